// pixel_array_width8_height4
//
// Pixels that execute one instruction stream.
//
// Parameters  PixelArray { width: 8, height: 4 }
// Latency     the clocks of the instructions; 0 clocks for a port to read a byte
// Source      Reducing Latency on PixelFlow, section 3 (PFL-NODE)
// Described   rtl/src/pixelflow/array.rs:35
`default_nettype none

module pixel_array_width8_height4 (
    input  wire        array_clk,
    input  wire        array_rst,
    input  wire        network_clk,
    // The instructions; all coefficients are relative to the region.
    input  wire        instructions_valid,
    input  wire [1:0]  instructions_source,      // Where the operand comes from: a `Source`.
    input  wire [3:0]  instructions_function,    // The function of the ALU: a `Function`.
    input  wire [1:0]  instructions_begin,       // The carry that comes into the first byte: a `Begin`.
    input  wire [1:0]  instructions_mask,        // Which processors write: a `Mask`.
    input  wire        instructions_accumulates, // Results go to the accumulator.
    input  wire        instructions_stores,      // Results go to memory.
    // What the last byte's `enabling` and `flagging` depend on: a `Condition`.
    input  wire [1:0]  instructions_condition,
    input  wire [2:0]  instructions_enabling,    // The change of the enable flags with the last byte: an `Enabling`.
    input  wire [1:0]  instructions_flagging,    // The change of the flag with the last byte: a `Flagging`.
    // The number of bytes of the expression before the word; 0 without an expression.
    input  wire [2:0]  instructions_skip,
    input  wire [3:0]  instructions_length,      // The number of bytes of the word: 1 to `LONGEST`.
    // Addresses decrease from byte to byte, most significant byte first: for shifts to the right.
    input  wire        instructions_descends,
    input  wire [8:0]  instructions_read,        // The address of the first byte that is read.
    input  wire [8:0]  instructions_write,       // The address of the first byte that is written.
    input  wire [2:0]  instructions_sync,        // The synchronization with the ports: a `Sync`.
    input  wire [39:0] instructions_a,           // Coefficient A of the expression, in two's complement.
    input  wire [39:0] instructions_b,           // Coefficient B of the expression, in two's complement.
    // Coefficient C of the expression, in two's complement, relative to the region. Without an expression, C is the
    // constant, least significant byte first; its sign extends it to a longer word.
    input  wire [39:0] instructions_c,
    // Evaluator and memory may execute two instructions at once; while this is low, they execute one at a time.
    input  wire        side_by_side,
    input  wire [1:0]  bank_done,                // For one clock: the network is done with a bank; a bit for each.
    input  wire        texture_done,             // For one clock: the texture unit is done.
    // For each bank: the network's access.
    input  wire [3:0]  network_0_pixel,          // The pixel of each chip, counted line by line.
    input  wire [4:0]  network_0_address,        // The register of the pixel.
    input  wire        network_0_writes,         // The register is written.
    input  wire [15:0] network_0_bytes,          // The bytes to write, one of each chip.
    input  wire [3:0]  network_1_pixel,
    input  wire [4:0]  network_1_address,
    input  wire        network_1_writes,
    input  wire [15:0] network_1_bytes,
    // The texture unit's access to its registers.
    input  wire [3:0]  texture_pixel,            // The pixel of each chip, counted line by line.
    input  wire [5:0]  texture_address,          // The register of the pixel.
    input  wire        texture_writes,           // The register is written.
    input  wire [15:0] texture_bytes,            // The bytes to write, one of each chip.
    // The hand-over to network and texture unit: after the next edge the registers have all results so far.
    output wire [1:0]  given_banks,              // For one clock: a bank is given to the network; a bit for each.
    output wire        given_texture,            // For one clock: the texture unit begins.
    // For each bank: the byte of each chip that the network reads.
    output wire [15:0] network_seen_0,
    output wire [15:0] network_seen_1,
    output wire [15:0] texture_seen,             // The byte of each chip that the texture unit reads.
    // All instructions have left the controller; the pixels execute the last one after the evaluator's latency.
    output wire        idle,
    output wire        instructions_ready
);

    wire [7:0] u_controller_coefficients_a;                      // rtl/src/pixelflow/array.rs:109
    wire [7:0] u_controller_coefficients_b;                      // rtl/src/pixelflow/array.rs:109
    wire [7:0] u_controller_coefficients_c;                      // rtl/src/pixelflow/array.rs:109
    wire u_controller_first;                                     // rtl/src/pixelflow/array.rs:109
    wire u_controller_sends;                                     // rtl/src/pixelflow/array.rs:109
    wire [1:0] u_controller_control_source;                      // rtl/src/pixelflow/array.rs:109
    wire [7:0] u_controller_control_constant;                    // rtl/src/pixelflow/array.rs:109
    wire [3:0] u_controller_control_function;                    // rtl/src/pixelflow/array.rs:109
    wire [1:0] u_controller_control_begin;                       // rtl/src/pixelflow/array.rs:109
    wire [1:0] u_controller_control_mask;                        // rtl/src/pixelflow/array.rs:109
    wire u_controller_control_accumulates;                       // rtl/src/pixelflow/array.rs:109
    wire u_controller_control_stores;                            // rtl/src/pixelflow/array.rs:109
    wire [1:0] u_controller_control_condition;                   // rtl/src/pixelflow/array.rs:109
    wire [2:0] u_controller_control_enabling;                    // rtl/src/pixelflow/array.rs:109
    wire u_controller_control_by_sign;                           // rtl/src/pixelflow/array.rs:109
    wire [1:0] u_controller_control_flagging;                    // rtl/src/pixelflow/array.rs:109
    wire [8:0] u_controller_control_read;                        // rtl/src/pixelflow/array.rs:109
    wire [8:0] u_controller_control_write;                       // rtl/src/pixelflow/array.rs:109
    wire [255:0] u_evaluator_value;                              // rtl/src/pixelflow/array.rs:115
    wire [255:0] u_bank0_word;                                   // rtl/src/pixelflow/array.rs:130
    wire [255:0] u_bank1_word;                                   // rtl/src/pixelflow/array.rs:130
    wire [255:0] u_texture_word;                                 // rtl/src/pixelflow/array.rs:130

    wire [31:0] u_bank0_writes;                                  // rtl/src/pixelflow/array.rs:126
    wire [255:0] u_bank0_result;                                 // rtl/src/pixelflow/array.rs:119
    wire [31:0] u_bank1_writes;                                  // rtl/src/pixelflow/array.rs:126
    wire [255:0] u_bank1_result;                                 // rtl/src/pixelflow/array.rs:119
    wire [31:0] u_texture_writes;                                // rtl/src/pixelflow/array.rs:126
    wire [255:0] u_texture_result;                               // rtl/src/pixelflow/array.rs:119

    genvar i;
    genvar j;

    generate
        for (i = 0; i < 2; i = i + 1) begin : u_pixel                // rtl/src/pixelflow/array.rs:141
            for (j = 0; j < 16; j = j + 1) begin : col
                wire [7:0] lane_result;
                wire lane_writes_register;
                wire [7:0] u_pixel_register_byte_choice = u_controller_control_read[5] ? u_bank1_word[(i * 16 + j) * 8 +: 8] : u_bank0_word[(i * 16 + j) * 8 +: 8];

                pixel_processor_depth8 lane (
                    .clk                 (array_clk),
                    .control_source      (u_controller_control_source),
                    .control_constant    (u_controller_control_constant),
                    .control_function    (u_controller_control_function),
                    .control_begin       (u_controller_control_begin),
                    .control_mask        (u_controller_control_mask),
                    .control_accumulates (u_controller_control_accumulates),
                    .control_stores      (u_controller_control_stores),
                    .control_condition   (u_controller_control_condition),
                    .control_enabling    (u_controller_control_enabling),
                    .control_by_sign     (u_controller_control_by_sign),
                    .control_flagging    (u_controller_control_flagging),
                    .control_read        (u_controller_control_read),
                    .control_write       (u_controller_control_write),
                    .expression          (u_evaluator_value[(i * 16 + j) * 8 +: 8]),
                    .register_byte       (u_controller_control_read[6] ? u_texture_word[(i * 16 + j) * 8 +: 8] : u_pixel_register_byte_choice),
                    .result              (lane_result),
                    .writes_register     (lane_writes_register)
                );
            end
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : result_cells
            for (j = 0; j < 16; j = j + 1) begin : col
                wire [7:0] result = u_pixel[i].col[j].lane_result;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : writes_register_cells
            for (j = 0; j < 16; j = j + 1) begin : col
                wire writes_register = u_pixel[i].col[j].lane_writes_register;
                wire u_bank0_writes_and = writes_register & (!u_controller_control_write[6] & !u_controller_control_write[5]);
                wire u_bank1_writes_and = writes_register & (!u_controller_control_write[6] & u_controller_control_write[5]);
                wire u_texture_writes_and = writes_register & u_controller_control_write[6];
            end
        end
    endgenerate

    array_controller_width8_height4 u_controller (               // rtl/src/pixelflow/array.rs:109
        .clk                      (array_clk),
        .rst                      (array_rst),
        .instructions_valid       (instructions_valid),
        .instructions_source      (instructions_source),
        .instructions_function    (instructions_function),
        .instructions_begin       (instructions_begin),
        .instructions_mask        (instructions_mask),
        .instructions_accumulates (instructions_accumulates),
        .instructions_stores      (instructions_stores),
        .instructions_condition   (instructions_condition),
        .instructions_enabling    (instructions_enabling),
        .instructions_flagging    (instructions_flagging),
        .instructions_skip        (instructions_skip),
        .instructions_length      (instructions_length),
        .instructions_descends    (instructions_descends),
        .instructions_read        (instructions_read),
        .instructions_write       (instructions_write),
        .instructions_sync        (instructions_sync),
        .instructions_a           (instructions_a),
        .instructions_b           (instructions_b),
        .instructions_c           (instructions_c),
        .side_by_side             (side_by_side),
        .bank_done                (bank_done),
        .texture_done             (texture_done),
        .coefficients_a           (u_controller_coefficients_a),
        .coefficients_b           (u_controller_coefficients_b),
        .coefficients_c           (u_controller_coefficients_c),
        .first                    (u_controller_first),
        .sends                    (u_controller_sends),
        .control_source           (u_controller_control_source),
        .control_constant         (u_controller_control_constant),
        .control_function         (u_controller_control_function),
        .control_begin            (u_controller_control_begin),
        .control_mask             (u_controller_control_mask),
        .control_accumulates      (u_controller_control_accumulates),
        .control_stores           (u_controller_control_stores),
        .control_condition        (u_controller_control_condition),
        .control_enabling         (u_controller_control_enabling),
        .control_by_sign          (u_controller_control_by_sign),
        .control_flagging         (u_controller_control_flagging),
        .control_read             (u_controller_control_read),
        .control_write            (u_controller_control_write),
        .given_banks              (given_banks),
        .given_texture            (given_texture),
        .idle                     (idle),
        .instructions_ready       (instructions_ready)
    );

    linear_evaluator_width8_height4 u_evaluator (                // rtl/src/pixelflow/array.rs:115
        .clk            (array_clk),
        .rst            (array_rst),
        .coefficients_a (u_controller_coefficients_a),
        .coefficients_b (u_controller_coefficients_b),
        .coefficients_c (u_controller_coefficients_c),
        .first          (u_controller_first),
        .sends          (u_controller_sends),
        .value          (u_evaluator_value)
    );

    communication_registers_width8_height4_bytes32_port_network u_bank0 ( // rtl/src/pixelflow/array.rs:130
        .array_clk    (array_clk),
        .network_clk  (network_clk),
        .read         (u_controller_control_read[4:0]),
        .write        (u_controller_control_write[4:0]),
        .writes       (u_bank0_writes),
        .result       (u_bank0_result),
        .port_pixel   (network_0_pixel),
        .port_address (network_0_address),
        .port_writes  (network_0_writes),
        .port_bytes   (network_0_bytes),
        .word         (u_bank0_word),
        .seen         (network_seen_0)
    );

    communication_registers_width8_height4_bytes32_port_network u_bank1 ( // rtl/src/pixelflow/array.rs:130
        .array_clk    (array_clk),
        .network_clk  (network_clk),
        .read         (u_controller_control_read[4:0]),
        .write        (u_controller_control_write[4:0]),
        .writes       (u_bank1_writes),
        .result       (u_bank1_result),
        .port_pixel   (network_1_pixel),
        .port_address (network_1_address),
        .port_writes  (network_1_writes),
        .port_bytes   (network_1_bytes),
        .word         (u_bank1_word),
        .seen         (network_seen_1)
    );

    communication_registers_width8_height4_bytes64_port_array u_texture ( // rtl/src/pixelflow/array.rs:130
        .array_clk    (array_clk),
        .read         (u_controller_control_read[5:0]),
        .write        (u_controller_control_write[5:0]),
        .writes       (u_texture_writes),
        .result       (u_texture_result),
        .port_pixel   (texture_pixel),
        .port_address (texture_address),
        .port_writes  (texture_writes),
        .port_bytes   (texture_bytes),
        .word         (u_texture_word),
        .seen         (texture_seen)
    );

    generate
        for (i = 0; i < 2; i = i + 1) begin : u_bank0_writes_of
            for (j = 0; j < 16; j = j + 1) begin : u_bank0_writes_col
                assign u_bank0_writes[i * 16 + j] = writes_register_cells[i].col[j].u_bank0_writes_and;
            end
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : u_bank0_result_of
            for (j = 0; j < 16; j = j + 1) begin : u_bank0_result_col
                assign u_bank0_result[(i * 16 + j) * 8 +: 8] = result_cells[i].col[j].result;
            end
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : u_bank1_writes_of
            for (j = 0; j < 16; j = j + 1) begin : u_bank1_writes_col
                assign u_bank1_writes[i * 16 + j] = writes_register_cells[i].col[j].u_bank1_writes_and;
            end
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : u_bank1_result_of
            for (j = 0; j < 16; j = j + 1) begin : u_bank1_result_col
                assign u_bank1_result[(i * 16 + j) * 8 +: 8] = result_cells[i].col[j].result;
            end
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : u_texture_writes_of
            for (j = 0; j < 16; j = j + 1) begin : u_texture_writes_col
                assign u_texture_writes[i * 16 + j] = writes_register_cells[i].col[j].u_texture_writes_and;
            end
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : u_texture_result_of
            for (j = 0; j < 16; j = j + 1) begin : u_texture_result_col
                assign u_texture_result[(i * 16 + j) * 8 +: 8] = result_cells[i].col[j].result;
            end
        end
    endgenerate
endmodule
`default_nettype wire
