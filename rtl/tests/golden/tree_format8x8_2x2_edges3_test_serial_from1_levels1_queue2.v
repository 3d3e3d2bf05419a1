// tree_format8x8_2x2_edges3_test_serial_from1_levels1_queue2
//
// Divides windows in a tree of units, which divide the quarters side by side.
//
// Parameters  Tree { format: "8x8_2x2_edges3", test: Serial, from: 1, levels: 1, queue: 2 }
// Latency     the clocks of the slowest unit; the quarters of a window are divided at the same time
// Source      sparse-raster quadtree generator, figure 1 (MPG-RP, MPG-TREE)
// Described   rtl/src/quadtree/tree.rs:24
`default_nettype none

module tree_format8x8_2x2_edges3_test_serial_from1_levels1_queue2 (
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
    output wire         works_ready
);

    wire u_queue_out_valid;                                      // rtl/src/quadtree/tree.rs:47
    wire [744:0] u_queue_out_payload;                            // rtl/src/quadtree/tree.rs:47
    wire u_test_works_ready;                                     // rtl/src/quadtree/tree.rs:49

    fifo_depth2_width745_storage_registers u_queue (             // rtl/src/quadtree/tree.rs:47
        .clk          (clk),
        .rst          (rst),
        .into_valid   (works_valid),
        .into_payload ({
            works_polygon_last_edge, works_polygon_step_x, works_polygon_step_y,
            works_polygon_right, works_polygon_lower, works_polygon_plane_x,
            works_polygon_plane_y, works_window_size, works_window_x, works_window_y,
            works_window_edges, works_window_bounds_left, works_window_bounds_top,
            works_window_bounds_right, works_window_bounds_bottom, works_window_planes
        }),
        .out_ready    (u_test_works_ready),
        .out_valid    (u_queue_out_valid),
        .out_payload  (u_queue_out_payload),
        .into_ready   (works_ready)
    );

    coverage_test_format8x8_2x2_edges3_test_serial_from1_sizes1 u_test ( // rtl/src/quadtree/tree.rs:49
        .clk                        (clk),
        .rst                        (rst),
        .works_valid                (u_queue_out_valid),
        .works_polygon_last_edge    (u_queue_out_payload[744:742]),
        .works_polygon_step_x       (u_queue_out_payload[741:691]),
        .works_polygon_step_y       (u_queue_out_payload[690:640]),
        .works_polygon_right        (u_queue_out_payload[639:637]),
        .works_polygon_lower        (u_queue_out_payload[636:634]),
        .works_polygon_plane_x      (u_queue_out_payload[633:474]),
        .works_polygon_plane_y      (u_queue_out_payload[473:314]),
        .works_window_size          (u_queue_out_payload[313:312]),
        .works_window_x             (u_queue_out_payload[311:310]),
        .works_window_y             (u_queue_out_payload[309:308]),
        .works_window_edges         (u_queue_out_payload[307:212]),
        .works_window_bounds_left   (u_queue_out_payload[211:199]),
        .works_window_bounds_top    (u_queue_out_payload[198:186]),
        .works_window_bounds_right  (u_queue_out_payload[185:173]),
        .works_window_bounds_bottom (u_queue_out_payload[172:160]),
        .works_window_planes        (u_queue_out_payload[159:0]),
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
        .works_ready                (u_test_works_ready)
    );
endmodule
`default_nettype wire
