// systolic
//
// Parameters  systolic
// Described   gen/tests/../../hdl/tests/shapes/machines.rs:136
`default_nettype none

module systolic (
    input  wire         clk,
    input  wire         rst,
    input  wire [31:0]  left,
    input  wire [31:0]  above,
    input  wire         clear,
    output wire [255:0] product
);

    genvar i;
    genvar j;

    generate
        for (i = 0; i < 4; i = i + 1) begin : cells
            for (j = 0; j < 4; j = j + 1) begin : col
                reg [7:0] x;
                reg [7:0] y;
                reg [15:0] sum;
                wire [7:0] x_next;
                if (j < 1) begin : x_next_edge
                    assign x_next = left[i * 8 +: 8];
                end else begin : x_next_link
                    assign x_next = cells[i].col[j - 1].x;
                end
                wire [7:0] y_next;
                if (i < 1) begin : y_next_edge
                    assign y_next = above[j * 8 +: 8];
                end else begin : y_next_link
                    assign y_next = cells[i - 1].col[j].y;
                end

                always @(posedge clk) begin
                    if (rst) begin
                        x <= 8'd0;
                        y <= 8'd0;
                        sum <= 16'd0;
                    end else begin
                        x <= x_next;
                        y <= y_next;
                        if (clear) sum <= 16'd0;
                        else sum <= sum + ({8'd0, x} * {8'd0, y});
                    end
                end
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : product_of
            for (j = 0; j < 4; j = j + 1) begin : product_col
                assign product[(i * 4 + j) * 16 +: 16] = cells[i].col[j].sum;
            end
        end
    endgenerate
endmodule
`default_nettype wire
