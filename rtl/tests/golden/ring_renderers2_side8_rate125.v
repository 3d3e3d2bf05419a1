// ring_renderers2_side8_rate125
//
// Carries instructions to renderers, and their planes to the frame buffer, at `rate` bits a
// clock.
//
// Parameters  Ring { renderers: 2, side: 8, rate: 125 }
// Latency     none; 125 bits a clock
// Source      Pixel-planes 5, section I.3.2.1 (PP5-ARCH)
// Described   rtl/src/pixel_planes/ring.rs:34
`default_nettype none

module ring_renderers2_side8_rate125 (
    input  wire        clk,
    input  wire        rst,
    // The instructions for each renderer.
    input  wire        bins_0_valid,
    input  wire [4:0]  bins_0_operation,              // The operation: an `Operation`.
    // Bits of the expression before the word; 0 without an expression.
    input  wire [5:0]  bins_0_skip,
    input  wire [6:0]  bins_0_length,                 // Bits of the word: 1 to `LONGEST`.
    input  wire [7:0]  bins_0_read,                   // The first address that is read.
    input  wire [7:0]  bins_0_write,                  // The first address that is written.
    // The coefficients of the expression, in two's complement, relative to the region. Without an expression, `c` is
    // the constant; its sign extends to longer words. For a curve they are `d`, `e` and `f`.
    input  wire [39:0] bins_0_coefficients_a,         // Coefficient A, the increase from one column to the next.
    input  wire [39:0] bins_0_coefficients_b,         // Coefficient B, the increase from one line to the next.
    input  wire [39:0] bins_0_coefficients_c,         // Coefficient C, the value at column 0 of line 0.
    input  wire        bins_1_valid,
    input  wire [4:0]  bins_1_operation,
    input  wire [5:0]  bins_1_skip,
    input  wire [6:0]  bins_1_length,
    input  wire [7:0]  bins_1_read,
    input  wire [7:0]  bins_1_write,
    input  wire [39:0] bins_1_coefficients_a,
    input  wire [39:0] bins_1_coefficients_b,
    input  wire [39:0] bins_1_coefficients_c,
    // The renderers whose queues have room for an instruction in this clock.
    input  wire [1:0]  room,
    // The finished regions of each renderer.
    input  wire        finished_0_valid,
    input  wire [15:0] finished_0_region,             // The number of the region.
    input  wire [2:0]  finished_0_line,               // The line of the region.
    input  wire [5:0]  finished_0_plane,              // The number of the bit in the visibility word.
    input  wire [7:0]  finished_0_bits,               // The plane's bit of each pixel of the line, from the left.
    input  wire        finished_1_valid,
    input  wire [15:0] finished_1_region,
    input  wire [2:0]  finished_1_line,
    input  wire [5:0]  finished_1_plane,
    input  wire [7:0]  finished_1_bits,
    input  wire        instructions_0_ready,
    input  wire        instructions_1_ready,
    input  wire        planes_ready,
    // The instructions to each renderer.
    output wire        instructions_0_valid,
    output wire [4:0]  instructions_0_operation,      // The operation: an `Operation`.
    // Bits of the expression before the word; 0 without an expression.
    output wire [5:0]  instructions_0_skip,
    output wire [6:0]  instructions_0_length,         // Bits of the word: 1 to `LONGEST`.
    output wire [7:0]  instructions_0_read,           // The first address that is read.
    output wire [7:0]  instructions_0_write,          // The first address that is written.
    // The coefficients of the expression, in two's complement, relative to the region. Without an expression, `c` is
    // the constant; its sign extends to longer words. For a curve they are `d`, `e` and `f`.
    output wire [39:0] instructions_0_coefficients_a, // Coefficient A, the increase from one column to the next.
    output wire [39:0] instructions_0_coefficients_b, // Coefficient B, the increase from one line to the next.
    output wire [39:0] instructions_0_coefficients_c, // Coefficient C, the value at column 0 of line 0.
    output wire        instructions_1_valid,
    output wire [4:0]  instructions_1_operation,
    output wire [5:0]  instructions_1_skip,
    output wire [6:0]  instructions_1_length,
    output wire [7:0]  instructions_1_read,
    output wire [7:0]  instructions_1_write,
    output wire [39:0] instructions_1_coefficients_a,
    output wire [39:0] instructions_1_coefficients_b,
    output wire [39:0] instructions_1_coefficients_c,
    // The planes to the frame buffer.
    output wire        planes_valid,
    output wire [15:0] planes_region,                 // The number of the region.
    output wire [2:0]  planes_line,                   // The line of the region.
    output wire [5:0]  planes_plane,                  // The number of the bit in the visibility word.
    output wire [7:0]  planes_bits,                   // The plane's bit of each pixel of the line, from the left.
    output wire        bins_0_ready,
    output wire        bins_1_ready,
    output wire        finished_0_ready,
    output wire        finished_1_ready
);

    reg [1:0] line_of;                                           // rtl/src/pixel_planes/ring.rs:117
    reg [8:0] credit;                                            // rtl/src/pixel_planes/ring.rs:143
    reg [3:0] last;                                              // rtl/src/pixel_planes/ring.rs:144

    wire requests_and_3;                                         // rtl/src/pixel_planes/ring.rs:110
    wire requests_and_4;                                         // rtl/src/pixel_planes/ring.rs:110
    wire [7:0] goes;                                             // rtl/src/pixel_planes/ring.rs:163
    wire [8:0] paid;                                             // rtl/src/pixel_planes/ring.rs:166
    wire [7:0] last_to_go_lanes;                                 // rtl/src/pixel_planes/ring.rs:169
    wire [7:0] last_to_go;                                       // rtl/src/pixel_planes/ring.rs:170
    wire requests_and = finished_1_valid & ((line_of == 2'd0) | line_of[1]); // rtl/src/pixel_planes/ring.rs:121
    wire requests_and_2 = finished_0_valid & ((line_of == 2'd0) | line_of[0]); // rtl/src/pixel_planes/ring.rs:121
    wire [3:0] requests = {requests_and, requests_and_2, requests_and_3, requests_and_4}; // rtl/src/pixel_planes/ring.rs:132
    wire [3:0] up_to_last = requests & (last | (last - 4'd1));   // rtl/src/pixel_planes/ring.rs:148
    wire [3:0] behind_last = requests & ~(last | (last - 4'd1)); // rtl/src/pixel_planes/ring.rs:149
    wire [7:0] first_plane_joined = {up_to_last, behind_last};   // rtl/src/pixel_planes/ring.rs:150
    wire [7:0] first_plane_and = first_plane_joined & 8'hcc;     // rtl/src/pixel_planes/ring.rs:152
    wire [7:0] first_plane = first_plane_and & (~first_plane_and + 8'd1); // rtl/src/pixel_planes/ring.rs:152
    wire [3:0] granted = goes[3:0] | goes[7:4];                  // rtl/src/pixel_planes/ring.rs:106
    assign bins_0_ready = granted[0];                            // rtl/src/pixel_planes/ring.rs:111
    assign bins_1_ready = granted[1];                            // rtl/src/pixel_planes/ring.rs:111
    wire [1:0] of_plane = granted[3:2];                          // rtl/src/pixel_planes/ring.rs:118
    assign finished_0_ready = of_plane[0];                       // rtl/src/pixel_planes/ring.rs:122
    assign finished_1_ready = of_plane[1];                       // rtl/src/pixel_planes/ring.rs:122
    assign instructions_0_valid = granted[0];                    // rtl/src/pixel_planes/ring.rs:111
    assign instructions_1_valid = granted[1];                    // rtl/src/pixel_planes/ring.rs:111
    assign planes_region = of_plane[1] ? finished_1_region : finished_0_region; // rtl/src/pixel_planes/ring.rs:125
    assign planes_line = of_plane[1] ? finished_1_line : finished_0_line; // rtl/src/pixel_planes/ring.rs:125
    assign planes_plane = of_plane[1] ? finished_1_plane : finished_0_plane; // rtl/src/pixel_planes/ring.rs:125
    assign planes_valid = |of_plane;                             // rtl/src/pixel_planes/ring.rs:126
    wire line_ends = planes_plane == 6'd47;                      // rtl/src/pixel_planes/ring.rs:128
    wire [8:0] credit_sum = (credit - paid) + 9'd125;            // rtl/src/pixel_planes/ring.rs:167
    wire [7:0] last_to_go_and = last_to_go_lanes & (~last_to_go_lanes + 8'd1); // rtl/src/pixel_planes/ring.rs:170

    genvar i;

    generate
        for (i = 0; i < 8; i = i + 1) begin : planes_bits_choice_row
            wire planes_bits_choice = of_plane[1] ? finished_1_bits[i] : finished_0_bits[i];
        end
    endgenerate

    generate
        for (i = 0; i < 8; i = i + 1) begin : wants_row
            localparam [31:0] wants_listed = 1 - ((i / 2) % 2);
            wire wants = first_plane_joined[i] & (wants_listed[0] | first_plane[i]);
            localparam [31:0] sums_of2_listed = 154 - 146 * ((i / 2) % 2);
            wire [8:0] sums_of2_choice = wants ? sums_of2_listed[8:0] : 9'd0;
            wire [8:0] sums_of2_linked;
            if (i < 1) begin : sums_of2_linked_edge
                assign sums_of2_linked = 9'd0;
            end else begin : sums_of2_linked_link
                assign sums_of2_linked = wants_row[i - 1].sums_of2_choice;
            end
            wire [8:0] sums_of2 = sums_of2_choice + sums_of2_linked;
            wire [8:0] sums_of4_linked;
            if (i < 2) begin : sums_of4_linked_edge
                assign sums_of4_linked = 9'd0;
            end else begin : sums_of4_linked_link
                assign sums_of4_linked = wants_row[i - 2].sums_of2;
            end
            wire [8:0] sums_of4 = sums_of2 + sums_of4_linked;
            wire [8:0] sums_of8_linked;
            if (i < 4) begin : sums_of8_linked_edge
                assign sums_of8_linked = 9'd0;
            end else begin : sums_of8_linked_link
                assign sums_of8_linked = wants_row[i - 4].sums_of4;
            end
            wire [8:0] sums_of8 = sums_of4 + sums_of8_linked;
            wire fits = sums_of8 <= credit;
            wire wants_and_fits = wants & fits;
            wire last_that_fits_linked;
            if (i >= 7) begin : last_that_fits_linked_edge
                assign last_that_fits_linked = 1'b0;
            end else begin : last_that_fits_linked_link
                assign last_that_fits_linked = wants_row[i + 1].fits;
            end
            wire last_that_fits = fits & !last_that_fits_linked;
            wire [8:0] paid_choice = last_that_fits ? sums_of8 : 9'd0;
        end
    endgenerate

    assign requests_and_3 = bins_1_valid & room[1];              // rtl/src/pixel_planes/ring.rs:110
    assign requests_and_4 = bins_0_valid & room[0];              // rtl/src/pixel_planes/ring.rs:110
    generate
        for (i = 0; i < 8; i = i + 1) begin : goes_of
            assign goes[i] = wants_row[i].wants_and_fits;
        end
    endgenerate
    generate
        for (i = 0; i < 15; i = i + 1) begin : paid_tree
            wire [8:0] value;
            if (i < 8) begin : leaf
                assign value = wants_row[i].paid_choice;
            end else begin : pair
                assign value = paid_tree[2 * (i - 8)].value | paid_tree[2 * (i - 8) + 1].value;
            end
        end
    endgenerate
    assign paid = paid_tree[14].value;                           // rtl/src/pixel_planes/ring.rs:166
    generate
        for (i = 0; i < 8; i = i + 1) begin : last_to_go_lanes_of
            assign last_to_go_lanes[i] = wants_row[7 - i].wants_and_fits;
        end
    endgenerate
    generate
        for (i = 0; i < 8; i = i + 1) begin : last_to_go_of
            assign last_to_go[i] = last_to_go_and[7 - i];
        end
    endgenerate
    generate
        for (i = 0; i < 8; i = i + 1) begin : planes_bits_of
            assign planes_bits[i] = planes_bits_choice_row[i].planes_bits_choice;
        end
    endgenerate

    always @(posedge clk) begin
        if (rst) begin
            line_of <= 2'd0;
            credit <= 9'd278;
            last <= 4'd0;
        end else begin
            if (|of_plane) begin
                if (line_ends) line_of <= 2'd0;
                else line_of <= of_plane;
            end
            if (credit_sum > 9'd278) credit <= 9'd278;
            else credit <= credit_sum;
            if (|goes) last <= last_to_go[3:0] | last_to_go[7:4];
        end
    end

    assign instructions_0_operation = bins_0_operation;
    assign instructions_0_skip = bins_0_skip;
    assign instructions_0_length = bins_0_length;
    assign instructions_0_read = bins_0_read;
    assign instructions_0_write = bins_0_write;
    assign instructions_0_coefficients_a = bins_0_coefficients_a;
    assign instructions_0_coefficients_b = bins_0_coefficients_b;
    assign instructions_0_coefficients_c = bins_0_coefficients_c;
    assign instructions_1_operation = bins_1_operation;
    assign instructions_1_skip = bins_1_skip;
    assign instructions_1_length = bins_1_length;
    assign instructions_1_read = bins_1_read;
    assign instructions_1_write = bins_1_write;
    assign instructions_1_coefficients_a = bins_1_coefficients_a;
    assign instructions_1_coefficients_b = bins_1_coefficients_b;
    assign instructions_1_coefficients_c = bins_1_coefficients_c;

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
        if (!rst) assume (!instructions_0_valid | instructions_0_ready); // rtl/src/pixel_planes/ring.rs:112
        if (!rst) assume (!instructions_1_valid | instructions_1_ready); // rtl/src/pixel_planes/ring.rs:112
        if (!rst) assume (!planes_valid | planes_ready);             // rtl/src/pixel_planes/ring.rs:127
    end
`else
    always @(posedge clk) begin
        if (!rst && !(!instructions_0_valid | instructions_0_ready)) begin // rtl/src/pixel_planes/ring.rs:112
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a queue that has room takes an instruction", $time);
            stop;
        end
        if (!rst && !(!instructions_1_valid | instructions_1_ready)) begin // rtl/src/pixel_planes/ring.rs:112
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a queue that has room takes an instruction", $time);
            stop;
        end
        if (!rst && !(!planes_valid | planes_ready)) begin           // rtl/src/pixel_planes/ring.rs:127
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: the frame buffer takes each plane", $time);
            stop;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, instructions_0_ready, instructions_1_ready, planes_ready};
endmodule
`default_nettype wire
