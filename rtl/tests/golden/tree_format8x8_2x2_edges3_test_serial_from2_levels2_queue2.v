// tree_format8x8_2x2_edges3_test_serial_from2_levels2_queue2
//
// Divides windows in a tree of units, which divide the quarters side by side.
//
// Parameters  Tree { format: "8x8_2x2_edges3", test: Serial, from: 2, levels: 2, queue: 2 }
// Latency     the clocks of the slowest unit; the quarters of a window are divided at the same time
// Source      sparse-raster quadtree generator, figure 1 (MPG-RP, MPG-TREE)
// Described   rtl/src/quadtree/tree.rs:24
`default_nettype none

module tree_format8x8_2x2_edges3_test_serial_from2_levels2_queue2 (
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

    wire u_queue_out_valid;                                      // rtl/src/quadtree/tree.rs:47
    wire [744:0] u_queue_out_payload;                            // rtl/src/quadtree/tree.rs:47
    wire u_test_parts_valid;                                     // rtl/src/quadtree/tree.rs:49
    wire [2:0] u_test_parts_polygon_last_edge;                   // rtl/src/quadtree/tree.rs:49
    wire [50:0] u_test_parts_polygon_step_x;                     // rtl/src/quadtree/tree.rs:49
    wire [50:0] u_test_parts_polygon_step_y;                     // rtl/src/quadtree/tree.rs:49
    wire [2:0] u_test_parts_polygon_right;                       // rtl/src/quadtree/tree.rs:49
    wire [2:0] u_test_parts_polygon_lower;                       // rtl/src/quadtree/tree.rs:49
    wire [159:0] u_test_parts_polygon_plane_x;                   // rtl/src/quadtree/tree.rs:49
    wire [159:0] u_test_parts_polygon_plane_y;                   // rtl/src/quadtree/tree.rs:49
    wire [1:0] u_test_parts_window_size;                         // rtl/src/quadtree/tree.rs:49
    wire [1:0] u_test_parts_window_x;                            // rtl/src/quadtree/tree.rs:49
    wire [1:0] u_test_parts_window_y;                            // rtl/src/quadtree/tree.rs:49
    wire [95:0] u_test_parts_window_edges;                       // rtl/src/quadtree/tree.rs:49
    wire [12:0] u_test_parts_window_bounds_left;                 // rtl/src/quadtree/tree.rs:49
    wire [12:0] u_test_parts_window_bounds_top;                  // rtl/src/quadtree/tree.rs:49
    wire [12:0] u_test_parts_window_bounds_right;                // rtl/src/quadtree/tree.rs:49
    wire [12:0] u_test_parts_window_bounds_bottom;               // rtl/src/quadtree/tree.rs:49
    wire [159:0] u_test_parts_window_planes;                     // rtl/src/quadtree/tree.rs:49
    wire u_test_idle;                                            // rtl/src/quadtree/tree.rs:49
    wire u_test_works_ready;                                     // rtl/src/quadtree/tree.rs:49
    wire [744:0] u_arbiter_out_payload;                          // rtl/src/quadtree/tree.rs:59
    wire u_arbiter_into_0_ready;                                 // rtl/src/quadtree/tree.rs:59
    wire u_arbiter_into_1_ready;                                 // rtl/src/quadtree/tree.rs:59
    wire u_arbiter_into_2_ready;                                 // rtl/src/quadtree/tree.rs:59
    wire u_arbiter_into_3_ready;                                 // rtl/src/quadtree/tree.rs:59

    wire u_test_parts_ready_and_2;                               // rtl/src/quadtree/tree.rs:55
    wire u_test_parts_ready_or_2;                                // rtl/src/quadtree/tree.rs:55
    wire u_test_parts_ready_or;                                  // rtl/src/quadtree/tree.rs:55
    wire [50:0] u_arbiter_into_0_payload_lanes;                  // rtl/src/quadtree/tree.rs:59
    wire [50:0] u_arbiter_into_0_payload_lanes_2;                // rtl/src/quadtree/tree.rs:59
    wire [2:0] u_arbiter_into_0_payload_lanes_3;                 // rtl/src/quadtree/tree.rs:59
    wire [2:0] u_arbiter_into_0_payload_lanes_4;                 // rtl/src/quadtree/tree.rs:59
    wire [159:0] u_arbiter_into_0_payload_lanes_5;               // rtl/src/quadtree/tree.rs:59
    wire [159:0] u_arbiter_into_0_payload_lanes_6;               // rtl/src/quadtree/tree.rs:59
    wire [95:0] u_arbiter_into_0_payload_lanes_7;                // rtl/src/quadtree/tree.rs:59
    wire [159:0] u_arbiter_into_0_payload_lanes_8;               // rtl/src/quadtree/tree.rs:59
    wire [50:0] u_arbiter_into_1_payload_lanes;                  // rtl/src/quadtree/tree.rs:59
    wire [50:0] u_arbiter_into_1_payload_lanes_2;                // rtl/src/quadtree/tree.rs:59
    wire [2:0] u_arbiter_into_1_payload_lanes_3;                 // rtl/src/quadtree/tree.rs:59
    wire [2:0] u_arbiter_into_1_payload_lanes_4;                 // rtl/src/quadtree/tree.rs:59
    wire [159:0] u_arbiter_into_1_payload_lanes_5;               // rtl/src/quadtree/tree.rs:59
    wire [159:0] u_arbiter_into_1_payload_lanes_6;               // rtl/src/quadtree/tree.rs:59
    wire [95:0] u_arbiter_into_1_payload_lanes_7;                // rtl/src/quadtree/tree.rs:59
    wire [159:0] u_arbiter_into_1_payload_lanes_8;               // rtl/src/quadtree/tree.rs:59
    wire [50:0] u_arbiter_into_2_payload_lanes;                  // rtl/src/quadtree/tree.rs:59
    wire [50:0] u_arbiter_into_2_payload_lanes_2;                // rtl/src/quadtree/tree.rs:59
    wire [2:0] u_arbiter_into_2_payload_lanes_3;                 // rtl/src/quadtree/tree.rs:59
    wire [2:0] u_arbiter_into_2_payload_lanes_4;                 // rtl/src/quadtree/tree.rs:59
    wire [159:0] u_arbiter_into_2_payload_lanes_5;               // rtl/src/quadtree/tree.rs:59
    wire [159:0] u_arbiter_into_2_payload_lanes_6;               // rtl/src/quadtree/tree.rs:59
    wire [95:0] u_arbiter_into_2_payload_lanes_7;                // rtl/src/quadtree/tree.rs:59
    wire [159:0] u_arbiter_into_2_payload_lanes_8;               // rtl/src/quadtree/tree.rs:59
    wire [50:0] u_arbiter_into_3_payload_lanes;                  // rtl/src/quadtree/tree.rs:59
    wire [50:0] u_arbiter_into_3_payload_lanes_2;                // rtl/src/quadtree/tree.rs:59
    wire [2:0] u_arbiter_into_3_payload_lanes_3;                 // rtl/src/quadtree/tree.rs:59
    wire [2:0] u_arbiter_into_3_payload_lanes_4;                 // rtl/src/quadtree/tree.rs:59
    wire [159:0] u_arbiter_into_3_payload_lanes_5;               // rtl/src/quadtree/tree.rs:59
    wire [159:0] u_arbiter_into_3_payload_lanes_6;               // rtl/src/quadtree/tree.rs:59
    wire [95:0] u_arbiter_into_3_payload_lanes_7;                // rtl/src/quadtree/tree.rs:59
    wire [159:0] u_arbiter_into_3_payload_lanes_8;               // rtl/src/quadtree/tree.rs:59
    wire u_branch_idle_all;                                      // rtl/src/quadtree/tree.rs:60
    wire [1:0] u_test_parts_ready_joined = {u_test_parts_window_y[1], u_test_parts_window_x[1]}; // rtl/src/quadtree/tree.rs:54
    wire u_test_parts_ready_and = u_test_parts_valid & (u_test_parts_ready_joined == 2'd0); // rtl/src/quadtree/tree.rs:55
    wire u_test_parts_ready_and_3 = u_test_parts_valid & (u_test_parts_ready_joined == 2'd1); // rtl/src/quadtree/tree.rs:55
    wire u_test_parts_ready_and_4 = u_test_parts_valid & (u_test_parts_ready_joined == 2'd2); // rtl/src/quadtree/tree.rs:55
    wire u_test_parts_ready_and_5 = u_test_parts_valid & (u_test_parts_ready_joined == 2'd3); // rtl/src/quadtree/tree.rs:55
    assign parts_polygon_last_edge = u_arbiter_out_payload[744:742]; // rtl/src/quadtree/tree.rs:59
    assign parts_polygon_step_x = u_arbiter_out_payload[741:691]; // rtl/src/quadtree/tree.rs:59
    assign parts_polygon_step_y = u_arbiter_out_payload[690:640]; // rtl/src/quadtree/tree.rs:59
    assign parts_polygon_right = u_arbiter_out_payload[639:637]; // rtl/src/quadtree/tree.rs:59
    assign parts_polygon_lower = u_arbiter_out_payload[636:634]; // rtl/src/quadtree/tree.rs:59
    assign parts_polygon_plane_x = u_arbiter_out_payload[633:474]; // rtl/src/quadtree/tree.rs:59
    assign parts_polygon_plane_y = u_arbiter_out_payload[473:314]; // rtl/src/quadtree/tree.rs:59
    assign parts_window_size = u_arbiter_out_payload[313:312];   // rtl/src/quadtree/tree.rs:59
    assign parts_window_x = u_arbiter_out_payload[311:310];      // rtl/src/quadtree/tree.rs:59
    assign parts_window_y = u_arbiter_out_payload[309:308];      // rtl/src/quadtree/tree.rs:59
    assign parts_window_edges = u_arbiter_out_payload[307:212];  // rtl/src/quadtree/tree.rs:59
    assign parts_window_bounds_left = u_arbiter_out_payload[211:199]; // rtl/src/quadtree/tree.rs:59
    assign parts_window_bounds_top = u_arbiter_out_payload[198:186]; // rtl/src/quadtree/tree.rs:59
    assign parts_window_bounds_right = u_arbiter_out_payload[185:173]; // rtl/src/quadtree/tree.rs:59
    assign parts_window_bounds_bottom = u_arbiter_out_payload[172:160]; // rtl/src/quadtree/tree.rs:59
    assign parts_window_planes = u_arbiter_out_payload[159:0];   // rtl/src/quadtree/tree.rs:59
    assign idle = u_test_idle & u_branch_idle_all;               // rtl/src/quadtree/tree.rs:60

    genvar i;
    genvar j;

    generate
        for (i = 0; i < 4; i = i + 1) begin : u_branch               // rtl/src/quadtree/tree.rs:57
            wire lane_parts_valid;
            wire [2:0] lane_parts_polygon_last_edge;
            wire [50:0] lane_parts_polygon_step_x;
            wire [50:0] lane_parts_polygon_step_y;
            wire [2:0] lane_parts_polygon_right;
            wire [2:0] lane_parts_polygon_lower;
            wire [159:0] lane_parts_polygon_plane_x;
            wire [159:0] lane_parts_polygon_plane_y;
            wire [1:0] lane_parts_window_size;
            wire [1:0] lane_parts_window_x;
            wire [1:0] lane_parts_window_y;
            wire [95:0] lane_parts_window_edges;
            wire [12:0] lane_parts_window_bounds_left;
            wire [12:0] lane_parts_window_bounds_top;
            wire [12:0] lane_parts_window_bounds_right;
            wire [12:0] lane_parts_window_bounds_bottom;
            wire [159:0] lane_parts_window_planes;
            wire lane_idle;
            wire [31:0] lane_tally_0_busy;
            wire [31:0] lane_tally_0_stalled;
            wire [31:0] lane_tally_0_results;
            wire lane_works_ready;
            wire lane_parts_ready;
            case (i)
                0: begin : lane_parts_ready_0 assign lane_parts_ready = u_arbiter_into_0_ready; end
                1: begin : lane_parts_ready_1 assign lane_parts_ready = u_arbiter_into_1_ready; end
                2: begin : lane_parts_ready_2 assign lane_parts_ready = u_arbiter_into_2_ready; end
                default: begin : lane_parts_ready_3 assign lane_parts_ready = u_arbiter_into_3_ready; end
            endcase
            wire lane_works_valid;
            case (i)
                0: begin : lane_works_valid_0 assign lane_works_valid = u_test_parts_ready_and; end
                1: begin : lane_works_valid_1 assign lane_works_valid = u_test_parts_ready_and_3; end
                2: begin : lane_works_valid_2 assign lane_works_valid = u_test_parts_ready_and_4; end
                default: begin : lane_works_valid_3 assign lane_works_valid = u_test_parts_ready_and_5; end
            endcase
            wire [50:0] u_branch_works_polygon_step_x;
            for (j = 0; j < 3; j = j + 1) begin : u_branch_works_polygon_step_x_of
                assign u_branch_works_polygon_step_x[j * 17 +: 17] = u_test_parts_polygon_step_x[j * 17 +: 17];
            end
            wire [50:0] u_branch_works_polygon_step_y;
            for (j = 0; j < 3; j = j + 1) begin : u_branch_works_polygon_step_y_of
                assign u_branch_works_polygon_step_y[j * 17 +: 17] = u_test_parts_polygon_step_y[j * 17 +: 17];
            end
            wire [2:0] u_branch_works_polygon_right;
            for (j = 0; j < 3; j = j + 1) begin : u_branch_works_polygon_right_of
                assign u_branch_works_polygon_right[j] = u_test_parts_polygon_right[j];
            end
            wire [2:0] u_branch_works_polygon_lower;
            for (j = 0; j < 3; j = j + 1) begin : u_branch_works_polygon_lower_of
                assign u_branch_works_polygon_lower[j] = u_test_parts_polygon_lower[j];
            end
            wire [159:0] u_branch_works_polygon_plane_x;
            for (j = 0; j < 4; j = j + 1) begin : u_branch_works_polygon_plane_x_of
                assign u_branch_works_polygon_plane_x[j * 40 +: 40] = u_test_parts_polygon_plane_x[j * 40 +: 40];
            end
            wire [159:0] u_branch_works_polygon_plane_y;
            for (j = 0; j < 4; j = j + 1) begin : u_branch_works_polygon_plane_y_of
                assign u_branch_works_polygon_plane_y[j * 40 +: 40] = u_test_parts_polygon_plane_y[j * 40 +: 40];
            end
            wire [95:0] u_branch_works_window_edges;
            for (j = 0; j < 3; j = j + 1) begin : u_branch_works_window_edges_of
                assign u_branch_works_window_edges[j * 32 +: 32] = u_test_parts_window_edges[j * 32 +: 32];
            end
            wire [159:0] u_branch_works_window_planes;
            for (j = 0; j < 4; j = j + 1) begin : u_branch_works_window_planes_of
                assign u_branch_works_window_planes[j * 40 +: 40] = u_test_parts_window_planes[j * 40 +: 40];
            end

            tree_format8x8_2x2_edges3_test_serial_from1_levels1_queue2 lane (
                .clk                        (clk),
                .rst                        (rst),
                .works_valid                (lane_works_valid),
                .works_polygon_last_edge    (u_test_parts_polygon_last_edge),
                .works_polygon_step_x       (u_branch_works_polygon_step_x),
                .works_polygon_step_y       (u_branch_works_polygon_step_y),
                .works_polygon_right        (u_branch_works_polygon_right),
                .works_polygon_lower        (u_branch_works_polygon_lower),
                .works_polygon_plane_x      (u_branch_works_polygon_plane_x),
                .works_polygon_plane_y      (u_branch_works_polygon_plane_y),
                .works_window_size          (u_test_parts_window_size),
                .works_window_x             (u_test_parts_window_x),
                .works_window_y             (u_test_parts_window_y),
                .works_window_edges         (u_branch_works_window_edges),
                .works_window_bounds_left   (u_test_parts_window_bounds_left),
                .works_window_bounds_top    (u_test_parts_window_bounds_top),
                .works_window_bounds_right  (u_test_parts_window_bounds_right),
                .works_window_bounds_bottom (u_test_parts_window_bounds_bottom),
                .works_window_planes        (u_branch_works_window_planes),
                .parts_ready                (lane_parts_ready),
                .parts_valid                (lane_parts_valid),
                .parts_polygon_last_edge    (lane_parts_polygon_last_edge),
                .parts_polygon_step_x       (lane_parts_polygon_step_x),
                .parts_polygon_step_y       (lane_parts_polygon_step_y),
                .parts_polygon_right        (lane_parts_polygon_right),
                .parts_polygon_lower        (lane_parts_polygon_lower),
                .parts_polygon_plane_x      (lane_parts_polygon_plane_x),
                .parts_polygon_plane_y      (lane_parts_polygon_plane_y),
                .parts_window_size          (lane_parts_window_size),
                .parts_window_x             (lane_parts_window_x),
                .parts_window_y             (lane_parts_window_y),
                .parts_window_edges         (lane_parts_window_edges),
                .parts_window_bounds_left   (lane_parts_window_bounds_left),
                .parts_window_bounds_top    (lane_parts_window_bounds_top),
                .parts_window_bounds_right  (lane_parts_window_bounds_right),
                .parts_window_bounds_bottom (lane_parts_window_bounds_bottom),
                .parts_window_planes        (lane_parts_window_planes),
                .idle                       (lane_idle),
                .tally_0_busy               (lane_tally_0_busy),
                .tally_0_stalled            (lane_tally_0_stalled),
                .tally_0_results            (lane_tally_0_results),
                .works_ready                (lane_works_ready)
            );
        end
    endgenerate

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

    coverage_test_format8x8_2x2_edges3_test_serial_from2_sizes1 u_test ( // rtl/src/quadtree/tree.rs:49
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
        .parts_ready                (u_test_parts_ready_or | (u_test_parts_ready_and_5 & u_branch[3].lane_works_ready)),
        .parts_valid                (u_test_parts_valid),
        .parts_polygon_last_edge    (u_test_parts_polygon_last_edge),
        .parts_polygon_step_x       (u_test_parts_polygon_step_x),
        .parts_polygon_step_y       (u_test_parts_polygon_step_y),
        .parts_polygon_right        (u_test_parts_polygon_right),
        .parts_polygon_lower        (u_test_parts_polygon_lower),
        .parts_polygon_plane_x      (u_test_parts_polygon_plane_x),
        .parts_polygon_plane_y      (u_test_parts_polygon_plane_y),
        .parts_window_size          (u_test_parts_window_size),
        .parts_window_x             (u_test_parts_window_x),
        .parts_window_y             (u_test_parts_window_y),
        .parts_window_edges         (u_test_parts_window_edges),
        .parts_window_bounds_left   (u_test_parts_window_bounds_left),
        .parts_window_bounds_top    (u_test_parts_window_bounds_top),
        .parts_window_bounds_right  (u_test_parts_window_bounds_right),
        .parts_window_bounds_bottom (u_test_parts_window_bounds_bottom),
        .parts_window_planes        (u_test_parts_window_planes),
        .idle                       (u_test_idle),
        .tally_0_busy               (tally_0_busy),
        .tally_0_stalled            (tally_0_stalled),
        .tally_0_results            (tally_0_results),
        .works_ready                (u_test_works_ready)
    );

    arbiter_senders4_width745_turns_round_robin u_arbiter (      // rtl/src/quadtree/tree.rs:59
        .clk            (clk),
        .rst            (rst),
        .into_0_valid   (u_branch[0].lane_parts_valid),
        .into_0_payload ({
            u_branch[0].lane_parts_polygon_last_edge, u_arbiter_into_0_payload_lanes,
            u_arbiter_into_0_payload_lanes_2, u_arbiter_into_0_payload_lanes_3,
            u_arbiter_into_0_payload_lanes_4, u_arbiter_into_0_payload_lanes_5,
            u_arbiter_into_0_payload_lanes_6, u_branch[0].lane_parts_window_size,
            u_branch[0].lane_parts_window_x, u_branch[0].lane_parts_window_y,
            u_arbiter_into_0_payload_lanes_7, u_branch[0].lane_parts_window_bounds_left,
            u_branch[0].lane_parts_window_bounds_top,
            u_branch[0].lane_parts_window_bounds_right,
            u_branch[0].lane_parts_window_bounds_bottom, u_arbiter_into_0_payload_lanes_8
        }),
        .into_1_valid   (u_branch[1].lane_parts_valid),
        .into_1_payload ({
            u_branch[1].lane_parts_polygon_last_edge, u_arbiter_into_1_payload_lanes,
            u_arbiter_into_1_payload_lanes_2, u_arbiter_into_1_payload_lanes_3,
            u_arbiter_into_1_payload_lanes_4, u_arbiter_into_1_payload_lanes_5,
            u_arbiter_into_1_payload_lanes_6, u_branch[1].lane_parts_window_size,
            u_branch[1].lane_parts_window_x, u_branch[1].lane_parts_window_y,
            u_arbiter_into_1_payload_lanes_7, u_branch[1].lane_parts_window_bounds_left,
            u_branch[1].lane_parts_window_bounds_top,
            u_branch[1].lane_parts_window_bounds_right,
            u_branch[1].lane_parts_window_bounds_bottom, u_arbiter_into_1_payload_lanes_8
        }),
        .into_2_valid   (u_branch[2].lane_parts_valid),
        .into_2_payload ({
            u_branch[2].lane_parts_polygon_last_edge, u_arbiter_into_2_payload_lanes,
            u_arbiter_into_2_payload_lanes_2, u_arbiter_into_2_payload_lanes_3,
            u_arbiter_into_2_payload_lanes_4, u_arbiter_into_2_payload_lanes_5,
            u_arbiter_into_2_payload_lanes_6, u_branch[2].lane_parts_window_size,
            u_branch[2].lane_parts_window_x, u_branch[2].lane_parts_window_y,
            u_arbiter_into_2_payload_lanes_7, u_branch[2].lane_parts_window_bounds_left,
            u_branch[2].lane_parts_window_bounds_top,
            u_branch[2].lane_parts_window_bounds_right,
            u_branch[2].lane_parts_window_bounds_bottom, u_arbiter_into_2_payload_lanes_8
        }),
        .into_3_valid   (u_branch[3].lane_parts_valid),
        .into_3_payload ({
            u_branch[3].lane_parts_polygon_last_edge, u_arbiter_into_3_payload_lanes,
            u_arbiter_into_3_payload_lanes_2, u_arbiter_into_3_payload_lanes_3,
            u_arbiter_into_3_payload_lanes_4, u_arbiter_into_3_payload_lanes_5,
            u_arbiter_into_3_payload_lanes_6, u_branch[3].lane_parts_window_size,
            u_branch[3].lane_parts_window_x, u_branch[3].lane_parts_window_y,
            u_arbiter_into_3_payload_lanes_7, u_branch[3].lane_parts_window_bounds_left,
            u_branch[3].lane_parts_window_bounds_top,
            u_branch[3].lane_parts_window_bounds_right,
            u_branch[3].lane_parts_window_bounds_bottom, u_arbiter_into_3_payload_lanes_8
        }),
        .out_ready      (parts_ready),
        .out_valid      (parts_valid),
        .out_payload    (u_arbiter_out_payload),
        .into_0_ready   (u_arbiter_into_0_ready),
        .into_1_ready   (u_arbiter_into_1_ready),
        .into_2_ready   (u_arbiter_into_2_ready),
        .into_3_ready   (u_arbiter_into_3_ready)
    );

    assign u_test_parts_ready_and_2 = u_test_parts_ready_and_3 & u_branch[1].lane_works_ready; // rtl/src/quadtree/tree.rs:55
    assign u_test_parts_ready_or_2 = (u_test_parts_ready_and & u_branch[0].lane_works_ready) | u_test_parts_ready_and_2; // rtl/src/quadtree/tree.rs:55
    assign u_test_parts_ready_or = u_test_parts_ready_or_2 | (u_test_parts_ready_and_4 & u_branch[2].lane_works_ready); // rtl/src/quadtree/tree.rs:55
    generate
        for (i = 0; i < 7; i = i + 1) begin : tally_1_busy_tree
            wire [31:0] value;
            if (i < 4) begin : leaf
                assign value = u_branch[i].lane_tally_0_busy;
            end else begin : pair
                assign value = tally_1_busy_tree[2 * (i - 4)].value + tally_1_busy_tree[2 * (i - 4) + 1].value;
            end
        end
    endgenerate
    assign tally_1_busy = tally_1_busy_tree[6].value;            // rtl/src/quadtree/tree.rs:58
    generate
        for (i = 0; i < 7; i = i + 1) begin : tally_1_stalled_tree
            wire [31:0] value;
            if (i < 4) begin : leaf
                assign value = u_branch[i].lane_tally_0_stalled;
            end else begin : pair
                assign value = tally_1_stalled_tree[2 * (i - 4)].value + tally_1_stalled_tree[2 * (i - 4) + 1].value;
            end
        end
    endgenerate
    assign tally_1_stalled = tally_1_stalled_tree[6].value;      // rtl/src/quadtree/tree.rs:58
    generate
        for (i = 0; i < 7; i = i + 1) begin : tally_1_results_tree
            wire [31:0] value;
            if (i < 4) begin : leaf
                assign value = u_branch[i].lane_tally_0_results;
            end else begin : pair
                assign value = tally_1_results_tree[2 * (i - 4)].value + tally_1_results_tree[2 * (i - 4) + 1].value;
            end
        end
    endgenerate
    assign tally_1_results = tally_1_results_tree[6].value;      // rtl/src/quadtree/tree.rs:58
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_arbiter_into_0_payload_lanes_of
            assign u_arbiter_into_0_payload_lanes[i * 17 +: 17] = u_branch[0].lane_parts_polygon_step_x[i * 17 +: 17];
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_arbiter_into_0_payload_lanes_2_of
            assign u_arbiter_into_0_payload_lanes_2[i * 17 +: 17] = u_branch[0].lane_parts_polygon_step_y[i * 17 +: 17];
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_arbiter_into_0_payload_lanes_3_of
            assign u_arbiter_into_0_payload_lanes_3[i] = u_branch[0].lane_parts_polygon_right[i];
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_arbiter_into_0_payload_lanes_4_of
            assign u_arbiter_into_0_payload_lanes_4[i] = u_branch[0].lane_parts_polygon_lower[i];
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : u_arbiter_into_0_payload_lanes_5_of
            assign u_arbiter_into_0_payload_lanes_5[i * 40 +: 40] = u_branch[0].lane_parts_polygon_plane_x[i * 40 +: 40];
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : u_arbiter_into_0_payload_lanes_6_of
            assign u_arbiter_into_0_payload_lanes_6[i * 40 +: 40] = u_branch[0].lane_parts_polygon_plane_y[i * 40 +: 40];
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_arbiter_into_0_payload_lanes_7_of
            assign u_arbiter_into_0_payload_lanes_7[i * 32 +: 32] = u_branch[0].lane_parts_window_edges[i * 32 +: 32];
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : u_arbiter_into_0_payload_lanes_8_of
            assign u_arbiter_into_0_payload_lanes_8[i * 40 +: 40] = u_branch[0].lane_parts_window_planes[i * 40 +: 40];
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_arbiter_into_1_payload_lanes_of
            assign u_arbiter_into_1_payload_lanes[i * 17 +: 17] = u_branch[1].lane_parts_polygon_step_x[i * 17 +: 17];
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_arbiter_into_1_payload_lanes_2_of
            assign u_arbiter_into_1_payload_lanes_2[i * 17 +: 17] = u_branch[1].lane_parts_polygon_step_y[i * 17 +: 17];
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_arbiter_into_1_payload_lanes_3_of
            assign u_arbiter_into_1_payload_lanes_3[i] = u_branch[1].lane_parts_polygon_right[i];
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_arbiter_into_1_payload_lanes_4_of
            assign u_arbiter_into_1_payload_lanes_4[i] = u_branch[1].lane_parts_polygon_lower[i];
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : u_arbiter_into_1_payload_lanes_5_of
            assign u_arbiter_into_1_payload_lanes_5[i * 40 +: 40] = u_branch[1].lane_parts_polygon_plane_x[i * 40 +: 40];
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : u_arbiter_into_1_payload_lanes_6_of
            assign u_arbiter_into_1_payload_lanes_6[i * 40 +: 40] = u_branch[1].lane_parts_polygon_plane_y[i * 40 +: 40];
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_arbiter_into_1_payload_lanes_7_of
            assign u_arbiter_into_1_payload_lanes_7[i * 32 +: 32] = u_branch[1].lane_parts_window_edges[i * 32 +: 32];
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : u_arbiter_into_1_payload_lanes_8_of
            assign u_arbiter_into_1_payload_lanes_8[i * 40 +: 40] = u_branch[1].lane_parts_window_planes[i * 40 +: 40];
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_arbiter_into_2_payload_lanes_of
            assign u_arbiter_into_2_payload_lanes[i * 17 +: 17] = u_branch[2].lane_parts_polygon_step_x[i * 17 +: 17];
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_arbiter_into_2_payload_lanes_2_of
            assign u_arbiter_into_2_payload_lanes_2[i * 17 +: 17] = u_branch[2].lane_parts_polygon_step_y[i * 17 +: 17];
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_arbiter_into_2_payload_lanes_3_of
            assign u_arbiter_into_2_payload_lanes_3[i] = u_branch[2].lane_parts_polygon_right[i];
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_arbiter_into_2_payload_lanes_4_of
            assign u_arbiter_into_2_payload_lanes_4[i] = u_branch[2].lane_parts_polygon_lower[i];
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : u_arbiter_into_2_payload_lanes_5_of
            assign u_arbiter_into_2_payload_lanes_5[i * 40 +: 40] = u_branch[2].lane_parts_polygon_plane_x[i * 40 +: 40];
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : u_arbiter_into_2_payload_lanes_6_of
            assign u_arbiter_into_2_payload_lanes_6[i * 40 +: 40] = u_branch[2].lane_parts_polygon_plane_y[i * 40 +: 40];
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_arbiter_into_2_payload_lanes_7_of
            assign u_arbiter_into_2_payload_lanes_7[i * 32 +: 32] = u_branch[2].lane_parts_window_edges[i * 32 +: 32];
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : u_arbiter_into_2_payload_lanes_8_of
            assign u_arbiter_into_2_payload_lanes_8[i * 40 +: 40] = u_branch[2].lane_parts_window_planes[i * 40 +: 40];
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_arbiter_into_3_payload_lanes_of
            assign u_arbiter_into_3_payload_lanes[i * 17 +: 17] = u_branch[3].lane_parts_polygon_step_x[i * 17 +: 17];
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_arbiter_into_3_payload_lanes_2_of
            assign u_arbiter_into_3_payload_lanes_2[i * 17 +: 17] = u_branch[3].lane_parts_polygon_step_y[i * 17 +: 17];
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_arbiter_into_3_payload_lanes_3_of
            assign u_arbiter_into_3_payload_lanes_3[i] = u_branch[3].lane_parts_polygon_right[i];
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_arbiter_into_3_payload_lanes_4_of
            assign u_arbiter_into_3_payload_lanes_4[i] = u_branch[3].lane_parts_polygon_lower[i];
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : u_arbiter_into_3_payload_lanes_5_of
            assign u_arbiter_into_3_payload_lanes_5[i * 40 +: 40] = u_branch[3].lane_parts_polygon_plane_x[i * 40 +: 40];
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : u_arbiter_into_3_payload_lanes_6_of
            assign u_arbiter_into_3_payload_lanes_6[i * 40 +: 40] = u_branch[3].lane_parts_polygon_plane_y[i * 40 +: 40];
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_arbiter_into_3_payload_lanes_7_of
            assign u_arbiter_into_3_payload_lanes_7[i * 32 +: 32] = u_branch[3].lane_parts_window_edges[i * 32 +: 32];
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : u_arbiter_into_3_payload_lanes_8_of
            assign u_arbiter_into_3_payload_lanes_8[i * 40 +: 40] = u_branch[3].lane_parts_window_planes[i * 40 +: 40];
        end
    endgenerate
    wire [3:0] u_branch_idle_all_lanes;
    generate
        for (i = 0; i < 4; i = i + 1) begin : u_branch_idle_all_of
            assign u_branch_idle_all_lanes[i] = u_branch[i].lane_idle;
        end
    endgenerate
    assign u_branch_idle_all = &u_branch_idle_all_lanes;         // rtl/src/quadtree/tree.rs:60
endmodule
`default_nettype wire
