// counters
//
// Parameters  counters
// Described   gen/tests/lanes/modules.rs:13
`default_nettype none

module counters (
    input  wire        clk,
    input  wire        rst,
    input  wire        go,
    input  wire [39:0] limits,
    output wire        any,
    output wire [7:0]  most,
    output wire [39:0] counts
);

    genvar i;

    localparam [39:0] row_count_reset = {
        8'h03, 8'hc8, 8'h00, 8'h07, 8'h09
    };
    generate
        for (i = 0; i < 5; i = i + 1) begin : row
            reg [7:0] count;
            wire done = count >= limits[i * 8 +: 8];
            wire count_enable;
            if (i < 1) begin : count_enable_edge
                assign count_enable = go;
            end else begin : count_enable_link
                assign count_enable = row[i - 1].done;
            end

            always @(posedge clk) begin
                if (rst) begin
                    count <= row_count_reset[i * 8 +: 8];
                end else if (count_enable) begin
                    if (done) count <= 8'd0;
                    else count <= count + 8'd1;
                end
            end
            `ifndef SYNTHESIS
            `ifdef FORMAL
            always @(posedge clk) begin
                if (!rst) assert (!done | (count >= limits[i * 8 +: 8]));    // gen/tests/lanes/modules.rs:34
            end
            `else
            always @(posedge clk) begin
                if (!rst && !(!done | (count >= limits[i * 8 +: 8]))) begin  // gen/tests/lanes/modules.rs:34
                    $display("FAIL: time %0t: %m: done at the limit", $time);
                    stop;
                end
            end
            `endif
            `endif
        end
    endgenerate

    wire [4:0] any_lanes;
    generate
        for (i = 0; i < 5; i = i + 1) begin : any_of
            assign any_lanes[i] = row[i].done;
        end
    endgenerate
    assign any = |any_lanes;                                     // gen/tests/lanes/modules.rs:26
    generate
        for (i = 0; i < 9; i = i + 1) begin : most_tree
            wire [7:0] value;
            if (i < 5) begin : leaf
                assign value = row[i].count;
            end else begin : pair
                wire [7:0] a = most_tree[2 * (i - 5)].value;
                wire [7:0] b = most_tree[2 * (i - 5) + 1].value;
                assign value = (a > b) ? a : b;
            end
        end
    endgenerate
    assign most = most_tree[8].value;                            // gen/tests/lanes/modules.rs:28
    generate
        for (i = 0; i < 5; i = i + 1) begin : counts_of
            assign counts[i * 8 +: 8] = row[i].count;
        end
    endgenerate

`ifndef SYNTHESIS
`ifndef FORMAL
    task stop;
        begin
`ifdef __ICARUS__
            $finish_and_return(1);
`else
            $stop;
`endif
        end
    endtask
`endif
`endif
endmodule
`default_nettype wire
