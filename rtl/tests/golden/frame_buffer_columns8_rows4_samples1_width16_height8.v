// frame_buffer_columns8_rows4_samples1_width16_height8
//
// Stores frames of a screen region by region, and scans them out.
//
// Parameters  FrameBuffer { columns: 8, rows: 4, samples: 1, screen: Screen { width: 16, height: 8 } }
// Latency     51 clocks for a region
// Source      Reducing Latency on PixelFlow, section 4 (PFL-LOAD)
// Described   rtl/src/pixelflow/frame_buffer.rs:46
`default_nettype none

module frame_buffer_columns8_rows4_samples1_width16_height8 (
    input  wire        clk,
    input  wire        rst,
    input  wire        start,        // For one clock: take the next region.
    input  wire [15:0] seen,         // The byte of each chip that the port addresses.
    input  wire        pixels_ready,
    // The access to the node's registers.
    output wire [3:0]  port_pixel,   // The pixel of each chip, counted line by line.
    output wire [5:0]  port_address, // The register of the pixel.
    output wire        port_writes,  // The register is written.
    output wire [15:0] port_bytes,   // The bytes to write, one of each chip.
    output wire        done,         // For one clock: the frame buffer has the region.
    // The pixels of the displayed frame.
    output wire        pixels_valid,
    output wire [7:0]  pixels_red,   // The red of the pixel.
    output wire [7:0]  pixels_green, // The green of the pixel.
    output wire [7:0]  pixels_blue,  // The blue of the pixel.
    output wire        pixels_first, // The pixel is the first of a frame.
    output wire        pixels_last   // The pixel is the last of a line.
);

    reg shown;                                                   // rtl/src/pixelflow/frame_buffer.rs:190
    reg is_whole;                                                // rtl/src/pixelflow/frame_buffer.rs:191
    reg busy;                                                    // rtl/src/pixelflow/frame_buffer.rs:198
    reg [2:0] clock;                                             // rtl/src/pixelflow/frame_buffer.rs:199
    reg [4:0] pixel;                                             // rtl/src/pixelflow/frame_buffer.rs:200
    reg [1:0] region;                                            // rtl/src/pixelflow/frame_buffer.rs:201
    reg [3:0] x;                                                 // rtl/src/pixelflow/frame_buffer.rs:226
    reg [2:0] y;                                                 // rtl/src/pixelflow/frame_buffer.rs:227
    reg [2:0] left;                                              // rtl/src/pixelflow/frame_buffer.rs:228
    reg has_frame;                                               // rtl/src/pixelflow/frame_buffer.rs:229
    reg arrived;                                                 // rtl/src/pixelflow/frame_buffer.rs:236
    reg is_odd;                                                  // rtl/src/pixelflow/frame_buffer.rs:256
    reg first;                                                   // rtl/src/pixelflow/frame_buffer.rs:256
    reg last;                                                    // rtl/src/pixelflow/frame_buffer.rs:256

    (* no_rw_check *)
    reg [23:0] even [0:127];                                     // rtl/src/pixelflow/frame_buffer.rs:189
    reg [23:0] even_read;                                        // rtl/src/pixelflow/frame_buffer.rs:254
    (* no_rw_check *)
    reg [23:0] odd [0:127];                                      // rtl/src/pixelflow/frame_buffer.rs:189
    reg [23:0] odd_read;                                         // rtl/src/pixelflow/frame_buffer.rs:254

    wire runs = busy & !(is_whole & (region == 2'd0));           // rtl/src/pixelflow/frame_buffer.rs:203
    wire turn_ends = runs & (clock == 3'd2);                     // rtl/src/pixelflow/frame_buffer.rs:204
    wire ends = turn_ends & (pixel == 5'd16);                    // rtl/src/pixelflow/frame_buffer.rs:205
    wire is_last = region == 2'd3;                               // rtl/src/pixelflow/frame_buffer.rs:206
    wire reads = runs & (clock < 3'd3) & (pixel < 5'd16);        // rtl/src/pixelflow/frame_buffer.rs:212
    wire stores = runs & (pixel != 5'd0) & (clock < 3'd1);       // rtl/src/pixelflow/frame_buffer.rs:216
    wire [4:0] pixel_minus_1 = pixel - 5'd1;                     // rtl/src/pixelflow/frame_buffer.rs:217
    wire [2:0] stores_at_choice = !shown ? ({1'd0, region} + 3'd4) : {1'd0, region}; // rtl/src/pixelflow/frame_buffer.rs:194
    wire [6:0] stores_at = {stores_at_choice, pixel_minus_1[3:0]}; // rtl/src/pixelflow/frame_buffer.rs:218
    wire is_first = (x == 4'd0) & (y == 3'd0);                   // rtl/src/pixelflow/frame_buffer.rs:230
    wire changes = is_first & is_whole;                          // rtl/src/pixelflow/frame_buffer.rs:231
    wire pixels_taken = arrived & pixels_ready;                  // rtl/src/pixelflow/frame_buffer.rs:260
    wire scans = has_frame & !changes & (!arrived | pixels_taken); // rtl/src/pixelflow/frame_buffer.rs:237
    wire is_rightmost = x == 4'd15;                              // rtl/src/pixelflow/frame_buffer.rs:238
    wire line_ends = scans & is_rightmost;                       // rtl/src/pixelflow/frame_buffer.rs:239
    wire frame_ends = line_ends & (y == 3'd7);                   // rtl/src/pixelflow/frame_buffer.rs:240
    wire region_ends = line_ends & (y[1:0] == 2'd3);             // rtl/src/pixelflow/frame_buffer.rs:241
    wire [2:0] scanned_sum = left + {2'd0, x[3]};                // rtl/src/pixelflow/frame_buffer.rs:247
    wire [2:0] scanned = shown ? (scanned_sum + 3'd4) : scanned_sum; // rtl/src/pixelflow/frame_buffer.rs:247
    wire [6:0] scans_at = {scanned, y[0], x[2:0]};               // rtl/src/pixelflow/frame_buffer.rs:253
    wire [23:0] colour = is_odd ? odd_read : even_read;          // rtl/src/pixelflow/frame_buffer.rs:257
    assign pixels_red = colour[23:16];                           // rtl/src/pixelflow/frame_buffer.rs:258
    assign pixels_green = colour[15:8];                          // rtl/src/pixelflow/frame_buffer.rs:258
    assign pixels_blue = colour[7:0];                            // rtl/src/pixelflow/frame_buffer.rs:258
    assign port_pixel = pixel[3:0];                              // rtl/src/pixelflow/frame_buffer.rs:264
    assign port_address = {3'd0, clock};                         // rtl/src/pixelflow/frame_buffer.rs:266

    genvar i;

    generate
        for (i = 0; i < 2; i = i + 1) begin : row
            reg [23:0] colours;
            reg [23:0] stored;
            wire [23:0] gathered = reads ? {seen[i * 8 +: 8], colours[23:8]} : colours;

            always @(posedge clk) begin
                colours <= gathered;
                if (turn_ends) stored <= gathered;
                else stored <= 24'd0;
            end
        end
    endgenerate

    always @(posedge clk) begin
        if (stores) even[stores_at] <= row[0].stored;
        if (scans) even_read <= even[scans_at];
    end

    always @(posedge clk) begin
        if (stores) odd[stores_at] <= row[1].stored;
        if (scans) odd_read <= odd[scans_at];
    end

    always @(posedge clk) begin
        if (start | turn_ends) clock <= 3'd0;
        else if (runs) clock <= clock + 3'd1;
        if (start) pixel <= 5'd0;
        else if (turn_ends) pixel <= pixel + 5'd1;
    end

    always @(posedge clk) begin
        if (scans) begin
            is_odd <= y[1];
            first <= is_first;
            last <= is_rightmost;
        end
    end

    always @(posedge clk) begin
        if (rst) begin
            shown <= 1'b0;
            is_whole <= 1'b0;
            busy <= 1'b0;
            region <= 2'd0;
            x <= 4'd0;
            y <= 3'd0;
            left <= 3'd0;
            has_frame <= 1'b0;
            arrived <= 1'b0;
        end else begin
            if (changes) shown <= !shown;
            if (ends & is_last) is_whole <= 1'b1;
            else if (changes) is_whole <= 1'b0;
            if (start) busy <= 1'b1;
            else if (ends) busy <= 1'b0;
            if (ends) begin
                if (is_last) region <= 2'd0;
                else region <= region + 2'd1;
            end
            if (line_ends) x <= 4'd0;
            else if (scans) x <= x + 4'd1;
            if (frame_ends) y <= 3'd0;
            else if (line_ends) y <= y + 3'd1;
            if (frame_ends) left <= 3'd0;
            else if (region_ends) left <= left + 3'd2;
            if (changes) has_frame <= 1'b1;
            if (scans) arrived <= 1'b1;
            else if (pixels_taken) arrived <= 1'b0;
        end
    end

    assign port_writes = 1'b0;
    assign port_bytes = 16'd0;
    assign done = ends;
    assign pixels_valid = arrived;
    assign pixels_first = first;
    assign pixels_last = last;

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
        if (!rst) assume (!start | !busy);                           // rtl/src/pixelflow/frame_buffer.rs:202
    end
`else
    always @(posedge clk) begin
        if (!rst && !(!start | !busy)) begin                         // rtl/src/pixelflow/frame_buffer.rs:202
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: the frame buffer begins only when it is done", $time);
            stop;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, pixel_minus_1[4]};
endmodule
`default_nettype wire
