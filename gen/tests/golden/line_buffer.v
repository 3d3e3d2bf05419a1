// line_buffer
//
// A line buffer of 1000 words and a table.
//
// Parameters  LineBuffer
// Described   gen/tests/blocks/mod.rs:59
`default_nettype none

module line_buffer (
    input  wire        clk,
    input  wire        write,
    input  wire [9:0]  write_x,
    input  wire [23:0] z,
    input  wire [9:0]  x,
    input  wire [1:0]  gain,
    output wire [23:0] nearest,
    output wire [31:0] scaled
);

    (* no_rw_check *)
    reg [23:0] line [0:999];                                     // gen/tests/blocks/mod.rs:68
    reg [23:0] line_read_word;
    reg line_read_inside;
    wire [23:0] line_read = line_read_inside ? line_read_word : 24'd0;
    reg [7:0] gains [0:3];                                       // gen/tests/blocks/mod.rs:70

    initial $readmemh("line_buffer.line.hex", line);

    initial begin : gains_contents
        gains[0] = 8'h01;
        gains[1] = 8'h02;
        gains[2] = 8'h04;
        gains[3] = 8'h08;
    end

    wire [7:0] gains_word = gains[gain];                         // gen/tests/blocks/mod.rs:72
    assign scaled = {8'd0, line_read} * {24'd0, gains_word};     // gen/tests/blocks/mod.rs:72

    always @(posedge clk) begin
        if (write) line[write_x] <= z;
        line_read_word <= line[x];
        line_read_inside <= x < 10'd1000;
    end

    assign nearest = line_read;
endmodule
`default_nettype wire
