// merging_unit
//
// Passes on the nearer of two pixels, each a word of depth above colour: the smaller word.
//
// Parameters  MergingUnit
// Latency     4 clocks with `enable`
// Source      VC-1, section 3.3, pipelined image merger (VC1-MU)
// Described   rtl/src/merger/unit.rs:26
`default_nettype none

module merging_unit (
    input  wire        clk,
    input  wire [47:0] left,   // The pixel of the preceding unit of the chain.
    input  wire [47:0] right,  // The pixel of the local frame buffer.
    input  wire        enable, // The pipeline advances.
    output reg  [47:0] nearer  // The nearer pixel.
);

    reg [47:0] left1;                                            // rtl/src/merger/unit.rs:57
    reg [47:0] right1;                                           // rtl/src/merger/unit.rs:57
    reg decided1;                                                // rtl/src/merger/unit.rs:57
    reg right_is_nearer1;                                        // rtl/src/merger/unit.rs:57
    reg [47:0] left2;                                            // rtl/src/merger/unit.rs:57
    reg [47:0] right2;                                           // rtl/src/merger/unit.rs:57
    reg decided2;                                                // rtl/src/merger/unit.rs:57
    reg right_is_nearer2;                                        // rtl/src/merger/unit.rs:57
    reg [47:0] left3;                                            // rtl/src/merger/unit.rs:57
    reg [47:0] right3;                                           // rtl/src/merger/unit.rs:57
    reg decided3;                                                // rtl/src/merger/unit.rs:57
    reg right_is_nearer3;                                        // rtl/src/merger/unit.rs:57

    always @(posedge clk) begin
        if (enable) begin
            left1 <= left;
            right1 <= right;
            decided1 <= right[47:36] != left[47:36];
            right_is_nearer1 <= right[47:36] < left[47:36];
            left2 <= left1;
            right2 <= right1;
            decided2 <= decided1 | (right1[35:24] != left1[35:24]);
            right_is_nearer2 <= right_is_nearer1 | (!decided1 & (right1[35:24] < left1[35:24]));
            left3 <= left2;
            right3 <= right2;
            decided3 <= decided2 | (right2[23:12] != left2[23:12]);
            right_is_nearer3 <= right_is_nearer2 | (!decided2 & (right2[23:12] < left2[23:12]));
            if (right_is_nearer3 | (!decided3 & (right3[11:0] < left3[11:0]))) nearer <= right3;
            else nearer <= left3;
        end
    end
endmodule
`default_nettype wire
