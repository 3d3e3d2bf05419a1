// video_processor_4b528d89
//
// Draws polygons in a raster of its own: every p-th pixel of every q-th line.
//
// Parameters  VideoProcessor { format: "8x8_2x2_edges3", form: "pipe2", test: Serial, queues: Queues { broadcast: 2, packets: 2, windows: 2 } }
// Latency     a polygon takes a clock for each edge, but at least 4, and the clocks of the windows that it covers
// Source      sparse-raster quadtree generator, figure 1 (MPG-ARCH, MPG-SPR)
// Described   rtl/src/quadtree/processor.rs:38
`default_nettype none

module video_processor_4b528d89 (
    input  wire         clk,
    input  wire         rst,
    // The polygons to draw.
    input  wire         packets_valid,
    input  wire [2:0]   packets_last_edge,     // The number of the polygon's edges, less one.
    // The edge functions of the polygon; those beyond the last edge are ignored.
    // Coefficient of x: the increase of the edge function per pixel to the right.
    input  wire [50:0]  packets_edges_a,
    input  wire [50:0]  packets_edges_b,       // Coefficient of y: the increase of the edge function per line downward.
    input  wire [95:0]  packets_edges_c,       // The value of the edge function at the upper left pixel.
    // The attributes of the polygon.
    input  wire [159:0] packets_planes_x,      // Coefficient of x: the increase of the plane per pixel to the right.
    input  wire [159:0] packets_planes_y,      // Coefficient of y: the increase of the plane per line downward.
    // The value of the plane at the upper left pixel, plus half a unit for rounding.
    input  wire [159:0] packets_planes_origin,
    // The pixels whose centres lie within the extent of the polygon's vertices along each axis.
    input  wire [10:0]  packets_bounds_left,   // The left bound, a column of pixels, or the distance past it.
    input  wire [10:0]  packets_bounds_top,    // The upper bound, a line of pixels, or the distance past it.
    input  wire [10:0]  packets_bounds_right,  // The right bound, a column of pixels, or the distance past it.
    input  wire [10:0]  packets_bounds_bottom, // The lower bound, a line of pixels, or the distance past it.
    // The outermost pixels of this video processor, widened by half the aperture; constants from `Format::place_of`.
    input  wire [12:0]  place_left,            // The left bound, a column of pixels, or the distance past it.
    input  wire [12:0]  place_top,             // The upper bound, a line of pixels, or the distance past it.
    input  wire [12:0]  place_right,           // The right bound, a column of pixels, or the distance past it.
    input  wire [12:0]  place_bottom,          // The lower bound, a line of pixels, or the distance past it.
    input  wire         strict,                // Depth alone is compared, and the first drawn of equal depths stays.
    input  wire         back,                  // The number of the bank to draw in.
    // The pixel of the other bank to send.
    // A pixel is sent; while `enable` is low, the word sent stays until the banks are exchanged.
    input  wire         scan_enable,
    input  wire [1:0]   scan_x,                // The pixel's column among those of the video processor.
    input  wire [1:0]   scan_y,                // The pixel's line among those of the video processor.
    input  wire         scan_clear,            // The pixel is cleared when it is read.
    output wire [47:0]  word,                  // The word sent to the video controller.
    output wire         idle,                  // No polygon is under way.
    // The counters of the set-up, and of each level of the raster processor.
    output wire [31:0]  tally_0_busy,          // Clocks in which the unit worked.
    output wire [31:0]  tally_0_stalled,       // Clocks in which the unit had a result that was not taken.
    output wire [31:0]  tally_0_results,       // Results that the unit delivered.
    output wire [31:0]  tally_1_busy,
    output wire [31:0]  tally_1_stalled,
    output wire [31:0]  tally_1_results,
    output wire [31:0]  tally_2_busy,
    output wire [31:0]  tally_2_stalled,
    output wire [31:0]  tally_2_results,
    output wire [31:0]  fragments,             // Fragments since the reset, modulo 2^32.
    output wire         packets_ready
);

    reg drawn;                                                   // rtl/src/quadtree/processor.rs:95

    wire u_queue_out_valid;                                      // rtl/src/quadtree/processor.rs:84
    wire [724:0] u_queue_out_payload;                            // rtl/src/quadtree/processor.rs:84
    wire u_set_up_roots_valid;                                   // rtl/src/quadtree/processor.rs:85
    wire [2:0] u_set_up_roots_polygon_last_edge;                 // rtl/src/quadtree/processor.rs:85
    wire [50:0] u_set_up_roots_polygon_step_x;                   // rtl/src/quadtree/processor.rs:85
    wire [50:0] u_set_up_roots_polygon_step_y;                   // rtl/src/quadtree/processor.rs:85
    wire [2:0] u_set_up_roots_polygon_right;                     // rtl/src/quadtree/processor.rs:85
    wire [2:0] u_set_up_roots_polygon_lower;                     // rtl/src/quadtree/processor.rs:85
    wire [159:0] u_set_up_roots_polygon_plane_x;                 // rtl/src/quadtree/processor.rs:85
    wire [159:0] u_set_up_roots_polygon_plane_y;                 // rtl/src/quadtree/processor.rs:85
    wire [1:0] u_set_up_roots_window_size;                       // rtl/src/quadtree/processor.rs:85
    wire [1:0] u_set_up_roots_window_x;                          // rtl/src/quadtree/processor.rs:85
    wire [1:0] u_set_up_roots_window_y;                          // rtl/src/quadtree/processor.rs:85
    wire [95:0] u_set_up_roots_window_edges;                     // rtl/src/quadtree/processor.rs:85
    wire [12:0] u_set_up_roots_window_bounds_left;               // rtl/src/quadtree/processor.rs:85
    wire [12:0] u_set_up_roots_window_bounds_top;                // rtl/src/quadtree/processor.rs:85
    wire [12:0] u_set_up_roots_window_bounds_right;              // rtl/src/quadtree/processor.rs:85
    wire [12:0] u_set_up_roots_window_bounds_bottom;             // rtl/src/quadtree/processor.rs:85
    wire [159:0] u_set_up_roots_window_planes;                   // rtl/src/quadtree/processor.rs:85
    wire u_set_up_idle;                                          // rtl/src/quadtree/processor.rs:85
    wire u_set_up_packets_ready;                                 // rtl/src/quadtree/processor.rs:85
    wire u_raster_parts_valid;                                   // rtl/src/quadtree/processor.rs:88
    wire [2:0] u_raster_parts_polygon_last_edge;                 // rtl/src/quadtree/processor.rs:88
    wire [50:0] u_raster_parts_polygon_step_x;                   // rtl/src/quadtree/processor.rs:88
    wire [50:0] u_raster_parts_polygon_step_y;                   // rtl/src/quadtree/processor.rs:88
    wire [2:0] u_raster_parts_polygon_right;                     // rtl/src/quadtree/processor.rs:88
    wire [2:0] u_raster_parts_polygon_lower;                     // rtl/src/quadtree/processor.rs:88
    wire [159:0] u_raster_parts_polygon_plane_x;                 // rtl/src/quadtree/processor.rs:88
    wire [159:0] u_raster_parts_polygon_plane_y;                 // rtl/src/quadtree/processor.rs:88
    wire [1:0] u_raster_parts_window_size;                       // rtl/src/quadtree/processor.rs:88
    wire [1:0] u_raster_parts_window_x;                          // rtl/src/quadtree/processor.rs:88
    wire [1:0] u_raster_parts_window_y;                          // rtl/src/quadtree/processor.rs:88
    wire [95:0] u_raster_parts_window_edges;                     // rtl/src/quadtree/processor.rs:88
    wire [12:0] u_raster_parts_window_bounds_left;               // rtl/src/quadtree/processor.rs:88
    wire [12:0] u_raster_parts_window_bounds_top;                // rtl/src/quadtree/processor.rs:88
    wire [12:0] u_raster_parts_window_bounds_right;              // rtl/src/quadtree/processor.rs:88
    wire [12:0] u_raster_parts_window_bounds_bottom;             // rtl/src/quadtree/processor.rs:88
    wire [159:0] u_raster_parts_window_planes;                   // rtl/src/quadtree/processor.rs:88
    wire u_raster_idle;                                          // rtl/src/quadtree/processor.rs:88
    wire u_raster_works_ready;                                   // rtl/src/quadtree/processor.rs:88
    wire u_pixel_fragment_valid;                                 // rtl/src/quadtree/processor.rs:90
    wire [1:0] u_pixel_fragment_x;                               // rtl/src/quadtree/processor.rs:90
    wire [1:0] u_pixel_fragment_y;                               // rtl/src/quadtree/processor.rs:90
    wire [47:0] u_pixel_fragment_word;                           // rtl/src/quadtree/processor.rs:90
    wire u_pixel_leaves_ready;                                   // rtl/src/quadtree/processor.rs:90

    wire idle_and = u_set_up_idle & u_raster_idle & !u_pixel_fragment_valid; // rtl/src/quadtree/processor.rs:97
    assign idle = idle_and & !drawn;                             // rtl/src/quadtree/processor.rs:97

    fifo_depth2_width725_storage_registers u_queue (             // rtl/src/quadtree/processor.rs:84
        .clk          (clk),
        .rst          (rst),
        .into_valid   (packets_valid),
        .into_payload ({
            packets_last_edge, packets_edges_a, packets_edges_b, packets_edges_c,
            packets_planes_x, packets_planes_y, packets_planes_origin, packets_bounds_left,
            packets_bounds_top, packets_bounds_right, packets_bounds_bottom
        }),
        .out_ready    (u_set_up_packets_ready),
        .out_valid    (u_queue_out_valid),
        .out_payload  (u_queue_out_payload),
        .into_ready   (packets_ready)
    );

    set_up_format8x8_2x2_edges3 u_set_up (                       // rtl/src/quadtree/processor.rs:85
        .clk                        (clk),
        .rst                        (rst),
        .packets_valid              (u_queue_out_valid),
        .packets_last_edge          (u_queue_out_payload[724:722]),
        .packets_edges_a            (u_queue_out_payload[721:671]),
        .packets_edges_b            (u_queue_out_payload[670:620]),
        .packets_edges_c            (u_queue_out_payload[619:524]),
        .packets_planes_x           (u_queue_out_payload[523:364]),
        .packets_planes_y           (u_queue_out_payload[363:204]),
        .packets_planes_origin      (u_queue_out_payload[203:44]),
        .packets_bounds_left        (u_queue_out_payload[43:33]),
        .packets_bounds_top         (u_queue_out_payload[32:22]),
        .packets_bounds_right       (u_queue_out_payload[21:11]),
        .packets_bounds_bottom      (u_queue_out_payload[10:0]),
        .place_left                 (place_left),
        .place_top                  (place_top),
        .place_right                (place_right),
        .place_bottom               (place_bottom),
        .roots_ready                (u_raster_works_ready),
        .roots_valid                (u_set_up_roots_valid),
        .roots_polygon_last_edge    (u_set_up_roots_polygon_last_edge),
        .roots_polygon_step_x       (u_set_up_roots_polygon_step_x),
        .roots_polygon_step_y       (u_set_up_roots_polygon_step_y),
        .roots_polygon_right        (u_set_up_roots_polygon_right),
        .roots_polygon_lower        (u_set_up_roots_polygon_lower),
        .roots_polygon_plane_x      (u_set_up_roots_polygon_plane_x),
        .roots_polygon_plane_y      (u_set_up_roots_polygon_plane_y),
        .roots_window_size          (u_set_up_roots_window_size),
        .roots_window_x             (u_set_up_roots_window_x),
        .roots_window_y             (u_set_up_roots_window_y),
        .roots_window_edges         (u_set_up_roots_window_edges),
        .roots_window_bounds_left   (u_set_up_roots_window_bounds_left),
        .roots_window_bounds_top    (u_set_up_roots_window_bounds_top),
        .roots_window_bounds_right  (u_set_up_roots_window_bounds_right),
        .roots_window_bounds_bottom (u_set_up_roots_window_bounds_bottom),
        .roots_window_planes        (u_set_up_roots_window_planes),
        .idle                       (u_set_up_idle),
        .tally_busy                 (tally_0_busy),
        .tally_stalled              (tally_0_stalled),
        .tally_results              (tally_0_results),
        .packets_ready              (u_set_up_packets_ready)
    );

    raster_processor_format8x8_2x2_edges3_form_pipe2_test_serial_queue2 u_raster ( // rtl/src/quadtree/processor.rs:88
        .clk                        (clk),
        .rst                        (rst),
        .works_valid                (u_set_up_roots_valid),
        .works_polygon_last_edge    (u_set_up_roots_polygon_last_edge),
        .works_polygon_step_x       (u_set_up_roots_polygon_step_x),
        .works_polygon_step_y       (u_set_up_roots_polygon_step_y),
        .works_polygon_right        (u_set_up_roots_polygon_right),
        .works_polygon_lower        (u_set_up_roots_polygon_lower),
        .works_polygon_plane_x      (u_set_up_roots_polygon_plane_x),
        .works_polygon_plane_y      (u_set_up_roots_polygon_plane_y),
        .works_window_size          (u_set_up_roots_window_size),
        .works_window_x             (u_set_up_roots_window_x),
        .works_window_y             (u_set_up_roots_window_y),
        .works_window_edges         (u_set_up_roots_window_edges),
        .works_window_bounds_left   (u_set_up_roots_window_bounds_left),
        .works_window_bounds_top    (u_set_up_roots_window_bounds_top),
        .works_window_bounds_right  (u_set_up_roots_window_bounds_right),
        .works_window_bounds_bottom (u_set_up_roots_window_bounds_bottom),
        .works_window_planes        (u_set_up_roots_window_planes),
        .parts_ready                (u_pixel_leaves_ready),
        .parts_valid                (u_raster_parts_valid),
        .parts_polygon_last_edge    (u_raster_parts_polygon_last_edge),
        .parts_polygon_step_x       (u_raster_parts_polygon_step_x),
        .parts_polygon_step_y       (u_raster_parts_polygon_step_y),
        .parts_polygon_right        (u_raster_parts_polygon_right),
        .parts_polygon_lower        (u_raster_parts_polygon_lower),
        .parts_polygon_plane_x      (u_raster_parts_polygon_plane_x),
        .parts_polygon_plane_y      (u_raster_parts_polygon_plane_y),
        .parts_window_size          (u_raster_parts_window_size),
        .parts_window_x             (u_raster_parts_window_x),
        .parts_window_y             (u_raster_parts_window_y),
        .parts_window_edges         (u_raster_parts_window_edges),
        .parts_window_bounds_left   (u_raster_parts_window_bounds_left),
        .parts_window_bounds_top    (u_raster_parts_window_bounds_top),
        .parts_window_bounds_right  (u_raster_parts_window_bounds_right),
        .parts_window_bounds_bottom (u_raster_parts_window_bounds_bottom),
        .parts_window_planes        (u_raster_parts_window_planes),
        .idle                       (u_raster_idle),
        .tally_0_busy               (tally_1_busy),
        .tally_0_stalled            (tally_1_stalled),
        .tally_0_results            (tally_1_results),
        .tally_1_busy               (tally_2_busy),
        .tally_1_stalled            (tally_2_stalled),
        .tally_1_results            (tally_2_results),
        .works_ready                (u_raster_works_ready)
    );

    pixel_processor_format8x8_2x2_edges3 u_pixel (               // rtl/src/quadtree/processor.rs:90
        .clk                         (clk),
        .rst                         (rst),
        .leaves_valid                (u_raster_parts_valid),
        .leaves_polygon_last_edge    (u_raster_parts_polygon_last_edge),
        .leaves_polygon_step_x       (u_raster_parts_polygon_step_x),
        .leaves_polygon_step_y       (u_raster_parts_polygon_step_y),
        .leaves_polygon_right        (u_raster_parts_polygon_right),
        .leaves_polygon_lower        (u_raster_parts_polygon_lower),
        .leaves_polygon_plane_x      (u_raster_parts_polygon_plane_x),
        .leaves_polygon_plane_y      (u_raster_parts_polygon_plane_y),
        .leaves_window_size          (u_raster_parts_window_size),
        .leaves_window_x             (u_raster_parts_window_x),
        .leaves_window_y             (u_raster_parts_window_y),
        .leaves_window_edges         (u_raster_parts_window_edges),
        .leaves_window_bounds_left   (u_raster_parts_window_bounds_left),
        .leaves_window_bounds_top    (u_raster_parts_window_bounds_top),
        .leaves_window_bounds_right  (u_raster_parts_window_bounds_right),
        .leaves_window_bounds_bottom (u_raster_parts_window_bounds_bottom),
        .leaves_window_planes        (u_raster_parts_window_planes),
        .fragment_valid              (u_pixel_fragment_valid),
        .fragment_x                  (u_pixel_fragment_x),
        .fragment_y                  (u_pixel_fragment_y),
        .fragment_word               (u_pixel_fragment_word),
        .fragments                   (fragments),
        .leaves_ready                (u_pixel_leaves_ready)
    );

    video_buffer_format8x8_2x2_edges3 u_buffer (                 // rtl/src/quadtree/processor.rs:92
        .clk         (clk),
        .rst         (rst),
        .draw_valid  (u_pixel_fragment_valid),
        .draw_x      (u_pixel_fragment_x),
        .draw_y      (u_pixel_fragment_y),
        .draw_word   (u_pixel_fragment_word),
        .strict      (strict),
        .back        (back),
        .scan_enable (scan_enable),
        .scan_x      (scan_x),
        .scan_y      (scan_y),
        .scan_clear  (scan_clear),
        .word        (word)
    );

    always @(posedge clk) begin
        if (rst) drawn <= 1'b0;
        else drawn <= u_pixel_fragment_valid;
    end
endmodule
`default_nettype wire
