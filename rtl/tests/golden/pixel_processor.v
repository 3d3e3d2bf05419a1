// pixel_processor
//
// Processes one bit of a pixel in each clock.
//
// Parameters  PixelProcessor
// Latency     1 clock to the memory and the flags
// Source      Pixel-planes 5, section I.3.2.1 (PP5-ARCH)
// Described   rtl/src/pixel_planes/pixel.rs:95
`default_nettype none

module pixel_processor (
    input  wire       clk,
    // The control of all processors.
    input  wire [1:0] control_source,   // Where the operand comes from: a `Source`.
    input  wire       control_constant, // The operand, if it is a constant.
    input  wire       control_adds,     // The bit that is read, and the carry, are added to the operand.
    input  wire       control_first,    // The bit is the first of a word: carry and flag restart from 0.
    input  wire [1:0] control_mask,     // Which processors write the result: a `Mask`.
    // The flag is set where the operand's bits so far are less than those in memory.
    input  wire       control_compares,
    input  wire       control_gates,    // The comparison sets the flag only where the processor is enabled.
    input  wire [2:0] control_enabling, // The change of the enable flags: an `Enabling`.
    input  wire       control_captures, // The flag takes the new value of the enable flag.
    input  wire [7:0] control_read,     // The address that is read.
    input  wire [7:0] control_write,    // The address that is written.
    input  wire       expression,       // A bit of the expression at this pixel.
    output wire       word              // The bit of memory that is read.
);

    localparam [1:0] SOURCE_EXPRESSION = 2'd0;
    localparam [1:0] SOURCE_MEMORY     = 2'd1;
    // Not used here: SOURCE_CONSTANT = 2.
    localparam [1:0] MASK_NOBODY    = 2'd0;
    localparam [1:0] MASK_EVERYBODY = 2'd1;
    localparam [1:0] MASK_ENABLED   = 2'd2;
    // Not used here: MASK_FLAGGED = 3.
    localparam [2:0] ENABLING_KEEP    = 3'd0;
    localparam [2:0] ENABLING_SET     = 3'd1;
    localparam [2:0] ENABLING_CLEAR   = 3'd2;
    localparam [2:0] ENABLING_REPLACE = 3'd3;
    // Not used here: ENABLING_RESTRICT = 4.

    reg carry;                                                   // rtl/src/pixel_planes/pixel.rs:126
    reg enable;                                                  // rtl/src/pixel_planes/pixel.rs:131
    reg flag;                                                    // rtl/src/pixel_planes/pixel.rs:141

    (* no_rw_check *)
    reg memory [0:207];                                          // rtl/src/pixel_planes/pixel.rs:118

    assign word = (control_read < 8'd208) ? memory[control_read] : 1'b0; // rtl/src/pixel_planes/pixel.rs:119
    reg operand;                                                 // rtl/src/pixel_planes/pixel.rs:120
    always @* begin
        case (control_source)
            SOURCE_EXPRESSION: operand = expression;
            SOURCE_MEMORY: operand = word;
            default: operand = control_constant; // SOURCE_CONSTANT
        endcase
    end
    wire carried = carry & !control_first;                       // rtl/src/pixel_planes/pixel.rs:127
    wire result = operand ^ (control_adds & (word ^ carried));   // rtl/src/pixel_planes/pixel.rs:129
    reg enabled;                                                 // rtl/src/pixel_planes/pixel.rs:132
    always @* begin
        case (control_enabling)
            ENABLING_KEEP: enabled = enable;
            ENABLING_SET: enabled = 1'b1;
            ENABLING_CLEAR: enabled = 1'b0;
            ENABLING_REPLACE: enabled = !expression;
            default: enabled = enable & !expression; // ENABLING_RESTRICT
        endcase
    end
    wire is_less = (operand == word) ? (flag & !control_first) : word; // rtl/src/pixel_planes/pixel.rs:142
    reg writes;                                                  // rtl/src/pixel_planes/pixel.rs:145
    always @* begin
        case (control_mask)
            MASK_NOBODY: writes = 1'b0;
            MASK_EVERYBODY: writes = 1'b1;
            MASK_ENABLED: writes = enable;
            default: writes = flag; // MASK_FLAGGED
        endcase
    end

    always @(posedge clk) begin
        if (writes) memory[control_write] <= result;
    end

    always @(posedge clk) begin
        if (control_adds) carry <= (operand & word) | (carried & (operand | word));
        enable <= enabled;
        if (control_captures) flag <= enabled;
        else if (control_compares) flag <= is_less & (enable | !control_gates);
    end
endmodule
`default_nettype wire
