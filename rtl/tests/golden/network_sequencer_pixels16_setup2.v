// network_sequencer_pixels16_setup2
//
// Schedules the words of a direction of the network.
//
// Parameters  NetworkSequencer { pixels: 16, setup: 2 }
// Latency     5 clocks from taking a job to ready, if the bank is given
// Source      Reducing Latency on PixelFlow, section 3 (PFL-NET, PFL-SETUP)
// Described   rtl/src/pixelflow/network_sequencer.rs:29
`default_nettype none

module network_sequencer_pixels16_setup2 (
    input  wire       clk,
    input  wire       rst,
    // The jobs, one for each word.
    input  wire       jobs_valid,
    input  wire [1:0] jobs_mode,  // The mode of the node for the word: a `Mode`.
    input  wire       jobs_bank,  // The bank of the word, unless the node forwards.
    // The bytes of the word, 1 to 32; or 0 before the node that loads, where the mode has to be `Mode::Forward`.
    input  wire [5:0] jobs_bytes,
    input  wire [1:0] given,      // The banks that the array has given: a bit for each.
    input  wire       go,         // All nodes are ready.
    input  wire [3:0] pixel,      // The current pixel of each chip.
    input  wire       advances,   // A byte of the current pixel is transferred.
    output wire [1:0] mode,       // The mode of the port: a `Mode`.
    output wire       sends,      // The node sends a byte of each chip.
    output reg        first,      // The byte is the first of its word.
    output reg  [1:0] bank,       // The bank, if the job needs one: a bit for each.
    output reg  [4:0] address,    // The address of the byte in the bank.
    output wire       ready,      // The node is ready for its word.
    output wire [1:0] done,       // For one clock: the network is done with a bank; a bit for each.
    output wire       idle,       // The node has no job.
    output wire       jobs_ready
);

    localparam [1:0] MODE_FORWARD = 2'd0;
    localparam [1:0] MODE_LOAD    = 2'd1;
    // Not used here: MODE_COMPOSITE = 2, MODE_UNLOAD = 3.
    localparam [2:0] PHASE_IDLE   = 3'd0;
    localparam [2:0] PHASE_BANK   = 3'd1;
    localparam [2:0] PHASE_SET_UP = 3'd2;
    localparam [2:0] PHASE_READY  = 3'd3;
    localparam [2:0] PHASE_SENDS  = 3'd4;

    reg [2:0] phase;                                             // rtl/src/pixelflow/network_sequencer.rs:104
    reg [1:0] job_mode;                                          // rtl/src/pixelflow/network_sequencer.rs:106
    reg empty;                                                   // rtl/src/pixelflow/network_sequencer.rs:110
    reg [1:0] waited;                                            // rtl/src/pixelflow/network_sequencer.rs:113

    assign jobs_ready = phase == PHASE_IDLE;                     // rtl/src/pixelflow/network_sequencer.rs:105
    wire jobs_taken = jobs_valid & jobs_ready;                   // rtl/src/pixelflow/network_sequencer.rs:105
    wire has_bank = (bank & ~given) == 2'd0;                     // rtl/src/pixelflow/network_sequencer.rs:112
    wire byte_ends = advances & (pixel == 4'd15);                // rtl/src/pixelflow/network_sequencer.rs:115
    wire word_ends = byte_ends & (address == 5'd0);              // rtl/src/pixelflow/network_sequencer.rs:116
    wire begins = (job_mode == MODE_LOAD) & go;                  // rtl/src/pixelflow/network_sequencer.rs:117
    wire is_over = word_ends | (empty & go);                     // rtl/src/pixelflow/network_sequencer.rs:118
    wire ends_and = (phase == PHASE_READY) & (!begins & is_over); // rtl/src/pixelflow/network_sequencer.rs:126
    wire ends = ends_and | ((phase == PHASE_SENDS) & word_ends); // rtl/src/pixelflow/network_sequencer.rs:126
    wire [1:0] needs = (jobs_mode == MODE_FORWARD) ? 2'd0 : {jobs_bank, !jobs_bank}; // rtl/src/pixelflow/network_sequencer.rs:128
    wire [5:0] jobs_bytes_minus_1 = jobs_bytes - 6'd1;           // rtl/src/pixelflow/network_sequencer.rs:131
    assign ready = phase == PHASE_READY;                         // rtl/src/pixelflow/network_sequencer.rs:135
    assign sends = phase == PHASE_SENDS;                         // rtl/src/pixelflow/network_sequencer.rs:136
    assign done = ends ? bank : 2'd0;                            // rtl/src/pixelflow/network_sequencer.rs:141
    assign mode = (ready | sends) ? job_mode : MODE_FORWARD;     // rtl/src/pixelflow/network_sequencer.rs:143
    assign idle = (phase == PHASE_IDLE) & !jobs_valid;           // rtl/src/pixelflow/network_sequencer.rs:152

    always @(posedge clk) begin
        if (jobs_taken) begin
            address <= jobs_bytes_minus_1[4:0];
            first <= 1'b1;
        end else if (byte_ends) begin
            address <= address - 5'd1;
            first <= 1'b0;
        end
        if (jobs_taken) empty <= jobs_bytes == 6'd0;
        if (phase == PHASE_BANK) waited <= 2'd0;
        else waited <= waited + 2'd1;
    end

    always @(posedge clk) begin
        if (rst) begin
            phase <= PHASE_IDLE;
            job_mode <= MODE_FORWARD;
            bank <= 2'd0;
        end else begin
            case (phase)
                PHASE_IDLE: if (jobs_valid) phase <= PHASE_BANK;
                PHASE_BANK: if (has_bank) phase <= PHASE_SET_UP;
                PHASE_SET_UP: if (waited == 2'd2) phase <= PHASE_READY;
                PHASE_READY: begin
                    if (begins) phase <= PHASE_SENDS;
                    else if (is_over) phase <= PHASE_IDLE;
                end
                default: begin // PHASE_SENDS
                    if (word_ends) phase <= PHASE_IDLE;
                    else phase <= PHASE_SENDS;
                end
            endcase
            if (jobs_taken) begin
                job_mode <= jobs_mode;
                bank <= needs;
            end else if (ends) begin
                job_mode <= MODE_FORWARD;
                bank <= 2'd0;
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
    always @(posedge clk) begin
        if (!rst) assume (!jobs_taken | (jobs_bytes <= 6'd32));      // rtl/src/pixelflow/network_sequencer.rs:137
        if (!rst) assume (!jobs_taken | ((jobs_bytes != 6'd0) | (jobs_mode == MODE_FORWARD))); // rtl/src/pixelflow/network_sequencer.rs:137
        if (!rst) assume (!advances | (ready | sends));              // rtl/src/pixelflow/network_sequencer.rs:140
    end
`else
    always @(posedge clk) begin
        if (!rst && !(!jobs_taken | (jobs_bytes <= 6'd32))) begin    // rtl/src/pixelflow/network_sequencer.rs:137
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a word has at most 32 bytes", $time);
            stop;
        end
        if (!rst && !(!jobs_taken | ((jobs_bytes != 6'd0) | (jobs_mode == MODE_FORWARD)))) begin // rtl/src/pixelflow/network_sequencer.rs:137
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a job of no bytes forwards", $time);
            stop;
        end
        if (!rst && !(!advances | (ready | sends))) begin            // rtl/src/pixelflow/network_sequencer.rs:140
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: a word comes only when the node is ready for it", $time);
            stop;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, jobs_bytes_minus_1[5]};
endmodule
`default_nettype wire
