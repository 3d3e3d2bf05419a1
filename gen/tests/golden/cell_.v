// cell_
//
// A cell of a systolic row.
//
// Parameters  Cell
// Described   gen/tests/blocks/mod.rs:77
`default_nettype none

module cell_ (
    input  wire       clk,
    input  wire       op,
    input  wire [3:0] x,
    input  wire [7:0] left,
    input  wire [7:0] weight,
    output reg  [7:0] q,
    output wire       hit,
    output wire [7:0] sum
);

    assign hit = q == left;                                      // gen/tests/blocks/mod.rs:88
    assign sum = (left ^ weight) + q;                            // gen/tests/blocks/mod.rs:88

    always @(posedge clk) begin
        if (op) q <= left + {4'd0, x};
    end
endmodule
`default_nettype wire
