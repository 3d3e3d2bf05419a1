// pixel_flow_nodes3_array_pixel_array_width8_height4_words16_setup2
//
// PixelFlow's nodes on a network with two directions.
//
// Parameters  PixelFlow { nodes: 3, node: Node { array: PixelArray { width: 8, height: 4 }, words: 16, setup: 2 } }
// Latency     1 clock of the network per node; in the array, the clocks of each instruction
// Source      Reducing Latency on PixelFlow, section 3 (PFL-NODE, PFL-NET)
// Described   rtl/src/pixelflow/machine.rs:40
`default_nettype none

module pixel_flow_nodes3_array_pixel_array_width8_height4_words16_setup2 (
    input  wire        array_clk,
    input  wire        array_rst,
    input  wire        network_clk,
    input  wire        network_rst,
    // A write to the instruction memory of each node.
    input  wire        stores_0_writes,                  // An instruction is written.
    input  wire [3:0]  stores_0_address,                 // The address at which the instruction is written.
    // The instruction that is written.
    input  wire [1:0]  stores_0_instruction_source,      // Where the operand comes from: a `Source`.
    input  wire [3:0]  stores_0_instruction_function,    // The function of the ALU: a `Function`.
    input  wire [1:0]  stores_0_instruction_begin,       // The carry that comes into the first byte: a `Begin`.
    input  wire [1:0]  stores_0_instruction_mask,        // Which processors write: a `Mask`.
    input  wire        stores_0_instruction_accumulates, // Results go to the accumulator.
    input  wire        stores_0_instruction_stores,      // Results go to memory.
    // What the last byte's `enabling` and `flagging` depend on: a `Condition`.
    input  wire [1:0]  stores_0_instruction_condition,
    // The change of the enable flags with the last byte: an `Enabling`.
    input  wire [2:0]  stores_0_instruction_enabling,
    input  wire [1:0]  stores_0_instruction_flagging,    // The change of the flag with the last byte: a `Flagging`.
    // The number of bytes of the expression before the word; 0 without an expression.
    input  wire [2:0]  stores_0_instruction_skip,
    input  wire [3:0]  stores_0_instruction_length,      // The number of bytes of the word: 1 to `LONGEST`.
    // Addresses decrease from byte to byte, most significant byte first: for shifts to the right.
    input  wire        stores_0_instruction_descends,
    input  wire [8:0]  stores_0_instruction_read,        // The address of the first byte that is read.
    input  wire [8:0]  stores_0_instruction_write,       // The address of the first byte that is written.
    input  wire [2:0]  stores_0_instruction_sync,        // The synchronization with the ports: a `Sync`.
    input  wire [39:0] stores_0_instruction_a,           // Coefficient A of the expression, in two's complement.
    input  wire [39:0] stores_0_instruction_b,           // Coefficient B of the expression, in two's complement.
    // Coefficient C of the expression, in two's complement, relative to the region. Without an expression, C is the
    // constant, least significant byte first; its sign extends it to a longer word.
    input  wire [39:0] stores_0_instruction_c,
    input  wire        stores_1_writes,
    input  wire [3:0]  stores_1_address,
    input  wire [1:0]  stores_1_instruction_source,
    input  wire [3:0]  stores_1_instruction_function,
    input  wire [1:0]  stores_1_instruction_begin,
    input  wire [1:0]  stores_1_instruction_mask,
    input  wire        stores_1_instruction_accumulates,
    input  wire        stores_1_instruction_stores,
    input  wire [1:0]  stores_1_instruction_condition,
    input  wire [2:0]  stores_1_instruction_enabling,
    input  wire [1:0]  stores_1_instruction_flagging,
    input  wire [2:0]  stores_1_instruction_skip,
    input  wire [3:0]  stores_1_instruction_length,
    input  wire        stores_1_instruction_descends,
    input  wire [8:0]  stores_1_instruction_read,
    input  wire [8:0]  stores_1_instruction_write,
    input  wire [2:0]  stores_1_instruction_sync,
    input  wire [39:0] stores_1_instruction_a,
    input  wire [39:0] stores_1_instruction_b,
    input  wire [39:0] stores_1_instruction_c,
    input  wire        stores_2_writes,
    input  wire [3:0]  stores_2_address,
    input  wire [1:0]  stores_2_instruction_source,
    input  wire [3:0]  stores_2_instruction_function,
    input  wire [1:0]  stores_2_instruction_begin,
    input  wire [1:0]  stores_2_instruction_mask,
    input  wire        stores_2_instruction_accumulates,
    input  wire        stores_2_instruction_stores,
    input  wire [1:0]  stores_2_instruction_condition,
    input  wire [2:0]  stores_2_instruction_enabling,
    input  wire [1:0]  stores_2_instruction_flagging,
    input  wire [2:0]  stores_2_instruction_skip,
    input  wire [3:0]  stores_2_instruction_length,
    input  wire        stores_2_instruction_descends,
    input  wire [8:0]  stores_2_instruction_read,
    input  wire [8:0]  stores_2_instruction_write,
    input  wire [2:0]  stores_2_instruction_sync,
    input  wire [39:0] stores_2_instruction_a,
    input  wire [39:0] stores_2_instruction_b,
    input  wire [39:0] stores_2_instruction_c,
    // The frames that each node executes, one after another.
    input  wire        frames_0_valid,
    input  wire [3:0]  frames_0_base,                    // The address of the frame's first instruction.
    // The number of the frame's instructions; addresses wrap at the end of the memory.
    input  wire [4:0]  frames_0_length,
    input  wire        frames_1_valid,
    input  wire [3:0]  frames_1_base,
    input  wire [4:0]  frames_1_length,
    input  wire        frames_2_valid,
    input  wire [3:0]  frames_2_base,
    input  wire [4:0]  frames_2_length,
    // Evaluator and memory may execute two instructions at once; while this is low, they execute one at a time.
    input  wire        side_by_side,
    // The access of each node's texture unit to its registers.
    input  wire [3:0]  textures_0_pixel,                 // The pixel of each chip, counted line by line.
    input  wire [5:0]  textures_0_address,               // The register of the pixel.
    input  wire        textures_0_writes,                // The register is written.
    input  wire [15:0] textures_0_bytes,                 // The bytes to write, one of each chip.
    input  wire [3:0]  textures_1_pixel,
    input  wire [5:0]  textures_1_address,
    input  wire        textures_1_writes,
    input  wire [15:0] textures_1_bytes,
    input  wire [3:0]  textures_2_pixel,
    input  wire [5:0]  textures_2_address,
    input  wire        textures_2_writes,
    input  wire [15:0] textures_2_bytes,
    // For one clock: the texture unit of the node is done; a bit for each node.
    input  wire [2:0]  textures_done,
    // The jobs of each node for the words that go forth, from the first node to the last.
    input  wire        forth_0_valid,
    input  wire [1:0]  forth_0_mode,                     // The mode of the node for the word: a `Mode`.
    input  wire        forth_0_bank,                     // The bank of the word, unless the node forwards.
    // The bytes of the word, 1 to 32; or 0 before the node that loads, where the mode has to be `Mode::Forward`.
    input  wire [5:0]  forth_0_bytes,
    input  wire        forth_1_valid,
    input  wire [1:0]  forth_1_mode,
    input  wire        forth_1_bank,
    input  wire [5:0]  forth_1_bytes,
    input  wire        forth_2_valid,
    input  wire [1:0]  forth_2_mode,
    input  wire        forth_2_bank,
    input  wire [5:0]  forth_2_bytes,
    // The jobs of each node for the words that go back, from the last node to the first.
    input  wire        back_0_valid,
    input  wire [1:0]  back_0_mode,                      // The mode of the node for the word: a `Mode`.
    input  wire        back_0_bank,                      // The bank of the word, unless the node forwards.
    // The bytes of the word, 1 to 32; or 0 before the node that loads, where the mode has to be `Mode::Forward`.
    input  wire [5:0]  back_0_bytes,
    input  wire        back_1_valid,
    input  wire [1:0]  back_1_mode,
    input  wire        back_1_bank,
    input  wire [5:0]  back_1_bytes,
    input  wire        back_2_valid,
    input  wire [1:0]  back_2_mode,
    input  wire        back_2_bank,
    input  wire [5:0]  back_2_bytes,
    // The byte of each chip that the texture unit of each node reads.
    output wire [15:0] texture_seen_0,
    output wire [15:0] texture_seen_1,
    output wire [15:0] texture_seen_2,
    // For one clock: the texture unit of the node begins; a bit for each node.
    output wire [2:0]  textures_start,
    // All instructions have left the controller of the node; a bit for each node.
    output wire [2:0]  idle,
    // For each direction: the node has no job; a bit for each node.
    output wire [2:0]  without_job_0,
    output wire [2:0]  without_job_1,
    // For each direction: all nodes are ready for their word.
    output wire        go_0,
    output wire        go_1,
    // For each direction: the bytes that leave the network at its end.
    output wire        off_0_valid,                      // A byte of each chip is transferred.
    output wire        off_0_first,                      // The byte is the first of a word.
    output wire [15:0] off_0_bytes,                      // The bytes, one of each chip.
    output wire        off_1_valid,
    output wire        off_1_first,
    output wire [15:0] off_1_bytes,
    output wire        frames_0_ready,
    output wire        frames_1_ready,
    output wire        frames_2_ready,
    output wire        forth_0_ready,
    output wire        forth_1_ready,
    output wire        forth_2_ready,
    output wire        back_0_ready,
    output wire        back_1_ready,
    output wire        back_2_ready
);

    wire go_forth;                                               // rtl/src/pixelflow/machine.rs:85
    wire go_back;                                                // rtl/src/pixelflow/machine.rs:85

    genvar i;
    genvar j;

    generate
        for (i = 0; i < 3; i = i + 1) begin : u_node_network_0_upstream_bytes_linked_cells_ahead
            for (j = 0; j < 2; j = j + 1) begin : col
                wire [7:0] u_node_network_0_upstream_bytes_linked;
                wire [7:0] u_node_network_1_upstream_bytes_linked;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 3; i = i + 1) begin : u_node_texture_bytes_listed_cells
            for (j = 0; j < 2; j = j + 1) begin : col
                wire [7:0] u_node_texture_bytes_listed;
                case (i)
                    0: begin : u_node_texture_bytes_listed_0 assign u_node_texture_bytes_listed = textures_0_bytes[j * 8 +: 8]; end
                    1: begin : u_node_texture_bytes_listed_1 assign u_node_texture_bytes_listed = textures_1_bytes[j * 8 +: 8]; end
                    default: begin : u_node_texture_bytes_listed_2 assign u_node_texture_bytes_listed = textures_2_bytes[j * 8 +: 8]; end
                endcase
            end
        end
    endgenerate

    wire [2:0] u_node_network_0_jobs_valid = {forth_2_valid, forth_1_valid, forth_0_valid};
    wire [5:0] u_node_network_0_jobs_mode = {forth_2_mode, forth_1_mode, forth_0_mode};
    wire [2:0] u_node_network_0_jobs_bank = {forth_2_bank, forth_1_bank, forth_0_bank};
    wire [17:0] u_node_network_0_jobs_bytes = {forth_2_bytes, forth_1_bytes, forth_0_bytes};
    wire [2:0] u_node_network_1_jobs_valid = {back_2_valid, back_1_valid, back_0_valid};
    wire [5:0] u_node_network_1_jobs_mode = {back_2_mode, back_1_mode, back_0_mode};
    wire [2:0] u_node_network_1_jobs_bank = {back_2_bank, back_1_bank, back_0_bank};
    wire [17:0] u_node_network_1_jobs_bytes = {back_2_bytes, back_1_bytes, back_0_bytes};
    wire [2:0] u_node_store_writes = {stores_2_writes, stores_1_writes, stores_0_writes};
    wire [11:0] u_node_store_address = {stores_2_address, stores_1_address, stores_0_address};
    wire [5:0] u_node_store_instruction_source = {stores_2_instruction_source, stores_1_instruction_source,
            stores_0_instruction_source};
    wire [11:0] u_node_store_instruction_function = {stores_2_instruction_function, stores_1_instruction_function,
            stores_0_instruction_function};
    wire [5:0] u_node_store_instruction_begin = {stores_2_instruction_begin, stores_1_instruction_begin,
            stores_0_instruction_begin};
    wire [5:0] u_node_store_instruction_mask = {
        stores_2_instruction_mask, stores_1_instruction_mask, stores_0_instruction_mask
    };
    wire [2:0] u_node_store_instruction_accumulates = {stores_2_instruction_accumulates, stores_1_instruction_accumulates,
            stores_0_instruction_accumulates};
    wire [2:0] u_node_store_instruction_stores = {stores_2_instruction_stores, stores_1_instruction_stores,
            stores_0_instruction_stores};
    wire [5:0] u_node_store_instruction_condition = {stores_2_instruction_condition, stores_1_instruction_condition,
            stores_0_instruction_condition};
    wire [8:0] u_node_store_instruction_enabling = {stores_2_instruction_enabling, stores_1_instruction_enabling,
            stores_0_instruction_enabling};
    wire [5:0] u_node_store_instruction_flagging = {stores_2_instruction_flagging, stores_1_instruction_flagging,
            stores_0_instruction_flagging};
    wire [8:0] u_node_store_instruction_skip = {
        stores_2_instruction_skip, stores_1_instruction_skip, stores_0_instruction_skip
    };
    wire [11:0] u_node_store_instruction_length = {stores_2_instruction_length, stores_1_instruction_length,
            stores_0_instruction_length};
    wire [2:0] u_node_store_instruction_descends = {stores_2_instruction_descends, stores_1_instruction_descends,
            stores_0_instruction_descends};
    wire [26:0] u_node_store_instruction_read = {
        stores_2_instruction_read, stores_1_instruction_read, stores_0_instruction_read
    };
    wire [26:0] u_node_store_instruction_write = {stores_2_instruction_write, stores_1_instruction_write,
            stores_0_instruction_write};
    wire [8:0] u_node_store_instruction_sync = {
        stores_2_instruction_sync, stores_1_instruction_sync, stores_0_instruction_sync
    };
    wire [119:0] u_node_store_instruction_a = {stores_2_instruction_a, stores_1_instruction_a, stores_0_instruction_a};
    wire [119:0] u_node_store_instruction_b = {stores_2_instruction_b, stores_1_instruction_b, stores_0_instruction_b};
    wire [119:0] u_node_store_instruction_c = {stores_2_instruction_c, stores_1_instruction_c, stores_0_instruction_c};
    wire [2:0] u_node_frames_valid = {frames_2_valid, frames_1_valid, frames_0_valid};
    wire [11:0] u_node_frames_base = {frames_2_base, frames_1_base, frames_0_base};
    wire [14:0] u_node_frames_length = {frames_2_length, frames_1_length, frames_0_length};
    wire [11:0] u_node_texture_pixel = {textures_2_pixel, textures_1_pixel, textures_0_pixel};
    wire [17:0] u_node_texture_address = {textures_2_address, textures_1_address, textures_0_address};
    wire [2:0] u_node_texture_writes = {textures_2_writes, textures_1_writes, textures_0_writes};
    generate
        for (i = 0; i < 3; i = i + 1) begin : u_node                 // rtl/src/pixelflow/machine.rs:87
            wire [15:0] texture_seen;
            wire texture_starts;
            wire lane_idle;
            wire network_0_ready;
            wire network_0_idle;
            wire network_0_downstream_valid;
            wire network_0_downstream_first;
            wire [15:0] network_0_downstream_bytes;
            wire network_1_ready;
            wire network_1_idle;
            wire network_1_downstream_valid;
            wire network_1_downstream_first;
            wire [15:0] network_1_downstream_bytes;
            wire frames_ready;
            wire network_0_jobs_ready;
            wire network_1_jobs_ready;
            wire network_0_jobs_valid = u_node_network_0_jobs_valid[i];
            wire [1:0] network_0_jobs_mode = u_node_network_0_jobs_mode[i * 2 +: 2];
            wire network_0_jobs_bank = u_node_network_0_jobs_bank[i];
            wire [5:0] network_0_jobs_bytes = u_node_network_0_jobs_bytes[i * 6 +: 6];
            wire network_1_jobs_valid = u_node_network_1_jobs_valid[i];
            wire [1:0] network_1_jobs_mode = u_node_network_1_jobs_mode[i * 2 +: 2];
            wire network_1_jobs_bank = u_node_network_1_jobs_bank[i];
            wire [5:0] network_1_jobs_bytes = u_node_network_1_jobs_bytes[i * 6 +: 6];
            wire store_writes = u_node_store_writes[i];
            wire [3:0] store_address = u_node_store_address[i * 4 +: 4];
            wire [1:0] store_instruction_source = u_node_store_instruction_source[i * 2 +: 2];
            wire [3:0] store_instruction_function = u_node_store_instruction_function[i * 4 +: 4];
            wire [1:0] store_instruction_begin = u_node_store_instruction_begin[i * 2 +: 2];
            wire [1:0] store_instruction_mask = u_node_store_instruction_mask[i * 2 +: 2];
            wire store_instruction_accumulates = u_node_store_instruction_accumulates[i];
            wire store_instruction_stores = u_node_store_instruction_stores[i];
            wire [1:0] store_instruction_condition = u_node_store_instruction_condition[i * 2 +: 2];
            wire [2:0] store_instruction_enabling = u_node_store_instruction_enabling[i * 3 +: 3];
            wire [1:0] store_instruction_flagging = u_node_store_instruction_flagging[i * 2 +: 2];
            wire [2:0] store_instruction_skip = u_node_store_instruction_skip[i * 3 +: 3];
            wire [3:0] store_instruction_length = u_node_store_instruction_length[i * 4 +: 4];
            wire store_instruction_descends = u_node_store_instruction_descends[i];
            wire [8:0] store_instruction_read = u_node_store_instruction_read[i * 9 +: 9];
            wire [8:0] store_instruction_write = u_node_store_instruction_write[i * 9 +: 9];
            wire [2:0] store_instruction_sync = u_node_store_instruction_sync[i * 3 +: 3];
            wire [39:0] store_instruction_a = u_node_store_instruction_a[i * 40 +: 40];
            wire [39:0] store_instruction_b = u_node_store_instruction_b[i * 40 +: 40];
            wire [39:0] store_instruction_c = u_node_store_instruction_c[i * 40 +: 40];
            wire frames_valid = u_node_frames_valid[i];
            wire [3:0] frames_base = u_node_frames_base[i * 4 +: 4];
            wire [4:0] frames_length = u_node_frames_length[i * 5 +: 5];
            wire [3:0] texture_pixel = u_node_texture_pixel[i * 4 +: 4];
            wire [5:0] texture_address = u_node_texture_address[i * 6 +: 6];
            wire texture_writes = u_node_texture_writes[i];
            wire network_0_upstream_valid;
            if (i < 1) begin : network_0_upstream_valid_edge
                assign network_0_upstream_valid = 1'b0;
            end else begin : network_0_upstream_valid_link
                assign network_0_upstream_valid = u_node[i - 1].network_0_downstream_valid;
            end
            wire network_0_upstream_first;
            if (i < 1) begin : network_0_upstream_first_edge
                assign network_0_upstream_first = 1'b0;
            end else begin : network_0_upstream_first_link
                assign network_0_upstream_first = u_node[i - 1].network_0_downstream_first;
            end
            wire network_1_upstream_valid;
            if (i >= 2) begin : network_1_upstream_valid_edge
                assign network_1_upstream_valid = 1'b0;
            end else begin : network_1_upstream_valid_link
                assign network_1_upstream_valid = u_node[i + 1].network_1_downstream_valid;
            end
            wire network_1_upstream_first;
            if (i >= 2) begin : network_1_upstream_first_edge
                assign network_1_upstream_first = 1'b0;
            end else begin : network_1_upstream_first_link
                assign network_1_upstream_first = u_node[i + 1].network_1_downstream_first;
            end
            wire [15:0] u_node_texture_bytes;
            for (j = 0; j < 2; j = j + 1) begin : u_node_texture_bytes_of
                assign u_node_texture_bytes[j * 8 +: 8] = u_node_texture_bytes_listed_cells[i].col[j].u_node_texture_bytes_listed;
            end
            wire [15:0] u_node_network_0_upstream_bytes;
            for (j = 0; j < 2; j = j + 1) begin : u_node_network_0_upstream_bytes_of
                assign u_node_network_0_upstream_bytes[j * 8 +: 8] = u_node_network_0_upstream_bytes_linked_cells_ahead[i].col[j].u_node_network_0_upstream_bytes_linked;
            end
            wire [15:0] u_node_network_1_upstream_bytes;
            for (j = 0; j < 2; j = j + 1) begin : u_node_network_1_upstream_bytes_of
                assign u_node_network_1_upstream_bytes[j * 8 +: 8] = u_node_network_0_upstream_bytes_linked_cells_ahead[i].col[j].u_node_network_1_upstream_bytes_linked;
            end

            node_array_pixel_array_width8_height4_words16_setup2 lane (
                .array_clk                     (array_clk),
                .array_rst                     (array_rst),
                .network_clk                   (network_clk),
                .network_rst                   (network_rst),
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
                .side_by_side                  (side_by_side),
                .texture_pixel                 (texture_pixel),
                .texture_address               (texture_address),
                .texture_writes                (texture_writes),
                .texture_bytes                 (u_node_texture_bytes),
                .texture_done                  (textures_done[i]),
                .network_0_jobs_valid          (network_0_jobs_valid),
                .network_0_jobs_mode           (network_0_jobs_mode),
                .network_0_jobs_bank           (network_0_jobs_bank),
                .network_0_jobs_bytes          (network_0_jobs_bytes),
                .network_0_go                  (go_forth),
                .network_0_upstream_valid      (network_0_upstream_valid),
                .network_0_upstream_first      (network_0_upstream_first),
                .network_0_upstream_bytes      (u_node_network_0_upstream_bytes),
                .network_1_jobs_valid          (network_1_jobs_valid),
                .network_1_jobs_mode           (network_1_jobs_mode),
                .network_1_jobs_bank           (network_1_jobs_bank),
                .network_1_jobs_bytes          (network_1_jobs_bytes),
                .network_1_go                  (go_back),
                .network_1_upstream_valid      (network_1_upstream_valid),
                .network_1_upstream_first      (network_1_upstream_first),
                .network_1_upstream_bytes      (u_node_network_1_upstream_bytes),
                .texture_seen                  (texture_seen),
                .texture_starts                (texture_starts),
                .idle                          (lane_idle),
                .network_0_ready               (network_0_ready),
                .network_0_idle                (network_0_idle),
                .network_0_downstream_valid    (network_0_downstream_valid),
                .network_0_downstream_first    (network_0_downstream_first),
                .network_0_downstream_bytes    (network_0_downstream_bytes),
                .network_1_ready               (network_1_ready),
                .network_1_idle                (network_1_idle),
                .network_1_downstream_valid    (network_1_downstream_valid),
                .network_1_downstream_first    (network_1_downstream_first),
                .network_1_downstream_bytes    (network_1_downstream_bytes),
                .frames_ready                  (frames_ready),
                .network_0_jobs_ready          (network_0_jobs_ready),
                .network_1_jobs_ready          (network_1_jobs_ready)
            );
        end
    endgenerate

    generate
        for (i = 0; i < 3; i = i + 1) begin : u_node_network_0_upstream_bytes_linked_cells
            for (j = 0; j < 2; j = j + 1) begin : col
                if (i < 1) begin : u_node_network_0_upstream_bytes_linked_edge
                    assign u_node_network_0_upstream_bytes_linked_cells_ahead[i].col[j].u_node_network_0_upstream_bytes_linked = 8'd0;
                end else begin : u_node_network_0_upstream_bytes_linked_link
                    assign u_node_network_0_upstream_bytes_linked_cells_ahead[i].col[j].u_node_network_0_upstream_bytes_linked = u_node[i - 1].network_0_downstream_bytes[j * 8 +: 8];
                end
                if (i >= 2) begin : u_node_network_1_upstream_bytes_linked_edge
                    assign u_node_network_0_upstream_bytes_linked_cells_ahead[i].col[j].u_node_network_1_upstream_bytes_linked = 8'd0;
                end else begin : u_node_network_1_upstream_bytes_linked_link
                    assign u_node_network_0_upstream_bytes_linked_cells_ahead[i].col[j].u_node_network_1_upstream_bytes_linked = u_node[i + 1].network_1_downstream_bytes[j * 8 +: 8];
                end
            end
        end
    endgenerate

    assign frames_0_ready = u_node[0].frames_ready;              // rtl/src/pixelflow/machine.rs:91
    assign frames_1_ready = u_node[1].frames_ready;              // rtl/src/pixelflow/machine.rs:91
    assign frames_2_ready = u_node[2].frames_ready;              // rtl/src/pixelflow/machine.rs:91
    assign forth_0_ready = u_node[0].network_0_jobs_ready;       // rtl/src/pixelflow/machine.rs:86
    assign forth_1_ready = u_node[1].network_0_jobs_ready;       // rtl/src/pixelflow/machine.rs:86
    assign forth_2_ready = u_node[2].network_0_jobs_ready;       // rtl/src/pixelflow/machine.rs:86
    assign back_0_ready = u_node[0].network_1_jobs_ready;        // rtl/src/pixelflow/machine.rs:86
    assign back_1_ready = u_node[1].network_1_jobs_ready;        // rtl/src/pixelflow/machine.rs:86
    assign back_2_ready = u_node[2].network_1_jobs_ready;        // rtl/src/pixelflow/machine.rs:86
    wire [2:0] go_forth_lanes;
    generate
        for (i = 0; i < 3; i = i + 1) begin : go_forth_of
            assign go_forth_lanes[i] = u_node[i].network_0_ready;
        end
    endgenerate
    assign go_forth = &go_forth_lanes;                           // rtl/src/pixelflow/machine.rs:85
    wire [2:0] go_back_lanes;
    generate
        for (i = 0; i < 3; i = i + 1) begin : go_back_of
            assign go_back_lanes[i] = u_node[i].network_1_ready;
        end
    endgenerate
    assign go_back = &go_back_lanes;                             // rtl/src/pixelflow/machine.rs:85
    generate
        for (i = 0; i < 2; i = i + 1) begin : texture_seen_0_of
            assign texture_seen_0[i * 8 +: 8] = u_node[0].texture_seen[i * 8 +: 8];
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : texture_seen_1_of
            assign texture_seen_1[i * 8 +: 8] = u_node[1].texture_seen[i * 8 +: 8];
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : texture_seen_2_of
            assign texture_seen_2[i * 8 +: 8] = u_node[2].texture_seen[i * 8 +: 8];
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : textures_start_of
            assign textures_start[i] = u_node[i].texture_starts;
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : idle_of
            assign idle[i] = u_node[i].lane_idle;
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : without_job_0_of
            assign without_job_0[i] = u_node[i].network_0_idle;
        end
    endgenerate
    generate
        for (i = 0; i < 3; i = i + 1) begin : without_job_1_of
            assign without_job_1[i] = u_node[i].network_1_idle;
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : off_0_bytes_of
            assign off_0_bytes[i * 8 +: 8] = u_node[2].network_0_downstream_bytes[i * 8 +: 8];
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : off_1_bytes_of
            assign off_1_bytes[i * 8 +: 8] = u_node[0].network_1_downstream_bytes[i * 8 +: 8];
        end
    endgenerate

    assign go_0 = go_forth;
    assign go_1 = go_back;
    assign off_0_valid = u_node[2].network_0_downstream_valid;
    assign off_0_first = u_node[2].network_0_downstream_first;
    assign off_1_valid = u_node[0].network_1_downstream_valid;
    assign off_1_first = u_node[0].network_1_downstream_first;
endmodule
`default_nettype wire
