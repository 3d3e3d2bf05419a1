// backing_store_side8
//
// Stores a finished region, and sends it line by line while the next one is drawn.
//
// Parameters  BackingStore { side: 8 }
// Latency     2 clocks from the last plane; a region is sent in 384 clocks
// Source      Pixel-planes 5, section I.3.2.1 (PP5-ARCH)
// Described   rtl/src/pixel_planes/backing_store.rs:22
`default_nettype none

module backing_store_side8 (
    input  wire        clk,
    input  wire        rst,
    // The commands of the controller.
    input  wire        save_claim,    // A region is about to be saved: the store is no longer free.
    input  wire [15:0] save_region,   // The number of the region to save.
    // The pixels read a plane of the region; their write address is the plane's number.
    input  wire        save_plane,
    input  wire [5:0]  number,        // The number of the plane that arrives.
    input  wire [63:0] word,          // The bits of the plane that arrives, a row for each line.
    input  wire        planes_ready,
    output reg         free,          // The store can take a region.
    // The planes of the region, line by line.
    output wire        planes_valid,
    output wire [15:0] planes_region, // The number of the region.
    output wire [2:0]  planes_line,   // The line of the region.
    output wire [5:0]  planes_plane,  // The number of the bit in the visibility word.
    output wire [7:0]  planes_bits    // The plane's bit of each pixel of the line, from the left.
);

    reg [15:0] region;                                           // rtl/src/pixel_planes/backing_store.rs:65
    reg reading;                                                 // rtl/src/pixel_planes/backing_store.rs:72
    reg [5:0] plane;                                             // rtl/src/pixel_planes/backing_store.rs:73
    reg [2:0] line;                                              // rtl/src/pixel_planes/backing_store.rs:74
    reg arrived;                                                 // rtl/src/pixel_planes/backing_store.rs:75
    reg [5:0] read_plane;                                        // rtl/src/pixel_planes/backing_store.rs:79
    reg [2:0] read_line;                                         // rtl/src/pixel_planes/backing_store.rs:79

    reg [63:0] bits [0:47];                                      // rtl/src/pixel_planes/backing_store.rs:67
    reg [63:0] bits_read_word;
    reg bits_read_inside;
    wire [63:0] bits_read = bits_read_inside ? bits_read_word : 64'd0;

    wire complete = save_plane & (number == 6'd47);              // rtl/src/pixel_planes/backing_store.rs:69
    wire planes_taken = arrived & planes_ready;                  // rtl/src/pixel_planes/backing_store.rs:82
    wire reads = reading & (!arrived | planes_taken);            // rtl/src/pixel_planes/backing_store.rs:76
    wire line_ends = reads & (plane == 6'd47);                   // rtl/src/pixel_planes/backing_store.rs:84
    wire ends = line_ends & (line == 3'd7);                      // rtl/src/pixel_planes/backing_store.rs:85

    genvar i;
    genvar j;

    generate
        for (i = 0; i < 8; i = i + 1) begin : row
            wire planes_bits_picked;
            wire [7:0] planes_bits_picked_lanes;
            for (j = 0; j < 8; j = j + 1) begin : planes_bits_picked_of
                assign planes_bits_picked_lanes[j] = bits_read[j * 8 + i];
            end
            assign planes_bits_picked = planes_bits_picked_lanes[read_line];
        end
    endgenerate

    generate
        for (i = 0; i < 8; i = i + 1) begin : planes_bits_of
            assign planes_bits[i] = row[i].planes_bits_picked;
        end
    endgenerate

    always @(posedge clk) begin
        if (save_plane) bits[number] <= word;
        if (reads) begin
            bits_read_word <= bits[plane];
            bits_read_inside <= plane < 6'd48;
        end
    end

    always @(posedge clk) begin
        if (save_claim) region <= save_region;
    end

    always @(posedge clk) begin
        if (reads) begin
            read_plane <= plane;
            read_line <= line;
        end
    end

    always @(posedge clk) begin
        if (rst) begin
            free <= 1'b1;
            reading <= 1'b0;
            plane <= 6'd0;
            line <= 3'd0;
            arrived <= 1'b0;
        end else begin
            if (save_claim) free <= 1'b0;
            else if (planes_taken & !reading) free <= 1'b1;
            if (complete) reading <= 1'b1;
            else if (ends) reading <= 1'b0;
            if (line_ends) plane <= 6'd0;
            else if (reads) plane <= plane + 6'd1;
            if (line_ends) line <= line + 3'd1;
            if (reads) arrived <= 1'b1;
            else if (planes_taken) arrived <= 1'b0;
        end
    end

    assign planes_valid = arrived;
    assign planes_region = region;
    assign planes_line = read_line;
    assign planes_plane = read_plane;

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
        if (!rst) assume (!save_claim | free);                       // rtl/src/pixel_planes/backing_store.rs:92
        if (!rst) assume (!save_plane | (!free & !reading & !arrived)); // rtl/src/pixel_planes/backing_store.rs:93
    end
`else
    always @(posedge clk) begin
        if (!rst && !(!save_claim | free)) begin                     // rtl/src/pixel_planes/backing_store.rs:92
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a region is claimed only when the previous one has left", $time);
            stop;
        end
        if (!rst && !(!save_plane | (!free & !reading & !arrived))) begin // rtl/src/pixel_planes/backing_store.rs:93
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a plane arrives only for a region that was claimed", $time);
            stop;
        end
    end
`endif
`endif
endmodule
`default_nettype wire
