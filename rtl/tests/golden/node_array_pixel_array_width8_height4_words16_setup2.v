// node_array_pixel_array_width8_height4_words16_setup2
//
// A node of PixelFlow without its geometry processors.
//
// Parameters  Node { array: PixelArray { width: 8, height: 4 }, words: 16, setup: 2 }
// Latency     1 clock of the network for a byte of each chip; in the array, the clocks of each instruction
// Source      Reducing Latency on PixelFlow, section 3 (PFL-NODE, PFL-NET)
// Described   rtl/src/pixelflow/node.rs:69
`default_nettype none

module node_array_pixel_array_width8_height4_words16_setup2 (
    input  wire        array_clk,
    input  wire        array_rst,
    input  wire        network_clk,
    input  wire        network_rst,
    // A write to the instruction memory.
    input  wire        store_writes,                  // An instruction is written.
    input  wire [3:0]  store_address,                 // The address at which the instruction is written.
    // The instruction that is written.
    input  wire [1:0]  store_instruction_source,      // Where the operand comes from: a `Source`.
    input  wire [3:0]  store_instruction_function,    // The function of the ALU: a `Function`.
    input  wire [1:0]  store_instruction_begin,       // The carry that comes into the first byte: a `Begin`.
    input  wire [1:0]  store_instruction_mask,        // Which processors write: a `Mask`.
    input  wire        store_instruction_accumulates, // Results go to the accumulator.
    input  wire        store_instruction_stores,      // Results go to memory.
    // What the last byte's `enabling` and `flagging` depend on: a `Condition`.
    input  wire [1:0]  store_instruction_condition,
    // The change of the enable flags with the last byte: an `Enabling`.
    input  wire [2:0]  store_instruction_enabling,
    input  wire [1:0]  store_instruction_flagging,    // The change of the flag with the last byte: a `Flagging`.
    // The number of bytes of the expression before the word; 0 without an expression.
    input  wire [2:0]  store_instruction_skip,
    input  wire [3:0]  store_instruction_length,      // The number of bytes of the word: 1 to `LONGEST`.
    // Addresses decrease from byte to byte, most significant byte first: for shifts to the right.
    input  wire        store_instruction_descends,
    input  wire [8:0]  store_instruction_read,        // The address of the first byte that is read.
    input  wire [8:0]  store_instruction_write,       // The address of the first byte that is written.
    input  wire [2:0]  store_instruction_sync,        // The synchronization with the ports: a `Sync`.
    input  wire [39:0] store_instruction_a,           // Coefficient A of the expression, in two's complement.
    input  wire [39:0] store_instruction_b,           // Coefficient B of the expression, in two's complement.
    // Coefficient C of the expression, in two's complement, relative to the region. Without an expression, C is the
    // constant, least significant byte first; its sign extends it to a longer word.
    input  wire [39:0] store_instruction_c,
    // The frames to execute, one after another.
    input  wire        frames_valid,
    input  wire [3:0]  frames_base,                   // The address of the frame's first instruction.
    // The number of the frame's instructions; addresses wrap at the end of the memory.
    input  wire [4:0]  frames_length,
    // Evaluator and memory may execute two instructions at once; while this is low, they execute one at a time.
    input  wire        side_by_side,
    // The texture unit's access to its registers.
    input  wire [3:0]  texture_pixel,                 // The pixel of each chip, counted line by line.
    input  wire [5:0]  texture_address,               // The register of the pixel.
    input  wire        texture_writes,                // The register is written.
    input  wire [15:0] texture_bytes,                 // The bytes to write, one of each chip.
    input  wire        texture_done,                  // For one clock: the texture unit is done.
    // The inputs from both directions of the network.
    // The jobs of the node, one for each word.
    input  wire        network_0_jobs_valid,
    input  wire [1:0]  network_0_jobs_mode,           // The mode of the node for the word: a `Mode`.
    input  wire        network_0_jobs_bank,           // The bank of the word, unless the node forwards.
    // The bytes of the word, 1 to 32; or 0 before the node that loads, where the mode has to be `Mode::Forward`.
    input  wire [5:0]  network_0_jobs_bytes,
    input  wire        network_0_go,                  // All nodes are ready.
    // The bytes from the previous node.
    input  wire        network_0_upstream_valid,      // A byte of each chip is transferred.
    input  wire        network_0_upstream_first,      // The byte is the first of a word.
    input  wire [15:0] network_0_upstream_bytes,      // The bytes, one of each chip.
    input  wire        network_1_jobs_valid,
    input  wire [1:0]  network_1_jobs_mode,
    input  wire        network_1_jobs_bank,
    input  wire [5:0]  network_1_jobs_bytes,
    input  wire        network_1_go,
    input  wire        network_1_upstream_valid,
    input  wire        network_1_upstream_first,
    input  wire [15:0] network_1_upstream_bytes,
    output wire [15:0] texture_seen,                  // The byte of each chip that the texture unit reads.
    output wire        texture_starts,                // For one clock: the texture unit begins.
    // All instructions have left the controller; the pixels execute the last one after the evaluator's latency.
    output wire        idle,
    // The outputs to both directions of the network.
    output wire        network_0_ready,               // The node is ready for its word.
    output wire        network_0_idle,                // The node has no job in this direction.
    // The bytes to the next node.
    output wire        network_0_downstream_valid,    // A byte of each chip is transferred.
    output wire        network_0_downstream_first,    // The byte is the first of a word.
    output wire [15:0] network_0_downstream_bytes,    // The bytes, one of each chip.
    output wire        network_1_ready,
    output wire        network_1_idle,
    output wire        network_1_downstream_valid,
    output wire        network_1_downstream_first,
    output wire [15:0] network_1_downstream_bytes,
    output wire        frames_ready,
    output wire        network_0_jobs_ready,
    output wire        network_1_jobs_ready
);

    reg done_flag1;                                              // rtl/src/pixelflow/node.rs:198
    (* ASYNC_REG = "TRUE" *) reg done_here1_meta;                // rtl/src/pixelflow/node.rs:199
    (* ASYNC_REG = "TRUE" *) reg done_here1;                     // rtl/src/pixelflow/node.rs:199
    reg done_before1;                                            // rtl/src/pixelflow/node.rs:200
    reg done_flag0;                                              // rtl/src/pixelflow/node.rs:198
    (* ASYNC_REG = "TRUE" *) reg done_here0_meta;                // rtl/src/pixelflow/node.rs:199
    (* ASYNC_REG = "TRUE" *) reg done_here0;                     // rtl/src/pixelflow/node.rs:199
    reg done_before0;                                            // rtl/src/pixelflow/node.rs:200
    reg [1:0] held;                                              // rtl/src/pixelflow/node.rs:121
    reg given_flag1;                                             // rtl/src/pixelflow/node.rs:198
    (* ASYNC_REG = "TRUE" *) reg given_here1_meta;               // rtl/src/pixelflow/node.rs:199
    (* ASYNC_REG = "TRUE" *) reg given_here1;                    // rtl/src/pixelflow/node.rs:199
    reg given_before1;                                           // rtl/src/pixelflow/node.rs:200
    reg given_flag0;                                             // rtl/src/pixelflow/node.rs:198
    (* ASYNC_REG = "TRUE" *) reg given_here0_meta;               // rtl/src/pixelflow/node.rs:199
    (* ASYNC_REG = "TRUE" *) reg given_here0;                    // rtl/src/pixelflow/node.rs:199
    reg given_before0;                                           // rtl/src/pixelflow/node.rs:200

    wire u_dma_instructions_valid;                               // rtl/src/pixelflow/node.rs:117
    wire [1:0] u_dma_instructions_source;                        // rtl/src/pixelflow/node.rs:117
    wire [3:0] u_dma_instructions_function;                      // rtl/src/pixelflow/node.rs:117
    wire [1:0] u_dma_instructions_begin;                         // rtl/src/pixelflow/node.rs:117
    wire [1:0] u_dma_instructions_mask;                          // rtl/src/pixelflow/node.rs:117
    wire u_dma_instructions_accumulates;                         // rtl/src/pixelflow/node.rs:117
    wire u_dma_instructions_stores;                              // rtl/src/pixelflow/node.rs:117
    wire [1:0] u_dma_instructions_condition;                     // rtl/src/pixelflow/node.rs:117
    wire [2:0] u_dma_instructions_enabling;                      // rtl/src/pixelflow/node.rs:117
    wire [1:0] u_dma_instructions_flagging;                      // rtl/src/pixelflow/node.rs:117
    wire [2:0] u_dma_instructions_skip;                          // rtl/src/pixelflow/node.rs:117
    wire [3:0] u_dma_instructions_length;                        // rtl/src/pixelflow/node.rs:117
    wire u_dma_instructions_descends;                            // rtl/src/pixelflow/node.rs:117
    wire [8:0] u_dma_instructions_read;                          // rtl/src/pixelflow/node.rs:117
    wire [8:0] u_dma_instructions_write;                         // rtl/src/pixelflow/node.rs:117
    wire [2:0] u_dma_instructions_sync;                          // rtl/src/pixelflow/node.rs:117
    wire [39:0] u_dma_instructions_a;                            // rtl/src/pixelflow/node.rs:117
    wire [39:0] u_dma_instructions_b;                            // rtl/src/pixelflow/node.rs:117
    wire [39:0] u_dma_instructions_c;                            // rtl/src/pixelflow/node.rs:117
    wire u_dma_idle;                                             // rtl/src/pixelflow/node.rs:117
    wire [1:0] u_sequencer0_mode;                                // rtl/src/pixelflow/node.rs:166
    wire u_sequencer0_sends;                                     // rtl/src/pixelflow/node.rs:166
    wire u_sequencer0_first;                                     // rtl/src/pixelflow/node.rs:166
    wire [1:0] u_sequencer0_bank;                                // rtl/src/pixelflow/node.rs:166
    wire [4:0] u_sequencer0_address;                             // rtl/src/pixelflow/node.rs:166
    wire [1:0] u_sequencer0_done;                                // rtl/src/pixelflow/node.rs:166
    wire [3:0] pixel0;                                           // rtl/src/pixelflow/node.rs:161
    wire advances0;                                              // rtl/src/pixelflow/node.rs:162
    wire u_port0_unloaded;                                       // rtl/src/pixelflow/node.rs:169
    wire [1:0] u_sequencer1_mode;                                // rtl/src/pixelflow/node.rs:166
    wire u_sequencer1_sends;                                     // rtl/src/pixelflow/node.rs:166
    wire u_sequencer1_first;                                     // rtl/src/pixelflow/node.rs:166
    wire [1:0] u_sequencer1_bank;                                // rtl/src/pixelflow/node.rs:166
    wire [4:0] u_sequencer1_address;                             // rtl/src/pixelflow/node.rs:166
    wire [1:0] u_sequencer1_done;                                // rtl/src/pixelflow/node.rs:166
    wire [3:0] pixel1;                                           // rtl/src/pixelflow/node.rs:161
    wire advances1;                                              // rtl/src/pixelflow/node.rs:162
    wire u_port1_unloaded;                                       // rtl/src/pixelflow/node.rs:169
    wire [1:0] given;                                            // rtl/src/pixelflow/node.rs:118
    wire [15:0] u_array_network_seen_0;                          // rtl/src/pixelflow/node.rs:146
    wire [15:0] u_array_network_seen_1;                          // rtl/src/pixelflow/node.rs:146
    wire u_array_idle;                                           // rtl/src/pixelflow/node.rs:146
    wire u_array_instructions_ready;                             // rtl/src/pixelflow/node.rs:146

    wire [15:0] u_port0_own;                                     // rtl/src/pixelflow/node.rs:167
    wire [15:0] u_port1_own;                                     // rtl/src/pixelflow/node.rs:167
    wire [15:0] u_array_network_0_bytes;                         // rtl/src/pixelflow/node.rs:136
    wire [15:0] u_array_network_1_bytes;                         // rtl/src/pixelflow/node.rs:136
    wire [1:0] done = u_sequencer0_done | u_sequencer1_done;     // rtl/src/pixelflow/node.rs:119
    wire [1:0] held_joined = {given_here1 ^ given_before1, given_here0 ^ given_before0}; // rtl/src/pixelflow/node.rs:204
    wire u_array_network_0_writes_and = u_port1_unloaded & u_sequencer1_bank[0]; // rtl/src/pixelflow/node.rs:189
    wire u_array_network_0_writes_and_2 = u_port0_unloaded & u_sequencer0_bank[0]; // rtl/src/pixelflow/node.rs:189
    wire u_array_network_1_writes_and = u_port1_unloaded & u_sequencer1_bank[1]; // rtl/src/pixelflow/node.rs:189
    wire u_array_network_1_writes_and_2 = u_port0_unloaded & u_sequencer0_bank[1]; // rtl/src/pixelflow/node.rs:189
    assign idle = u_array_idle & u_dma_idle;                     // rtl/src/pixelflow/node.rs:152

    genvar i;

    generate
        for (i = 0; i < 2; i = i + 1) begin : seen0_row
            wire [7:0] seen0 = u_array_network_seen_0[i * 8 +: 8];
            wire [7:0] seen1 = u_array_network_seen_1[i * 8 +: 8];
            wire [7:0] u_port0_own_choice = u_sequencer0_bank[1] ? seen1 : seen0;
            wire [7:0] u_port1_own_choice = u_sequencer1_bank[1] ? seen1 : seen0;
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : u_array_network_0_bytes_choice_row
            wire [7:0] u_array_network_0_bytes_choice = u_sequencer1_bank[0] ? network_1_upstream_bytes[i * 8 +: 8] : network_0_upstream_bytes[i * 8 +: 8];
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : u_array_network_1_bytes_choice_row
            wire [7:0] u_array_network_1_bytes_choice = u_sequencer1_bank[1] ? network_1_upstream_bytes[i * 8 +: 8] : network_0_upstream_bytes[i * 8 +: 8];
        end
    endgenerate

    command_dma_words16 u_dma (                                  // rtl/src/pixelflow/node.rs:117
        .clk                           (array_clk),
        .rst                           (array_rst),
        .store_writes                  (store_writes),
        .store_address                 (store_address),
        .store_instruction_source      (store_instruction_source),
        .store_instruction_function    (store_instruction_function),
        .store_instruction_begin       (store_instruction_begin),
        .store_instruction_mask        (store_instruction_mask),
        .store_instruction_accumulates (store_instruction_accumulates),
        .store_instruction_stores      (store_instruction_stores),
        .store_instruction_condition   (store_instruction_condition),
        .store_instruction_enabling    (store_instruction_enabling),
        .store_instruction_flagging    (store_instruction_flagging),
        .store_instruction_skip        (store_instruction_skip),
        .store_instruction_length      (store_instruction_length),
        .store_instruction_descends    (store_instruction_descends),
        .store_instruction_read        (store_instruction_read),
        .store_instruction_write       (store_instruction_write),
        .store_instruction_sync        (store_instruction_sync),
        .store_instruction_a           (store_instruction_a),
        .store_instruction_b           (store_instruction_b),
        .store_instruction_c           (store_instruction_c),
        .frames_valid                  (frames_valid),
        .frames_base                   (frames_base),
        .frames_length                 (frames_length),
        .instructions_ready            (u_array_instructions_ready),
        .instructions_valid            (u_dma_instructions_valid),
        .instructions_source           (u_dma_instructions_source),
        .instructions_function         (u_dma_instructions_function),
        .instructions_begin            (u_dma_instructions_begin),
        .instructions_mask             (u_dma_instructions_mask),
        .instructions_accumulates      (u_dma_instructions_accumulates),
        .instructions_stores           (u_dma_instructions_stores),
        .instructions_condition        (u_dma_instructions_condition),
        .instructions_enabling         (u_dma_instructions_enabling),
        .instructions_flagging         (u_dma_instructions_flagging),
        .instructions_skip             (u_dma_instructions_skip),
        .instructions_length           (u_dma_instructions_length),
        .instructions_descends         (u_dma_instructions_descends),
        .instructions_read             (u_dma_instructions_read),
        .instructions_write            (u_dma_instructions_write),
        .instructions_sync             (u_dma_instructions_sync),
        .instructions_a                (u_dma_instructions_a),
        .instructions_b                (u_dma_instructions_b),
        .instructions_c                (u_dma_instructions_c),
        .idle                          (u_dma_idle),
        .frames_ready                  (frames_ready)
    );

    network_sequencer_pixels16_setup2 u_sequencer0 (             // rtl/src/pixelflow/node.rs:166
        .clk        (network_clk),
        .rst        (network_rst),
        .jobs_valid (network_0_jobs_valid),
        .jobs_mode  (network_0_jobs_mode),
        .jobs_bank  (network_0_jobs_bank),
        .jobs_bytes (network_0_jobs_bytes),
        .given      (held),
        .go         (network_0_go),
        .pixel      (pixel0),
        .advances   (advances0),
        .mode       (u_sequencer0_mode),
        .sends      (u_sequencer0_sends),
        .first      (u_sequencer0_first),
        .bank       (u_sequencer0_bank),
        .address    (u_sequencer0_address),
        .ready      (network_0_ready),
        .done       (u_sequencer0_done),
        .idle       (network_0_idle),
        .jobs_ready (network_0_jobs_ready)
    );

    network_port_chips2_pixels16_width8 u_port0 (                // rtl/src/pixelflow/node.rs:169
        .clk              (network_clk),
        .rst              (network_rst),
        .mode             (u_sequencer0_mode),
        .sends            (u_sequencer0_sends),
        .first            (u_sequencer0_first),
        .upstream_valid   (network_0_upstream_valid),
        .upstream_first   (network_0_upstream_first),
        .upstream_bytes   (network_0_upstream_bytes),
        .own              (u_port0_own),
        .pixel            (pixel0),
        .advances         (advances0),
        .unloaded         (u_port0_unloaded),
        .downstream_valid (network_0_downstream_valid),
        .downstream_first (network_0_downstream_first),
        .downstream_bytes (network_0_downstream_bytes)
    );

    network_sequencer_pixels16_setup2 u_sequencer1 (             // rtl/src/pixelflow/node.rs:166
        .clk        (network_clk),
        .rst        (network_rst),
        .jobs_valid (network_1_jobs_valid),
        .jobs_mode  (network_1_jobs_mode),
        .jobs_bank  (network_1_jobs_bank),
        .jobs_bytes (network_1_jobs_bytes),
        .given      (held),
        .go         (network_1_go),
        .pixel      (pixel1),
        .advances   (advances1),
        .mode       (u_sequencer1_mode),
        .sends      (u_sequencer1_sends),
        .first      (u_sequencer1_first),
        .bank       (u_sequencer1_bank),
        .address    (u_sequencer1_address),
        .ready      (network_1_ready),
        .done       (u_sequencer1_done),
        .idle       (network_1_idle),
        .jobs_ready (network_1_jobs_ready)
    );

    network_port_chips2_pixels16_width8 u_port1 (                // rtl/src/pixelflow/node.rs:169
        .clk              (network_clk),
        .rst              (network_rst),
        .mode             (u_sequencer1_mode),
        .sends            (u_sequencer1_sends),
        .first            (u_sequencer1_first),
        .upstream_valid   (network_1_upstream_valid),
        .upstream_first   (network_1_upstream_first),
        .upstream_bytes   (network_1_upstream_bytes),
        .own              (u_port1_own),
        .pixel            (pixel1),
        .advances         (advances1),
        .unloaded         (u_port1_unloaded),
        .downstream_valid (network_1_downstream_valid),
        .downstream_first (network_1_downstream_first),
        .downstream_bytes (network_1_downstream_bytes)
    );

    pixel_array_width8_height4 u_array (                         // rtl/src/pixelflow/node.rs:146
        .array_clk                (array_clk),
        .array_rst                (array_rst),
        .network_clk              (network_clk),
        .instructions_valid       (u_dma_instructions_valid),
        .instructions_source      (u_dma_instructions_source),
        .instructions_function    (u_dma_instructions_function),
        .instructions_begin       (u_dma_instructions_begin),
        .instructions_mask        (u_dma_instructions_mask),
        .instructions_accumulates (u_dma_instructions_accumulates),
        .instructions_stores      (u_dma_instructions_stores),
        .instructions_condition   (u_dma_instructions_condition),
        .instructions_enabling    (u_dma_instructions_enabling),
        .instructions_flagging    (u_dma_instructions_flagging),
        .instructions_skip        (u_dma_instructions_skip),
        .instructions_length      (u_dma_instructions_length),
        .instructions_descends    (u_dma_instructions_descends),
        .instructions_read        (u_dma_instructions_read),
        .instructions_write       (u_dma_instructions_write),
        .instructions_sync        (u_dma_instructions_sync),
        .instructions_a           (u_dma_instructions_a),
        .instructions_b           (u_dma_instructions_b),
        .instructions_c           (u_dma_instructions_c),
        .side_by_side             (side_by_side),
        .bank_done                ({done_here1 ^ done_before1, done_here0 ^ done_before0}),
        .texture_done             (texture_done),
        .network_0_pixel          (u_sequencer1_bank[0] ? pixel1 : pixel0),
        .network_0_address        (u_sequencer1_bank[0] ? u_sequencer1_address : u_sequencer0_address),
        .network_0_writes         (u_sequencer1_bank[0] ? u_array_network_0_writes_and : u_array_network_0_writes_and_2),
        .network_0_bytes          (u_array_network_0_bytes),
        .network_1_pixel          (u_sequencer1_bank[1] ? pixel1 : pixel0),
        .network_1_address        (u_sequencer1_bank[1] ? u_sequencer1_address : u_sequencer0_address),
        .network_1_writes         (u_sequencer1_bank[1] ? u_array_network_1_writes_and : u_array_network_1_writes_and_2),
        .network_1_bytes          (u_array_network_1_bytes),
        .texture_pixel            (texture_pixel),
        .texture_address          (texture_address),
        .texture_writes           (texture_writes),
        .texture_bytes            (texture_bytes),
        .given_banks              (given),
        .given_texture            (texture_starts),
        .network_seen_0           (u_array_network_seen_0),
        .network_seen_1           (u_array_network_seen_1),
        .texture_seen             (texture_seen),
        .idle                     (u_array_idle),
        .instructions_ready       (u_array_instructions_ready)
    );

    generate
        for (i = 0; i < 2; i = i + 1) begin : u_port0_own_of
            assign u_port0_own[i * 8 +: 8] = seen0_row[i].u_port0_own_choice;
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : u_port1_own_of
            assign u_port1_own[i * 8 +: 8] = seen0_row[i].u_port1_own_choice;
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : u_array_network_0_bytes_of
            assign u_array_network_0_bytes[i * 8 +: 8] = u_array_network_0_bytes_choice_row[i].u_array_network_0_bytes_choice;
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : u_array_network_1_bytes_of
            assign u_array_network_1_bytes[i * 8 +: 8] = u_array_network_1_bytes_choice_row[i].u_array_network_1_bytes_choice;
        end
    endgenerate

    always @(posedge network_clk) begin
        if (network_rst) begin
            done_flag1 <= 1'b0;
            done_flag0 <= 1'b0;
            held <= 2'd0;
            given_here1_meta <= 1'b0;
            given_here1 <= 1'b0;
            given_before1 <= 1'b0;
            given_here0_meta <= 1'b0;
            given_here0 <= 1'b0;
            given_before0 <= 1'b0;
        end else begin
            if (done[1]) done_flag1 <= !done_flag1;
            if (done[0]) done_flag0 <= !done_flag0;
            held <= (held & ~done) | held_joined;
            given_here1_meta <= given_flag1;
            given_here1 <= given_here1_meta;
            given_before1 <= given_here1;
            given_here0_meta <= given_flag0;
            given_here0 <= given_here0_meta;
            given_before0 <= given_here0;
        end
    end

    always @(posedge array_clk) begin
        if (array_rst) begin
            done_here1_meta <= 1'b0;
            done_here1 <= 1'b0;
            done_before1 <= 1'b0;
            done_here0_meta <= 1'b0;
            done_here0 <= 1'b0;
            done_before0 <= 1'b0;
            given_flag1 <= 1'b0;
            given_flag0 <= 1'b0;
        end else begin
            done_here1_meta <= done_flag1;
            done_here1 <= done_here1_meta;
            done_before1 <= done_here1;
            done_here0_meta <= done_flag0;
            done_here0 <= done_here0_meta;
            done_before0 <= done_here0;
            if (given[1]) given_flag1 <= !given_flag1;
            if (given[0]) given_flag0 <= !given_flag0;
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
    always @(posedge network_clk) begin
        if (!network_rst) assert ((u_sequencer0_bank & u_sequencer1_bank) == 2'd0); // rtl/src/pixelflow/node.rs:134
    end
`else
    always @(posedge network_clk) begin
        if (!network_rst && !((u_sequencer0_bank & u_sequencer1_bank) == 2'd0)) begin // rtl/src/pixelflow/node.rs:134
            $display("FAIL: time %0t: %m: a bank belongs to one direction at a time", $time);
            stop;
        end
    end
`endif
`endif
endmodule
`default_nettype wire
