// sums3
//
// Parameters  sums3
// Latency     0 clocks
// Described   gen/tests/lanes/modules.rs:113
`default_nettype none

module sums3 (
    input  wire [23:0] x,
    output wire [7:0]  sum,
    output wire [23:0] reverse,
    output wire [7:0]  smallest
);

    genvar i;

    generate
        for (i = 0; i < 5; i = i + 1) begin : sum_tree
            wire [7:0] value;
            if (i < 3) begin : leaf
                assign value = x[i * 8 +: 8];
            end else begin : pair
                assign value = sum_tree[2 * (i - 3)].value + sum_tree[2 * (i - 3) + 1].value;
            end
        end
    endgenerate
    assign sum = sum_tree[4].value;                              // gen/tests/lanes/modules.rs:115
    generate
        for (i = 0; i < 5; i = i + 1) begin : smallest_tree
            wire [7:0] value;
            if (i < 3) begin : leaf
                assign value = x[i * 8 +: 8];
            end else begin : pair
                wire [7:0] a = smallest_tree[2 * (i - 3)].value;
                wire [7:0] b = smallest_tree[2 * (i - 3) + 1].value;
                assign value = (a < b) ? a : b;
            end
        end
    endgenerate
    assign smallest = smallest_tree[4].value;                    // gen/tests/lanes/modules.rs:117
    generate
        for (i = 0; i < 3; i = i + 1) begin : reverse_of
            assign reverse[i * 8 +: 8] = x[(2 - i) * 8 +: 8];
        end
    endgenerate
endmodule
`default_nettype wire
