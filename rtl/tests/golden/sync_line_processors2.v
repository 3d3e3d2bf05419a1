// sync_line_processors2
//
// One bit that is high unless a processing element, the bus or the host pulls it low.
//
// Parameters  SyncLine { processors: 2 }
// Latency     0 clocks; 0 clocks
// Source      VC-1, sections 3.1 and 4, sync line (VC1-NET, VC1-SW1)
// Described   rtl/src/swap/sync_line.rs:15
`default_nettype none

module sync_line_processors2 (
    input  wire clk,
    input  wire rst,
    // For each processing element: the frame is drawn, and the last swap is over.
    input  wire ready_0,
    input  wire ready_1,
    input  wire bus,     // The broadcast bus is idle.
    input  wire host,    // The host releases the sync line.
    output wire line     // The sync line: high unless a unit pulls it low.
);

    assign line = ready_0 & ready_1 & bus & host;                // rtl/src/swap/sync_line.rs:40

`ifndef SYNTHESIS
    reg line_past;                                               // rtl/src/swap/sync_line.rs:41
    reg has_past;                                                // rtl/src/swap/sync_line.rs:41

    initial has_past = 1'b0;

    always @(posedge clk) begin
        line_past <= line;
    end

    always @(posedge clk) begin
        if (rst) has_past <= 1'b0;
        else has_past <= 1'b1;
    end

`ifdef FORMAL
    always @(posedge clk) begin
        if (!rst) cover (has_past & (line & !line_past));            // rtl/src/swap/sync_line.rs:41
    end
`else
    reg is_covered;
    initial is_covered = 1'b0;
    always @(posedge clk) begin
        if (!rst && (has_past & (line & !line_past)) && !is_covered) begin // rtl/src/swap/sync_line.rs:41
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: all have drawn a frame", $time);
            `endif
            is_covered <= 1'b1;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, clk, rst};
endmodule
`default_nettype wire
