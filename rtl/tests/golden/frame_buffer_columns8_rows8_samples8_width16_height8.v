// frame_buffer_columns8_rows8_samples8_width16_height8
//
// Stores frames of a screen region by region, and scans them out.
//
// Parameters  FrameBuffer { columns: 8, rows: 8, samples: 8, screen: Screen { width: 16, height: 8 } }
// Latency     120 clocks for a region
// Source      Reducing Latency on PixelFlow, section 4 (PFL-LOAD)
// Described   rtl/src/pixelflow/frame_buffer.rs:46
`default_nettype none

module frame_buffer_columns8_rows8_samples8_width16_height8 (
    input  wire        clk,
    input  wire        rst,
    input  wire        start,        // For one clock: take the next region.
    input  wire [31:0] seen,         // The byte of each chip that the port addresses.
    input  wire        pixels_ready,
    // The access to the node's registers.
    output wire [3:0]  port_pixel,   // The pixel of each chip, counted line by line.
    output wire [5:0]  port_address, // The register of the pixel.
    output wire        port_writes,  // The register is written.
    output wire [31:0] port_bytes,   // The bytes to write, one of each chip.
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
    reg [4:0] clock;                                             // rtl/src/pixelflow/frame_buffer.rs:199
    reg [2:0] pixel;                                             // rtl/src/pixelflow/frame_buffer.rs:200
    reg [2:0] region;                                            // rtl/src/pixelflow/frame_buffer.rs:201
    reg [3:0] x;                                                 // rtl/src/pixelflow/frame_buffer.rs:226
    reg [2:0] y;                                                 // rtl/src/pixelflow/frame_buffer.rs:227
    reg [3:0] left;                                              // rtl/src/pixelflow/frame_buffer.rs:228
    reg has_frame;                                               // rtl/src/pixelflow/frame_buffer.rs:229
    reg arrived;                                                 // rtl/src/pixelflow/frame_buffer.rs:236
    reg is_odd;                                                  // rtl/src/pixelflow/frame_buffer.rs:256
    reg first;                                                   // rtl/src/pixelflow/frame_buffer.rs:256
    reg last;                                                    // rtl/src/pixelflow/frame_buffer.rs:256
    reg [2:0] register;                                          // rtl/src/pixelflow/frame_buffer.rs:296
    reg [1:0] sample;                                            // rtl/src/pixelflow/frame_buffer.rs:297

    (* no_rw_check *)
    reg [23:0] even [0:127];                                     // rtl/src/pixelflow/frame_buffer.rs:189
    reg [23:0] even_read;                                        // rtl/src/pixelflow/frame_buffer.rs:254
    (* no_rw_check *)
    reg [23:0] odd [0:127];                                      // rtl/src/pixelflow/frame_buffer.rs:189
    reg [23:0] odd_read;                                         // rtl/src/pixelflow/frame_buffer.rs:254

    wire runs = busy & !(is_whole & (region == 3'd0));           // rtl/src/pixelflow/frame_buffer.rs:203
    wire turn_ends = runs & (clock == 5'd23);                    // rtl/src/pixelflow/frame_buffer.rs:204
    wire ends = turn_ends & (pixel == 3'd4);                     // rtl/src/pixelflow/frame_buffer.rs:205
    wire is_last = region == 3'd7;                               // rtl/src/pixelflow/frame_buffer.rs:206
    wire reads = runs & (clock < 5'd24) & (pixel < 3'd4);        // rtl/src/pixelflow/frame_buffer.rs:212
    wire stores = runs & (pixel != 3'd0) & (clock < 5'd2);       // rtl/src/pixelflow/frame_buffer.rs:216
    wire [2:0] pixel_minus_1 = pixel - 3'd1;                     // rtl/src/pixelflow/frame_buffer.rs:217
    wire [3:0] stores_at_choice = !shown ? ({1'd0, region} + 4'd8) : {1'd0, region}; // rtl/src/pixelflow/frame_buffer.rs:194
    wire [6:0] stores_at = {stores_at_choice, clock[0], pixel_minus_1[1:0]}; // rtl/src/pixelflow/frame_buffer.rs:218
    wire is_first = (x == 4'd0) & (y == 3'd0);                   // rtl/src/pixelflow/frame_buffer.rs:230
    wire changes = is_first & is_whole;                          // rtl/src/pixelflow/frame_buffer.rs:231
    wire pixels_taken = arrived & pixels_ready;                  // rtl/src/pixelflow/frame_buffer.rs:260
    wire scans = has_frame & !changes & (!arrived | pixels_taken); // rtl/src/pixelflow/frame_buffer.rs:237
    wire is_rightmost = x == 4'd15;                              // rtl/src/pixelflow/frame_buffer.rs:238
    wire line_ends = scans & is_rightmost;                       // rtl/src/pixelflow/frame_buffer.rs:239
    wire frame_ends = line_ends & (y == 3'd7);                   // rtl/src/pixelflow/frame_buffer.rs:240
    wire region_ends = line_ends & (y[1:0] == 2'd3);             // rtl/src/pixelflow/frame_buffer.rs:241
    wire [3:0] scanned_sum = left + {2'd0, x[3:2]};              // rtl/src/pixelflow/frame_buffer.rs:247
    wire [3:0] scanned = shown ? (scanned_sum + 4'd8) : scanned_sum; // rtl/src/pixelflow/frame_buffer.rs:247
    wire [6:0] scans_at = {scanned, y[1], x[1:0]};               // rtl/src/pixelflow/frame_buffer.rs:253
    wire [23:0] colour = is_odd ? odd_read : even_read;          // rtl/src/pixelflow/frame_buffer.rs:257
    assign pixels_red = colour[23:16];                           // rtl/src/pixelflow/frame_buffer.rs:258
    assign pixels_green = colour[15:8];                          // rtl/src/pixelflow/frame_buffer.rs:258
    assign pixels_blue = colour[7:0];                            // rtl/src/pixelflow/frame_buffer.rs:258
    wire start_or_turn_ends = start | turn_ends;                 // rtl/src/pixelflow/frame_buffer.rs:267
    wire sample_ends = runs & (register == 3'd5);                // rtl/src/pixelflow/frame_buffer.rs:298
    assign port_pixel = {sample[1], pixel[1:0], sample[0]};      // rtl/src/pixelflow/frame_buffer.rs:301
    assign port_address = {3'd0, register};                      // rtl/src/pixelflow/frame_buffer.rs:301

    genvar i;

    generate
        for (i = 0; i < 4; i = i + 1) begin : row
            reg [32:0] sums;
            reg [23:0] stored;
            wire [10:0] sum = ((clock < 5'd3) ? 11'd4 : sums[10:0]) + {3'd0, seen[i * 8 +: 8]};
            wire [32:0] summed = reads ? {sum, sums[32:11]} : sums;
            wire [23:0] gathered = {summed[32:25], summed[21:14], summed[10:3]};
            wire [23:0] stored_linked;
            if (i >= 2) begin : stored_linked_edge
                assign stored_linked = 24'd0;
            end else begin : stored_linked_link
                assign stored_linked = row[i + 2].stored;
            end

            always @(posedge clk) begin
                sums <= summed;
                if (turn_ends) stored <= gathered;
                else stored <= stored_linked;
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
        if (start | turn_ends) clock <= 5'd0;
        else if (runs) clock <= clock + 5'd1;
        if (start) pixel <= 3'd0;
        else if (turn_ends) pixel <= pixel + 3'd1;
        if (start_or_turn_ends | sample_ends) register <= 3'd0;
        else if (runs) register <= register + 3'd1;
        if (start_or_turn_ends) sample <= 2'd0;
        else if (sample_ends) sample <= sample + 2'd1;
    end

    always @(posedge clk) begin
        if (scans) begin
            is_odd <= y[0];
            first <= is_first;
            last <= is_rightmost;
        end
    end

    always @(posedge clk) begin
        if (rst) begin
            shown <= 1'b0;
            is_whole <= 1'b0;
            busy <= 1'b0;
            region <= 3'd0;
            x <= 4'd0;
            y <= 3'd0;
            left <= 4'd0;
            has_frame <= 1'b0;
            arrived <= 1'b0;
        end else begin
            if (changes) shown <= !shown;
            if (ends & is_last) is_whole <= 1'b1;
            else if (changes) is_whole <= 1'b0;
            if (start) busy <= 1'b1;
            else if (ends) busy <= 1'b0;
            if (ends) begin
                if (is_last) region <= 3'd0;
                else region <= region + 3'd1;
            end
            if (line_ends) x <= 4'd0;
            else if (scans) x <= x + 4'd1;
            if (frame_ends) y <= 3'd0;
            else if (line_ends) y <= y + 3'd1;
            if (frame_ends) left <= 4'd0;
            else if (region_ends) left <= left + 4'd4;
            if (changes) has_frame <= 1'b1;
            if (scans) arrived <= 1'b1;
            else if (pixels_taken) arrived <= 1'b0;
        end
    end

    assign port_writes = 1'b0;
    assign port_bytes = 32'd0;
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

    wire _unused_ok = &{1'b0, pixel_minus_1[2]};
endmodule
`default_nettype wire
