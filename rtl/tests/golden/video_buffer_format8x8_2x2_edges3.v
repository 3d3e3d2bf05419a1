// video_buffer_format8x8_2x2_edges3
//
// Stores the pixels of a video processor in two banks: keeps the nearer word in one, and
// sends the words of the other.
//
// Parameters  VideoBuffer { format: "8x8_2x2_edges3" }
// Latency     2 clocks to draw, 1 clock to send
// Source      sparse-raster quadtree generator, figure 1 (MPG-ARCH)
// Described   rtl/src/quadtree/video_buffer.rs:24
`default_nettype none

module video_buffer_format8x8_2x2_edges3 (
    input  wire        clk,
    input  wire        rst,
    // A pixel to draw.
    input  wire        draw_valid,  // The fragment is valid.
    input  wire [1:0]  draw_x,      // The fragment's column among those of the video processor.
    input  wire [1:0]  draw_y,      // The fragment's line among those of the video processor.
    input  wire [47:0] draw_word,   // The word of the fragment: depth above colour.
    input  wire        strict,      // Depth alone is compared, and the first drawn of equal depths stays.
    input  wire        back,        // The number of the bank to draw in.
    // The pixel of the other bank to send.
    // A pixel is sent; while `enable` is low, the word sent stays until the banks are exchanged.
    input  wire        scan_enable,
    input  wire [1:0]  scan_x,      // The pixel's column among those of the video processor.
    input  wire [1:0]  scan_y,      // The pixel's line among those of the video processor.
    input  wire        scan_clear,  // The pixel is cleared when it is read.
    output wire [47:0] word         // The word sent to the video controller.
);

    reg [47:0] drawn_word;                                       // rtl/src/quadtree/video_buffer.rs:70
    reg sent_of;                                                 // rtl/src/quadtree/video_buffer.rs:71
    reg writes0;                                                 // rtl/src/quadtree/video_buffer.rs:83
    reg draws0;                                                  // rtl/src/quadtree/video_buffer.rs:85
    reg [3:0] place0;                                            // rtl/src/quadtree/video_buffer.rs:86
    reg passes0;                                                 // rtl/src/quadtree/video_buffer.rs:87
    reg [47:0] passed0;                                          // rtl/src/quadtree/video_buffer.rs:88
    reg writes1;                                                 // rtl/src/quadtree/video_buffer.rs:83
    reg draws1;                                                  // rtl/src/quadtree/video_buffer.rs:85
    reg [3:0] place1;                                            // rtl/src/quadtree/video_buffer.rs:86
    reg passes1;                                                 // rtl/src/quadtree/video_buffer.rs:87
    reg [47:0] passed1;                                          // rtl/src/quadtree/video_buffer.rs:88

    (* no_rw_check *)
    reg [47:0] bank0 [0:15];                                     // rtl/src/quadtree/banks.rs:93
    reg [47:0] bank0_read;                                       // rtl/src/quadtree/banks.rs:94
    (* no_rw_check *)
    reg [47:0] bank1 [0:15];                                     // rtl/src/quadtree/banks.rs:93
    reg [47:0] bank1_read;                                       // rtl/src/quadtree/banks.rs:94

    initial begin : bank0_contents
        integer i;
        for (i = 0; i < 16; i = i + 1) bank0[i] = 48'hffffffffffff;
    end

    initial begin : bank1_contents
        integer i;
        for (i = 0; i < 16; i = i + 1) bank1[i] = 48'hffffffffffff;
    end

    wire [3:0] drawn = {draw_y, draw_x};                         // rtl/src/quadtree/video_buffer.rs:68
    wire [3:0] shown = {scan_y, scan_x};                         // rtl/src/quadtree/video_buffer.rs:69
    wire is_back0 = !back;                                       // rtl/src/quadtree/video_buffer.rs:75
    wire reads0 = is_back0 ? draw_valid : scan_enable;           // rtl/src/quadtree/video_buffer.rs:76
    wire [3:0] address0 = is_back0 ? drawn : shown;              // rtl/src/quadtree/video_buffer.rs:77
    wire [47:0] old0 = passes0 ? passed0 : bank0_read;           // rtl/src/quadtree/video_buffer.rs:89
    wire write0_choice = strict ? (drawn_word[47:24] < old0[47:24]) : (drawn_word < old0); // rtl/src/quadtree/video_buffer.rs:91
    wire [47:0] passed0_next = draws0 ? drawn_word : 48'hffffffffffff; // rtl/src/quadtree/video_buffer.rs:92
    wire write0 = writes0 & (!draws0 | write0_choice);           // rtl/src/quadtree/video_buffer.rs:93
    wire is_back1 = back;                                        // rtl/src/quadtree/video_buffer.rs:75
    wire reads1 = is_back1 ? draw_valid : scan_enable;           // rtl/src/quadtree/video_buffer.rs:76
    wire [3:0] address1 = is_back1 ? drawn : shown;              // rtl/src/quadtree/video_buffer.rs:77
    wire [47:0] old1 = passes1 ? passed1 : bank1_read;           // rtl/src/quadtree/video_buffer.rs:89
    wire write1_choice = strict ? (drawn_word[47:24] < old1[47:24]) : (drawn_word < old1); // rtl/src/quadtree/video_buffer.rs:91
    wire [47:0] passed1_next = draws1 ? drawn_word : 48'hffffffffffff; // rtl/src/quadtree/video_buffer.rs:92
    wire write1 = writes1 & (!draws1 | write1_choice);           // rtl/src/quadtree/video_buffer.rs:93
    assign word = sent_of ? old1 : old0;                         // rtl/src/quadtree/video_buffer.rs:99

    always @(posedge clk) begin
        if (write0) bank0[place0] <= passed0_next;
        if (reads0) bank0_read <= bank0[address0];
    end

    always @(posedge clk) begin
        if (write1) bank1[place1] <= passed1_next;
        if (reads1) bank1_read <= bank1[address1];
    end

    always @(posedge clk) begin
        if (draw_valid) drawn_word <= draw_word;
    end

    always @(posedge clk) begin
        if (scan_enable) sent_of <= !back;
    end

    always @(posedge clk) begin
        if (reads0) begin
            draws0 <= is_back0;
            place0 <= address0;
            passes0 <= write0 & (place0 == address0);
            passed0 <= passed0_next;
        end
    end

    always @(posedge clk) begin
        if (reads1) begin
            draws1 <= is_back1;
            place1 <= address1;
            passes1 <= write1 & (place1 == address1);
            passed1 <= passed1_next;
        end
    end

    always @(posedge clk) begin
        if (rst) begin
            writes0 <= 1'b0;
            writes1 <= 1'b0;
        end else begin
            if (is_back0) writes0 <= draw_valid;
            else writes0 <= scan_enable & scan_clear;
            if (is_back1) writes1 <= draw_valid;
            else writes1 <= scan_enable & scan_clear;
        end
    end
endmodule
`default_nettype wire
