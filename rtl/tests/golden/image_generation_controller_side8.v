// image_generation_controller_side8
//
// Takes the instructions of a renderer, and controls its tree and its pixels.
//
// Parameters  ImageGenerationController { side: 8, quadratic: false }
// Latency     1 clock to the coefficients' bits, 7 to the control of pixels; instructions follow without a gap
// Source      Pixel-planes 5, section I.3.2.1 (PP5-UT)
// Described   rtl/src/pixel_planes/controller.rs:47
`default_nettype none

module image_generation_controller_side8 (
    input  wire        clk,
    input  wire        rst,
    // The instructions.
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
    input  wire        store_free,                  // The backing store can take a region.
    // The bits of the coefficients, for the tree.
    output wire        coefficients_a,              // Coefficient A, the increase from one column to the next.
    output wire        coefficients_b,              // Coefficient B, the increase from one line to the next.
    output wire        coefficients_c,              // Coefficient C, the value at column 0 of line 0.
    output reg         first,                       // The coefficients' bits are the first of an expression.
    // The control of the pixels.
    output wire [1:0]  control_source,              // Where the operand comes from: a `Source`.
    output wire        control_constant,            // The operand, if it is a constant.
    output wire        control_adds,                // The bit that is read, and the carry, are added to the operand.
    output wire        control_first,               // The bit is the first of a word: carry and flag restart from 0.
    output wire [1:0]  control_mask,                // Which processors write the result: a `Mask`.
    // The flag is set where the operand's bits so far are less than those in memory.
    output wire        control_compares,
    output wire        control_gates,               // The comparison sets the flag only where the processor is enabled.
    output wire [2:0]  control_enabling,            // The change of the enable flags: an `Enabling`.
    output wire        control_captures,            // The flag takes the new value of the enable flag.
    output wire [7:0]  control_read,                // The address that is read.
    output wire [7:0]  control_write,               // The address that is written.
    // The commands to the backing store.
    output wire        save_claim,                  // A region is about to be saved: the store is no longer free.
    output wire [15:0] save_region,                 // The number of the region to save.
    // The pixels read a plane of the region; their write address is the plane's number.
    output wire        save_plane,
    // No instruction is offered, waits or is in a slot; the pixels may still be at work.
    output wire        idle,
    output wire        instructions_ready
);

    localparam [4:0] OPERATION_CURVE = 5'd18;
    // Not used here: OPERATION_ENABLE = 0, OPERATION_DISABLE = 1, OPERATION_TEST_FIRST = 2,
    //     OPERATION_TEST = 3, OPERATION_TEST_LAST = 4, OPERATION_FLAG = 5, OPERATION_EVALUATE = 6,
    //     OPERATION_EVALUATE_ENABLED = 7, OPERATION_EVALUATE_FLAGGED = 8, OPERATION_ADD = 9,
    //     OPERATION_COMPARE = 10, OPERATION_COMPARE_ON = 11, OPERATION_COMPARE_CONSTANT = 12,
    //     OPERATION_FILL = 13, OPERATION_FILL_FLAGGED = 14, OPERATION_COPY = 15,
    //     OPERATION_COPY_FLAGGED = 16, OPERATION_SAVE = 17.
    localparam [1:0] SOURCE_EXPRESSION = 2'd0;
    localparam [1:0] SOURCE_CONSTANT   = 2'd2;
    // Not used here: SOURCE_MEMORY = 1.
    localparam [1:0] MASK_NOBODY = 2'd0;
    // Not used here: MASK_EVERYBODY = 1, MASK_ENABLED = 2, MASK_FLAGGED = 3.
    localparam [2:0] ENABLING_KEEP     = 3'd0;
    localparam [2:0] ENABLING_RESTRICT = 3'd4;
    // Not used here: ENABLING_SET = 1, ENABLING_CLEAR = 2, ENABLING_REPLACE = 3.

    reg tree_microcode_on_tree;                                  // rtl/src/pixel_planes/controller/slot.rs:53
    reg tree_microcode_on_memory;                                // rtl/src/pixel_planes/controller/slot.rs:53
    reg [1:0] tree_microcode_source;                             // rtl/src/pixel_planes/controller/slot.rs:53
    reg tree_microcode_adds;                                     // rtl/src/pixel_planes/controller/slot.rs:53
    reg tree_microcode_begins;                                   // rtl/src/pixel_planes/controller/slot.rs:53
    reg [1:0] tree_microcode_mask;                               // rtl/src/pixel_planes/controller/slot.rs:53
    reg tree_microcode_compares;                                 // rtl/src/pixel_planes/controller/slot.rs:53
    reg tree_microcode_gates;                                    // rtl/src/pixel_planes/controller/slot.rs:53
    reg [2:0] tree_microcode_enabling;                           // rtl/src/pixel_planes/controller/slot.rs:53
    reg tree_microcode_captures;                                 // rtl/src/pixel_planes/controller/slot.rs:53
    reg tree_microcode_saves;                                    // rtl/src/pixel_planes/controller/slot.rs:53
    reg [6:0] tree_length;                                       // rtl/src/pixel_planes/controller/slot.rs:53
    reg [7:0] tree_left;                                         // rtl/src/pixel_planes/controller/slot.rs:55
    reg [39:0] tree_bits;                                        // rtl/src/pixel_planes/controller/slot.rs:57
    reg [7:0] tree_read;                                         // rtl/src/pixel_planes/controller/slot.rs:59
    reg [7:0] tree_write;                                        // rtl/src/pixel_planes/controller/slot.rs:60
    reg memory_microcode_on_tree;                                // rtl/src/pixel_planes/controller/slot.rs:53
    reg memory_microcode_on_memory;                              // rtl/src/pixel_planes/controller/slot.rs:53
    reg [1:0] memory_microcode_source;                           // rtl/src/pixel_planes/controller/slot.rs:53
    reg memory_microcode_adds;                                   // rtl/src/pixel_planes/controller/slot.rs:53
    reg memory_microcode_begins;                                 // rtl/src/pixel_planes/controller/slot.rs:53
    reg [1:0] memory_microcode_mask;                             // rtl/src/pixel_planes/controller/slot.rs:53
    reg memory_microcode_compares;                               // rtl/src/pixel_planes/controller/slot.rs:53
    reg memory_microcode_gates;                                  // rtl/src/pixel_planes/controller/slot.rs:53
    reg [2:0] memory_microcode_enabling;                         // rtl/src/pixel_planes/controller/slot.rs:53
    reg memory_microcode_captures;                               // rtl/src/pixel_planes/controller/slot.rs:53
    reg memory_microcode_saves;                                  // rtl/src/pixel_planes/controller/slot.rs:53
    reg [6:0] memory_length;                                     // rtl/src/pixel_planes/controller/slot.rs:53
    reg [7:0] memory_left;                                       // rtl/src/pixel_planes/controller/slot.rs:55
    reg [39:0] memory_bits;                                      // rtl/src/pixel_planes/controller/slot.rs:57
    reg [7:0] memory_read;                                       // rtl/src/pixel_planes/controller/slot.rs:59
    reg [7:0] memory_write;                                      // rtl/src/pixel_planes/controller/slot.rs:60
    reg waits;                                                   // rtl/src/pixel_planes/controller.rs:118
    reg waiting_microcode_on_tree;                               // rtl/src/pixel_planes/controller.rs:119
    reg waiting_microcode_on_memory;                             // rtl/src/pixel_planes/controller.rs:119
    reg [1:0] waiting_microcode_source;                          // rtl/src/pixel_planes/controller.rs:119
    reg waiting_microcode_adds;                                  // rtl/src/pixel_planes/controller.rs:119
    reg waiting_microcode_begins;                                // rtl/src/pixel_planes/controller.rs:119
    reg [1:0] waiting_microcode_mask;                            // rtl/src/pixel_planes/controller.rs:119
    reg waiting_microcode_compares;                              // rtl/src/pixel_planes/controller.rs:119
    reg waiting_microcode_gates;                                 // rtl/src/pixel_planes/controller.rs:119
    reg [2:0] waiting_microcode_enabling;                        // rtl/src/pixel_planes/controller.rs:119
    reg waiting_microcode_captures;                              // rtl/src/pixel_planes/controller.rs:119
    reg waiting_microcode_saves;                                 // rtl/src/pixel_planes/controller.rs:119
    reg [5:0] waiting_skip;                                      // rtl/src/pixel_planes/controller.rs:119
    reg [6:0] waiting_length;                                    // rtl/src/pixel_planes/controller.rs:119
    reg [7:0] waiting_read;                                      // rtl/src/pixel_planes/controller.rs:119
    reg [7:0] waiting_write;                                     // rtl/src/pixel_planes/controller.rs:119
    reg [39:0] waiting_constant;                                 // rtl/src/pixel_planes/controller.rs:119
    reg [39:0] a;                                                // rtl/src/pixel_planes/controller/slot.rs:107
    reg [39:0] b;                                                // rtl/src/pixel_planes/controller/slot.rs:107
    reg [1:0] sent1_control_source;                              // rtl/src/pixel_planes/controller.rs:198
    reg sent1_control_constant;                                  // rtl/src/pixel_planes/controller.rs:198
    reg sent1_control_adds;                                      // rtl/src/pixel_planes/controller.rs:198
    reg sent1_control_first;                                     // rtl/src/pixel_planes/controller.rs:198
    reg [1:0] sent1_control_mask;                                // rtl/src/pixel_planes/controller.rs:198
    reg sent1_control_compares;                                  // rtl/src/pixel_planes/controller.rs:198
    reg sent1_control_gates;                                     // rtl/src/pixel_planes/controller.rs:198
    reg [2:0] sent1_control_enabling;                            // rtl/src/pixel_planes/controller.rs:198
    reg sent1_control_captures;                                  // rtl/src/pixel_planes/controller.rs:198
    reg [7:0] sent1_control_read;                                // rtl/src/pixel_planes/controller.rs:198
    reg [7:0] sent1_control_write;                               // rtl/src/pixel_planes/controller.rs:198
    reg sent1_plane;                                             // rtl/src/pixel_planes/controller.rs:198
    reg [1:0] sent2_control_source;                              // rtl/src/pixel_planes/controller.rs:198
    reg sent2_control_constant;                                  // rtl/src/pixel_planes/controller.rs:198
    reg sent2_control_adds;                                      // rtl/src/pixel_planes/controller.rs:198
    reg sent2_control_first;                                     // rtl/src/pixel_planes/controller.rs:198
    reg [1:0] sent2_control_mask;                                // rtl/src/pixel_planes/controller.rs:198
    reg sent2_control_compares;                                  // rtl/src/pixel_planes/controller.rs:198
    reg sent2_control_gates;                                     // rtl/src/pixel_planes/controller.rs:198
    reg [2:0] sent2_control_enabling;                            // rtl/src/pixel_planes/controller.rs:198
    reg sent2_control_captures;                                  // rtl/src/pixel_planes/controller.rs:198
    reg [7:0] sent2_control_read;                                // rtl/src/pixel_planes/controller.rs:198
    reg [7:0] sent2_control_write;                               // rtl/src/pixel_planes/controller.rs:198
    reg sent2_plane;                                             // rtl/src/pixel_planes/controller.rs:198
    reg [1:0] sent3_control_source;                              // rtl/src/pixel_planes/controller.rs:198
    reg sent3_control_constant;                                  // rtl/src/pixel_planes/controller.rs:198
    reg sent3_control_adds;                                      // rtl/src/pixel_planes/controller.rs:198
    reg sent3_control_first;                                     // rtl/src/pixel_planes/controller.rs:198
    reg [1:0] sent3_control_mask;                                // rtl/src/pixel_planes/controller.rs:198
    reg sent3_control_compares;                                  // rtl/src/pixel_planes/controller.rs:198
    reg sent3_control_gates;                                     // rtl/src/pixel_planes/controller.rs:198
    reg [2:0] sent3_control_enabling;                            // rtl/src/pixel_planes/controller.rs:198
    reg sent3_control_captures;                                  // rtl/src/pixel_planes/controller.rs:198
    reg [7:0] sent3_control_read;                                // rtl/src/pixel_planes/controller.rs:198
    reg [7:0] sent3_control_write;                               // rtl/src/pixel_planes/controller.rs:198
    reg sent3_plane;                                             // rtl/src/pixel_planes/controller.rs:198
    reg [1:0] sent4_control_source;                              // rtl/src/pixel_planes/controller.rs:198
    reg sent4_control_constant;                                  // rtl/src/pixel_planes/controller.rs:198
    reg sent4_control_adds;                                      // rtl/src/pixel_planes/controller.rs:198
    reg sent4_control_first;                                     // rtl/src/pixel_planes/controller.rs:198
    reg [1:0] sent4_control_mask;                                // rtl/src/pixel_planes/controller.rs:198
    reg sent4_control_compares;                                  // rtl/src/pixel_planes/controller.rs:198
    reg sent4_control_gates;                                     // rtl/src/pixel_planes/controller.rs:198
    reg [2:0] sent4_control_enabling;                            // rtl/src/pixel_planes/controller.rs:198
    reg sent4_control_captures;                                  // rtl/src/pixel_planes/controller.rs:198
    reg [7:0] sent4_control_read;                                // rtl/src/pixel_planes/controller.rs:198
    reg [7:0] sent4_control_write;                               // rtl/src/pixel_planes/controller.rs:198
    reg sent4_plane;                                             // rtl/src/pixel_planes/controller.rs:198
    reg [1:0] sent5_control_source;                              // rtl/src/pixel_planes/controller.rs:198
    reg sent5_control_constant;                                  // rtl/src/pixel_planes/controller.rs:198
    reg sent5_control_adds;                                      // rtl/src/pixel_planes/controller.rs:198
    reg sent5_control_first;                                     // rtl/src/pixel_planes/controller.rs:198
    reg [1:0] sent5_control_mask;                                // rtl/src/pixel_planes/controller.rs:198
    reg sent5_control_compares;                                  // rtl/src/pixel_planes/controller.rs:198
    reg sent5_control_gates;                                     // rtl/src/pixel_planes/controller.rs:198
    reg [2:0] sent5_control_enabling;                            // rtl/src/pixel_planes/controller.rs:198
    reg sent5_control_captures;                                  // rtl/src/pixel_planes/controller.rs:198
    reg [7:0] sent5_control_read;                                // rtl/src/pixel_planes/controller.rs:198
    reg [7:0] sent5_control_write;                               // rtl/src/pixel_planes/controller.rs:198
    reg sent5_plane;                                             // rtl/src/pixel_planes/controller.rs:198
    reg [1:0] sent6_control_source;                              // rtl/src/pixel_planes/controller.rs:198
    reg sent6_control_constant;                                  // rtl/src/pixel_planes/controller.rs:198
    reg sent6_control_adds;                                      // rtl/src/pixel_planes/controller.rs:198
    reg sent6_control_first;                                     // rtl/src/pixel_planes/controller.rs:198
    reg [1:0] sent6_control_mask;                                // rtl/src/pixel_planes/controller.rs:198
    reg sent6_control_compares;                                  // rtl/src/pixel_planes/controller.rs:198
    reg sent6_control_gates;                                     // rtl/src/pixel_planes/controller.rs:198
    reg [2:0] sent6_control_enabling;                            // rtl/src/pixel_planes/controller.rs:198
    reg sent6_control_captures;                                  // rtl/src/pixel_planes/controller.rs:198
    reg [7:0] sent6_control_read;                                // rtl/src/pixel_planes/controller.rs:198
    reg [7:0] sent6_control_write;                               // rtl/src/pixel_planes/controller.rs:198
    reg sent6_plane;                                             // rtl/src/pixel_planes/controller.rs:198

    (* no_rw_check *)
    reg [14:0] microcode [0:18];                                 // rtl/src/pixel_planes/controller.rs:115

    initial begin : microcode_contents
        microcode[0] = 15'h5004;
        microcode[1] = 15'h5008;
        microcode[2] = 15'h400c;
        microcode[3] = 15'h4010;
        microcode[4] = 15'h6012;
        microcode[5] = 15'h7002;
        microcode[6] = 15'h6080;
        microcode[7] = 15'h6100;
        microcode[8] = 15'h6180;
        microcode[9] = 15'h6700;
        microcode[10] = 15'h62e0;
        microcode[11] = 15'h60e0;
        microcode[12] = 15'h3240;
        microcode[13] = 15'h3080;
        microcode[14] = 15'h3180;
        microcode[15] = 15'h2880;
        microcode[16] = 15'h2980;
        microcode[17] = 15'h2801;
        microcode[18] = 15'h5000;
    end

    wire [14:0] decoded = (instructions_operation < 5'd19) ? microcode[instructions_operation] : 15'd0; // rtl/src/pixel_planes/controller.rs:116
    wire decoded_on_tree = decoded[14];                          // rtl/src/pixel_planes/controller.rs:116
    wire tree_ends = tree_left <= 8'd1;                          // rtl/src/pixel_planes/controller/slot.rs:58
    wire decoded_on_memory = decoded[13];                        // rtl/src/pixel_planes/controller.rs:116
    wire [7:0] ahead = memory_left + (waits ? {1'd0, waiting_length} : 8'd0); // rtl/src/pixel_planes/controller.rs:122
    wire ends_in_time = ahead <= ({2'd0, instructions_skip} + 8'd1); // rtl/src/pixel_planes/controller.rs:123
    wire tree_may = tree_ends & (!decoded_on_memory | ends_in_time); // rtl/src/pixel_planes/controller.rs:124
    wire memory_ends = memory_left <= 8'd1;                      // rtl/src/pixel_planes/controller/slot.rs:58
    wire memory_may_or = tree_ends | !((tree_left != 8'd0) & tree_microcode_on_memory); // rtl/src/pixel_planes/controller.rs:125
    wire memory_may_and = (!waits | memory_ends) & memory_may_or; // rtl/src/pixel_planes/controller.rs:125
    wire decoded_saves = decoded[0];                             // rtl/src/pixel_planes/controller.rs:116
    wire memory_may = memory_may_and & (!decoded_saves | store_free); // rtl/src/pixel_planes/controller.rs:125
    wire both_end = tree_ends & memory_ends & !waits;            // rtl/src/pixel_planes/controller.rs:126
    wire may = (decoded_on_tree ? tree_may : memory_may) & (side_by_side | both_end); // rtl/src/pixel_planes/controller.rs:127
    assign instructions_ready = may;                             // rtl/src/pixel_planes/controller.rs:128
    wire [1:0] decoded_source = decoded[12:11];                  // rtl/src/pixel_planes/controller.rs:116
    wire decoded_adds = decoded[10];                             // rtl/src/pixel_planes/controller.rs:116
    wire decoded_begins = decoded[9];                            // rtl/src/pixel_planes/controller.rs:116
    wire [1:0] decoded_mask = decoded[8:7];                      // rtl/src/pixel_planes/controller.rs:116
    wire decoded_compares = decoded[6];                          // rtl/src/pixel_planes/controller.rs:116
    wire decoded_gates = decoded[5];                             // rtl/src/pixel_planes/controller.rs:116
    wire [2:0] decoded_enabling = decoded[4:2];                  // rtl/src/pixel_planes/controller.rs:116
    wire decoded_captures = decoded[1];                          // rtl/src/pixel_planes/controller.rs:116
    wire tree_is_word = (tree_left != 8'd0) & (tree_left <= {1'd0, tree_length}); // rtl/src/pixel_planes/controller/slot.rs:56
    assign coefficients_c = tree_bits[0];                        // rtl/src/pixel_planes/controller/slot.rs:61
    wire memory_is_word = (memory_left != 8'd0) & (memory_left <= {1'd0, memory_length}); // rtl/src/pixel_planes/controller/slot.rs:56
    wire instructions_taken = instructions_valid & may;          // rtl/src/pixel_planes/controller.rs:128
    wire tree_begins = instructions_taken & decoded_on_tree;     // rtl/src/pixel_planes/controller.rs:132
    wire for_memory = instructions_taken & !decoded_on_tree;     // rtl/src/pixel_planes/controller.rs:133
    wire must_wait = for_memory & (waits | !memory_ends);        // rtl/src/pixel_planes/controller.rs:134
    wire memory_begins = memory_ends & (waits | for_memory);     // rtl/src/pixel_planes/controller.rs:137
    wire [6:0] memory_length_choice = waits ? waiting_length : instructions_length; // rtl/src/pixel_planes/controller.rs:139
    wire [7:0] memory_left_extended = {2'd0, waits ? waiting_skip : instructions_skip}; // rtl/src/pixel_planes/controller/slot.rs:30
    assign coefficients_a = a[0];                                // rtl/src/pixel_planes/controller/slot.rs:109
    assign coefficients_b = b[0];                                // rtl/src/pixel_planes/controller/slot.rs:109
    wire asserted_and = (tree_left != 8'd0) & tree_microcode_on_memory & tree_is_word; // rtl/src/pixel_planes/controller.rs:150
    wire sent1_control_enabling_and = tree_is_word & (tree_left == 8'd1); // rtl/src/pixel_planes/controller/slot.rs:88
    wire assumed_and = (instructions_length != 7'd0) & (instructions_length <= 7'd64); // rtl/src/pixel_planes/controller.rs:209
    wire assumed_and_2 = (instructions_length == 7'd48) & (instructions_write == 8'd0); // rtl/src/pixel_planes/controller.rs:210
    wire assumed_at_most = ({1'd0, instructions_read} + {2'd0, instructions_length}) <= 9'd208; // rtl/src/pixel_planes/controller.rs:213
    wire assumed_at_most_2 = ({1'd0, instructions_write} + {2'd0, instructions_length}) <= 9'd208; // rtl/src/pixel_planes/controller.rs:213
    wire assumed_at_least = ({2'd0, instructions_skip} + {1'd0, instructions_length}) >= 8'd3; // rtl/src/pixel_planes/controller.rs:217
    wire assumed_or = (decoded_source == SOURCE_EXPRESSION) | (instructions_skip == 6'd0); // rtl/src/pixel_planes/controller.rs:220
    assign save_claim = instructions_taken & decoded_saves;      // rtl/src/pixel_planes/controller.rs:162
    assign save_region = instructions_coefficients_c[15:0];      // rtl/src/pixel_planes/controller.rs:162
    wire idle_and = !instructions_valid & (tree_left == 8'd0);   // rtl/src/pixel_planes/controller.rs:169
    assign idle = idle_and & (memory_left == 8'd0);              // rtl/src/pixel_planes/controller.rs:169

    always @(posedge clk) begin
        if (tree_begins) tree_bits <= instructions_coefficients_c;
        else tree_bits <= {tree_bits[39], tree_bits[39:1]};
        if (tree_begins) begin
            tree_read <= instructions_read;
            tree_write <= instructions_write;
        end else if (tree_is_word) begin
            tree_read <= tree_read + 8'd1;
            tree_write <= tree_write + 8'd1;
        end
        if (memory_begins) begin
            if (waits) memory_bits <= waiting_constant;
            else memory_bits <= instructions_coefficients_c;
        end else begin
            memory_bits <= {memory_bits[39], memory_bits[39:1]};
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
            memory_read <= memory_read + 8'd1;
            memory_write <= memory_write + 8'd1;
        end
        if (must_wait) begin
            waiting_microcode_on_tree <= decoded_on_tree;
            waiting_microcode_on_memory <= decoded_on_memory;
            waiting_microcode_source <= decoded_source;
            waiting_microcode_adds <= decoded_adds;
            waiting_microcode_begins <= decoded_begins;
            waiting_microcode_mask <= decoded_mask;
            waiting_microcode_compares <= decoded_compares;
            waiting_microcode_gates <= decoded_gates;
            waiting_microcode_enabling <= decoded_enabling;
            waiting_microcode_captures <= decoded_captures;
            waiting_microcode_saves <= decoded_saves;
            waiting_skip <= instructions_skip;
            waiting_length <= instructions_length;
            waiting_read <= instructions_read;
            waiting_write <= instructions_write;
            waiting_constant <= instructions_coefficients_c;
        end
        if (tree_begins) begin
            a <= instructions_coefficients_a;
            b <= instructions_coefficients_b;
        end else begin
            a <= {a[39], a[39:1]};
            b <= {b[39], b[39:1]};
        end
    end

    always @(posedge clk) begin
        if (rst) begin
            tree_microcode_on_tree <= 1'b0;
            tree_microcode_on_memory <= 1'b0;
            tree_microcode_source <= SOURCE_EXPRESSION;
            tree_microcode_adds <= 1'b0;
            tree_microcode_begins <= 1'b0;
            tree_microcode_mask <= MASK_NOBODY;
            tree_microcode_compares <= 1'b0;
            tree_microcode_gates <= 1'b0;
            tree_microcode_enabling <= ENABLING_KEEP;
            tree_microcode_captures <= 1'b0;
            tree_microcode_saves <= 1'b0;
            tree_length <= 7'd0;
            tree_left <= 8'd0;
            memory_microcode_on_tree <= 1'b0;
            memory_microcode_on_memory <= 1'b0;
            memory_microcode_source <= SOURCE_EXPRESSION;
            memory_microcode_adds <= 1'b0;
            memory_microcode_begins <= 1'b0;
            memory_microcode_mask <= MASK_NOBODY;
            memory_microcode_compares <= 1'b0;
            memory_microcode_gates <= 1'b0;
            memory_microcode_enabling <= ENABLING_KEEP;
            memory_microcode_captures <= 1'b0;
            memory_microcode_saves <= 1'b0;
            memory_length <= 7'd0;
            memory_left <= 8'd0;
            waits <= 1'b0;
            first <= 1'b0;
            sent1_control_source <= SOURCE_EXPRESSION;
            sent1_control_constant <= 1'b0;
            sent1_control_adds <= 1'b0;
            sent1_control_first <= 1'b0;
            sent1_control_mask <= MASK_NOBODY;
            sent1_control_compares <= 1'b0;
            sent1_control_gates <= 1'b0;
            sent1_control_enabling <= ENABLING_KEEP;
            sent1_control_captures <= 1'b0;
            sent1_control_read <= 8'd0;
            sent1_control_write <= 8'd0;
            sent1_plane <= 1'b0;
            sent2_control_source <= SOURCE_EXPRESSION;
            sent2_control_constant <= 1'b0;
            sent2_control_adds <= 1'b0;
            sent2_control_first <= 1'b0;
            sent2_control_mask <= MASK_NOBODY;
            sent2_control_compares <= 1'b0;
            sent2_control_gates <= 1'b0;
            sent2_control_enabling <= ENABLING_KEEP;
            sent2_control_captures <= 1'b0;
            sent2_control_read <= 8'd0;
            sent2_control_write <= 8'd0;
            sent2_plane <= 1'b0;
            sent3_control_source <= SOURCE_EXPRESSION;
            sent3_control_constant <= 1'b0;
            sent3_control_adds <= 1'b0;
            sent3_control_first <= 1'b0;
            sent3_control_mask <= MASK_NOBODY;
            sent3_control_compares <= 1'b0;
            sent3_control_gates <= 1'b0;
            sent3_control_enabling <= ENABLING_KEEP;
            sent3_control_captures <= 1'b0;
            sent3_control_read <= 8'd0;
            sent3_control_write <= 8'd0;
            sent3_plane <= 1'b0;
            sent4_control_source <= SOURCE_EXPRESSION;
            sent4_control_constant <= 1'b0;
            sent4_control_adds <= 1'b0;
            sent4_control_first <= 1'b0;
            sent4_control_mask <= MASK_NOBODY;
            sent4_control_compares <= 1'b0;
            sent4_control_gates <= 1'b0;
            sent4_control_enabling <= ENABLING_KEEP;
            sent4_control_captures <= 1'b0;
            sent4_control_read <= 8'd0;
            sent4_control_write <= 8'd0;
            sent4_plane <= 1'b0;
            sent5_control_source <= SOURCE_EXPRESSION;
            sent5_control_constant <= 1'b0;
            sent5_control_adds <= 1'b0;
            sent5_control_first <= 1'b0;
            sent5_control_mask <= MASK_NOBODY;
            sent5_control_compares <= 1'b0;
            sent5_control_gates <= 1'b0;
            sent5_control_enabling <= ENABLING_KEEP;
            sent5_control_captures <= 1'b0;
            sent5_control_read <= 8'd0;
            sent5_control_write <= 8'd0;
            sent5_plane <= 1'b0;
            sent6_control_source <= SOURCE_EXPRESSION;
            sent6_control_constant <= 1'b0;
            sent6_control_adds <= 1'b0;
            sent6_control_first <= 1'b0;
            sent6_control_mask <= MASK_NOBODY;
            sent6_control_compares <= 1'b0;
            sent6_control_gates <= 1'b0;
            sent6_control_enabling <= ENABLING_KEEP;
            sent6_control_captures <= 1'b0;
            sent6_control_read <= 8'd0;
            sent6_control_write <= 8'd0;
            sent6_plane <= 1'b0;
        end else begin
            if (tree_begins) begin
                tree_microcode_on_tree <= decoded_on_tree;
                tree_microcode_on_memory <= decoded_on_memory;
                tree_microcode_source <= decoded_source;
                tree_microcode_adds <= decoded_adds;
                tree_microcode_begins <= decoded_begins;
                tree_microcode_mask <= decoded_mask;
                tree_microcode_compares <= decoded_compares;
                tree_microcode_gates <= decoded_gates;
                tree_microcode_enabling <= decoded_enabling;
                tree_microcode_captures <= decoded_captures;
                tree_microcode_saves <= decoded_saves;
                tree_length <= instructions_length;
            end
            if (tree_begins) begin
                tree_left <= {2'd0, instructions_skip} + {1'd0, instructions_length};
            end else if (tree_left != 8'd0) begin
                tree_left <= tree_left - 8'd1;
            end
            if (memory_begins) begin
                if (waits) begin
                    memory_microcode_on_tree <= waiting_microcode_on_tree;
                    memory_microcode_on_memory <= waiting_microcode_on_memory;
                    memory_microcode_source <= waiting_microcode_source;
                    memory_microcode_adds <= waiting_microcode_adds;
                    memory_microcode_begins <= waiting_microcode_begins;
                    memory_microcode_mask <= waiting_microcode_mask;
                    memory_microcode_compares <= waiting_microcode_compares;
                    memory_microcode_gates <= waiting_microcode_gates;
                    memory_microcode_enabling <= waiting_microcode_enabling;
                    memory_microcode_captures <= waiting_microcode_captures;
                    memory_microcode_saves <= waiting_microcode_saves;
                end else begin
                    memory_microcode_on_tree <= decoded_on_tree;
                    memory_microcode_on_memory <= decoded_on_memory;
                    memory_microcode_source <= decoded_source;
                    memory_microcode_adds <= decoded_adds;
                    memory_microcode_begins <= decoded_begins;
                    memory_microcode_mask <= decoded_mask;
                    memory_microcode_compares <= decoded_compares;
                    memory_microcode_gates <= decoded_gates;
                    memory_microcode_enabling <= decoded_enabling;
                    memory_microcode_captures <= decoded_captures;
                    memory_microcode_saves <= decoded_saves;
                end
                memory_length <= memory_length_choice;
            end
            if (memory_begins) begin
                memory_left <= memory_left_extended + {1'd0, memory_length_choice};
            end else if (memory_left != 8'd0) begin
                memory_left <= memory_left - 8'd1;
            end
            if (must_wait) waits <= 1'b1;
            else if (memory_ends) waits <= 1'b0;
            first <= tree_begins & (decoded_source == SOURCE_EXPRESSION);
            if (memory_is_word) begin
                sent1_control_source <= memory_microcode_source;
                sent1_control_constant <= memory_bits[0];
                sent1_control_adds <= memory_is_word & memory_microcode_adds;
                sent1_control_first <= memory_microcode_begins & (memory_left == {1'd0, memory_length});
            end else begin
                sent1_control_source <= tree_microcode_source;
                sent1_control_constant <= coefficients_c;
                sent1_control_adds <= tree_is_word & tree_microcode_adds;
                sent1_control_first <= tree_microcode_begins & (tree_left == {1'd0, tree_length});
            end
            if (memory_is_word) begin
                if (memory_is_word) sent1_control_mask <= memory_microcode_mask;
                else sent1_control_mask <= MASK_NOBODY;
            end else if (tree_is_word) begin
                sent1_control_mask <= tree_microcode_mask;
            end else begin
                sent1_control_mask <= MASK_NOBODY;
            end
            if (memory_is_word) begin
                sent1_control_compares <= memory_is_word & memory_microcode_compares;
                sent1_control_gates <= memory_microcode_gates;
            end else begin
                sent1_control_compares <= tree_is_word & tree_microcode_compares;
                sent1_control_gates <= tree_microcode_gates;
            end
            if (sent1_control_enabling_and) sent1_control_enabling <= tree_microcode_enabling;
            else sent1_control_enabling <= ENABLING_KEEP;
            sent1_control_captures <= sent1_control_enabling_and & tree_microcode_captures;
            if (memory_is_word) begin
                sent1_control_read <= memory_read;
                sent1_control_write <= memory_write;
            end else begin
                sent1_control_read <= tree_read;
                sent1_control_write <= tree_write;
            end
            sent1_plane <= memory_is_word & memory_microcode_saves;
            sent2_control_source <= sent1_control_source;
            sent2_control_constant <= sent1_control_constant;
            sent2_control_adds <= sent1_control_adds;
            sent2_control_first <= sent1_control_first;
            sent2_control_mask <= sent1_control_mask;
            sent2_control_compares <= sent1_control_compares;
            sent2_control_gates <= sent1_control_gates;
            sent2_control_enabling <= sent1_control_enabling;
            sent2_control_captures <= sent1_control_captures;
            sent2_control_read <= sent1_control_read;
            sent2_control_write <= sent1_control_write;
            sent2_plane <= sent1_plane;
            sent3_control_source <= sent2_control_source;
            sent3_control_constant <= sent2_control_constant;
            sent3_control_adds <= sent2_control_adds;
            sent3_control_first <= sent2_control_first;
            sent3_control_mask <= sent2_control_mask;
            sent3_control_compares <= sent2_control_compares;
            sent3_control_gates <= sent2_control_gates;
            sent3_control_enabling <= sent2_control_enabling;
            sent3_control_captures <= sent2_control_captures;
            sent3_control_read <= sent2_control_read;
            sent3_control_write <= sent2_control_write;
            sent3_plane <= sent2_plane;
            sent4_control_source <= sent3_control_source;
            sent4_control_constant <= sent3_control_constant;
            sent4_control_adds <= sent3_control_adds;
            sent4_control_first <= sent3_control_first;
            sent4_control_mask <= sent3_control_mask;
            sent4_control_compares <= sent3_control_compares;
            sent4_control_gates <= sent3_control_gates;
            sent4_control_enabling <= sent3_control_enabling;
            sent4_control_captures <= sent3_control_captures;
            sent4_control_read <= sent3_control_read;
            sent4_control_write <= sent3_control_write;
            sent4_plane <= sent3_plane;
            sent5_control_source <= sent4_control_source;
            sent5_control_constant <= sent4_control_constant;
            sent5_control_adds <= sent4_control_adds;
            sent5_control_first <= sent4_control_first;
            sent5_control_mask <= sent4_control_mask;
            sent5_control_compares <= sent4_control_compares;
            sent5_control_gates <= sent4_control_gates;
            sent5_control_enabling <= sent4_control_enabling;
            sent5_control_captures <= sent4_control_captures;
            sent5_control_read <= sent4_control_read;
            sent5_control_write <= sent4_control_write;
            sent5_plane <= sent4_plane;
            sent6_control_source <= sent5_control_source;
            sent6_control_constant <= sent5_control_constant;
            sent6_control_adds <= sent5_control_adds;
            sent6_control_first <= sent5_control_first;
            sent6_control_mask <= sent5_control_mask;
            sent6_control_compares <= sent5_control_compares;
            sent6_control_gates <= sent5_control_gates;
            sent6_control_enabling <= sent5_control_enabling;
            sent6_control_captures <= sent5_control_captures;
            sent6_control_read <= sent5_control_read;
            sent6_control_write <= sent5_control_write;
            sent6_plane <= sent5_plane;
        end
    end

    assign control_source = sent6_control_source;
    assign control_constant = sent6_control_constant;
    assign control_adds = sent6_control_adds;
    assign control_first = sent6_control_first;
    assign control_mask = sent6_control_mask;
    assign control_compares = sent6_control_compares;
    assign control_gates = sent6_control_gates;
    assign control_enabling = sent6_control_enabling;
    assign control_captures = sent6_control_captures;
    assign control_read = sent6_control_read;
    assign control_write = sent6_control_write;
    assign save_plane = sent6_plane;

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
        if (!rst) assume (!instructions_taken | (instructions_operation != OPERATION_CURVE)); // rtl/src/pixel_planes/controller.rs:177
        if (!rst) assert (!(asserted_and & memory_is_word));         // rtl/src/pixel_planes/controller.rs:150
        if (!rst) assert ((sent6_control_source <= SOURCE_CONSTANT) & (sent6_control_enabling <= ENABLING_RESTRICT)); // rtl/src/pixel_planes/controller.rs:156
        if (!rst) assume (!instructions_taken | (instructions_operation <= OPERATION_CURVE)); // rtl/src/pixel_planes/controller.rs:207
        if (!rst) assume (!instructions_taken | assumed_and);        // rtl/src/pixel_planes/controller.rs:207
        if (!rst) assume (!instructions_taken | (!decoded_saves | assumed_and_2)); // rtl/src/pixel_planes/controller.rs:207
        if (!rst) assume (!instructions_taken | (assumed_at_most & assumed_at_most_2)); // rtl/src/pixel_planes/controller.rs:207
        if (!rst) assume (!instructions_taken | ((decoded_source != SOURCE_EXPRESSION) | assumed_at_least)); // rtl/src/pixel_planes/controller.rs:207
        if (!rst) assume (!instructions_taken | assumed_or);         // rtl/src/pixel_planes/controller.rs:207
    end
`else
    always @(posedge clk) begin
        if (!rst && !(!instructions_taken | (instructions_operation != OPERATION_CURVE))) begin // rtl/src/pixel_planes/controller.rs:177
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: only the controller of a quadratic tree takes a curve", $time);
            stop;
        end
        if (!rst && (asserted_and & memory_is_word)) begin           // rtl/src/pixel_planes/controller.rs:150
            $display("FAIL: time %0t: %m: at most one of the two slots uses the memory", $time);
            stop;
        end
        if (!rst && !((sent6_control_source <= SOURCE_CONSTANT) & (sent6_control_enabling <= ENABLING_RESTRICT))) begin // rtl/src/pixel_planes/controller.rs:156
            $display("FAIL: time %0t: %m: the source and the enabling of the pixels are valid codes", $time);
            stop;
        end
        if (!rst && !(!instructions_taken | (instructions_operation <= OPERATION_CURVE))) begin // rtl/src/pixel_planes/controller.rs:207
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: the code of an instruction is an operation", $time);
            stop;
        end
        if (!rst && !(!instructions_taken | assumed_and)) begin      // rtl/src/pixel_planes/controller.rs:207
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a word has 1 to 64 bits", $time);
            stop;
        end
        if (!rst && !(!instructions_taken | (!decoded_saves | assumed_and_2))) begin // rtl/src/pixel_planes/controller.rs:207
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a whole word is saved, as planes 0 to 47", $time);
            stop;
        end
        if (!rst && !(!instructions_taken | (assumed_at_most & assumed_at_most_2))) begin // rtl/src/pixel_planes/controller.rs:207
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a word is within the memory of 208 bits", $time);
            stop;
        end
        if (!rst && !(!instructions_taken | ((decoded_source != SOURCE_EXPRESSION) | assumed_at_least))) begin // rtl/src/pixel_planes/controller.rs:207
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: an expression has at least as many bits as each tree has levels", $time);
            stop;
        end
        if (!rst && !(!instructions_taken | assumed_or)) begin       // rtl/src/pixel_planes/controller.rs:207
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: only an expression has bits to skip", $time);
            stop;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, tree_microcode_on_tree, tree_microcode_saves, memory_microcode_on_tree,
            memory_microcode_on_memory, memory_microcode_enabling, memory_microcode_captures,
            asserted_and, assumed_and, assumed_and_2, assumed_at_most, assumed_at_most_2,
            assumed_at_least, assumed_or};
endmodule
`default_nettype wire
