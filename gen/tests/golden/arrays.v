// arrays
//
// Parameters  arrays
// Described   gen/tests/lanes/modules.rs:214
`default_nettype none

module arrays (
    input  wire        clk,
    input  wire        rst,
    input  wire [31:0] x,
    input  wire [23:0] tall,
    output wire [31:0] first_out,
    output wire [63:0] reversed,
    output wire [31:0] smallest,
    output wire [95:0] added
);

    genvar i;
    genvar j;

    generate
        for (i = 0; i < 3; i = i + 1) begin : u_cell                 // gen/tests/lanes/modules.rs:232
            for (j = 0; j < 4; j = j + 1) begin : col
                wire [7:0] sum;
                wire [7:0] lane_x;
                if (j < 1) begin : lane_x_edge
                    assign lane_x = tall[i * 8 +: 8];
                end else begin : lane_x_link
                    assign lane_x = u_cell[i].col[j - 1].sum;
                end

                adder lane (
                    .x   (lane_x),
                    .y   (x[j * 8 +: 8]),
                    .sum (sum)
                );
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : row
            wire [7:0] u_one_sum;
            wire [15:0] u_one_reverse;
            wire [7:0] u_one_smallest;
            wire [7:0] u_two_sum;
            wire [15:0] u_two_reverse;
            wire [7:0] u_two_smallest;
            reg [7:0] first;
            reg [7:0] second;

            sums2 u_one (
                .x        ({x[i * 8 +: 8], second}),
                .sum      (u_one_sum),
                .reverse  (u_one_reverse),
                .smallest (u_one_smallest)
            );

            sums2 u_two (
                .x        ({x[i * 8 +: 8], first}),
                .sum      (u_two_sum),
                .reverse  (u_two_reverse),
                .smallest (u_two_smallest)
            );

            always @(posedge clk) begin
                if (rst) begin
                    first <= 8'd0;
                    second <= 8'd0;
                end else begin
                    first <= u_one_sum;
                    second <= u_two_reverse[15:8];
                end
            end
            wire _unused_lane = &{1'b0, u_one_smallest, u_two_sum, u_two_reverse};
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : first_out_of
            assign first_out[i * 8 +: 8] = row[i].first;
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : reversed_of
            assign reversed[i * 16 +: 16] = row[i].u_one_reverse;
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : smallest_of
            assign smallest[i * 8 +: 8] = row[i].u_two_smallest;
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : added_of
            for (j = 0; j < 4; j = j + 1) begin : added_col
                assign added[(i * 4 + j) * 8 +: 8] = u_cell[i].col[j].sum;
            end
        end
    endgenerate
endmodule
`default_nettype wire
