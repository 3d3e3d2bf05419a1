// stack_format8x8_2x2_edges3_test_serial_from2_levels2
//
// Divides windows down to a size, with one unit and a stack.
//
// Parameters  Stack { format: "8x8_2x2_edges3", test: Serial, from: 2, levels: 2 }
// Latency     the clocks of all windows of a polygon, one after another
// Source      sparse-raster quadtree generator, equation 6 (MPG-RP, MPG-EQ6)
// Described   rtl/src/quadtree/stack.rs:23
`default_nettype none

module stack_format8x8_2x2_edges3_test_serial_from2_levels2 (
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

    reg [1:0] used;                                              // rtl/src/quadtree/stack.rs:60

    (* no_rw_check *)
    reg [313:0] windows [0:3];                                   // rtl/src/quadtree/stack.rs:59
    reg [313:0] windows_read;                                    // rtl/src/quadtree/stack.rs:66

    wire u_test_parts_valid;                                     // rtl/src/quadtree/stack.rs:46
    wire u_test_works_ready;                                     // rtl/src/quadtree/stack.rs:46

    wire [50:0] u_test_works_polygon_step_x;                     // rtl/src/quadtree/stack.rs:44
    wire [50:0] u_test_works_polygon_step_y;                     // rtl/src/quadtree/stack.rs:44
    wire [2:0] u_test_works_polygon_right;                       // rtl/src/quadtree/stack.rs:44
    wire [2:0] u_test_works_polygon_lower;                       // rtl/src/quadtree/stack.rs:44
    wire [159:0] u_test_works_polygon_plane_x;                   // rtl/src/quadtree/stack.rs:44
    wire [159:0] u_test_works_polygon_plane_y;                   // rtl/src/quadtree/stack.rs:44
    wire [95:0] u_test_works_window_edges;                       // rtl/src/quadtree/stack.rs:44
    wire [159:0] u_test_works_window_planes;                     // rtl/src/quadtree/stack.rs:44
    wire is_empty = used == 2'd0;                                // rtl/src/quadtree/stack.rs:69
    wire is_done = parts_window_size == 2'd0;                    // rtl/src/quadtree/stack.rs:50
    wire comes_back = u_test_parts_valid & !is_done;             // rtl/src/quadtree/stack.rs:53
    wire is_new = is_empty & !comes_back;                        // rtl/src/quadtree/stack.rs:71
    assign works_ready = is_new & u_test_works_ready;            // rtl/src/quadtree/stack.rs:73
    wire next_valid = !is_new | works_valid;                     // rtl/src/quadtree/stack.rs:44
    wire [2:0] next_polygon_last_edge = is_new ? works_polygon_last_edge : parts_polygon_last_edge; // rtl/src/quadtree/stack.rs:44
    wire [1:0] next_window_size_choice = comes_back ? parts_window_size : windows_read[313:312]; // rtl/src/quadtree/stack.rs:70
    wire [1:0] next_window_size = is_new ? works_window_size : next_window_size_choice; // rtl/src/quadtree/stack.rs:44
    wire [1:0] next_window_x_choice = comes_back ? parts_window_x : windows_read[311:310]; // rtl/src/quadtree/stack.rs:70
    wire [1:0] next_window_x = is_new ? works_window_x : next_window_x_choice; // rtl/src/quadtree/stack.rs:44
    wire [1:0] next_window_y_choice = comes_back ? parts_window_y : windows_read[309:308]; // rtl/src/quadtree/stack.rs:70
    wire [1:0] next_window_y = is_new ? works_window_y : next_window_y_choice; // rtl/src/quadtree/stack.rs:44
    wire [95:0] windows_read_307_212 = windows_read[307:212];    // rtl/src/quadtree/stack.rs:68
    wire [12:0] next_window_bounds_left_choice = comes_back ? parts_window_bounds_left : windows_read[211:199]; // rtl/src/quadtree/stack.rs:70
    wire [12:0] next_window_bounds_left = is_new ? works_window_bounds_left : next_window_bounds_left_choice; // rtl/src/quadtree/stack.rs:44
    wire [12:0] next_window_bounds_top_choice = comes_back ? parts_window_bounds_top : windows_read[198:186]; // rtl/src/quadtree/stack.rs:70
    wire [12:0] next_window_bounds_top = is_new ? works_window_bounds_top : next_window_bounds_top_choice; // rtl/src/quadtree/stack.rs:44
    wire [12:0] next_window_bounds_right_choice = comes_back ? parts_window_bounds_right : windows_read[185:173]; // rtl/src/quadtree/stack.rs:70
    wire [12:0] next_window_bounds_right = is_new ? works_window_bounds_right : next_window_bounds_right_choice; // rtl/src/quadtree/stack.rs:44
    wire [12:0] next_window_bounds_bottom_choice = comes_back ? parts_window_bounds_bottom : windows_read[172:160]; // rtl/src/quadtree/stack.rs:70
    wire [12:0] next_window_bounds_bottom = is_new ? works_window_bounds_bottom : next_window_bounds_bottom_choice; // rtl/src/quadtree/stack.rs:44
    wire [159:0] windows_read_159_0 = windows_read[159:0];       // rtl/src/quadtree/stack.rs:68
    assign parts_valid = u_test_parts_valid & is_done;           // rtl/src/quadtree/stack.rs:51
    wire [1:0] windows_read_address = used - 2'd1;               // rtl/src/quadtree/stack.rs:62
    wire pushes_and = next_valid & u_test_works_ready;           // rtl/src/quadtree/stack.rs:72
    wire pushes = comes_back & !pushes_and;                      // rtl/src/quadtree/stack.rs:76
    wire pops = pushes_and & !comes_back & !is_empty;            // rtl/src/quadtree/stack.rs:77
    wire past_next = used == 2'd3;                               // rtl/src/quadtree/stack.rs:81

    genvar i;

    generate
        for (i = 0; i < 3; i = i + 1) begin : next_polygon_step_x_row
            wire [16:0] next_polygon_step_x = is_new ? works_polygon_step_x[i * 17 +: 17] : parts_polygon_step_x[i * 17 +: 17];
        end
    endgenerate

    generate
        for (i = 0; i < 3; i = i + 1) begin : next_polygon_step_y_row
            wire [16:0] next_polygon_step_y = is_new ? works_polygon_step_y[i * 17 +: 17] : parts_polygon_step_y[i * 17 +: 17];
        end
    endgenerate

    generate
        for (i = 0; i < 3; i = i + 1) begin : next_polygon_right_row
            wire next_polygon_right = is_new ? works_polygon_right[i] : parts_polygon_right[i];
        end
    endgenerate

    generate
        for (i = 0; i < 3; i = i + 1) begin : next_polygon_lower_row
            wire next_polygon_lower = is_new ? works_polygon_lower[i] : parts_polygon_lower[i];
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : next_polygon_plane_x_row
            wire [39:0] next_polygon_plane_x = is_new ? works_polygon_plane_x[i * 40 +: 40] : parts_polygon_plane_x[i * 40 +: 40];
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : next_polygon_plane_y_row
            wire [39:0] next_polygon_plane_y = is_new ? works_polygon_plane_y[i * 40 +: 40] : parts_polygon_plane_y[i * 40 +: 40];
        end
    endgenerate

    generate
        for (i = 0; i < 3; i = i + 1) begin : next_window_edges_row
            wire [31:0] next_window_edges_choice = comes_back ? parts_window_edges[i * 32 +: 32] : windows_read_307_212[i * 32 +: 32];
            wire [31:0] next_window_edges = is_new ? works_window_edges[i * 32 +: 32] : next_window_edges_choice;
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : next_window_planes_row
            wire [39:0] next_window_planes_choice = comes_back ? parts_window_planes[i * 40 +: 40] : windows_read_159_0[i * 40 +: 40];
            wire [39:0] next_window_planes = is_new ? works_window_planes[i * 40 +: 40] : next_window_planes_choice;
        end
    endgenerate

    coverage_test_format8x8_2x2_edges3_test_serial_from2_sizes2 u_test ( // rtl/src/quadtree/stack.rs:46
        .clk                        (clk),
        .rst                        (rst),
        .works_valid                (next_valid),
        .works_polygon_last_edge    (next_polygon_last_edge),
        .works_polygon_step_x       (u_test_works_polygon_step_x),
        .works_polygon_step_y       (u_test_works_polygon_step_y),
        .works_polygon_right        (u_test_works_polygon_right),
        .works_polygon_lower        (u_test_works_polygon_lower),
        .works_polygon_plane_x      (u_test_works_polygon_plane_x),
        .works_polygon_plane_y      (u_test_works_polygon_plane_y),
        .works_window_size          (next_window_size),
        .works_window_x             (next_window_x),
        .works_window_y             (next_window_y),
        .works_window_edges         (u_test_works_window_edges),
        .works_window_bounds_left   (next_window_bounds_left),
        .works_window_bounds_top    (next_window_bounds_top),
        .works_window_bounds_right  (next_window_bounds_right),
        .works_window_bounds_bottom (next_window_bounds_bottom),
        .works_window_planes        (u_test_works_window_planes),
        .parts_ready                (!is_done | parts_ready),
        .parts_valid                (u_test_parts_valid),
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
        .works_ready                (u_test_works_ready)
    );

    generate
        for (i = 0; i < 3; i = i + 1) begin : u_test_works_polygon_step_x_of
            assign u_test_works_polygon_step_x[i * 17 +: 17] = next_polygon_step_x_row[i].next_polygon_step_x;
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_test_works_polygon_step_y_of
            assign u_test_works_polygon_step_y[i * 17 +: 17] = next_polygon_step_y_row[i].next_polygon_step_y;
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_test_works_polygon_right_of
            assign u_test_works_polygon_right[i] = next_polygon_right_row[i].next_polygon_right;
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_test_works_polygon_lower_of
            assign u_test_works_polygon_lower[i] = next_polygon_lower_row[i].next_polygon_lower;
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : u_test_works_polygon_plane_x_of
            assign u_test_works_polygon_plane_x[i * 40 +: 40] = next_polygon_plane_x_row[i].next_polygon_plane_x;
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : u_test_works_polygon_plane_y_of
            assign u_test_works_polygon_plane_y[i * 40 +: 40] = next_polygon_plane_y_row[i].next_polygon_plane_y;
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_test_works_window_edges_of
            assign u_test_works_window_edges[i * 32 +: 32] = next_window_edges_row[i].next_window_edges;
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : u_test_works_window_planes_of
            assign u_test_works_window_planes[i * 40 +: 40] = next_window_planes_row[i].next_window_planes;
        end
    endgenerate

    always @(posedge clk) begin
        if (pushes) begin
            windows[used] <= {
                parts_window_size, parts_window_x, parts_window_y, parts_window_edges,
                parts_window_bounds_left, parts_window_bounds_top, parts_window_bounds_right,
                parts_window_bounds_bottom, parts_window_planes
            };
        end
        windows_read <= windows[windows_read_address];
    end

    always @(posedge clk) begin
        if (rst) used <= 2'd0;
        else if (pushes) used <= used + 2'd1;
        else if (pops) used <= used - 2'd1;
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
    reg past;                                                    // rtl/src/quadtree/stack.rs:81
    reg has_past;                                                // rtl/src/quadtree/stack.rs:81

    initial has_past = 1'b0;

    always @(posedge clk) begin
        past <= past_next;
    end

    always @(posedge clk) begin
        if (rst) has_past <= 1'b0;
        else has_past <= 1'b1;
    end

`ifdef FORMAL
    always @(posedge clk) begin
        if (!rst) assert (!pushes | (used != 2'd3));                 // rtl/src/quadtree/stack.rs:80
        if (!rst) cover (has_past & (past_next & !past));            // rtl/src/quadtree/stack.rs:81
    end
`else
    reg is_covered;
    initial is_covered = 1'b0;
    always @(posedge clk) begin
        if (!rst && !(!pushes | (used != 2'd3))) begin               // rtl/src/quadtree/stack.rs:80
            $display("FAIL: time %0t: %m: the stack stores at most three windows of each size", $time);
            stop;
        end
        if (!rst && (has_past & (past_next & !past)) && !is_covered) begin // rtl/src/quadtree/stack.rs:81
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: the stack is full", $time);
            `endif
            is_covered <= 1'b1;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, past_next};
endmodule
`default_nettype wire
