// gfb_swap_processors2_merge_clocks296_way140_late45
//
// Swaps the global frame buffer in a vertical blanking, when a frame is merged.
//
// Parameters  GfbSwap { processors: 2, merge_clocks: 296, way: 140, late: 45 }
// Latency     0 clocks, if all guards hold
// Source      VC-1, section 3.3 and Figure 6, swap of the global frame buffer (VC1-SW2)
// Described   rtl/src/swap/gfb_swap.rs:19
`default_nettype none

module gfb_swap_processors2_merge_clocks296_way140_late45 (
    input  wire clk,
    input  wire rst,
    // Of each processing element: turns with its swap at the end of a frame.
    input  wire frames_0,
    input  wire frames_1,
    // Of each processing element: some of its back buffer is still to be sent.
    input  wire sending_0,
    input  wire sending_1,
    input  wire enable,    // The chain advances.
    input  wire blanking,  // The banks may change.
    output wire swap,      // For one clock: exchange the banks.
    output wire merged,    // A frame is stored, and waits for the blanking.
    output reg  shown      // Turns with each swap.
);

    reg [8:0] since;                                             // rtl/src/swap/gfb_swap.rs:61
    reg [7:0] way_left;                                          // rtl/src/swap/gfb_swap.rs:64

    wire all_swapped;                                            // rtl/src/swap/gfb_swap.rs:58
    wire waited = since >= 9'd296;                               // rtl/src/swap/gfb_swap.rs:63
    wire stored = way_left == 8'd0;                              // rtl/src/swap/gfb_swap.rs:65
    assign merged = all_swapped & waited & stored;               // rtl/src/swap/gfb_swap.rs:67
    assign swap = merged & blanking;                             // rtl/src/swap/gfb_swap.rs:56

    genvar i;

    wire [1:0] row_all_swapped_listed = {frames_1, frames_0};
    generate
        for (i = 0; i < 2; i = i + 1) begin : row
            wire all_swapped_listed = row_all_swapped_listed[i];
            wire all_swapped_differs = all_swapped_listed != shown;
        end
    endgenerate

    wire [1:0] all_swapped_lanes;
    generate
        for (i = 0; i < 2; i = i + 1) begin : all_swapped_of
            assign all_swapped_lanes[i] = row[i].all_swapped_differs;
        end
    endgenerate
    assign all_swapped = &all_swapped_lanes;                     // rtl/src/swap/gfb_swap.rs:58

    always @(posedge clk) begin
        if (rst) begin
            shown <= 1'b0;
            since <= 9'd0;
            way_left <= 8'd140;
        end else begin
            if (swap) shown <= !shown;
            if (!all_swapped | swap) since <= 9'd0;
            else if (since != 9'd341) since <= since + 9'd1;
            if (!all_swapped | swap) way_left <= 8'd140;
            else if (enable & !stored) way_left <= way_left - 8'd1;
        end
    end

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
        if (!rst) assert (!swap | (blanking & !(sending_0 | sending_1))); // rtl/src/swap/gfb_swap.rs:70
        if (!rst) assert ((since != 9'd341) | stored);               // rtl/src/swap/gfb_swap.rs:74
        if (!rst) cover (swap);                                      // rtl/src/swap/gfb_swap.rs:75
        if (!rst) cover (merged & !blanking);                        // rtl/src/swap/gfb_swap.rs:76
    end
`else
    reg is_covered;
    initial is_covered = 1'b0;
    reg is_covered_2;
    initial is_covered_2 = 1'b0;
    always @(posedge clk) begin
        if (!rst && !(!swap | (blanking & !(sending_0 | sending_1)))) begin // rtl/src/swap/gfb_swap.rs:70
            $display("FAIL: time %0t: %m: the banks change in a blanking, with all of the frame sent", $time);
            stop;
        end
        if (!rst && !((since != 9'd341) | stored)) begin             // rtl/src/swap/gfb_swap.rs:74
            $display("FAIL: time %0t: %m: all is stored soon after T_m", $time);
            stop;
        end
        if (!rst && swap && !is_covered) begin                       // rtl/src/swap/gfb_swap.rs:75
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: the banks change", $time);
            `endif
            is_covered <= 1'b1;
        end
        if (!rst && (merged & !blanking) && !is_covered_2) begin     // rtl/src/swap/gfb_swap.rs:76
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: a merged frame waits for the blanking", $time);
            `endif
            is_covered_2 <= 1'b1;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, sending_0, sending_1};
endmodule
`default_nettype wire
