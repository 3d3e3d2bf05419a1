// multipass_control
//
// Decides when a pass is added up, when the average is shown, and when the banks may change.
//
// Parameters  MultipassControl
// Latency     0 clocks from a swap to its sum; 1 clock from the blanking to the average
// Source      VC-1, section 3.3, accumulation buffer (VC1-ACB)
// Described   rtl/src/gfb/multipass.rs:63
`default_nettype none

module multipass_control (
    input  wire       clk,
    input  wire       rst,
    input  wire       swap,             // High for one clock when the banks are exchanged.
    // The settings from the host.
    input  wire       host_accumulates, // The next picture is the average of several passes.
    input  wire [1:0] host_passes,      // The number of passes of the next picture: a code of `Passes`.
    input  wire       busy,             // A sum is under way.
    input  wire       blanking,         // The display is in the part of its blanking in which its source may change.
    output wire       start,            // High for one clock when a sum starts.
    output wire       first,            // The sum that begins with `start` is that of the first pass of a picture.
    output reg  [1:0] passes,           // The number of passes of the picture being made or shown: a code of `Passes`.
    output reg        averages,         // The average is shown.
    output wire       may_swap          // The banks may change.
);

    localparam [1:0] PASSES_TWO   = 2'd0;
    localparam [1:0] PASSES_FOUR  = 2'd1;
    localparam [1:0] PASSES_EIGHT = 2'd2;
    // Not used here: PASSES_SIXTEEN = 3.
    localparam [1:0] STAGE_PASS     = 2'd0;
    localparam [1:0] STAGE_LAST_SUM = 2'd1;
    localparam [1:0] STAGE_TURN     = 2'd2;
    localparam [1:0] STAGE_AVERAGE  = 2'd3;

    reg [3:0] number;                                            // rtl/src/gfb/multipass.rs:96
    reg [1:0] stage;                                             // rtl/src/gfb/multipass.rs:105

    assign first = number == 4'd0;                               // rtl/src/gfb/multipass.rs:97
    assign start = swap & (host_accumulates | !first);           // rtl/src/gfb/multipass.rs:98
    reg [3:0] last_choice;                                       // rtl/src/gfb/multipass.rs:101
    always @* begin
        case (passes)
            PASSES_TWO: last_choice = 4'd1;
            PASSES_FOUR: last_choice = 4'd3;
            PASSES_EIGHT: last_choice = 4'd7;
            default: last_choice = 4'd15; // PASSES_SIXTEEN
        endcase
    end
    wire last = number == last_choice;                           // rtl/src/gfb/multipass.rs:101
    wire summed = (stage == STAGE_LAST_SUM) & !busy;             // rtl/src/gfb/multipass.rs:106
    wire may_change = ((stage == STAGE_PASS) & !busy) | (stage == STAGE_AVERAGE); // rtl/src/gfb/multipass.rs:115
    assign may_swap = blanking & may_change;                     // rtl/src/gfb/multipass.rs:132

    always @(posedge clk) begin
        if (rst) begin
            number <= 4'd0;
            passes <= PASSES_TWO;
            stage <= STAGE_PASS;
            averages <= 1'b0;
        end else begin
            if (start & last) number <= 4'd0;
            else if (start) number <= number + 4'd1;
            if (start & first) passes <= host_passes;
            case (stage)
                STAGE_PASS: if (start & last) stage <= STAGE_LAST_SUM;
                STAGE_LAST_SUM: if (summed & blanking) stage <= STAGE_TURN;
                STAGE_TURN: if (!blanking) stage <= STAGE_AVERAGE;
                default: begin // STAGE_AVERAGE
                    if (swap) stage <= STAGE_PASS;
                    else stage <= STAGE_AVERAGE;
                end
            endcase
            if (summed & blanking) averages <= 1'b1;
            else if (swap) averages <= 1'b0;
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
    reg busy_past;                                               // rtl/src/gfb/multipass.rs:118
    reg start_past;                                              // rtl/src/gfb/multipass.rs:118
    reg has_past;                                                // rtl/src/gfb/multipass.rs:118

    initial has_past = 1'b0;

    always @(posedge clk) begin
        busy_past <= busy;
        start_past <= start;
    end

    always @(posedge clk) begin
        if (rst) has_past <= 1'b0;
        else has_past <= 1'b1;
    end

`ifdef FORMAL
    always @(posedge clk) begin
        if (!rst) assume (!swap | !busy);                            // rtl/src/gfb/multipass.rs:117
        if (!rst) assume (!has_past | (!(busy & !busy_past) | start_past)); // rtl/src/gfb/multipass.rs:118
        if (!rst) assume (!swap | ((stage != STAGE_LAST_SUM) & (stage != STAGE_TURN))); // rtl/src/gfb/multipass.rs:119
        if (!rst) assert (averages == ((stage == STAGE_TURN) | (stage == STAGE_AVERAGE))); // rtl/src/gfb/multipass.rs:123
        if (!rst) assert (!averages | !busy);                        // rtl/src/gfb/multipass.rs:127
        if (!rst) cover (start & averages);                          // rtl/src/gfb/multipass.rs:128
        if (!rst) cover (swap & !start & averages);                  // rtl/src/gfb/multipass.rs:129
        if (!rst) cover (summed & !blanking);                        // rtl/src/gfb/multipass.rs:130
        if (!rst) cover (blanking & busy);                           // rtl/src/gfb/multipass.rs:131
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
    always @(posedge clk) begin
        if (!rst && !(!swap | !busy)) begin                          // rtl/src/gfb/multipass.rs:117
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: the banks do not change while a sum is under way", $time);
            stop;
        end
        if (!rst && !(!has_past | (!(busy & !busy_past) | start_past))) begin // rtl/src/gfb/multipass.rs:118
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a sum gets under way in the clock after its start", $time);
            stop;
        end
        if (!rst && !(!swap | ((stage != STAGE_LAST_SUM) & (stage != STAGE_TURN)))) begin // rtl/src/gfb/multipass.rs:119
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: the banks do not change before the average has been shown for a whole refresh", $time);
            stop;
        end
        if (!rst && !(averages == ((stage == STAGE_TURN) | (stage == STAGE_AVERAGE)))) begin // rtl/src/gfb/multipass.rs:123
            $display("FAIL: time %0t: %m: the average is shown when the sum of all passes is complete", $time);
            stop;
        end
        if (!rst && !(!averages | !busy)) begin                      // rtl/src/gfb/multipass.rs:127
            $display("FAIL: time %0t: %m: no sum is under way while its average is shown", $time);
            stop;
        end
        if (!rst && (start & averages) && !is_covered) begin         // rtl/src/gfb/multipass.rs:128
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: a picture begins while the average of the previous one is shown", $time);
            `endif
            is_covered <= 1'b1;
        end
        if (!rst && (swap & !start & averages) && !is_covered_2) begin // rtl/src/gfb/multipass.rs:129
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: a frame without accumulation follows an average", $time);
            `endif
            is_covered_2 <= 1'b1;
        end
        if (!rst && (summed & !blanking) && !is_covered_3) begin     // rtl/src/gfb/multipass.rs:130
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: a last sum waits for the blanking", $time);
            `endif
            is_covered_3 <= 1'b1;
        end
        if (!rst && (blanking & busy) && !is_covered_4) begin        // rtl/src/gfb/multipass.rs:131
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: a blanking passes while a sum is under way", $time);
            `endif
            is_covered_4 <= 1'b1;
        end
    end
`endif
`endif
endmodule
`default_nettype wire
