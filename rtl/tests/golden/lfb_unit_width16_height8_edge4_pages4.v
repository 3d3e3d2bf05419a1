// lfb_unit_width16_height8_edge4_pages4
//
// A virtual local frame buffer: a full screen, of which only the patches drawn into take
// memory.
//
// Parameters  LfbUnit { patches: Patches { screen: Screen { width: 16, height: 8 }, edge: 4 }, pages: 4 }
// Latency     an access every 3 or 4 clocks; 2 clocks of the merger from the scan counter to the word
// Source      VC-1, section 3.3, local frame buffer (VC1-LFB, VC1-ACC, VC1-SCAN, VC1-CLR1)
// Described   rtl/src/lfb/unit.rs:36
`default_nettype none

module lfb_unit_width16_height8_edge4_pages4 (
    input  wire        pe_clk,
    input  wire        pe_rst,
    input  wire        merge_clk,
    input  wire        merge_rst,
    // A pixel that the processor draws.
    input  wire        request_valid,
    input  wire [3:0]  request_x,     // The column of the pixel, counted from the left.
    input  wire [2:0]  request_y,     // The line of the pixel, counted from the top.
    input  wire [47:0] request_word,  // The word of the pixel: depth above colour.
    // A patch table entry that the processor clears. If a request is accepted at the same edge, the clear comes first.
    input  wire        clear_valid,
    input  wire [2:0]  clear_patch,   // The number of the patch.
    input  wire        swap,          // For one clock, when idle or in overflow: swap the buffers.
    input  wire        resume,        // For one clock: try the waiting request again.
    // The control of the scan, from the global frame buffer unit.
    input  wire        scan_restart,  // High for one clock: every scan counter loads its preset.
    // The counters, the read-out and the merging units advance by a pixel; while `enable` is low, they keep their
    // values.
    input  wire        scan_enable,
    // The pixel to which a restart sets the scan counter; a constant, `ScanCounter::preset`.
    input  wire [3:0]  preset_x,      // The column of the pixel, counted from the left.
    input  wire [2:0]  preset_y,      // The line of the pixel, counted from the top.
    output wire        overflow,      // A request waits, because its patch has no page and all pages are taken.
    output wire [2:0]  pages_used,    // The number of pages taken in the front buffer.
    output wire        idle,          // No request is under way.
    output wire        draws,         // A request is accepted.
    output wire        clears,        // An entry of the patch table is cleared.
    output wire [47:0] word,          // The pixel sent to the merging unit.
    output reg         sending,       // A part of the back buffer has not been sent since the last swap.
    // The pixel that the scan counter shows; the pixel's word is sent 2 clocks later.
    output wire [3:0]  scanned_x,     // The column of the pixel, counted from the left.
    output wire [2:0]  scanned_y,     // The line of the pixel, counted from the top.
    output wire        request_ready,
    output wire        clear_ready
);

    reg front;                                                   // rtl/src/lfb/unit.rs:102
    (* ASYNC_REG = "TRUE" *) reg merge_front_meta;               // rtl/src/lfb/unit.rs:103
    (* ASYNC_REG = "TRUE" *) reg merge_front;                    // rtl/src/lfb/unit.rs:103
    (* ASYNC_REG = "TRUE" *) reg known_front_meta;               // rtl/src/lfb/unit.rs:104
    (* ASYNC_REG = "TRUE" *) reg known_front;                    // rtl/src/lfb/unit.rs:104
    reg sought_armed;                                            // rtl/src/lfb/unit.rs:112
    reg [3:0] sought_offset;                                     // rtl/src/lfb/unit.rs:113
    reg sought_buffer;                                           // rtl/src/lfb/unit.rs:114
    reg was_front;                                               // rtl/src/lfb/unit.rs:119
    reg [7:0] pixels_left;                                       // rtl/src/lfb/unit.rs:123
    reg [3:0] wanted_offset;                                     // rtl/src/lfb/unit.rs:146
    reg [47:0] wanted_word;                                      // rtl/src/lfb/unit.rs:147

    wire u_scan_counter_armed;                                   // rtl/src/lfb/unit.rs:110
    wire u_patch_table_idle;                                     // rtl/src/lfb/unit.rs:145
    wire u_patch_table_found;                                    // rtl/src/lfb/unit.rs:145
    wire [1:0] u_patch_table_page;                               // rtl/src/lfb/unit.rs:145
    wire u_patch_table_scan_entry_resident;                      // rtl/src/lfb/unit.rs:145
    wire [1:0] u_patch_table_scan_entry_page;                    // rtl/src/lfb/unit.rs:145
    wire u_image_memory_idle;                                    // rtl/src/lfb/unit.rs:155

    wire settled = known_front == front;                         // rtl/src/lfb/unit.rs:105
    wire back = !merge_front;                                    // rtl/src/lfb/unit.rs:106
    wire [3:0] u_patch_table_scan_patch_product = {3'd0, scanned_y[2]} * 4'd4; // rtl/src/lfb/patches.rs:96
    wire swapped = was_front != merge_front;                     // rtl/src/lfb/unit.rs:121
    wire passes = scan_enable & u_scan_counter_armed;            // rtl/src/lfb/unit.rs:122
    wire all_sent = pixels_left == 8'd0;                         // rtl/src/lfb/unit.rs:124
    wire [3:0] u_patch_table_look_up_patch_product = {3'd0, request_y[2]} * 4'd4; // rtl/src/lfb/patches.rs:96
    wire accept = request_valid & request_ready;                 // rtl/src/lfb/unit.rs:139
    assign clears = clear_valid & clear_ready;                   // rtl/src/lfb/unit.rs:140
    wire resident = sought_armed & u_patch_table_scan_entry_resident & (sought_buffer == back); // rtl/src/lfb/unit.rs:150
    wire again = all_sent & !swapped;                            // rtl/src/lfb/unit.rs:158
    assign idle = u_patch_table_idle & u_image_memory_idle;      // rtl/src/lfb/unit.rs:163

    scan_counter_width16_height8 u_scan_counter (                // rtl/src/lfb/unit.rs:110
        .clk          (merge_clk),
        .rst          (merge_rst),
        .scan_restart (scan_restart),
        .scan_enable  (scan_enable),
        .preset_x     (preset_x),
        .preset_y     (preset_y),
        .pixel_x      (scanned_x),
        .pixel_y      (scanned_y),
        .armed        (u_scan_counter_armed)
    );

    patch_table_patches8_pages4 u_patch_table (                  // rtl/src/lfb/unit.rs:145
        .pe_clk              (pe_clk),
        .pe_rst              (pe_rst),
        .merge_clk           (merge_clk),
        .look_up_valid       (request_valid),
        .look_up_patch       (u_patch_table_look_up_patch_product[2:0] + {1'd0, request_x[3:2]}),
        .clear_valid         (clear_valid),
        .clear_patch         (clear_patch),
        .front               (front),
        .settled             (settled),
        .restart             (swap),
        .resume              (resume),
        .scan_enable         (scan_enable),
        .scan_patch          (u_patch_table_scan_patch_product[2:0] + {1'd0, scanned_x[3:2]}),
        .scan_buffer         (back),
        .overflow            (overflow),
        .idle                (u_patch_table_idle),
        .pages_used          (pages_used),
        .found               (u_patch_table_found),
        .page                (u_patch_table_page),
        .scan_entry_resident (u_patch_table_scan_entry_resident),
        .scan_entry_page     (u_patch_table_scan_entry_page),
        .look_up_ready       (request_ready),
        .clear_ready         (clear_ready)
    );

    image_memory_pages4_page_pixels16 u_image_memory (           // rtl/src/lfb/unit.rs:155
        .pe_clk        (pe_clk),
        .pe_rst        (pe_rst),
        .merge_clk     (merge_clk),
        .merge_rst     (merge_rst),
        .draw_valid    (u_patch_table_found),
        .draw_page     (u_patch_table_page),
        .draw_offset   (wanted_offset),
        .draw_word     (wanted_word),
        .front         (front),
        .send_enable   (scan_enable),
        .send_resident (resident),
        .send_page     (u_patch_table_scan_entry_page),
        .send_offset   (sought_offset),
        .send_buffer   (back),
        .idle          (u_image_memory_idle),
        .sent          (word)
    );

    always @(posedge merge_clk) begin
        if (scan_enable) begin
            sought_offset <= {scanned_y[1:0], scanned_x[1:0]};
            sought_buffer <= back;
        end
    end

    always @(posedge pe_clk) begin
        if (accept) begin
            wanted_offset <= {request_y[1:0], request_x[1:0]};
            wanted_word <= request_word;
        end
    end

    always @(posedge pe_clk) begin
        if (pe_rst) begin
            front <= 1'b0;
            known_front_meta <= 1'b0;
            known_front <= 1'b0;
        end else begin
            if (swap) front <= !front;
            known_front_meta <= merge_front;
            known_front <= known_front_meta;
        end
    end

    always @(posedge merge_clk) begin
        if (merge_rst) begin
            merge_front_meta <= 1'b0;
            merge_front <= 1'b0;
            sought_armed <= 1'b0;
            was_front <= 1'b0;
            pixels_left <= 8'd0;
            sending <= 1'b0;
        end else begin
            merge_front_meta <= front;
            merge_front <= merge_front_meta;
            if (scan_enable) sought_armed <= u_scan_counter_armed;
            was_front <= merge_front;
            if (swapped) begin
                if (passes) pixels_left <= 8'd129;
                else pixels_left <= 8'd130;
            end else if (passes & !all_sent) begin
                pixels_left <= pixels_left - 8'd1;
            end
            sending <= !all_sent | swapped;
        end
    end

    assign draws = accept;

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
    reg sought_again;                                            // rtl/src/lfb/unit.rs:159
    reg sent_again;                                              // rtl/src/lfb/unit.rs:160

    always @(posedge merge_clk) begin
        if (merge_rst) begin
            sought_again <= 1'b0;
            sent_again <= 1'b0;
        end else if (scan_enable) begin
            sought_again <= again;
            sent_again <= sought_again;
        end
    end

`ifdef FORMAL
    always @(posedge pe_clk) begin
        if (!pe_rst) assume (!swap | (overflow | idle));             // rtl/src/lfb/unit.rs:164
        if (!pe_rst) assume (!swap | settled);                       // rtl/src/lfb/unit.rs:165
    end
    always @(posedge merge_clk) begin
        if (!merge_rst) assert (!swapped | all_sent);                // rtl/src/lfb/unit.rs:131
        if (!merge_rst) assume (!scan_restart | (all_sent & !swapped)); // rtl/src/lfb/unit.rs:133
        if (!merge_rst) cover (swapped & passes);                    // rtl/src/lfb/unit.rs:134
        if (!merge_rst) assert (!sent_again | (word == 48'hffffffffffff)); // rtl/src/lfb/unit.rs:161
        if (!merge_rst) cover (passes & again);                      // rtl/src/lfb/unit.rs:162
    end
`else
    reg is_covered;
    initial is_covered = 1'b0;
    reg is_covered_2;
    initial is_covered_2 = 1'b0;
    always @(posedge pe_clk) begin
        if (!pe_rst && !(!swap | (overflow | idle))) begin           // rtl/src/lfb/unit.rs:164
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: the buffers are swapped only when idle or in overflow", $time);
            stop;
        end
        if (!pe_rst && !(!swap | settled)) begin                     // rtl/src/lfb/unit.rs:165
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: the buffers are not swapped again before the merger has followed", $time);
            stop;
        end
    end
    always @(posedge merge_clk) begin
        if (!merge_rst && !(!swapped | all_sent)) begin              // rtl/src/lfb/unit.rs:131
            $display("FAIL: time %0t: %m: the buffers are swapped only when the back buffer has been sent", $time);
            stop;
        end
        if (!merge_rst && !(!scan_restart | (all_sent & !swapped))) begin // rtl/src/lfb/unit.rs:133
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: the scan restarts only when nothing is left to send", $time);
            stop;
        end
        if (!merge_rst && (swapped & passes) && !is_covered) begin   // rtl/src/lfb/unit.rs:134
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: the buffers are swapped while the scan is within a frame", $time);
            `endif
            is_covered <= 1'b1;
        end
        if (!merge_rst && !(!sent_again | (word == 48'hffffffffffff))) begin // rtl/src/lfb/unit.rs:161
            $display("FAIL: time %0t: %m: a back buffer that has been sent is cleared", $time);
            stop;
        end
        if (!merge_rst && (passes & again) && !is_covered_2) begin   // rtl/src/lfb/unit.rs:162
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: a pixel is scanned again after it was sent", $time);
            `endif
            is_covered_2 <= 1'b1;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, u_patch_table_scan_patch_product[3],
            u_patch_table_look_up_patch_product[3], again};
endmodule
`default_nettype wire
