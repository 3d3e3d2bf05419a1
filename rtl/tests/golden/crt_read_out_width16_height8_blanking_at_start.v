// crt_read_out_width16_height8_blanking_at_start
//
// Reads the bank on display, refresh after refresh.
//
// Parameters  CrtReadOut { screen: Screen { width: 16, height: 8 }, blanking: AtStart }
// Latency     0 clocks; 1 clock from an address to its pixel; a refresh of 9328 clocks
// Source      VC-1, section 3.3, display of the global frame buffer (VC1-GFB, VC1-SW2, VC1-59)
// Described   rtl/src/gfb/crt.rs:68
`default_nettype none

module crt_read_out_width16_height8_blanking_at_start (
    input  wire        clk,
    input  wire        rst,
    input  wire [47:0] word,        // The word of the pixel at the address of the previous clock.
    output reg  [6:0]  address,     // The number of the pixel to read, in raster order.
    // The outputs to the display.
    output wire        pixel_valid, // The display gets a pixel in this clock.
    output wire [23:0] pixel_rgb,   // The colour of the pixel.
    output wire        dark,        // The vertical blanking: no pixel is read.
    output reg         window       // The banks may change.
);

    reg [7:0] x;                                                 // rtl/src/gfb/crt.rs:113
    reg [5:0] y;                                                 // rtl/src/gfb/crt.rs:114
    reg valid;                                                   // rtl/src/gfb/crt.rs:124

    wire line_ends = x == 8'd175;                                // rtl/src/gfb/crt.rs:115
    wire last_line = y == 6'd52;                                 // rtl/src/gfb/crt.rs:116
    assign dark = y >= 6'd8;                                     // rtl/src/gfb/crt.rs:120
    wire reads = (x < 8'd16) & !dark;                            // rtl/src/gfb/crt.rs:121
    assign pixel_rgb = word[23:0];                               // rtl/src/gfb/crt.rs:135

    always @(posedge clk) begin
        if (rst) begin
            x <= 8'd0;
            y <= 6'd8;
            address <= 7'd0;
            valid <= 1'b0;
            window <= 1'b0;
        end else begin
            if (line_ends) x <= 8'd0;
            else x <= x + 8'd1;
            if (line_ends & last_line) y <= 6'd0;
            else if (line_ends) y <= y + 6'd1;
            if (dark) address <= 7'd0;
            else if (reads) address <= address + 7'd1;
            valid <= reads;
            window <= y == 6'd8;
        end
    end

    assign pixel_valid = valid;

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
        if (!rst) assert (!window | dark);                           // rtl/src/gfb/crt.rs:134
    end
`else
    always @(posedge clk) begin
        if (!rst && !(!window | dark)) begin                         // rtl/src/gfb/crt.rs:134
            $display("FAIL: time %0t: %m: the banks change in a blanking", $time);
            stop;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, word[47:24]};
endmodule
`default_nettype wire
