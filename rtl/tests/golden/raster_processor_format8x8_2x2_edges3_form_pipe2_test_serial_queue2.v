// raster_processor_format8x8_2x2_edges3_form_pipe2_test_serial_queue2
//
// Finds the pixels of a polygon: divides the window of all samples down to single samples.
//
// Parameters  RasterProcessor { format: "8x8_2x2_edges3", form: "pipe2", test: Serial, queue: 2 }
// Latency     the clocks of the windows that the polygon covers, in the slowest part
// Source      sparse-raster quadtree generator, figure 1 (MPG-RP)
// Described   rtl/src/quadtree/raster.rs:153
`default_nettype none

module raster_processor_format8x8_2x2_edges3_form_pipe2_test_serial_queue2 (
    input  wire         clk,
    input  wire         rst,
    // Windows with their polygons.
    input  wire         works_valid,
    // The polygon.
    input  wire [2:0]   works_polygon_last_edge,    // The number of the polygon's edges, less one.
    // The step of each edge function per sample along x, as a decrease from its greatest value.
    input  wire [50:0]  works_polygon_step_x,
    // The step of each edge function per sample along y, as a decrease from its greatest value.
    input  wire [50:0]  works_polygon_step_y,
    // Whether each edge function is greatest at the right side of a window.
    input  wire [2:0]   works_polygon_right,
    // Whether each edge function is greatest at the lower side of a window.
    input  wire [2:0]   works_polygon_lower,
    input  wire [159:0] works_polygon_plane_x,      // The increase of each plane per sample to the right.
    input  wire [159:0] works_polygon_plane_y,      // The increase of each plane per sample downward.
    // The window.
    // The binary logarithm of the window's side in samples: n less the level.
    input  wire [1:0]   works_window_size,
    input  wire [1:0]   works_window_x,             // The column of the window's leftmost samples.
    input  wire [1:0]   works_window_y,             // The row of the window's uppermost samples.
    // The greatest value of each edge function in the window; those beyond the polygon's last edge are ignored.
    input  wire [95:0]  works_window_edges,
    // How far the window extends inward past each bound of the polygon, in pixels; negative if it lies outside the
    // bound.
    input  wire [12:0]  works_window_bounds_left,   // The left bound, a column of pixels, or the distance past it.
    input  wire [12:0]  works_window_bounds_top,    // The upper bound, a line of pixels, or the distance past it.
    input  wire [12:0]  works_window_bounds_right,  // The right bound, a column of pixels, or the distance past it.
    input  wire [12:0]  works_window_bounds_bottom, // The lower bound, a line of pixels, or the distance past it.
    input  wire [159:0] works_window_planes,        // The value of each plane at the window's upper left sample.
    input  wire         parts_ready,
    // The parts of the windows that the polygon may cover; after the last division, single samples.
    output wire         parts_valid,
    // The polygon.
    output wire [2:0]   parts_polygon_last_edge,    // The number of the polygon's edges, less one.
    // The step of each edge function per sample along x, as a decrease from its greatest value.
    output wire [50:0]  parts_polygon_step_x,
    // The step of each edge function per sample along y, as a decrease from its greatest value.
    output wire [50:0]  parts_polygon_step_y,
    // Whether each edge function is greatest at the right side of a window.
    output wire [2:0]   parts_polygon_right,
    // Whether each edge function is greatest at the lower side of a window.
    output wire [2:0]   parts_polygon_lower,
    output wire [159:0] parts_polygon_plane_x,      // The increase of each plane per sample to the right.
    output wire [159:0] parts_polygon_plane_y,      // The increase of each plane per sample downward.
    // The window.
    // The binary logarithm of the window's side in samples: n less the level.
    output wire [1:0]   parts_window_size,
    output wire [1:0]   parts_window_x,             // The column of the window's leftmost samples.
    output wire [1:0]   parts_window_y,             // The row of the window's uppermost samples.
    // The greatest value of each edge function in the window; those beyond the polygon's last edge are ignored.
    output wire [95:0]  parts_window_edges,
    // How far the window extends inward past each bound of the polygon, in pixels; negative if it lies outside the
    // bound.
    output wire [12:0]  parts_window_bounds_left,   // The left bound, a column of pixels, or the distance past it.
    output wire [12:0]  parts_window_bounds_top,    // The upper bound, a line of pixels, or the distance past it.
    output wire [12:0]  parts_window_bounds_right,  // The right bound, a column of pixels, or the distance past it.
    output wire [12:0]  parts_window_bounds_bottom, // The lower bound, a line of pixels, or the distance past it.
    output wire [159:0] parts_window_planes,        // The value of each plane at the window's upper left sample.
    output wire         idle,                       // No window is under way.
    // The counters of each level, from the first.
    output wire [31:0]  tally_0_busy,               // Clocks in which the unit worked.
    output wire [31:0]  tally_0_stalled,            // Clocks in which the unit had a result that was not taken.
    output wire [31:0]  tally_0_results,            // Results that the unit delivered.
    output wire [31:0]  tally_1_busy,
    output wire [31:0]  tally_1_stalled,
    output wire [31:0]  tally_1_results,
    output wire         works_ready
);

    pipe_format8x8_2x2_edges3_test_serial_from2_levels2_queue2 u_pipe0 ( // rtl/src/quadtree/raster.rs:180
        .clk                        (clk),
        .rst                        (rst),
        .works_valid                (works_valid),
        .works_polygon_last_edge    (works_polygon_last_edge),
        .works_polygon_step_x       (works_polygon_step_x),
        .works_polygon_step_y       (works_polygon_step_y),
        .works_polygon_right        (works_polygon_right),
        .works_polygon_lower        (works_polygon_lower),
        .works_polygon_plane_x      (works_polygon_plane_x),
        .works_polygon_plane_y      (works_polygon_plane_y),
        .works_window_size          (works_window_size),
        .works_window_x             (works_window_x),
        .works_window_y             (works_window_y),
        .works_window_edges         (works_window_edges),
        .works_window_bounds_left   (works_window_bounds_left),
        .works_window_bounds_top    (works_window_bounds_top),
        .works_window_bounds_right  (works_window_bounds_right),
        .works_window_bounds_bottom (works_window_bounds_bottom),
        .works_window_planes        (works_window_planes),
        .parts_ready                (parts_ready),
        .parts_valid                (parts_valid),
        .parts_polygon_last_edge    (parts_polygon_last_edge),
        .parts_polygon_step_x       (parts_polygon_step_x),
        .parts_polygon_step_y       (parts_polygon_step_y),
        .parts_polygon_right        (parts_polygon_right),
        .parts_polygon_lower        (parts_polygon_lower),
        .parts_polygon_plane_x      (parts_polygon_plane_x),
        .parts_polygon_plane_y      (parts_polygon_plane_y),
        .parts_window_size          (parts_window_size),
        .parts_window_x             (parts_window_x),
        .parts_window_y             (parts_window_y),
        .parts_window_edges         (parts_window_edges),
        .parts_window_bounds_left   (parts_window_bounds_left),
        .parts_window_bounds_top    (parts_window_bounds_top),
        .parts_window_bounds_right  (parts_window_bounds_right),
        .parts_window_bounds_bottom (parts_window_bounds_bottom),
        .parts_window_planes        (parts_window_planes),
        .idle                       (idle),
        .tally_0_busy               (tally_0_busy),
        .tally_0_stalled            (tally_0_stalled),
        .tally_0_results            (tally_0_results),
        .tally_1_busy               (tally_1_busy),
        .tally_1_stalled            (tally_1_stalled),
        .tally_1_results            (tally_1_results),
        .works_ready                (works_ready)
    );
endmodule
`default_nettype wire
