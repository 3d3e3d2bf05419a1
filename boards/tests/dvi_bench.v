`timescale 1ps/1ps

// A PLL whose feedback is its output: it has CLKFB_DIV / CLKI_DIV of the frequency of its input.
module EHXPLLL #(
    parameter CLKI_DIV = 1, CLKFB_DIV = 1, CLKOP_DIV = 8, CLKOP_CPHASE = 0, FEEDBK_PATH = "CLKOP"
) (
    input  wire CLKI, CLKFB, RST, STDBY, PHASESEL0, PHASESEL1, PHASEDIR, PHASESTEP, PHASELOADREG, PLLWAKESYNC, ENCLKOP,
    output reg  CLKOP,
    output reg  LOCK
);
    time before, half;

    initial begin
        {CLKOP, LOCK} = 2'b00;
        @(posedge CLKI) before = $time;
        @(posedge CLKI) half = ($time - before) * CLKI_DIV / CLKFB_DIV / 2;
        // The oscillator runs at 400 to 800 MHz.
        if (2 * half / CLKOP_DIV < 1250 || 2 * half / CLKOP_DIV > 2500) $finish;
        // No phase of the clock is promised.
        #1234 forever begin
            #half CLKOP = ~CLKOP;
            LOCK = $time > 500_000;
        end
    end
endmodule

// Two bits in each clock.
module ODDRX1F (input wire SCLK, RST, D0, D1, output wire Q);
    reg first, second;
    always @(posedge SCLK) {first, second} <= {D0, D1};
    assign Q = SCLK ? first : second;
endmodule

module bench;
    reg clock = 1'b0;
    wire [3:0] tmds;
    wire locked;
    integer bits;

    test_picture dut (.pixel_clk(clock), .tmds(tmds), .locked(locked));
    always #20_000 clock = ~clock;

    // From the clock of the dut only its first edge is known: the bits follow each other in 4 ns.
    initial begin
        @(posedge locked);
        @(posedge dut.serial_clk) #2_000;
        for (bits = 0; bits < 4 * 800 * 10; bits = bits + 1) begin
            $write("%h", tmds);
            #4_000;
        end
        $finish;
    end
endmodule
