`timescale 1ps/1ps

// The cells of an ECP5 as far as the tops use them, for simulators: Yosys has no models of these.

// A PLL whose feedback is its output: it has CLKFB_DIV / CLKI_DIV of the frequency of its input.
module EHXPLLL #(
    parameter CLKI_DIV = 1, CLKFB_DIV = 1, CLKOP_DIV = 8, CLKOP_CPHASE = 0, FEEDBK_PATH = "CLKOP",
    parameter CLKOS_ENABLE = "DISABLED", CLKOS_DIV = 8, CLKOS_CPHASE = 0
) (
    input  wire CLKI, CLKFB, RST, STDBY, PHASESEL0, PHASESEL1, PHASEDIR, PHASESTEP, PHASELOADREG, PLLWAKESYNC, ENCLKOP,
    output reg  CLKOP, CLKOS,
    output reg  LOCK
);
    time before, half, other;

    initial begin
        {CLKOP, CLKOS, LOCK} = 3'b000;
        @(posedge CLKI) before = $time;
        @(posedge CLKI) half = ($time - before) * CLKI_DIV / CLKFB_DIV / 2;
        // The oscillator runs at 400 to 800 MHz.
        if (2 * half / CLKOP_DIV < 1250 || 2 * half / CLKOP_DIV > 2500) $finish;
        other = half / CLKOP_DIV * CLKOS_DIV;
        // No phase of the clock is promised.
        #1234 fork
            forever begin
                #half CLKOP = ~CLKOP;
                LOCK = $time > 500_000;
            end
            forever #other CLKOS = ~CLKOS;
        join
    end
endmodule

// Two bits in each clock.
module ODDRX1F (input wire SCLK, RST, D0, D1, output wire Q);
    parameter GSR = "ENABLED";
    reg first, second;
    always @(posedge SCLK) {first, second} <= {D0, D1};
    assign Q = SCLK ? first : second;
endmodule


// A block RAM of 1024 rows of 18 bits. Ports of 1, 2 and 4 bits leave the ninth bit of each byte alone.
module DP16KD (
    input wire DIA17, DIA16, DIA15, DIA14, DIA13, DIA12, DIA11, DIA10, DIA9, DIA8, DIA7, DIA6, DIA5, DIA4, DIA3, DIA2, DIA1, DIA0,
    input wire ADA13, ADA12, ADA11, ADA10, ADA9, ADA8, ADA7, ADA6, ADA5, ADA4, ADA3, ADA2, ADA1, ADA0,
    input wire CEA, OCEA, CLKA, WEA, RSTA, CSA2, CSA1, CSA0,
    output wire DOA17, DOA16, DOA15, DOA14, DOA13, DOA12, DOA11, DOA10, DOA9, DOA8, DOA7, DOA6, DOA5, DOA4, DOA3, DOA2, DOA1, DOA0,
    input wire DIB17, DIB16, DIB15, DIB14, DIB13, DIB12, DIB11, DIB10, DIB9, DIB8, DIB7, DIB6, DIB5, DIB4, DIB3, DIB2, DIB1, DIB0,
    input wire ADB13, ADB12, ADB11, ADB10, ADB9, ADB8, ADB7, ADB6, ADB5, ADB4, ADB3, ADB2, ADB1, ADB0,
    input wire CEB, OCEB, CLKB, WEB, RSTB, CSB2, CSB1, CSB0,
    output wire DOB17, DOB16, DOB15, DOB14, DOB13, DOB12, DOB11, DOB10, DOB9, DOB8, DOB7, DOB6, DOB5, DOB4, DOB3, DOB2, DOB1, DOB0
);
    parameter DATA_WIDTH_A = 18, DATA_WIDTH_B = 18, REGMODE_A = "NOREG", REGMODE_B = "NOREG", RESETMODE = "SYNC";
    parameter ASYNC_RESET_RELEASE = "SYNC", CSDECODE_A = "0b000", CSDECODE_B = "0b000", GSR = "AUTO";
    parameter WRITEMODE_A = "NORMAL", WRITEMODE_B = "NORMAL", CLKAMUX = "CLKA", CLKBMUX = "CLKB";
    parameter [319:0]
        INITVAL_00 = 320'b0, INITVAL_01 = 320'b0, INITVAL_02 = 320'b0, INITVAL_03 = 320'b0,
        INITVAL_04 = 320'b0, INITVAL_05 = 320'b0, INITVAL_06 = 320'b0, INITVAL_07 = 320'b0,
        INITVAL_08 = 320'b0, INITVAL_09 = 320'b0, INITVAL_0A = 320'b0, INITVAL_0B = 320'b0,
        INITVAL_0C = 320'b0, INITVAL_0D = 320'b0, INITVAL_0E = 320'b0, INITVAL_0F = 320'b0,
        INITVAL_10 = 320'b0, INITVAL_11 = 320'b0, INITVAL_12 = 320'b0, INITVAL_13 = 320'b0,
        INITVAL_14 = 320'b0, INITVAL_15 = 320'b0, INITVAL_16 = 320'b0, INITVAL_17 = 320'b0,
        INITVAL_18 = 320'b0, INITVAL_19 = 320'b0, INITVAL_1A = 320'b0, INITVAL_1B = 320'b0,
        INITVAL_1C = 320'b0, INITVAL_1D = 320'b0, INITVAL_1E = 320'b0, INITVAL_1F = 320'b0,
        INITVAL_20 = 320'b0, INITVAL_21 = 320'b0, INITVAL_22 = 320'b0, INITVAL_23 = 320'b0,
        INITVAL_24 = 320'b0, INITVAL_25 = 320'b0, INITVAL_26 = 320'b0, INITVAL_27 = 320'b0,
        INITVAL_28 = 320'b0, INITVAL_29 = 320'b0, INITVAL_2A = 320'b0, INITVAL_2B = 320'b0,
        INITVAL_2C = 320'b0, INITVAL_2D = 320'b0, INITVAL_2E = 320'b0, INITVAL_2F = 320'b0,
        INITVAL_30 = 320'b0, INITVAL_31 = 320'b0, INITVAL_32 = 320'b0, INITVAL_33 = 320'b0,
        INITVAL_34 = 320'b0, INITVAL_35 = 320'b0, INITVAL_36 = 320'b0, INITVAL_37 = 320'b0,
        INITVAL_38 = 320'b0, INITVAL_39 = 320'b0, INITVAL_3A = 320'b0, INITVAL_3B = 320'b0,
        INITVAL_3C = 320'b0, INITVAL_3D = 320'b0, INITVAL_3E = 320'b0, INITVAL_3F = 320'b0;

    reg [17:0] rows [0:1023];
    reg [17:0] a, b;
    // Port B reads two rows of 18 bits as one of 36.
    reg [35:0] both;
    wire [13:0] ada = {ADA13, ADA12, ADA11, ADA10, ADA9, ADA8, ADA7, ADA6, ADA5, ADA4, ADA3, ADA2, ADA1, ADA0}, adb = {ADB13, ADB12, ADB11, ADB10, ADB9, ADB8, ADB7, ADB6, ADB5, ADB4, ADB3, ADB2, ADB1, ADB0};
    wire [17:0] dia = {DIA17, DIA16, DIA15, DIA14, DIA13, DIA12, DIA11, DIA10, DIA9, DIA8, DIA7, DIA6, DIA5, DIA4, DIA3, DIA2, DIA1, DIA0}, dib = {DIB17, DIB16, DIB15, DIB14, DIB13, DIB12, DIB11, DIB10, DIB9, DIB8, DIB7, DIB6, DIB5, DIB4, DIB3, DIB2, DIB1, DIB0};
    assign {DOA17, DOA16, DOA15, DOA14, DOA13, DOA12, DOA11, DOA10, DOA9, DOA8, DOA7, DOA6, DOA5, DOA4, DOA3, DOA2, DOA1, DOA0} = DATA_WIDTH_B == 36 ? both[17:0] : a;
    assign {DOB17, DOB16, DOB15, DOB14, DOB13, DOB12, DOB11, DOB10, DOB9, DOB8, DOB7, DOB6, DOB5, DOB4, DOB3, DOB2, DOB1, DOB0} = DATA_WIDTH_B == 36 ? both[35:18] : b;

    integer place;
    task start(input integer first, input [319:0] slice);
        for (place = 0; place < 16; place = place + 1) rows[16 * first + place] = slice[20 * place +: 18];
    endtask
    initial begin
        {a, b, both} = 72'b0;
        start(0, INITVAL_00);
        start(1, INITVAL_01);
        start(2, INITVAL_02);
        start(3, INITVAL_03);
        start(4, INITVAL_04);
        start(5, INITVAL_05);
        start(6, INITVAL_06);
        start(7, INITVAL_07);
        start(8, INITVAL_08);
        start(9, INITVAL_09);
        start(10, INITVAL_0A);
        start(11, INITVAL_0B);
        start(12, INITVAL_0C);
        start(13, INITVAL_0D);
        start(14, INITVAL_0E);
        start(15, INITVAL_0F);
        start(16, INITVAL_10);
        start(17, INITVAL_11);
        start(18, INITVAL_12);
        start(19, INITVAL_13);
        start(20, INITVAL_14);
        start(21, INITVAL_15);
        start(22, INITVAL_16);
        start(23, INITVAL_17);
        start(24, INITVAL_18);
        start(25, INITVAL_19);
        start(26, INITVAL_1A);
        start(27, INITVAL_1B);
        start(28, INITVAL_1C);
        start(29, INITVAL_1D);
        start(30, INITVAL_1E);
        start(31, INITVAL_1F);
        start(32, INITVAL_20);
        start(33, INITVAL_21);
        start(34, INITVAL_22);
        start(35, INITVAL_23);
        start(36, INITVAL_24);
        start(37, INITVAL_25);
        start(38, INITVAL_26);
        start(39, INITVAL_27);
        start(40, INITVAL_28);
        start(41, INITVAL_29);
        start(42, INITVAL_2A);
        start(43, INITVAL_2B);
        start(44, INITVAL_2C);
        start(45, INITVAL_2D);
        start(46, INITVAL_2E);
        start(47, INITVAL_2F);
        start(48, INITVAL_30);
        start(49, INITVAL_31);
        start(50, INITVAL_32);
        start(51, INITVAL_33);
        start(52, INITVAL_34);
        start(53, INITVAL_35);
        start(54, INITVAL_36);
        start(55, INITVAL_37);
        start(56, INITVAL_38);
        start(57, INITVAL_39);
        start(58, INITVAL_3A);
        start(59, INITVAL_3B);
        start(60, INITVAL_3C);
        start(61, INITVAL_3D);
        start(62, INITVAL_3E);
        start(63, INITVAL_3F);
    end

    // Where the bits of an address begin in its row.
    function integer low(input integer width, input [13:0] at);
        case (width)
            1: low = 9 * at[3] + at[2:0];
            2: low = 9 * at[3] + 2 * at[2:1];
            4: low = 9 * at[3] + 4 * at[2];
            9: low = 9 * at[3];
            default: low = 0;
        endcase
    endfunction
    function [17:0] mask(input integer width, input [13:0] at);
        mask = width == 18 ? {{9{at[1]}}, {9{at[0]}}} : ((18'd1 << width) - 18'd1) << low(width, at);
    endfunction

    // What the tops do not use is not modelled.
    task refuse;
        begin
            $display("a DP16KD is used in a way that its model does not have");
            $finish;
        end
    endtask
    initial if (WRITEMODE_A == "WRITETHROUGH" || WRITEMODE_B == "WRITETHROUGH") refuse;
    initial if (CLKAMUX == "INV" || CLKBMUX == "INV" || REGMODE_A != "NOREG" || REGMODE_B != "NOREG") refuse;
    always @(posedge CLKA) if (RSTA || (CEA && WEA && DATA_WIDTH_A == 36)) refuse;
    always @(posedge CLKB) if (RSTB) refuse;

    always @(posedge CLKA) if (CEA) begin
        if (!WEA || WRITEMODE_A == "READBEFOREWRITE") a <= rows[ada[13:4]] >> low(DATA_WIDTH_A, ada);
        if (WEA) rows[ada[13:4]] <= rows[ada[13:4]] & ~mask(DATA_WIDTH_A, ada)
            | dia << low(DATA_WIDTH_A, ada) & mask(DATA_WIDTH_A, ada);
    end
    always @(posedge CLKB) if (CEB) begin
        both <= {rows[{adb[13:5], 1'b1}], rows[{adb[13:5], 1'b0}]};
        if (!WEB || WRITEMODE_B == "READBEFOREWRITE") b <= rows[adb[13:4]] >> low(DATA_WIDTH_B, adb);
        if (WEB) rows[adb[13:4]] <= rows[adb[13:4]] & ~mask(DATA_WIDTH_B, adb)
            | dib << low(DATA_WIDTH_B, adb) & mask(DATA_WIDTH_B, adb);
    end
endmodule

// A product without registers.
module MULT18X18D (
    input wire A17, A16, A15, A14, A13, A12, A11, A10, A9, A8, A7, A6, A5, A4, A3, A2, A1, A0,
    input wire B17, B16, B15, B14, B13, B12, B11, B10, B9, B8, B7, B6, B5, B4, B3, B2, B1, B0,
    input wire C17, C16, C15, C14, C13, C12, C11, C10, C9, C8, C7, C6, C5, C4, C3, C2, C1, C0,
    input wire SIGNEDA, SIGNEDB, SOURCEA, SOURCEB,
    input wire CLK0, CLK1, CLK2, CLK3, CE0, CE1, CE2, CE3, RST0, RST1, RST2, RST3,
    output wire P35, P34, P33, P32, P31, P30, P29, P28, P27, P26, P25, P24, P23, P22, P21, P20, P19, P18, P17, P16, P15, P14, P13, P12, P11, P10, P9, P8, P7, P6, P5, P4, P3, P2, P1, P0
);
    parameter REG_INPUTA_CLK = "NONE", REG_INPUTB_CLK = "NONE", REG_INPUTC_CLK = "NONE", REG_PIPELINE_CLK = "NONE";
    parameter REG_OUTPUT_CLK = "NONE", CLK0_DIV = "ENABLED", MULT_BYPASS = "DISABLED", GSR = "ENABLED", RESETMODE = "SYNC";
    parameter SOURCEB_MODE = "B_SHIFT", HIGHSPEED_CLK = "NONE", CAS_MATCH_REG = "FALSE";
    initial if ({REG_INPUTA_CLK, REG_INPUTB_CLK, REG_PIPELINE_CLK, REG_OUTPUT_CLK} != "NONENONENONENONE") begin
        $display("a MULT18X18D has registers, which its model does not have");
        $finish;
    end
    wire [17:0] a = {A17, A16, A15, A14, A13, A12, A11, A10, A9, A8, A7, A6, A5, A4, A3, A2, A1, A0}, b = {B17, B16, B15, B14, B13, B12, B11, B10, B9, B8, B7, B6, B5, B4, B3, B2, B1, B0};
    assign {P35, P34, P33, P32, P31, P30, P29, P28, P27, P26, P25, P24, P23, P22, P21, P20, P19, P18, P17, P16, P15, P14, P13, P12, P11, P10, P9, P8, P7, P6, P5, P4, P3, P2, P1, P0} = {{18{SIGNEDA & a[17]}}, a} * {{18{SIGNEDB & b[17]}}, b};
endmodule
