// grid_tb
//
// Replays 3 recorded steps of grid and compares every output before every edge.
`default_nettype none

module grid_tb;

    reg clk;
    reg op;
    reg [7:0] seed;
    wire [7:0] total;
    reg [7:0] want_total;

    reg [8:0] stimulus;
    reg [7:0] expected;
    reg [16:0] steps [0:2];
    integer cycle;
    integer errors;

    grid dut (
        .clk   (clk),
        .op    (op),
        .seed  (seed),
        .total (total)
    );

    genvar lane0;
    genvar lane1;
    generate
        for (lane0 = 0; lane0 < 2; lane0 = lane0 + 1) begin : start_u_row
            for (lane1 = 0; lane1 < 3; lane1 = lane1 + 1) begin : start_u_row_u_cell_u_lane
                initial dut.u_row[lane0].lane.u_cell[lane1].u_lane.q = 8'h00;
            end
        end
    endgenerate

    initial begin : run
        fill;
        errors = 0;
        clk = 1'b0;
        #1;
        dut.u_row[1].lane.u_cell[2].u_lane.q = 8'h09;
        for (cycle = 0; cycle < 3; cycle = cycle + 1) begin
            {stimulus, expected} = steps[cycle];
            #2;
            clk = 1'b0;
            {op, seed} = stimulus;
            #3;
            {want_total} = expected;
            if (total !== want_total) begin
                if (errors < 10)
                    $display("FAIL: cycle %0d: total is %h, expected %h", cycle, total, want_total);
                errors = errors + 1;
            end
            clk = 1'b1;
        end
        #1;
        if (errors == 0) $display("PASS: 3 cycles");
        else begin
            $display("FAIL: %0d mismatches in 3 cycles", errors);
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
        put(0, 3, { 1'b1,
            9'h105, 8'h00,
            9'h10a, 8'h00,
            9'h10f, 8'h00
        });
    end
    endtask

    // The first row is the most significant. Above it is a 1.
    task put;
        input integer first;
        input integer count;
        input [51:0] rows;
        integer row;
    begin
        for (row = 0; row < count; row = row + 1)
            steps[first + row] = rows[17 * (count - 1 - row) +: 17];
    end
    endtask
endmodule
`default_nettype wire
