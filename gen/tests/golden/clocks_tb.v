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

    reg [5:0] gap;
    reg [1:0] rising;
    reg [15:0] expected;
    reg [23:0] steps [0:3];
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
            {gap, rising, expected} = steps[cycle];
            /* verilator lint_off ZERODLY */ // a gap is 2 at least
            #(gap / 2);
            clk = 1'b0;
            slow_clk = 1'b0;
            #(gap - gap / 2);
            /* verilator lint_on ZERODLY */
            {want_count, want_seen} = expected;
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
            if (rising[0]) clk = 1'b1;
            if (rising[1]) slow_clk = 1'b1;
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
        put(0, 4, { 1'b1,
            6'h0a, 2'h1, 16'h0a00,
            6'h04, 2'h2, 16'h0e00,
            6'h06, 2'h1, 16'h1400,
            6'h32, 2'h3, 16'h4600
        });
    end
    endtask

    // The first row is the most significant. Above it is a 1.
    task put;
        input integer first;
        input integer count_2;
        input [96:0] rows;
        integer row;
    begin
        for (row = 0; row < count_2; row = row + 1)
            steps[first + row] = rows[24 * (count_2 - 1 - row) +: 24];
    end
    endtask
endmodule
`default_nettype wire
