// packed_ports
//
// Parameters  packed_ports
// Described   gen/tests/lanes/modules.rs:129
`default_nettype none

module packed_ports (
    input  wire        clk,
    input  wire        rst,
    input  wire [95:0] x,
    input  wire [11:0] word,
    output wire [31:0] sums,
    output wire [31:0] smallest,
    output wire [7:0]  single,
    output wire [23:0] turned,
    output wire [23:0] lanes
);

    wire [7:0] u_single_smallest;                                // gen/tests/../../hdl/tests/shapes/build.rs:275

    wire [23:0] u_single_x;                                      // gen/tests/lanes/modules.rs:133

    genvar i;
    genvar j;

    generate
        for (i = 0; i < 4; i = i + 1) begin : cells
            for (j = 0; j < 3; j = j + 1) begin : col
                reg [7:0] state;

                always @(posedge clk) begin
                    if (rst) state <= 8'd0;
                    else state <= x[(i * 3 + j) * 8 +: 8];
                end
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : u_row                  // gen/tests/lanes/modules.rs:132
            wire [7:0] sum;
            wire [23:0] reverse;
            wire [7:0] lane_smallest;
            wire [23:0] u_row_x;
            for (j = 0; j < 3; j = j + 1) begin : u_row_x_of
                assign u_row_x[j * 8 +: 8] = cells[i].col[j].state;
            end

            sums3 lane (
                .x        (u_row_x),
                .sum      (sum),
                .reverse  (reverse),
                .smallest (lane_smallest)
            );
        end
    endgenerate

    generate
        for (i = 0; i < 3; i = i + 1) begin : row
            wire [7:0] lanes_xor;
            for (j = 0; j < 7; j = j + 1) begin : lanes_xor_tree
                wire [7:0] value;
                if (j < 4) begin : leaf
                    assign value = u_row[j].reverse[i * 8 +: 8];
                end else begin : pair
                    assign value = lanes_xor_tree[2 * (j - 4)].value ^ lanes_xor_tree[2 * (j - 4) + 1].value;
                end
            end
            assign lanes_xor = lanes_xor_tree[6].value;
            wire [7:0] lanes_difference = {{4{word[i * 4 + 3]}}, word[i * 4 +: 4]} - lanes_xor;
        end
    endgenerate

    sums3 u_single (                                             // gen/tests/lanes/modules.rs:134
        .x        (u_single_x),
        .sum      (single),
        .reverse  (turned),
        .smallest (u_single_smallest)
    );

    generate
        for (i = 0; i < 3; i = i + 1) begin : lanes_of
            assign lanes[i * 8 +: 8] = row[i].lanes_difference;
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_single_x_of
            assign u_single_x[i * 8 +: 8] = row[i].lanes_xor;
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : sums_of
            assign sums[i * 8 +: 8] = u_row[i].sum;
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : smallest_of
            assign smallest[i * 8 +: 8] = u_row[i].lane_smallest;
        end
    endgenerate

    wire _unused_ok = &{1'b0, u_single_smallest};
endmodule
`default_nettype wire
