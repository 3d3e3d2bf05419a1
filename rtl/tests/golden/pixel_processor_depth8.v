// pixel_processor_depth8
//
// Computes one byte of a pixel in every clock.
//
// Parameters  PixelProcessor { depth: 8 }
// Latency     1 clock to the memory and the flags
// Source      Reducing Latency on PixelFlow, section 3 (PFL-NODE)
// Described   rtl/src/pixelflow/pixel.rs:177
`default_nettype none

module pixel_processor_depth8 (
    input  wire       clk,
    // The control of all processors.
    input  wire [1:0] control_source,      // Where the operand comes from: a `Source`.
    input  wire [7:0] control_constant,    // The operand, if it is a constant.
    input  wire [3:0] control_function,    // The function of the ALU: a `Function`.
    input  wire [1:0] control_begin,       // The carry into the byte: a `Begin`.
    input  wire [1:0] control_mask,        // Which processors write: a `Mask`.
    input  wire       control_accumulates, // The result goes to the accumulator.
    input  wire       control_stores,      // The result goes to memory.
    input  wire [1:0] control_condition,   // What `enabling` and `flagging` depend on: a `Condition`.
    input  wire [2:0] control_enabling,    // The change of the enable flags: an `Enabling`.
    // `enabling` depends on the expression's sign instead: the condition is true if its top bit is 0.
    input  wire       control_by_sign,
    input  wire [1:0] control_flagging,    // The change of the flag: a `Flagging`.
    input  wire [8:0] control_read,        // The read address.
    input  wire [8:0] control_write,       // The write address.
    input  wire [7:0] expression,          // A byte of the expression at this pixel.
    // The communication register at the read address, if that is one of a register.
    input  wire [7:0] register_byte,
    output reg  [7:0] result,              // The result of the ALU.
    output wire       writes_register      // The result is written to the communication register at the write address.
);

    localparam [1:0] SOURCE_CONSTANT    = 2'd0;
    localparam [1:0] SOURCE_EXPRESSION  = 2'd1;
    localparam [1:0] SOURCE_ACCUMULATOR = 2'd2;
    // Not used here: SOURCE_MULTIPLICAND = 3.
    localparam [3:0] FUNCTION_WORD         = 4'd1;
    localparam [3:0] FUNCTION_ADD          = 4'd2;
    localparam [3:0] FUNCTION_SUBTRACT     = 4'd3;
    localparam [3:0] FUNCTION_COMPARE      = 4'd4;
    localparam [3:0] FUNCTION_AND          = 4'd5;
    localparam [3:0] FUNCTION_OR           = 4'd6;
    localparam [3:0] FUNCTION_EXCLUSIVE_OR = 4'd7;
    localparam [3:0] FUNCTION_SHIFT_LEFT   = 4'd8;
    localparam [3:0] FUNCTION_SHIFT_RIGHT  = 4'd9;
    localparam [3:0] FUNCTION_ADD_HALVED   = 4'd10;
    // Not used here: FUNCTION_OPERAND = 0.
    localparam [1:0] BEGIN_KEPT = 2'd0;
    localparam [1:0] BEGIN_ZERO = 2'd1;
    // Not used here: BEGIN_ONE = 2.
    localparam [1:0] MASK_NOBODY    = 2'd0;
    localparam [1:0] MASK_EVERYBODY = 2'd1;
    localparam [1:0] MASK_ENABLED   = 2'd2;
    // Not used here: MASK_FLAGGED = 3.
    localparam [1:0] CONDITION_POSITIVE = 2'd0;
    localparam [1:0] CONDITION_CARRY    = 2'd1;
    // Not used here: CONDITION_NO_CARRY = 2.
    localparam [2:0] ENABLING_KEEP     = 3'd0;
    localparam [2:0] ENABLING_SET      = 3'd1;
    localparam [2:0] ENABLING_REPLACE  = 3'd2;
    localparam [2:0] ENABLING_RESTRICT = 3'd3;
    localparam [2:0] ENABLING_PUSH     = 3'd4;
    localparam [2:0] ENABLING_INVERT   = 3'd5;
    // Not used here: ENABLING_POP = 6.
    localparam [1:0] FLAGGING_KEEP      = 2'd0;
    localparam [1:0] FLAGGING_CONDITION = 2'd1;
    // Not used here: FLAGGING_ENABLED_CONDITION = 2.

    reg [7:0] accumulator;                                       // rtl/src/pixelflow/pixel.rs:213
    reg carry;                                                   // rtl/src/pixelflow/pixel.rs:214
    reg flag;                                                    // rtl/src/pixelflow/pixel.rs:215
    reg [7:0] enable;                                            // rtl/src/pixelflow/pixel.rs:259

    (* no_rw_check *)
    reg [7:0] memory [0:255];                                    // rtl/src/pixelflow/pixel.rs:211

    wire [7:0] memory_word = memory[control_read[7:0]];          // rtl/src/pixelflow/pixel.rs:212
    wire [7:0] word = control_read[8] ? register_byte : memory_word; // rtl/src/pixelflow/pixel.rs:212
    reg [7:0] operand;                                           // rtl/src/pixelflow/pixel.rs:216
    always @* begin
        case (control_source)
            SOURCE_CONSTANT: operand = control_constant;
            SOURCE_EXPRESSION: operand = expression;
            SOURCE_ACCUMULATOR: operand = accumulator;
            default: begin // SOURCE_MULTIPLICAND
                if (flag) operand = accumulator;
                else operand = 8'd0;
            end
        endcase
    end
    reg carried;                                                 // rtl/src/pixelflow/pixel.rs:222
    always @* begin
        case (control_begin)
            BEGIN_KEPT: carried = carry;
            BEGIN_ZERO: carried = 1'b0;
            default: carried = 1'b1; // BEGIN_ONE
        endcase
    end
    wire subtracts = (control_function == FUNCTION_SUBTRACT) | (control_function == FUNCTION_COMPARE); // rtl/src/pixelflow/pixel.rs:229
    wire [7:0] addend = subtracts ? ~operand : operand;          // rtl/src/pixelflow/pixel.rs:230
    wire [7:0] sum = word + addend + {7'd0, carried};            // rtl/src/pixelflow/pixel.rs:231
    wire [7:0] carry_out_or = (word & addend) | ((word | addend) & ~sum); // rtl/src/pixelflow/pixel.rs:232
    wire carry_out = carry_out_or[7];                            // rtl/src/pixelflow/pixel.rs:232
    always @* begin
        case (control_function)
            FUNCTION_WORD: result = word;
            FUNCTION_ADD: result = sum;
            FUNCTION_SUBTRACT: result = sum;
            FUNCTION_AND: result = word & operand;
            FUNCTION_OR: result = word | operand;
            FUNCTION_EXCLUSIVE_OR: result = word ^ operand;
            FUNCTION_SHIFT_LEFT: result = {word[6:0], carried};
            FUNCTION_SHIFT_RIGHT: result = {carried, word[7:1]};
            FUNCTION_ADD_HALVED: result = {carry_out, sum[7:1]};
            default: result = operand;
        endcase
    end
    reg carry_next;                                              // rtl/src/pixelflow/pixel.rs:244
    always @* begin
        case (control_function)
            FUNCTION_ADD: carry_next = carry_out;
            FUNCTION_SUBTRACT: carry_next = carry_out;
            FUNCTION_COMPARE: carry_next = carry_out;
            FUNCTION_SHIFT_LEFT: carry_next = word[7];
            FUNCTION_SHIFT_RIGHT: carry_next = word[0];
            FUNCTION_ADD_HALVED: carry_next = sum[0];
            default: carry_next = carry;
        endcase
    end
    reg holds;                                                   // rtl/src/pixelflow/pixel.rs:253
    always @* begin
        case (control_condition)
            CONDITION_POSITIVE: holds = !operand[7];
            CONDITION_CARRY: holds = carry_next;
            default: holds = !carry_next; // CONDITION_NO_CARRY
        endcase
    end
    wire enters = control_by_sign ? !expression[7] : holds;      // rtl/src/pixelflow/pixel.rs:258
    reg [7:0] enables;                                           // rtl/src/pixelflow/pixel.rs:261
    always @* begin
        case (control_enabling)
            ENABLING_KEEP: enables = enable;
            ENABLING_SET: enables = {enable[7:1], 1'b1};
            ENABLING_REPLACE: enables = {enable[7:1], enters};
            ENABLING_RESTRICT: enables = {enable[7:1], enable[0] & enters};
            ENABLING_PUSH: enables = {enable[6:0], enable[0] & enters};
            ENABLING_INVERT: enables = {enable[7:1], enable[1] & !enable[0]};
            default: enables = {enable[7], enable[7:1]}; // ENABLING_POP
        endcase
    end
    reg writes;                                                  // rtl/src/pixelflow/pixel.rs:277
    always @* begin
        case (control_mask)
            MASK_NOBODY: writes = 1'b0;
            MASK_EVERYBODY: writes = 1'b1;
            MASK_ENABLED: writes = enable[0];
            default: writes = flag; // MASK_FLAGGED
        endcase
    end
    wire stores = writes & control_stores;                       // rtl/src/pixelflow/pixel.rs:284
    assign writes_register = stores & control_write[8];          // rtl/src/pixelflow/pixel.rs:286

    always @(posedge clk) begin
        if (stores & !control_write[8]) memory[control_write[7:0]] <= result;
    end

    always @(posedge clk) begin
        if (writes & control_accumulates) accumulator <= result;
        carry <= carry_next;
        case (control_flagging)
            FLAGGING_KEEP: ;
            FLAGGING_CONDITION: flag <= holds;
            default: flag <= holds & enable[0]; // FLAGGING_ENABLED_CONDITION
        endcase
        enable <= enables;
    end

    wire _unused_ok = &{1'b0, carry_out_or[6:0]};
endmodule
`default_nettype wire
