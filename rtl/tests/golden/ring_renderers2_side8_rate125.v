// ring_renderers2_side8_rate125
//
// Carries instructions to renderers, and their planes to the frame buffer, at `rate` bits a
// clock.
//
// Parameters  Ring { renderers: 2, side: 8, rate: 125 }
// Latency     none; 125 bits a clock
// Source      Pixel-planes 5, section I.3.2.1 (PP5-ARCH)
// Described   rtl/src/pixel_planes/ring.rs:33
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

    reg [1:0] line_of;                                           // rtl/src/pixel_planes/ring.rs:128
    reg [8:0] credit;                                            // rtl/src/pixel_planes/ring.rs:152
    reg [3:0] last;                                              // rtl/src/pixel_planes/ring.rs:153

    wire requests_and_3;                                         // rtl/src/pixel_planes/ring.rs:121
    wire requests_and_4;                                         // rtl/src/pixel_planes/ring.rs:121
    wire requests_and = finished_1_valid & ((line_of == 2'd0) | line_of[1]); // rtl/src/pixel_planes/ring.rs:132
    wire requests_and_2 = finished_0_valid & ((line_of == 2'd0) | line_of[0]); // rtl/src/pixel_planes/ring.rs:132
    wire [3:0] requests = {requests_and, requests_and_2, requests_and_3, requests_and_4}; // rtl/src/pixel_planes/ring.rs:143
    wire [3:0] behind_last = requests & ~(last | (last - 4'd1)); // rtl/src/pixel_planes/ring.rs:154
    wire wants0 = behind_last[0];                                // rtl/src/pixel_planes/ring.rs:176
    wire wants1_and = wants0 & (credit < 9'd154);                // rtl/src/pixel_planes/ring.rs:179
    wire wants1 = behind_last[1] & !wants1_and;                  // rtl/src/pixel_planes/ring.rs:176
    wire goes0 = wants0 & (credit >= 9'd154);                    // rtl/src/pixel_planes/ring.rs:178
    wire [8:0] credit0 = goes0 ? (credit - 9'd154) : credit;     // rtl/src/pixel_planes/ring.rs:180
    wire wants2_or = wants1_and | (wants1 & (credit0 < 9'd154)); // rtl/src/pixel_planes/ring.rs:179
    wire wants2 = behind_last[2] & !wants2_or;                   // rtl/src/pixel_planes/ring.rs:176
    wire goes1 = wants1 & (credit0 >= 9'd154);                   // rtl/src/pixel_planes/ring.rs:178
    wire [8:0] credit1 = goes1 ? (credit0 - 9'd154) : credit0;   // rtl/src/pixel_planes/ring.rs:180
    wire wants3_or = wants2_or | (wants2 & (credit1 < 9'd8));    // rtl/src/pixel_planes/ring.rs:179
    wire goes2 = wants2 & (credit1 >= 9'd8);                     // rtl/src/pixel_planes/ring.rs:178
    wire wants3 = behind_last[3] & (!wants3_or & !goes2);        // rtl/src/pixel_planes/ring.rs:176
    wire [8:0] credit2 = goes2 ? (credit1 - 9'd8) : credit1;     // rtl/src/pixel_planes/ring.rs:180
    wire goes3 = wants3 & (credit2 >= 9'd8);                     // rtl/src/pixel_planes/ring.rs:178
    wire [3:0] up_to_last = requests & (last | (last - 4'd1));   // rtl/src/pixel_planes/ring.rs:155
    wire wants4_or = wants3_or | (wants3 & (credit2 < 9'd8));    // rtl/src/pixel_planes/ring.rs:179
    wire wants4 = up_to_last[0] & !wants4_or;                    // rtl/src/pixel_planes/ring.rs:176
    wire [8:0] credit3 = goes3 ? (credit2 - 9'd8) : credit2;     // rtl/src/pixel_planes/ring.rs:180
    wire wants5_or = wants4_or | (wants4 & (credit3 < 9'd154));  // rtl/src/pixel_planes/ring.rs:179
    wire wants5 = up_to_last[1] & !wants5_or;                    // rtl/src/pixel_planes/ring.rs:176
    wire goes4 = wants4 & (credit3 >= 9'd154);                   // rtl/src/pixel_planes/ring.rs:178
    wire [8:0] credit4 = goes4 ? (credit3 - 9'd154) : credit3;   // rtl/src/pixel_planes/ring.rs:180
    wire wants6_or = wants5_or | (wants5 & (credit4 < 9'd154));  // rtl/src/pixel_planes/ring.rs:179
    wire goes2_or_goes3 = goes2 | goes3;                         // rtl/src/pixel_planes/ring.rs:183
    wire wants6 = up_to_last[2] & (!wants6_or & !goes2_or_goes3); // rtl/src/pixel_planes/ring.rs:176
    wire goes5 = wants5 & (credit4 >= 9'd154);                   // rtl/src/pixel_planes/ring.rs:178
    wire [8:0] credit5 = goes5 ? (credit4 - 9'd154) : credit4;   // rtl/src/pixel_planes/ring.rs:180
    wire wants7_inverse = !(wants6_or | (wants6 & (credit5 < 9'd8))); // rtl/src/pixel_planes/ring.rs:175
    wire goes6 = wants6 & (credit5 >= 9'd8);                     // rtl/src/pixel_planes/ring.rs:178
    wire wants7 = up_to_last[3] & (wants7_inverse & !(goes2_or_goes3 | goes6)); // rtl/src/pixel_planes/ring.rs:176
    wire [8:0] credit6 = goes6 ? (credit5 - 9'd8) : credit5;     // rtl/src/pixel_planes/ring.rs:180
    wire goes7 = wants7 & (credit6 >= 9'd8);                     // rtl/src/pixel_planes/ring.rs:178
    wire [3:0] granted = {goes3 | goes7, goes2 | goes6, goes1 | goes5, goes0 | goes4}; // rtl/src/pixel_planes/ring.rs:117
    assign bins_0_ready = granted[0];                            // rtl/src/pixel_planes/ring.rs:122
    assign bins_1_ready = granted[1];                            // rtl/src/pixel_planes/ring.rs:122
    wire [1:0] of_plane = granted[3:2];                          // rtl/src/pixel_planes/ring.rs:129
    assign finished_0_ready = of_plane[0];                       // rtl/src/pixel_planes/ring.rs:133
    assign finished_1_ready = of_plane[1];                       // rtl/src/pixel_planes/ring.rs:133
    assign instructions_0_valid = granted[0];                    // rtl/src/pixel_planes/ring.rs:122
    assign instructions_1_valid = granted[1];                    // rtl/src/pixel_planes/ring.rs:122
    assign planes_region = of_plane[1] ? finished_1_region : finished_0_region; // rtl/src/pixel_planes/ring.rs:136
    assign planes_line = of_plane[1] ? finished_1_line : finished_0_line; // rtl/src/pixel_planes/ring.rs:136
    assign planes_plane = of_plane[1] ? finished_1_plane : finished_0_plane; // rtl/src/pixel_planes/ring.rs:136
    assign planes_valid = |of_plane;                             // rtl/src/pixel_planes/ring.rs:137
    wire line_ends = planes_plane == 6'd47;                      // rtl/src/pixel_planes/ring.rs:139
    wire [8:0] credit7 = goes7 ? (credit6 - 9'd8) : credit6;     // rtl/src/pixel_planes/ring.rs:180
    wire [8:0] credit7_plus_125 = credit7 + 9'd125;              // rtl/src/pixel_planes/ring.rs:165

    genvar i;

    generate
        for (i = 0; i < 8; i = i + 1) begin : row
            wire planes_bits_choice = of_plane[1] ? finished_1_bits[i] : finished_0_bits[i];
        end
    endgenerate

    assign requests_and_3 = bins_1_valid & room[1];              // rtl/src/pixel_planes/ring.rs:121
    assign requests_and_4 = bins_0_valid & room[0];              // rtl/src/pixel_planes/ring.rs:121
    generate
        for (i = 0; i < 8; i = i + 1) begin : planes_bits_of
            assign planes_bits[i] = row[i].planes_bits_choice;
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
            if (credit7_plus_125 > 9'd278) credit <= 9'd278;
            else credit <= credit7_plus_125;
            if (goes7) last <= 4'd8;
            else if (goes6) last <= 4'd4;
            else if (goes5) last <= 4'd2;
            else if (goes4) last <= 4'd1;
            else if (goes3) last <= 4'd8;
            else if (goes2) last <= 4'd4;
            else if (goes1) last <= 4'd2;
            else if (goes0) last <= 4'd1;
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
        if (!rst) assume (!instructions_0_valid | instructions_0_ready); // rtl/src/pixel_planes/ring.rs:123
        if (!rst) assume (!instructions_1_valid | instructions_1_ready); // rtl/src/pixel_planes/ring.rs:123
        if (!rst) assume (!planes_valid | planes_ready);             // rtl/src/pixel_planes/ring.rs:138
    end
`else
    always @(posedge clk) begin
        if (!rst && !(!instructions_0_valid | instructions_0_ready)) begin // rtl/src/pixel_planes/ring.rs:123
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a queue that has room takes an instruction", $time);
            stop;
        end
        if (!rst && !(!instructions_1_valid | instructions_1_ready)) begin // rtl/src/pixel_planes/ring.rs:123
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a queue that has room takes an instruction", $time);
            stop;
        end
        if (!rst && !(!planes_valid | planes_ready)) begin           // rtl/src/pixel_planes/ring.rs:138
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: the frame buffer takes each plane", $time);
            stop;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, instructions_0_ready, instructions_1_ready, planes_ready};
endmodule
`default_nettype wire
