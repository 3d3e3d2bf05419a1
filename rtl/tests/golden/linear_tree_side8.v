// linear_tree_side8
//
// Evaluates a linear expression at every pixel of a square.
//
// Parameters  LinearTree { side: 8 }
// Latency     6 clocks from a coefficient's bit to the expression's bit at each pixel
// Source      Pixel-planes 5, section I.3.2.1 (PP5-ARCH)
// Described   rtl/src/pixel_planes/linear_tree.rs:26
`default_nettype none

module linear_tree_side8 (
    input  wire        clk,
    input  wire        rst,
    // A bit of each coefficient, beginning with the least significant.
    input  wire        coefficients_a, // Coefficient A, the increase from one column to the next.
    input  wire        coefficients_b, // Coefficient B, the increase from one line to the next.
    input  wire        coefficients_c, // Coefficient C, the value at column 0 of line 0.
    // The coefficients' bits are the first of an expression, which has at least log2 `side` bits.
    input  wire        first,
    output wire [63:0] value           // A bit of the expression at each pixel, a row for each line.
);

    reg first1;                                                  // rtl/src/pixel_planes/linear_tree.rs:68
    reg first2;                                                  // rtl/src/pixel_planes/linear_tree.rs:68
    reg first3;                                                  // rtl/src/pixel_planes/linear_tree.rs:68
    reg first4;                                                  // rtl/src/pixel_planes/linear_tree.rs:68
    reg first5;                                                  // rtl/src/pixel_planes/linear_tree.rs:68
    reg a1;                                                      // rtl/src/pixel_planes/linear_tree.rs:70
    reg a2;                                                      // rtl/src/pixel_planes/linear_tree.rs:70
    reg b1;                                                      // rtl/src/pixel_planes/linear_tree.rs:71
    reg b2;                                                      // rtl/src/pixel_planes/linear_tree.rs:71
    reg b3;                                                      // rtl/src/pixel_planes/linear_tree.rs:71
    reg b4;                                                      // rtl/src/pixel_planes/linear_tree.rs:71
    reg b5;                                                      // rtl/src/pixel_planes/linear_tree.rs:71
    reg x_has_come0;                                             // rtl/src/pixel_planes/linear_tree.rs:99
    reg x_has_come1;                                             // rtl/src/pixel_planes/linear_tree.rs:99
    reg y_has_come0;                                             // rtl/src/pixel_planes/linear_tree.rs:99
    reg y_has_come1;                                             // rtl/src/pixel_planes/linear_tree.rs:99

    genvar i;
    genvar j;

    generate
        for (i = 0; i < 2; i = i + 1) begin : x_carry0_row
            reg x_carry0;
            reg x_sum0;
            localparam [31:0] x_adds0_listed = i;
            wire x_adds0 = x_adds0_listed[0] & (a2 & (first2 | (x_has_come0 & !first)));
            wire x_carry0_in = x_carry0 & !first;
            wire x_carry0_and = x_carry0_in & (coefficients_c | x_adds0);

            always @(posedge clk) begin
                x_carry0 <= (coefficients_c & x_adds0) | x_carry0_and;
                x_sum0 <= coefficients_c ^ x_adds0 ^ x_carry0_in;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : x_carry1_row
            reg x_carry1;
            reg x_sum1;
            localparam [31:0] x_adds1_listed = i % 2;
            wire x_adds1 = x_adds1_listed[0] & (a2 & (first2 | (x_has_come1 & !first1)));
            wire x_carry1_in = x_carry1 & !first1;

            always @(posedge clk) begin
                x_carry1 <= (x_carry0_row[i / 2].x_sum0 & x_adds1) | (x_carry1_in & (x_carry0_row[i / 2].x_sum0 | x_adds1));
                x_sum1 <= x_carry0_row[i / 2].x_sum0 ^ x_adds1 ^ x_carry1_in;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 8; i = i + 1) begin : x_carry2_row
            reg x_carry2;
            reg x_sum2;
            localparam [31:0] x_adds2_listed = i % 2;
            wire x_adds2 = x_adds2_listed[0] & a2;
            wire x_carry2_in = x_carry2 & !first2;

            always @(posedge clk) begin
                x_carry2 <= (x_carry1_row[i / 2].x_sum1 & x_adds2) | (x_carry2_in & (x_carry1_row[i / 2].x_sum1 | x_adds2));
                x_sum2 <= x_carry1_row[i / 2].x_sum1 ^ x_adds2 ^ x_carry2_in;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : y_carry0_cells
            for (j = 0; j < 8; j = j + 1) begin : col
                reg y_carry0;
                reg y_sum0;
                localparam [31:0] y_adds0_lane = i;
                wire y_adds0 = y_adds0_lane[0] & (b5 & (first5 | (y_has_come0 & !first3)));
                wire y_carry0_in = y_carry0 & !first3;

                always @(posedge clk) begin
                    y_carry0 <= (x_carry2_row[j].x_sum2 & y_adds0) | (y_carry0_in & (x_carry2_row[j].x_sum2 | y_adds0));
                    y_sum0 <= x_carry2_row[j].x_sum2 ^ y_adds0 ^ y_carry0_in;
                end
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : y_carry1_cells
            for (j = 0; j < 8; j = j + 1) begin : col
                reg y_carry1;
                reg y_sum1;
                localparam [31:0] y_adds1_lane = i % 2;
                wire y_adds1 = y_adds1_lane[0] & (b5 & (first5 | (y_has_come1 & !first4)));
                wire y_carry1_in = y_carry1 & !first4;

                always @(posedge clk) begin
                    y_carry1 <= (y_carry0_cells[i / 2].col[j].y_sum0 & y_adds1) | (y_carry1_in & (y_carry0_cells[i / 2].col[j].y_sum0 | y_adds1));
                    y_sum1 <= y_carry0_cells[i / 2].col[j].y_sum0 ^ y_adds1 ^ y_carry1_in;
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
                wire y_adds2 = y_adds2_lane[0] & b5;
                wire y_carry2_in = y_carry2 & !first5;

                always @(posedge clk) begin
                    y_carry2 <= (y_carry1_cells[i / 2].col[j].y_sum1 & y_adds2) | (y_carry2_in & (y_carry1_cells[i / 2].col[j].y_sum1 | y_adds2));
                    y_sum2 <= y_carry1_cells[i / 2].col[j].y_sum1 ^ y_adds2 ^ y_carry2_in;
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
        a1 <= coefficients_a;
        a2 <= a1;
        b1 <= coefficients_b;
        b2 <= b1;
        b3 <= b2;
        b4 <= b3;
        b5 <= b4;
    end

    always @(posedge clk) begin
        if (rst) begin
            first1 <= 1'b0;
            first2 <= 1'b0;
            first3 <= 1'b0;
            first4 <= 1'b0;
            first5 <= 1'b0;
            x_has_come0 <= 1'b0;
            x_has_come1 <= 1'b0;
            y_has_come0 <= 1'b0;
            y_has_come1 <= 1'b0;
        end else begin
            first1 <= first;
            first2 <= first1;
            first3 <= first2;
            first4 <= first3;
            first5 <= first4;
            if (first) x_has_come0 <= 1'b0;
            else if (first2) x_has_come0 <= 1'b1;
            if (first1) x_has_come1 <= 1'b0;
            else if (first2) x_has_come1 <= 1'b1;
            if (first3) y_has_come0 <= 1'b0;
            else if (first5) y_has_come0 <= 1'b1;
            if (first4) y_has_come1 <= 1'b0;
            else if (first5) y_has_come1 <= 1'b1;
        end
    end
endmodule
`default_nettype wire
