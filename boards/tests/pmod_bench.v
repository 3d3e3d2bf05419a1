// Prints what the chip of a PMOD takes of each pixel.
module bench;
    reg clock = 1'b0;
    wire [3:0] red, green, blue;
    wire active, hsync, vsync, dvi_clk;
    integer pixels;

    TOP dut (
        .oscillator_clk(clock), .red(red), .green(green), .blue(blue),
        .active(active), .hsync(hsync), .vsync(vsync), .dvi_clk(dvi_clk)
    );
    always #41_667 clock = ~clock;

    // The chip of the PMOD takes a pixel where its clock rises.
    initial begin
        for (pixels = 0; pixels < TIMES; pixels = pixels + 1) begin
            @(posedge dvi_clk) $write("%h ", {active, hsync, vsync, red, green, blue});
        end
        $finish;
    end
endmodule
