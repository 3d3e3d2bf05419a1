// quadratic_tree_side4
//
// Evaluates a quadratic expression at every pixel of a square.
//
// Parameters  QuadraticTree { side: 4 }
// Latency     8 clocks from a coefficient's bit to the expression's bit at each pixel
// Source      Pixel-planes 5, section I.3.2.1 (PP5-ARCH)
// Described   rtl/src/pixel_planes/quadratic_tree.rs:43
`default_nettype none

module quadratic_tree_side4 (
    input  wire        clk,
    input  wire        rst,
    // A bit of each linear coefficient, beginning with the least significant.
    input  wire        coefficients_a, // Coefficient A, the increase from one column to the next.
    input  wire        coefficients_b, // Coefficient B, the increase from one line to the next.
    input  wire        coefficients_c, // Coefficient C, the value at column 0 of line 0.
    // A bit of each quadratic coefficient; all are 0 for a linear expression.
    input  wire        curve_d,        // Coefficient D, of the square of x.
    input  wire        curve_e,        // Coefficient E, of x times y.
    input  wire        curve_f,        // Coefficient F, of the square of y.
    // The coefficients' bits are the first of an expression, which has at least log2 `side` bits.
    input  wire        first,
    output wire [15:0] value           // A bit of the expression at each pixel, a row for each line.
);

    reg first1;                                                  // rtl/src/pixel_planes/quadratic_tree.rs:88
    reg first2;                                                  // rtl/src/pixel_planes/quadratic_tree.rs:88
    reg first3;                                                  // rtl/src/pixel_planes/quadratic_tree.rs:88
    reg first4;                                                  // rtl/src/pixel_planes/quadratic_tree.rs:88
    reg first5;                                                  // rtl/src/pixel_planes/quadratic_tree.rs:88
    reg first6;                                                  // rtl/src/pixel_planes/quadratic_tree.rs:88
    reg first7;                                                  // rtl/src/pixel_planes/quadratic_tree.rs:88
    reg d1;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg d2;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg f1;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg f2;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg f3;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg f4;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg f5;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg f6;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg a1;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg x_curve_has_come0;                                       // rtl/src/pixel_planes/quadratic_tree.rs:156
    reg x_middle_has_come0;                                      // rtl/src/pixel_planes/quadratic_tree.rs:156
    reg x_bent0;                                                 // rtl/src/pixel_planes/quadratic_tree.rs:168
    reg b1;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg b2;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg b3;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg e1;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg e2;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg e3;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg e4;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg e_has_come0;                                             // rtl/src/pixel_planes/quadratic_tree.rs:106
    reg y_curve_has_come0;                                       // rtl/src/pixel_planes/quadratic_tree.rs:156
    reg y_middle_has_come0;                                      // rtl/src/pixel_planes/quadratic_tree.rs:156
    reg y_bent0;                                                 // rtl/src/pixel_planes/quadratic_tree.rs:168

    wire x_middle_carry0_and = d2 & (first2 | (x_curve_has_come0 & !first1)); // rtl/src/pixel_planes/quadratic_tree.rs:156
    wire y_middle_carry0_and = f6 & (first6 | (y_curve_has_come0 & !first5)); // rtl/src/pixel_planes/quadratic_tree.rs:156

    genvar i;
    genvar j;

    generate
        for (i = 0; i < 1; i = i + 1) begin : x_middle_carry0_row
            reg x_middle_carry0;
            reg x_middle0;
            wire x_middle_carry0_in = x_middle_carry0 & !first1;
            wire x_middle_carry0_and_2 = x_middle_carry0_in & (a1 | x_middle_carry0_and);
            wire x_adds0_and = x_middle0 & (first2 | (x_middle_has_come0 & !first1));

            always @(posedge clk) begin
                x_middle_carry0 <= (a1 & x_middle_carry0_and) | x_middle_carry0_and_2;
                x_middle0 <= a1 ^ x_middle_carry0_and ^ x_middle_carry0_in;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : x_downward_carry0_row
            reg x_downward_carry0;
            reg x_downward0;
            localparam [31:0] x_downward_adds0_listed = i;
            wire x_downward_adds0 = x_downward_adds0_listed[0] & (e4 & (first4 | (e_has_come0 & !first3)));
            wire x_downward_carry0_in = x_downward_carry0 & !first3;
            wire x_downward_carry0_and = x_downward_carry0_in & (b3 | x_downward_adds0);

            always @(posedge clk) begin
                x_downward_carry0 <= (b3 & x_downward_adds0) | x_downward_carry0_and;
                x_downward0 <= b3 ^ x_downward_adds0 ^ x_downward_carry0_in;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : x_downward_carry1_row
            reg x_downward_carry1;
            reg x_downward1;
            localparam [31:0] x_downward_adds1_listed = i % 2;
            wire x_downward_adds1 = x_downward_adds1_listed[0] & e4;
            wire x_downward_carry1_in = x_downward_carry1 & !first4;
            wire x_downward_carry1_and = x_downward_carry1_in & (x_downward_carry0_row[i / 2].x_downward0 | x_downward_adds1);

            always @(posedge clk) begin
                x_downward_carry1 <= (x_downward_carry0_row[i / 2].x_downward0 & x_downward_adds1) | x_downward_carry1_and;
                x_downward1 <= x_downward_carry0_row[i / 2].x_downward0 ^ x_downward_adds1 ^ x_downward_carry1_in;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 1; i = i + 1) begin : y_middle_carry0_cells
            for (j = 0; j < 4; j = j + 1) begin : col
                reg y_middle_carry0;
                reg y_middle0;
                wire y_middle_carry0_in = y_middle_carry0 & !first5;
                wire y_middle_carry0_and_2 = y_middle_carry0_in & (x_downward_carry1_row[j].x_downward1 | y_middle_carry0_and);
                wire y_adds0_and = y_middle0 & (first6 | (y_middle_has_come0 & !first5));

                always @(posedge clk) begin
                    y_middle_carry0 <= (x_downward_carry1_row[j].x_downward1 & y_middle_carry0_and) | y_middle_carry0_and_2;
                    y_middle0 <= x_downward_carry1_row[j].x_downward1 ^ y_middle_carry0_and ^ y_middle_carry0_in;
                end
            end
        end
    endgenerate

    generate
        for (i = 0; i < 1; i = i + 1) begin : x_waiting0_row
            reg x_waiting0;

            always @(posedge clk) begin
                x_waiting0 <= coefficients_c;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : x_carry0_row
            reg x_carry0;
            reg x_sum0;
            reg x_growth_carry0;
            reg x_growth0;
            reg x_middle_carry1;
            reg x_middle1;
            reg x_waiting1;
            localparam [31:0] x_adds0_listed = i;
            wire x_adds0 = x_adds0_listed[0] & x_middle_carry0_row[i / 2].x_adds0_and;
            wire x_carry0_in = x_carry0 & !first1;
            wire x_carry0_and = x_carry0_in & (x_waiting0_row[i / 2].x_waiting0 | x_adds0);
            wire x_bends0 = x_adds0_listed[0] & (x_bent0 & !first1);
            wire x_growth_carry0_in = x_growth_carry0 & !first1;
            wire x_middle_carry1_in = x_middle_carry1 & !first2;

            always @(posedge clk) begin
                x_carry0 <= (x_waiting0_row[i / 2].x_waiting0 & x_adds0) | x_carry0_and;
                x_sum0 <= x_waiting0_row[i / 2].x_waiting0 ^ x_adds0 ^ x_carry0_in;
                x_growth_carry0 <= (a1 & x_bends0) | (x_growth_carry0_in & (a1 | x_bends0));
                x_growth0 <= a1 ^ x_bends0 ^ x_growth_carry0_in;
                x_middle_carry1 <= (x_growth0 & d2) | (x_middle_carry1_in & (x_growth0 | d2));
                x_middle1 <= x_growth0 ^ d2 ^ x_middle_carry1_in;
                x_waiting1 <= x_sum0;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : x_carry1_row
            reg x_carry1;
            reg x_sum1;
            localparam [31:0] x_adds1_listed = i % 2;
            wire x_adds1 = x_adds1_listed[0] & x_carry0_row[i / 2].x_middle1;
            wire x_carry1_in = x_carry1 & !first3;
            wire x_carry1_and = x_carry1_in & (x_carry0_row[i / 2].x_waiting1 | x_adds1);

            always @(posedge clk) begin
                x_carry1 <= (x_carry0_row[i / 2].x_waiting1 & x_adds1) | x_carry1_and;
                x_sum1 <= x_carry0_row[i / 2].x_waiting1 ^ x_adds1 ^ x_carry1_in;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 1; i = i + 1) begin : y_waiting0_cells
            for (j = 0; j < 4; j = j + 1) begin : col
                reg y_waiting0;

                always @(posedge clk) begin
                    y_waiting0 <= x_carry1_row[j].x_sum1;
                end
            end
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : y_carry0_cells
            for (j = 0; j < 4; j = j + 1) begin : col
                reg y_carry0;
                reg y_sum0;
                reg y_growth_carry0;
                reg y_growth0;
                reg y_middle_carry1;
                reg y_middle1;
                reg y_waiting1;
                localparam [31:0] y_adds0_lane = i;
                wire y_adds0 = y_adds0_lane[0] & y_middle_carry0_cells[i / 2].col[j].y_adds0_and;
                wire y_carry0_in = y_carry0 & !first5;
                wire y_carry0_and = y_carry0_in & (y_waiting0_cells[i / 2].col[j].y_waiting0 | y_adds0);
                wire y_bends0 = y_adds0_lane[0] & (y_bent0 & !first5);
                wire y_growth_carry0_in = y_growth_carry0 & !first5;
                wire y_growth_carry0_and = y_growth_carry0_in & (x_downward_carry1_row[j].x_downward1 | y_bends0);
                wire y_middle_carry1_in = y_middle_carry1 & !first6;
                wire y_middle_carry1_and = y_middle_carry1_in & (y_growth0 | f6);

                always @(posedge clk) begin
                    y_carry0 <= (y_waiting0_cells[i / 2].col[j].y_waiting0 & y_adds0) | y_carry0_and;
                    y_sum0 <= y_waiting0_cells[i / 2].col[j].y_waiting0 ^ y_adds0 ^ y_carry0_in;
                    y_growth_carry0 <= (x_downward_carry1_row[j].x_downward1 & y_bends0) | y_growth_carry0_and;
                    y_growth0 <= x_downward_carry1_row[j].x_downward1 ^ y_bends0 ^ y_growth_carry0_in;
                    y_middle_carry1 <= (y_growth0 & f6) | y_middle_carry1_and;
                    y_middle1 <= y_growth0 ^ f6 ^ y_middle_carry1_in;
                    y_waiting1 <= y_sum0;
                end
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : y_carry1_cells
            for (j = 0; j < 4; j = j + 1) begin : col
                reg y_carry1;
                reg y_sum1;
                localparam [31:0] y_adds1_lane = i % 2;
                wire y_adds1 = y_adds1_lane[0] & y_carry0_cells[i / 2].col[j].y_middle1;
                wire y_carry1_in = y_carry1 & !first7;
                wire y_carry1_and = y_carry1_in & (y_carry0_cells[i / 2].col[j].y_waiting1 | y_adds1);

                always @(posedge clk) begin
                    y_carry1 <= (y_carry0_cells[i / 2].col[j].y_waiting1 & y_adds1) | y_carry1_and;
                    y_sum1 <= y_carry0_cells[i / 2].col[j].y_waiting1 ^ y_adds1 ^ y_carry1_in;
                end
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : value_of
            for (j = 0; j < 4; j = j + 1) begin : value_col
                assign value[i * 4 + j] = y_carry1_cells[i].col[j].y_sum1;
            end
        end
    endgenerate

    always @(posedge clk) begin
        d1 <= curve_d;
        d2 <= d1;
        f1 <= curve_f;
        f2 <= f1;
        f3 <= f2;
        f4 <= f3;
        f5 <= f4;
        f6 <= f5;
        a1 <= coefficients_a;
        x_bent0 <= x_middle_carry0_and;
        b1 <= coefficients_b;
        b2 <= b1;
        b3 <= b2;
        e1 <= curve_e;
        e2 <= e1;
        e3 <= e2;
        e4 <= e3;
        y_bent0 <= y_middle_carry0_and;
    end

    always @(posedge clk) begin
        if (rst) begin
            first1 <= 1'b0;
            first2 <= 1'b0;
            first3 <= 1'b0;
            first4 <= 1'b0;
            first5 <= 1'b0;
            first6 <= 1'b0;
            first7 <= 1'b0;
            x_curve_has_come0 <= 1'b0;
            x_middle_has_come0 <= 1'b0;
            e_has_come0 <= 1'b0;
            y_curve_has_come0 <= 1'b0;
            y_middle_has_come0 <= 1'b0;
        end else begin
            first1 <= first;
            first2 <= first1;
            first3 <= first2;
            first4 <= first3;
            first5 <= first4;
            first6 <= first5;
            first7 <= first6;
            if (first1) begin
                x_curve_has_come0 <= 1'b0;
                x_middle_has_come0 <= 1'b0;
            end else if (first2) begin
                x_curve_has_come0 <= 1'b1;
                x_middle_has_come0 <= 1'b1;
            end
            if (first3) e_has_come0 <= 1'b0;
            else if (first4) e_has_come0 <= 1'b1;
            if (first5) begin
                y_curve_has_come0 <= 1'b0;
                y_middle_has_come0 <= 1'b0;
            end else if (first6) begin
                y_curve_has_come0 <= 1'b1;
                y_middle_has_come0 <= 1'b1;
            end
        end
    end
endmodule
`default_nettype wire
