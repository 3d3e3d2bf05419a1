// counter_width8_limit10
//
// Counts the clocks with `enable` high and starts again at a limit.
//
// Parameters  Counter { width: 8, limit: 10 }
// Latency     1 clock
// Described   gen/tests/blocks/mod.rs:6
`default_nettype none

module counter_width8_limit10 (
    input  wire       clk,
    input  wire       rst,
    input  wire       enable,  // It counts.
    output reg  [7:0] count,   // The clocks since it began.
    // It is at its limit, and begins anew with the next clock, which is said at such length that it stands above.
    output wire       wrapped
);

    wire at_end = count == 8'd9;                                 // gen/tests/blocks/mod.rs:28
    assign wrapped = at_end & enable;                            // gen/tests/blocks/mod.rs:30

    always @(posedge clk) begin
        if (rst) begin
            count <= 8'd0;
        end else if (enable) begin
            if (at_end) count <= 8'd0;
            else count <= count + 8'd1;
        end
    end
endmodule
`default_nettype wire
