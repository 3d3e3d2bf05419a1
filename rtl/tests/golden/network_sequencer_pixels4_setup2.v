// network_sequencer_pixels4_setup2
//
// Schedules the words of a direction of the network.
//
// Parameters  NetworkSequencer { pixels: 4, setup: 2 }
// Latency     5 clocks from a job to ready, if it has its bank
// Source      Reducing Latency on PixelFlow, section 3 (PFL-NET, PFL-SETUP)
// Described   rtl/src/pixelflow/network_sequencer.rs:108
`default_nettype none

module network_sequencer_pixels4_setup2 (
    input  wire       clk,
    input  wire       rst,
    // What to do with each word, in turn.
    input  wire       jobs_valid,
    input  wire [1:0] jobs_mode,  // A `Mode`.
    input  wire       jobs_bank,  // The bank, unless it forwards.
    input  wire [5:0] jobs_bytes, // Bytes of a word, 1 to 32.
    input  wire [1:0] given,      // Banks that the array has given: a bit for each.
    input  wire       go,         // All nodes are ready.
    input  wire [1:0] pixel,      // The pixel of each chip whose turn it is.
    input  wire       advances,   // A byte of it goes.
    output wire [1:0] mode,       // To the port: a `Mode`.
    output wire       sends,      // A byte of the node goes.
    output reg        first,      // It is the first of its word.
    output reg  [1:0] bank,       // The bank, if the job needs one: a bit for each.
    output reg  [4:0] address,    // The byte of the bank.
    output wire       ready,      // The node is set for its word.
    output wire [1:0] done,       // The network has done with a bank: a bit for each.
    output wire       idle,       // There is no job.
    output wire       jobs_ready
);

    localparam [1:0] MODE_FORWARD   = 2'd0;
    localparam [1:0] MODE_LOAD      = 2'd1;
    // not mentioned: localparam [1:0] MODE_COMPOSITE = 2'd2;
    // not mentioned: localparam [1:0] MODE_UNLOAD    = 2'd3;
    localparam [2:0] PHASE_IDLE   = 3'd0;
    localparam [2:0] PHASE_BANK   = 3'd1;
    localparam [2:0] PHASE_SET_UP = 3'd2;
    localparam [2:0] PHASE_READY  = 3'd3;
    localparam [2:0] PHASE_SENDS  = 3'd4;

    reg [2:0] phase;                                             // rtl/src/pixelflow/network_sequencer.rs:108
    reg [1:0] job_mode;                                          // rtl/src/pixelflow/network_sequencer.rs:110
    reg [1:0] waited;                                            // rtl/src/pixelflow/network_sequencer.rs:116

    assign jobs_ready = phase == PHASE_IDLE;                     // rtl/src/pixelflow/network_sequencer.rs:109
    wire jobs_taken = jobs_valid & jobs_ready;                   // rtl/src/pixelflow/network_sequencer.rs:109
    wire has_bank = (bank & ~given) == 2'd0;                     // rtl/src/pixelflow/network_sequencer.rs:115
    wire is_set = waited == 2'd2;                                // rtl/src/pixelflow/network_sequencer.rs:117
    wire loads = job_mode == MODE_LOAD;                          // rtl/src/pixelflow/network_sequencer.rs:118
    wire byte_ends = advances & (pixel == 2'd3);                 // rtl/src/pixelflow/network_sequencer.rs:119
    wire ends = byte_ends & (address == 5'd0);                   // rtl/src/pixelflow/network_sequencer.rs:120
    wire [1:0] needs = (jobs_mode == MODE_FORWARD) ? 2'd0 : {jobs_bank, !jobs_bank}; // rtl/src/pixelflow/network_sequencer.rs:122
    wire [5:0] address_difference = jobs_bytes - 6'd1;           // rtl/src/pixelflow/network_sequencer.rs:125
    assign ready = phase == PHASE_READY;                         // rtl/src/pixelflow/network_sequencer.rs:135
    assign sends = phase == PHASE_SENDS;                         // rtl/src/pixelflow/network_sequencer.rs:136
    wire assumed_and = (jobs_bytes != 6'd0) & (jobs_bytes <= 6'd32); // rtl/src/pixelflow/network_sequencer.rs:138
    assign done = ends ? bank : 2'd0;                            // rtl/src/pixelflow/network_sequencer.rs:140
    assign mode = (ready | sends) ? job_mode : MODE_FORWARD;     // rtl/src/pixelflow/network_sequencer.rs:142
    assign idle = (phase == PHASE_IDLE) & !jobs_valid;           // rtl/src/pixelflow/network_sequencer.rs:151

    always @(posedge clk) begin
        if (jobs_taken) address <= address_difference[4:0];
        else if (byte_ends) address <= address - 5'd1;
        if (jobs_taken) first <= 1'b1;
        else if (byte_ends) first <= 1'b0;
        if (phase == PHASE_BANK) waited <= 2'd0;
        else waited <= waited + 2'd1;
    end

    always @(posedge clk) begin
        if (rst) begin
            phase <= PHASE_IDLE;
            job_mode <= MODE_FORWARD;
            bank <= 2'd0;
        end else begin
            if (jobs_taken) phase <= PHASE_BANK;
            else if ((phase == PHASE_BANK) & has_bank) phase <= PHASE_SET_UP;
            else if ((phase == PHASE_SET_UP) & is_set) phase <= PHASE_READY;
            else if ((phase == PHASE_READY) & loads & go) phase <= PHASE_SENDS;
            else if (ends) phase <= PHASE_IDLE;
            if (jobs_taken) job_mode <= jobs_mode;
            else if (ends) job_mode <= MODE_FORWARD;
            if (jobs_taken) bank <= needs;
            else if (ends) bank <= 2'd0;
        end
    end

`ifndef SYNTHESIS
`ifdef FORMAL
    always @(posedge clk) begin
        if (!rst) assume (!jobs_taken | assumed_and);                // rtl/src/pixelflow/network_sequencer.rs:137
        if (!rst) assume (!advances | (ready | sends));              // rtl/src/pixelflow/network_sequencer.rs:139
    end
`else
    always @(posedge clk) begin
        if (!rst && !(!jobs_taken | assumed_and)) begin              // rtl/src/pixelflow/network_sequencer.rs:137
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a word has 1 to 32 bytes", $time);
            $stop;
        end
        if (!rst && !(!advances | (ready | sends))) begin            // rtl/src/pixelflow/network_sequencer.rs:139
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a word comes when the node is ready for it", $time);
            $stop;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, address_difference[5], assumed_and};
endmodule
`default_nettype wire
