// linear_evaluator_width8_height4
//
// Evaluates a linear expression at every pixel of a region.
//
// Parameters  LinearEvaluator { width: 8, height: 4 }
// Latency     4 clocks from a coefficient's byte to the expression's at each pixel
// Source      Reducing Latency on PixelFlow, section 3 (PFL-NODE)
// Described   rtl/src/pixelflow/linear_evaluator.rs:90
`default_nettype none

module linear_evaluator_width8_height4 (
    input  wire         clk,
    input  wire         rst,
    // A byte of each coefficient, beginning with the least significant.
    input  wire [7:0]   coefficients_a, // Of what is added from a column to the next.
    input  wire [7:0]   coefficients_b, // Of what is added from a line to the next.
    input  wire [7:0]   coefficients_c, // Of the value at column 0 of line 0.
    input  wire         first,          // These are the first bytes of an expression.
    output wire [255:0] value           // A byte of the expression at each pixel, a row for each line.
);

    reg first1;                                                  // rtl/src/pixelflow/linear_evaluator.rs:90
    reg first2;                                                  // rtl/src/pixelflow/linear_evaluator.rs:90
    reg first3;                                                  // rtl/src/pixelflow/linear_evaluator.rs:90
    reg [7:0] x1;                                                // rtl/src/pixelflow/linear_evaluator.rs:90
    reg [7:0] x2;                                                // rtl/src/pixelflow/linear_evaluator.rs:90
    reg [7:0] x3;                                                // rtl/src/pixelflow/linear_evaluator.rs:90
    reg [1:0] x0_before;                                         // rtl/src/pixelflow/linear_evaluator.rs:136
    reg x1_before;                                               // rtl/src/pixelflow/linear_evaluator.rs:136
    reg [7:0] y1;                                                // rtl/src/pixelflow/linear_evaluator.rs:90
    reg [7:0] y2;                                                // rtl/src/pixelflow/linear_evaluator.rs:90
    reg [7:0] y3;                                                // rtl/src/pixelflow/linear_evaluator.rs:90
    reg [7:0] y_root1;                                           // rtl/src/pixelflow/linear_evaluator.rs:90
    reg y0_before;                                               // rtl/src/pixelflow/linear_evaluator.rs:136

    genvar i;
    genvar j;

    generate
        for (i = 0; i < 2; i = i + 1) begin : x0_carry_row
            reg x0_carry;
            reg [7:0] x0_sum;
            localparam [31:0] x0_carry_listed = 255 * i;
            wire [7:0] x0_carry_and = x0_carry_listed[7:0] & {coefficients_a[5:0], first ? 2'd0 : x0_before};
            wire [7:0] x0_carry_sum_2 = coefficients_c + x0_carry_and;
            wire [7:0] x0_carry_sum = x0_carry_sum_2 + {7'd0, x0_carry & !first};
            wire [7:0] x0_carry_and_2 = (coefficients_c | x0_carry_and) & ~x0_carry_sum;
            wire [7:0] x0_carry_or = (coefficients_c & x0_carry_and) | x0_carry_and_2;

            always @(posedge clk) begin
                x0_carry <= x0_carry_or[7];
                x0_sum <= x0_carry_sum;
            end
            wire _unused_lane = &{1'b0, x0_carry_or[6:0]};
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : x1_carry_row
            reg x1_carry;
            reg [7:0] x1_sum;
            localparam [31:0] x1_carry_listed = 255 * (i % 2);
            wire [7:0] x1_carry_and = x1_carry_listed[7:0] & {x1[6:0], first1 ? 1'b0 : x1_before};
            wire [7:0] x1_carry_extended = {7'd0, x1_carry & !first1};
            wire [7:0] x1_carry_sum = x0_carry_row[i / 2].x0_sum + x1_carry_and + x1_carry_extended;
            wire [7:0] x1_carry_and_2 = (x0_carry_row[i / 2].x0_sum | x1_carry_and) & ~x1_carry_sum;
            wire [7:0] x1_carry_or = (x0_carry_row[i / 2].x0_sum & x1_carry_and) | x1_carry_and_2;

            always @(posedge clk) begin
                x1_carry <= x1_carry_or[7];
                x1_sum <= x1_carry_sum;
            end
            wire _unused_lane = &{1'b0, x1_carry_or[6:0]};
        end
    endgenerate

    generate
        for (i = 0; i < 8; i = i + 1) begin : x2_carry_row
            reg x2_carry;
            reg [7:0] x2_sum;
            localparam [31:0] x2_carry_listed = 255 * (i % 2);
            wire [7:0] x2_carry_and = x2_carry_listed[7:0] & x2;
            wire [7:0] x2_carry_extended = {7'd0, x2_carry & !first2};
            wire [7:0] x2_carry_sum = x1_carry_row[i / 2].x1_sum + x2_carry_and + x2_carry_extended;
            wire [7:0] x2_carry_and_2 = (x1_carry_row[i / 2].x1_sum | x2_carry_and) & ~x2_carry_sum;
            wire [7:0] x2_carry_or = (x1_carry_row[i / 2].x1_sum & x2_carry_and) | x2_carry_and_2;

            always @(posedge clk) begin
                x2_carry <= x2_carry_or[7];
                x2_sum <= x2_carry_sum;
            end
            wire _unused_lane = &{1'b0, x2_carry_or[6:0]};
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : y0_carry_row
            reg y0_carry;
            reg [7:0] y0_sum;
            localparam [31:0] y0_carry_listed = 255 * i;
            wire [7:0] y0_carry_and = y0_carry_listed[7:0] & {y1[6:0], first1 ? 1'b0 : y0_before};
            wire [7:0] y0_carry_extended = {7'd0, y0_carry & !first1};
            wire [7:0] y0_carry_sum = y_root1 + y0_carry_and + y0_carry_extended;
            wire [7:0] y0_carry_and_2 = (y_root1 | y0_carry_and) & ~y0_carry_sum;
            wire [7:0] y0_carry_or = (y_root1 & y0_carry_and) | y0_carry_and_2;

            always @(posedge clk) begin
                y0_carry <= y0_carry_or[7];
                y0_sum <= y0_carry_sum;
            end
            wire _unused_lane = &{1'b0, y0_carry_or[6:0]};
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : y1_carry_row
            reg y1_carry;
            reg [7:0] y1_sum;
            localparam [31:0] y1_carry_listed = 255 * (i % 2);
            wire [7:0] y1_carry_and = y1_carry_listed[7:0] & y2;
            wire [7:0] y1_carry_extended = {7'd0, y1_carry & !first2};
            wire [7:0] y1_carry_sum = y0_carry_row[i / 2].y0_sum + y1_carry_and + y1_carry_extended;
            wire [7:0] y1_carry_and_2 = (y0_carry_row[i / 2].y0_sum | y1_carry_and) & ~y1_carry_sum;
            wire [7:0] y1_carry_or = (y0_carry_row[i / 2].y0_sum & y1_carry_and) | y1_carry_and_2;

            always @(posedge clk) begin
                y1_carry <= y1_carry_or[7];
                y1_sum <= y1_carry_sum;
            end
            wire _unused_lane = &{1'b0, y1_carry_or[6:0]};
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : cells
            for (j = 0; j < 8; j = j + 1) begin : col
                reg value_carry;
                reg [7:0] value_sum;
                wire [7:0] value_carry_extended = {7'd0, value_carry & !first3};
                wire [7:0] value_carry_sum = x2_carry_row[j].x2_sum + y1_carry_row[i].y1_sum + value_carry_extended;
                wire [7:0] value_carry_and = (x2_carry_row[j].x2_sum | y1_carry_row[i].y1_sum) & ~value_carry_sum;
                wire [7:0] value_carry_or = (x2_carry_row[j].x2_sum & y1_carry_row[i].y1_sum) | value_carry_and;

                always @(posedge clk) begin
                    value_carry <= value_carry_or[7];
                    value_sum <= value_carry_sum;
                end
                wire _unused_lane = &{1'b0, value_carry_or[6:0]};
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : value_of
            for (j = 0; j < 8; j = j + 1) begin : value_col
                assign value[(i * 8 + j) * 8 +: 8] = cells[i].col[j].value_sum;
            end
        end
    endgenerate

    always @(posedge clk) begin
        x1 <= coefficients_a;
        x2 <= x1;
        x3 <= x2;
        x0_before <= coefficients_a[7:6];
        x1_before <= x1[7];
        y1 <= coefficients_b;
        y2 <= y1;
        y3 <= y2;
        y_root1 <= 8'd0;
        y0_before <= y1[7];
    end

    always @(posedge clk) begin
        if (rst) begin
            first1 <= 1'b0;
            first2 <= 1'b0;
            first3 <= 1'b0;
        end else begin
            first1 <= first;
            first2 <= first1;
            first3 <= first2;
        end
    end

    wire _unused_ok = &{1'b0, x3, y3};
endmodule
`default_nettype wire
