// vc1_width16_height8_edge4_pages4_processors2_queue4_word_clocks6_beb30a35
//
// The frame buffer subsystem of a VC-1: virtual local frame buffers, pipelined image merger,
// global frame buffer, swap control.
//
// Parameters  Vc1 { lfb: LfbUnit { patches: Patches { screen: Screen { width: 16, height: 8 }, edge: 4 }, pages: 4 }, processors: 2, queue: 4, word_clocks: 6, accumulation: false, display: Display { period: Period(7934), blanking: AtStart } }
// Latency     a frame is merged in 296 clocks of the merger
// Source      VC-1, section 3.3 (VC1-LFB, VC1-PIM, VC1-GFB, VC1-SW1 to SW4)
// Described   rtl/src/vc1/mod.rs:80
`default_nettype none

module vc1_width16_height8_edge4_pages4_processors2_queue4_word_clocks6_beb30a35 (
    input  wire        merge_clk,
    input  wire        merge_rst,
    input  wire        crt_clk,
    input  wire        crt_rst,
    input  wire        pe_clk,
    input  wire        pe_rst,
    // Of each processor.
    // A pixel to draw.
    input  wire        processors_0_request_valid,
    input  wire [3:0]  processors_0_request_x,      // Counted from the left.
    input  wire [2:0]  processors_0_request_y,      // Counted from the top.
    input  wire [47:0] processors_0_request_word,   // Depth above colour.
    // A patch table entry to clear.
    input  wire        processors_0_clear_valid,
    input  wire [2:0]  processors_0_clear_patch,    // Its number.
    // A word for the bus.
    input  wire        processors_0_sends_valid,
    input  wire [31:0] processors_0_sends_word,     // What it says.
    input  wire        processors_0_sends_last,     // The packet ends with it.
    input  wire        processors_0_done,           // Its frame is drawn.
    input  wire        processors_1_request_valid,
    input  wire [3:0]  processors_1_request_x,
    input  wire [2:0]  processors_1_request_y,
    input  wire [47:0] processors_1_request_word,
    input  wire        processors_1_clear_valid,
    input  wire [2:0]  processors_1_clear_patch,
    input  wire        processors_1_sends_valid,
    input  wire [31:0] processors_1_sends_word,
    input  wire        processors_1_sends_last,
    input  wire        processors_1_done,
    // A word of the host for the bus.
    input  wire        command_valid,
    input  wire [31:0] command_word,                // What it says.
    input  wire        command_last,                // The packet ends with it.
    input  wire        ready,                       // The host lets the sync line go.
    // Of the host.
    // Reads and writes of the bank on display, one in every clock.
    input  wire        host_accesses_valid,
    input  wire [6:0]  host_accesses_address,       // A pixel, in raster order.
    input  wire        host_accesses_writes,        // Whether it is written; else it is read.
    input  wire [47:0] host_accesses_word,          // What is written there: depth above colour.
    // The word of a blank pixel: the greatest depth above the background's colour.
    input  wire [47:0] host_background,
    input  wire        processors_0_received_ready,
    input  wire        processors_1_received_ready,
    // To each processor.
    output wire [1:0]  processors_0_state,          // What it may do: a code of `SwapState`.
    output wire [2:0]  processors_0_pages_used,     // How many pages are taken.
    output wire        processors_0_idle,           // Nothing is under way.
    // The word at the front of its queue.
    output wire        processors_0_received_valid,
    output wire [31:0] processors_0_received_word,  // What it says.
    output wire        processors_0_received_last,  // The packet ends with it.
    output wire [1:0]  processors_1_state,
    output wire [2:0]  processors_1_pages_used,
    output wire        processors_1_idle,
    output wire        processors_1_received_valid,
    output wire [31:0] processors_1_received_word,
    output wire        processors_1_received_last,
    output wire        line,                        // The sync line: all processors have drawn the frame.
    // To the host.
    output wire        view_read_valid,             // The access of the last clock was a read.
    output wire [47:0] view_read_word,              // The pixel that the last read asked for.
    // Blank pixels enter the chain: the round is the first since the banks were swapped.
    output wire        view_first_round,
    // A frame is stored in the global frame buffer, and waits for the blanking.
    output wire        is_merged,
    output wire        shown,                       // Turns with each swap of the global frame buffer.
    // To the display.
    output wire        pixel_valid,                 // There is a pixel.
    output wire [23:0] pixel_rgb,                   // Its colour.
    output wire        processors_0_request_ready,
    output wire        processors_0_clear_ready,
    output wire        processors_0_sends_ready,
    output wire        processors_1_request_ready,
    output wire        processors_1_clear_ready,
    output wire        processors_1_sends_ready,
    output wire        command_ready,
    output wire        host_accesses_ready
);

    wire u_gfb_scan_restart;                                     // rtl/src/vc1/mod.rs:178
    wire u_gfb_scan_enable;                                      // rtl/src/vc1/mod.rs:178
    wire [47:0] u_gfb_left;                                      // rtl/src/vc1/mod.rs:178
    wire u_gfb_blanking;                                         // rtl/src/vc1/mod.rs:178
    wire u_bus_idle;                                             // rtl/src/vc1/mod.rs:184
    wire [1:0] u_bus_empty;                                      // rtl/src/vc1/mod.rs:184
    wire gfb_swap;                                               // rtl/src/vc1/mod.rs:176
    wire [47:0] merged;                                          // rtl/src/vc1/mod.rs:175

    wire asserted_all;                                           // rtl/src/vc1/mod.rs:219
    wire u_lfb_idle_all;                                         // rtl/src/vc1/mod.rs:219

    genvar i;

    wire [1:0] swap_row_request_valid = {processors_1_request_valid, processors_0_request_valid};
    wire [7:0] swap_row_request_x = {processors_1_request_x, processors_0_request_x};
    wire [5:0] swap_row_request_y = {processors_1_request_y, processors_0_request_y};
    wire [95:0] swap_row_request_word = {processors_1_request_word, processors_0_request_word};
    wire [1:0] swap_row_clear_valid = {processors_1_clear_valid, processors_0_clear_valid};
    wire [5:0] swap_row_clear_patch = {processors_1_clear_patch, processors_0_clear_patch};
    wire [1:0] swap_row_done = {processors_1_done, processors_0_done};
    generate
        for (i = 0; i < 2; i = i + 1) begin : swap_row
            wire u_lfb_overflow;
            wire [2:0] u_lfb_pages_used;
            wire u_lfb_idle;
            wire u_lfb_draws;
            wire u_lfb_clears;
            wire [47:0] u_lfb_word;
            wire u_lfb_sending;
            wire u_lfb_request_ready;
            wire u_lfb_clear_ready;
            wire u_lfb_swap_ready;
            wire u_lfb_swap_swap;
            wire u_lfb_swap_resume;
            wire [1:0] u_lfb_swap_state;
            wire u_lfb_swap_frame;
            wire swap = u_lfb_swap_swap;
            wire resume = u_lfb_swap_resume;
            wire request_valid = swap_row_request_valid[i];
            wire [3:0] request_x = swap_row_request_x[i * 4 +: 4];
            wire [2:0] request_y = swap_row_request_y[i * 3 +: 3];
            wire [47:0] request_word = swap_row_request_word[i * 48 +: 48];
            wire clear_valid = swap_row_clear_valid[i];
            wire [2:0] clear_patch = swap_row_clear_patch[i * 3 +: 3];
            wire done = swap_row_done[i];
            localparam [31:0] preset_x = 12 * i;
            localparam [31:0] preset_y = 7 * i;
            wire finished = u_lfb_idle & u_bus_empty[i];

            lfb_unit_width16_height8_edge4_pages4 u_lfb (
                .pe_clk        (pe_clk),
                .pe_rst        (pe_rst),
                .merge_clk     (merge_clk),
                .merge_rst     (merge_rst),
                .request_valid (request_valid),
                .request_x     (request_x),
                .request_y     (request_y),
                .request_word  (request_word),
                .clear_valid   (clear_valid),
                .clear_patch   (clear_patch),
                .swap          (swap),
                .resume        (resume),
                .scan_restart  (u_gfb_scan_restart),
                .scan_enable   (u_gfb_scan_enable),
                .preset_x      (preset_x[3:0]),
                .preset_y      (preset_y[2:0]),
                .overflow      (u_lfb_overflow),
                .pages_used    (u_lfb_pages_used),
                .idle          (u_lfb_idle),
                .draws         (u_lfb_draws),
                .clears        (u_lfb_clears),
                .word          (u_lfb_word),
                .sending       (u_lfb_sending),
                .request_ready (u_lfb_request_ready),
                .clear_ready   (u_lfb_clear_ready)
            );

            lfb_swap_patches8_merge_clocks948_sent_clocks1108 u_lfb_swap (
                .pe_clk    (pe_clk),
                .pe_rst    (pe_rst),
                .merge_clk (merge_clk),
                .merge_rst (merge_rst),
                .done      (done),
                .idle      (finished),
                .overflow  (u_lfb_overflow),
                .draws     (u_lfb_draws),
                .clears    (u_lfb_clears),
                .patch     (clear_patch),
                .line      (line),
                .shown     (shown),
                .sending   (u_lfb_sending),
                .ready     (u_lfb_swap_ready),
                .swap      (u_lfb_swap_swap),
                .resume    (u_lfb_swap_resume),
                .state     (u_lfb_swap_state),
                .frame     (u_lfb_swap_frame)
            );
        end
    endgenerate

    gfb_unit_width16_height8_units2_overhead20_period7934_blanking_at_start u_gfb ( // rtl/src/vc1/mod.rs:178
        .merge_clk             (merge_clk),
        .merge_rst             (merge_rst),
        .crt_clk               (crt_clk),
        .crt_rst               (crt_rst),
        .swap                  (gfb_swap),
        .host_accesses_valid   (host_accesses_valid),
        .host_accesses_address (host_accesses_address),
        .host_accesses_writes  (host_accesses_writes),
        .host_accesses_word    (host_accesses_word),
        .host_background       (host_background),
        .merged                (merged),
        .view_read_valid       (view_read_valid),
        .view_read_word        (view_read_word),
        .view_first_round      (view_first_round),
        .scan_restart          (u_gfb_scan_restart),
        .scan_enable           (u_gfb_scan_enable),
        .left                  (u_gfb_left),
        .blanking              (u_gfb_blanking),
        .pixel_valid           (pixel_valid),
        .pixel_rgb             (pixel_rgb),
        .host_accesses_ready   (host_accesses_ready)
    );

    broadcast_bus_processors2_queue4_word_clocks6 u_bus (        // rtl/src/vc1/mod.rs:184
        .clk              (pe_clk),
        .rst              (pe_rst),
        .senders_0_valid  (processors_0_sends_valid),
        .senders_0_word   (processors_0_sends_word),
        .senders_0_last   (processors_0_sends_last),
        .senders_1_valid  (processors_1_sends_valid),
        .senders_1_word   (processors_1_sends_word),
        .senders_1_last   (processors_1_sends_last),
        .senders_2_valid  (command_valid),
        .senders_2_word   (command_word),
        .senders_2_last   (command_last),
        .received_0_ready (processors_0_received_ready),
        .received_1_ready (processors_1_received_ready),
        .received_0_valid (processors_0_received_valid),
        .received_0_word  (processors_0_received_word),
        .received_0_last  (processors_0_received_last),
        .received_1_valid (processors_1_received_valid),
        .received_1_word  (processors_1_received_word),
        .received_1_last  (processors_1_received_last),
        .idle             (u_bus_idle),
        .empty            (u_bus_empty),
        .senders_0_ready  (processors_0_sends_ready),
        .senders_1_ready  (processors_1_sends_ready),
        .senders_2_ready  (command_ready)
    );

    sync_line_processors2 u_sync_line (                          // rtl/src/vc1/mod.rs:211
        .clk     (pe_clk),
        .rst     (pe_rst),
        .ready_0 (swap_row[0].u_lfb_swap_ready),
        .ready_1 (swap_row[1].u_lfb_swap_ready),
        .bus     (u_bus_idle),
        .host    (ready),
        .line    (line)
    );

    gfb_swap_processors2_merge_clocks296_way140_late45 u_gfb_swap ( // rtl/src/vc1/mod.rs:222
        .clk       (merge_clk),
        .rst       (merge_rst),
        .frames_0  (swap_row[0].u_lfb_swap_frame),
        .frames_1  (swap_row[1].u_lfb_swap_frame),
        .sending_0 (swap_row[0].u_lfb_sending),
        .sending_1 (swap_row[1].u_lfb_sending),
        .enable    (u_gfb_scan_enable),
        .blanking  (u_gfb_blanking),
        .swap      (gfb_swap),
        .merged    (is_merged),
        .shown     (shown)
    );

    image_merger_units2 u_merger (                               // rtl/src/vc1/mod.rs:228
        .clk       (merge_clk),
        .left      (u_gfb_left),
        .samples_0 (swap_row[0].u_lfb_word),
        .samples_1 (swap_row[1].u_lfb_word),
        .enable    (u_gfb_scan_enable),
        .merged    (merged)
    );

    assign processors_0_request_ready = swap_row[0].u_lfb_request_ready; // rtl/src/vc1/mod.rs:182
    assign processors_0_clear_ready = swap_row[0].u_lfb_clear_ready; // rtl/src/vc1/mod.rs:182
    assign processors_1_request_ready = swap_row[1].u_lfb_request_ready; // rtl/src/vc1/mod.rs:182
    assign processors_1_clear_ready = swap_row[1].u_lfb_clear_ready; // rtl/src/vc1/mod.rs:182
    wire [1:0] asserted_all_lanes;
    generate
        for (i = 0; i < 2; i = i + 1) begin : asserted_all_of
            assign asserted_all_lanes[i] = u_bus_empty[i];
        end
    endgenerate
    assign asserted_all = &asserted_all_lanes;                   // rtl/src/vc1/mod.rs:219
    wire [1:0] u_lfb_idle_all_lanes;
    generate
        for (i = 0; i < 2; i = i + 1) begin : u_lfb_idle_all_of
            assign u_lfb_idle_all_lanes[i] = swap_row[i].u_lfb_idle;
        end
    endgenerate
    assign u_lfb_idle_all = &u_lfb_idle_all_lanes;               // rtl/src/vc1/mod.rs:219

    assign processors_0_state = swap_row[0].u_lfb_swap_state;
    assign processors_0_pages_used = swap_row[0].u_lfb_pages_used;
    assign processors_0_idle = swap_row[0].u_lfb_idle;
    assign processors_1_state = swap_row[1].u_lfb_swap_state;
    assign processors_1_pages_used = swap_row[1].u_lfb_pages_used;
    assign processors_1_idle = swap_row[1].u_lfb_idle;

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
    always @(posedge pe_clk) begin
        if (!pe_rst) assert (!line | (u_bus_idle & asserted_all & u_lfb_idle_all)); // rtl/src/vc1/mod.rs:218
    end
`else
    always @(posedge pe_clk) begin
        if (!pe_rst && !(!line | (u_bus_idle & asserted_all & u_lfb_idle_all))) begin // rtl/src/vc1/mod.rs:218
            $display("FAIL: time %0t: %m: the line is high only with the bus and all queues empty and all local frame buffers idle", $time);
            stop;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, asserted_all, u_lfb_idle_all};
endmodule
`default_nettype wire
