// pixel_planes5_width16_height8_renderers2_side8_queue16_rate125
//
// Renderers around a ring, with the region allocator and the frame buffer.
//
// Parameters  PixelPlanes5 { screen: Screen { width: 16, height: 8 }, renderers: 2, side: 8, queue: 16, rate: 125, quadratic: false }
// Latency     the clocks of the last renderer to finish; 1 clock to read a line
// Source      Pixel-planes 5, section I.3.2.1 (PP5-ARCH, PP5-UT)
// Described   rtl/src/pixel_planes/machine.rs:34
`default_nettype none

module pixel_planes5_width16_height8_renderers2_side8_queue16_rate125 (
    input  wire         clk,
    input  wire         rst,
    // The numbers of the regions, the one with the most primitives first.
    input  wire         regions_valid,
    input  wire [15:0]  regions_payload,
    // The instructions for each renderer's region.
    input  wire         bins_0_valid,
    input  wire [4:0]   bins_0_operation,      // The operation: an `Operation`.
    input  wire [5:0]   bins_0_skip,           // Bits of the expression before the word; 0 without an expression.
    input  wire [6:0]   bins_0_length,         // Bits of the word: 1 to `LONGEST`.
    input  wire [7:0]   bins_0_read,           // The first address that is read.
    input  wire [7:0]   bins_0_write,          // The first address that is written.
    // The coefficients of the expression, in two's complement, relative to the region. Without an expression, `c` is
    // the constant; its sign extends to longer words. For a curve they are `d`, `e` and `f`.
    input  wire [39:0]  bins_0_coefficients_a, // Coefficient A, the increase from one column to the next.
    input  wire [39:0]  bins_0_coefficients_b, // Coefficient B, the increase from one line to the next.
    input  wire [39:0]  bins_0_coefficients_c, // Coefficient C, the value at column 0 of line 0.
    input  wire         bins_1_valid,
    input  wire [4:0]   bins_1_operation,
    input  wire [5:0]   bins_1_skip,
    input  wire [6:0]   bins_1_length,
    input  wire [7:0]   bins_1_read,
    input  wire [7:0]   bins_1_write,
    input  wire [39:0]  bins_1_coefficients_a,
    input  wire [39:0]  bins_1_coefficients_b,
    input  wire [39:0]  bins_1_coefficients_c,
    input  wire [1:0]   open,                  // The renderers whose bins have more instructions to come.
    // Tree and memory may each execute an instruction. While `side_by_side` is low, an instruction begins only after
    // its predecessor has ended.
    input  wire         side_by_side,
    // A line of a region to read.
    input  wire         read_enable,           // A line is read; while `enable` is low, the words keep their values.
    input  wire         read_region,           // The number of the region.
    input  wire [2:0]   read_line,             // The line of the region.
    output wire [1:0]   given,                 // The renderer that gets a region in this clock, if any.
    output wire [15:0]  region,                // The number of the region that is given.
    output wire [1:0]   takes,                 // The renderers whose controllers take an instruction in this clock.
    // The renderers that have executed all instructions, except in the pixels.
    output wire [1:0]   idle,
    output wire         plane_goes,            // A plane goes to the frame buffer in this clock.
    output wire [383:0] words,                 // The words of the pixels of the line that was read.
    output wire         regions_ready,
    output wire         bins_0_ready,
    output wire         bins_1_ready
);

    wire u_ring_instructions_0_valid;                            // rtl/src/pixel_planes/machine.rs:102
    wire [4:0] u_ring_instructions_0_operation;                  // rtl/src/pixel_planes/machine.rs:102
    wire [5:0] u_ring_instructions_0_skip;                       // rtl/src/pixel_planes/machine.rs:102
    wire [6:0] u_ring_instructions_0_length;                     // rtl/src/pixel_planes/machine.rs:102
    wire [7:0] u_ring_instructions_0_read;                       // rtl/src/pixel_planes/machine.rs:102
    wire [7:0] u_ring_instructions_0_write;                      // rtl/src/pixel_planes/machine.rs:102
    wire [39:0] u_ring_instructions_0_coefficients_a;            // rtl/src/pixel_planes/machine.rs:102
    wire [39:0] u_ring_instructions_0_coefficients_b;            // rtl/src/pixel_planes/machine.rs:102
    wire [39:0] u_ring_instructions_0_coefficients_c;            // rtl/src/pixel_planes/machine.rs:102
    wire u_ring_instructions_1_valid;                            // rtl/src/pixel_planes/machine.rs:102
    wire [4:0] u_ring_instructions_1_operation;                  // rtl/src/pixel_planes/machine.rs:102
    wire [5:0] u_ring_instructions_1_skip;                       // rtl/src/pixel_planes/machine.rs:102
    wire [6:0] u_ring_instructions_1_length;                     // rtl/src/pixel_planes/machine.rs:102
    wire [7:0] u_ring_instructions_1_read;                       // rtl/src/pixel_planes/machine.rs:102
    wire [7:0] u_ring_instructions_1_write;                      // rtl/src/pixel_planes/machine.rs:102
    wire [39:0] u_ring_instructions_1_coefficients_a;            // rtl/src/pixel_planes/machine.rs:102
    wire [39:0] u_ring_instructions_1_coefficients_b;            // rtl/src/pixel_planes/machine.rs:102
    wire [39:0] u_ring_instructions_1_coefficients_c;            // rtl/src/pixel_planes/machine.rs:102
    wire [15:0] u_ring_planes_region;                            // rtl/src/pixel_planes/machine.rs:102
    wire [2:0] u_ring_planes_line;                               // rtl/src/pixel_planes/machine.rs:102
    wire [5:0] u_ring_planes_plane;                              // rtl/src/pixel_planes/machine.rs:102
    wire [7:0] u_ring_planes_bits;                               // rtl/src/pixel_planes/machine.rs:102
    wire u_ring_finished_0_ready;                                // rtl/src/pixel_planes/machine.rs:102
    wire u_ring_finished_1_ready;                                // rtl/src/pixel_planes/machine.rs:102
    wire finished0_valid;                                        // rtl/src/pixel_planes/machine.rs:99
    wire [15:0] finished0_region;                                // rtl/src/pixel_planes/machine.rs:99
    wire [2:0] finished0_line;                                   // rtl/src/pixel_planes/machine.rs:99
    wire [5:0] finished0_plane;                                  // rtl/src/pixel_planes/machine.rs:99
    wire [7:0] u_renderer0_planes_bits;                          // rtl/src/pixel_planes/machine.rs:107
    wire u_renderer0_room;                                       // rtl/src/pixel_planes/machine.rs:107
    wire u_renderer0_takes;                                      // rtl/src/pixel_planes/machine.rs:107
    wire u_renderer0_idle;                                       // rtl/src/pixel_planes/machine.rs:107
    wire u_renderer0_instructions_ready;                         // rtl/src/pixel_planes/machine.rs:107
    wire finished1_valid;                                        // rtl/src/pixel_planes/machine.rs:99
    wire [15:0] finished1_region;                                // rtl/src/pixel_planes/machine.rs:99
    wire [2:0] finished1_line;                                   // rtl/src/pixel_planes/machine.rs:99
    wire [5:0] finished1_plane;                                  // rtl/src/pixel_planes/machine.rs:99
    wire [7:0] u_renderer1_planes_bits;                          // rtl/src/pixel_planes/machine.rs:107
    wire u_renderer1_room;                                       // rtl/src/pixel_planes/machine.rs:107
    wire u_renderer1_takes;                                      // rtl/src/pixel_planes/machine.rs:107
    wire u_renderer1_idle;                                       // rtl/src/pixel_planes/machine.rs:107
    wire u_renderer1_instructions_ready;                         // rtl/src/pixel_planes/machine.rs:107
    wire u_frame_buffer_planes_ready;                            // rtl/src/pixel_planes/machine.rs:119

    wire [1:0] u_ring_room;                                      // rtl/src/pixel_planes/machine.rs:100
    wire [7:0] u_ring_finished_0_bits;                           // rtl/src/pixel_planes/machine.rs:99
    wire [7:0] u_ring_finished_1_bits;                           // rtl/src/pixel_planes/machine.rs:99
    wire [1:0] u_allocator_free;                                 // rtl/src/pixel_planes/machine.rs:116
    assign takes = {u_renderer1_takes, u_renderer0_takes};       // rtl/src/pixel_planes/machine.rs:123
    assign idle = {u_renderer1_idle, u_renderer0_idle};          // rtl/src/pixel_planes/machine.rs:114

    genvar i;

    generate
        for (i = 0; i < 8; i = i + 1) begin : finished0_bits_row
            wire finished0_bits = u_renderer0_planes_bits[i];
        end
    endgenerate

    generate
        for (i = 0; i < 8; i = i + 1) begin : finished1_bits_row
            wire finished1_bits = u_renderer1_planes_bits[i];
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : room_row
            wire room;
            case (i)
                0: begin : room_0 assign room = u_renderer0_room; end
                default: begin : room_1 assign room = u_renderer1_room; end
            endcase
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : idle_lane_row
            wire idle_lane;
            case (i)
                0: begin : idle_lane_0 assign idle_lane = u_renderer0_idle; end
                default: begin : idle_lane_1 assign idle_lane = u_renderer1_idle; end
            endcase
            wire u_allocator_free_and = idle_lane & !open[i];
        end
    endgenerate

    ring_renderers2_side8_rate125 u_ring (                       // rtl/src/pixel_planes/machine.rs:102
        .clk                           (clk),
        .rst                           (rst),
        .bins_0_valid                  (bins_0_valid),
        .bins_0_operation              (bins_0_operation),
        .bins_0_skip                   (bins_0_skip),
        .bins_0_length                 (bins_0_length),
        .bins_0_read                   (bins_0_read),
        .bins_0_write                  (bins_0_write),
        .bins_0_coefficients_a         (bins_0_coefficients_a),
        .bins_0_coefficients_b         (bins_0_coefficients_b),
        .bins_0_coefficients_c         (bins_0_coefficients_c),
        .bins_1_valid                  (bins_1_valid),
        .bins_1_operation              (bins_1_operation),
        .bins_1_skip                   (bins_1_skip),
        .bins_1_length                 (bins_1_length),
        .bins_1_read                   (bins_1_read),
        .bins_1_write                  (bins_1_write),
        .bins_1_coefficients_a         (bins_1_coefficients_a),
        .bins_1_coefficients_b         (bins_1_coefficients_b),
        .bins_1_coefficients_c         (bins_1_coefficients_c),
        .room                          (u_ring_room),
        .finished_0_valid              (finished0_valid),
        .finished_0_region             (finished0_region),
        .finished_0_line               (finished0_line),
        .finished_0_plane              (finished0_plane),
        .finished_0_bits               (u_ring_finished_0_bits),
        .finished_1_valid              (finished1_valid),
        .finished_1_region             (finished1_region),
        .finished_1_line               (finished1_line),
        .finished_1_plane              (finished1_plane),
        .finished_1_bits               (u_ring_finished_1_bits),
        .instructions_0_ready          (u_renderer0_instructions_ready),
        .instructions_1_ready          (u_renderer1_instructions_ready),
        .planes_ready                  (u_frame_buffer_planes_ready),
        .instructions_0_valid          (u_ring_instructions_0_valid),
        .instructions_0_operation      (u_ring_instructions_0_operation),
        .instructions_0_skip           (u_ring_instructions_0_skip),
        .instructions_0_length         (u_ring_instructions_0_length),
        .instructions_0_read           (u_ring_instructions_0_read),
        .instructions_0_write          (u_ring_instructions_0_write),
        .instructions_0_coefficients_a (u_ring_instructions_0_coefficients_a),
        .instructions_0_coefficients_b (u_ring_instructions_0_coefficients_b),
        .instructions_0_coefficients_c (u_ring_instructions_0_coefficients_c),
        .instructions_1_valid          (u_ring_instructions_1_valid),
        .instructions_1_operation      (u_ring_instructions_1_operation),
        .instructions_1_skip           (u_ring_instructions_1_skip),
        .instructions_1_length         (u_ring_instructions_1_length),
        .instructions_1_read           (u_ring_instructions_1_read),
        .instructions_1_write          (u_ring_instructions_1_write),
        .instructions_1_coefficients_a (u_ring_instructions_1_coefficients_a),
        .instructions_1_coefficients_b (u_ring_instructions_1_coefficients_b),
        .instructions_1_coefficients_c (u_ring_instructions_1_coefficients_c),
        .planes_valid                  (plane_goes),
        .planes_region                 (u_ring_planes_region),
        .planes_line                   (u_ring_planes_line),
        .planes_plane                  (u_ring_planes_plane),
        .planes_bits                   (u_ring_planes_bits),
        .bins_0_ready                  (bins_0_ready),
        .bins_1_ready                  (bins_1_ready),
        .finished_0_ready              (u_ring_finished_0_ready),
        .finished_1_ready              (u_ring_finished_1_ready)
    );

    renderer_side8_queue16 u_renderer0 (                         // rtl/src/pixel_planes/machine.rs:107
        .clk                         (clk),
        .rst                         (rst),
        .instructions_valid          (u_ring_instructions_0_valid),
        .instructions_operation      (u_ring_instructions_0_operation),
        .instructions_skip           (u_ring_instructions_0_skip),
        .instructions_length         (u_ring_instructions_0_length),
        .instructions_read           (u_ring_instructions_0_read),
        .instructions_write          (u_ring_instructions_0_write),
        .instructions_coefficients_a (u_ring_instructions_0_coefficients_a),
        .instructions_coefficients_b (u_ring_instructions_0_coefficients_b),
        .instructions_coefficients_c (u_ring_instructions_0_coefficients_c),
        .side_by_side                (side_by_side),
        .planes_ready                (u_ring_finished_0_ready),
        .planes_valid                (finished0_valid),
        .planes_region               (finished0_region),
        .planes_line                 (finished0_line),
        .planes_plane                (finished0_plane),
        .planes_bits                 (u_renderer0_planes_bits),
        .room                        (u_renderer0_room),
        .takes                       (u_renderer0_takes),
        .idle                        (u_renderer0_idle),
        .instructions_ready          (u_renderer0_instructions_ready)
    );

    renderer_side8_queue16 u_renderer1 (                         // rtl/src/pixel_planes/machine.rs:107
        .clk                         (clk),
        .rst                         (rst),
        .instructions_valid          (u_ring_instructions_1_valid),
        .instructions_operation      (u_ring_instructions_1_operation),
        .instructions_skip           (u_ring_instructions_1_skip),
        .instructions_length         (u_ring_instructions_1_length),
        .instructions_read           (u_ring_instructions_1_read),
        .instructions_write          (u_ring_instructions_1_write),
        .instructions_coefficients_a (u_ring_instructions_1_coefficients_a),
        .instructions_coefficients_b (u_ring_instructions_1_coefficients_b),
        .instructions_coefficients_c (u_ring_instructions_1_coefficients_c),
        .side_by_side                (side_by_side),
        .planes_ready                (u_ring_finished_1_ready),
        .planes_valid                (finished1_valid),
        .planes_region               (finished1_region),
        .planes_line                 (finished1_line),
        .planes_plane                (finished1_plane),
        .planes_bits                 (u_renderer1_planes_bits),
        .room                        (u_renderer1_room),
        .takes                       (u_renderer1_takes),
        .idle                        (u_renderer1_idle),
        .instructions_ready          (u_renderer1_instructions_ready)
    );

    region_allocator_renderers2 u_allocator (                    // rtl/src/pixel_planes/machine.rs:117
        .clk             (clk),
        .rst             (rst),
        .regions_valid   (regions_valid),
        .regions_payload (regions_payload),
        .free            (u_allocator_free),
        .given           (given),
        .region          (region),
        .regions_ready   (regions_ready)
    );

    frame_buffer_width16_height8_side8 u_frame_buffer (          // rtl/src/pixel_planes/machine.rs:119
        .clk           (clk),
        .rst           (rst),
        .planes_valid  (plane_goes),
        .planes_region (u_ring_planes_region),
        .planes_line   (u_ring_planes_line),
        .planes_plane  (u_ring_planes_plane),
        .planes_bits   (u_ring_planes_bits),
        .read_enable   (read_enable),
        .read_region   (read_region),
        .read_line     (read_line),
        .words         (words),
        .planes_ready  (u_frame_buffer_planes_ready)
    );

    generate
        for (i = 0; i < 2; i = i + 1) begin : u_ring_room_of
            assign u_ring_room[i] = room_row[i].room;
        end
    endgenerate
    generate
        for (i = 0; i < 8; i = i + 1) begin : u_ring_finished_0_bits_of
            assign u_ring_finished_0_bits[i] = finished0_bits_row[i].finished0_bits;
        end
    endgenerate
    generate
        for (i = 0; i < 8; i = i + 1) begin : u_ring_finished_1_bits_of
            assign u_ring_finished_1_bits[i] = finished1_bits_row[i].finished1_bits;
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : u_allocator_free_of
            assign u_allocator_free[i] = idle_lane_row[i].u_allocator_free_and;
        end
    endgenerate
endmodule
`default_nettype wire
