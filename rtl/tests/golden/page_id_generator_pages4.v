// page_id_generator_pages4
//
// Names the next free page of an image memory: 0, 1, 2 ..
//
// Parameters  PageIdGenerator { pages: 4 }
// Latency     1 clock
// Source      VC-1, section 3.3, page ID generator (VC1-PIG)
// Described   rtl/src/lfb/page_id_generator.rs:17
`default_nettype none

module page_id_generator_pages4 (
    input  wire       clk,
    input  wire       rst,
    input  wire       restart,   // Frees all pages, with priority over `take`.
    input  wire       take,      // Takes the next free page.
    output wire [1:0] page,      // The next free page, unless all are taken.
    output reg  [2:0] used,      // The number of pages taken.
    output wire       exhausted  // All pages are taken.
);

    assign exhausted = used == 3'd4;                             // rtl/src/lfb/page_id_generator.rs:45
    assign page = used[1:0];                                     // rtl/src/lfb/page_id_generator.rs:50

    always @(posedge clk) begin
        if (rst) used <= 3'd0;
        else if (restart) used <= 3'd0;
        else if (take) used <= used + 3'd1;
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
    reg restart_past;                                            // rtl/src/lfb/page_id_generator.rs:48
    reg exhausted_past;                                          // rtl/src/lfb/page_id_generator.rs:49
    reg has_past;                                                // rtl/src/lfb/page_id_generator.rs:48

    initial has_past = 1'b0;

    always @(posedge clk) begin
        restart_past <= restart;
        exhausted_past <= exhausted;
    end

    always @(posedge clk) begin
        if (rst) has_past <= 1'b0;
        else has_past <= 1'b1;
    end

`ifdef FORMAL
    always @(posedge clk) begin
        if (!rst) assume (!take | !exhausted);                       // rtl/src/lfb/page_id_generator.rs:46
        if (!rst) assert (!has_past | (!restart_past | (used == 3'd0))); // rtl/src/lfb/page_id_generator.rs:48
        if (!rst) cover (has_past & (exhausted & !exhausted_past));  // rtl/src/lfb/page_id_generator.rs:49
    end
`else
    reg is_covered;
    initial is_covered = 1'b0;
    always @(posedge clk) begin
        if (!rst && !(!take | !exhausted)) begin                     // rtl/src/lfb/page_id_generator.rs:46
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a page is taken only while one is free", $time);
            stop;
        end
        if (!rst && !(!has_past | (!restart_past | (used == 3'd0)))) begin // rtl/src/lfb/page_id_generator.rs:48
            $display("FAIL: time %0t: %m: a restart frees all pages", $time);
            stop;
        end
        if (!rst && (has_past & (exhausted & !exhausted_past)) && !is_covered) begin // rtl/src/lfb/page_id_generator.rs:49
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: all pages are taken", $time);
            `endif
            is_covered <= 1'b1;
        end
    end
`endif
`endif
endmodule
`default_nettype wire
