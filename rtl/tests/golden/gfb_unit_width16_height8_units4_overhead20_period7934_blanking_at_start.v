// gfb_unit_width16_height8_units4_overhead20_period7934_blanking_at_start
//
// A double-buffered frame buffer with depth: leads the scan, feeds the chain of merging
// units and keeps what comes out of it.
//
// Parameters  GfbUnit { screen: Screen { width: 16, height: 8 }, units: 4, overhead: 20, display: Display { period: Period(7934), blanking: AtStart } }
// Latency     rounds with a period of 288 clocks
// Source      VC-1, section 3.3, global frame buffer (VC1-GFB, VC1-TM, VC1-FREE, VC1-CLR3)
// Described   rtl/src/gfb/unit.rs:33
`default_nettype none

module gfb_unit_width16_height8_units4_overhead20_period7934_blanking_at_start (
    input  wire        merge_clk,
    input  wire        merge_rst,
    input  wire        crt_clk,
    input  wire        crt_rst,
    input  wire        swap,                              // For one clock: exchange the banks.
    // What the host says.
    input  wire [6:0]  host_read_address,                 // A pixel of the bank on display, in raster order.
    // The word of a blank pixel: the greatest depth above the background's colour.
    input  wire [47:0] host_background,
    input  wire [47:0] merged,                            // From the right end of the chain.
    // What the host sees.
    output wire [47:0] view_read_word,                    // The pixel at the address of the last clock.
    // Blank pixels enter the chain: the round is the first since the banks were swapped.
    output wire        view_first_round,
    // To every unit of the chain.
    output wire        scan_restart,                      // For one clock: every scan counter takes its preset.
    // The counters, the read-out and the merging units advance by a pixel; where it is low they hold.
    output wire        scan_enable,
    output reg  [47:0] left,                              // To the left end of the chain.
    // The banks may change: the display is in its vertical blanking.
    (* ASYNC_REG = "TRUE" *) output reg         blanking,
    // To the display.
    output wire        pixel_valid,                       // There is a pixel.
    output wire [23:0] pixel_rgb                          // Its colour.
);

    reg filled_bank;                                             // rtl/src/gfb/unit.rs:103
    reg old_is_blank;                                            // rtl/src/gfb/unit.rs:109
    reg [3:0] place;                                             // rtl/src/gfb/unit.rs:115
    (* ASYNC_REG = "TRUE" *) reg shown_bank_meta;                // rtl/src/gfb/unit.rs:129
    (* ASYNC_REG = "TRUE" *) reg shown_bank;                     // rtl/src/gfb/unit.rs:129
    (* ASYNC_REG = "TRUE" *) reg blanking_meta;                  // rtl/src/gfb/unit.rs:134

    (* no_rw_check *)
    reg [47:0] banks [0:255];                                    // rtl/src/gfb/unit.rs:104
    reg [47:0] read_word;                                        // rtl/src/gfb/unit.rs:106
    reg [47:0] old;                                              // rtl/src/gfb/unit.rs:108
    reg [47:0] banks_read2;                                      // rtl/src/gfb/unit.rs:132
    (* no_rw_check *)
    reg [47:0] entered [0:15];                                   // rtl/src/gfb/unit.rs:114

    wire [6:0] u_sequencer_feed;                                 // rtl/src/gfb/unit.rs:98
    wire u_sequencer_stores;                                     // rtl/src/gfb/unit.rs:98
    wire u_sequencer_stale;                                      // rtl/src/gfb/unit.rs:98
    wire [6:0] u_sequencer_store;                                // rtl/src/gfb/unit.rs:98
    wire [6:0] u_crt_address;                                    // rtl/src/gfb/unit.rs:131
    wire u_crt_dark;                                             // rtl/src/gfb/unit.rs:131
    wire u_crt_window;                                           // rtl/src/gfb/unit.rs:131

    wire [47:0] entered_word = entered[place];                   // rtl/src/gfb/unit.rs:122
    wire [47:0] word = banks_read2;                              // rtl/src/gfb/unit.rs:130

    gfb_sequencer_width16_height8_units4_overhead20 u_sequencer ( // rtl/src/gfb/unit.rs:98
        .clk          (merge_clk),
        .rst          (merge_rst),
        .restart      (swap),
        .scan_restart (scan_restart),
        .scan_enable  (scan_enable),
        .feed         (u_sequencer_feed),
        .blank        (view_first_round),
        .stores       (u_sequencer_stores),
        .stale        (u_sequencer_stale),
        .store        (u_sequencer_store)
    );

    crt_read_out_width16_height8_blanking_at_start u_crt (       // rtl/src/gfb/unit.rs:131
        .clk         (crt_clk),
        .rst         (crt_rst),
        .word        (word),
        .address     (u_crt_address),
        .pixel_valid (pixel_valid),
        .pixel_rgb   (pixel_rgb),
        .dark        (u_crt_dark),
        .window      (u_crt_window)
    );

    always @(posedge merge_clk) begin
        if (u_sequencer_stores) banks[{u_sequencer_store, filled_bank}] <= merged;
        read_word <= banks[{host_read_address, !filled_bank}];
        if (scan_enable) old <= banks[{u_sequencer_feed, filled_bank}];
    end

    always @(posedge crt_clk) begin
        banks_read2 <= banks[{u_crt_address, shown_bank}];
    end

    always @(posedge merge_clk) begin
        if (scan_enable) entered[place] <= left;
    end

    always @(posedge merge_clk) begin
        if (scan_enable) begin
            old_is_blank <= view_first_round;
            if (old_is_blank) left <= host_background;
            else left <= old;
        end
    end

    always @(posedge merge_clk) begin
        if (merge_rst) begin
            filled_bank <= 1'b0;
            place <= 4'd0;
            blanking_meta <= 1'b0;
            blanking <= 1'b0;
        end else begin
            if (swap) filled_bank <= !filled_bank;
            if (scan_enable & (place == 4'd15)) place <= 4'd0;
            else if (scan_enable) place <= place + 4'd1;
            blanking_meta <= u_crt_window;
            blanking <= blanking_meta;
        end
    end

    always @(posedge crt_clk) begin
        if (crt_rst) begin
            shown_bank_meta <= 1'b1;
            shown_bank <= 1'b1;
        end else begin
            shown_bank_meta <= !filled_bank;
            shown_bank <= shown_bank_meta;
        end
    end

    assign view_read_word = read_word;

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
    reg is_full;                                                 // rtl/src/gfb/unit.rs:116
    reg was_full;                                                // rtl/src/gfb/unit.rs:119
    reg shown_bank_past;                                         // rtl/src/gfb/unit.rs:133
    reg has_past;                                                // rtl/src/gfb/unit.rs:133

    initial has_past = 1'b0;

    always @(posedge crt_clk) begin
        shown_bank_past <= shown_bank;
    end

    always @(posedge merge_clk) begin
        if (merge_rst) begin
            is_full <= 1'b0;
            was_full <= 1'b0;
        end else begin
            if (scan_enable & (place == 4'd15)) is_full <= 1'b1;
            if (swap) was_full <= is_full;
        end
    end

    always @(posedge crt_clk) begin
        if (crt_rst) has_past <= 1'b0;
        else has_past <= 1'b1;
    end

`ifdef FORMAL
    always @(posedge merge_clk) begin
        if (!merge_rst) assert (!(u_sequencer_stale & was_full) | (merged == entered_word)); // rtl/src/gfb/unit.rs:123
    end
    always @(posedge crt_clk) begin
        if (!crt_rst) assert (!has_past | ((shown_bank == shown_bank_past) | u_crt_dark)); // rtl/src/gfb/unit.rs:133
    end
`else
    always @(posedge merge_clk) begin
        if (!merge_rst && !(!(u_sequencer_stale & was_full) | (merged == entered_word))) begin // rtl/src/gfb/unit.rs:123
            $display("FAIL: time %0t: %m: a pixel that entered the chain before a swap is the word that its bank has", $time);
            stop;
        end
    end
    always @(posedge crt_clk) begin
        if (!crt_rst && !(!has_past | ((shown_bank == shown_bank_past) | u_crt_dark))) begin // rtl/src/gfb/unit.rs:133
            $display("FAIL: time %0t: %m: no refresh shows two frames", $time);
            stop;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, u_sequencer_stale, entered_word, u_crt_dark};
endmodule
`default_nettype wire
