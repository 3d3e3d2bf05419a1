// gfb_sequencer_width16_height8_units2_overhead20
//
// Leads a merging round over the screen, through a chain of merging units.
//
// Parameters  GfbSequencer { screen: Screen { width: 16, height: 8 }, units: 2, overhead: 20 }
// Latency     a round of 296 clocks
// Source      VC-1, section 3.3, T_m (VC1-TM)
// Described   rtl/src/gfb/sequencer.rs:31
`default_nettype none

module gfb_sequencer_width16_height8_units2_overhead20 (
    input  wire       clk,
    input  wire       rst,
    input  wire       start,        // Begins a round, unless one is under way.
    // To every unit of the chain.
    output wire       scan_restart, // For one clock: every scan counter takes its preset.
    // The counters, the read-out and the merging units advance by a pixel; where it is low they hold.
    output wire       scan_enable,
    output reg  [6:0] feed,         // The pixel to read, which enters the chain `SCAN_LATENCY` clocks later.
    output wire       stores,       // A pixel leaves the chain.
    output reg  [6:0] store,        // The pixel that leaves the chain.
    output wire       busy,         // A round is under way.
    output wire       ends,         // The round ends with this clock.
    // The clocks of the round so far, or of the last one, from the first pixel that entered the chain.
    output reg  [8:0] clocks
);

    localparam [2:0] ROUND_IDLE     = 3'd0;
    localparam [2:0] ROUND_PRIME    = 3'd1;
    localparam [2:0] ROUND_LINE     = 3'd2;
    localparam [2:0] ROUND_OVERHEAD = 3'd3;
    localparam [2:0] ROUND_DRAIN    = 3'd4;

    reg [2:0] round;                                             // rtl/src/gfb/sequencer.rs:78
    reg [3:0] x;                                                 // rtl/src/gfb/sequencer.rs:79
    reg [2:0] y;                                                 // rtl/src/gfb/sequencer.rs:80
    reg [4:0] clocks_left;                                       // rtl/src/gfb/sequencer.rs:82
    reg [3:0] until_stored;                                      // rtl/src/gfb/sequencer.rs:111

    wire part_ends = clocks_left == 5'd0;                        // rtl/src/gfb/sequencer.rs:83
    wire last_pixel = x == 4'd15;                                // rtl/src/gfb/sequencer.rs:84
    wire last_line = y == 3'd7;                                  // rtl/src/gfb/sequencer.rs:85
    wire begins = (round == ROUND_IDLE) & start;                 // rtl/src/gfb/sequencer.rs:93
    wire line_ends = (round == ROUND_LINE) & last_pixel;         // rtl/src/gfb/sequencer.rs:94
    wire overhead_ends = (round == ROUND_OVERHEAD) & part_ends;  // rtl/src/gfb/sequencer.rs:95
    wire scan_ends = (round == ROUND_OVERHEAD) & (part_ends & last_line); // rtl/src/gfb/sequencer.rs:96
    assign ends = (round == ROUND_DRAIN) & part_ends;            // rtl/src/gfb/sequencer.rs:97
    wire enable = (round == ROUND_PRIME) | (round == ROUND_LINE) | (round == ROUND_DRAIN); // rtl/src/gfb/sequencer.rs:107
    assign stores = enable & (until_stored == 4'd0);             // rtl/src/gfb/sequencer.rs:112
    wire counts = (round == ROUND_LINE) | (round == ROUND_OVERHEAD) | (round == ROUND_DRAIN); // rtl/src/gfb/sequencer.rs:118
    assign busy = round != ROUND_IDLE;                           // rtl/src/gfb/sequencer.rs:122

    always @(posedge clk) begin
        if (rst) begin
            round <= ROUND_IDLE;
            x <= 4'd0;
            y <= 3'd0;
            clocks_left <= 5'd0;
            feed <= 7'd0;
            until_stored <= 4'd0;
            store <= 7'd0;
            clocks <= 9'd0;
        end else begin
            case (round)
                ROUND_IDLE: if (start) round <= ROUND_PRIME;
                ROUND_PRIME: if (part_ends) round <= ROUND_LINE;
                ROUND_LINE: if (last_pixel) round <= ROUND_OVERHEAD;
                ROUND_OVERHEAD: begin
                    if (!part_ends) round <= ROUND_OVERHEAD;
                    else if (last_line) round <= ROUND_DRAIN;
                    else round <= ROUND_LINE;
                end
                default: begin // ROUND_DRAIN
                    if (part_ends) round <= ROUND_IDLE;
                    else round <= ROUND_DRAIN;
                end
            endcase
            if (line_ends) x <= 4'd0;
            else if (round == ROUND_LINE) x <= x + 4'd1;
            if (scan_ends) y <= 3'd0;
            else if (overhead_ends) y <= y + 3'd1;
            if (begins) clocks_left <= 5'd1;
            else if (line_ends) clocks_left <= 5'd19;
            else if (scan_ends) clocks_left <= 5'd7;
            else if (!part_ends) clocks_left <= clocks_left - 5'd1;
            if (begins) feed <= 7'd0;
            else if (enable) feed <= feed + 7'd1;
            if (begins) until_stored <= 4'd10;
            else if (stores) until_stored <= 4'd0;
            else if (enable) until_stored <= until_stored - 4'd1;
            if (begins) store <= 7'd0;
            else if (stores) store <= store + 7'd1;
            if (begins) clocks <= 9'd0;
            else if (counts) clocks <= clocks + 9'd1;
        end
    end

    assign scan_restart = begins;
    assign scan_enable = enable;
endmodule
`default_nettype wire
