// linear_evaluator_width8_height4
//
// Evaluates a linear expression at every pixel of a region.
//
// Parameters  LinearEvaluator { width: 8, height: 4 }
// Latency     5 clocks from a byte of the coefficients to the expression's byte at each pixel
// Source      Reducing Latency on PixelFlow, section 3 (PFL-NODE)
// Described   rtl/src/pixelflow/linear_evaluator.rs:34
`default_nettype none

module linear_evaluator_width8_height4 (
    input  wire         clk,
    input  wire         rst,
    // A byte of each coefficient, least significant byte first.
    input  wire [7:0]   coefficients_a, // A byte of coefficient A, the increment from each column to the next.
    input  wire [7:0]   coefficients_b, // A byte of coefficient B, the increment from each line to the next.
    input  wire [7:0]   coefficients_c, // A byte of coefficient C, the value at column 0 of line 0.
    input  wire         first,          // The bytes of the coefficients are the first of an expression.
    // The bytes of the coefficients belong to an expression. The bytes of an expression come without a pause.
    input  wire         sends,
    // A byte of the expression at each pixel: a row for each chip, with its upper line before its lower one.
    output wire [255:0] value
);

    reg first1;                                                  // rtl/src/pixelflow/linear_evaluator.rs:81
    reg first2;                                                  // rtl/src/pixelflow/linear_evaluator.rs:81
    reg first3;                                                  // rtl/src/pixelflow/linear_evaluator.rs:81
    reg first4;                                                  // rtl/src/pixelflow/linear_evaluator.rs:81
    reg sends1;                                                  // rtl/src/pixelflow/linear_evaluator.rs:82
    reg sends2;                                                  // rtl/src/pixelflow/linear_evaluator.rs:82
    reg sends3;                                                  // rtl/src/pixelflow/linear_evaluator.rs:82
    reg sends4;                                                  // rtl/src/pixelflow/linear_evaluator.rs:82
    reg [7:0] a1;                                                // rtl/src/pixelflow/linear_evaluator.rs:83
    reg [7:0] a2;                                                // rtl/src/pixelflow/linear_evaluator.rs:83
    reg [7:0] a3;                                                // rtl/src/pixelflow/linear_evaluator.rs:83
    reg [7:0] a4;                                                // rtl/src/pixelflow/linear_evaluator.rs:83
    reg [7:0] a5;                                                // rtl/src/pixelflow/linear_evaluator.rs:83
    reg [7:0] b1;                                                // rtl/src/pixelflow/linear_evaluator.rs:84
    reg [7:0] b2;                                                // rtl/src/pixelflow/linear_evaluator.rs:84
    reg [7:0] b3;                                                // rtl/src/pixelflow/linear_evaluator.rs:84
    reg [7:0] b4;                                                // rtl/src/pixelflow/linear_evaluator.rs:84
    reg [7:0] b5;                                                // rtl/src/pixelflow/linear_evaluator.rs:84
    reg [7:0] chip_root1;                                        // rtl/src/pixelflow/linear_evaluator.rs:92
    reg [7:0] chip_root2;                                        // rtl/src/pixelflow/linear_evaluator.rs:92
    reg [7:0] chip_root3;                                        // rtl/src/pixelflow/linear_evaluator.rs:92

    genvar i;
    genvar j;

    generate
        for (i = 0; i < 2; i = i + 1) begin : pixel0_sum_row
            reg [7:0] pixel0_sum;
            reg pixel0_carry;
            localparam [31:0] pixel0_adds_listed = 255 * i;
            wire [7:0] pixel0_adds = pixel0_adds_listed[7:0] & coefficients_b;
            wire [7:0] pixel0_total_extended = {7'd0, pixel0_carry & !first};
            wire [7:0] pixel0_total = coefficients_c + pixel0_adds + pixel0_total_extended;
            wire [7:0] pixel0_carries_and = (coefficients_c | pixel0_adds) & ~pixel0_total;
            wire [7:0] pixel0_carries = (coefficients_c & pixel0_adds) | pixel0_carries_and;

            always @(posedge clk) begin
                if (sends) begin
                    pixel0_sum <= pixel0_total;
                    pixel0_carry <= pixel0_carries[7];
                end
            end
            wire _unused_lane = &{1'b0, pixel0_carries[6:0]};
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : pixel1_sum_row
            reg [7:0] pixel1_sum;
            reg pixel1_carry;
            localparam [31:0] pixel1_adds_listed = 255 * (i % 2);
            wire [7:0] pixel1_adds = pixel1_adds_listed[7:0] & {a1[5:0], first1 ? 2'd0 : a2[7:6]};
            wire [7:0] pixel1_total_extended = {7'd0, pixel1_carry & !first1};
            wire [7:0] pixel1_total = pixel0_sum_row[i / 2].pixel0_sum + pixel1_adds + pixel1_total_extended;
            wire [7:0] pixel1_carries_and = (pixel0_sum_row[i / 2].pixel0_sum | pixel1_adds) & ~pixel1_total;
            wire [7:0] pixel1_carries = (pixel0_sum_row[i / 2].pixel0_sum & pixel1_adds) | pixel1_carries_and;

            always @(posedge clk) begin
                if (sends1) begin
                    pixel1_sum <= pixel1_total;
                    pixel1_carry <= pixel1_carries[7];
                end
            end
            wire _unused_lane = &{1'b0, pixel1_carries[6:0]};
        end
    endgenerate

    generate
        for (i = 0; i < 8; i = i + 1) begin : pixel2_sum_row
            reg [7:0] pixel2_sum;
            reg pixel2_carry;
            localparam [31:0] pixel2_adds_listed = 255 * (i % 2);
            wire [7:0] pixel2_adds = pixel2_adds_listed[7:0] & {a2[6:0], first2 ? 1'b0 : a3[7]};
            wire [7:0] pixel2_total_extended = {7'd0, pixel2_carry & !first2};
            wire [7:0] pixel2_total = pixel1_sum_row[i / 2].pixel1_sum + pixel2_adds + pixel2_total_extended;
            wire [7:0] pixel2_carries_and = (pixel1_sum_row[i / 2].pixel1_sum | pixel2_adds) & ~pixel2_total;
            wire [7:0] pixel2_carries = (pixel1_sum_row[i / 2].pixel1_sum & pixel2_adds) | pixel2_carries_and;

            always @(posedge clk) begin
                if (sends2) begin
                    pixel2_sum <= pixel2_total;
                    pixel2_carry <= pixel2_carries[7];
                end
            end
            wire _unused_lane = &{1'b0, pixel2_carries[6:0]};
        end
    endgenerate

    generate
        for (i = 0; i < 16; i = i + 1) begin : pixel3_sum_row
            reg [7:0] pixel3_sum;
            reg pixel3_carry;
            localparam [31:0] pixel3_adds_listed = 255 * (i % 2);
            wire [7:0] pixel3_adds = pixel3_adds_listed[7:0] & a3;
            wire [7:0] pixel3_total_extended = {7'd0, pixel3_carry & !first3};
            wire [7:0] pixel3_total = pixel2_sum_row[i / 2].pixel2_sum + pixel3_adds + pixel3_total_extended;
            wire [7:0] pixel3_carries_and = (pixel2_sum_row[i / 2].pixel2_sum | pixel3_adds) & ~pixel3_total;
            wire [7:0] pixel3_carries = (pixel2_sum_row[i / 2].pixel2_sum & pixel3_adds) | pixel3_carries_and;

            always @(posedge clk) begin
                if (sends3) begin
                    pixel3_sum <= pixel3_total;
                    pixel3_carry <= pixel3_carries[7];
                end
            end
            wire _unused_lane = &{1'b0, pixel3_carries[6:0]};
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : chip0_sum_row
            reg [7:0] chip0_sum;
            reg chip0_carry;
            localparam [31:0] chip0_adds_listed = 255 * i;
            wire [7:0] chip0_adds = chip0_adds_listed[7:0] & {b3[6:0], first3 ? 1'b0 : b4[7]};
            wire [7:0] chip0_total_extended = {7'd0, chip0_carry & !first3};
            wire [7:0] chip0_total = chip_root3 + chip0_adds + chip0_total_extended;
            wire [7:0] chip0_carries_and = (chip_root3 | chip0_adds) & ~chip0_total;
            wire [7:0] chip0_carries = (chip_root3 & chip0_adds) | chip0_carries_and;

            always @(posedge clk) begin
                if (sends3) begin
                    chip0_sum <= chip0_total;
                    chip0_carry <= chip0_carries[7];
                end
            end
            wire _unused_lane = &{1'b0, chip0_carries[6:0]};
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : cells
            for (j = 0; j < 16; j = j + 1) begin : col
                reg [7:0] value_sum;
                reg value_carry;
                wire [7:0] value_total_extended = {7'd0, value_carry & !first4};
                wire [7:0] value_total = pixel3_sum_row[j].pixel3_sum + chip0_sum_row[i].chip0_sum + value_total_extended;
                wire [7:0] value_carries_and = (pixel3_sum_row[j].pixel3_sum | chip0_sum_row[i].chip0_sum) & ~value_total;
                wire [7:0] value_carries = (pixel3_sum_row[j].pixel3_sum & chip0_sum_row[i].chip0_sum) | value_carries_and;

                always @(posedge clk) begin
                    if (sends4) begin
                        value_sum <= value_total;
                        value_carry <= value_carries[7];
                    end
                end
                wire _unused_lane = &{1'b0, value_carries[6:0]};
            end
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : value_of
            for (j = 0; j < 16; j = j + 1) begin : value_col
                assign value[(i * 16 + j) * 8 +: 8] = cells[i].col[j].value_sum;
            end
        end
    endgenerate

    always @(posedge clk) begin
        a1 <= coefficients_a;
        a2 <= a1;
        a3 <= a2;
        a4 <= a3;
        a5 <= a4;
        b1 <= coefficients_b;
        b2 <= b1;
        b3 <= b2;
        b4 <= b3;
        b5 <= b4;
        chip_root1 <= 8'd0;
        chip_root2 <= chip_root1;
        chip_root3 <= chip_root2;
    end

    always @(posedge clk) begin
        if (rst) begin
            first1 <= 1'b0;
            first2 <= 1'b0;
            first3 <= 1'b0;
            first4 <= 1'b0;
            sends1 <= 1'b0;
            sends2 <= 1'b0;
            sends3 <= 1'b0;
            sends4 <= 1'b0;
        end else begin
            first1 <= first;
            first2 <= first1;
            first3 <= first2;
            first4 <= first3;
            sends1 <= sends;
            sends2 <= sends1;
            sends3 <= sends2;
            sends4 <= sends3;
        end
    end

    wire _unused_ok = &{1'b0, a5, b5};
endmodule
`default_nettype wire
