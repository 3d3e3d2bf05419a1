// Counts from 0 to LIMIT - 1 and starts again.
module counter #(parameter LIMIT = 5) (
    input  wire                       clk,
    input  wire                       rst,
    input  wire                       restart,
    input  wire                       enable,
    output reg  [$clog2(LIMIT) - 1:0] count,
    output wire                       wraps
);
    assign wraps = enable && !restart && count == LIMIT - 1;

    always @(posedge clk)
        if (rst || restart || wraps) count <= 0;
        else if (enable) count <= count + 1;
endmodule
