// swap_control_f1eef5f4
//
// Decides when each local frame buffer swaps its buffers, and when the global one does.
//
// Parameters  SwapControl { local: LfbSwap { patches: 3, merge_clocks: 13, sent_clocks: 53, overflow_clocks: 119 }, global: GfbSwap { processors: 2, merge_clocks: 4, way: 4, late: 8 } }
// Latency     0 clocks from the last guard to a swap
// Source      VC-1, section 3.3 and Figure 6, buffer swap control (VC1-SW1 to SW4)
// Described   rtl/src/swap/control.rs:32
`default_nettype none

module swap_control_f1eef5f4 (
    input  wire       pe_clk,
    input  wire       pe_rst,
    input  wire       merge_clk,
    input  wire       merge_rst,
    input  wire [1:0] done,      // For each processing element: the program has drawn its frame.
    // For each processing element: no pixel is under way, and no word waits in the receive queue.
    input  wire [1:0] idle,
    input  wire [1:0] overflow,  // For each processing element: a pixel waits, because all pages are taken.
    input  wire [1:0] draws,     // For each processing element: a pixel is accepted.
    input  wire [1:0] clears,    // For each processing element: an entry of the patch table is cleared.
    input  wire [3:0] patch,     // For each processing element: the patch whose entry is cleared.
    input  wire       bus,       // The broadcast bus is idle.
    input  wire       host,      // The host releases the sync line.
    input  wire [1:0] sending,   // For each local frame buffer: a part of the back buffer is not sent yet.
    input  wire       enable,    // The chain advances.
    input  wire       blanking,  // The display is in the part of its vertical blanking in which the banks may change.
    output wire       line,      // The sync line: all have drawn the frame.
    output wire [1:0] swap,      // For each local frame buffer, for one clock: swap the buffers.
    output wire [1:0] resume,    // For each local frame buffer, for one clock: try the waiting request again.
    output wire [3:0] state,     // For each processing element: what the program may do.
    output wire       gfb_swap,  // For one clock: swap the banks of the global frame buffer.
    output wire       merged,    // A frame is stored, and waits for the blanking.
    output wire       shown      // Toggles with each swap of the global frame buffer.
);

    genvar i;

    generate
        for (i = 0; i < 2; i = i + 1) begin : u_lfb_swap             // rtl/src/swap/control.rs:97
            wire ready;
            wire lane_swap;
            wire lane_resume;
            wire [1:0] lane_state;
            wire frame;

            lfb_swap_patches3_merge_clocks13_sent_clocks53_overflow_clocks119 lane (
                .pe_clk    (pe_clk),
                .pe_rst    (pe_rst),
                .merge_clk (merge_clk),
                .merge_rst (merge_rst),
                .done      (done[i]),
                .idle      (idle[i]),
                .overflow  (overflow[i]),
                .draws     (draws[i]),
                .clears    (clears[i]),
                .patch     (patch[i * 2 +: 2]),
                .line      (line),
                .shown     (shown),
                .sending   (sending[i]),
                .ready     (ready),
                .swap      (lane_swap),
                .resume    (lane_resume),
                .state     (lane_state),
                .frame     (frame)
            );
        end
    endgenerate

    sync_line_processors2 u_sync_line (                          // rtl/src/swap/control.rs:111
        .clk     (pe_clk),
        .rst     (pe_rst),
        .ready_0 (u_lfb_swap[0].ready),
        .ready_1 (u_lfb_swap[1].ready),
        .bus     (bus),
        .host    (host),
        .line    (line)
    );

    gfb_swap_processors2_merge_clocks4_way4_late8 u_gfb_swap (   // rtl/src/swap/control.rs:116
        .clk       (merge_clk),
        .rst       (merge_rst),
        .frames_0  (u_lfb_swap[0].frame),
        .frames_1  (u_lfb_swap[1].frame),
        .sending_0 (sending[0]),
        .sending_1 (sending[1]),
        .enable    (enable),
        .blanking  (blanking),
        .swap      (gfb_swap),
        .merged    (merged),
        .shown     (shown)
    );

    generate
        for (i = 0; i < 2; i = i + 1) begin : swap_of
            assign swap[i] = u_lfb_swap[i].lane_swap;
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : resume_of
            assign resume[i] = u_lfb_swap[i].lane_resume;
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : state_of
            assign state[i * 2 +: 2] = u_lfb_swap[i].lane_state;
        end
    endgenerate
endmodule
`default_nettype wire
