// image_merger_units2
//
// Merges the images of the local frame buffers: passes on the nearest sample of each pixel.
//
// Parameters  ImageMerger { units: 2 }
// Latency     8 clocks with `enable`
// Source      VC-1, section 3.3, pipelined image merger (VC1-PIM)
// Described   rtl/src/merger/image_merger.rs:16
`default_nettype none

module image_merger_units2 (
    input  wire        clk,
    input  wire [47:0] left,      // The pixel that enters the chain at its left end.
    // The pixel of each local frame buffer.
    input  wire [47:0] samples_0,
    input  wire [47:0] samples_1,
    input  wire        enable,    // The chain advances.
    output wire [47:0] merged     // The nearest of the samples that met in the chain.
);

    genvar i;

    wire [95:0] u_merging_unit_right = {samples_1, samples_0};
    generate
        for (i = 0; i < 2; i = i + 1) begin : u_merging_unit         // rtl/src/merger/image_merger.rs:41
            wire [47:0] nearer;
            wire [47:0] lane_left;
            if (i < 1) begin : lane_left_edge
                assign lane_left = left;
            end else begin : lane_left_link
                assign lane_left = u_merging_unit[i - 1].nearer;
            end
            wire [47:0] right = u_merging_unit_right[i * 48 +: 48];

            merging_unit lane (
                .clk    (clk),
                .left   (lane_left),
                .right  (right),
                .enable (enable),
                .nearer (nearer)
            );
        end
    endgenerate

    assign merged = u_merging_unit[1].nearer;
endmodule
`default_nettype wire
