// rings
//
// Parameters  rings
// Described   gen/tests/lanes/modules.rs:149
`default_nettype none

module rings (
    input  wire        clk,
    input  wire        rst,
    input  wire [23:0] x,
    input  wire [7:0]  first,
    output wire [7:0]  last,
    output wire [95:0] held_out
);

    genvar i;
    genvar j;

    generate
        for (i = 0; i < 3; i = i + 1) begin : cells_ahead
            for (j = 0; j < 4; j = j + 1) begin : col
                reg [7:0] held;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 3; i = i + 1) begin : rippled_row
            wire [7:0] rippled;
            wire [7:0] rippled_linked;
            if (i < 1) begin : rippled_linked_edge
                assign rippled_linked = first;
            end else begin : rippled_linked_link
                assign rippled_linked = rippled_row[i - 1].rippled;
            end
            assign rippled = x[i * 8 +: 8] + rippled_linked;
        end
    endgenerate

    generate
        for (i = 0; i < 3; i = i + 1) begin : total_row
            reg [7:0] total;
            wire [7:0] held_max;
            for (j = 0; j < 7; j = j + 1) begin : held_max_tree
                wire [7:0] value;
                if (j < 4) begin : leaf
                    assign value = cells_ahead[i].col[j].held;
                end else begin : pair
                    wire [7:0] a = held_max_tree[2 * (j - 4)].value;
                    wire [7:0] b = held_max_tree[2 * (j - 4) + 1].value;
                    assign value = (a > b) ? a : b;
                end
            end
            assign held_max = held_max_tree[6].value;

            always @(posedge clk) begin
                if (rst) total <= 8'd0;
                else total <= held_max + x[i * 8 +: 8];
            end
        end
    endgenerate

    generate
        for (i = 0; i < 3; i = i + 1) begin : cells
            for (j = 0; j < 4; j = j + 1) begin : col
                always @(posedge clk) begin
                    if (rst) begin
                        cells_ahead[i].col[j].held <= 8'd0;
                    end else begin
                        cells_ahead[i].col[j].held <= cells_ahead[i].col[j].held + total_row[i].total;
                    end
                end
            end
        end
    endgenerate

    generate
        for (i = 0; i < 3; i = i + 1) begin : held_out_of
            for (j = 0; j < 4; j = j + 1) begin : held_out_col
                assign held_out[(i * 4 + j) * 8 +: 8] = cells_ahead[i].col[j].held;
            end
        end
    endgenerate

    assign last = rippled_row[2].rippled;
endmodule
`default_nettype wire
