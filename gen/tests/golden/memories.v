// memories
//
// Parameters  memories
// Described   gen/tests/lanes/modules.rs:87
`default_nettype none

module memories (
    input  wire        clk,
    input  wire        rst,
    input  wire [3:0]  address,
    input  wire        on,
    input  wire [3:0]  mask,
    input  wire [31:0] data,
    input  wire [11:0] own,
    input  wire [5:0]  cells,
    output wire [31:0] masked,
    output wire [31:0] whole,
    output wire [31:0] now,
    output wire [5:0]  texel,
    output wire [31:0] later
);

    reg [31:0] wide [0:15];                                      // gen/tests/lanes/modules.rs:92
    reg [31:0] wide_read0;                                       // gen/tests/lanes/modules.rs:95
    reg [31:0] wide_read1;                                       // gen/tests/lanes/modules.rs:96
    reg [5:0] plain [0:9];                                       // gen/tests/lanes/modules.rs:98

    initial begin : wide_contents
        integer word_i;
        for (word_i = 2; word_i < 16; word_i = word_i + 1) wide[word_i] = 32'h00000000;
        wide[0] = 32'h03020100;
        wide[1] = 32'h03020100;
    end

    assign now = wide[address];                                  // gen/tests/lanes/modules.rs:97
    assign texel = (address < 4'd10) ? plain[address] : 6'd0;    // gen/tests/lanes/modules.rs:101

    genvar i;

    generate
        for (i = 0; i < 4; i = i + 1) begin : row
            reg [7:0] each [0:5];                                        // gen/tests/lanes/modules.rs:102
            reg [7:0] each_read_word;
            reg each_read_inside;
            wire [7:0] each_read = each_read_inside ? each_read_word : 8'd0;
            case (i)
                0: begin : each_0
                    initial begin : each_contents
                        integer word_i;
                        for (word_i = 1; word_i < 6; word_i = word_i + 1) each[word_i] = 8'h00;
                        each[0] = 8'h10;
                    end
                end
                1: begin : each_1
                    initial begin : lane_each_contents
                        integer word_i;
                        for (word_i = 1; word_i < 6; word_i = word_i + 1) each[word_i] = 8'h00;
                        each[0] = 8'h11;
                    end
                end
                2: begin : each_2
                    initial begin : lane_each_contents_2
                        integer word_i;
                        for (word_i = 1; word_i < 6; word_i = word_i + 1) each[word_i] = 8'h00;
                        each[0] = 8'h12;
                    end
                end
                default: begin : each_3
                    initial begin : lane_each_contents_3
                        integer word_i;
                        for (word_i = 1; word_i < 6; word_i = word_i + 1) each[word_i] = 8'h00;
                        each[0] = 8'h13;
                    end
                end
            endcase

            always @(posedge clk) begin
                if (mask[i]) each[own[i * 3 +: 3]] <= data[i * 8 +: 8];
                if (mask[i]) begin
                    each_read_word <= each[own[i * 3 +: 3]];
                    each_read_inside <= own[i * 3 +: 3] < 3'd6;
                end
            end
        end
    endgenerate

    generate
        for (i = 0; i < 4; i = i + 1) begin : later_of
            assign later[i * 8 +: 8] = row[i].each_read;
        end
    endgenerate

    always @(posedge clk) begin
        if (on) wide_read1 <= wide[address];
    end

    generate
        for (i = 0; i < 4; i = i + 1) begin : wide_lane
            always @(posedge clk) begin
                if (mask[i]) wide[address][i * 8 +: 8] <= data[i * 8 +: 8];
                if (mask[i]) wide_read0[i * 8 +: 8] <= wide[address][i * 8 +: 8];
            end
        end
    endgenerate

    always @(posedge clk) begin
        if (on) plain[address] <= cells;
    end

    assign masked = wide_read0;
    assign whole = wide_read1;

    wire _unused_ok = &{1'b0, rst};
endmodule
`default_nettype wire
