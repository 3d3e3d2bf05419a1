// image_memory_pages4_page_pixels16
//
// Stores two buffers of pages of pixels: keeps the nearer word of each pixel drawn, and
// clears each word that it sends.
//
// Parameters  ImageMemory { pages: 4, page_pixels: 16 }
// Latency     3 clocks of the processor to draw, 1 clock of the merger to send
// Source      VC-1, section 3.3, image memory (VC1-ACC, VC1-CLR1)
// Described   rtl/src/lfb/image_memory.rs:28
`default_nettype none

module image_memory_pages4_page_pixels16 (
    input  wire        pe_clk,
    input  wire        pe_rst,
    input  wire        merge_clk,
    input  wire        merge_rst,
    // A pixel to draw, from the first stage, at least 3 clocks after the previous one.
    input  wire        draw_valid,    // There is a pixel to draw.
    input  wire [1:0]  draw_page,     // The page of the pixel's patch.
    input  wire [3:0]  draw_offset,   // The pixel's place in the page.
    input  wire [47:0] draw_word,     // The word of the pixel: depth above colour.
    input  wire        front,         // The buffer to draw into.
    // A pixel to send to the merger, from the scan counter by way of the patch table.
    input  wire        send_enable,   // The scan advances; while it is low, the word sent does not change.
    input  wire        send_resident, // The pixel has a page; if not, the empty word is sent, which is all ones.
    input  wire [1:0]  send_page,     // The page of the pixel's patch.
    input  wire [3:0]  send_offset,   // The pixel's place in the page.
    input  wire        send_buffer,   // The buffer to read and clear.
    output wire        idle,          // No pixel is under way.
    output wire [47:0] sent           // The word sent to the merger.
);

    localparam [1:0] STAGE2_IDLE    = 2'd0;
    localparam [1:0] STAGE2_READ    = 2'd1;
    localparam [1:0] STAGE2_COMPARE = 2'd2;
    localparam [1:0] STAGE2_WRITE   = 2'd3;

    reg [1:0] stage2;                                            // rtl/src/lfb/image_memory.rs:83
    reg [6:0] drawn_address;                                     // rtl/src/lfb/image_memory.rs:96
    reg [47:0] drawn_word;                                       // rtl/src/lfb/image_memory.rs:97
    reg nearer;                                                  // rtl/src/lfb/image_memory.rs:99
    reg resident;                                                // rtl/src/lfb/image_memory.rs:106

    /* verilator lint_off MULTIDRIVEN */ // written by two clocks
    reg [47:0] words [0:127];                                    // rtl/src/lfb/image_memory.rs:81
    /* verilator lint_on MULTIDRIVEN */
    reg [47:0] old_word;                                         // rtl/src/lfb/image_memory.rs:98
    reg [47:0] taken_word;                                       // rtl/src/lfb/image_memory.rs:104

    initial begin : words_contents
        integer i;
        for (i = 0; i < 128; i = i + 1) words[i] = 48'hffffffffffff;
    end

    wire begins = ((stage2 == STAGE2_IDLE) & draw_valid) | ((stage2 == STAGE2_WRITE) & draw_valid); // rtl/src/lfb/image_memory.rs:90
    wire [6:0] send_address = {send_page, send_offset, send_buffer}; // rtl/src/lfb/image_memory.rs:102
    wire take = send_enable & send_resident;                     // rtl/src/lfb/image_memory.rs:103
    assign idle = stage2 == STAGE2_IDLE;                         // rtl/src/lfb/image_memory.rs:107
    assign sent = resident ? taken_word : 48'hffffffffffff;      // rtl/src/lfb/image_memory.rs:107

    always @(posedge pe_clk) begin
        if ((stage2 == STAGE2_WRITE) & nearer) words[drawn_address] <= drawn_word;
        if (stage2 == STAGE2_READ) old_word <= words[drawn_address];
    end

    always @(posedge merge_clk) begin
        if (take) words[send_address] <= 48'hffffffffffff;
        if (take) taken_word <= words[send_address];
    end

    always @(posedge pe_clk) begin
        if (begins) begin
            drawn_address <= {draw_page, draw_offset, front};
            drawn_word <= draw_word;
        end
    end

    always @(posedge pe_clk) begin
        if (stage2 == STAGE2_COMPARE) nearer <= drawn_word < old_word;
    end

    always @(posedge pe_clk) begin
        if (pe_rst) begin
            stage2 <= STAGE2_IDLE;
        end else begin
            case (stage2)
                STAGE2_IDLE: if (draw_valid) stage2 <= STAGE2_READ;
                STAGE2_READ: stage2 <= STAGE2_COMPARE;
                STAGE2_COMPARE: stage2 <= STAGE2_WRITE;
                default: begin // STAGE2_WRITE
                    if (draw_valid) stage2 <= STAGE2_READ;
                    else stage2 <= STAGE2_IDLE;
                end
            endcase
        end
    end

    always @(posedge merge_clk) begin
        if (merge_rst) resident <= 1'b0;
        else if (send_enable) resident <= send_resident;
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
`ifdef FORMAL
    always @(posedge pe_clk) begin
        if (!pe_rst) assume (!draw_valid | begins);                  // rtl/src/lfb/image_memory.rs:91
    end
`else
    always @(posedge pe_clk) begin
        if (!pe_rst && !(!draw_valid | begins)) begin                // rtl/src/lfb/image_memory.rs:91
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a pixel comes only when the second stage is idle or in its last clock", $time);
            stop;
        end
    end
`endif
`endif
endmodule
`default_nettype wire
