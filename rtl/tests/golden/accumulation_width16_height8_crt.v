// accumulation_width16_height8_crt
//
// Adds up the pictures of several passes and shows their average.
//
// Parameters  Accumulation { screen: Screen { width: 16, height: 8 }, crt: Clock { name: "crt", period: Period(7934) } }
// Latency     a pass of 129 clocks of the merger; 1 clock of the display to read
// Source      VC-1, section 3.3, accumulation buffer and MUACC (VC1-ACB)
// Described   rtl/src/gfb/accumulation.rs:81
// Stable      passes: the number of passes is constant while the average is shown (rtl/src/gfb/accumulation.rs:167)
`default_nettype none

module accumulation_width16_height8_crt (
    input  wire        merge_clk,
    input  wire        merge_rst,
    input  wire        crt_clk,
    input  wire        start,        // High for one clock to begin a pass; only while not busy.
    // The pass that begins with `start` is the first: its colours are stored. Those of later passes are added.
    input  wire        first,
    // The word at the address of the previous clock: a depth, which is ignored, above a colour.
    input  wire [47:0] word,
    input  wire [1:0]  passes,       // The number of passes in the average.
    input  wire [6:0]  read_address, // The number of the pixel to show, in raster order.
    output wire        busy,         // A pass is under way.
    output reg  [6:0]  address,      // The number of the pixel that the pass reads, in raster order.
    // The average at the read address of the previous clock: red above green above blue.
    output wire [23:0] colour
);

    localparam [1:0] PASSES_TWO   = 2'd0;
    localparam [1:0] PASSES_FOUR  = 2'd1;
    localparam [1:0] PASSES_EIGHT = 2'd2;
    // Not used here: PASSES_SIXTEEN = 3.

    reg reads;                                                   // rtl/src/gfb/accumulation.rs:124
    reg stores;                                                  // rtl/src/gfb/accumulation.rs:129
    reg [6:0] stored;                                            // rtl/src/gfb/accumulation.rs:131
    reg replaces;                                                // rtl/src/gfb/accumulation.rs:150
    reg [3:0] may_follow;                                        // rtl/src/gfb/accumulation.rs:157
    reg read_odd;                                                // rtl/src/gfb/accumulation.rs:168

    wire [35:0] so_far_picked;                                   // rtl/src/gfb/accumulation.rs:151
    wire [35:0] sums_write_lanes;                                // rtl/src/gfb/accumulation.rs:154
    wire [35:0] read_at_read_odd;                                // rtl/src/gfb/accumulation.rs:170
    wire ends = address == 7'd127;                               // rtl/src/gfb/accumulation.rs:126
    assign busy = reads | stores;                                // rtl/src/gfb/accumulation.rs:132
    wire stored_0 = stored[0];                                   // rtl/src/gfb/accumulation.rs:151
    wire [35:0] so_far = replaces ? 36'd0 : so_far_picked;       // rtl/src/gfb/accumulation.rs:151
    wire [23:0] word_23_0 = word[23:0];                          // rtl/src/gfb/accumulation.rs:152
    wire [12:0] asserted_product = {8'd0, 5'd16 - {1'd0, may_follow}} * 13'd255; // rtl/src/gfb/accumulation.rs:162

    genvar i;

    generate
        for (i = 0; i < 2; i = i + 1) begin : parity_row
            (* no_rw_check *)
            reg [35:0] sums [0:63];                                      // rtl/src/gfb/accumulation.rs:137
            reg [35:0] old;                                              // rtl/src/gfb/accumulation.rs:147
            reg [35:0] read;                                             // rtl/src/gfb/accumulation.rs:169
            wire parity;
            localparam [31:0] parity_value = i;
            assign parity = parity_value[0];
            wire reads_here = reads & (parity == address[0]);
            wire stores_here = stores & (parity == stored[0]);
            wire [6:0] pixel = stores_here ? stored : address;

            always @(posedge merge_clk) begin
                if (stores_here) sums[pixel[6:1]] <= sums_write_lanes;
                if (reads_here) old <= sums[pixel[6:1]];
            end

            always @(posedge crt_clk) begin
                read <= sums[read_address[6:1]];
            end
            `ifndef SYNTHESIS
            `ifdef FORMAL
            always @(posedge merge_clk) begin
                if (!merge_rst) assert (!(reads_here & stores_here));        // rtl/src/gfb/accumulation.rs:146
            end
            `else
            always @(posedge merge_clk) begin
                if (!merge_rst && (reads_here & stores_here)) begin          // rtl/src/gfb/accumulation.rs:146
                    $display("FAIL: time %0t: %m: no memory is read and written in the same clock", $time);
                    stop;
                end
            end
            `endif
            `endif
            wire _unused_lane = &{1'b0, pixel[0]};
        end
    endgenerate

    generate
        for (i = 0; i < 3; i = i + 1) begin : added_row
            wire [11:0] added = so_far[i * 12 +: 12] + {4'd0, word_23_0[i * 8 +: 8]};
            `ifndef SYNTHESIS
            `ifdef FORMAL
            always @(posedge merge_clk) begin
                if (!merge_rst) assert (!stores | (added <= asserted_product[11:0])); // rtl/src/gfb/accumulation.rs:163
            end
            `else
            always @(posedge merge_clk) begin
                if (!merge_rst && !(!stores | (added <= asserted_product[11:0]))) begin // rtl/src/gfb/accumulation.rs:163
                    $display("FAIL: time %0t: %m: no sum exceeds the greatest that the passes so far can give", $time);
                    stop;
                end
            end
            `endif
            `endif
        end
    endgenerate

    generate
        for (i = 0; i < 3; i = i + 1) begin : colour_choice_row
            reg [8:0] colour_choice;
            always @* begin
                case (passes)
                    PASSES_TWO: colour_choice = read_at_read_odd[i * 12 +: 9];
                    PASSES_FOUR: colour_choice = read_at_read_odd[i * 12 + 1 +: 9];
                    PASSES_EIGHT: colour_choice = read_at_read_odd[i * 12 + 2 +: 9];
                    default: colour_choice = read_at_read_odd[i * 12 + 3 +: 9]; // PASSES_SIXTEEN
                endcase
            end
            wire [7:0] colour_sum = colour_choice[8:1] + {7'd0, colour_choice[0]};
        end
    endgenerate

    wire [35:0] so_far_picked_lanes [0:1];
    generate
        for (i = 0; i < 2; i = i + 1) begin : so_far_picked_of
            assign so_far_picked_lanes[i] = parity_row[i].old;
        end
    endgenerate
    assign so_far_picked = so_far_picked_lanes[stored_0];        // rtl/src/gfb/accumulation.rs:151
    generate
        for (i = 0; i < 3; i = i + 1) begin : sums_write_lanes_of
            assign sums_write_lanes[i * 12 +: 12] = added_row[i].added;
        end
    endgenerate
    wire [35:0] read_at_read_odd_lanes [0:1];
    generate
        for (i = 0; i < 2; i = i + 1) begin : read_at_read_odd_of
            assign read_at_read_odd_lanes[i] = parity_row[i].read;
        end
    endgenerate
    assign read_at_read_odd = read_at_read_odd_lanes[read_odd];  // rtl/src/gfb/accumulation.rs:170
    generate
        for (i = 0; i < 3; i = i + 1) begin : colour_of
            assign colour[i * 8 +: 8] = colour_choice_row[i].colour_sum;
        end
    endgenerate

    always @(posedge merge_clk) begin
        stored <= address;
    end

    always @(posedge merge_clk) begin
        if (start) replaces <= first;
    end

    always @(posedge crt_clk) begin
        read_odd <= read_address[0];
    end

    always @(posedge merge_clk) begin
        if (merge_rst) begin
            reads <= 1'b0;
            address <= 7'd0;
            stores <= 1'b0;
            may_follow <= 4'd0;
        end else begin
            if (start) reads <= 1'b1;
            else if (ends) reads <= 1'b0;
            if (ends) address <= 7'd0;
            else if (reads) address <= address + 7'd1;
            stores <= reads;
            if (start) begin
                if (first) may_follow <= 4'd15;
                else may_follow <= may_follow - 4'd1;
            end
        end
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
    always @(posedge merge_clk) begin
        if (!merge_rst) assume (!start | !busy);                     // rtl/src/gfb/accumulation.rs:133
        if (!merge_rst) assume (!(start & !first) | (may_follow != 4'd0)); // rtl/src/gfb/accumulation.rs:160
        if (!merge_rst) cover (stores & (may_follow == 4'd0));       // rtl/src/gfb/accumulation.rs:164
    end
`else
    reg is_covered;
    initial is_covered = 1'b0;
    always @(posedge merge_clk) begin
        if (!merge_rst && !(!start | !busy)) begin                   // rtl/src/gfb/accumulation.rs:133
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a pass begins only while none is under way", $time);
            stop;
        end
        if (!merge_rst && !(!(start & !first) | (may_follow != 4'd0))) begin // rtl/src/gfb/accumulation.rs:160
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a pass is the first, or one of at most 15 that follow it", $time);
            stop;
        end
        if (!merge_rst && (stores & (may_follow == 4'd0)) && !is_covered) begin // rtl/src/gfb/accumulation.rs:164
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: a pixel is the sum of 16 passes", $time);
            `endif
            is_covered <= 1'b1;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, word[47:24], asserted_product};
endmodule
`default_nettype wire
