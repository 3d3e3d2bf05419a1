// latest_
//
// A single register by priority, after a reset.
//
// Parameters  Latest
// Described   gen/tests/blocks/mod.rs:192
`default_nettype none

module latest_ (
    input  wire       clk,
    input  wire       rst,
    input  wire       forget,
    input  wire       load,
    input  wire [7:0] value,
    output reg  [7:0] latest
);

    always @(posedge clk) begin
        if (rst) latest <= 8'd0;
        else if (forget) latest <= 8'd0;
        else if (load) latest <= value;
    end
endmodule
`default_nettype wire
