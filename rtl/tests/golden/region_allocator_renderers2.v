// region_allocator_renderers2
//
// Gives the next region to the first renderer that is free.
//
// Parameters  RegionAllocator { renderers: 2 }
// Latency     0 clocks; a region a clock
// Source      Pixel-planes 5, section I.3.2.1 (PP5-ARCH)
// Described   rtl/src/pixel_planes/allocator.rs:22
`default_nettype none

module region_allocator_renderers2 (
    input  wire        clk,
    input  wire        rst,
    // The numbers of the regions, the one with the most primitives first.
    input  wire        regions_valid,
    input  wire [15:0] regions_payload,
    input  wire [1:0]  free,            // The renderers that are free.
    output wire [1:0]  given,           // The renderer that gets the region in this clock, if any.
    output wire [15:0] region,          // The number of the region that is given.
    output wire        regions_ready
);

    wire asserted_any;                                           // rtl/src/pixel_planes/allocator.rs:49
    wire regions_taken = regions_valid & regions_ready;          // rtl/src/pixel_planes/allocator.rs:46
    wire [1:0] given_and_2 = free & (~free + 2'd1);              // rtl/src/pixel_planes/allocator.rs:47

    genvar i;

    generate
        for (i = 0; i < 2; i = i + 1) begin : row
            wire given_and = given_and_2[i] & regions_taken;
        end
    endgenerate

    wire [1:0] regions_ready_lanes;
    generate
        for (i = 0; i < 2; i = i + 1) begin : regions_ready_of
            assign regions_ready_lanes[i] = free[i];
        end
    endgenerate
    assign regions_ready = |regions_ready_lanes;                 // rtl/src/pixel_planes/allocator.rs:46
    wire [1:0] asserted_any_lanes;
    generate
        for (i = 0; i < 2; i = i + 1) begin : asserted_any_of
            assign asserted_any_lanes[i] = row[i].given_and;
        end
    endgenerate
    assign asserted_any = |asserted_any_lanes;                   // rtl/src/pixel_planes/allocator.rs:49
    generate
        for (i = 0; i < 2; i = i + 1) begin : given_of
            assign given[i] = row[i].given_and;
        end
    endgenerate

    assign region = regions_payload;

`ifndef SYNTHESIS
`ifndef FORMAL
    task stop;
        begin
`ifdef __ICARUS__
            $finish_and_return(1);
`else
            $stop;
`endif
        end
    endtask
`endif
`endif

`ifndef SYNTHESIS
`ifdef FORMAL
    always @(posedge clk) begin
        if (!rst) assert (asserted_any == regions_taken);            // rtl/src/pixel_planes/allocator.rs:49
    end
`else
    always @(posedge clk) begin
        if (!rst && !(asserted_any == regions_taken)) begin          // rtl/src/pixel_planes/allocator.rs:49
            $display("FAIL: time %0t: %m: a region that is taken goes to a renderer", $time);
            stop;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, clk, rst, asserted_any};
endmodule
`default_nettype wire
