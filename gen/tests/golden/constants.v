// constants
//
// Parameters  constants
// Latency     0 clocks
// Described   gen/tests/lanes/modules.rs:173
`default_nettype none

module constants (
    input  wire         clk,
    input  wire         rst,
    input  wire [95:0]  x,
    output wire [143:0] shown,
    output wire [95:0]  corner
);

    genvar i;
    genvar j;

    localparam [95:0] all_cells_all_listed_4 = {
        8'h06, 8'h03, 8'h00, 8'h04, 8'h03, 8'h00, 8'h04, 8'h01, 8'h02, 8'h06, 8'h03, 8'h00
    };
    generate
        for (i = 0; i < 3; i = i + 1) begin : all_cells
            for (j = 0; j < 4; j = j + 1) begin : col
                localparam [31:0] all_listed = 10 * i;
                localparam [31:0] all_listed_2 = j;
                localparam [31:0] all_listed_3 = (i * 4 + j);
                wire [7:0] all_sum = x[(i * 4 + j) * 8 +: 8] + all_listed[7:0] + all_listed_2[7:0] + all_listed_3[7:0];
                wire [7:0] all = all_sum + all_cells_all_listed_4[(i * 4 + j) * 8 +: 8];
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : row
            wire [7:0] difference = all_cells[0].col[3 - i].all - all_cells[2].col[3 - i].all;
        end
    endgenerate

    generate
        for (i = 0; i < 3; i = i + 1) begin : shown_listed_cells
            for (j = 0; j < 4; j = j + 1) begin : col
                wire [7:0] shown_listed;
                case (i)
                    0: begin : shown_listed_0 assign shown_listed = row[j].difference; end
                    1: begin : shown_listed_1 assign shown_listed = all_cells[0].col[3 - j].all; end
                    default: begin : shown_listed_2 assign shown_listed = all_cells[2].col[3 - j].all; end
                endcase
            end
        end
    endgenerate

    generate
        for (i = 0; i < 3; i = i + 1) begin : shown_linked_cells
            for (j = 0; j < 6; j = j + 1) begin : col
                wire [7:0] shown_linked;
                if (j < 1 || j >= 5) begin : shown_linked_edge
                    assign shown_linked = x[i * 32 +: 8];
                end else begin : shown_linked_link
                    assign shown_linked = shown_listed_cells[i].col[j - 1].shown_listed;
                end
            end
        end
    endgenerate

    generate
        for (i = 0; i < 3; i = i + 1) begin : shown_of
            for (j = 0; j < 6; j = j + 1) begin : shown_col
                assign shown[(i * 6 + j) * 8 +: 8] = shown_linked_cells[i].col[j].shown_linked;
            end
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : corner_of
            for (j = 0; j < 4; j = j + 1) begin : corner_col
                assign corner[(i * 4 + j) * 8 +: 8] = all_cells[i].col[j].all;
            end
        end
    endgenerate

    wire _unused_ok = &{1'b0, clk, rst};
endmodule
`default_nettype wire
