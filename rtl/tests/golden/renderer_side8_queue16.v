// renderer_side8_queue16
//
// Draws regions of the screen, one after another.
//
// Parameters  Renderer { side: 8, queue: 16, quadratic: false }
// Latency     a primitive takes the clocks of its instructions; a region is sent in 48 clocks a line
// Source      Pixel-planes 5, section I.3.2.1 (PP5-ARCH, PP5-UT)
// Described   rtl/src/pixel_planes/renderer.rs:32
`default_nettype none

module renderer_side8_queue16 (
    input  wire        clk,
    input  wire        rst,
    // The instructions; all coefficients are relative to the region.
    input  wire        instructions_valid,
    input  wire [4:0]  instructions_operation,      // The operation: an `Operation`.
    input  wire [5:0]  instructions_skip,           // Bits of the expression before the word; 0 without an expression.
    input  wire [6:0]  instructions_length,         // Bits of the word: 1 to `LONGEST`.
    input  wire [7:0]  instructions_read,           // The first address that is read.
    input  wire [7:0]  instructions_write,          // The first address that is written.
    // The coefficients of the expression, in two's complement, relative to the region. Without an expression, `c` is
    // the constant; its sign extends to longer words. For a curve they are `d`, `e` and `f`.
    input  wire [39:0] instructions_coefficients_a, // Coefficient A, the increase from one column to the next.
    input  wire [39:0] instructions_coefficients_b, // Coefficient B, the increase from one line to the next.
    input  wire [39:0] instructions_coefficients_c, // Coefficient C, the value at column 0 of line 0.
    // Tree and memory may each execute an instruction. While `side_by_side` is low, an instruction begins only after
    // its predecessor has ended.
    input  wire        side_by_side,
    input  wire        planes_ready,
    // Finished regions, S bits a clock.
    output wire        planes_valid,
    output wire [15:0] planes_region,               // The number of the region.
    output wire [2:0]  planes_line,                 // The line of the region.
    output wire [5:0]  planes_plane,                // The number of the bit in the visibility word.
    output wire [7:0]  planes_bits,                 // The plane's bit of each pixel of the line, from the left.
    // The queue has room for an instruction in this clock: a copy of `instructions.ready`, for a sender that must know
    // before it offers one.
    output wire        room,
    output wire        takes,                       // The controller takes an instruction from the queue in this clock.
    // All instructions have ended, except in the pixels, which are `Renderer::lag` clocks behind. The renderer can take
    // another region.
    output wire        idle,
    output wire        instructions_ready
);

    wire u_queue_out_valid;                                      // rtl/src/pixel_planes/renderer.rs:96
    wire [153:0] u_queue_out_payload;                            // rtl/src/pixel_planes/renderer.rs:96
    wire u_controller_coefficients_a;                            // rtl/src/pixel_planes/renderer.rs:101
    wire u_controller_coefficients_b;                            // rtl/src/pixel_planes/renderer.rs:101
    wire u_controller_coefficients_c;                            // rtl/src/pixel_planes/renderer.rs:101
    wire u_controller_first;                                     // rtl/src/pixel_planes/renderer.rs:101
    wire [1:0] u_controller_control_source;                      // rtl/src/pixel_planes/renderer.rs:101
    wire u_controller_control_constant;                          // rtl/src/pixel_planes/renderer.rs:101
    wire u_controller_control_adds;                              // rtl/src/pixel_planes/renderer.rs:101
    wire u_controller_control_first;                             // rtl/src/pixel_planes/renderer.rs:101
    wire [1:0] u_controller_control_mask;                        // rtl/src/pixel_planes/renderer.rs:101
    wire u_controller_control_compares;                          // rtl/src/pixel_planes/renderer.rs:101
    wire u_controller_control_gates;                             // rtl/src/pixel_planes/renderer.rs:101
    wire [2:0] u_controller_control_enabling;                    // rtl/src/pixel_planes/renderer.rs:101
    wire u_controller_control_captures;                          // rtl/src/pixel_planes/renderer.rs:101
    wire [7:0] u_controller_control_read;                        // rtl/src/pixel_planes/renderer.rs:101
    wire [7:0] u_controller_control_write;                       // rtl/src/pixel_planes/renderer.rs:101
    wire u_controller_save_claim;                                // rtl/src/pixel_planes/renderer.rs:101
    wire [15:0] u_controller_save_region;                        // rtl/src/pixel_planes/renderer.rs:101
    wire u_controller_save_plane;                                // rtl/src/pixel_planes/renderer.rs:101
    wire u_controller_instructions_ready;                        // rtl/src/pixel_planes/renderer.rs:101
    wire [63:0] u_tree_value;                                    // rtl/src/pixel_planes/renderer.rs:110
    wire store_free;                                             // rtl/src/pixel_planes/renderer.rs:98

    wire [63:0] u_store_word;                                    // rtl/src/pixel_planes/renderer.rs:116
    assign takes = u_queue_out_valid & u_controller_instructions_ready; // rtl/src/pixel_planes/renderer.rs:97

    genvar i;
    genvar j;

    generate
        for (i = 0; i < 8; i = i + 1) begin : u_pixel                // rtl/src/pixel_planes/renderer.rs:116
            for (j = 0; j < 8; j = j + 1) begin : col
                wire word;

                pixel_processor lane (
                    .clk              (clk),
                    .control_source   (u_controller_control_source),
                    .control_constant (u_controller_control_constant),
                    .control_adds     (u_controller_control_adds),
                    .control_first    (u_controller_control_first),
                    .control_mask     (u_controller_control_mask),
                    .control_compares (u_controller_control_compares),
                    .control_gates    (u_controller_control_gates),
                    .control_enabling (u_controller_control_enabling),
                    .control_captures (u_controller_control_captures),
                    .control_read     (u_controller_control_read),
                    .control_write    (u_controller_control_write),
                    .expression       (u_tree_value[i * 8 + j]),
                    .word             (word)
                );
            end
        end
    endgenerate

    fifo_depth16_width154_storage_registers u_queue (            // rtl/src/pixel_planes/renderer.rs:96
        .clk          (clk),
        .rst          (rst),
        .into_valid   (instructions_valid),
        .into_payload ({
            instructions_operation, instructions_skip, instructions_length,
            instructions_read, instructions_write, instructions_coefficients_a,
            instructions_coefficients_b, instructions_coefficients_c
        }),
        .out_ready    (u_controller_instructions_ready),
        .out_valid    (u_queue_out_valid),
        .out_payload  (u_queue_out_payload),
        .into_ready   (instructions_ready)
    );

    image_generation_controller_side8 u_controller (             // rtl/src/pixel_planes/renderer.rs:101
        .clk                         (clk),
        .rst                         (rst),
        .instructions_valid          (u_queue_out_valid),
        .instructions_operation      (u_queue_out_payload[153:149]),
        .instructions_skip           (u_queue_out_payload[148:143]),
        .instructions_length         (u_queue_out_payload[142:136]),
        .instructions_read           (u_queue_out_payload[135:128]),
        .instructions_write          (u_queue_out_payload[127:120]),
        .instructions_coefficients_a (u_queue_out_payload[119:80]),
        .instructions_coefficients_b (u_queue_out_payload[79:40]),
        .instructions_coefficients_c (u_queue_out_payload[39:0]),
        .side_by_side                (side_by_side),
        .store_free                  (store_free),
        .coefficients_a              (u_controller_coefficients_a),
        .coefficients_b              (u_controller_coefficients_b),
        .coefficients_c              (u_controller_coefficients_c),
        .first                       (u_controller_first),
        .control_source              (u_controller_control_source),
        .control_constant            (u_controller_control_constant),
        .control_adds                (u_controller_control_adds),
        .control_first               (u_controller_control_first),
        .control_mask                (u_controller_control_mask),
        .control_compares            (u_controller_control_compares),
        .control_gates               (u_controller_control_gates),
        .control_enabling            (u_controller_control_enabling),
        .control_captures            (u_controller_control_captures),
        .control_read                (u_controller_control_read),
        .control_write               (u_controller_control_write),
        .save_claim                  (u_controller_save_claim),
        .save_region                 (u_controller_save_region),
        .save_plane                  (u_controller_save_plane),
        .idle                        (idle),
        .instructions_ready          (u_controller_instructions_ready)
    );

    linear_tree_side8 u_tree (                                   // rtl/src/pixel_planes/renderer.rs:110
        .clk            (clk),
        .rst            (rst),
        .coefficients_a (u_controller_coefficients_a),
        .coefficients_b (u_controller_coefficients_b),
        .coefficients_c (u_controller_coefficients_c),
        .first          (u_controller_first),
        .value          (u_tree_value)
    );

    backing_store_side8 u_store (                                // rtl/src/pixel_planes/renderer.rs:120
        .clk           (clk),
        .rst           (rst),
        .save_claim    (u_controller_save_claim),
        .save_region   (u_controller_save_region),
        .save_plane    (u_controller_save_plane),
        .number        (u_controller_control_write[5:0]),
        .word          (u_store_word),
        .planes_ready  (planes_ready),
        .free          (store_free),
        .planes_valid  (planes_valid),
        .planes_region (planes_region),
        .planes_line   (planes_line),
        .planes_plane  (planes_plane),
        .planes_bits   (planes_bits)
    );

    generate
        for (i = 0; i < 8; i = i + 1) begin : u_store_word_of
            for (j = 0; j < 8; j = j + 1) begin : u_store_word_col
                assign u_store_word[i * 8 + j] = u_pixel[i].col[j].word;
            end
        end
    endgenerate

    assign room = instructions_ready;
endmodule
`default_nettype wire
