// vc1_width16_height8_edge4_pages4_processors2
//
// The frame buffer subsystem of a VC-1: virtual local frame buffers, pipelined image merger,
// global frame buffer.
//
// Parameters  Vc1 { lfb: LfbUnit { patches: Patches { screen: Screen { width: 16, height: 8 }, edge: 4 }, pages: 4 }, processors: 2 }
// Latency     a round of merging takes 296 clocks
// Source      VC-1, section 3.3 (VC1-LFB, VC1-PIM, VC1-GFB)
// Described   rtl/src/vc1/mod.rs:67
`default_nettype none

module vc1_width16_height8_edge4_pages4_processors2 (
    input  wire        merge_clk,
    input  wire        merge_rst,
    input  wire        pe_clk,
    input  wire        pe_rst,
    // Of each processor.
    // A pixel to draw.
    input  wire        processors_0_request_valid,
    input  wire [3:0]  processors_0_request_x,     // Counted from the left.
    input  wire [2:0]  processors_0_request_y,     // Counted from the top.
    input  wire [47:0] processors_0_request_word,  // Depth above colour.
    // A patch table entry to clear.
    input  wire        processors_0_clear_valid,
    input  wire [2:0]  processors_0_clear_patch,   // Its number.
    input  wire        processors_0_swap,          // For one clock, when idle or in overflow: exchange the buffers.
    input  wire        processors_0_resume,        // For one clock, in overflow: try the held request again.
    input  wire        processors_1_request_valid,
    input  wire [3:0]  processors_1_request_x,
    input  wire [2:0]  processors_1_request_y,
    input  wire [47:0] processors_1_request_word,
    input  wire        processors_1_clear_valid,
    input  wire [2:0]  processors_1_clear_patch,
    input  wire        processors_1_swap,
    input  wire        processors_1_resume,
    // Of the host.
    input  wire        gfb_start,                  // For one clock, when not busy: merge the local frame buffers.
    input  wire        gfb_swap,                   // For one clock, when not busy: exchange the banks.
    input  wire [6:0]  gfb_read_address,           // A pixel of the bank on display, in raster order.
    // The word of a blank pixel: the greatest depth above the background's colour.
    input  wire [47:0] gfb_background,
    // To each processor.
    output wire        processors_0_overflow,      // The request is held: all pages are taken.
    output wire [2:0]  processors_0_pages_used,    // How many pages are taken.
    output wire        processors_0_idle,          // Nothing is under way.
    output wire        processors_1_overflow,
    output wire [2:0]  processors_1_pages_used,
    output wire        processors_1_idle,
    // To the host.
    output wire [47:0] gfb_read_word,              // The pixel at the address of the last clock.
    output wire        gfb_busy,                   // A round is under way.
    // The next or present round is the first since the banks were swapped.
    output wire        gfb_first_round,
    // The clocks of the round so far, or of the last one, from the first pixel that entered the chain.
    output wire [8:0]  gfb_clocks,
    output wire        processors_0_request_ready,
    output wire        processors_0_clear_ready,
    output wire        processors_1_request_ready,
    output wire        processors_1_clear_ready
);

    wire u_gfb_scan_restart;                                     // rtl/src/vc1/mod.rs:112
    wire u_gfb_scan_enable;                                      // rtl/src/vc1/mod.rs:112
    wire [47:0] u_gfb_left;                                      // rtl/src/vc1/mod.rs:112
    wire [47:0] merged;                                          // rtl/src/vc1/mod.rs:111

    genvar i;

    wire [1:0] u_lfb_request_valid = {processors_1_request_valid, processors_0_request_valid};
    wire [7:0] u_lfb_request_x = {processors_1_request_x, processors_0_request_x};
    wire [5:0] u_lfb_request_y = {processors_1_request_y, processors_0_request_y};
    wire [95:0] u_lfb_request_word = {processors_1_request_word, processors_0_request_word};
    wire [1:0] u_lfb_clear_valid = {processors_1_clear_valid, processors_0_clear_valid};
    wire [5:0] u_lfb_clear_patch = {processors_1_clear_patch, processors_0_clear_patch};
    wire [1:0] u_lfb_swap = {processors_1_swap, processors_0_swap};
    wire [1:0] u_lfb_resume = {processors_1_resume, processors_0_resume};
    generate
        for (i = 0; i < 2; i = i + 1) begin : u_lfb                  // rtl/src/vc1/mod.rs:114
            wire overflow;
            wire [2:0] pages_used;
            wire idle;
            wire [47:0] word;
            wire request_ready;
            wire clear_ready;
            wire request_valid = u_lfb_request_valid[i];
            wire [3:0] request_x = u_lfb_request_x[i * 4 +: 4];
            wire [2:0] request_y = u_lfb_request_y[i * 3 +: 3];
            wire [47:0] request_word = u_lfb_request_word[i * 48 +: 48];
            wire clear_valid = u_lfb_clear_valid[i];
            wire [2:0] clear_patch = u_lfb_clear_patch[i * 3 +: 3];
            wire swap = u_lfb_swap[i];
            wire resume = u_lfb_resume[i];
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
                .word          (word),
                .request_ready (request_ready),
                .clear_ready   (clear_ready)
            );
        end
    endgenerate

    gfb_unit_width16_height8_units2_overhead20 u_gfb (           // rtl/src/vc1/mod.rs:112
        .clk               (merge_clk),
        .rst               (merge_rst),
        .host_start        (gfb_start),
        .host_swap         (gfb_swap),
        .host_read_address (gfb_read_address),
        .host_background   (gfb_background),
        .merged            (merged),
        .view_read_word    (gfb_read_word),
        .view_busy         (gfb_busy),
        .view_first_round  (gfb_first_round),
        .view_clocks       (gfb_clocks),
        .scan_restart      (u_gfb_scan_restart),
        .scan_enable       (u_gfb_scan_enable),
        .left              (u_gfb_left)
    );

    image_merger_units2 u_merger (                               // rtl/src/vc1/mod.rs:123
        .clk       (merge_clk),
        .left      (u_gfb_left),
        .samples_0 (u_lfb[0].word),
        .samples_1 (u_lfb[1].word),
        .enable    (u_gfb_scan_enable),
        .merged    (merged)
    );

    assign processors_0_request_ready = u_lfb[0].request_ready;  // rtl/src/vc1/mod.rs:115
    assign processors_0_clear_ready = u_lfb[0].clear_ready;      // rtl/src/vc1/mod.rs:115
    assign processors_1_request_ready = u_lfb[1].request_ready;  // rtl/src/vc1/mod.rs:115
    assign processors_1_clear_ready = u_lfb[1].clear_ready;      // rtl/src/vc1/mod.rs:115

    assign processors_0_overflow = u_lfb[0].overflow;
    assign processors_0_pages_used = u_lfb[0].pages_used;
    assign processors_0_idle = u_lfb[0].idle;
    assign processors_1_overflow = u_lfb[1].overflow;
    assign processors_1_pages_used = u_lfb[1].pages_used;
    assign processors_1_idle = u_lfb[1].idle;
endmodule
`default_nettype wire
