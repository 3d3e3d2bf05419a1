// clocks_tb
//
// Replays 4 recorded steps of clocks and compares every output before every edge.
`default_nettype none

module clocks_tb;

    reg clk;
    reg slow_clk;
    wire [7:0] count;
    wire [7:0] seen;
    reg [7:0] want_count;
    reg [7:0] want_seen;

    reg [15:0] expected [0:3];
    reg [63:0] gap [0:3];
    reg [1:0] rising [0:3];
    integer cycle;
    integer errors;

    clocks dut (
        .clk      (clk),
        .slow_clk (slow_clk),
        .count    (count),
        .seen     (seen)
    );

    generate
        initial dut.count = 8'h00;
        initial dut.seen = 8'h00;
    endgenerate

    initial begin : run
        fill;
        errors = 0;
        clk = 1'b0;
        slow_clk = 1'b0;
        for (cycle = 0; cycle < 4; cycle = cycle + 1) begin
            /* verilator lint_off ZERODLY */ // a gap is 2 at least
            #(gap[cycle] / 2);
            clk = 1'b0;
            slow_clk = 1'b0;
            #(gap[cycle] - gap[cycle] / 2);
            /* verilator lint_on ZERODLY */
            {want_count, want_seen} = expected[cycle];
            if (count !== want_count) begin
                if (errors < 10)
                    $display("FAIL: cycle %0d: count is %h, expected %h", cycle, count, want_count);
                errors = errors + 1;
            end
            if (seen !== want_seen) begin
                if (errors < 10)
                    $display("FAIL: cycle %0d: seen is %h, expected %h", cycle, seen, want_seen);
                errors = errors + 1;
            end
            if (rising[cycle][0]) clk = 1'b1;
            if (rising[cycle][1]) slow_clk = 1'b1;
        end
        #1;
        if (errors == 0) $display("PASS: 4 cycles");
        else begin
            $display("FAIL: %0d mismatches in 4 cycles", errors);
    `ifdef __ICARUS__
            $finish_and_return(1);
    `else
            $stop;
    `endif
        end
        $finish;
    end

    task fill;
    begin
        expected[0] = 16'h0a00; gap[0] = 64'h000000000000000a; rising[0] = 2'h1;
        expected[1] = 16'h0e00; gap[1] = 64'h0000000000000004; rising[1] = 2'h2;
        expected[2] = 16'h1400; gap[2] = 64'h0000000000000006; rising[2] = 2'h1;
        expected[3] = 16'h4600; gap[3] = 64'h0000000000000032; rising[3] = 2'h3;
    end
    endtask
endmodule
`default_nettype wire
