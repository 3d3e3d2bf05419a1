// adder
//
// Parameters  adder
// Latency     0 clocks
// Described   gen/tests/lanes/modules.rs:240
`default_nettype none

module adder (
    input  wire [7:0] x,
    input  wire [7:0] y,
    output wire [7:0] sum
);

    assign sum = x + y;                                          // gen/tests/lanes/modules.rs:242
endmodule
`default_nettype wire
