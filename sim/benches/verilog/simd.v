// A square of processors under one instruction, written by hand: the function of the design `simd`.

module simd #(
    parameter EDGE = 64
) (
    input  wire        clk,
    input  wire        rst,
    output reg  [31:0] csum
);
    wire [7:0] read_address, write_address, constant, a, b, c;
    wire [3:0] opcode;
    simd_sequencer sequencer (
        .clk(clk), .rst(rst), .read_address(read_address), .opcode(opcode),
        .write_address(write_address), .constant(constant), .a(a), .b(b), .c(c)
    );

    genvar x, y;
    generate
        for (x = 0; x < EDGE; x = x + 1) begin : column
            wire [7:0] term = a * x + c;
        end
        for (y = 0; y < EDGE; y = y + 1) begin : row
            wire [7:0] term = b * y;
            wire [8 * EDGE - 1:0] results;
            for (x = 0; x < EDGE; x = x + 1) begin : place
                simd_processor processor (
                    .clk(clk), .rst(rst), .read_address(read_address), .opcode(opcode),
                    .write_address(write_address), .constant(constant),
                    .column(column[x].term), .row(term), .result(results[8 * x +: 8])
                );
            end
            reg  [7:0] sum, results_sum;
            integer i;
            always @* begin
                results_sum = 0;
                for (i = 0; i < EDGE; i = i + 1) results_sum = results_sum ^ results[8 * i +: 8];
            end
            always @(posedge clk) sum <= results_sum;
            initial sum = 0;
            wire [7:0] folded;
            if (y == 0) begin : first
                assign folded = sum;
            end else begin : later
                assign folded = {row[y - 1].folded[6:0], row[y - 1].folded[7]} ^ sum;
            end
        end
    endgenerate

    initial csum = 0;
    always @(posedge clk) begin
        if (rst) csum <= 0;
        else csum <= {csum[30:0], csum[31]} + {24'b0, row[EDGE - 1].folded};
    end
endmodule

module simd_processor (
    input  wire       clk,
    input  wire       rst,
    input  wire [7:0] read_address,
    input  wire [3:0] opcode,
    input  wire [7:0] write_address,
    input  wire [7:0] constant,
    input  wire [7:0] column,
    input  wire [7:0] row,
    output wire [7:0] result
);
    reg  [7:0] memory [0:255];
    reg  [7:0] operand, accumulator;
    reg        active;
    wire [7:0] plane = column + row;
    assign result = active ? accumulator : 8'd0;

    always @(posedge clk) begin
        operand <= memory[read_address];
        if (rst) begin
            accumulator <= 0;
            active <= 1;
        end else begin
            if (active) case (opcode)
                1: accumulator <= operand;
                3: accumulator <= accumulator + operand;
                4: accumulator <= accumulator - operand;
                5: active <= accumulator < operand;
                7: accumulator <= plane;
                8: accumulator <= accumulator + constant;
                9: accumulator <= accumulator & operand;
                10: accumulator <= accumulator ^ operand;
                11: accumulator <= accumulator >> 1;
                12: active <= accumulator >= constant;
                13: accumulator <= accumulator + plane;
                14: accumulator <= accumulator ^ constant;
                15: active <= 0;
                default: ;
            endcase
            else active <= opcode == 6 || opcode == 15;
        end
        if (active && opcode == 2) memory[write_address] <= accumulator;
    end

    integer i;
    initial begin
        {operand, accumulator, active} = 1;
        for (i = 0; i < 256; i = i + 1) memory[i] = 0;
    end
endmodule

// Opcodes from a program of 32, the first in the lowest digit; operands from a random generator.
module simd_sequencer (
    input  wire       clk,
    input  wire       rst,
    output wire [7:0] read_address,
    output reg  [3:0] opcode,
    output reg  [7:0] write_address,
    output reg  [7:0] constant,
    output reg  [7:0] a,
    output reg  [7:0] b,
    output reg  [7:0] c
);
    localparam [127:0] PROGRAM = 128'ha02d5423_ce2bd916_28f275a1_24cd3276;
    reg  [4:0]  pc;
    reg  [31:0] random;
    wire [31:0] mixed1 = random ^ (random << 13);
    wire [31:0] mixed2 = mixed1 ^ (mixed1 >> 17);
    assign read_address = random[7:0];

    always @(posedge clk) begin
        pc <= rst ? 5'd0 : pc + 5'd1;
        random <= rst ? 32'h01234567 : mixed2 ^ (mixed2 << 5);
        opcode <= PROGRAM[4 * pc +: 4];
        {constant, write_address} <= random[23:8];
        {a, c, b} <= {random[31:24], random[19:12], random[11:4]};
    end
    initial begin
        {pc, opcode, write_address, constant, a, b, c} = 0;
        random = 32'h01234567;
    end
endmodule
