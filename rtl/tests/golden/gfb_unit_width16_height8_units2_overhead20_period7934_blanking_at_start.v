// gfb_unit_width16_height8_units2_overhead20_period7934_blanking_at_start
//
// A double-buffered frame buffer with depth: paces the scan, feeds the chain of merging
// units and stores its output.
//
// Parameters  GfbUnit { screen: Screen { width: 16, height: 8 }, units: 2, overhead: 20, accumulation: false, display: Display { period: Period(7934), blanking: AtStart } }
// Latency     rounds with a period of 288 clocks
// Source      VC-1, section 3.3, global frame buffer (VC1-GFB, VC1-TM, VC1-FREE, VC1-CLR3)
// Described   rtl/src/gfb/unit.rs:92
`default_nettype none

module gfb_unit_width16_height8_units2_overhead20_period7934_blanking_at_start (
    input  wire        merge_clk,
    input  wire        merge_rst,
    input  wire        crt_clk,
    input  wire        crt_rst,
    input  wire        swap,                  // High for one clock to swap the banks.
    // The inputs from the host.
    // Reads and writes of the bank on display, one in every clock.
    input  wire        host_accesses_valid,
    input  wire [6:0]  host_accesses_address, // The number of the pixel that the host accesses, in raster order.
    input  wire        host_accesses_writes,  // High if the host writes the pixel, low if it reads the pixel.
    input  wire [47:0] host_accesses_word,    // The word that the host writes: depth above colour.
    // The word of a blank pixel: the greatest depth above the background's colour.
    input  wire [47:0] host_background,
    input  wire [47:0] merged,                // The pixel from the right end of the chain.
    // The outputs to the host.
    output wire        view_read_valid,       // The access of the previous clock was a read.
    output wire [47:0] view_read_word,        // The word of the pixel that was read last.
    // Blank pixels enter the chain: the round is the first since the banks were swapped.
    output wire        view_first_round,
    // The control of the scan, for every unit of the chain.
    output wire        scan_restart,          // High for one clock: every scan counter loads its preset.
    // The counters, the read-out and the merging units advance by a pixel; while `enable` is low, they keep their
    // values.
    output wire        scan_enable,
    output reg  [47:0] left,                  // The pixel to the left end of the chain.
    output wire        blanking,              // The banks may change: the display is in its vertical blanking.
    // The pixel to the display.
    output wire        pixel_valid,           // The display gets a pixel in this clock.
    output wire [23:0] pixel_rgb,             // The colour of the pixel.
    output wire        host_accesses_ready
);

    reg filled_bank;                                             // rtl/src/gfb/unit.rs:169
    reg read_bank;                                               // rtl/src/gfb/unit.rs:192
    reg read_valid;                                              // rtl/src/gfb/unit.rs:193
    reg [47:0] arrived;                                          // rtl/src/gfb/unit.rs:202
    reg fed_bank;                                                // rtl/src/gfb/unit.rs:213
    reg old_is_blank;                                            // rtl/src/gfb/unit.rs:214
    reg [2:0] place;                                             // rtl/src/gfb/unit.rs:246
    (* ASYNC_REG = "TRUE" *) reg shown_bank_meta;                // rtl/src/gfb/unit.rs:220
    (* ASYNC_REG = "TRUE" *) reg shown_bank;                     // rtl/src/gfb/unit.rs:220
    (* ASYNC_REG = "TRUE" *) reg window_meta;                    // rtl/src/gfb/unit.rs:226
    (* ASYNC_REG = "TRUE" *) reg window;                         // rtl/src/gfb/unit.rs:226

    (* no_rw_check *)
    reg [47:0] entered [0:7];                                    // rtl/src/gfb/unit.rs:245

    wire [6:0] u_sequencer_feed;                                 // rtl/src/gfb/unit.rs:163
    wire u_sequencer_stores;                                     // rtl/src/gfb/unit.rs:163
    wire u_sequencer_stale;                                      // rtl/src/gfb/unit.rs:163
    wire [6:0] u_sequencer_store;                                // rtl/src/gfb/unit.rs:163
    wire [6:0] u_crt_address;                                    // rtl/src/gfb/unit.rs:222
    wire u_crt_dark;                                             // rtl/src/gfb/unit.rs:222
    wire u_crt_window;                                           // rtl/src/gfb/unit.rs:222

    wire [47:0] old_at_read_bank;                                // rtl/src/gfb/unit.rs:201
    wire [47:0] old_at_fed_bank;                                 // rtl/src/gfb/unit.rs:215
    wire [47:0] word;                                            // rtl/src/gfb/unit.rs:221
    assign host_accesses_ready = 1'b1;                           // rtl/src/gfb/unit.rs:162
    wire writes = host_accesses_valid & host_accesses_writes;    // rtl/src/gfb/unit.rs:172
    wire reads = host_accesses_valid & !host_accesses_writes;    // rtl/src/gfb/unit.rs:173
    assign view_read_word = read_valid ? old_at_read_bank : arrived; // rtl/src/gfb/unit.rs:203
    wire is_last = scan_enable & (place == 3'd7);                // rtl/src/gfb/unit.rs:248
    wire [47:0] entered_word = entered[place];                   // rtl/src/gfb/unit.rs:254

    genvar i;

    generate
        for (i = 0; i < 2; i = i + 1) begin : row
            (* no_rw_check *)
            reg [47:0] banks [0:127];                                    // rtl/src/gfb/unit.rs:171
            reg [47:0] old;                                              // rtl/src/gfb/unit.rs:189
            reg [47:0] banks_read1;                                      // rtl/src/gfb/unit.rs:225
            localparam [31:0] is_filled_listed = i;
            wire is_filled = is_filled_listed[0] == filled_bank;
            wire [6:0] banks_write_address = is_filled ? u_sequencer_store : host_accesses_address;
            wire [6:0] banks_read_address = is_filled ? u_sequencer_feed : host_accesses_address;

            always @(posedge merge_clk) begin
                if (is_filled ? u_sequencer_stores : writes) begin
                    banks[banks_write_address] <= is_filled ? merged : host_accesses_word;
                end
                if (is_filled ? scan_enable : reads) old <= banks[banks_read_address];
            end

            always @(posedge crt_clk) begin
                banks_read1 <= banks[u_crt_address];
            end
        end
    endgenerate

    gfb_sequencer_width16_height8_units2_overhead20 u_sequencer ( // rtl/src/gfb/unit.rs:163
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

    crt_read_out_width16_height8_blanking_at_start u_crt (       // rtl/src/gfb/unit.rs:222
        .clk         (crt_clk),
        .rst         (crt_rst),
        .word        (word),
        .address     (u_crt_address),
        .pixel_valid (pixel_valid),
        .pixel_rgb   (pixel_rgb),
        .dark        (u_crt_dark),
        .window      (u_crt_window)
    );

    wire [47:0] old_at_read_bank_lanes [0:1];
    generate
        for (i = 0; i < 2; i = i + 1) begin : old_at_read_bank_of
            assign old_at_read_bank_lanes[i] = row[i].old;
        end
    endgenerate
    assign old_at_read_bank = old_at_read_bank_lanes[read_bank]; // rtl/src/gfb/unit.rs:201
    wire [47:0] old_at_fed_bank_lanes [0:1];
    generate
        for (i = 0; i < 2; i = i + 1) begin : old_at_fed_bank_of
            assign old_at_fed_bank_lanes[i] = row[i].old;
        end
    endgenerate
    assign old_at_fed_bank = old_at_fed_bank_lanes[fed_bank];    // rtl/src/gfb/unit.rs:215
    wire [47:0] word_lanes [0:1];
    generate
        for (i = 0; i < 2; i = i + 1) begin : word_of
            assign word_lanes[i] = row[i].banks_read1;
        end
    endgenerate
    assign word = word_lanes[shown_bank];                        // rtl/src/gfb/unit.rs:221

    always @(posedge merge_clk) begin
        if (scan_enable) entered[place] <= left;
    end

    always @(posedge merge_clk) begin
        if (reads) read_bank <= !filled_bank;
    end

    always @(posedge merge_clk) begin
        if (read_valid) arrived <= old_at_read_bank;
    end

    always @(posedge merge_clk) begin
        if (scan_enable) begin
            fed_bank <= filled_bank;
            old_is_blank <= view_first_round;
            if (old_is_blank) left <= host_background;
            else left <= old_at_fed_bank;
        end
    end

    always @(posedge merge_clk) begin
        if (merge_rst) begin
            filled_bank <= 1'b0;
            read_valid <= 1'b0;
            place <= 3'd0;
            window_meta <= 1'b0;
            window <= 1'b0;
        end else begin
            if (swap) filled_bank <= !filled_bank;
            read_valid <= reads;
            if (is_last) place <= 3'd0;
            else if (scan_enable) place <= place + 3'd1;
            window_meta <= u_crt_window;
            window <= window_meta;
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

    assign view_read_valid = read_valid;
    assign blanking = window;

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
    reg writes_past;                                             // rtl/src/gfb/unit.rs:206
    reg swap_past;                                               // rtl/src/gfb/unit.rs:209
    reg is_full;                                                 // rtl/src/gfb/unit.rs:247
    reg was_full;                                                // rtl/src/gfb/unit.rs:251
    reg shown_bank_past;                                         // rtl/src/gfb/unit.rs:223
    reg has_past;                                                // rtl/src/gfb/unit.rs:206
    reg has_past_2;                                              // rtl/src/gfb/unit.rs:223

    initial has_past = 1'b0;
    initial has_past_2 = 1'b0;

    always @(posedge merge_clk) begin
        writes_past <= writes;
        swap_past <= swap;
    end

    always @(posedge crt_clk) begin
        shown_bank_past <= shown_bank;
    end

    always @(posedge merge_clk) begin
        if (merge_rst) begin
            is_full <= 1'b0;
            was_full <= 1'b0;
            has_past <= 1'b0;
        end else begin
            if (is_last) is_full <= 1'b1;
            if (swap) was_full <= is_full;
            has_past <= 1'b1;
        end
    end

    always @(posedge crt_clk) begin
        if (crt_rst) has_past_2 <= 1'b0;
        else has_past_2 <= 1'b1;
    end

`ifdef FORMAL
    always @(posedge merge_clk) begin
        if (!merge_rst) cover (has_past & (reads & writes_past));    // rtl/src/gfb/unit.rs:206
        if (!merge_rst) cover (writes & swap);                       // rtl/src/gfb/unit.rs:207
        if (!merge_rst) assert (!has_past | (!swap_past | view_first_round)); // rtl/src/gfb/unit.rs:208
        if (!merge_rst) assert (!(u_sequencer_stale & was_full) | (merged == entered_word)); // rtl/src/gfb/unit.rs:255
    end
    always @(posedge crt_clk) begin
        if (!crt_rst) assert (!has_past_2 | ((shown_bank == shown_bank_past) | u_crt_dark)); // rtl/src/gfb/unit.rs:223
        if (!crt_rst) cover (has_past_2 & (shown_bank != shown_bank_past)); // rtl/src/gfb/unit.rs:224
    end
