// frame_buffer_width16_height8_side8
//
// Assembles the picture from regions.
//
// Parameters  FrameBuffer { screen: Screen { width: 16, height: 8 }, side: 8 }
// Latency     1 clock from a line's last plane to the memory, 1 clock to read
// Source      Pixel-planes 5, section I.3.2.1 (PP5-ARCH)
// Described   rtl/src/pixel_planes/frame_buffer.rs:21
`default_nettype none

module frame_buffer_width16_height8_side8 (
    input  wire         clk,
    input  wire         rst,
    // Lines of regions, plane by plane; each is taken at once.
    input  wire         planes_valid,
    input  wire [15:0]  planes_region, // The number of the region.
    input  wire [2:0]   planes_line,   // The line of the region.
    input  wire [5:0]   planes_plane,  // The number of the bit in the visibility word.
    input  wire [7:0]   planes_bits,   // The plane's bit of each pixel of the line, from the left.
    // A line of a region to read.
    input  wire         read_enable,   // A line is read; while `enable` is low, the words keep their values.
    input  wire         read_region,   // The number of the region.
    input  wire [2:0]   read_line,     // The line of the region.
    output wire [383:0] words,         // The words of the pixels of the line that was read.
    output wire         planes_ready
);

    (* no_rw_check *)
    reg [383:0] lines [0:15];                                    // rtl/src/pixel_planes/frame_buffer.rs:79
    reg [383:0] lines_read;                                      // rtl/src/pixel_planes/frame_buffer.rs:88

    wire [383:0] lines_write_data;                               // rtl/src/pixel_planes/frame_buffer.rs:76
    assign planes_ready = 1'b1;                                  // rtl/src/pixel_planes/frame_buffer.rs:74

    genvar i;

    generate
        for (i = 0; i < 8; i = i + 1) begin : row
            reg [46:0] so_far;
            wire [47:0] word = {planes_bits[i], so_far};

            always @(posedge clk) begin
                if (planes_valid) so_far <= word[47:1];
            end
        end
    endgenerate

    generate
        for (i = 0; i < 8; i = i + 1) begin : lines_write_data_of
            assign lines_write_data[i * 48 +: 48] = row[i].word;
        end
    endgenerate

    always @(posedge clk) begin
        if (planes_valid & (planes_plane == 6'd47)) lines[{planes_region[0], planes_line}] <= lines_write_data;
        if (read_enable) lines_read <= lines[{read_region, read_line}];
    end

    assign words = lines_read;

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
    reg [5:0] next;                                              // rtl/src/pixel_planes/frame_buffer.rs:84

    always @(posedge clk) begin
        if (rst) begin
            next <= 6'd0;
        end else if (planes_valid) begin
            if (next == 6'd47) next <= 6'd0;
            else next <= next + 6'd1;
        end
    end

`ifdef FORMAL
    always @(posedge clk) begin
        if (!rst) assume (!planes_valid | (planes_plane == next));   // rtl/src/pixel_planes/frame_buffer.rs:86
        if (!rst) assume (!planes_valid | (planes_region < 16'd2));  // rtl/src/pixel_planes/frame_buffer.rs:87
    end
`else
    always @(posedge clk) begin
        if (!rst && !(!planes_valid | (planes_plane == next))) begin // rtl/src/pixel_planes/frame_buffer.rs:86
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: the planes of a line arrive in sequence", $time);
            stop;
        end
        if (!rst && !(!planes_valid | (planes_region < 16'd2))) begin // rtl/src/pixel_planes/frame_buffer.rs:87
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: the region belongs to the screen", $time);
            stop;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, rst, planes_region[15:1]};
endmodule
`default_nettype wire
