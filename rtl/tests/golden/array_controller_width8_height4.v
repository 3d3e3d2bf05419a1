// array_controller_width8_height4
//
// Takes the instructions of a node, and controls the evaluator and the pixels.
//
// Parameters  ArrayController { width: 8, height: 4 }
// Latency     1 clock to the bytes of the coefficients, 6 to the control of pixels; the next instruction is taken with the last byte
// Source      Reducing Latency on PixelFlow, section 3 (PFL-NODE)
// Described   rtl/src/pixelflow/controller.rs:47
`default_nettype none

module array_controller_width8_height4 (
    input  wire        clk,
    input  wire        rst,
    // The instructions.
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
    // A byte of each coefficient for the evaluator.
    output wire [7:0]  coefficients_a,           // A byte of coefficient A, the increment from each column to the next.
    output wire [7:0]  coefficients_b,           // A byte of coefficient B, the increment from each line to the next.
    output wire [7:0]  coefficients_c,           // A byte of coefficient C, the value at column 0 of line 0.
    output reg         first,                    // The bytes of the coefficients are the first of an expression.
    output reg         sends,                    // The bytes of the coefficients belong to an expression.
    // The control of the pixels.
    output wire [1:0]  control_source,           // Where the operand comes from: a `Source`.
    output wire [7:0]  control_constant,         // The operand, if it is a constant.
    output wire [3:0]  control_function,         // The function of the ALU: a `Function`.
    output wire [1:0]  control_begin,            // The carry into the byte: a `Begin`.
    output wire [1:0]  control_mask,             // Which processors write: a `Mask`.
    output wire        control_accumulates,      // The result goes to the accumulator.
    output wire        control_stores,           // The result goes to memory.
    output wire [1:0]  control_condition,        // What `enabling` and `flagging` depend on: a `Condition`.
    output wire [2:0]  control_enabling,         // The change of the enable flags: an `Enabling`.
    // `enabling` depends on the expression's sign instead: the condition is true if its top bit is 0.
    output wire        control_by_sign,
    output wire [1:0]  control_flagging,         // The change of the flag: a `Flagging`.
    output wire [8:0]  control_read,             // The read address.
    output wire [8:0]  control_write,            // The write address.
    // The hand-over to network and texture unit: after the next edge the registers have all results so far.
    output wire [1:0]  given_banks,              // For one clock: a bank is given to the network; a bit for each.
    output wire        given_texture,            // For one clock: the texture unit begins.
    output wire        idle,                     // No instruction is offered, and none is in a slot.
    output wire        instructions_ready
);

    localparam [1:0] SOURCE_CONSTANT   = 2'd0;
    localparam [1:0] SOURCE_EXPRESSION = 2'd1;
    // Not used here: SOURCE_ACCUMULATOR = 2, SOURCE_MULTIPLICAND = 3.
    localparam [3:0] FUNCTION_OPERAND    = 4'd0;
    localparam [3:0] FUNCTION_ADD_HALVED = 4'd10;
    // Not used here: FUNCTION_WORD = 1, FUNCTION_ADD = 2, FUNCTION_SUBTRACT = 3, FUNCTION_COMPARE = 4,
    //     FUNCTION_AND = 5, FUNCTION_OR = 6, FUNCTION_EXCLUSIVE_OR = 7, FUNCTION_SHIFT_LEFT = 8,
    //     FUNCTION_SHIFT_RIGHT = 9.
    localparam [1:0] BEGIN_KEPT = 2'd0;
    localparam [1:0] BEGIN_ONE  = 2'd2;
    // Not used here: BEGIN_ZERO = 1.
    localparam [1:0] MASK_NOBODY  = 2'd0;
    localparam [1:0] MASK_ENABLED = 2'd2;
    // Not used here: MASK_EVERYBODY = 1, MASK_FLAGGED = 3.
    localparam [1:0] CONDITION_POSITIVE = 2'd0;
    localparam [1:0] CONDITION_NO_CARRY = 2'd2;
    // Not used here: CONDITION_CARRY = 1.
    localparam [2:0] ENABLING_KEEP     = 3'd0;
    localparam [2:0] ENABLING_REPLACE  = 3'd2;
    localparam [2:0] ENABLING_RESTRICT = 3'd3;
    localparam [2:0] ENABLING_PUSH     = 3'd4;
    localparam [2:0] ENABLING_POP      = 3'd6;
    // Not used here: ENABLING_SET = 1, ENABLING_INVERT = 5.
    localparam [1:0] FLAGGING_KEEP              = 2'd0;
    localparam [1:0] FLAGGING_ENABLED_CONDITION = 2'd2;
    // Not used here: FLAGGING_CONDITION = 1.
    localparam [2:0] SYNC_NOTHING       = 3'd0;
    localparam [2:0] SYNC_AWAIT_BANK    = 3'd1;
    localparam [2:0] SYNC_GIVE_BANK     = 3'd2;
    localparam [2:0] SYNC_AWAIT_TEXTURE = 3'd3;
    localparam [2:0] SYNC_START_TEXTURE = 3'd4;

    reg [1:0] evaluator_action_source;                           // rtl/src/pixelflow/controller/slot.rs:95
    reg [3:0] evaluator_action_function;                         // rtl/src/pixelflow/controller/slot.rs:95
    reg [1:0] evaluator_action_begin;                            // rtl/src/pixelflow/controller/slot.rs:95
    reg [1:0] evaluator_action_mask;                             // rtl/src/pixelflow/controller/slot.rs:95
    reg evaluator_action_accumulates;                            // rtl/src/pixelflow/controller/slot.rs:95
    reg evaluator_action_stores;                                 // rtl/src/pixelflow/controller/slot.rs:95
    reg [1:0] evaluator_action_condition;                        // rtl/src/pixelflow/controller/slot.rs:95
    reg [2:0] evaluator_action_enabling;                         // rtl/src/pixelflow/controller/slot.rs:95
    reg evaluator_action_by_sign;                                // rtl/src/pixelflow/controller/slot.rs:95
    reg [1:0] evaluator_action_flagging;                         // rtl/src/pixelflow/controller/slot.rs:95
    reg evaluator_action_on_memory;                              // rtl/src/pixelflow/controller/slot.rs:95
    reg evaluator_action_descends;                               // rtl/src/pixelflow/controller/slot.rs:95
    reg evaluator_action_gives;                                  // rtl/src/pixelflow/controller/slot.rs:95
    reg [1:0] evaluator_action_bank;                             // rtl/src/pixelflow/controller/slot.rs:95
    reg evaluator_action_starts;                                 // rtl/src/pixelflow/controller/slot.rs:95
    reg [3:0] evaluator_length;                                  // rtl/src/pixelflow/controller/slot.rs:95
    reg [4:0] evaluator_left;                                    // rtl/src/pixelflow/controller/slot.rs:97
    reg [39:0] evaluator_bytes;                                  // rtl/src/pixelflow/controller/slot.rs:99
    reg [8:0] evaluator_read;                                    // rtl/src/pixelflow/controller/slot.rs:101
    reg [8:0] evaluator_write;                                   // rtl/src/pixelflow/controller/slot.rs:102
    reg [1:0] memory_action_source;                              // rtl/src/pixelflow/controller/slot.rs:95
    reg [3:0] memory_action_function;                            // rtl/src/pixelflow/controller/slot.rs:95
    reg [1:0] memory_action_begin;                               // rtl/src/pixelflow/controller/slot.rs:95
    reg [1:0] memory_action_mask;                                // rtl/src/pixelflow/controller/slot.rs:95
    reg memory_action_accumulates;                               // rtl/src/pixelflow/controller/slot.rs:95
    reg memory_action_stores;                                    // rtl/src/pixelflow/controller/slot.rs:95
    reg [1:0] memory_action_condition;                           // rtl/src/pixelflow/controller/slot.rs:95
    reg [2:0] memory_action_enabling;                            // rtl/src/pixelflow/controller/slot.rs:95
    reg memory_action_by_sign;                                   // rtl/src/pixelflow/controller/slot.rs:95
    reg [1:0] memory_action_flagging;                            // rtl/src/pixelflow/controller/slot.rs:95
    reg memory_action_on_memory;                                 // rtl/src/pixelflow/controller/slot.rs:95
    reg memory_action_descends;                                  // rtl/src/pixelflow/controller/slot.rs:95
    reg memory_action_gives;                                     // rtl/src/pixelflow/controller/slot.rs:95
    reg [1:0] memory_action_bank;                                // rtl/src/pixelflow/controller/slot.rs:95
    reg memory_action_starts;                                    // rtl/src/pixelflow/controller/slot.rs:95
    reg [3:0] memory_length;                                     // rtl/src/pixelflow/controller/slot.rs:95
    reg [4:0] memory_left;                                       // rtl/src/pixelflow/controller/slot.rs:97
    reg [39:0] memory_bytes;                                     // rtl/src/pixelflow/controller/slot.rs:99
    reg [8:0] memory_read;                                       // rtl/src/pixelflow/controller/slot.rs:101
    reg [8:0] memory_write;                                      // rtl/src/pixelflow/controller/slot.rs:102
    reg waits;                                                   // rtl/src/pixelflow/controller.rs:137
    reg [1:0] waiting_action_source;                             // rtl/src/pixelflow/controller.rs:138
    reg [3:0] waiting_action_function;                           // rtl/src/pixelflow/controller.rs:138
    reg [1:0] waiting_action_begin;                              // rtl/src/pixelflow/controller.rs:138
    reg [1:0] waiting_action_mask;                               // rtl/src/pixelflow/controller.rs:138
    reg waiting_action_accumulates;                              // rtl/src/pixelflow/controller.rs:138
    reg waiting_action_stores;                                   // rtl/src/pixelflow/controller.rs:138
    reg [1:0] waiting_action_condition;                          // rtl/src/pixelflow/controller.rs:138
    reg [2:0] waiting_action_enabling;                           // rtl/src/pixelflow/controller.rs:138
    reg waiting_action_by_sign;                                  // rtl/src/pixelflow/controller.rs:138
    reg [1:0] waiting_action_flagging;                           // rtl/src/pixelflow/controller.rs:138
    reg waiting_action_on_memory;                                // rtl/src/pixelflow/controller.rs:138
    reg waiting_action_descends;                                 // rtl/src/pixelflow/controller.rs:138
    reg waiting_action_gives;                                    // rtl/src/pixelflow/controller.rs:138
    reg [1:0] waiting_action_bank;                               // rtl/src/pixelflow/controller.rs:138
    reg waiting_action_starts;                                   // rtl/src/pixelflow/controller.rs:138
    reg [2:0] waiting_skip;                                      // rtl/src/pixelflow/controller.rs:138
    reg [3:0] waiting_length;                                    // rtl/src/pixelflow/controller.rs:138
    reg [8:0] waiting_read;                                      // rtl/src/pixelflow/controller.rs:138
    reg [8:0] waiting_write;                                     // rtl/src/pixelflow/controller.rs:138
    reg [39:0] waiting_constant;                                 // rtl/src/pixelflow/controller.rs:138
    reg [1:0] banks_under_way;                                   // rtl/src/pixelflow/controller.rs:221
    reg texture_under_way;                                       // rtl/src/pixelflow/controller.rs:222
    reg [39:0] a;                                                // rtl/src/pixelflow/controller/slot.rs:159
    reg [39:0] b;                                                // rtl/src/pixelflow/controller/slot.rs:159
    reg [1:0] sent1_control_source;                              // rtl/src/pixelflow/controller.rs:203
    reg [7:0] sent1_control_constant;                            // rtl/src/pixelflow/controller.rs:203
    reg [3:0] sent1_control_function;                            // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent1_control_begin;                               // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent1_control_mask;                                // rtl/src/pixelflow/controller.rs:203
    reg sent1_control_accumulates;                               // rtl/src/pixelflow/controller.rs:203
    reg sent1_control_stores;                                    // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent1_control_condition;                           // rtl/src/pixelflow/controller.rs:203
    reg [2:0] sent1_control_enabling;                            // rtl/src/pixelflow/controller.rs:203
    reg sent1_control_by_sign;                                   // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent1_control_flagging;                            // rtl/src/pixelflow/controller.rs:203
    reg [8:0] sent1_control_read;                                // rtl/src/pixelflow/controller.rs:203
    reg [8:0] sent1_control_write;                               // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent1_given_banks;                                 // rtl/src/pixelflow/controller.rs:203
    reg sent1_given_texture;                                     // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent2_control_source;                              // rtl/src/pixelflow/controller.rs:203
    reg [7:0] sent2_control_constant;                            // rtl/src/pixelflow/controller.rs:203
    reg [3:0] sent2_control_function;                            // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent2_control_begin;                               // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent2_control_mask;                                // rtl/src/pixelflow/controller.rs:203
    reg sent2_control_accumulates;                               // rtl/src/pixelflow/controller.rs:203
    reg sent2_control_stores;                                    // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent2_control_condition;                           // rtl/src/pixelflow/controller.rs:203
    reg [2:0] sent2_control_enabling;                            // rtl/src/pixelflow/controller.rs:203
    reg sent2_control_by_sign;                                   // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent2_control_flagging;                            // rtl/src/pixelflow/controller.rs:203
    reg [8:0] sent2_control_read;                                // rtl/src/pixelflow/controller.rs:203
    reg [8:0] sent2_control_write;                               // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent2_given_banks;                                 // rtl/src/pixelflow/controller.rs:203
    reg sent2_given_texture;                                     // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent3_control_source;                              // rtl/src/pixelflow/controller.rs:203
    reg [7:0] sent3_control_constant;                            // rtl/src/pixelflow/controller.rs:203
    reg [3:0] sent3_control_function;                            // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent3_control_begin;                               // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent3_control_mask;                                // rtl/src/pixelflow/controller.rs:203
    reg sent3_control_accumulates;                               // rtl/src/pixelflow/controller.rs:203
    reg sent3_control_stores;                                    // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent3_control_condition;                           // rtl/src/pixelflow/controller.rs:203
    reg [2:0] sent3_control_enabling;                            // rtl/src/pixelflow/controller.rs:203
    reg sent3_control_by_sign;                                   // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent3_control_flagging;                            // rtl/src/pixelflow/controller.rs:203
    reg [8:0] sent3_control_read;                                // rtl/src/pixelflow/controller.rs:203
    reg [8:0] sent3_control_write;                               // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent3_given_banks;                                 // rtl/src/pixelflow/controller.rs:203
    reg sent3_given_texture;                                     // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent4_control_source;                              // rtl/src/pixelflow/controller.rs:203
    reg [7:0] sent4_control_constant;                            // rtl/src/pixelflow/controller.rs:203
    reg [3:0] sent4_control_function;                            // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent4_control_begin;                               // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent4_control_mask;                                // rtl/src/pixelflow/controller.rs:203
    reg sent4_control_accumulates;                               // rtl/src/pixelflow/controller.rs:203
    reg sent4_control_stores;                                    // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent4_control_condition;                           // rtl/src/pixelflow/controller.rs:203
    reg [2:0] sent4_control_enabling;                            // rtl/src/pixelflow/controller.rs:203
    reg sent4_control_by_sign;                                   // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent4_control_flagging;                            // rtl/src/pixelflow/controller.rs:203
    reg [8:0] sent4_control_read;                                // rtl/src/pixelflow/controller.rs:203
    reg [8:0] sent4_control_write;                               // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent4_given_banks;                                 // rtl/src/pixelflow/controller.rs:203
    reg sent4_given_texture;                                     // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent5_control_source;                              // rtl/src/pixelflow/controller.rs:203
    reg [7:0] sent5_control_constant;                            // rtl/src/pixelflow/controller.rs:203
    reg [3:0] sent5_control_function;                            // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent5_control_begin;                               // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent5_control_mask;                                // rtl/src/pixelflow/controller.rs:203
    reg sent5_control_accumulates;                               // rtl/src/pixelflow/controller.rs:203
    reg sent5_control_stores;                                    // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent5_control_condition;                           // rtl/src/pixelflow/controller.rs:203
    reg [2:0] sent5_control_enabling;                            // rtl/src/pixelflow/controller.rs:203
    reg sent5_control_by_sign;                                   // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent5_control_flagging;                            // rtl/src/pixelflow/controller.rs:203
    reg [8:0] sent5_control_read;                                // rtl/src/pixelflow/controller.rs:203
    reg [8:0] sent5_control_write;                               // rtl/src/pixelflow/controller.rs:203
    reg [1:0] sent5_given_banks;                                 // rtl/src/pixelflow/controller.rs:203
    reg sent5_given_texture;                                     // rtl/src/pixelflow/controller.rs:203

    wire expression = instructions_source == SOURCE_EXPRESSION;  // rtl/src/pixelflow/controller.rs:111
    wire on_enable_or = (instructions_enabling != ENABLING_KEEP) | (instructions_mask == MASK_ENABLED); // rtl/src/pixelflow/controller.rs:122
    wire on_enable = on_enable_or | (instructions_flagging == FLAGGING_ENABLED_CONDITION); // rtl/src/pixelflow/controller.rs:120
    wire on_evaluator = expression | on_enable;                  // rtl/src/pixelflow/controller.rs:124
    wire evaluator_ends = evaluator_left <= 5'd1;                // rtl/src/pixelflow/controller/slot.rs:100
    wire writes_or = instructions_accumulates | instructions_stores; // rtl/src/pixelflow/controller.rs:118
    wire writes = (instructions_mask != MASK_NOBODY) & writes_or; // rtl/src/pixelflow/controller.rs:118
    wire quiet_and_2 = (instructions_function == FUNCTION_OPERAND) & !writes; // rtl/src/pixelflow/controller.rs:119
    wire quiet_and = quiet_and_2 & (instructions_flagging == FLAGGING_KEEP); // rtl/src/pixelflow/controller.rs:119
    wire looks_or = (instructions_enabling == ENABLING_REPLACE) | (instructions_enabling == ENABLING_RESTRICT); // rtl/src/pixelflow/controller.rs:113
    wire looks = looks_or | (instructions_enabling == ENABLING_PUSH); // rtl/src/pixelflow/controller.rs:116
    wire by_sign = looks & expression & (instructions_condition == CONDITION_POSITIVE); // rtl/src/pixelflow/controller.rs:117
    wire quiet = quiet_and & (!looks | by_sign);                 // rtl/src/pixelflow/controller.rs:119
    wire on_memory = !on_evaluator | !quiet;                     // rtl/src/pixelflow/controller.rs:125
    wire [4:0] ahead = memory_left + (waits ? {1'd0, waiting_length} : 5'd0); // rtl/src/pixelflow/controller.rs:142
    wire ends_in_time = ahead <= ({2'd0, instructions_skip} + 5'd1); // rtl/src/pixelflow/controller.rs:143
    wire evaluator_may = evaluator_ends & (!on_memory | ends_in_time); // rtl/src/pixelflow/controller.rs:144
    wire memory_ends = memory_left <= 5'd1;                      // rtl/src/pixelflow/controller/slot.rs:100
    wire memory_may_inverse = !((evaluator_left != 5'd0) & evaluator_action_on_memory); // rtl/src/pixelflow/controller.rs:145
    wire memory_may = (!waits | memory_ends) & (evaluator_ends | memory_may_inverse); // rtl/src/pixelflow/controller.rs:145
    wire both_end = evaluator_ends & memory_ends & !waits;       // rtl/src/pixelflow/controller.rs:146
    wire in_turn = (side_by_side & (instructions_sync == SYNC_NOTHING)) | both_end; // rtl/src/pixelflow/controller.rs:148
    wire may_and = (on_evaluator ? evaluator_may : memory_may) & in_turn; // rtl/src/pixelflow/controller.rs:149
    wire [1:0] bank_is_out_and = banks_under_way & {instructions_c[0], !instructions_c[0]}; // rtl/src/pixelflow/controller.rs:230
    wire bank_is_out = bank_is_out_and != 2'd0;                  // rtl/src/pixelflow/controller.rs:230
    wire waits_for_bank = (instructions_sync == SYNC_AWAIT_BANK) & bank_is_out; // rtl/src/pixelflow/controller.rs:231
    wire may_inverse = !(waits_for_bank | ((instructions_sync == SYNC_AWAIT_TEXTURE) & texture_under_way)); // rtl/src/pixelflow/controller.rs:149
    wire may = may_and & may_inverse;                            // rtl/src/pixelflow/controller.rs:149
    assign instructions_ready = may;                             // rtl/src/pixelflow/controller.rs:150
    wire evaluator_is_word_at_most = evaluator_left <= {1'd0, evaluator_length}; // rtl/src/pixelflow/controller/slot.rs:98
    wire evaluator_is_word = (evaluator_left != 5'd0) & evaluator_is_word_at_most; // rtl/src/pixelflow/controller/slot.rs:98
    assign coefficients_c = evaluator_bytes[7:0];                // rtl/src/pixelflow/controller/slot.rs:103
    wire memory_is_word = (memory_left != 5'd0) & (memory_left <= {1'd0, memory_length}); // rtl/src/pixelflow/controller/slot.rs:98
    wire instructions_taken = instructions_valid & may;          // rtl/src/pixelflow/controller.rs:150
    wire [1:0] banks_under_way_joined = {instructions_c[0], !instructions_c[0]}; // rtl/src/pixelflow/controller/slot.rs:73
    wire banks_under_way_and = instructions_taken & (instructions_sync == SYNC_GIVE_BANK); // rtl/src/pixelflow/controller.rs:239
    wire [1:0] banks_under_way_choice = banks_under_way_and ? banks_under_way_joined : 2'd0; // rtl/src/pixelflow/controller.rs:239
    wire assumed_equal = (banks_under_way & banks_under_way_joined) == 2'd0; // rtl/src/pixelflow/controller.rs:242
    wire assumed_or = (instructions_sync != SYNC_START_TEXTURE) | !texture_under_way; // rtl/src/pixelflow/controller.rs:243
    wire instructions_sync_is_give_bank = instructions_sync == SYNC_GIVE_BANK; // rtl/src/pixelflow/controller/slot.rs:57
    wire [1:0] evaluator_action_bank_joined = {instructions_c[0], !instructions_c[0]}; // rtl/src/pixelflow/controller/slot.rs:73
    wire evaluator_action_starts_equal = instructions_sync == SYNC_START_TEXTURE; // rtl/src/pixelflow/controller/slot.rs:59
    wire evaluator_begins = instructions_taken & on_evaluator;   // rtl/src/pixelflow/controller.rs:155
    wire for_memory = instructions_taken & !on_evaluator;        // rtl/src/pixelflow/controller.rs:156
    wire must_wait = for_memory & (waits | !memory_ends);        // rtl/src/pixelflow/controller.rs:157
    wire memory_begins = memory_ends & (waits | for_memory);     // rtl/src/pixelflow/controller.rs:160
    wire [3:0] memory_length_choice = waits ? waiting_length : instructions_length; // rtl/src/pixelflow/controller.rs:162
    wire [4:0] memory_left_extended = {2'd0, waits ? waiting_skip : instructions_skip}; // rtl/src/pixelflow/controller/slot.rs:66
    assign coefficients_a = a[7:0];                              // rtl/src/pixelflow/controller/slot.rs:161
    assign coefficients_b = b[7:0];                              // rtl/src/pixelflow/controller/slot.rs:161
    wire asserted_and = (evaluator_left != 5'd0) & evaluator_action_on_memory; // rtl/src/pixelflow/controller/slot.rs:121
    wire sent1_given_banks_and = evaluator_is_word & (evaluator_left == 5'd1) & evaluator_action_gives; // rtl/src/pixelflow/controller/slot.rs:153
    wire [1:0] sent1_given_banks_choice = sent1_given_banks_and ? evaluator_action_bank : 2'd0; // rtl/src/pixelflow/controller/slot.rs:153
    wire sent1_given_texture_and = evaluator_is_word & (evaluator_left == 5'd1) & evaluator_action_starts; // rtl/src/pixelflow/controller/slot.rs:153
    wire sent1_given_banks_and_2 = memory_is_word & (memory_left == 5'd1) & memory_action_gives; // rtl/src/pixelflow/controller/slot.rs:153
    wire sent1_given_texture_and_2 = memory_is_word & (memory_left == 5'd1) & memory_action_starts; // rtl/src/pixelflow/controller/slot.rs:153
    wire asserted_and_4 = (sent5_control_function <= FUNCTION_ADD_HALVED) & (sent5_control_begin <= BEGIN_ONE); // rtl/src/pixelflow/controller.rs:264
    wire asserted_and_3 = asserted_and_4 & (sent5_control_condition <= CONDITION_NO_CARRY); // rtl/src/pixelflow/controller.rs:264
    wire asserted_and_2 = asserted_and_3 & (sent5_control_enabling <= ENABLING_POP); // rtl/src/pixelflow/controller.rs:264
    wire assumed_and = (instructions_length != 4'd0) & (instructions_length <= 4'd8); // rtl/src/pixelflow/controller.rs:249
    wire assumed_at_least = ({1'd0, instructions_read} + 10'd1) >= {6'd0, instructions_length}; // rtl/src/pixelflow/controller.rs:254
    wire assumed_at_most = ({1'd0, instructions_read} + {6'd0, instructions_length}) <= 10'd384; // rtl/src/pixelflow/controller.rs:254
    wire assumed_choice = instructions_descends ? assumed_at_least : assumed_at_most; // rtl/src/pixelflow/controller.rs:254
    wire assumed_at_least_2 = ({1'd0, instructions_write} + 10'd1) >= {6'd0, instructions_length}; // rtl/src/pixelflow/controller.rs:254
    wire assumed_at_most_2 = ({1'd0, instructions_write} + {6'd0, instructions_length}) <= 10'd384; // rtl/src/pixelflow/controller.rs:254
    wire assumed_choice_2 = instructions_descends ? assumed_at_least_2 : assumed_at_most_2; // rtl/src/pixelflow/controller.rs:254
    wire assumed_and_5 = (instructions_function <= FUNCTION_ADD_HALVED) & (instructions_begin <= BEGIN_ONE); // rtl/src/pixelflow/controller.rs:264
    wire assumed_and_4 = assumed_and_5 & (instructions_condition <= CONDITION_NO_CARRY); // rtl/src/pixelflow/controller.rs:264
    wire assumed_and_3 = assumed_and_4 & (instructions_enabling <= ENABLING_POP); // rtl/src/pixelflow/controller.rs:264
    wire assumed_and_2 = assumed_and_3 & (instructions_flagging <= FLAGGING_ENABLED_CONDITION); // rtl/src/pixelflow/controller.rs:264
    wire idle_and = !instructions_valid & (evaluator_left == 5'd0); // rtl/src/pixelflow/controller.rs:196
    assign idle = idle_and & (memory_left == 5'd0);              // rtl/src/pixelflow/controller.rs:196

    always @(posedge clk) begin
        if (evaluator_begins) begin
            evaluator_bytes <= instructions_c;
        end else begin
            evaluator_bytes <= {{8{evaluator_bytes[39]}}, evaluator_bytes[39:8]};
        end
        if (evaluator_begins) begin
            evaluator_read <= instructions_read;
            evaluator_write <= instructions_write;
        end else if (evaluator_is_word) begin
            if (evaluator_action_descends) begin
                evaluator_read <= evaluator_read - 9'd1;
                evaluator_write <= evaluator_write - 9'd1;
            end else begin
                evaluator_read <= evaluator_read + 9'd1;
                evaluator_write <= evaluator_write + 9'd1;
            end
        end
        if (memory_begins) begin
            if (waits) memory_bytes <= waiting_constant;
            else memory_bytes <= instructions_c;
        end else begin
            memory_bytes <= {{8{memory_bytes[39]}}, memory_bytes[39:8]};
        end
        if (memory_begins) begin
            if (waits) begin
                memory_read <= waiting_read;
                memory_write <= waiting_write;
            end else begin
                memory_read <= instructions_read;
                memory_write <= instructions_write;
            end
        end else if (memory_is_word) begin
            if (memory_action_descends) begin
                memory_read <= memory_read - 9'd1;
                memory_write <= memory_write - 9'd1;
            end else begin
                memory_read <= memory_read + 9'd1;
                memory_write <= memory_write + 9'd1;
            end
        end
        if (must_wait) begin
            waiting_action_source <= instructions_source;
            waiting_action_function <= instructions_function;
            waiting_action_begin <= instructions_begin;
            waiting_action_mask <= instructions_mask;
            waiting_action_accumulates <= instructions_accumulates;
            waiting_action_stores <= instructions_stores;
            waiting_action_condition <= instructions_condition;
            waiting_action_enabling <= instructions_enabling;
            waiting_action_by_sign <= by_sign;
            waiting_action_flagging <= instructions_flagging;
            waiting_action_on_memory <= on_memory;
            waiting_action_descends <= instructions_descends;
            waiting_action_gives <= instructions_sync_is_give_bank;
            waiting_action_bank <= evaluator_action_bank_joined;
            waiting_action_starts <= evaluator_action_starts_equal;
            waiting_skip <= instructions_skip;
            waiting_length <= instructions_length;
            waiting_read <= instructions_read;
            waiting_write <= instructions_write;
            waiting_constant <= instructions_c;
        end
        if (evaluator_begins) begin
            a <= instructions_a;
            b <= instructions_b;
        end else begin
            a <= {{8{a[39]}}, a[39:8]};
            b <= {{8{b[39]}}, b[39:8]};
        end
    end

    always @(posedge clk) begin
        if (rst) begin
            evaluator_action_source <= SOURCE_CONSTANT;
            evaluator_action_function <= FUNCTION_OPERAND;
            evaluator_action_begin <= BEGIN_KEPT;
            evaluator_action_mask <= MASK_NOBODY;
            evaluator_action_accumulates <= 1'b0;
            evaluator_action_stores <= 1'b0;
            evaluator_action_condition <= CONDITION_POSITIVE;
            evaluator_action_enabling <= ENABLING_KEEP;
            evaluator_action_by_sign <= 1'b0;
            evaluator_action_flagging <= FLAGGING_KEEP;
            evaluator_action_on_memory <= 1'b0;
            evaluator_action_descends <= 1'b0;
            evaluator_action_gives <= 1'b0;
            evaluator_action_bank <= 2'd0;
            evaluator_action_starts <= 1'b0;
            evaluator_length <= 4'd0;
            evaluator_left <= 5'd0;
            memory_action_source <= SOURCE_CONSTANT;
            memory_action_function <= FUNCTION_OPERAND;
            memory_action_begin <= BEGIN_KEPT;
            memory_action_mask <= MASK_NOBODY;
            memory_action_accumulates <= 1'b0;
            memory_action_stores <= 1'b0;
            memory_action_condition <= CONDITION_POSITIVE;
            memory_action_enabling <= ENABLING_KEEP;
            memory_action_by_sign <= 1'b0;
            memory_action_flagging <= FLAGGING_KEEP;
            memory_action_on_memory <= 1'b0;
            memory_action_descends <= 1'b0;
            memory_action_gives <= 1'b0;
            memory_action_bank <= 2'd0;
            memory_action_starts <= 1'b0;
            memory_length <= 4'd0;
            memory_left <= 5'd0;
            waits <= 1'b0;
            banks_under_way <= 2'd0;
            texture_under_way <= 1'b0;
            first <= 1'b0;
            sends <= 1'b0;
            sent1_control_source <= SOURCE_CONSTANT;
            sent1_control_constant <= 8'd0;
            sent1_control_function <= FUNCTION_OPERAND;
            sent1_control_begin <= BEGIN_KEPT;
            sent1_control_mask <= MASK_NOBODY;
            sent1_control_accumulates <= 1'b0;
            sent1_control_stores <= 1'b0;
            sent1_control_condition <= CONDITION_POSITIVE;
            sent1_control_enabling <= ENABLING_KEEP;
            sent1_control_by_sign <= 1'b0;
            sent1_control_flagging <= FLAGGING_KEEP;
            sent1_control_read <= 9'd0;
            sent1_control_write <= 9'd0;
            sent1_given_banks <= 2'd0;
            sent1_given_texture <= 1'b0;
            sent2_control_source <= SOURCE_CONSTANT;
            sent2_control_constant <= 8'd0;
            sent2_control_function <= FUNCTION_OPERAND;
            sent2_control_begin <= BEGIN_KEPT;
            sent2_control_mask <= MASK_NOBODY;
            sent2_control_accumulates <= 1'b0;
            sent2_control_stores <= 1'b0;
            sent2_control_condition <= CONDITION_POSITIVE;
            sent2_control_enabling <= ENABLING_KEEP;
            sent2_control_by_sign <= 1'b0;
            sent2_control_flagging <= FLAGGING_KEEP;
            sent2_control_read <= 9'd0;
            sent2_control_write <= 9'd0;
            sent2_given_banks <= 2'd0;
            sent2_given_texture <= 1'b0;
            sent3_control_source <= SOURCE_CONSTANT;
            sent3_control_constant <= 8'd0;
            sent3_control_function <= FUNCTION_OPERAND;
            sent3_control_begin <= BEGIN_KEPT;
            sent3_control_mask <= MASK_NOBODY;
            sent3_control_accumulates <= 1'b0;
            sent3_control_stores <= 1'b0;
            sent3_control_condition <= CONDITION_POSITIVE;
            sent3_control_enabling <= ENABLING_KEEP;
            sent3_control_by_sign <= 1'b0;
            sent3_control_flagging <= FLAGGING_KEEP;
            sent3_control_read <= 9'd0;
            sent3_control_write <= 9'd0;
            sent3_given_banks <= 2'd0;
            sent3_given_texture <= 1'b0;
            sent4_control_source <= SOURCE_CONSTANT;
            sent4_control_constant <= 8'd0;
            sent4_control_function <= FUNCTION_OPERAND;
            sent4_control_begin <= BEGIN_KEPT;
            sent4_control_mask <= MASK_NOBODY;
            sent4_control_accumulates <= 1'b0;
            sent4_control_stores <= 1'b0;
            sent4_control_condition <= CONDITION_POSITIVE;
            sent4_control_enabling <= ENABLING_KEEP;
            sent4_control_by_sign <= 1'b0;
            sent4_control_flagging <= FLAGGING_KEEP;
            sent4_control_read <= 9'd0;
            sent4_control_write <= 9'd0;
            sent4_given_banks <= 2'd0;
            sent4_given_texture <= 1'b0;
            sent5_control_source <= SOURCE_CONSTANT;
            sent5_control_constant <= 8'd0;
            sent5_control_function <= FUNCTION_OPERAND;
            sent5_control_begin <= BEGIN_KEPT;
            sent5_control_mask <= MASK_NOBODY;
            sent5_control_accumulates <= 1'b0;
            sent5_control_stores <= 1'b0;
            sent5_control_condition <= CONDITION_POSITIVE;
            sent5_control_enabling <= ENABLING_KEEP;
            sent5_control_by_sign <= 1'b0;
            sent5_control_flagging <= FLAGGING_KEEP;
            sent5_control_read <= 9'd0;
            sent5_control_write <= 9'd0;
            sent5_given_banks <= 2'd0;
            sent5_given_texture <= 1'b0;
        end else begin
            if (evaluator_begins) begin
                evaluator_action_source <= instructions_source;
                evaluator_action_function <= instructions_function;
                evaluator_action_begin <= instructions_begin;
                evaluator_action_mask <= instructions_mask;
                evaluator_action_accumulates <= instructions_accumulates;
                evaluator_action_stores <= instructions_stores;
                evaluator_action_condition <= instructions_condition;
                evaluator_action_enabling <= instructions_enabling;
                evaluator_action_by_sign <= by_sign;
                evaluator_action_flagging <= instructions_flagging;
                evaluator_action_on_memory <= on_memory;
                evaluator_action_descends <= instructions_descends;
                evaluator_action_gives <= instructions_sync_is_give_bank;
                evaluator_action_bank <= evaluator_action_bank_joined;
                evaluator_action_starts <= evaluator_action_starts_equal;
                evaluator_length <= instructions_length;
            end
            if (evaluator_begins) begin
                evaluator_left <= {2'd0, instructions_skip} + {1'd0, instructions_length};
            end else if (evaluator_left != 5'd0) begin
                evaluator_left <= evaluator_left - 5'd1;
            end
            if (memory_begins) begin
                if (waits) begin
                    memory_action_source <= waiting_action_source;
                    memory_action_function <= waiting_action_function;
                    memory_action_begin <= waiting_action_begin;
                    memory_action_mask <= waiting_action_mask;
                    memory_action_accumulates <= waiting_action_accumulates;
                    memory_action_stores <= waiting_action_stores;
                    memory_action_condition <= waiting_action_condition;
                    memory_action_enabling <= waiting_action_enabling;
                    memory_action_by_sign <= waiting_action_by_sign;
                    memory_action_flagging <= waiting_action_flagging;
                    memory_action_on_memory <= waiting_action_on_memory;
                    memory_action_descends <= waiting_action_descends;
                    memory_action_gives <= waiting_action_gives;
                    memory_action_bank <= waiting_action_bank;
                    memory_action_starts <= waiting_action_starts;
                end else begin
                    memory_action_source <= instructions_source;
                    memory_action_function <= instructions_function;
                    memory_action_begin <= instructions_begin;
                    memory_action_mask <= instructions_mask;
                    memory_action_accumulates <= instructions_accumulates;
                    memory_action_stores <= instructions_stores;
                    memory_action_condition <= instructions_condition;
                    memory_action_enabling <= instructions_enabling;
                    memory_action_by_sign <= by_sign;
                    memory_action_flagging <= instructions_flagging;
                    memory_action_on_memory <= on_memory;
                    memory_action_descends <= instructions_descends;
                    memory_action_gives <= instructions_sync_is_give_bank;
                    memory_action_bank <= evaluator_action_bank_joined;
                    memory_action_starts <= evaluator_action_starts_equal;
                end
                memory_length <= memory_length_choice;
            end
            if (memory_begins) begin
                memory_left <= memory_left_extended + {1'd0, memory_length_choice};
            end else if (memory_left != 5'd0) begin
                memory_left <= memory_left - 5'd1;
            end
            if (must_wait) waits <= 1'b1;
            else if (memory_ends) waits <= 1'b0;
            banks_under_way <= (banks_under_way & ~bank_done) | banks_under_way_choice;
            if (instructions_taken & (instructions_sync == SYNC_START_TEXTURE)) texture_under_way <= 1'b1;
            else if (texture_done) texture_under_way <= 1'b0;
            first <= evaluator_begins & expression;
            if (evaluator_begins) sends <= expression;
            else if (evaluator_ends) sends <= 1'b0;
            if (memory_is_word) begin
                sent1_control_source <= memory_action_source;
                sent1_control_constant <= memory_bytes[7:0];
            end else begin
                sent1_control_source <= evaluator_action_source;
                sent1_control_constant <= coefficients_c;
            end
            if (memory_is_word) begin
                if (memory_is_word) sent1_control_function <= memory_action_function;
                else sent1_control_function <= FUNCTION_OPERAND;
            end else if (evaluator_is_word) begin
                sent1_control_function <= evaluator_action_function;
            end else begin
                sent1_control_function <= FUNCTION_OPERAND;
            end
            if (memory_is_word) begin
                if (memory_left == {1'd0, memory_length}) sent1_control_begin <= memory_action_begin;
                else sent1_control_begin <= BEGIN_KEPT;
            end else if (evaluator_left == {1'd0, evaluator_length}) begin
                sent1_control_begin <= evaluator_action_begin;
            end else begin
                sent1_control_begin <= BEGIN_KEPT;
            end
            if (memory_is_word) begin
                if (memory_is_word) sent1_control_mask <= memory_action_mask;
                else sent1_control_mask <= MASK_NOBODY;
            end else if (evaluator_is_word) begin
                sent1_control_mask <= evaluator_action_mask;
            end else begin
                sent1_control_mask <= MASK_NOBODY;
            end
            if (memory_is_word) begin
                sent1_control_accumulates <= memory_action_accumulates;
                sent1_control_stores <= memory_action_stores;
                sent1_control_condition <= memory_action_condition;
            end else begin
                sent1_control_accumulates <= evaluator_action_accumulates;
                sent1_control_stores <= evaluator_action_stores;
                sent1_control_condition <= evaluator_action_condition;
            end
            if (evaluator_is_word & (evaluator_left == 5'd1)) sent1_control_enabling <= evaluator_action_enabling;
            else sent1_control_enabling <= ENABLING_KEEP;
            sent1_control_by_sign <= evaluator_action_by_sign;
            if (memory_is_word) begin
                if (memory_is_word & (memory_left == 5'd1)) sent1_control_flagging <= memory_action_flagging;
                else sent1_control_flagging <= FLAGGING_KEEP;
            end else if (evaluator_is_word & (evaluator_left == 5'd1)) begin
                sent1_control_flagging <= evaluator_action_flagging;
            end else begin
                sent1_control_flagging <= FLAGGING_KEEP;
            end
            if (memory_is_word) begin
                sent1_control_read <= memory_read;
                sent1_control_write <= memory_write;
            end else begin
                sent1_control_read <= evaluator_read;
                sent1_control_write <= evaluator_write;
            end
            sent1_given_banks <= sent1_given_banks_choice | (sent1_given_banks_and_2 ? memory_action_bank : 2'd0);
            sent1_given_texture <= sent1_given_texture_and | sent1_given_texture_and_2;
            sent2_control_source <= sent1_control_source;
            sent2_control_constant <= sent1_control_constant;
            sent2_control_function <= sent1_control_function;
            sent2_control_begin <= sent1_control_begin;
            sent2_control_mask <= sent1_control_mask;
            sent2_control_accumulates <= sent1_control_accumulates;
            sent2_control_stores <= sent1_control_stores;
            sent2_control_condition <= sent1_control_condition;
            sent2_control_enabling <= sent1_control_enabling;
            sent2_control_by_sign <= sent1_control_by_sign;
            sent2_control_flagging <= sent1_control_flagging;
            sent2_control_read <= sent1_control_read;
            sent2_control_write <= sent1_control_write;
            sent2_given_banks <= sent1_given_banks;
            sent2_given_texture <= sent1_given_texture;
            sent3_control_source <= sent2_control_source;
            sent3_control_constant <= sent2_control_constant;
            sent3_control_function <= sent2_control_function;
            sent3_control_begin <= sent2_control_begin;
            sent3_control_mask <= sent2_control_mask;
            sent3_control_accumulates <= sent2_control_accumulates;
            sent3_control_stores <= sent2_control_stores;
            sent3_control_condition <= sent2_control_condition;
            sent3_control_enabling <= sent2_control_enabling;
            sent3_control_by_sign <= sent2_control_by_sign;
            sent3_control_flagging <= sent2_control_flagging;
            sent3_control_read <= sent2_control_read;
            sent3_control_write <= sent2_control_write;
            sent3_given_banks <= sent2_given_banks;
            sent3_given_texture <= sent2_given_texture;
            sent4_control_source <= sent3_control_source;
            sent4_control_constant <= sent3_control_constant;
            sent4_control_function <= sent3_control_function;
            sent4_control_begin <= sent3_control_begin;
            sent4_control_mask <= sent3_control_mask;
            sent4_control_accumulates <= sent3_control_accumulates;
            sent4_control_stores <= sent3_control_stores;
            sent4_control_condition <= sent3_control_condition;
            sent4_control_enabling <= sent3_control_enabling;
            sent4_control_by_sign <= sent3_control_by_sign;
            sent4_control_flagging <= sent3_control_flagging;
            sent4_control_read <= sent3_control_read;
            sent4_control_write <= sent3_control_write;
            sent4_given_banks <= sent3_given_banks;
            sent4_given_texture <= sent3_given_texture;
            sent5_control_source <= sent4_control_source;
            sent5_control_constant <= sent4_control_constant;
            sent5_control_function <= sent4_control_function;
            sent5_control_begin <= sent4_control_begin;
            sent5_control_mask <= sent4_control_mask;
            sent5_control_accumulates <= sent4_control_accumulates;
            sent5_control_stores <= sent4_control_stores;
            sent5_control_condition <= sent4_control_condition;
            sent5_control_enabling <= sent4_control_enabling;
            sent5_control_by_sign <= sent4_control_by_sign;
            sent5_control_flagging <= sent4_control_flagging;
            sent5_control_read <= sent4_control_read;
            sent5_control_write <= sent4_control_write;
            sent5_given_banks <= sent4_given_banks;
            sent5_given_texture <= sent4_given_texture;
        end
    end

    assign control_source = sent5_control_source;
    assign control_constant = sent5_control_constant;
    assign control_function = sent5_control_function;
    assign control_begin = sent5_control_begin;
    assign control_mask = sent5_control_mask;
    assign control_accumulates = sent5_control_accumulates;
    assign control_stores = sent5_control_stores;
    assign control_condition = sent5_control_condition;
    assign control_enabling = sent5_control_enabling;
    assign control_by_sign = sent5_control_by_sign;
    assign control_flagging = sent5_control_flagging;
    assign control_read = sent5_control_read;
    assign control_write = sent5_control_write;
    assign given_banks = sent5_given_banks;
    assign given_texture = sent5_given_texture;

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
        if (!rst) assume (!instructions_taken | ((instructions_sync != SYNC_GIVE_BANK) | assumed_equal)); // rtl/src/pixelflow/controller.rs:241
        if (!rst) assume (!instructions_taken | assumed_or);         // rtl/src/pixelflow/controller.rs:241
        if (!rst) assert (!(asserted_and & evaluator_is_word & memory_is_word)); // rtl/src/pixelflow/controller.rs:173
        if (!rst) assert (asserted_and_2 & (sent5_control_flagging <= FLAGGING_ENABLED_CONDITION)); // rtl/src/pixelflow/controller.rs:184
        if (!rst) assume (!instructions_taken | assumed_and);        // rtl/src/pixelflow/controller.rs:248
        if (!rst) assume (!instructions_taken | (expression | (instructions_skip == 3'd0))); // rtl/src/pixelflow/controller.rs:248
        if (!rst) assume (!instructions_taken | (assumed_choice & assumed_choice_2)); // rtl/src/pixelflow/controller.rs:248
        if (!rst) assume (!instructions_taken | (assumed_and_2 & (instructions_sync <= SYNC_START_TEXTURE))); // rtl/src/pixelflow/controller.rs:248
    end
`else
    always @(posedge clk) begin
        if (!rst && !(!instructions_taken | ((instructions_sync != SYNC_GIVE_BANK) | assumed_equal))) begin // rtl/src/pixelflow/controller.rs:241
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a bank is given only when the network is done with it", $time);
            stop;
        end
        if (!rst && !(!instructions_taken | assumed_or)) begin       // rtl/src/pixelflow/controller.rs:241
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: the texture unit begins only when it is done", $time);
            stop;
        end
        if (!rst && (asserted_and & evaluator_is_word & memory_is_word)) begin // rtl/src/pixelflow/controller.rs:173
            $display("FAIL: time %0t: %m: at most one of two instructions uses the memory", $time);
            stop;
        end
        if (!rst && !(asserted_and_2 & (sent5_control_flagging <= FLAGGING_ENABLED_CONDITION))) begin // rtl/src/pixelflow/controller.rs:184
            $display("FAIL: time %0t: %m: the controls of pixels are valid codes", $time);
            stop;
        end
        if (!rst && !(!instructions_taken | assumed_and)) begin      // rtl/src/pixelflow/controller.rs:248
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a word has 1 to 8 bytes", $time);
            stop;
        end
        if (!rst && !(!instructions_taken | (expression | (instructions_skip == 3'd0)))) begin // rtl/src/pixelflow/controller.rs:248
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: only bytes of an expression are skipped", $time);
            stop;
        end
        if (!rst && !(!instructions_taken | (assumed_choice & assumed_choice_2))) begin // rtl/src/pixelflow/controller.rs:248
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a word is within the 384 bytes of a pixel", $time);
            stop;
        end
        if (!rst && !(!instructions_taken | (assumed_and_2 & (instructions_sync <= SYNC_START_TEXTURE)))) begin // rtl/src/pixelflow/controller.rs:248
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: each field has a valid code", $time);
            stop;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, memory_action_enabling, memory_action_by_sign, memory_action_on_memory,
            assumed_equal, assumed_or, asserted_and, asserted_and_2, assumed_and,
            assumed_choice, assumed_choice_2, assumed_and_2};
endmodule
`default_nettype wire
