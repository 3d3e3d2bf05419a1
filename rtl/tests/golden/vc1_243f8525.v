// vc1_243f8525
//
// The frame buffer subsystem of a VC-1: virtual local frame buffers, pipelined image merger,
// global frame buffer, swap control.
//
// Parameters  Vc1 { lfb: LfbUnit { patches: Patches { screen: Screen { width: 16, height: 8 }, edge: 4 }, pages: 4 }, processors: 2, queue: 4, word_clocks: 6, overhead: 20, accumulation: false, display: Display { period: Period(7934), blanking: AtStart } }
// Latency     a frame is merged in 296 clocks of the merger
// Source      VC-1, section 3.3 (VC1-LFB, VC1-PIM, VC1-GFB, VC1-SW1 to SW4)
// Described   rtl/src/vc1/mod.rs:83
`default_nettype none

module vc1_243f8525 (
    input  wire        merge_clk,
    input  wire        merge_rst,
    input  wire        crt_clk,
    input  wire        crt_rst,
    input  wire        pe_clk,
    input  wire        pe_rst,
    // The inputs from each processor.
    // A pixel to draw.
    input  wire        processors_0_request_valid,
    input  wire [3:0]  processors_0_request_x,      // The column of the pixel, counted from the left.
    input  wire [2:0]  processors_0_request_y,      // The line of the pixel, counted from the top.
    input  wire [47:0] processors_0_request_word,   // The word of the pixel: depth above colour.
    // A patch table entry to clear.
    input  wire        processors_0_clear_valid,
    input  wire [2:0]  processors_0_clear_patch,    // The number of the patch.
    // A word for the bus.
    input  wire        processors_0_sends_valid,
    input  wire [31:0] processors_0_sends_word,     // A word of the packet.
    input  wire        processors_0_sends_last,     // The word is the last of its packet.
    input  wire        processors_0_done,           // The processor has drawn its frame.
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
    input  wire [31:0] command_word,                // A word of the packet.
    input  wire        command_last,                // The word is the last of its packet.
    input  wire        ready,                       // The host releases the sync line.
    // The inputs from the host.
    // Reads and writes of the bank on display, one in every clock.
    input  wire        host_accesses_valid,
    input  wire [6:0]  host_accesses_address,       // The number of the pixel that the host accesses, in raster order.
    input  wire        host_accesses_writes,        // High if the host writes the pixel, low if it reads the pixel.
    input  wire [47:0] host_accesses_word,          // The word that the host writes: depth above colour.
    // The word of a blank pixel: the greatest depth above the background's colour.
    input  wire [47:0] host_background,
    input  wire        processors_0_received_ready,
    input  wire        processors_1_received_ready,
    // The outputs to each processor.
    output wire [1:0]  processors_0_state,          // What the processor may do: a code of `SwapState`.
    output wire [2:0]  processors_0_pages_used,     // The number of pages taken.
    output wire        processors_0_idle,           // No request of the processor is under way.
    // The word at the front of the processor's queue.
    output wire        processors_0_received_valid,
    output wire [31:0] processors_0_received_word,  // A word of the packet.
    output wire        processors_0_received_last,  // The word is the last of its packet.
    output wire [1:0]  processors_1_state,
    output wire [2:0]  processors_1_pages_used,
    output wire        processors_1_idle,
    output wire        processors_1_received_valid,
    output wire [31:0] processors_1_received_word,
    output wire        processors_1_received_last,
    output wire        line,                        // The sync line: all processors have drawn the frame.
    // The outputs to the host.
    output wire        view_read_valid,             // The access of the previous clock was a read.
    output wire [47:0] view_read_word,              // The word of the pixel that was read last.
    // Blank pixels enter the chain: the round is the first since the banks were swapped.
    output wire        view_first_round,
    // A frame is stored in the global frame buffer, and waits for the blanking.
    output wire        is_merged,
    output wire        shown,                       // Toggles with each swap of the global frame buffer.
    // The output to the display.
    output wire        pixel_valid,                 // The display gets a pixel in this clock.
    output wire [23:0] pixel_rgb,                   // The colour of the pixel.
    output wire        processors_0_request_ready,
    output wire        processors_0_clear_ready,
    output wire        processors_0_sends_ready,
    output wire        processors_1_request_ready,
    output wire        processors_1_clear_ready,
    output wire        processors_1_sends_ready,
    output wire        command_ready,
    output wire        host_accesses_ready
);

    wire u_gfb_scan_restart;                                     // rtl/src/vc1/mod.rs:193
    wire u_gfb_scan_enable;                                      // rtl/src/vc1/mod.rs:193
    wire [47:0] u_gfb_left;                                      // rtl/src/vc1/mod.rs:193
    wire u_gfb_blanking;                                         // rtl/src/vc1/mod.rs:193
    wire u_bus_idle;                                             // rtl/src/vc1/mod.rs:199
    wire [1:0] u_bus_empty;                                      // rtl/src/vc1/mod.rs:199
    wire [1:0] u_swap_swap;                                      // rtl/src/vc1/mod.rs:226
    wire [1:0] u_swap_resume;                                    // rtl/src/vc1/mod.rs:226
    wire [3:0] u_swap_state;                                     // rtl/src/vc1/mod.rs:226
    wire gfb_swap;                                               // rtl/src/vc1/mod.rs:191
    wire [47:0] merged;                                          // rtl/src/vc1/mod.rs:190

    wire asserted_all;                                           // rtl/src/vc1/mod.rs:270
    wire brought_all;                                            // rtl/src/vc1/mod.rs:230
    wire u_lfb_idle_all;                                         // rtl/src/vc1/mod.rs:232
    wire covered_all;                                            // rtl/src/vc1/mod.rs:235
    wire [1:0] u_swap_idle;                                      // rtl/src/vc1/mod.rs:212
    wire [1:0] u_swap_overflow;                                  // rtl/src/vc1/mod.rs:201
    wire [1:0] u_swap_draws;                                     // rtl/src/vc1/mod.rs:201
    wire [1:0] u_swap_clears;                                    // rtl/src/vc1/mod.rs:201
    wire [1:0] u_swap_sending;                                   // rtl/src/vc1/mod.rs:201
    wire brought = u_bus_idle & brought_all;                     // rtl/src/vc1/mod.rs:230

    genvar i;

    wire [1:0] u_lfb_request_valid = {processors_1_request_valid, processors_0_request_valid};
    wire [7:0] u_lfb_request_x = {processors_1_request_x, processors_0_request_x};
    wire [5:0] u_lfb_request_y = {processors_1_request_y, processors_0_request_y};
    wire [95:0] u_lfb_request_word = {processors_1_request_word, processors_0_request_word};
    wire [1:0] u_lfb_clear_valid = {processors_1_clear_valid, processors_0_clear_valid};
    wire [5:0] u_lfb_clear_patch = {processors_1_clear_patch, processors_0_clear_patch};
    generate
        for (i = 0; i < 2; i = i + 1) begin : u_lfb                  // rtl/src/vc1/mod.rs:201
            wire overflow;
            wire [2:0] pages_used;
            wire idle;
            wire draws;
            wire clears;
            wire [47:0] word;
            wire sending;
            wire [3:0] scanned_x;
            wire [2:0] scanned_y;
            wire request_ready;
            wire clear_ready;
            wire swap = u_swap_swap[i];
            wire resume = u_swap_resume[i];
            wire request_valid = u_lfb_request_valid[i];
            wire [3:0] request_x = u_lfb_request_x[i * 4 +: 4];
            wire [2:0] request_y = u_lfb_request_y[i * 3 +: 3];
            wire [47:0] request_word = u_lfb_request_word[i * 48 +: 48];
            wire clear_valid = u_lfb_clear_valid[i];
            wire [2:0] clear_patch = u_lfb_clear_patch[i * 3 +: 3];
            localparam [31:0] preset_x = 12 * i;
            localparam [31:0] preset_y = 7 * i;

            lfb_unit_width16_height8_edge4_pages4 lane (
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
                .overflow      (overflow),
                .pages_used    (pages_used),
                .idle          (idle),
                .draws         (draws),
                .clears        (clears),
                .word          (word),
                .sending       (sending),
                .scanned_x     (scanned_x),
                .scanned_y     (scanned_y),
                .request_ready (request_ready),
                .clear_ready   (clear_ready)
            );
        end
    endgenerate

    wire [1:0] covered_listed_row_covered_listed = {processors_1_done, processors_0_done};
    generate
        for (i = 0; i < 2; i = i + 1) begin : covered_listed_row
            wire covered_listed = covered_listed_row_covered_listed[i];
            wire covered_and = covered_listed & u_lfb[i].idle;
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : sum_row
            localparam [31:0] sum_listed = 4 * i;
            wire [12:0] sum_product = {5'd0, {5'd0, u_lfb[i].scanned_y}} * 13'd16;
            wire [7:0] sum = sum_product[7:0] + {4'd0, u_lfb[i].scanned_x} + sum_listed[7:0];
            wire [7:0] led = (sum >= 8'd128) ? (sum - 8'd128) : sum;
            wire asserted_equal = led == sum_row[0].led;
            wire _unused_lane = &{1'b0, sum_product[12:8]};
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : finished_row
            wire finished = u_lfb[i].idle & u_bus_empty[i];
        end
    endgenerate

    gfb_unit_width16_height8_units2_overhead20_period7934_blanking_at_start u_gfb ( // rtl/src/vc1/mod.rs:193
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

    broadcast_bus_processors2_queue4_word_clocks6 u_bus (        // rtl/src/vc1/mod.rs:199
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

    swap_control_376173f8 u_swap (                               // rtl/src/vc1/mod.rs:226
        .pe_clk    (pe_clk),
        .pe_rst    (pe_rst),
        .merge_clk (merge_clk),
        .merge_rst (merge_rst),
        .done      ({processors_1_done, processors_0_done}),
        .idle      (u_swap_idle),
        .overflow  (u_swap_overflow),
        .draws     (u_swap_draws),
        .clears    (u_swap_clears),
        .patch     ({processors_1_clear_patch, processors_0_clear_patch}),
        .bus       (u_bus_idle),
        .host      (ready),
        .sending   (u_swap_sending),
        .enable    (u_gfb_scan_enable),
        .blanking  (u_gfb_blanking),
        .line      (line),
        .swap      (u_swap_swap),
        .resume    (u_swap_resume),
        .state     (u_swap_state),
        .gfb_swap  (gfb_swap),
        .merged    (is_merged),
        .shown     (shown)
    );

    image_merger_units2 u_merger (                               // rtl/src/vc1/mod.rs:239
        .clk       (merge_clk),
        .left      (u_gfb_left),
        .samples_0 (u_lfb[0].word),
        .samples_1 (u_lfb[1].word),
        .enable    (u_gfb_scan_enable),
        .merged    (merged)
    );

    assign processors_0_request_ready = u_lfb[0].request_ready;  // rtl/src/vc1/mod.rs:197
    assign processors_0_clear_ready = u_lfb[0].clear_ready;      // rtl/src/vc1/mod.rs:197
    assign processors_1_request_ready = u_lfb[1].request_ready;  // rtl/src/vc1/mod.rs:197
    assign processors_1_clear_ready = u_lfb[1].clear_ready;      // rtl/src/vc1/mod.rs:197
    wire [1:0] asserted_all_lanes;
    generate
        for (i = 0; i < 2; i = i + 1) begin : asserted_all_of
            assign asserted_all_lanes[i] = sum_row[i].asserted_equal;
        end
    endgenerate
    assign asserted_all = &asserted_all_lanes;                   // rtl/src/vc1/mod.rs:270
    wire [1:0] brought_all_lanes;
    generate
        for (i = 0; i < 2; i = i + 1) begin : brought_all_of
            assign brought_all_lanes[i] = u_bus_empty[i];
        end
    endgenerate
    assign brought_all = &brought_all_lanes;                     // rtl/src/vc1/mod.rs:230
    wire [1:0] u_lfb_idle_all_lanes;
    generate
        for (i = 0; i < 2; i = i + 1) begin : u_lfb_idle_all_of
            assign u_lfb_idle_all_lanes[i] = u_lfb[i].idle;
        end
    endgenerate
    assign u_lfb_idle_all = &u_lfb_idle_all_lanes;               // rtl/src/vc1/mod.rs:232
    wire [1:0] covered_all_lanes;
    generate
        for (i = 0; i < 2; i = i + 1) begin : covered_all_of
            assign covered_all_lanes[i] = covered_listed_row[i].covered_and;
        end
    endgenerate
    assign covered_all = &covered_all_lanes;                     // rtl/src/vc1/mod.rs:235
    generate
        for (i = 0; i < 2; i = i + 1) begin : u_swap_idle_of
            assign u_swap_idle[i] = finished_row[i].finished;
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : u_swap_overflow_of
            assign u_swap_overflow[i] = u_lfb[i].overflow;
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : u_swap_draws_of
            assign u_swap_draws[i] = u_lfb[i].draws;
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : u_swap_clears_of
            assign u_swap_clears[i] = u_lfb[i].clears;
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : u_swap_sending_of
            assign u_swap_sending[i] = u_lfb[i].sending;
        end
    endgenerate

    assign processors_0_state = u_swap_state[1:0];
    assign processors_0_pages_used = u_lfb[0].pages_used;
    assign processors_0_idle = u_lfb[0].idle;
    assign processors_1_state = u_swap_state[3:2];
    assign processors_1_pages_used = u_lfb[1].pages_used;
    assign processors_1_idle = u_lfb[1].idle;

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
    reg is_scanning;                                             // rtl/src/vc1/mod.rs:267

    always @(posedge merge_clk) begin
        if (merge_rst) is_scanning <= 1'b0;
        else if (u_gfb_scan_restart) is_scanning <= 1'b1;
    end

`ifdef FORMAL
    always @(posedge merge_clk) begin
        if (!merge_rst) assert (!is_scanning | asserted_all);        // rtl/src/vc1/mod.rs:269
    end
    always @(posedge pe_clk) begin
        if (!pe_rst) assert (!line | (brought & u_lfb_idle_all));    // rtl/src/vc1/mod.rs:231
        if (!pe_rst) cover (covered_all & ready & !brought);         // rtl/src/vc1/mod.rs:235
    end
`else
    reg is_covered;
    initial is_covered = 1'b0;
    always @(posedge merge_clk) begin
        if (!merge_rst && !(!is_scanning | asserted_all)) begin      // rtl/src/vc1/mod.rs:269
            $display("FAIL: time %0t: %m: each scan counter runs 4 pixels ahead of the succeeding one, modulo a frame", $time);
            stop;
        end
    end
    always @(posedge pe_clk) begin
        if (!pe_rst && !(!line | (brought & u_lfb_idle_all))) begin  // rtl/src/vc1/mod.rs:231
            $display("FAIL: time %0t: %m: the line is high only with the bus and all queues empty and all local frame buffers idle", $time);
            stop;
        end
        if (!pe_rst && (covered_all & ready & !brought) && !is_covered) begin // rtl/src/vc1/mod.rs:235
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: a word on the bus or in a queue keeps the line low", $time);
            `endif
            is_covered <= 1'b1;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, asserted_all, brought, u_lfb_idle_all, covered_all};
endmodule
`default_nettype wire
