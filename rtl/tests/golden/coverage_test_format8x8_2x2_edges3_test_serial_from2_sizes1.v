// coverage_test_format8x8_2x2_edges3_test_serial_from2_sizes1
//
// Tests the quarters of windows, and sends on those that their polygon may cover.
//
// Parameters  CoverageTest { format: "8x8_2x2_edges3", test: Serial, from: 2, sizes: 1 }
// Latency     a window takes a clock for each edge of each quarter, and 4 for each quarter that passes
// Source      sparse-raster quadtree generator, equation 5 (MPG-EQ5, MPG-WIN)
// Described   rtl/src/quadtree/coverage_test.rs:45
`default_nettype none

module coverage_test_format8x8_2x2_edges3_test_serial_from2_sizes1 (
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

    reg busy;                                                    // rtl/src/quadtree/coverage_test.rs:68
    reg [2:0] held_polygon_last_edge;                            // rtl/src/quadtree/coverage_test.rs:69
    reg [1:0] held_window_size;                                  // rtl/src/quadtree/coverage_test.rs:69
    reg [1:0] held_window_x;                                     // rtl/src/quadtree/coverage_test.rs:69
    reg [1:0] held_window_y;                                     // rtl/src/quadtree/coverage_test.rs:69
    reg [12:0] held_window_bounds_left;                          // rtl/src/quadtree/coverage_test.rs:69
    reg [12:0] held_window_bounds_top;                           // rtl/src/quadtree/coverage_test.rs:69
    reg [12:0] held_window_bounds_right;                         // rtl/src/quadtree/coverage_test.rs:69
    reg [12:0] held_window_bounds_bottom;                        // rtl/src/quadtree/coverage_test.rs:69
    reg [1:0] number;                                            // rtl/src/quadtree/coverage_test.rs:70
    reg moves;                                                   // rtl/src/quadtree/coverage_test.rs:71
    reg [2:0] step;                                              // rtl/src/quadtree/coverage_test.rs:72
    reg outside;                                                 // rtl/src/quadtree/coverage_test.rs:137
    reg [31:0] size2_busy;                                       // rtl/src/quadtree/tally.rs:22
    reg [31:0] size2_stalled;                                    // rtl/src/quadtree/tally.rs:22
    reg [31:0] size2_results;                                    // rtl/src/quadtree/tally.rs:22

    wire [31:0] edge_of_window;                                  // rtl/src/quadtree/coverage_test.rs:129
    wire right;                                                  // rtl/src/quadtree/coverage_test.rs:132
    wire [16:0] step_x;                                          // rtl/src/quadtree/coverage_test.rs:130
    wire lower;                                                  // rtl/src/quadtree/coverage_test.rs:133
    wire [16:0] step_y;                                          // rtl/src/quadtree/coverage_test.rs:131
    wire [39:0] plane_of_window;                                 // rtl/src/quadtree/coverage_test.rs:89
    wire [39:0] plane_x;                                         // rtl/src/quadtree/coverage_test.rs:90
    wire [39:0] plane_y;                                         // rtl/src/quadtree/coverage_test.rs:91
    wire tests = busy & !moves;                                  // rtl/src/quadtree/coverage_test.rs:80
    wire is_last = step == held_polygon_last_edge;               // rtl/src/quadtree/coverage_test.rs:136
    wire [31:0] value_choice = (right == number[0]) ? 32'd0 : {14'd0, step_x, 1'b0}; // rtl/src/quadtree/coverage_test.rs:160
    wire [31:0] value_choice_2 = (lower == number[1]) ? 32'd0 : {14'd0, step_y, 1'b0}; // rtl/src/quadtree/coverage_test.rs:160
    wire [31:0] value = edge_of_window - value_choice - value_choice_2; // rtl/src/quadtree/coverage_test.rs:134
    wire is_outside = outside | value[31];                       // rtl/src/quadtree/coverage_test.rs:138
    assign parts_window_bounds_left = held_window_bounds_left - (number[0] ? 13'd0 : 13'd4); // rtl/src/quadtree/format.rs:347
    assign parts_window_bounds_top = held_window_bounds_top - (number[1] ? 13'd0 : 13'd4); // rtl/src/quadtree/format.rs:347
    wire misses_or_2 = parts_window_bounds_left[12] | parts_window_bounds_top[12]; // rtl/src/quadtree/format.rs:361
    assign parts_window_bounds_right = held_window_bounds_right - (!number[0] ? 13'd0 : 13'd4); // rtl/src/quadtree/format.rs:347
    wire misses_or = misses_or_2 | parts_window_bounds_right[12]; // rtl/src/quadtree/format.rs:361
    assign parts_window_bounds_bottom = held_window_bounds_bottom - (!number[1] ? 13'd0 : 13'd4); // rtl/src/quadtree/format.rs:347
    wire misses = is_outside | (misses_or | parts_window_bounds_bottom[12]); // rtl/src/quadtree/coverage_test.rs:83
    wire fails = tests & is_last & misses;                       // rtl/src/quadtree/coverage_test.rs:85
    wire ready = moves & (step == 3'd3);                         // rtl/src/quadtree/coverage_test.rs:94
    wire parts_taken = ready & parts_ready;                      // rtl/src/quadtree/coverage_test.rs:98
    wire ends_quarter = fails | parts_taken;                     // rtl/src/quadtree/coverage_test.rs:100
    wire ends = ends_quarter & (&number);                        // rtl/src/quadtree/coverage_test.rs:101
    assign works_ready = !busy | ends;                           // rtl/src/quadtree/coverage_test.rs:102
    wire passes = tests & is_last & !misses;                     // rtl/src/quadtree/coverage_test.rs:84
    wire [39:0] plane_choice = number[0] ? {plane_x[38:0], 1'b0} : 40'd0; // rtl/src/quadtree/coverage_test.rs:88
    wire [39:0] plane_choice_2 = number[1] ? {plane_y[38:0], 1'b0} : 40'd0; // rtl/src/quadtree/coverage_test.rs:88
    wire [39:0] plane = plane_of_window + plane_choice + plane_choice_2; // rtl/src/quadtree/coverage_test.rs:92
    assign parts_window_x = held_window_x | {number[0], 1'b0};   // rtl/src/quadtree/coverage_test.rs:95
    assign parts_window_y = held_window_y | {number[1], 1'b0};   // rtl/src/quadtree/coverage_test.rs:95
    wire works_taken = works_valid & works_ready;                // rtl/src/quadtree/coverage_test.rs:102
    wire waits = ready & !parts_taken;                           // rtl/src/quadtree/coverage_test.rs:109
    assign idle = !busy & !works_valid;                          // rtl/src/quadtree/coverage_test.rs:115

    genvar i;

    generate
        for (i = 0; i < 3; i = i + 1) begin : edges_row
            reg [31:0] edges;
            localparam [31:0] edges_listed = i;

            always @(posedge clk) begin
                if (tests) begin
                    if (edges_listed[2:0] == step) edges <= value;
                end
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : planes_row
            reg [39:0] planes;
            localparam [31:0] parts_window_planes_listed = i;
            wire [39:0] parts_window_planes_choice = (parts_window_planes_listed[2:0] == step) ? plane : planes;

            always @(posedge clk) begin
                if (moves) planes <= parts_window_planes_choice;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 3; i = i + 1) begin : held_polygon_step_x_row
            reg [16:0] held_polygon_step_x;

            always @(posedge clk) begin
                if (works_taken) held_polygon_step_x <= works_polygon_step_x[i * 17 +: 17];
            end
        end
    endgenerate

    generate
        for (i = 0; i < 3; i = i + 1) begin : held_polygon_step_y_row
            reg [16:0] held_polygon_step_y;

            always @(posedge clk) begin
                if (works_taken) held_polygon_step_y <= works_polygon_step_y[i * 17 +: 17];
            end
        end
    endgenerate

    generate
        for (i = 0; i < 3; i = i + 1) begin : held_polygon_right_row
            reg held_polygon_right;

            always @(posedge clk) begin
                if (works_taken) held_polygon_right <= works_polygon_right[i];
            end
        end
    endgenerate

    generate
        for (i = 0; i < 3; i = i + 1) begin : held_polygon_lower_row
            reg held_polygon_lower;

            always @(posedge clk) begin
                if (works_taken) held_polygon_lower <= works_polygon_lower[i];
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : held_polygon_plane_x_row
            reg [39:0] held_polygon_plane_x;

            always @(posedge clk) begin
                if (works_taken) begin
                    held_polygon_plane_x <= works_polygon_plane_x[i * 40 +: 40];
                end
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : held_polygon_plane_y_row
            reg [39:0] held_polygon_plane_y;

            always @(posedge clk) begin
                if (works_taken) begin
                    held_polygon_plane_y <= works_polygon_plane_y[i * 40 +: 40];
                end
            end
        end
    endgenerate

    generate
        for (i = 0; i < 3; i = i + 1) begin : held_window_edges_row
            reg [31:0] held_window_edges;

            always @(posedge clk) begin
                if (works_taken) held_window_edges <= works_window_edges[i * 32 +: 32];
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : held_window_planes_row
            reg [39:0] held_window_planes;

            always @(posedge clk) begin
                if (works_taken) held_window_planes <= works_window_planes[i * 40 +: 40];
            end
        end
    endgenerate

    wire [31:0] edge_of_window_lanes [0:2];
    generate
        for (i = 0; i < 3; i = i + 1) begin : edge_of_window_of
            assign edge_of_window_lanes[i] = held_window_edges_row[i].held_window_edges;
        end
    endgenerate
    assign edge_of_window = (step < 3'd3) ? edge_of_window_lanes[step[1:0]] : 32'd0; // rtl/src/quadtree/coverage_test.rs:129
    wire [2:0] right_lanes;
    generate
        for (i = 0; i < 3; i = i + 1) begin : right_of
            assign right_lanes[i] = held_polygon_right_row[i].held_polygon_right;
        end
    endgenerate
    assign right = (step < 3'd3) ? right_lanes[step[1:0]] : 1'b0; // rtl/src/quadtree/coverage_test.rs:132
    wire [16:0] step_x_lanes [0:2];
    generate
        for (i = 0; i < 3; i = i + 1) begin : step_x_of
            assign step_x_lanes[i] = held_polygon_step_x_row[i].held_polygon_step_x;
        end
    endgenerate
    assign step_x = (step < 3'd3) ? step_x_lanes[step[1:0]] : 17'd0; // rtl/src/quadtree/coverage_test.rs:130
    wire [2:0] lower_lanes;
    generate
        for (i = 0; i < 3; i = i + 1) begin : lower_of
            assign lower_lanes[i] = held_polygon_lower_row[i].held_polygon_lower;
        end
    endgenerate
    assign lower = (step < 3'd3) ? lower_lanes[step[1:0]] : 1'b0; // rtl/src/quadtree/coverage_test.rs:133
    wire [16:0] step_y_lanes [0:2];
    generate
        for (i = 0; i < 3; i = i + 1) begin : step_y_of
            assign step_y_lanes[i] = held_polygon_step_y_row[i].held_polygon_step_y;
        end
    endgenerate
    assign step_y = (step < 3'd3) ? step_y_lanes[step[1:0]] : 17'd0; // rtl/src/quadtree/coverage_test.rs:131
    wire [39:0] plane_of_window_lanes [0:3];
    generate
        for (i = 0; i < 4; i = i + 1) begin : plane_of_window_of
            assign plane_of_window_lanes[i] = held_window_planes_row[i].held_window_planes;
        end
    endgenerate
    assign plane_of_window = (step < 3'd4) ? plane_of_window_lanes[step[1:0]] : 40'd0; // rtl/src/quadtree/coverage_test.rs:89
    wire [39:0] plane_x_lanes [0:3];
    generate
        for (i = 0; i < 4; i = i + 1) begin : plane_x_of
            assign plane_x_lanes[i] = held_polygon_plane_x_row[i].held_polygon_plane_x;
        end
    endgenerate
    assign plane_x = (step < 3'd4) ? plane_x_lanes[step[1:0]] : 40'd0; // rtl/src/quadtree/coverage_test.rs:90
    wire [39:0] plane_y_lanes [0:3];
    generate
        for (i = 0; i < 4; i = i + 1) begin : plane_y_of
            assign plane_y_lanes[i] = held_polygon_plane_y_row[i].held_polygon_plane_y;
        end
    endgenerate
    assign plane_y = (step < 3'd4) ? plane_y_lanes[step[1:0]] : 40'd0; // rtl/src/quadtree/coverage_test.rs:91
    generate
        for (i = 0; i < 3; i = i + 1) begin : parts_polygon_step_x_of
            assign parts_polygon_step_x[i * 17 +: 17] = held_polygon_step_x_row[i].held_polygon_step_x;
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : parts_polygon_step_y_of
            assign parts_polygon_step_y[i * 17 +: 17] = held_polygon_step_y_row[i].held_polygon_step_y;
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : parts_polygon_right_of
            assign parts_polygon_right[i] = held_polygon_right_row[i].held_polygon_right;
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : parts_polygon_lower_of
            assign parts_polygon_lower[i] = held_polygon_lower_row[i].held_polygon_lower;
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : parts_polygon_plane_x_of
            assign parts_polygon_plane_x[i * 40 +: 40] = held_polygon_plane_x_row[i].held_polygon_plane_x;
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : parts_polygon_plane_y_of
            assign parts_polygon_plane_y[i * 40 +: 40] = held_polygon_plane_y_row[i].held_polygon_plane_y;
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : parts_window_edges_of
            assign parts_window_edges[i * 32 +: 32] = edges_row[i].edges;
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : parts_window_planes_of
            assign parts_window_planes[i * 40 +: 40] = planes_row[i].parts_window_planes_choice;
        end
    endgenerate

    always @(posedge clk) begin
        if (works_taken) begin
            held_polygon_last_edge <= works_polygon_last_edge;
            held_window_size <= works_window_size;
            held_window_x <= works_window_x;
            held_window_y <= works_window_y;
            held_window_bounds_left <= works_window_bounds_left;
            held_window_bounds_top <= works_window_bounds_top;
            held_window_bounds_right <= works_window_bounds_right;
            held_window_bounds_bottom <= works_window_bounds_bottom;
        end
    end

    always @(posedge clk) begin
        if (rst) begin
            busy <= 1'b0;
            number <= 2'd0;
            moves <= 1'b0;
            step <= 3'd0;
            outside <= 1'b0;
            size2_busy <= 32'd0;
            size2_stalled <= 32'd0;
            size2_results <= 32'd0;
        end else begin
            if (works_taken) busy <= 1'b1;
            else if (ends) busy <= 1'b0;
            if (ends_quarter) number <= number + 2'd1;
            if (passes) moves <= 1'b1;
            else if (parts_taken) moves <= 1'b0;
            if (passes | ends_quarter) step <= 3'd0;
            else if (busy & !ready) step <= step + 3'd1;
            if (tests) outside <= is_outside & !is_last;
            if (busy & !waits) size2_busy <= size2_busy + 32'd1;
            if (waits) size2_stalled <= size2_stalled + 32'd1;
            if (parts_taken) size2_results <= size2_results + 32'd1;
        end
    end

    assign parts_valid = ready;
    assign parts_polygon_last_edge = held_polygon_last_edge;
    assign parts_window_size = 2'd1;
    assign tally_0_busy = size2_busy;
    assign tally_0_stalled = size2_stalled;
    assign tally_0_results = size2_results;

    wire _unused_ok = &{1'b0, held_window_size, plane_x[39], plane_y[39]};
endmodule
`default_nettype wire
