// row_lanes5
//
// A chain of cells.
//
// Parameters  Row { lanes: 5 }
// Described   gen/tests/blocks/mod.rs:92
`default_nettype none

module row_lanes5 (
    input  wire       clk,
    input  wire       op,
    input  wire [7:0] seed,
    output wire       any,
    output wire       all,
    output wire [7:0] last,
    output wire [7:0] total,
    output wire [7:0] third
);

    genvar i;

    localparam [39:0] u_cell_weight = {
        8'h3e, 8'h3e, 8'h7c, 8'h1f, 8'h00
    };
    generate
        for (i = 0; i < 5; i = i + 1) begin : u_cell                 // gen/tests/blocks/mod.rs:101
            wire [7:0] q;
            wire hit;
            wire [7:0] sum;
            localparam [31:0] x = i;
            wire [7:0] left;
            if (i < 1) begin : left_edge
                assign left = seed;
            end else begin : left_link
                assign left = u_cell[i - 1].sum;
            end

            cell_ lane (
                .clk    (clk),
                .op     (op),
                .x      (x[3:0]),
                .left   (left),
                .weight (u_cell_weight[i * 8 +: 8]),
                .q      (q),
                .hit    (hit),
                .sum    (sum)
            );
            wire _unused_lane = &{1'b0, sum};
        end
    endgenerate

    wire [4:0] any_lanes;
    generate
        for (i = 0; i < 5; i = i + 1) begin : any_of
            assign any_lanes[i] = u_cell[i].hit;
        end
    endgenerate
    assign any = |any_lanes;                                     // gen/tests/blocks/mod.rs:108
    wire [4:0] all_lanes;
    generate
        for (i = 0; i < 5; i = i + 1) begin : all_of
            assign all_lanes[i] = u_cell[i].hit;
        end
    endgenerate
    assign all = &all_lanes;                                     // gen/tests/blocks/mod.rs:109
    generate
        for (i = 0; i < 9; i = i + 1) begin : total_tree
            wire [7:0] value;
            if (i < 5) begin : leaf
                assign value = u_cell[i].q;
            end else begin : pair
                assign value = total_tree[2 * (i - 5)].value + total_tree[2 * (i - 5) + 1].value;
            end
        end
    endgenerate
    assign total = total_tree[8].value;                          // gen/tests/blocks/mod.rs:111

    assign last = u_cell[4].q;
    assign third = u_cell[2].sum;
endmodule
`default_nettype wire
