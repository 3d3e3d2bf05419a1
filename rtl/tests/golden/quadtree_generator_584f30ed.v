// quadtree_generator_584f30ed
//
// The matrix of video processors of a sparse-raster quadtree generator, with its video
// controller.
//
// Parameters  QuadtreeGenerator { video_processor: VideoProcessor { format: "8x8_2x2_edges3", form: "pipe2", test: Serial, queues: Queues { broadcast: 2, packets: 2, windows: 2 } } }
// Latency     the clocks of the slowest video processor; 2 clocks from `start` to the first pixels
// Source      sparse-raster quadtree generator, figure 1 (MPG-ARCH, MPG-LIM)
// Described   rtl/src/quadtree/generator.rs:35
`default_nettype none

module quadtree_generator_584f30ed (
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
    // Depth alone is compared, and the first drawn of equal depths stays; constant while a picture is being drawn.
    input  wire         strict,
    // High for one clock to swap the banks; only when idle and while no picture is being read.
    input  wire         swap,
    // The settings of the read-out.
    // High for one clock to read a picture; only while no picture is being read.
    input  wire         show_start,
    // Each pixel is cleared when it is read; constant while a picture is being read.
    input  wire         show_clear,
    input  wire [23:0]  show_background,       // The colour of pixels where nothing was drawn.
    // The unit whose counters are read.
    input  wire [1:0]   probe_processor,       // The number of the probed video processor, row by row.
    input  wire [1:0]   probe_unit,            // The probed unit: 0 for the set-up, or a level of the raster processor.
    input  wire         pixels_ready,
    // Groups of p neighbouring pixels, line by line; pixels beyond the end of a line are to be ignored.
    output wire         pixels_valid,
    output wire [95:0]  pixels_payload,
    output wire         idle,                  // No polygon is under way.
    output wire         showing,               // A picture is being read.
    // The counters of the probed unit.
    output reg  [31:0]  tally_busy,            // Clocks in which the unit worked.
    output reg  [31:0]  tally_stalled,         // Clocks in which the unit had a result that was not taken.
    output reg  [31:0]  tally_results,         // Results that the unit delivered.
    // The fragments of the probed video processor since the reset, modulo 2^32.
    output wire [31:0]  fragments,
    // The counters of the broadcast: packets that all video processors have, and clocks in which a packet waited for
    // room.
    output reg  [31:0]  broadcast_busy,        // Clocks in which the unit worked.
    output reg  [31:0]  broadcast_stalled,     // Clocks in which the unit had a result that was not taken.
    output reg  [31:0]  broadcast_results,     // Results that the unit delivered.
    output wire         packets_ready
);

    reg back;                                                    // rtl/src/quadtree/generator.rs:86

    wire u_queue_out_valid;                                      // rtl/src/quadtree/generator.rs:89
    wire [724:0] u_queue_out_payload;                            // rtl/src/quadtree/generator.rs:89
    wire [3:0] u_controller_scan_enable;                         // rtl/src/quadtree/generator.rs:116
    wire [7:0] u_controller_scan_x;                              // rtl/src/quadtree/generator.rs:116
    wire [7:0] u_controller_scan_y;                              // rtl/src/quadtree/generator.rs:116
    wire [3:0] u_controller_scan_clear;                          // rtl/src/quadtree/generator.rs:116

    wire all_have;                                               // rtl/src/quadtree/generator.rs:96
    wire u_processor_idle_all;                                   // rtl/src/quadtree/generator.rs:119
    wire [31:0] tally_busy_picked_3;                             // rtl/src/quadtree/generator.rs:121
    wire [31:0] tally_stalled_picked_3;                          // rtl/src/quadtree/generator.rs:121
    wire [31:0] tally_results_picked_3;                          // rtl/src/quadtree/generator.rs:121
    wire [31:0] tally_busy_picked;                               // rtl/src/quadtree/generator.rs:121
    wire [31:0] tally_stalled_picked;                            // rtl/src/quadtree/generator.rs:121
    wire [31:0] tally_results_picked;                            // rtl/src/quadtree/generator.rs:121
    wire [31:0] tally_busy_picked_2;                             // rtl/src/quadtree/generator.rs:121
    wire [31:0] tally_stalled_picked_2;                          // rtl/src/quadtree/generator.rs:121
    wire [31:0] tally_results_picked_2;                          // rtl/src/quadtree/generator.rs:121
    wire [191:0] u_controller_words;                             // rtl/src/quadtree/generator.rs:106
    wire [50:0] u_queue_out_payload_721_671 = u_queue_out_payload[721:671]; // rtl/src/quadtree/generator.rs:89
    wire [50:0] u_queue_out_payload_670_620 = u_queue_out_payload[670:620]; // rtl/src/quadtree/generator.rs:89
    wire [95:0] u_queue_out_payload_619_524 = u_queue_out_payload[619:524]; // rtl/src/quadtree/generator.rs:89
    wire [159:0] u_queue_out_payload_523_364 = u_queue_out_payload[523:364]; // rtl/src/quadtree/generator.rs:89
    wire [159:0] u_queue_out_payload_363_204 = u_queue_out_payload[363:204]; // rtl/src/quadtree/generator.rs:89
    wire [159:0] u_queue_out_payload_203_44 = u_queue_out_payload[203:44]; // rtl/src/quadtree/generator.rs:89
    wire u_queue_out_valid_and_all_have = u_queue_out_valid & all_have; // rtl/src/quadtree/generator.rs:97
    wire waits = u_queue_out_valid & !all_have;                  // rtl/src/quadtree/generator.rs:99
    assign idle = !u_queue_out_valid & u_processor_idle_all;     // rtl/src/quadtree/generator.rs:119
    always @* begin
        case (probe_unit)
            2'd1: tally_busy = tally_busy_picked;
            2'd2: tally_busy = tally_busy_picked_2;
            default: tally_busy = tally_busy_picked_3;
        endcase
    end
    always @* begin
        case (probe_unit)
            2'd1: tally_stalled = tally_stalled_picked;
            2'd2: tally_stalled = tally_stalled_picked_2;
            default: tally_stalled = tally_stalled_picked_3;
        endcase
    end
    always @* begin
        case (probe_unit)
            2'd1: tally_results = tally_results_picked;
            2'd2: tally_results = tally_results_picked_2;
            default: tally_results = tally_results_picked_3;
        endcase
    end

    genvar i;
    genvar j;

    generate
        for (i = 0; i < 4; i = i + 1) begin : u_processor            // rtl/src/quadtree/generator.rs:106
            wire [47:0] word;
            wire lane_idle;
            wire [31:0] tally_0_busy;
            wire [31:0] tally_0_stalled;
            wire [31:0] tally_0_results;
            wire [31:0] tally_1_busy;
            wire [31:0] tally_1_stalled;
            wire [31:0] tally_1_results;
            wire [31:0] tally_2_busy;
            wire [31:0] tally_2_stalled;
            wire [31:0] tally_2_results;
            wire [31:0] lane_fragments;
            wire lane_packets_ready;
            reg has;
            wire u_queue_out_valid_and_not_has = u_queue_out_valid & !has;
            wire all_have_and = u_queue_out_valid_and_not_has & lane_packets_ready;
            wire all_have_or = has | all_have_and;
            wire scan_enable = u_controller_scan_enable[i];
            wire [1:0] scan_x = u_controller_scan_x[i * 2 +: 2];
            wire [1:0] scan_y = u_controller_scan_y[i * 2 +: 2];
            wire scan_clear = u_controller_scan_clear[i];
            localparam [31:0] place_left = i % 2;
            localparam [31:0] place_top = i / 2;
            localparam [31:0] place_right = 6 + (i % 2);
            localparam [31:0] place_bottom = 6 + (i / 2);
            wire [50:0] u_processor_packets_edges_a;
            for (j = 0; j < 3; j = j + 1) begin : u_processor_packets_edges_a_of
                assign u_processor_packets_edges_a[j * 17 +: 17] = u_queue_out_payload_721_671[j * 17 +: 17];
            end
            wire [50:0] u_processor_packets_edges_b;
            for (j = 0; j < 3; j = j + 1) begin : u_processor_packets_edges_b_of
                assign u_processor_packets_edges_b[j * 17 +: 17] = u_queue_out_payload_670_620[j * 17 +: 17];
            end
            wire [95:0] u_processor_packets_edges_c;
            for (j = 0; j < 3; j = j + 1) begin : u_processor_packets_edges_c_of
                assign u_processor_packets_edges_c[j * 32 +: 32] = u_queue_out_payload_619_524[j * 32 +: 32];
            end
            wire [159:0] u_processor_packets_planes_x;
            for (j = 0; j < 4; j = j + 1) begin : u_processor_packets_planes_x_of
                assign u_processor_packets_planes_x[j * 40 +: 40] = u_queue_out_payload_523_364[j * 40 +: 40];
            end
            wire [159:0] u_processor_packets_planes_y;
            for (j = 0; j < 4; j = j + 1) begin : u_processor_packets_planes_y_of
                assign u_processor_packets_planes_y[j * 40 +: 40] = u_queue_out_payload_363_204[j * 40 +: 40];
            end
            wire [159:0] u_processor_packets_planes_origin;
            for (j = 0; j < 4; j = j + 1) begin : u_processor_packets_planes_origin_of
                assign u_processor_packets_planes_origin[j * 40 +: 40] = u_queue_out_payload_203_44[j * 40 +: 40];
            end

            video_processor_4b528d89 lane (
                .clk                   (clk),
                .rst                   (rst),
                .packets_valid         (u_queue_out_valid_and_not_has),
                .packets_last_edge     (u_queue_out_payload[724:722]),
                .packets_edges_a       (u_processor_packets_edges_a),
                .packets_edges_b       (u_processor_packets_edges_b),
                .packets_edges_c       (u_processor_packets_edges_c),
                .packets_planes_x      (u_processor_packets_planes_x),
                .packets_planes_y      (u_processor_packets_planes_y),
                .packets_planes_origin (u_processor_packets_planes_origin),
                .packets_bounds_left   (u_queue_out_payload[43:33]),
                .packets_bounds_top    (u_queue_out_payload[32:22]),
                .packets_bounds_right  (u_queue_out_payload[21:11]),
                .packets_bounds_bottom (u_queue_out_payload[10:0]),
                .place_left            (place_left[12:0]),
                .place_top             (place_top[12:0]),
                .place_right           (place_right[12:0]),
                .place_bottom          (place_bottom[12:0]),
                .strict                (strict),
                .back                  (back),
                .scan_enable           (scan_enable),
                .scan_x                (scan_x),
                .scan_y                (scan_y),
                .scan_clear            (scan_clear),
                .word                  (word),
                .idle                  (lane_idle),
                .tally_0_busy          (tally_0_busy),
                .tally_0_stalled       (tally_0_stalled),
                .tally_0_results       (tally_0_results),
                .tally_1_busy          (tally_1_busy),
                .tally_1_stalled       (tally_1_stalled),
                .tally_1_results       (tally_1_results),
                .tally_2_busy          (tally_2_busy),
                .tally_2_stalled       (tally_2_stalled),
                .tally_2_results       (tally_2_results),
                .fragments             (lane_fragments),
                .packets_ready         (lane_packets_ready)
            );

            always @(posedge clk) begin
                if (rst) has <= 1'b0;
                else if (u_queue_out_valid_and_all_have) has <= 1'b0;
                else if (all_have_and) has <= 1'b1;
            end
        end
    endgenerate

    fifo_depth2_width725_storage_registers u_queue (             // rtl/src/quadtree/generator.rs:89
        .clk          (clk),
        .rst          (rst),
        .into_valid   (packets_valid),
        .into_payload ({
            packets_last_edge, packets_edges_a, packets_edges_b, packets_edges_c,
            packets_planes_x, packets_planes_y, packets_planes_origin, packets_bounds_left,
            packets_bounds_top, packets_bounds_right, packets_bounds_bottom
        }),
        .out_ready    (all_have),
        .out_valid    (u_queue_out_valid),
        .out_payload  (u_queue_out_payload),
        .into_ready   (packets_ready)
    );

    video_controller_format8x8_2x2_edges3 u_controller (         // rtl/src/quadtree/generator.rs:116
        .clk             (clk),
        .rst             (rst),
        .show_start      (show_start),
        .show_clear      (show_clear),
        .show_background (show_background),
        .words           (u_controller_words),
        .pixels_ready    (pixels_ready),
        .scan_enable     (u_controller_scan_enable),
        .scan_x          (u_controller_scan_x),
        .scan_y          (u_controller_scan_y),
        .scan_clear      (u_controller_scan_clear),
        .pixels_valid    (pixels_valid),
        .pixels_payload  (pixels_payload),
        .busy            (showing)
    );

    wire [3:0] all_have_lanes;
    generate
        for (i = 0; i < 4; i = i + 1) begin : all_have_of
            assign all_have_lanes[i] = u_processor[i].all_have_or;
        end
    endgenerate
    assign all_have = &all_have_lanes;                           // rtl/src/quadtree/generator.rs:96
    wire [3:0] u_processor_idle_all_lanes;
    generate
        for (i = 0; i < 4; i = i + 1) begin : u_processor_idle_all_of
            assign u_processor_idle_all_lanes[i] = u_processor[i].lane_idle;
        end
    endgenerate
    assign u_processor_idle_all = &u_processor_idle_all_lanes;   // rtl/src/quadtree/generator.rs:119
    wire [31:0] tally_busy_picked_3_lanes [0:3];
    generate
        for (i = 0; i < 4; i = i + 1) begin : tally_busy_picked_3_of
            assign tally_busy_picked_3_lanes[i] = u_processor[i].tally_0_busy;
        end
    endgenerate
    assign tally_busy_picked_3 = tally_busy_picked_3_lanes[probe_processor]; // rtl/src/quadtree/generator.rs:121
    wire [31:0] tally_stalled_picked_3_lanes [0:3];
    generate
        for (i = 0; i < 4; i = i + 1) begin : tally_stalled_picked_3_of
            assign tally_stalled_picked_3_lanes[i] = u_processor[i].tally_0_stalled;
        end
    endgenerate
    assign tally_stalled_picked_3 = tally_stalled_picked_3_lanes[probe_processor]; // rtl/src/quadtree/generator.rs:121
    wire [31:0] tally_results_picked_3_lanes [0:3];
    generate
        for (i = 0; i < 4; i = i + 1) begin : tally_results_picked_3_of
            assign tally_results_picked_3_lanes[i] = u_processor[i].tally_0_results;
        end
    endgenerate
    assign tally_results_picked_3 = tally_results_picked_3_lanes[probe_processor]; // rtl/src/quadtree/generator.rs:121
    wire [31:0] tally_busy_picked_lanes [0:3];
    generate
        for (i = 0; i < 4; i = i + 1) begin : tally_busy_picked_of
            assign tally_busy_picked_lanes[i] = u_processor[i].tally_1_busy;
        end
    endgenerate
    assign tally_busy_picked = tally_busy_picked_lanes[probe_processor]; // rtl/src/quadtree/generator.rs:121
    wire [31:0] tally_stalled_picked_lanes [0:3];
    generate
        for (i = 0; i < 4; i = i + 1) begin : tally_stalled_picked_of
            assign tally_stalled_picked_lanes[i] = u_processor[i].tally_1_stalled;
        end
    endgenerate
    assign tally_stalled_picked = tally_stalled_picked_lanes[probe_processor]; // rtl/src/quadtree/generator.rs:121
    wire [31:0] tally_results_picked_lanes [0:3];
    generate
        for (i = 0; i < 4; i = i + 1) begin : tally_results_picked_of
            assign tally_results_picked_lanes[i] = u_processor[i].tally_1_results;
        end
    endgenerate
    assign tally_results_picked = tally_results_picked_lanes[probe_processor]; // rtl/src/quadtree/generator.rs:121
    wire [31:0] tally_busy_picked_2_lanes [0:3];
    generate
        for (i = 0; i < 4; i = i + 1) begin : tally_busy_picked_2_of
            assign tally_busy_picked_2_lanes[i] = u_processor[i].tally_2_busy;
        end
    endgenerate
    assign tally_busy_picked_2 = tally_busy_picked_2_lanes[probe_processor]; // rtl/src/quadtree/generator.rs:121
    wire [31:0] tally_stalled_picked_2_lanes [0:3];
    generate
        for (i = 0; i < 4; i = i + 1) begin : tally_stalled_picked_2_of
            assign tally_stalled_picked_2_lanes[i] = u_processor[i].tally_2_stalled;
        end
    endgenerate
    assign tally_stalled_picked_2 = tally_stalled_picked_2_lanes[probe_processor]; // rtl/src/quadtree/generator.rs:121
    wire [31:0] tally_results_picked_2_lanes [0:3];
    generate
        for (i = 0; i < 4; i = i + 1) begin : tally_results_picked_2_of
            assign tally_results_picked_2_lanes[i] = u_processor[i].tally_2_results;
        end
    endgenerate
    assign tally_results_picked_2 = tally_results_picked_2_lanes[probe_processor]; // rtl/src/quadtree/generator.rs:121
    wire [31:0] fragments_lanes [0:3];
    generate
        for (i = 0; i < 4; i = i + 1) begin : fragments_of
            assign fragments_lanes[i] = u_processor[i].lane_fragments;
        end
    endgenerate
    assign fragments = fragments_lanes[probe_processor];         // rtl/src/quadtree/generator.rs:130
    generate
        for (i = 0; i < 4; i = i + 1) begin : u_controller_words_of
            assign u_controller_words[i * 48 +: 48] = u_processor[i].word;
        end
    endgenerate

    always @(posedge clk) begin
        if (rst) begin
            back <= 1'b0;
            broadcast_busy <= 32'd0;
            broadcast_stalled <= 32'd0;
            broadcast_results <= 32'd0;
        end else begin
            if (swap) back <= !back;
            if (u_queue_out_valid_and_all_have) broadcast_busy <= broadcast_busy + 32'd1;
            if (waits) broadcast_stalled <= broadcast_stalled + 32'd1;
            if (u_queue_out_valid_and_all_have) broadcast_results <= broadcast_results + 32'd1;
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
        if (!rst) assume (!swap | (idle & !showing));                // rtl/src/quadtree/generator.rs:120
    end
`else
    always @(posedge clk) begin
        if (!rst && !(!swap | (idle & !showing))) begin              // rtl/src/quadtree/generator.rs:120
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: the banks are swapped only while nothing is drawn or read", $time);
            stop;
        end
    end
`endif
`endif
endmodule
`default_nettype wire
