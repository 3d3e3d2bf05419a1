// compositor_pixels4_width8
//
// Passes on the lesser of two words of each pixel, byte by byte.
//
// Parameters  Compositor { pixels: 4, width: 8 }
// Latency     1 clock; a byte in every clock
// Source      Reducing Latency on PixelFlow, section 3 (PFL-NET)
// Described   rtl/src/pixelflow/compositor.rs:54
`default_nettype none

module compositor_pixels4_width8 (
    input  wire       clk,
    input  wire [1:0] mode,       // The mode of the node: a `Mode`.
    input  wire       advances,   // A byte of the pixel is transferred.
    input  wire       first,      // The byte is the first of the pixel's word.
    input  wire [1:0] pixel,      // The number of the pixel.
    input  wire [7:0] upstream,   // The pixel's byte from the previous node.
    input  wire [7:0] own,        // The pixel's byte in this node.
    output reg  [7:0] downstream  // The pixel's byte for the next node.
);

    localparam [1:0] MODE_LOAD      = 2'd1;
    localparam [1:0] MODE_COMPOSITE = 2'd2;
    // Not used here: MODE_FORWARD = 0, MODE_UNLOAD = 3.
    localparam [1:0] NEARER_EQUAL    = 2'd0;
    localparam [1:0] NEARER_OWN      = 2'd1;
    localparam [1:0] NEARER_UPSTREAM = 2'd2;

    (* no_rw_check *)
    reg [1:0] states [0:3];                                      // rtl/src/pixelflow/compositor.rs:86

    wire [1:0] states_word = states[pixel];                      // rtl/src/pixelflow/compositor.rs:87
    wire [1:0] state = first ? NEARER_EQUAL : states_word;       // rtl/src/pixelflow/compositor.rs:87
    reg [1:0] nearer_choice;                                     // rtl/src/pixelflow/compositor.rs:89
    always @* begin
        if (own < upstream) nearer_choice = NEARER_OWN;
        else if (upstream < own) nearer_choice = NEARER_UPSTREAM;
        else nearer_choice = NEARER_EQUAL;
    end
    wire [1:0] nearer = (state == NEARER_EQUAL) ? nearer_choice : state; // rtl/src/pixelflow/compositor.rs:89
    reg takes_own;                                               // rtl/src/pixelflow/compositor.rs:92
    always @* begin
        case (mode)
            MODE_LOAD: takes_own = 1'b1;
            MODE_COMPOSITE: takes_own = nearer == NEARER_OWN;
            default: takes_own = 1'b0;
        endcase
    end

    always @(posedge clk) begin
        if (advances) states[pixel] <= nearer;
    end

    always @(posedge clk) begin
        if (advances) begin
            if (takes_own) downstream <= own;
            else downstream <= upstream;
        end
    end
endmodule
`default_nettype wire
