// pixel_processor_format8x8_2x2_edges3
//
// Makes fragments from windows of one sample.
//
// Parameters  PixelProcessor { format: "8x8_2x2_edges3" }
// Latency     1 clock to the fragment, and a fragment a clock
// Source      sparse-raster quadtree generator, figure 1 (MPG-ARCH, MPG-LIM)
// Described   rtl/src/quadtree/pixel.rs:17
`default_nettype none

module pixel_processor_format8x8_2x2_edges3 (
    input  wire         clk,
    input  wire         rst,
    // Windows of one sample; each is taken at once.
    input  wire         leaves_valid,
    // The polygon.
    input  wire [2:0]   leaves_polygon_last_edge,    // The number of the polygon's edges, less one.
    // The step of each edge function per sample along x, as a decrease from its greatest value.
    input  wire [50:0]  leaves_polygon_step_x,
    // The step of each edge function per sample along y, as a decrease from its greatest value.
    input  wire [50:0]  leaves_polygon_step_y,
    // Whether each edge function is greatest at the right side of a window.
    input  wire [2:0]   leaves_polygon_right,
    // Whether each edge function is greatest at the lower side of a window.
    input  wire [2:0]   leaves_polygon_lower,
    input  wire [159:0] leaves_polygon_plane_x,      // The increase of each plane per sample to the right.
    input  wire [159:0] leaves_polygon_plane_y,      // The increase of each plane per sample downward.
    // The window.
    // The binary logarithm of the window's side in samples: n less the level.
    input  wire [1:0]   leaves_window_size,
    input  wire [1:0]   leaves_window_x,             // The column of the window's leftmost samples.
    input  wire [1:0]   leaves_window_y,             // The row of the window's uppermost samples.
    // The greatest value of each edge function in the window; those beyond the polygon's last edge are ignored.
    input  wire [95:0]  leaves_window_edges,
    // How far the window extends inward past each bound of the polygon, in pixels; negative if it lies outside the
    // bound.
    input  wire [12:0]  leaves_window_bounds_left,   // The left bound, a column of pixels, or the distance past it.
    input  wire [12:0]  leaves_window_bounds_top,    // The upper bound, a line of pixels, or the distance past it.
    input  wire [12:0]  leaves_window_bounds_right,  // The right bound, a column of pixels, or the distance past it.
    input  wire [12:0]  leaves_window_bounds_bottom, // The lower bound, a line of pixels, or the distance past it.
    input  wire [159:0] leaves_window_planes,        // The value of each plane at the window's upper left sample.
    // A pixel of the polygon.
    output reg          fragment_valid,              // The fragment is valid.
    output reg  [1:0]   fragment_x,                  // The fragment's column among those of the video processor.
    output reg  [1:0]   fragment_y,                  // The fragment's line among those of the video processor.
    output reg  [47:0]  fragment_word,               // The word of the fragment: depth above colour.
    output reg  [31:0]  fragments,                   // Fragments since the reset, modulo 2^32.
    output wire         leaves_ready
);

    wire [47:0] word;                                            // rtl/src/quadtree/pixel.rs:59
    assign leaves_ready = 1'b1;                                  // rtl/src/quadtree/pixel.rs:54
    wire covered = 1'b1;                                         // rtl/src/quadtree/pixel.rs:60

    assign word = {                                              // rtl/src/quadtree/pixel.rs:59
        leaves_window_planes[39:16], leaves_window_planes[63:56],
        leaves_window_planes[103:96], leaves_window_planes[143:136]
    };

    always @(posedge clk) begin
        if (leaves_valid) begin
            fragment_x <= leaves_window_x;
            fragment_y <= leaves_window_y;
            fragment_word <= word;
        end
    end

    always @(posedge clk) begin
        if (rst) begin
            fragment_valid <= 1'b0;
            fragments <= 32'd0;
        end else begin
            fragment_valid <= leaves_valid;
            if (fragment_valid) fragments <= fragments + 32'd1;
        end
    end

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
        if (!rst) assume (!leaves_valid | (leaves_window_size == 2'd0)); // rtl/src/quadtree/pixel.rs:71
    end
`else
    always @(posedge clk) begin
        if (!rst && !(!leaves_valid | (leaves_window_size == 2'd0))) begin // rtl/src/quadtree/pixel.rs:71
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a leaf is a window of one sample", $time);
            stop;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, leaves_polygon_last_edge, leaves_window_size, leaves_window_bounds_left,
            leaves_window_bounds_top, leaves_window_bounds_right,
            leaves_window_bounds_bottom, covered, leaves_polygon_step_x,
            leaves_polygon_step_y, leaves_polygon_right, leaves_polygon_lower,
            leaves_polygon_plane_x, leaves_polygon_plane_y, leaves_window_edges,
            leaves_window_planes[159:144], leaves_window_planes[135:104],
            leaves_window_planes[95:64], leaves_window_planes[55:40],
            leaves_window_planes[15:0]};
endmodule
`default_nettype wire
