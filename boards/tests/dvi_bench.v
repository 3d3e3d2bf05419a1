// Prints what is at the pins of the top in the middle of each bit.
module bench;
    reg clock = 1'b0;
    wire [3:0] tmds;
    wire locked;
    integer bits;

    TOP dut (.pixel_clk(clock), .tmds(tmds), .locked(locked));
    always #20_000 clock = ~clock;

    // From the clock of the dut only its first edge is known: the bits follow each other in 4 ns.
    initial begin
        @(posedge locked);
        @(posedge dut.serial_clk) #2_000;
        for (bits = 0; bits < TIMES; bits = bits + 1) begin
            $write("%h", tmds);
            #4_000;
        end
        $finish;
    end
endmodule
