// scan_counter_width16_height8
//
// Counts the pixels of the screen in raster order from a preset on, frame after frame.
//
// Parameters  ScanCounter { screen: Screen { width: 16, height: 8 } }
// Latency     1 clock
// Source      VC-1, section 3.3, scan counter (VC1-SCAN)
// Described   rtl/src/lfb/scan_counter.rs:24
`default_nettype none

module scan_counter_width16_height8 (
    input  wire       clk,
    input  wire       rst,
    // The control of the scan, from the global frame buffer.
    input  wire       scan_restart, // High for one clock: every scan counter loads its preset.
    // The counters, the read-out and the merging units advance by a pixel; while `enable` is low, they keep their
    // values.
    input  wire       scan_enable,
    // The pixel to which a restart sets the counter; a constant.
    input  wire [3:0] preset_x,     // The column of the pixel, counted from the left.
    input  wire [2:0] preset_y,     // The line of the pixel, counted from the top.
    // The pixel to send.
    output wire [3:0] pixel_x,      // The column of the pixel, counted from the left.
    output wire [2:0] pixel_y,      // The line of the pixel, counted from the top.
    output reg        armed         // The pixel belongs to the first whole frame after the restart, or to a later one.
);

    reg [3:0] x;                                                 // rtl/src/lfb/scan_counter.rs:57
    reg [2:0] y;                                                 // rtl/src/lfb/scan_counter.rs:58

    wire line_end = scan_enable & (x == 4'd15);                  // rtl/src/lfb/scan_counter.rs:60
    wire last_line = y == 3'd7;                                  // rtl/src/lfb/scan_counter.rs:61
    wire frame_end = line_end & last_line;                       // rtl/src/lfb/scan_counter.rs:62
    wire at_start = (preset_x == 4'd0) & (preset_y == 3'd0);     // rtl/src/lfb/scan_counter.rs:66

    always @(posedge clk) begin
        if (rst) begin
            x <= 4'd0;
            y <= 3'd0;
            armed <= 1'b0;
        end else begin
            if (scan_restart) x <= preset_x;
            else if (line_end) x <= 4'd0;
            else if (scan_enable) x <= x + 4'd1;
            if (scan_restart) y <= preset_y;
            else if (frame_end) y <= 3'd0;
            else if (line_end) y <= y + 3'd1;
            if (scan_restart) armed <= at_start;
            else if (frame_end) armed <= 1'b1;
        end
    end

    assign pixel_x = x;
    assign pixel_y = y;

`ifndef SYNTHESIS
`ifdef FORMAL
    always @(posedge clk) begin
        if (!rst) cover (frame_end & armed);                         // rtl/src/lfb/scan_counter.rs:68
    end
`else
    reg is_covered;
    initial is_covered = 1'b0;
    always @(posedge clk) begin
        if (!rst && (frame_end & armed) && !is_covered) begin        // rtl/src/lfb/scan_counter.rs:68
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: a whole frame is sent", $time);
            `endif
            is_covered <= 1'b1;
        end
    end
`endif
`endif
endmodule
`default_nettype wire
