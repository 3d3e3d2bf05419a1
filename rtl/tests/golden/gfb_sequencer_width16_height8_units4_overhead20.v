// gfb_sequencer_width16_height8_units4_overhead20
//
// Scans the screen continuously, and paces a chain of merging units.
//
// Parameters  GfbSequencer { screen: Screen { width: 16, height: 8 }, units: 4, overhead: 20 }
// Latency     rounds with a period of 288 clocks
// Source      VC-1, section 3.3, T_m and the free-running scan (VC1-TM, VC1-FREE, VC1-CLR3)
// Described   rtl/src/gfb/sequencer.rs:33
`default_nettype none

module gfb_sequencer_width16_height8_units4_overhead20 (
    input  wire       clk,
    input  wire       rst,
    input  wire       restart,      // High for one clock to restart the scan at the first pixel.
    // The control of the scan, for every unit of the chain.
    output wire       scan_restart, // High for one clock: every scan counter loads its preset.
    // The counters, the read-out and the merging units advance by a pixel; while `enable` is low, they keep their
    // values.
    output wire       scan_enable,
    // The number of the pixel to read. The pixel enters the chain `SCAN_LATENCY` clocks with `enable` later.
    output reg  [6:0] feed,
    output reg        blank,        // A blank pixel enters the chain in place of the pixel that is read.
    output wire       stores,       // A pixel that entered the chain after the last restart leaves it.
    output wire       stale,        // A pixel that entered the chain before the last restart leaves it.
    output reg  [6:0] store         // The number of the pixel that is stored, in raster order.
);

    localparam [1:0] SCAN_RESTART_2 = 2'd0;
    localparam [1:0] SCAN_PRIME     = 2'd1;
    localparam [1:0] SCAN_LINE      = 2'd2;
    localparam [1:0] SCAN_OVERHEAD  = 2'd3;

    reg [1:0] part;                                              // rtl/src/gfb/sequencer.rs:95
    reg [3:0] x;                                                 // rtl/src/gfb/sequencer.rs:97
    reg [2:0] y;                                                 // rtl/src/gfb/sequencer.rs:98
    reg [4:0] clocks_left;                                       // rtl/src/gfb/sequencer.rs:99
    reg [4:0] way_left;                                          // rtl/src/gfb/sequencer.rs:124

    wire restarts = restart | (part == SCAN_RESTART_2);          // rtl/src/gfb/sequencer.rs:96
    wire part_ends = clocks_left == 5'd0;                        // rtl/src/gfb/sequencer.rs:100
    wire line_ends = (part == SCAN_LINE) & (x == 4'd15);         // rtl/src/gfb/sequencer.rs:101
    wire enable = (part == SCAN_PRIME) | (part == SCAN_LINE);    // rtl/src/gfb/sequencer.rs:116
    wire round_ends = enable & (feed == 7'd127);                 // rtl/src/gfb/sequencer.rs:118
    wire is_stale = way_left != 5'd0;                            // rtl/src/gfb/sequencer.rs:125
    assign stores = enable & !is_stale;                          // rtl/src/gfb/sequencer.rs:127
    assign stale = enable & is_stale;                            // rtl/src/gfb/sequencer.rs:136

    always @(posedge clk) begin
        if (restarts | line_ends) x <= 4'd0;
        else if (part == SCAN_LINE) x <= x + 4'd1;
        if (restarts | (line_ends & (y == 3'd7))) y <= 3'd0;
        else if (line_ends) y <= y + 3'd1;
        if (restarts) clocks_left <= 5'd1;
        else if (line_ends) clocks_left <= 5'd19;
        else if (!part_ends) clocks_left <= clocks_left - 5'd1;
        if (restarts) way_left <= 5'd18;
        else if (enable & is_stale) way_left <= way_left - 5'd1;
    end

    always @(posedge clk) begin
        if (rst) begin
            part <= SCAN_RESTART_2;
            feed <= 7'd0;
            blank <= 1'b1;
            store <= 7'd0;
        end else begin
            case (part)
                SCAN_RESTART_2: part <= SCAN_PRIME;
                SCAN_PRIME: begin
                    if (restart) part <= SCAN_PRIME;
                    else if (part_ends) part <= SCAN_LINE;
                end
                SCAN_LINE: begin
                    if (restart) part <= SCAN_PRIME;
                    else if (line_ends) part <= SCAN_OVERHEAD;
                end
                default: begin // SCAN_OVERHEAD
                    if (restart) part <= SCAN_PRIME;
                    else if (part_ends) part <= SCAN_LINE;
                    else part <= SCAN_OVERHEAD;
                end
            endcase
            if (restarts | round_ends) feed <= 7'd0;
            else if (enable) feed <= feed + 7'd1;
            if (restarts) blank <= 1'b1;
            else if (round_ends) blank <= 1'b0;
            if (restarts | (stores & (store == 7'd127))) store <= 7'd0;
            else if (stores) store <= store + 7'd1;
        end
    end

    assign scan_restart = restarts;
    assign scan_enable = enable;

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
    reg [7:0] fed;                                               // rtl/src/gfb/sequencer.rs:131

    always @(posedge clk) begin
        if (rst) fed <= 8'd0;
        else if (restarts) fed <= 8'd0;
        else if (enable & (fed <= 8'd127)) fed <= fed + 8'd1;
    end

`ifdef FORMAL
    always @(posedge clk) begin
        if (!rst) assert (blank == (fed <= 8'd127));                 // rtl/src/gfb/sequencer.rs:133
        if (!rst) cover (round_ends & blank);                        // rtl/src/gfb/sequencer.rs:134
        if (!rst) cover (round_ends & !blank);                       // rtl/src/gfb/sequencer.rs:135
    end
`else
    reg is_covered;
    initial is_covered = 1'b0;
    reg is_covered_2;
    initial is_covered_2 = 1'b0;
    always @(posedge clk) begin
        if (!rst && !(blank == (fed <= 8'd127))) begin               // rtl/src/gfb/sequencer.rs:133
            $display("FAIL: time %0t: %m: blank pixels enter in the first round after a restart, and in no other", $time);
            stop;
        end
        if (!rst && (round_ends & blank) && !is_covered) begin       // rtl/src/gfb/sequencer.rs:134
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: a first round ends", $time);
            `endif
            is_covered <= 1'b1;
        end
        if (!rst && (round_ends & !blank) && !is_covered_2) begin    // rtl/src/gfb/sequencer.rs:135
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: a later round ends", $time);
            `endif
            is_covered_2 <= 1'b1;
        end
    end
`endif
`endif
endmodule
`default_nettype wire
