// lfb_swap_patches3_merge_clocks13_sent_clocks53_overflow_clocks119
//
// Swaps a local frame buffer at the end of a frame and in an overflow, as soon as all guards
// are true.
//
// Parameters  LfbSwap { patches: 3, merge_clocks: 13, sent_clocks: 53, overflow_clocks: 119 }
// Latency     1 clock from the line to the swap, if all guards are true
// Source      VC-1, section 3.3 and Figure 6, swap of a local frame buffer (VC1-SW1, VC1-SW3, VC1-SW4)
// Described   rtl/src/swap/lfb_swap.rs:62
`default_nettype none

module lfb_swap_patches3_merge_clocks13_sent_clocks53_overflow_clocks119 (
    input  wire       pe_clk,
    input  wire       pe_rst,
    input  wire       merge_clk,
    input  wire       merge_rst,
    // The program has drawn its frame: high until the swap is due, and low before the program clears the table.
    input  wire       done,
    // No pixel is under way in the local frame buffer, and no word waits in the receive queue.
    input  wire       idle,
    input  wire       overflow,  // A pixel waits, because all pages are taken.
    input  wire       draws,     // A pixel is accepted.
    input  wire       clears,    // An entry of the patch table is cleared.
    input  wire [1:0] patch,     // The patch whose entry is cleared.
    input  wire       line,      // The sync line.
    input  wire       shown,     // Toggles with each swap of the global frame buffer.
    input  wire       sending,   // A part of the back buffer is not sent yet.
    output wire       ready,     // The processing element's contribution to the sync line.
    output wire       swap,      // For one clock: swap the buffers.
    output wire       resume,    // For one clock: try the waiting request again.
    output reg  [1:0] state,     // What the program may do.
    output wire       frame      // Toggles with each swap at the end of a frame, in the merger's clock.
);

    localparam [1:0] SWAP_STATE_CLEAR    = 2'd0;
    localparam [1:0] SWAP_STATE_DRAW     = 2'd1;
    localparam [1:0] SWAP_STATE_DUE      = 2'd2;
    localparam [1:0] SWAP_STATE_OVERFLOW = 2'd3;

    reg parity;                                                  // rtl/src/swap/lfb_swap.rs:121
    (* ASYNC_REG = "TRUE" *) reg shown_here_meta;                // rtl/src/swap/lfb_swap.rs:122
    (* ASYNC_REG = "TRUE" *) reg shown_here;                     // rtl/src/swap/lfb_swap.rs:122
    (* ASYNC_REG = "TRUE" *) reg sending_here_meta;              // rtl/src/swap/lfb_swap.rs:123
    (* ASYNC_REG = "TRUE" *) reg sending_here;                   // rtl/src/swap/lfb_swap.rs:123
    reg [5:0] since;                                             // rtl/src/swap/lfb_swap.rs:127
    reg [1:0] entry;                                             // rtl/src/swap/lfb_swap.rs:133
    reg holds;                                                   // rtl/src/swap/lfb_swap.rs:141
    (* ASYNC_REG = "TRUE" *) reg frame_here_meta;                // rtl/src/swap/lfb_swap.rs:173
    (* ASYNC_REG = "TRUE" *) reg frame_here;                     // rtl/src/swap/lfb_swap.rs:173
    reg frame_late;                                              // rtl/src/swap/lfb_swap.rs:174

    wire state_is_draw = state == SWAP_STATE_DRAW;               // rtl/src/swap/lfb_swap.rs:116
    wire state_is_due = state == SWAP_STATE_DUE;                 // rtl/src/swap/lfb_swap.rs:116
    wire state_is_overflow = state == SWAP_STATE_OVERFLOW;       // rtl/src/swap/lfb_swap.rs:116
    wire is_shown = shown_here == parity;                        // rtl/src/swap/lfb_swap.rs:125
    wire waited = since >= 6'd13;                                // rtl/src/swap/lfb_swap.rs:129
    wire swap_and = (state_is_due | state_is_overflow) & is_shown & waited; // rtl/src/swap/lfb_swap.rs:130
    wire is_sent = !sending_here;                                // rtl/src/swap/lfb_swap.rs:124
    assign swap = swap_and & is_sent;                            // rtl/src/swap/lfb_swap.rs:119
    wire frame_end = state_is_due & swap;                        // rtl/src/swap/lfb_swap.rs:120
    wire last_entry = clears & (entry == 2'd2);                  // rtl/src/swap/lfb_swap.rs:134
    assign resume = last_entry & holds;                          // rtl/src/swap/lfb_swap.rs:142
    assign ready = state_is_draw & done & idle;                  // rtl/src/swap/lfb_swap.rs:144
    wire covered_and = (state_is_due | state_is_overflow) & waited & is_sent; // rtl/src/swap/lfb_swap.rs:169
    wire covered_and_2 = (state_is_due | state_is_overflow) & is_shown & is_sent; // rtl/src/swap/lfb_swap.rs:170
    wire covered_and_3 = (state_is_due | state_is_overflow) & is_shown & waited; // rtl/src/swap/lfb_swap.rs:171

    always @(posedge pe_clk) begin
        if (pe_rst) begin
            state <= SWAP_STATE_CLEAR;
            parity <= 1'b0;
            shown_here_meta <= 1'b0;
            shown_here <= 1'b0;
            sending_here_meta <= 1'b0;
            sending_here <= 1'b0;
            since <= 6'd53;
            entry <= 2'd0;
            holds <= 1'b0;
        end else begin
            case (state)
                SWAP_STATE_CLEAR: if (last_entry) state <= SWAP_STATE_DRAW;
                SWAP_STATE_DRAW: begin
                    if (overflow) state <= SWAP_STATE_OVERFLOW;
                    else if (line) state <= SWAP_STATE_DUE;
                end
                SWAP_STATE_DUE: if (swap) state <= SWAP_STATE_CLEAR;
                default: begin // SWAP_STATE_OVERFLOW
                    if (swap) state <= SWAP_STATE_CLEAR;
                    else state <= SWAP_STATE_OVERFLOW;
                end
            endcase
            if (frame_end) parity <= !parity;
            shown_here_meta <= shown;
            shown_here <= shown_here_meta;
            sending_here_meta <= sending;
            sending_here <= sending_here_meta;
            if (swap) since <= 6'd0;
            else if (since != 6'd53) since <= since + 6'd1;
            if (last_entry) entry <= 2'd0;
            else if (clears) entry <= entry + 2'd1;
            if (state_is_overflow) holds <= 1'b1;
            else if (resume) holds <= 1'b0;
        end
    end

    always @(posedge merge_clk) begin
        if (merge_rst) begin
            frame_here_meta <= 1'b0;
            frame_here <= 1'b0;
            frame_late <= 1'b0;
        end else begin
            frame_here_meta <= parity;
            frame_here <= frame_here_meta;
            frame_late <= frame_here;
        end
    end

    assign frame = frame_late;

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
    reg [6:0] overflow_clocks;                                   // rtl/src/swap/lfb_swap.rs:159

    always @(posedge pe_clk) begin
        if (pe_rst) overflow_clocks <= 7'd0;
        else if ((state != SWAP_STATE_OVERFLOW) | swap) overflow_clocks <= 7'd0;
        else if (overflow_clocks != 7'd119) overflow_clocks <= overflow_clocks + 7'd1;
    end

`ifdef FORMAL
    always @(posedge pe_clk) begin
        if (!pe_rst) assume (!clears | ((state == SWAP_STATE_CLEAR) & (patch == entry))); // rtl/src/swap/lfb_swap.rs:146
        if (!pe_rst) assume (!draws | state_is_draw);                // rtl/src/swap/lfb_swap.rs:150
        if (!pe_rst) assume (!line | ready);                         // rtl/src/swap/lfb_swap.rs:151
        if (!pe_rst) assume (!done | (state != SWAP_STATE_CLEAR));   // rtl/src/swap/lfb_swap.rs:152
        if (!pe_rst) assume ((since != 6'd53) | is_sent);            // rtl/src/swap/lfb_swap.rs:153
        if (!pe_rst) assert (!swap | (shown_here == parity));        // rtl/src/swap/lfb_swap.rs:157
        if (!pe_rst) assert (!swap | (since >= 6'd13));              // rtl/src/swap/lfb_swap.rs:158
        if (!pe_rst) assert (overflow_clocks != 7'd119);             // rtl/src/swap/lfb_swap.rs:161
        if (!pe_rst) cover (frame_end);                              // rtl/src/swap/lfb_swap.rs:165
        if (!pe_rst) cover (state_is_overflow & swap);               // rtl/src/swap/lfb_swap.rs:166
        if (!pe_rst) cover (last_entry);                             // rtl/src/swap/lfb_swap.rs:167
        if (!pe_rst) cover ((state == SWAP_STATE_DRAW) & overflow);  // rtl/src/swap/lfb_swap.rs:168
        if (!pe_rst) cover (covered_and & !is_shown);                // rtl/src/swap/lfb_swap.rs:169
        if (!pe_rst) cover (covered_and_2 & !waited);                // rtl/src/swap/lfb_swap.rs:170
        if (!pe_rst) cover (covered_and_3 & !is_sent);               // rtl/src/swap/lfb_swap.rs:171
    end
`else
    reg is_covered;
    initial is_covered = 1'b0;
    reg is_covered_2;
    initial is_covered_2 = 1'b0;
    reg is_covered_3;
    initial is_covered_3 = 1'b0;
    reg is_covered_4;
    initial is_covered_4 = 1'b0;
    reg is_covered_5;
    initial is_covered_5 = 1'b0;
    reg is_covered_6;
    initial is_covered_6 = 1'b0;
    reg is_covered_7;
    initial is_covered_7 = 1'b0;
    always @(posedge pe_clk) begin
        if (!pe_rst && !(!clears | ((state == SWAP_STATE_CLEAR) & (patch == entry)))) begin // rtl/src/swap/lfb_swap.rs:146
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: after a swap the entries are cleared in sequence, each once", $time);
            stop;
        end
        if (!pe_rst && !(!draws | state_is_draw)) begin              // rtl/src/swap/lfb_swap.rs:150
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: no pixel is drawn between a swap and the last entry cleared", $time);
            stop;
        end
        if (!pe_rst && !(!line | ready)) begin                       // rtl/src/swap/lfb_swap.rs:151
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: the line is high only while this processing element releases it", $time);
            stop;
        end
        if (!pe_rst && !(!done | (state != SWAP_STATE_CLEAR))) begin // rtl/src/swap/lfb_swap.rs:152
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: `done` is low while the program clears the table", $time);
            stop;
        end
        if (!pe_rst && !((since != 6'd53) | is_sent)) begin          // rtl/src/swap/lfb_swap.rs:153
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: the merger sends the back buffer within T_m, the crossings and the overheads", $time);
            stop;
        end
        if (!pe_rst && !(!swap | (shown_here == parity))) begin      // rtl/src/swap/lfb_swap.rs:157
            $display("FAIL: time %0t: %m: the global frame buffer has swapped for the previous frame", $time);
            stop;
        end
        if (!pe_rst && !(!swap | (since >= 6'd13))) begin            // rtl/src/swap/lfb_swap.rs:158
            $display("FAIL: time %0t: %m: T_m has passed since the last swap", $time);
            stop;
        end
        if (!pe_rst && !(overflow_clocks != 7'd119)) begin           // rtl/src/swap/lfb_swap.rs:161
            $display("FAIL: time %0t: %m: the swap of an overflow comes within 2 T_m and the refreshes that the banks wait for", $time);
            stop;
        end
        if (!pe_rst && frame_end && !is_covered) begin               // rtl/src/swap/lfb_swap.rs:165
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: a frame ends", $time);
            `endif
            is_covered <= 1'b1;
        end
        if (!pe_rst && (state_is_overflow & swap) && !is_covered_2) begin // rtl/src/swap/lfb_swap.rs:166
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: an overflow ends with a swap", $time);
            `endif
            is_covered_2 <= 1'b1;
        end
        if (!pe_rst && last_entry && !is_covered_3) begin            // rtl/src/swap/lfb_swap.rs:167
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: the last entry is cleared", $time);
            `endif
            is_covered_3 <= 1'b1;
        end
        if (!pe_rst && ((state == SWAP_STATE_DRAW) & overflow) && !is_covered_4) begin // rtl/src/swap/lfb_swap.rs:168
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: a buffer overflows", $time);
            `endif
            is_covered_4 <= 1'b1;
        end
        if (!pe_rst && (covered_and & !is_shown) && !is_covered_5) begin // rtl/src/swap/lfb_swap.rs:169
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: a swap waits for the global frame buffer alone", $time);
            `endif
            is_covered_5 <= 1'b1;
        end
        if (!pe_rst && (covered_and_2 & !waited) && !is_covered_6) begin // rtl/src/swap/lfb_swap.rs:170
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: a swap waits for T_m alone", $time);
            `endif
            is_covered_6 <= 1'b1;
        end
        if (!pe_rst && (covered_and_3 & !is_sent) && !is_covered_7) begin // rtl/src/swap/lfb_swap.rs:171
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: a swap waits for the merger alone", $time);
            `endif
            is_covered_7 <= 1'b1;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, draws, patch, covered_and, covered_and_2, covered_and_3};
endmodule
`default_nettype wire
