// video_controller_format8x8_2x2_edges3
//
// Reads the picture from the video buffers, line by line.
//
// Parameters  VideoController { format: "8x8_2x2_edges3" }
// Latency     2 clocks from `start` to the first pixels, then p pixels a clock
// Source      sparse-raster quadtree generator, figure 1 (MPG-ARCH, MPG-SPR)
// Described   rtl/src/quadtree/controller.rs:19
`default_nettype none

module video_controller_format8x8_2x2_edges3 (
    input  wire         clk,
    input  wire         rst,
    // The settings of the read-out.
    input  wire         show_start,      // High for one clock to read a picture; only while no picture is being read.
    // Each pixel is cleared when it is read; constant while a picture is being read.
    input  wire         show_clear,
    input  wire [23:0]  show_background, // The colour of pixels where nothing was drawn.
    input  wire [191:0] words,           // The words sent by the video buffers, row by row of the matrix.
    input  wire         pixels_ready,
    // The pixel that each video buffer is to send.
    // A pixel is sent; while `enable` is low, the word sent stays until the banks are exchanged.
    output wire [3:0]   scan_enable,
    output wire [7:0]   scan_x,          // The pixel's column among those of the video processor.
    output wire [7:0]   scan_y,          // The pixel's line among those of the video processor.
    output wire [3:0]   scan_clear,      // The pixel is cleared when it is read.
    // Groups of p neighbouring pixels; the last group of a line may extend beyond the line's end.
    output wire         pixels_valid,
    output wire [95:0]  pixels_payload,
    output wire         busy             // A picture is being read.
);

    reg reading;                                                 // rtl/src/quadtree/controller.rs:59
    reg [1:0] column;                                            // rtl/src/quadtree/controller.rs:60
    reg [2:0] line;                                              // rtl/src/quadtree/controller.rs:61
    reg arrived;                                                 // rtl/src/quadtree/controller.rs:62
    reg asked_row;                                               // rtl/src/quadtree/controller.rs:75

    wire arrived_row = asked_row;                                // rtl/src/quadtree/controller.rs:67
    wire pixels_taken = arrived & pixels_ready;                  // rtl/src/quadtree/controller.rs:71
    wire asks = reading & (!arrived | pixels_taken);             // rtl/src/quadtree/controller.rs:72
    wire line_ends = asks & (column == 2'd3);                    // rtl/src/quadtree/controller.rs:73
    wire ends = line_ends & (line == 3'd7);                      // rtl/src/quadtree/controller.rs:74
    assign busy = reading | arrived;                             // rtl/src/quadtree/controller.rs:89
    assign scan_x = {4{column}};                                 // rtl/src/quadtree/controller.rs:85
    assign scan_y = {4{line[2:1]}};                              // rtl/src/quadtree/controller.rs:86
    assign scan_clear = {4{show_clear}};                         // rtl/src/quadtree/controller.rs:87

    genvar i;
    genvar j;

    generate
        for (i = 0; i < 2; i = i + 1) begin : pixels_payload_picked_row
            wire [47:0] pixels_payload_picked;
            wire [47:0] pixels_payload_picked_lanes [0:1];
            for (j = 0; j < 2; j = j + 1) begin : pixels_payload_picked_of
                assign pixels_payload_picked_lanes[j] = words[(j * 2 + i) * 48 +: 48];
            end
            assign pixels_payload_picked = pixels_payload_picked_lanes[arrived_row];
            wire [47:0] pixels_payload_choice = (&pixels_payload_picked) ? {24'hffffff, show_background} : pixels_payload_picked;
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : scan_enable_listed_row
            localparam [31:0] scan_enable_listed = i / 2;
            wire scan_enable_and = asks & (scan_enable_listed[0] == line[0]);
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : scan_enable_of
            assign scan_enable[i] = scan_enable_listed_row[i].scan_enable_and;
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : pixels_payload_of
            assign pixels_payload[i * 48 +: 48] = pixels_payload_picked_row[i].pixels_payload_choice;
        end
    endgenerate

    always @(posedge clk) begin
        if (asks) asked_row <= line[0];
    end

    always @(posedge clk) begin
        if (rst) begin
            reading <= 1'b0;
            column <= 2'd0;
            line <= 3'd0;
            arrived <= 1'b0;
        end else begin
            if (show_start) reading <= 1'b1;
            else if (ends) reading <= 1'b0;
            if (show_start | line_ends) column <= 2'd0;
            else if (asks) column <= column + 2'd1;
            if (show_start) line <= 3'd0;
            else if (line_ends) line <= line + 3'd1;
            if (asks) arrived <= 1'b1;
            else if (pixels_taken) arrived <= 1'b0;
        end
    end

    assign pixels_valid = arrived;

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
        if (!rst) assume (!show_start | (!reading & !arrived));      // rtl/src/quadtree/controller.rs:80
    end
`else
    always @(posedge clk) begin
        if (!rst && !(!show_start | (!reading & !arrived))) begin    // rtl/src/quadtree/controller.rs:80
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a picture is requested only while none is being read", $time);
            stop;
        end
    end
`endif
`endif
endmodule
`default_nettype wire