`else
    reg is_covered;
    initial is_covered = 1'b0;
    reg is_covered_2;
    initial is_covered_2 = 1'b0;
    reg is_covered_3;
    initial is_covered_3 = 1'b0;
    always @(posedge merge_clk) begin
        if (!merge_rst && (has_past & (reads & writes_past)) && !is_covered) begin // rtl/src/gfb/unit.rs:206
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: the host reads in the clock after a write", $time);
            `endif
            is_covered <= 1'b1;
        end
        if (!merge_rst && (writes & swap) && !is_covered_2) begin    // rtl/src/gfb/unit.rs:207
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: the host writes in the clock of a swap", $time);
            `endif
            is_covered_2 <= 1'b1;
        end
        if (!merge_rst && !(!has_past | (!swap_past | view_first_round))) begin // rtl/src/gfb/unit.rs:208
            $display("FAIL: time %0t: %m: blank pixels enter the chain in the first round after a swap", $time);
            stop;
        end
        if (!merge_rst && !(!(u_sequencer_stale & was_full) | (merged == entered_word))) begin // rtl/src/gfb/unit.rs:255
            $display("FAIL: time %0t: %m: a pixel that entered the chain before a swap equals the word in its bank", $time);
            stop;
        end
    end
    always @(posedge crt_clk) begin
        if (!crt_rst && !(!has_past_2 | ((shown_bank == shown_bank_past) | u_crt_dark))) begin // rtl/src/gfb/unit.rs:223
            $display("FAIL: time %0t: %m: no refresh shows two frames", $time);
            stop;
        end
        if (!crt_rst && (has_past_2 & (shown_bank != shown_bank_past)) && !is_covered_3) begin // rtl/src/gfb/unit.rs:224
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: the display changes to the other bank", $time);
            `endif
            is_covered_3 <= 1'b1;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, u_sequencer_stale, entered_word, u_crt_dark};
endmodule
`default_nettype wire
