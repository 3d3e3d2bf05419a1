// picks
//
// Parameters  picks
// Described   gen/tests/lanes/modules.rs:63
`default_nettype none

module picks (
    input  wire        clk,
    input  wire        rst,
    input  wire [39:0] words,
    input  wire [2:0]  which,
    input  wire [5:0]  bits,
    input  wire [7:0]  place,
    input  wire [47:0] grid,
    input  wire [7:0]  rows,
    output wire [7:0]  of_port,
    output wire [7:0]  of_row,
    output wire        of_bits,
    output wire [15:0] of_columns,
    output wire [7:0]  prime
);

    wire [7:0] prime_picked;                                     // gen/tests/lanes/modules.rs:79
    wire [1:0] which_1_0 = which[1:0];                           // gen/tests/lanes/modules.rs:75

    genvar i;
    genvar j;

    localparam [31:0] prime_listed_row_prime_listed = {
        8'h07, 8'h05, 8'h03, 8'h02
    };
    generate
        for (i = 0; i < 4; i = i + 1) begin : prime_listed_row
            wire [7:0] prime_listed = prime_listed_row_prime_listed[i * 8 +: 8];
        end
    endgenerate

    generate
        for (i = 0; i < 5; i = i + 1) begin : held_row
            reg [7:0] held;

            always @(posedge clk) begin
                if (rst) held <= 8'd0;
                else held <= words[i * 8 +: 8];
            end
        end
    endgenerate

    generate
        for (i = 0; i < 3; i = i + 1) begin : cells
            for (j = 0; j < 4; j = j + 1) begin : col
                reg [3:0] texel;

                always @(posedge clk) begin
                    if (rst) texel <= 4'd0;
                    else texel <= grid[(i * 4 + j) * 4 +: 4];
                end
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : of_columns_picked_row
            wire [3:0] of_columns_picked;
            wire [3:0] of_columns_picked_lanes [0:2];
            for (j = 0; j < 3; j = j + 1) begin : of_columns_picked_of
                assign of_columns_picked_lanes[j] = cells[j].col[i].texel;
            end
            assign of_columns_picked = (rows[i * 2 +: 2] < 2'd3) ? of_columns_picked_lanes[rows[i * 2 +: 2]] : 4'd0;
        end
    endgenerate

    assign of_port = (which < 3'd5) ? words[which * 8 +: 8] : 8'd0; // gen/tests/lanes/modules.rs:69
    wire [7:0] of_row_lanes [0:4];
    generate
        for (i = 0; i < 5; i = i + 1) begin : of_row_of
            assign of_row_lanes[i] = held_row[i].held;
        end
    endgenerate
    assign of_row = (which < 3'd5) ? of_row_lanes[which] : 8'd0; // gen/tests/lanes/modules.rs:69
    assign of_bits = (place < 8'd6) ? bits[place[2:0]] : 1'b0;   // gen/tests/lanes/modules.rs:69
    wire [7:0] prime_picked_lanes [0:3];
    generate
        for (i = 0; i < 4; i = i + 1) begin : prime_picked_of
            assign prime_picked_lanes[i] = prime_listed_row[i].prime_listed;
        end
    endgenerate
    assign prime_picked = prime_picked_lanes[which_1_0];         // gen/tests/lanes/modules.rs:79
    assign prime = prime_picked + held_row[0].held;              // gen/tests/lanes/modules.rs:80
    generate
        for (i = 0; i < 4; i = i + 1) begin : of_columns_of
            assign of_columns[i * 4 +: 4] = of_columns_picked_row[i].of_columns_picked;
        end
    endgenerate
endmodule
`default_nettype wire
