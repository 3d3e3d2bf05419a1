// command_dma_words16
//
// Fetches the instructions of frames from memory.
//
// Parameters  CommandDma { words: 16 }
// Latency     2 clocks from the acceptance of a frame to its first instruction, then one in every clock
// Source      Reducing Latency on PixelFlow, section 3 (PFL-NODE)
// Described   rtl/src/pixelflow/command_dma.rs:21
`default_nettype none

module command_dma_words16 (
    input  wire        clk,
    input  wire        rst,
    // A write by the geometry processors.
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
    // The frames to fetch, one after another.
    input  wire        frames_valid,
    input  wire [3:0]  frames_base,                   // The address of the frame's first instruction.
    // The number of the frame's instructions; addresses wrap at the end of the memory.
    input  wire [4:0]  frames_length,
    input  wire        instructions_ready,
    // The instructions to the array.
    output wire        instructions_valid,
    output wire [1:0]  instructions_source,           // Where the operand comes from: a `Source`.
    output wire [3:0]  instructions_function,         // The function of the ALU: a `Function`.
    output wire [1:0]  instructions_begin,            // The carry that comes into the first byte: a `Begin`.
    output wire [1:0]  instructions_mask,             // Which processors write: a `Mask`.
    output wire        instructions_accumulates,      // Results go to the accumulator.
    output wire        instructions_stores,           // Results go to memory.
    // What the last byte's `enabling` and `flagging` depend on: a `Condition`.
    output wire [1:0]  instructions_condition,
    // The change of the enable flags with the last byte: an `Enabling`.
    output wire [2:0]  instructions_enabling,
    output wire [1:0]  instructions_flagging,         // The change of the flag with the last byte: a `Flagging`.
    // The number of bytes of the expression before the word; 0 without an expression.
    output wire [2:0]  instructions_skip,
    output wire [3:0]  instructions_length,           // The number of bytes of the word: 1 to `LONGEST`.
    // Addresses decrease from byte to byte, most significant byte first: for shifts to the right.
    output wire        instructions_descends,
    output wire [8:0]  instructions_read,             // The address of the first byte that is read.
    output wire [8:0]  instructions_write,            // The address of the first byte that is written.
    output wire [2:0]  instructions_sync,             // The synchronization with the ports: a `Sync`.
    output wire [39:0] instructions_a,                // Coefficient A of the expression, in two's complement.
    output wire [39:0] instructions_b,                // Coefficient B of the expression, in two's complement.
    // Coefficient C of the expression, in two's complement, relative to the region. Without an expression, C is the
    // constant, least significant byte first; its sign extends it to a longer word.
    output wire [39:0] instructions_c,
    output wire        idle,                          // No frame waits, and no instruction is under way.
    output wire        frames_ready
);

    reg [4:0] left;                                              // rtl/src/pixelflow/command_dma.rs:71
    reg [3:0] next;                                              // rtl/src/pixelflow/command_dma.rs:72
    reg arrived;                                                 // rtl/src/pixelflow/command_dma.rs:76

    reg [167:0] memory [0:15];                                   // rtl/src/pixelflow/command_dma.rs:68
    reg [167:0] memory_read;                                     // rtl/src/pixelflow/command_dma.rs:78

    wire u_frames_out_valid;                                     // rtl/src/pixelflow/command_dma.rs:70
    wire [8:0] u_frames_out_payload;                             // rtl/src/pixelflow/command_dma.rs:70

    wire left_is_0 = left == 5'd0;                               // rtl/src/pixelflow/command_dma.rs:73
    wire [3:0] u_frames_out_base = u_frames_out_payload[8:5];    // rtl/src/pixelflow/command_dma.rs:70
    wire [4:0] u_frames_out_length = u_frames_out_payload[4:0];  // rtl/src/pixelflow/command_dma.rs:70
    wire left_and = u_frames_out_valid & left_is_0;              // rtl/src/pixelflow/command_dma.rs:73
    wire instructions_taken = arrived & instructions_ready;      // rtl/src/pixelflow/command_dma.rs:78
    wire reads = (left != 5'd0) & (!arrived | instructions_taken); // rtl/src/pixelflow/command_dma.rs:77
    assign instructions_source = memory_read[167:166];           // rtl/src/pixelflow/command_dma.rs:78
    assign instructions_function = memory_read[165:162];         // rtl/src/pixelflow/command_dma.rs:78
    assign instructions_begin = memory_read[161:160];            // rtl/src/pixelflow/command_dma.rs:78
    assign instructions_mask = memory_read[159:158];             // rtl/src/pixelflow/command_dma.rs:78
    assign instructions_accumulates = memory_read[157];          // rtl/src/pixelflow/command_dma.rs:78
    assign instructions_stores = memory_read[156];               // rtl/src/pixelflow/command_dma.rs:78
    assign instructions_condition = memory_read[155:154];        // rtl/src/pixelflow/command_dma.rs:78
    assign instructions_enabling = memory_read[153:151];         // rtl/src/pixelflow/command_dma.rs:78
    assign instructions_flagging = memory_read[150:149];         // rtl/src/pixelflow/command_dma.rs:78
    assign instructions_skip = memory_read[148:146];             // rtl/src/pixelflow/command_dma.rs:78
    assign instructions_length = memory_read[145:142];           // rtl/src/pixelflow/command_dma.rs:78
    assign instructions_descends = memory_read[141];             // rtl/src/pixelflow/command_dma.rs:78
    assign instructions_read = memory_read[140:132];             // rtl/src/pixelflow/command_dma.rs:78
    assign instructions_write = memory_read[131:123];            // rtl/src/pixelflow/command_dma.rs:78
    assign instructions_sync = memory_read[122:120];             // rtl/src/pixelflow/command_dma.rs:78
    assign instructions_a = memory_read[119:80];                 // rtl/src/pixelflow/command_dma.rs:78
    assign instructions_b = memory_read[79:40];                  // rtl/src/pixelflow/command_dma.rs:78
    assign instructions_c = memory_read[39:0];                   // rtl/src/pixelflow/command_dma.rs:78
    assign idle = !u_frames_out_valid & (left == 5'd0) & !arrived; // rtl/src/pixelflow/command_dma.rs:83

    fifo_depth2_width9_storage_registers u_frames (              // rtl/src/pixelflow/command_dma.rs:70
        .clk          (clk),
        .rst          (rst),
        .into_valid   (frames_valid),
        .into_payload ({frames_base, frames_length}),
        .out_ready    (left_is_0),
        .out_valid    (u_frames_out_valid),
        .out_payload  (u_frames_out_payload),
        .into_ready   (frames_ready)
    );

    always @(posedge clk) begin
        if (store_writes) begin
            memory[store_address] <= {
                store_instruction_source, store_instruction_function,
                store_instruction_begin, store_instruction_mask,
                store_instruction_accumulates, store_instruction_stores,
                store_instruction_condition, store_instruction_enabling,
                store_instruction_flagging, store_instruction_skip, store_instruction_length,
                store_instruction_descends, store_instruction_read, store_instruction_write,
                store_instruction_sync, store_instruction_a, store_instruction_b,
                store_instruction_c
            };
        end
        if (reads) memory_read <= memory[next];
    end

    always @(posedge clk) begin
        if (left_and) begin
            next <= u_frames_out_base;
        end else if (reads) begin
            if (next == 4'd15) next <= 4'd0;
            else next <= next + 4'd1;
        end
    end

    always @(posedge clk) begin
        if (rst) begin
            left <= 5'd0;
            arrived <= 1'b0;
        end else begin
            if (left_and) left <= u_frames_out_length;
            else if (reads) left <= left - 5'd1;
            if (reads) arrived <= 1'b1;
            else if (instructions_taken) arrived <= 1'b0;
        end
    end

    assign instructions_valid = arrived;
endmodule
`default_nettype wire
