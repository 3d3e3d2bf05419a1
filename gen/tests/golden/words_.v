// words_
//
// Memories with several ports of each kind, of a depth that addresses exceed or do not.
//
// Parameters  Words
// Described   gen/tests/shapes/mod.rs:84
`default_nettype none

module words_ (
    input  wire       clk,
    input  wire [3:0] address,
    input  wire [2:0] low,
    input  wire [7:0] data,
    input  wire       write,
    output wire [7:0] old,
    output wire [7:0] gated,
    output wire [7:0] now,
    output wire [7:0] beyond,
    output wire [7:0] third,
    output wire [7:0] constants,
    output wire [7:0] loaded
);

    reg [7:0] words [0:10];                                      // gen/tests/shapes/mod.rs:93
    reg [7:0] words_read0_word;
    reg words_read0_inside;
    wire [7:0] words_read0 = words_read0_inside ? words_read0_word : 8'd0;
    reg [7:0] words_read1;                                       // gen/tests/shapes/mod.rs:96
    reg [7:0] some [0:4];                                        // gen/tests/shapes/mod.rs:98
    reg [7:0] some_read_word;
    reg some_read_inside;
    wire [7:0] some_read = some_read_inside ? some_read_word : 8'd0;
    reg [7:0] filled [0:15];                                     // gen/tests/shapes/mod.rs:100
    reg [7:0] filled_read;                                       // gen/tests/shapes/mod.rs:110
    reg [7:0] table_of_many [0:256];                             // gen/tests/shapes/mod.rs:101
    reg [7:0] table_of_many_read_word;
    reg table_of_many_read_inside;
    wire [7:0] table_of_many_read = table_of_many_read_inside ? table_of_many_read_word : 8'd0;
    reg [7:0] fixed [0:3];                                       // gen/tests/shapes/mod.rs:102
    reg [7:0] fixed_read;                                        // gen/tests/shapes/mod.rs:110

    initial begin : some_contents
        integer i;
        for (i = 3; i < 5; i = i + 1) some[i] = 8'h00;
        some[0] = 8'h03;
        some[1] = 8'h01;
        some[2] = 8'h04;
    end

    initial begin : filled_contents
        integer i;
        for (i = 0; i < 16; i = i + 1) filled[i] = 8'h5a;
    end

    initial $readmemh("words_.table_of_many.hex", table_of_many);

    wire [3:0] words_read_address = {1'd0, low};                 // gen/tests/shapes/mod.rs:96
    wire [3:0] words_read_address_2 = address + 4'd1;            // gen/tests/shapes/mod.rs:97
    wire [7:0] words_word0 = (words_read_address_2 < 4'd11) ? words[words_read_address_2] : 8'd0; // gen/tests/shapes/mod.rs:97
    wire [3:0] words_read_address_3 = {1'd0, low};               // gen/tests/shapes/mod.rs:97
    wire [7:0] words_word1 = words[words_read_address_3];        // gen/tests/shapes/mod.rs:97
    assign now = words_word0 ^ words_word1;                      // gen/tests/shapes/mod.rs:97
    assign third = some[3'd2];                                   // gen/tests/shapes/mod.rs:109
    assign constants = some_read ^ filled_read ^ fixed_read;     // gen/tests/shapes/mod.rs:110
    wire [8:0] table_of_many_read_address = {low, address, write, write}; // gen/tests/shapes/mod.rs:111
    wire [1:0] fixed_write_address = 2'd3;                       // gen/tests/shapes/mod.rs:103

    always @(posedge clk) begin
        if (write) words[address] <= data;
        words_read0_word <= words[address];
        words_read0_inside <= address < 4'd11;
        if (write) words_read1 <= words[words_read_address];
    end

    always @(posedge clk) begin
        some[low] <= data;
        some_read_word <= some[low];
        some_read_inside <= low < 3'd5;
    end

    always @(posedge clk) begin
        filled_read <= filled[address];
    end

    always @(posedge clk) begin
        table_of_many_read_word <= table_of_many[table_of_many_read_address];
        table_of_many_read_inside <= table_of_many_read_address < 9'd257;
    end

    always @(posedge clk) begin
        if (write) fixed[fixed_write_address] <= data;
        fixed_read <= fixed[low[1:0]];
    end

    assign old = words_read0;
    assign gated = words_read1;
    assign beyond = 8'd0;
    assign loaded = table_of_many_read;
endmodule
`default_nettype wire
