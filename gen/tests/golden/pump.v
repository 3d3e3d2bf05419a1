// pump
//
// A state machine.
//
// Parameters  Pump
// Described   gen/tests/blocks/mod.rs:39
`default_nettype none

module pump (
    input  wire       clk,
    input  wire       rst,
    input  wire       start,
    input  wire       full,
    input  wire       empty,
    output wire       busy,
    output reg  [3:0] valve
);

    localparam [1:0] PHASE_IDLE  = 2'd0;
    localparam [1:0] PHASE_FILL  = 2'd1;
    localparam [1:0] PHASE_DRAIN = 2'd2;

    reg [1:0] phase;                                             // gen/tests/blocks/mod.rs:48

    always @* begin
        case (phase)
            PHASE_IDLE: valve = 4'd0;
            PHASE_FILL: valve = 4'd3;
            default: valve = 4'd12; // PHASE_DRAIN
        endcase
    end
    assign busy = phase != PHASE_IDLE;                           // gen/tests/blocks/mod.rs:55

    always @(posedge clk) begin
        if (rst) begin
            phase <= PHASE_IDLE;
        end else begin
            case (phase)
                PHASE_IDLE: begin
                    if (start & !full) phase <= PHASE_FILL;
                    else if (start) phase <= PHASE_DRAIN;
                end
                PHASE_FILL: if (full) phase <= PHASE_DRAIN;
                default: begin // PHASE_DRAIN
                    if (empty) phase <= PHASE_IDLE;
                    else phase <= PHASE_DRAIN;
                end
            endcase
        end
    end
endmodule
`default_nettype wire
