// mirror
//
// Sends each place on, mirrored.
//
// Parameters  Mirror
// Latency     0 clocks
// Described   gen/tests/blocks/mod.rs:223
`default_nettype none

module mirror (
    // Where things are.
    input  wire [7:0] places_0_x,    // Counted from the left.
    input  wire [6:0] places_0_y,    // Counted from the top.
    input  wire [7:0] places_1_x,
    input  wire [6:0] places_1_y,
    // The axis.
    input  wire       axis_x,        // Counted from the left.
    input  wire       axis_y,        // Counted from the top.
    // Where there are any.
    input  wire       valid_0,
    input  wire       valid_1,
    // Where they look to be.
    output wire [7:0] places_0_left,
    output wire [6:0] places_0_top,
    output wire [7:0] places_1_left,
    output wire [6:0] places_1_top,
    output wire       seen           // Some are seen.
);

    assign places_0_left = axis_x ? ~places_0_x : places_0_x;    // gen/tests/blocks/mod.rs:244
    assign places_0_top = axis_y ? ~places_0_y : places_0_y;     // gen/tests/blocks/mod.rs:244
    assign places_1_left = axis_x ? ~places_1_x : places_1_x;    // gen/tests/blocks/mod.rs:244
    assign places_1_top = axis_y ? ~places_1_y : places_1_y;     // gen/tests/blocks/mod.rs:244
    assign seen = valid_0 | valid_1;                             // gen/tests/blocks/mod.rs:247
endmodule
`default_nettype wire
