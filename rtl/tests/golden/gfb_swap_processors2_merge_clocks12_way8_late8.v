// gfb_swap_processors2_merge_clocks12_way8_late8
//
// Swaps the global frame buffer in a vertical blanking, when a frame is merged.
//
// Parameters  GfbSwap { processors: 2, merge_clocks: 12, way: 8, late: 8 }
// Latency     0 clocks, if all guards are true
// Source      VC-1, section 3.3 and Figure 6, swap of the global frame buffer (VC1-SW2)
// Described   rtl/src/swap/gfb_swap.rs:20
`default_nettype none

module gfb_swap_processors2_merge_clocks12_way8_late8 (
    input  wire clk,
    input  wire rst,
    // For each processing element: toggles with the swap at the end of a frame.
    input  wire frames_0,
    input  wire frames_1,
    // For each processing element: a part of the back buffer is not sent yet.
    input  wire sending_0,
    input  wire sending_1,
    input  wire enable,    // The chain advances.
    input  wire blanking,  // The display is in the part of its vertical blanking in which the banks may change.
    output wire swap,      // For one clock: swap the banks.
    output wire merged,    // A frame is stored, and waits for the blanking.
    output reg  shown      // Toggles with each swap of the global frame buffer.
);

    reg [4:0] since;                                             // rtl/src/swap/gfb_swap.rs:63
    reg [3:0] way_left;                                          // rtl/src/swap/gfb_swap.rs:66

    wire all_swapped;                                            // rtl/src/swap/gfb_swap.rs:60
    wire assumed_all;                                            // rtl/src/swap/gfb_swap.rs:77
    wire waited = since >= 5'd12;                                // rtl/src/swap/gfb_swap.rs:65
    wire stored = way_left == 4'd0;                              // rtl/src/swap/gfb_swap.rs:67
    assign merged = waited & stored;                             // rtl/src/swap/gfb_swap.rs:69
    assign swap = merged & blanking;                             // rtl/src/swap/gfb_swap.rs:57

    genvar i;

    wire [1:0] row_frames = {frames_1, frames_0};
    generate
        for (i = 0; i < 2; i = i + 1) begin : row
            reg frames_past;
            wire frames = row_frames[i];
            wire frames_differs_from_shown = frames != shown;
            wire assumed_or = (frames == frames_past) | (frames != shown);

            always @(posedge clk) begin
                frames_past <= frames;
            end
        end
    endgenerate

    wire [1:0] all_swapped_lanes;
    generate
        for (i = 0; i < 2; i = i + 1) begin : all_swapped_of
            assign all_swapped_lanes[i] = row[i].frames_differs_from_shown;
        end
    endgenerate
    assign all_swapped = &all_swapped_lanes;                     // rtl/src/swap/gfb_swap.rs:60
    wire [1:0] assumed_all_lanes;
    generate
        for (i = 0; i < 2; i = i + 1) begin : assumed_all_of
            assign assumed_all_lanes[i] = row[i].assumed_or;
        end
    endgenerate
    assign assumed_all = &assumed_all_lanes;                     // rtl/src/swap/gfb_swap.rs:77

    always @(posedge clk) begin
        if (rst) begin
            shown <= 1'b0;
            since <= 5'd0;
            way_left <= 4'd8;
        end else begin
            if (swap) shown <= !shown;
            if (!all_swapped | swap) since <= 5'd0;
            else if (since != 5'd20) since <= since + 5'd1;
            if (!all_swapped | swap) way_left <= 4'd8;
            else if (enable & !stored) way_left <= way_left - 4'd1;
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
    reg has_past;                                                // rtl/src/swap/gfb_swap.rs:76

    initial has_past = 1'b0;

    always @(posedge clk) begin
        if (rst) has_past <= 1'b0;
        else has_past <= 1'b1;
    end

`ifdef FORMAL
    always @(posedge clk) begin
        if (!rst) assert (!swap | (blanking & stored));              // rtl/src/swap/gfb_swap.rs:72
        if (!rst) assume (!swap | !(sending_0 | sending_1));         // rtl/src/swap/gfb_swap.rs:73
        if (!rst) assert ((since != 5'd20) | stored);                // rtl/src/swap/gfb_swap.rs:74
        if (!rst) assert (!merged | all_swapped);                    // rtl/src/swap/gfb_swap.rs:75
        if (!rst) assume (!has_past | assumed_all);                  // rtl/src/swap/gfb_swap.rs:76
        if (!rst) cover (swap);                                      // rtl/src/swap/gfb_swap.rs:80
        if (!rst) cover (merged & !blanking);                        // rtl/src/swap/gfb_swap.rs:81
    end
`else
    reg is_covered;
    initial is_covered = 1'b0;
    reg is_covered_2;
    initial is_covered_2 = 1'b0;
    always @(posedge clk) begin
        if (!rst && !(!swap | (blanking & stored))) begin            // rtl/src/swap/gfb_swap.rs:72
            $display("FAIL: time %0t: %m: the banks change in a blanking, with all of the frame stored", $time);
            stop;
        end
        if (!rst && !(!swap | !(sending_0 | sending_1))) begin       // rtl/src/swap/gfb_swap.rs:73
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: all of a frame is sent before the banks change", $time);
            stop;
        end
        if (!rst && !((since != 5'd20) | stored)) begin              // rtl/src/swap/gfb_swap.rs:74
            $display("FAIL: time %0t: %m: the frame is stored soon after T_m", $time);
            stop;
        end
        if (!rst && !(!merged | all_swapped)) begin                  // rtl/src/swap/gfb_swap.rs:75
            $display("FAIL: time %0t: %m: a frame is merged only after all have ended it", $time);
            stop;
        end
        if (!rst && !(!has_past | assumed_all)) begin                // rtl/src/swap/gfb_swap.rs:76
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a frame ends only when the previous one is on display", $time);
            stop;
        end
        if (!rst && swap && !is_covered) begin                       // rtl/src/swap/gfb_swap.rs:80
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: the banks change", $time);
            `endif
            is_covered <= 1'b1;
        end
        if (!rst && (merged & !blanking) && !is_covered_2) begin     // rtl/src/swap/gfb_swap.rs:81
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: a merged frame waits for the blanking", $time);
            `endif
            is_covered_2 <= 1'b1;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, sending_0, sending_1, assumed_all};
endmodule
`default_nettype wire
