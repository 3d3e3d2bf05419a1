`timescale 1ps/1ps

// The PLL of an iCE40 as far as the tops use it, for simulators: Yosys has no model of it.

// It passes the clock of its pad on, and makes (DIVF + 1) / ((DIVR + 1) * 2 ** DIVQ) of its frequency.
module SB_PLL40_2_PAD (
    input  wire PACKAGEPIN, EXTFEEDBACK, BYPASS, RESETB, LATCHINPUTVALUE, SDI, SCLK,
    input  wire [7:0] DYNAMICDELAY,
    output wire PLLOUTCOREA, PLLOUTGLOBALA, PLLOUTCOREB,
    output reg  PLLOUTGLOBALB, LOCK,
    output wire SDO
);
    parameter FEEDBACK_PATH = "SIMPLE", PLLOUT_SELECT_PORTB = "GENCLK", FILTER_RANGE = 0, DIVR = 0, DIVF = 0, DIVQ = 0;
    time before, half;

    assign PLLOUTGLOBALA = PACKAGEPIN;
    initial begin
        {PLLOUTGLOBALB, LOCK} = 2'b00;
        @(posedge PACKAGEPIN) before = $time;
        @(posedge PACKAGEPIN) half = ($time - before) * (DIVR + 1) * (1 << DIVQ) / (DIVF + 1) / 2;
        // The oscillator runs at 533 to 1066 MHz.
        if (2 * half >> DIVQ < 938 || 2 * half >> DIVQ > 1876) $finish;
        // No phase of the clock is promised.
        #1234 forever begin
            #half PLLOUTGLOBALB = ~PLLOUTGLOBALB;
            LOCK = $time > 500_000;
        end
    end
endmodule

// A pin that sends a bit from a register, or in each clock two.
module SB_IO (
    input  wire CLOCK_ENABLE, INPUT_CLK, OUTPUT_CLK, LATCH_INPUT_VALUE, OUTPUT_ENABLE, D_OUT_0, D_OUT_1,
    output wire PACKAGE_PIN, D_IN_0, D_IN_1
);
    parameter [5:0] PIN_TYPE = 6'b01_0101;
    reg first, second;
    always @(posedge OUTPUT_CLK) first <= D_OUT_0;
    always @(negedge OUTPUT_CLK) second <= D_OUT_1;
    // No other kind is known here.
    initial if (PIN_TYPE != 6'b01_0101 && PIN_TYPE != 6'b01_0001) $finish;
    assign PACKAGE_PIN = PIN_TYPE[2] || OUTPUT_CLK ? first : second;
endmodule
