// broadcast_bus_processors2_queue4_word_clocks6
//
// Carries packets from the host or any processor to all processors, word by word.
//
// Parameters  BroadcastBus { processors: 2, queue: 4, word_clocks: 6 }
// Latency     a word every 6 clocks, shown 1 clock later
// Source      VC-1, section 3.1, broadcast bus (VC1-NET, VC1-APR)
// Described   rtl/src/bus/broadcast_bus.rs:47
`default_nettype none

module broadcast_bus_processors2_queue4_word_clocks6 (
    input  wire        clk,
    input  wire        rst,
    // The packets of each processor, then those of the host.
    input  wire        senders_0_valid,
    input  wire [31:0] senders_0_word,   // A word of the packet.
    input  wire        senders_0_last,   // The word is the last of its packet.
    input  wire        senders_1_valid,
    input  wire [31:0] senders_1_word,
    input  wire        senders_1_last,
    input  wire        senders_2_valid,
    input  wire [31:0] senders_2_word,
    input  wire        senders_2_last,
    input  wire        received_0_ready,
    input  wire        received_1_ready,
    // All packets, for each processor.
    output wire        received_0_valid,
    output wire [31:0] received_0_word,  // A word of the packet.
    output wire        received_0_last,  // The word is the last of its packet.
    output wire        received_1_valid,
    output wire [31:0] received_1_word,
    output wire        received_1_last,
    output wire        idle,             // No word is on the bus, and every packet that has begun is complete.
    output wire [1:0]  empty,            // The processors that have taken all words that left the bus.
    output wire        senders_0_ready,
    output wire        senders_1_ready,
    output wire        senders_2_ready
);

    reg open;                                                    // rtl/src/bus/broadcast_bus.rs:96
    reg [1:0] sender;                                            // rtl/src/bus/broadcast_bus.rs:97
    reg on_bus;                                                  // rtl/src/bus/broadcast_bus.rs:101
    reg [31:0] word_word;                                        // rtl/src/bus/broadcast_bus.rs:111
    reg word_last;                                               // rtl/src/bus/broadcast_bus.rs:111
    reg [2:0] clocks_left;                                       // rtl/src/bus/broadcast_bus.rs:113
    reg [31:0] word_word_past;                                   // rtl/src/bus/broadcast_bus.rs:130
    reg word_last_past;                                          // rtl/src/bus/broadcast_bus.rs:130
    reg [2:0] sent;                                              // rtl/src/bus/broadcast_bus.rs:134

    wire [3:0] rank_min;                                         // rtl/src/bus/broadcast_bus.rs:100
    wire room;                                                   // rtl/src/bus/broadcast_bus.rs:120
    wire requests_any;                                           // rtl/src/bus/broadcast_bus.rs:104
    wire [31:0] word_word_next;                                  // rtl/src/bus/broadcast_bus.rs:106
    wire open_picked;                                            // rtl/src/bus/broadcast_bus.rs:106
    wire asserted_all;                                           // rtl/src/bus/broadcast_bus.rs:132
    wire asserted_any;                                           // rtl/src/bus/broadcast_bus.rs:132
    wire [2:0] sent_sum;                                         // rtl/src/bus/broadcast_bus.rs:135
    wire covered;                                                // rtl/src/bus/broadcast_bus.rs:151
    wire [1:0] next = rank_min[1:0];                             // rtl/src/bus/broadcast_bus.rs:100
    wire arrived = on_bus & (clocks_left == 3'd0);               // rtl/src/bus/broadcast_bus.rs:115
    wire delivers = arrived & room;                              // rtl/src/bus/broadcast_bus.rs:102
    wire free = !on_bus | delivers;                              // rtl/src/bus/broadcast_bus.rs:103
    wire takes = free & requests_any;                            // rtl/src/bus/broadcast_bus.rs:104
    wire asserted_and = on_bus & (word_word == word_word_past) & (word_last == word_last_past); // rtl/src/bus/broadcast_bus.rs:130
    wire covered_and_2 = senders_0_valid & senders_1_valid & senders_2_valid; // rtl/src/bus/broadcast_bus.rs:152
    assign idle = !on_bus & !open;                               // rtl/src/bus/broadcast_bus.rs:154

    genvar i;

    wire [2:0] others_row_requests_listed = {senders_2_valid, senders_1_valid, senders_0_valid};
    generate
        for (i = 0; i < 3; i = i + 1) begin : others_row
            reg [1:0] others;
            wire requests_listed = others_row_requests_listed[i];
            wire [1:0] number;
            localparam [31:0] number_value = i;
            assign number = number_value[1:0];
            wire requests = requests_listed & (!open | (number == sender));
            localparam [31:0] rank_listed = i;
            wire rank_at_most = $signed(rank_listed[3:0]) <= $signed({2'd0, sender});
            wire [3:0] rank = {!requests, rank_at_most, number};
            wire senders_0_ready_and = requests & (number == next) & free;
            wire sent_and = requests_listed & senders_0_ready_and;
            wire [2:0] sent_extended = {2'd0, sent_and};
            wire covered_and = requests_listed & open & (number != sender);

            always @(posedge clk) begin
                if (rst) others <= 2'd0;
                else if (!requests_listed | sent_and) others <= 2'd0;
                else if (requests_listed & takes & !open) others <= others + 2'd1;
            end
            `ifndef SYNTHESIS
            `ifdef FORMAL
            always @(posedge clk) begin
                if (!rst) assert (!(sent_and & open) | (number == sender));  // rtl/src/bus/broadcast_bus.rs:143
                if (!rst) assert (others <= 2'd2);                           // rtl/src/bus/broadcast_bus.rs:147
            end
            `else
            always @(posedge clk) begin
                if (!rst && !(!(sent_and & open) | (number == sender))) begin // rtl/src/bus/broadcast_bus.rs:143
                    $display("FAIL: time %0t: %m: no word comes between those of another packet", $time);
                    stop;
                end
                if (!rst && !(others <= 2'd2)) begin                         // rtl/src/bus/broadcast_bus.rs:147
                    $display("FAIL: time %0t: %m: a packet waits for at most one packet of each other sender", $time);
                    stop;
                end
            end
            `endif
            `endif
        end
    endgenerate

    wire [95:0] word_word_listed_row_word_word_listed = {senders_2_word, senders_1_word, senders_0_word};
    generate
        for (i = 0; i < 3; i = i + 1) begin : word_word_listed_row
            wire [31:0] word_word_listed = word_word_listed_row_word_word_listed[i * 32 +: 32];
        end
    endgenerate

    wire [2:0] open_listed_row_open_listed = {senders_2_last, senders_1_last, senders_0_last};
    generate
        for (i = 0; i < 3; i = i + 1) begin : open_listed_row
            wire open_listed = open_listed_row_open_listed[i];
        end
    endgenerate

    wire [1:0] u_queue_out_ready = {received_1_ready, received_0_ready};
    generate
        for (i = 0; i < 2; i = i + 1) begin : u_queue                // rtl/src/bus/broadcast_bus.rs:123
            wire out_valid;
            wire [32:0] out_payload;
            wire into_ready;
            reg [2:0] seen;
            wire out_ready = u_queue_out_ready[i];
            wire empty_lane = !out_valid;
            wire leaves = out_valid & out_ready;
            wire [2:0] queued = sent - seen - {2'd0, on_bus};

            fifo_depth4_width33_storage_registers lane (
                .clk          (clk),
                .rst          (rst),
                .into_valid   (delivers),
                .into_payload ({word_word, word_last}),
                .out_ready    (out_ready),
                .out_valid    (out_valid),
                .out_payload  (out_payload),
                .into_ready   (into_ready)
            );

            always @(posedge clk) begin
                if (rst) seen <= 3'd0;
                else if (leaves) seen <= seen + 3'd1;
            end
            `ifndef SYNTHESIS
            `ifdef FORMAL
            always @(posedge clk) begin
                if (!rst) assert (queued <= 3'd4);                           // rtl/src/bus/broadcast_bus.rs:139
                if (!rst) assert (empty_lane == (queued == 3'd0));           // rtl/src/bus/broadcast_bus.rs:140
            end
            `else
            always @(posedge clk) begin
                if (!rst && !(queued <= 3'd4)) begin                         // rtl/src/bus/broadcast_bus.rs:139
                    $display("FAIL: time %0t: %m: the words taken and not yet received fit in the queue", $time);
                    stop;
                end
                if (!rst && !(empty_lane == (queued == 3'd0))) begin         // rtl/src/bus/broadcast_bus.rs:140
                    $display("FAIL: time %0t: %m: a processor whose queue is empty has received all that left the bus", $time);
                    stop;
                end
            end
            `endif
            `endif
            wire _unused_lane = &{1'b0, out_payload, queued};
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : delivers_and_u_queue_into_ready_row
            wire delivers_and_u_queue_into_ready = delivers & u_queue[i].into_ready;
        end
    endgenerate

    generate
        for (i = 0; i < 5; i = i + 1) begin : rank_min_tree
            wire [3:0] value;
            if (i < 3) begin : leaf
                assign value = others_row[i].rank;
            end else begin : pair
                wire [3:0] a = rank_min_tree[2 * (i - 3)].value;
                wire [3:0] b = rank_min_tree[2 * (i - 3) + 1].value;
                assign value = (a < b) ? a : b;
            end
        end
    endgenerate
    assign rank_min = rank_min_tree[4].value;                    // rtl/src/bus/broadcast_bus.rs:100
    wire [1:0] room_lanes;
    generate
        for (i = 0; i < 2; i = i + 1) begin : room_of
            assign room_lanes[i] = u_queue[i].into_ready;
        end
    endgenerate
    assign room = &room_lanes;                                   // rtl/src/bus/broadcast_bus.rs:120
    assign senders_0_ready = others_row[0].senders_0_ready_and;  // rtl/src/bus/broadcast_bus.rs:95
    assign senders_1_ready = others_row[1].senders_0_ready_and;  // rtl/src/bus/broadcast_bus.rs:95
    assign senders_2_ready = others_row[2].senders_0_ready_and;  // rtl/src/bus/broadcast_bus.rs:95
    wire [2:0] requests_any_lanes;
    generate
        for (i = 0; i < 3; i = i + 1) begin : requests_any_of
            assign requests_any_lanes[i] = others_row[i].requests;
        end
    endgenerate
    assign requests_any = |requests_any_lanes;                   // rtl/src/bus/broadcast_bus.rs:104
    wire [31:0] word_word_next_lanes [0:2];
    generate
        for (i = 0; i < 3; i = i + 1) begin : word_word_next_of
            assign word_word_next_lanes[i] = word_word_listed_row[i].word_word_listed;
        end
    endgenerate
    assign word_word_next = (next < 2'd3) ? word_word_next_lanes[next] : 32'd0; // rtl/src/bus/broadcast_bus.rs:106
    wire [2:0] open_picked_lanes;
    generate
        for (i = 0; i < 3; i = i + 1) begin : open_picked_of
            assign open_picked_lanes[i] = open_listed_row[i].open_listed;
        end
    endgenerate
    assign open_picked = (next < 2'd3) ? open_picked_lanes[next] : 1'b0; // rtl/src/bus/broadcast_bus.rs:106
    assign received_0_word = u_queue[0].out_payload[32:1];       // rtl/src/bus/broadcast_bus.rs:126
    assign received_0_last = u_queue[0].out_payload[0];          // rtl/src/bus/broadcast_bus.rs:126
    assign received_1_word = u_queue[1].out_payload[32:1];       // rtl/src/bus/broadcast_bus.rs:126
    assign received_1_last = u_queue[1].out_payload[0];          // rtl/src/bus/broadcast_bus.rs:126
    wire [1:0] asserted_all_lanes;
    generate
        for (i = 0; i < 2; i = i + 1) begin : asserted_all_of
            assign asserted_all_lanes[i] = delivers_and_u_queue_into_ready_row[i].delivers_and_u_queue_into_ready;
        end
    endgenerate
    assign asserted_all = &asserted_all_lanes;                   // rtl/src/bus/broadcast_bus.rs:132
    wire [1:0] asserted_any_lanes;
    generate
        for (i = 0; i < 2; i = i + 1) begin : asserted_any_of
            assign asserted_any_lanes[i] = delivers_and_u_queue_into_ready_row[i].delivers_and_u_queue_into_ready;
        end
    endgenerate
    assign asserted_any = |asserted_any_lanes;                   // rtl/src/bus/broadcast_bus.rs:132
    generate
        for (i = 0; i < 5; i = i + 1) begin : sent_sum_tree
            wire [2:0] value;
            if (i < 3) begin : leaf
                assign value = others_row[i].sent_extended;
            end else begin : pair
                assign value = sent_sum_tree[2 * (i - 3)].value + sent_sum_tree[2 * (i - 3) + 1].value;
            end
        end
    endgenerate
    assign sent_sum = sent_sum_tree[4].value;                    // rtl/src/bus/broadcast_bus.rs:135
    wire [2:0] covered_lanes;
    generate
        for (i = 0; i < 3; i = i + 1) begin : covered_of
            assign covered_lanes[i] = others_row[i].covered_and;
        end
    endgenerate
    assign covered = |covered_lanes;                             // rtl/src/bus/broadcast_bus.rs:151
    generate
        for (i = 0; i < 2; i = i + 1) begin : empty_of
            assign empty[i] = u_queue[i].empty_lane;
        end
    endgenerate

    always @(posedge clk) begin
        if (takes) begin
            word_word <= word_word_next;
            word_last <= open_picked;
        end
    end

    always @(posedge clk) begin
        if (takes) clocks_left <= 3'd5;
        else if (clocks_left != 3'd0) clocks_left <= clocks_left - 3'd1;
        word_word_past <= word_word;
        word_last_past <= word_last;
    end

    always @(posedge clk) begin
        if (rst) begin
            open <= 1'b0;
            sender <= 2'd2;
            on_bus <= 1'b0;
            sent <= 3'd0;
        end else begin
            if (takes) begin
                open <= !open_picked;
                sender <= next;
            end
            if (takes) on_bus <= 1'b1;
            else if (delivers) on_bus <= 1'b0;
            sent <= sent + sent_sum;
        end
    end

    assign received_0_valid = u_queue[0].out_valid;
    assign received_1_valid = u_queue[1].out_valid;

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
    reg past;                                                    // rtl/src/bus/broadcast_bus.rs:131
    reg takes_past;                                              // rtl/src/bus/broadcast_bus.rs:144
    reg has_past;                                                // rtl/src/bus/broadcast_bus.rs:131

    initial has_past = 1'b0;

    always @(posedge clk) begin
        past <= on_bus & !delivers;
        takes_past <= takes;
    end

    always @(posedge clk) begin
        if (rst) has_past <= 1'b0;
        else has_past <= 1'b1;
    end

`ifdef FORMAL
    always @(posedge clk) begin
        if (!rst) assert (!has_past | (!past | asserted_and));       // rtl/src/bus/broadcast_bus.rs:131
        if (!rst) assert (asserted_all == asserted_any);             // rtl/src/bus/broadcast_bus.rs:132
        if (!rst) assert (!has_past | (!takes_past | (open == !word_last))); // rtl/src/bus/broadcast_bus.rs:144
        if (!rst) cover (arrived & !room);                           // rtl/src/bus/broadcast_bus.rs:149
        if (!rst) cover (open & free & !takes);                      // rtl/src/bus/broadcast_bus.rs:150
        if (!rst) cover (covered);                                   // rtl/src/bus/broadcast_bus.rs:151
        if (!rst) cover (!open & !free & covered_and_2);             // rtl/src/bus/broadcast_bus.rs:152
        if (!rst) cover (delivers & takes & !open);                  // rtl/src/bus/broadcast_bus.rs:153
    end
`else
    reg is_covered;
    initial is_covered = 1'b0;
    reg is_covered_2;
    initial is_covered_2 = 1'b0;
    reg is_covered_3;
    initial is_covered_3 = 1'b0;
    reg is_covered_4;
    initial is_covered_4 = 1'b0;
    reg is_covered_5;
    initial is_covered_5 = 1'b0;
    always @(posedge clk) begin
        if (!rst && !(!has_past | (!past | asserted_and))) begin     // rtl/src/bus/broadcast_bus.rs:131
            $display("FAIL: time %0t: %m: a word stays on the bus until it goes to the queues", $time);
            stop;
        end
        if (!rst && !(asserted_all == asserted_any)) begin           // rtl/src/bus/broadcast_bus.rs:132
            $display("FAIL: time %0t: %m: a word goes to all queues or to none", $time);
            stop;
        end
        if (!rst && !(!has_past | (!takes_past | (open == !word_last)))) begin // rtl/src/bus/broadcast_bus.rs:144
            $display("FAIL: time %0t: %m: a packet is open until its last word", $time);
            stop;
        end
        if (!rst && (arrived & !room) && !is_covered) begin          // rtl/src/bus/broadcast_bus.rs:149
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: a full queue stalls the bus", $time);
            `endif
            is_covered <= 1'b1;
        end
        if (!rst && (open & free & !takes) && !is_covered_2) begin   // rtl/src/bus/broadcast_bus.rs:150
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: a sender pauses within its packet", $time);
            `endif
            is_covered_2 <= 1'b1;
        end
        if (!rst && covered && !is_covered_3) begin                  // rtl/src/bus/broadcast_bus.rs:151
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: a sender waits for the packet of another", $time);
            `endif
            is_covered_3 <= 1'b1;
        end
        if (!rst && (!open & !free & covered_and_2) && !is_covered_4) begin // rtl/src/bus/broadcast_bus.rs:152
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: all senders wait", $time);
            `endif
            is_covered_4 <= 1'b1;
        end
        if (!rst && (delivers & takes & !open) && !is_covered_5) begin // rtl/src/bus/broadcast_bus.rs:153
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: a packet follows another without a pause", $time);
            `endif
            is_covered_5 <= 1'b1;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, rank_min[3:2], asserted_and, asserted_all, asserted_any, covered,
            covered_and_2};
endmodule
`default_nettype wire
