// quadratic_tree_side8
//
// Evaluates a quadratic expression at every pixel of a square.
//
// Parameters  QuadraticTree { side: 8 }
// Latency     12 clocks from a coefficient's bit to the expression's bit at each pixel
// Source      Pixel-planes 5, section I.3.2.1 (PP5-ARCH)
// Described   rtl/src/pixel_planes/quadratic_tree.rs:43
`default_nettype none

module quadratic_tree_side8 (
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
    output wire [63:0] value           // A bit of the expression at each pixel, a row for each line.
);

    reg first1;                                                  // rtl/src/pixel_planes/quadratic_tree.rs:88
    reg first2;                                                  // rtl/src/pixel_planes/quadratic_tree.rs:88
    reg first3;                                                  // rtl/src/pixel_planes/quadratic_tree.rs:88
    reg first4;                                                  // rtl/src/pixel_planes/quadratic_tree.rs:88
    reg first5;                                                  // rtl/src/pixel_planes/quadratic_tree.rs:88
    reg first6;                                                  // rtl/src/pixel_planes/quadratic_tree.rs:88
    reg first7;                                                  // rtl/src/pixel_planes/quadratic_tree.rs:88
    reg first8;                                                  // rtl/src/pixel_planes/quadratic_tree.rs:88
    reg first9;                                                  // rtl/src/pixel_planes/quadratic_tree.rs:88
    reg first10;                                                 // rtl/src/pixel_planes/quadratic_tree.rs:88
    reg first11;                                                 // rtl/src/pixel_planes/quadratic_tree.rs:88
    reg d1;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg d2;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg d3;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg d4;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg f1;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg f2;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg f3;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg f4;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg f5;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg f6;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg f7;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg f8;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg f9;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg f10;                                                     // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg a1;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg a2;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg x_curve_has_come0;                                       // rtl/src/pixel_planes/quadratic_tree.rs:156
    reg x_middle_has_come0;                                      // rtl/src/pixel_planes/quadratic_tree.rs:156
    reg x_bent0;                                                 // rtl/src/pixel_planes/quadratic_tree.rs:168
    reg x_curve_has_come1;                                       // rtl/src/pixel_planes/quadratic_tree.rs:156
    reg x_middle_has_come1;                                      // rtl/src/pixel_planes/quadratic_tree.rs:156
    reg x_bent1;                                                 // rtl/src/pixel_planes/quadratic_tree.rs:168
    reg b1;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg b2;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg b3;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg b4;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg b5;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg e1;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg e2;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg e3;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg e4;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg e5;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg e6;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg e7;                                                      // rtl/src/pixel_planes/quadratic_tree.rs:89
    reg e_has_come0;                                             // rtl/src/pixel_planes/quadratic_tree.rs:106
    reg e_has_come1;                                             // rtl/src/pixel_planes/quadratic_tree.rs:106
    reg y_curve_has_come0;                                       // rtl/src/pixel_planes/quadratic_tree.rs:156
    reg y_middle_has_come0;                                      // rtl/src/pixel_planes/quadratic_tree.rs:156
    reg y_bent0;                                                 // rtl/src/pixel_planes/quadratic_tree.rs:168
    reg y_curve_has_come1;                                       // rtl/src/pixel_planes/quadratic_tree.rs:156
    reg y_middle_has_come1;                                      // rtl/src/pixel_planes/quadratic_tree.rs:156
    reg y_bent1;                                                 // rtl/src/pixel_planes/quadratic_tree.rs:168

    wire x_middle_carry0_and = d4 & (first4 | (x_curve_has_come0 & !first2)); // rtl/src/pixel_planes/quadratic_tree.rs:156
    wire x_middle_carry1_and = d4 & (first4 | (x_curve_has_come1 & !first3)); // rtl/src/pixel_planes/quadratic_tree.rs:156
    wire y_middle_carry0_and = f10 & (first10 | (y_curve_has_come0 & !first8)); // rtl/src/pixel_planes/quadratic_tree.rs:156
    wire y_middle_carry1_and = f10 & (first10 | (y_curve_has_come1 & !first9)); // rtl/src/pixel_planes/quadratic_tree.rs:156

    genvar i;
    genvar j;

    generate
        for (i = 0; i < 1; i = i + 1) begin : x_middle_carry0_row
            reg x_middle_carry0;
            reg x_middle0;
            wire x_middle_carry0_in = x_middle_carry0 & !first2;
            wire x_middle_carry0_and_2 = x_middle_carry0_in & (a2 | x_middle_carry0_and);
            wire x_adds0_and = x_middle0 & (first3 | (x_middle_has_come0 & !first1));

            always @(posedge clk) begin
                x_middle_carry0 <= (a2 & x_middle_carry0_and) | x_middle_carry0_and_2;
                x_middle0 <= a2 ^ x_middle_carry0_and ^ x_middle_carry0_in;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : x_downward_carry0_row
            reg x_downward_carry0;
            reg x_downward0;
            localparam [31:0] x_downward_adds0_listed = i;
            wire x_downward_adds0 = x_downward_adds0_listed[0] & (e7 & (first7 | (e_has_come0 & !first5)));
            wire x_downward_carry0_in = x_downward_carry0 & !first5;
            wire x_downward_carry0_and = x_downward_carry0_in & (b5 | x_downward_adds0);

            always @(posedge clk) begin
                x_downward_carry0 <= (b5 & x_downward_adds0) | x_downward_carry0_and;
                x_downward0 <= b5 ^ x_downward_adds0 ^ x_downward_carry0_in;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : x_downward_carry1_row
            reg x_downward_carry1;
            reg x_downward1;
            localparam [31:0] x_downward_adds1_listed = i % 2;
            wire x_downward_adds1 = x_downward_adds1_listed[0] & (e7 & (first7 | (e_has_come1 & !first6)));
            wire x_downward_carry1_in = x_downward_carry1 & !first6;
            wire x_downward_carry1_and = x_downward_carry1_in & (x_downward_carry0_row[i / 2].x_downward0 | x_downward_adds1);

            always @(posedge clk) begin
                x_downward_carry1 <= (x_downward_carry0_row[i / 2].x_downward0 & x_downward_adds1) | x_downward_carry1_and;
                x_downward1 <= x_downward_carry0_row[i / 2].x_downward0 ^ x_downward_adds1 ^ x_downward_carry1_in;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 8; i = i + 1) begin : x_downward_carry2_row
            reg x_downward_carry2;
            reg x_downward2;
            localparam [31:0] x_downward_adds2_listed = i % 2;
            wire x_downward_adds2 = x_downward_adds2_listed[0] & e7;
            wire x_downward_carry2_in = x_downward_carry2 & !first7;
            wire x_downward_carry2_and = x_downward_carry2_in & (x_downward_carry1_row[i / 2].x_downward1 | x_downward_adds2);

            always @(posedge clk) begin
                x_downward_carry2 <= (x_downward_carry1_row[i / 2].x_downward1 & x_downward_adds2) | x_downward_carry2_and;
                x_downward2 <= x_downward_carry1_row[i / 2].x_downward1 ^ x_downward_adds2 ^ x_downward_carry2_in;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 1; i = i + 1) begin : y_middle_carry0_cells
            for (j = 0; j < 8; j = j + 1) begin : col
                reg y_middle_carry0;
                reg y_middle0;
                wire y_middle_carry0_in = y_middle_carry0 & !first8;
                wire y_middle_carry0_and_2 = y_middle_carry0_in & (x_downward_carry2_row[j].x_downward2 | y_middle_carry0_and);
                wire y_adds0_and = y_middle0 & (first9 | (y_middle_has_come0 & !first7));

                always @(posedge clk) begin
                    y_middle_carry0 <= (x_downward_carry2_row[j].x_downward2 & y_middle_carry0_and) | y_middle_carry0_and_2;
                    y_middle0 <= x_downward_carry2_row[j].x_downward2 ^ y_middle_carry0_and ^ y_middle_carry0_in;
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
            wire x_bends0 = x_adds0_listed[0] & (x_bent0 & !first2);
            wire x_growth_carry0_in = x_growth_carry0 & !first2;
            wire x_middle_carry1_in = x_middle_carry1 & !first3;
            wire x_middle_carry1_and_2 = x_middle_carry1_in & (x_growth0 | x_middle_carry1_and);
            wire x_adds1_and = x_middle1 & (first4 | (x_middle_has_come1 & !first3));

            always @(posedge clk) begin
                x_carry0 <= (x_waiting0_row[i / 2].x_waiting0 & x_adds0) | x_carry0_and;
                x_sum0 <= x_waiting0_row[i / 2].x_waiting0 ^ x_adds0 ^ x_carry0_in;
                x_growth_carry0 <= (a2 & x_bends0) | (x_growth_carry0_in & (a2 | x_bends0));
                x_growth0 <= a2 ^ x_bends0 ^ x_growth_carry0_in;
                x_middle_carry1 <= (x_growth0 & x_middle_carry1_and) | x_middle_carry1_and_2;
                x_middle1 <= x_growth0 ^ x_middle_carry1_and ^ x_middle_carry1_in;
                x_waiting1 <= x_sum0;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : x_carry1_row
            reg x_carry1;
            reg x_sum1;
            reg x_growth_carry1;
            reg x_growth1;
            reg x_middle_carry2;
            reg x_middle2;
            reg x_waiting2;
            localparam [31:0] x_adds1_listed = i % 2;
            wire x_adds1 = x_adds1_listed[0] & x_carry0_row[i / 2].x_adds1_and;
            wire x_carry1_in = x_carry1 & !first3;
            wire x_carry1_and = x_carry1_in & (x_carry0_row[i / 2].x_waiting1 | x_adds1);
            wire x_bends1 = x_adds1_listed[0] & (x_bent1 & !first3);
            wire x_growth_carry1_in = x_growth_carry1 & !first3;
            wire x_growth_carry1_and = x_growth_carry1_in & (x_carry0_row[i / 2].x_growth0 | x_bends1);
            wire x_middle_carry2_in = x_middle_carry2 & !first4;

            always @(posedge clk) begin
                x_carry1 <= (x_carry0_row[i / 2].x_waiting1 & x_adds1) | x_carry1_and;
                x_sum1 <= x_carry0_row[i / 2].x_waiting1 ^ x_adds1 ^ x_carry1_in;
                x_growth_carry1 <= (x_carry0_row[i / 2].x_growth0 & x_bends1) | x_growth_carry1_and;
                x_growth1 <= x_carry0_row[i / 2].x_growth0 ^ x_bends1 ^ x_growth_carry1_in;
                x_middle_carry2 <= (x_growth1 & d4) | (x_middle_carry2_in & (x_growth1 | d4));
                x_middle2 <= x_growth1 ^ d4 ^ x_middle_carry2_in;
                x_waiting2 <= x_sum1;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 8; i = i + 1) begin : x_carry2_row
            reg x_carry2;
            reg x_sum2;
            localparam [31:0] x_adds2_listed = i % 2;
            wire x_adds2 = x_adds2_listed[0] & x_carry1_row[i / 2].x_middle2;
            wire x_carry2_in = x_carry2 & !first5;
            wire x_carry2_and = x_carry2_in & (x_carry1_row[i / 2].x_waiting2 | x_adds2);

            always @(posedge clk) begin
                x_carry2 <= (x_carry1_row[i / 2].x_waiting2 & x_adds2) | x_carry2_and;
                x_sum2 <= x_carry1_row[i / 2].x_waiting2 ^ x_adds2 ^ x_carry2_in;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 1; i = i + 1) begin : y_waiting0_cells
            for (j = 0; j < 8; j = j + 1) begin : col
                reg y_waiting0;

                always @(posedge clk) begin
                    y_waiting0 <= x_carry2_row[j].x_sum2;
                end
            end
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : y_carry0_cells
            for (j = 0; j < 8; j = j + 1) begin : col
                reg y_carry0;
                reg y_sum0;
                reg y_growth_carry0;
                reg y_growth0;
                reg y_middle_carry1;
                reg y_middle1;
                reg y_waiting1;
                localparam [31:0] y_adds0_lane = i;
                wire y_adds0 = y_adds0_lane[0] & y_middle_carry0_cells[i / 2].col[j].y_adds0_and;
                wire y_carry0_in = y_carry0 & !first7;
                wire y_carry0_and = y_carry0_in & (y_waiting0_cells[i / 2].col[j].y_waiting0 | y_adds0);
                wire y_bends0 = y_adds0_lane[0] & (y_bent0 & !first8);
                wire y_growth_carry0_in = y_growth_carry0 & !first8;
                wire y_growth_carry0_and = y_growth_carry0_in & (x_downward_carry2_row[j].x_downward2 | y_bends0);
                wire y_middle_carry1_in = y_middle_carry1 & !first9;
                wire y_middle_carry1_and_2 = y_middle_carry1_in & (y_growth0 | y_middle_carry1_and);
                wire y_adds1_and = y_middle1 & (first10 | (y_middle_has_come1 & !first9));

                always @(posedge clk) begin
                    y_carry0 <= (y_waiting0_cells[i / 2].col[j].y_waiting0 & y_adds0) | y_carry0_and;
                    y_sum0 <= y_waiting0_cells[i / 2].col[j].y_waiting0 ^ y_adds0 ^ y_carry0_in;
                    y_growth_carry0 <= (x_downward_carry2_row[j].x_downward2 & y_bends0) | y_growth_carry0_and;
                    y_growth0 <= x_downward_carry2_row[j].x_downward2 ^ y_bends0 ^ y_growth_carry0_in;
                    y_middle_carry1 <= (y_growth0 & y_middle_carry1_and) | y_middle_carry1_and_2;
                    y_middle1 <= y_growth0 ^ y_middle_carry1_and ^ y_middle_carry1_in;
                    y_waiting1 <= y_sum0;
                end
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : y_carry1_cells
            for (j = 0; j < 8; j = j + 1) begin : col
                reg y_carry1;
                reg y_sum1;
                reg y_growth_carry1;
                reg y_growth1;
                reg y_middle_carry2;
                reg y_middle2;
                reg y_waiting2;
                localparam [31:0] y_adds1_lane = i % 2;
                wire y_adds1 = y_adds1_lane[0] & y_carry0_cells[i / 2].col[j].y_adds1_and;
                wire y_carry1_in = y_carry1 & !first9;
                wire y_carry1_and = y_carry1_in & (y_carry0_cells[i / 2].col[j].y_waiting1 | y_adds1);
                wire y_bends1 = y_adds1_lane[0] & (y_bent1 & !first9);
                wire y_growth_carry1_in = y_growth_carry1 & !first9;
                wire y_growth_carry1_and = y_growth_carry1_in & (y_carry0_cells[i / 2].col[j].y_growth0 | y_bends1);
                wire y_middle_carry2_in = y_middle_carry2 & !first10;
                wire y_middle_carry2_and = y_middle_carry2_in & (y_growth1 | f10);

                always @(posedge clk) begin
                    y_carry1 <= (y_carry0_cells[i / 2].col[j].y_waiting1 & y_adds1) | y_carry1_and;
                    y_sum1 <= y_carry0_cells[i / 2].col[j].y_waiting1 ^ y_adds1 ^ y_carry1_in;
                    y_growth_carry1 <= (y_carry0_cells[i / 2].col[j].y_growth0 & y_bends1) | y_growth_carry1_and;
                    y_growth1 <= y_carry0_cells[i / 2].col[j].y_growth0 ^ y_bends1 ^ y_growth_carry1_in;
                    y_middle_carry2 <= (y_growth1 & f10) | y_middle_carry2_and;
                    y_middle2 <= y_growth1 ^ f10 ^ y_middle_carry2_in;
                    y_waiting2 <= y_sum1;
                end
            end
        end
    endgenerate

    generate
        for (i = 0; i < 8; i = i + 1) begin : y_carry2_cells
            for (j = 0; j < 8; j = j + 1) begin : col
                reg y_carry2;
                reg y_sum2;
                localparam [31:0] y_adds2_lane = i % 2;
                wire y_adds2 = y_adds2_lane[0] & y_carry1_cells[i / 2].col[j].y_middle2;
                wire y_carry2_in = y_carry2 & !first11;
                wire y_carry2_and = y_carry2_in & (y_carry1_cells[i / 2].col[j].y_waiting2 | y_adds2);

                always @(posedge clk) begin
                    y_carry2 <= (y_carry1_cells[i / 2].col[j].y_waiting2 & y_adds2) | y_carry2_and;
                    y_sum2 <= y_carry1_cells[i / 2].col[j].y_waiting2 ^ y_adds2 ^ y_carry2_in;
                end
            end
        end
    endgenerate

    generate
        for (i = 0; i < 8; i = i + 1) begin : value_of
            for (j = 0; j < 8; j = j + 1) begin : value_col
                assign value[i * 8 + j] = y_carry2_cells[i].col[j].y_sum2;
            end
        end
    endgenerate

    always @(posedge clk) begin
        d1 <= curve_d;
        d2 <= d1;
        d3 <= d2;
        d4 <= d3;
        f1 <= curve_f;
        f2 <= f1;
        f3 <= f2;
        f4 <= f3;
        f5 <= f4;
        f6 <= f5;
        f7 <= f6;
        f8 <= f7;
        f9 <= f8;
        f10 <= f9;
        a1 <= coefficients_a;
        a2 <= a1;
        x_bent0 <= x_middle_carry0_and;
        x_bent1 <= x_middle_carry1_and;
        b1 <= coefficients_b;
        b2 <= b1;
        b3 <= b2;
        b4 <= b3;
        b5 <= b4;
        e1 <= curve_e;
        e2 <= e1;
        e3 <= e2;
        e4 <= e3;
        e5 <= e4;
        e6 <= e5;
        e7 <= e6;
        y_bent0 <= y_middle_carry0_and;
        y_bent1 <= y_middle_carry1_and;
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
            first8 <= 1'b0;
            first9 <= 1'b0;
            first10 <= 1'b0;
            first11 <= 1'b0;
            x_curve_has_come0 <= 1'b0;
            x_middle_has_come0 <= 1'b0;
            x_curve_has_come1 <= 1'b0;
            x_middle_has_come1 <= 1'b0;
            e_has_come0 <= 1'b0;
            e_has_come1 <= 1'b0;
            y_curve_has_come0 <= 1'b0;
            y_middle_has_come0 <= 1'b0;
            y_curve_has_come1 <= 1'b0;
            y_middle_has_come1 <= 1'b0;
        end else begin
            first1 <= first;
            first2 <= first1;
            first3 <= first2;
            first4 <= first3;
            first5 <= first4;
            first6 <= first5;
            first7 <= first6;
            first8 <= first7;
            first9 <= first8;
            first10 <= first9;
            first11 <= first10;
            if (first2) x_curve_has_come0 <= 1'b0;
            else if (first4) x_curve_has_come0 <= 1'b1;
            if (first1) x_middle_has_come0 <= 1'b0;
            else if (first3) x_middle_has_come0 <= 1'b1;
            if (first3) begin
                x_curve_has_come1 <= 1'b0;
                x_middle_has_come1 <= 1'b0;
            end else if (first4) begin
                x_curve_has_come1 <= 1'b1;
                x_middle_has_come1 <= 1'b1;
            end
            if (first5) e_has_come0 <= 1'b0;
            else if (first7) e_has_come0 <= 1'b1;
            if (first6) e_has_come1 <= 1'b0;
            else if (first7) e_has_come1 <= 1'b1;
            if (first8) y_curve_has_come0 <= 1'b0;
            else if (first10) y_curve_has_come0 <= 1'b1;
            if (first7) y_middle_has_come0 <= 1'b0;
            else if (first9) y_middle_has_come0 <= 1'b1;
            if (first9) begin
                y_curve_has_come1 <= 1'b0;
                y_middle_has_come1 <= 1'b0;
            end else if (first10) begin
                y_curve_has_come1 <= 1'b1;
                y_middle_has_come1 <= 1'b1;
            end
        end
    end
endmodule
`default_nettype wire
