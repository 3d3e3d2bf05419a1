// set_up_format8x8_2x2_edges3
//
// Converts a polygon to the root window of one video processor.
//
// Parameters  SetUp { format: "8x8_2x2_edges3" }
// Latency     a polygon takes a clock for each edge, but at least 4
// Source      sparse-raster quadtree generator, figure 1 (MPG-RP, MPG-SPR, MPG-WIN)
// Described   rtl/src/quadtree/set_up.rs:23
`default_nettype none

module set_up_format8x8_2x2_edges3 (
    input  wire         clk,
    input  wire         rst,
    // The polygons to convert.
    input  wire         packets_valid,
    input  wire [2:0]   packets_last_edge,          // The number of the polygon's edges, less one.
    // The edge functions of the polygon; those beyond the last edge are ignored.
    // Coefficient of x: the increase of the edge function per pixel to the right.
    input  wire [50:0]  packets_edges_a,
    // Coefficient of y: the increase of the edge function per line downward.
    input  wire [50:0]  packets_edges_b,
    input  wire [95:0]  packets_edges_c,            // The value of the edge function at the upper left pixel.
    // The attributes of the polygon.
    // Coefficient of x: the increase of the plane per pixel to the right.
    input  wire [159:0] packets_planes_x,
    input  wire [159:0] packets_planes_y,           // Coefficient of y: the increase of the plane per line downward.
    // The value of the plane at the upper left pixel, plus half a unit for rounding.
    input  wire [159:0] packets_planes_origin,
    // The pixels whose centres lie within the extent of the polygon's vertices along each axis.
    input  wire [10:0]  packets_bounds_left,        // The left bound, a column of pixels, or the distance past it.
    input  wire [10:0]  packets_bounds_top,         // The upper bound, a line of pixels, or the distance past it.
    input  wire [10:0]  packets_bounds_right,       // The right bound, a column of pixels, or the distance past it.
    input  wire [10:0]  packets_bounds_bottom,      // The lower bound, a line of pixels, or the distance past it.
    // The outermost pixels of this video processor, widened by half the aperture; constants from `Format::place_of`.
    input  wire [12:0]  place_left,                 // The left bound, a column of pixels, or the distance past it.
    input  wire [12:0]  place_top,                  // The upper bound, a line of pixels, or the distance past it.
    input  wire [12:0]  place_right,                // The right bound, a column of pixels, or the distance past it.
    input  wire [12:0]  place_bottom,               // The lower bound, a line of pixels, or the distance past it.
    input  wire         roots_ready,
    // The window of all samples, for each polygon.
    output wire         roots_valid,
    // The polygon.
    output wire [2:0]   roots_polygon_last_edge,    // The number of the polygon's edges, less one.
    // The step of each edge function per sample along x, as a decrease from its greatest value.
    output wire [50:0]  roots_polygon_step_x,
    // The step of each edge function per sample along y, as a decrease from its greatest value.
    output wire [50:0]  roots_polygon_step_y,
    // Whether each edge function is greatest at the right side of a window.
    output wire [2:0]   roots_polygon_right,
    // Whether each edge function is greatest at the lower side of a window.
    output wire [2:0]   roots_polygon_lower,
    output wire [159:0] roots_polygon_plane_x,      // The increase of each plane per sample to the right.
    output wire [159:0] roots_polygon_plane_y,      // The increase of each plane per sample downward.
    // The window.
    // The binary logarithm of the window's side in samples: n less the level.
    output wire [1:0]   roots_window_size,
    output wire [1:0]   roots_window_x,             // The column of the window's leftmost samples.
    output wire [1:0]   roots_window_y,             // The row of the window's uppermost samples.
    // The greatest value of each edge function in the window; those beyond the polygon's last edge are ignored.
    output wire [95:0]  roots_window_edges,
    // How far the window extends inward past each bound of the polygon, in pixels; negative if it lies outside the
    // bound.
    output wire [12:0]  roots_window_bounds_left,   // The left bound, a column of pixels, or the distance past it.
    output wire [12:0]  roots_window_bounds_top,    // The upper bound, a line of pixels, or the distance past it.
    output wire [12:0]  roots_window_bounds_right,  // The right bound, a column of pixels, or the distance past it.
    output wire [12:0]  roots_window_bounds_bottom, // The lower bound, a line of pixels, or the distance past it.
    output wire [159:0] roots_window_planes,        // The value of each plane at the window's upper left sample.
    output wire         idle,                       // No polygon is under way.
    // The counters of the set-up.
    output wire [31:0]  tally_busy,                 // Clocks in which the unit worked.
    output wire [31:0]  tally_stalled,              // Clocks in which the unit had a result that was not taken.
    output wire [31:0]  tally_results,              // Results that the unit delivered.
    output wire         packets_ready
);

    reg [2:0] step;                                              // rtl/src/quadtree/set_up.rs:51
    reg [31:0] set_up_busy;                                      // rtl/src/quadtree/tally.rs:22
    reg [31:0] set_up_stalled;                                   // rtl/src/quadtree/tally.rs:22
    reg [31:0] set_up_results;                                   // rtl/src/quadtree/tally.rs:22

    wire [16:0] a;                                               // rtl/src/quadtree/set_up.rs:58
    wire [16:0] b;                                               // rtl/src/quadtree/set_up.rs:59
    wire [31:0] value_picked;                                    // rtl/src/quadtree/set_up.rs:70
    wire [39:0] plane_x;                                         // rtl/src/quadtree/set_up.rs:84
    wire [39:0] plane_y;                                         // rtl/src/quadtree/set_up.rs:85
    wire [39:0] plane_picked;                                    // rtl/src/quadtree/set_up.rs:87
    wire is_last = (step >= packets_last_edge) & (step >= 3'd3); // rtl/src/quadtree/set_up.rs:54
    assign packets_ready = is_last & roots_ready;                // rtl/src/quadtree/set_up.rs:116
    wire right = !a[16];                                         // rtl/src/quadtree/set_up.rs:60
    wire lower = !b[16];                                         // rtl/src/quadtree/set_up.rs:61
    wire [29:0] value_product = $signed(a) * $signed(right ? place_right : place_left); // rtl/src/quadtree/set_up.rs:63
    wire [29:0] value_product_2 = $signed(b) * $signed(lower ? place_bottom : place_top); // rtl/src/quadtree/set_up.rs:63
    wire [31:0] value_sum = value_picked + {{2{value_product[29]}}, value_product}; // rtl/src/quadtree/set_up.rs:70
    wire [31:0] value = value_sum + {{2{value_product_2[29]}}, value_product_2}; // rtl/src/quadtree/set_up.rs:70
    wire [43:0] plane_product = {4'd0, plane_x} * {40'd0, place_left[3:0]}; // rtl/src/quadtree/set_up.rs:86
    wire [43:0] plane_product_2 = {4'd0, plane_y} * {40'd0, place_top[3:0]}; // rtl/src/quadtree/set_up.rs:86
    wire [39:0] plane = plane_picked + plane_product[39:0] + plane_product_2[39:0]; // rtl/src/quadtree/set_up.rs:87
    wire [16:0] roots_polygon_step_x_choice_3 = a[16] ? (17'd0 - a) : a; // rtl/src/quadtree/set_up.rs:77
    wire [16:0] roots_polygon_step_y_choice_3 = b[16] ? (17'd0 - b) : b; // rtl/src/quadtree/set_up.rs:77
    assign roots_window_bounds_left = place_right - {2'd0, packets_bounds_left}; // rtl/src/quadtree/set_up.rs:90
    assign roots_window_bounds_top = place_bottom - {2'd0, packets_bounds_top}; // rtl/src/quadtree/set_up.rs:90
    assign roots_window_bounds_right = 13'd0 - (place_left - {2'd0, packets_bounds_right}); // rtl/src/quadtree/set_up.rs:109
    assign roots_window_bounds_bottom = 13'd0 - (place_top - {2'd0, packets_bounds_bottom}); // rtl/src/quadtree/set_up.rs:110
    assign roots_valid = packets_valid & is_last;                // rtl/src/quadtree/set_up.rs:115
    wire roots_taken = roots_valid & roots_ready;                // rtl/src/quadtree/set_up.rs:115
    wire waits = packets_valid & is_last & !roots_taken;         // rtl/src/quadtree/set_up.rs:119
    assign idle = !packets_valid;                                // rtl/src/quadtree/set_up.rs:122

    genvar i;

    generate
        for (i = 0; i < 3; i = i + 1) begin : step_x_row
            reg [16:0] step_x;
            reg [16:0] step_y;
            reg rights;
            reg lowers;
            reg [31:0] edges;
            localparam [31:0] is_edge_listed = i;
            wire is_edge = $signed(is_edge_listed[4:0]) <= $signed({2'd0, packets_last_edge});
            localparam [31:0] roots_polygon_step_x_listed = i;
            wire [16:0] roots_polygon_step_x_choice_2 = (roots_polygon_step_x_listed[2:0] == step) ? {roots_polygon_step_x_choice_3[15:0], 1'b0} : step_x;
            wire [16:0] roots_polygon_step_x_choice = is_edge ? roots_polygon_step_x_choice_2 : 17'd0;
            localparam [31:0] roots_polygon_step_y_listed = i;
            wire [16:0] roots_polygon_step_y_choice_2 = (roots_polygon_step_y_listed[2:0] == step) ? {roots_polygon_step_y_choice_3[15:0], 1'b0} : step_y;
            wire [16:0] roots_polygon_step_y_choice = is_edge ? roots_polygon_step_y_choice_2 : 17'd0;
            localparam [31:0] roots_polygon_right_listed = i;
            wire roots_polygon_right_choice_2 = (roots_polygon_right_listed[2:0] == step) ? right : rights;
            wire roots_polygon_right_choice = is_edge ? roots_polygon_right_choice_2 : 1'b0;
            localparam [31:0] roots_polygon_lower_listed = i;
            wire roots_polygon_lower_choice_2 = (roots_polygon_lower_listed[2:0] == step) ? lower : lowers;
            wire roots_polygon_lower_choice = is_edge ? roots_polygon_lower_choice_2 : 1'b0;
            localparam [31:0] roots_window_edges_listed = i;
            wire [31:0] roots_window_edges_choice_2 = (roots_window_edges_listed[2:0] == step) ? value : edges;
            wire [31:0] roots_window_edges_choice = is_edge ? roots_window_edges_choice_2 : 32'd0;

            always @(posedge clk) begin
                if (packets_valid) begin
                    step_x <= roots_polygon_step_x_choice_2;
                    step_y <= roots_polygon_step_y_choice_2;
                    rights <= roots_polygon_right_choice_2;
                    lowers <= roots_polygon_lower_choice_2;
                    edges <= roots_window_edges_choice_2;
                end
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : plane_xs_row
            reg [39:0] plane_xs;
            localparam [31:0] roots_polygon_plane_x_listed = i;
            wire [39:0] roots_polygon_plane_x_choice = (roots_polygon_plane_x_listed[2:0] == step) ? {plane_x[38:0], 1'b0} : plane_xs;

            always @(posedge clk) begin
                if (packets_valid) plane_xs <= roots_polygon_plane_x_choice;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : plane_ys_row
            reg [39:0] plane_ys;
            localparam [31:0] roots_polygon_plane_y_listed = i;
            wire [39:0] roots_polygon_plane_y_choice = (roots_polygon_plane_y_listed[2:0] == step) ? {plane_y[38:0], 1'b0} : plane_ys;

            always @(posedge clk) begin
                if (packets_valid) plane_ys <= roots_polygon_plane_y_choice;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : planes_row
            reg [39:0] planes;
            localparam [31:0] roots_window_planes_listed = i;
            wire [39:0] roots_window_planes_choice = (roots_window_planes_listed[2:0] == step) ? plane : planes;

            always @(posedge clk) begin
                if (packets_valid) planes <= roots_window_planes_choice;
            end
        end
    endgenerate

    wire [16:0] a_lanes [0:2];
    generate
        for (i = 0; i < 3; i = i + 1) begin : a_of
            assign a_lanes[i] = packets_edges_a[i * 17 +: 17];
        end
    endgenerate
    assign a = (step < 3'd3) ? a_lanes[step[1:0]] : 17'd0;       // rtl/src/quadtree/set_up.rs:58
    wire [16:0] b_lanes [0:2];
    generate
        for (i = 0; i < 3; i = i + 1) begin : b_of
            assign b_lanes[i] = packets_edges_b[i * 17 +: 17];
        end
    endgenerate
    assign b = (step < 3'd3) ? b_lanes[step[1:0]] : 17'd0;       // rtl/src/quadtree/set_up.rs:59
    assign value_picked = (step < 3'd3) ? packets_edges_c[step[1:0] * 32 +: 32] : 32'd0; // rtl/src/quadtree/set_up.rs:70
    wire [39:0] plane_x_lanes [0:3];
    generate
        for (i = 0; i < 4; i = i + 1) begin : plane_x_of
            assign plane_x_lanes[i] = packets_planes_x[i * 40 +: 40];
        end
    endgenerate
    assign plane_x = (step < 3'd4) ? plane_x_lanes[step[1:0]] : 40'd0; // rtl/src/quadtree/set_up.rs:84
    wire [39:0] plane_y_lanes [0:3];
    generate
        for (i = 0; i < 4; i = i + 1) begin : plane_y_of
            assign plane_y_lanes[i] = packets_planes_y[i * 40 +: 40];
        end
    endgenerate
    assign plane_y = (step < 3'd4) ? plane_y_lanes[step[1:0]] : 40'd0; // rtl/src/quadtree/set_up.rs:85
    wire [39:0] plane_picked_lanes [0:3];
    generate
        for (i = 0; i < 4; i = i + 1) begin : plane_picked_of
            assign plane_picked_lanes[i] = packets_planes_origin[i * 40 +: 40];
        end
    endgenerate
    assign plane_picked = (step < 3'd4) ? plane_picked_lanes[step[1:0]] : 40'd0; // rtl/src/quadtree/set_up.rs:87
    generate
        for (i = 0; i < 3; i = i + 1) begin : roots_polygon_step_x_of
            assign roots_polygon_step_x[i * 17 +: 17] = step_x_row[i].roots_polygon_step_x_choice;
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : roots_polygon_step_y_of
            assign roots_polygon_step_y[i * 17 +: 17] = step_x_row[i].roots_polygon_step_y_choice;
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : roots_polygon_right_of
            assign roots_polygon_right[i] = step_x_row[i].roots_polygon_right_choice;
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : roots_polygon_lower_of
            assign roots_polygon_lower[i] = step_x_row[i].roots_polygon_lower_choice;
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : roots_polygon_plane_x_of
            assign roots_polygon_plane_x[i * 40 +: 40] = plane_xs_row[i].roots_polygon_plane_x_choice;
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : roots_polygon_plane_y_of
            assign roots_polygon_plane_y[i * 40 +: 40] = plane_ys_row[i].roots_polygon_plane_y_choice;
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : roots_window_edges_of
            assign roots_window_edges[i * 32 +: 32] = step_x_row[i].roots_window_edges_choice;
        end
    endgenerate
    generate
        for (i = 0; i < 4; i = i + 1) begin : roots_window_planes_of
            assign roots_window_planes[i * 40 +: 40] = planes_row[i].roots_window_planes_choice;
        end
    endgenerate

    always @(posedge clk) begin
        if (rst) begin
            step <= 3'd0;
            set_up_busy <= 32'd0;
            set_up_stalled <= 32'd0;
            set_up_results <= 32'd0;
        end else begin
            if (roots_taken) step <= 3'd0;
            else if (packets_valid & !is_last) step <= step + 3'd1;
            if (packets_valid & !waits) set_up_busy <= set_up_busy + 32'd1;
            if (waits) set_up_stalled <= set_up_stalled + 32'd1;
            if (roots_taken) set_up_results <= set_up_results + 32'd1;
        end
    end

    assign roots_polygon_last_edge = packets_last_edge;
    assign roots_window_size = 2'd2;
    assign roots_window_x = 2'd0;
    assign roots_window_y = 2'd0;
    assign tally_busy = set_up_busy;
    assign tally_stalled = set_up_stalled;
    assign tally_results = set_up_results;

    wire _unused_ok = &{1'b0, plane_product[43:40], plane_product_2[43:40],
            roots_polygon_step_x_choice_3[16], roots_polygon_step_y_choice_3[16]};
endmodule
`default_nettype wire
