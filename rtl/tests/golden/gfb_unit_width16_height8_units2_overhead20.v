// gfb_unit_width16_height8_units2_overhead20
//
// A double-buffered frame buffer with depth: leads the scan, feeds the chain of merging
// units and keeps what comes out of it.
//
// Parameters  GfbUnit { screen: Screen { width: 16, height: 8 }, units: 2, overhead: 20 }
// Latency     a round of 296 clocks
// Source      VC-1, section 3.3, global frame buffer (VC1-GFB, VC1-TM, VC1-CLR3)
// Described   rtl/src/gfb/unit.rs:26
`default_nettype none

module gfb_unit_width16_height8_units2_overhead20 (
    input  wire        clk,
    input  wire        rst,
    // What the host says.
    input  wire        host_start,        // For one clock, when not busy: merge the local frame buffers.
    input  wire        host_swap,         // For one clock, when not busy: exchange the banks.
    input  wire [6:0]  host_read_address, // A pixel of the bank on display, in raster order.
    // The word of a blank pixel: the greatest depth above the background's colour.
    input  wire [47:0] host_background,
    input  wire [47:0] merged,            // From the right end of the chain.
    // What the host sees.
    output wire [47:0] view_read_word,    // The pixel at the address of the last clock.
    output wire        view_busy,         // A round is under way.
    output wire        view_first_round,  // The next or present round is the first since the banks were swapped.
    // The clocks of the round so far, or of the last one, from the first pixel that entered the chain.
    output wire [8:0]  view_clocks,
    // To every unit of the chain.
    output wire        scan_restart,      // For one clock: every scan counter takes its preset.
    // The counters, the read-out and the merging units advance by a pixel; where it is low they hold.
    output wire        scan_enable,
    output reg  [47:0] left               // To the left end of the chain.
);

    reg filled_bank;                                             // rtl/src/gfb/unit.rs:85
    reg first_round;                                             // rtl/src/gfb/unit.rs:90

    (* no_rw_check *)
    reg [47:0] banks [0:255];                                    // rtl/src/gfb/unit.rs:86
    reg [47:0] read_word;                                        // rtl/src/gfb/unit.rs:88
    reg [47:0] old;                                              // rtl/src/gfb/unit.rs:91

    wire [6:0] u_sequencer_feed;                                 // rtl/src/gfb/unit.rs:80
    wire u_sequencer_stores;                                     // rtl/src/gfb/unit.rs:80
    wire [6:0] u_sequencer_store;                                // rtl/src/gfb/unit.rs:80
    wire u_sequencer_ends;                                       // rtl/src/gfb/unit.rs:80

    gfb_sequencer_width16_height8_units2_overhead20 u_sequencer ( // rtl/src/gfb/unit.rs:80
        .clk          (clk),
        .rst          (rst),
        .start        (host_start),
        .scan_restart (scan_restart),
        .scan_enable  (scan_enable),
        .feed         (u_sequencer_feed),
        .stores       (u_sequencer_stores),
        .store        (u_sequencer_store),
        .busy         (view_busy),
        .ends         (u_sequencer_ends),
        .clocks       (view_clocks)
    );

    always @(posedge clk) begin
        if (u_sequencer_stores) banks[{u_sequencer_store, filled_bank}] <= merged;
        read_word <= banks[{host_read_address, !filled_bank}];
        if (scan_enable) old <= banks[{u_sequencer_feed, filled_bank}];
    end

    always @(posedge clk) begin
        if (scan_enable) begin
            if (first_round) left <= host_background;
            else left <= old;
        end
    end

    always @(posedge clk) begin
        if (rst) begin
            filled_bank <= 1'b0;
            first_round <= 1'b1;
        end else begin
            if (host_swap) filled_bank <= !filled_bank;
            if (host_swap) first_round <= 1'b1;
            else if (u_sequencer_ends) first_round <= 1'b0;
        end
    end

    assign view_read_word = read_word;
    assign view_first_round = first_round;

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
        if (!rst) assume (!(host_swap | host_start) | !view_busy);   // rtl/src/gfb/unit.rs:81
    end
`else
    always @(posedge clk) begin
        if (!rst && !(!(host_swap | host_start) | !view_busy)) begin // rtl/src/gfb/unit.rs:81
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: the banks are swapped and a round is started between rounds", $time);
            stop;
        end
    end
`endif
`endif
endmodule
`default_nettype wire
