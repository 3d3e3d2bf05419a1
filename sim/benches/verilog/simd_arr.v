// The function of simd.v in the form that suits a compiled simulator best: one memory for each kind of state of all processors,
// and a loop over them for each instruction.

module simd_arr #(
    parameter EDGE = 64
) (
    input  wire        clk,
    input  wire        rst,
    output reg  [31:0] csum
);
    localparam ALL = EDGE * EDGE;
    localparam [127:0] PROGRAM = 128'ha02d5423_ce2bd916_28f275a1_24cd3276;
    reg  [4:0]  pc;
    reg  [31:0] random;
    wire [31:0] mixed1 = random ^ (random << 13);
    wire [31:0] mixed2 = mixed1 ^ (mixed1 >> 17);
    reg  [3:0]  opcode;
    reg  [7:0]  write_address, constant, a, b, c;

    reg  [7:0]  memory [0:256 * ALL - 1]; // by address, then by processor
    reg  [7:0]  operand [0:ALL - 1];
    reg  [7:0]  accumulator [0:ALL - 1];
    reg  [7:0]  active [0:ALL - 1];       // a mask: all ones or all zeros
    reg  [7:0]  sum [0:EDGE - 1];
    reg  [7:0]  folded, plane, row_term;
    integer     p, x, y, read_base, write_base;

    always @(posedge clk) begin
        // What the rows held before the edge goes into the checksum, what the processors held goes into the rows.
        folded = 0;
        for (y = 0; y < EDGE; y = y + 1) folded = {folded[6:0], folded[7]} ^ sum[y];
        csum = rst ? 32'd0 : {csum[30:0], csum[31]} + {24'b0, folded};
        for (y = 0; y < EDGE; y = y + 1) begin
            folded = 0;
            for (x = 0; x < EDGE; x = x + 1) folded = folded ^ (accumulator[EDGE * y + x] & active[EDGE * y + x]);
            sum[y] = folded;
        end

        read_base = ALL * random[7:0];
        write_base = ALL * write_address;
        if (rst) begin
            for (p = 0; p < ALL; p = p + 1) begin
                operand[p] = memory[read_base + p];
                accumulator[p] = 0;
                active[p] = 8'hff;
            end
        end else begin
            // A masked result leaves an accumulator as it is: by adding or subtracting 0, or bit by bit.
            case (opcode)
                1: for (p = 0; p < ALL; p = p + 1) accumulator[p] = (operand[p] & active[p]) | (accumulator[p] & ~active[p]);
                3: for (p = 0; p < ALL; p = p + 1) accumulator[p] = accumulator[p] + (operand[p] & active[p]);
                4: for (p = 0; p < ALL; p = p + 1) accumulator[p] = accumulator[p] - (operand[p] & active[p]);
                5: for (p = 0; p < ALL; p = p + 1) active[p] = active[p] & {8{accumulator[p] < operand[p]}};
                6: for (p = 0; p < ALL; p = p + 1) active[p] = 8'hff;
                7, 13: for (y = 0; y < EDGE; y = y + 1) begin
                    row_term = b * y[7:0] + c;
                    for (x = 0; x < EDGE; x = x + 1) begin
                        p = EDGE * y + x;
                        plane = (a * x[7:0] + row_term) & active[p];
                        accumulator[p] = plane + (opcode == 13 ? accumulator[p] : accumulator[p] & ~active[p]);
                    end
                end
                8: for (p = 0; p < ALL; p = p + 1) accumulator[p] = accumulator[p] + (constant & active[p]);
                9: for (p = 0; p < ALL; p = p + 1) accumulator[p] = accumulator[p] & (operand[p] | ~active[p]);
                10: for (p = 0; p < ALL; p = p + 1) accumulator[p] = accumulator[p] ^ (operand[p] & active[p]);
                11: for (p = 0; p < ALL; p = p + 1)
                    accumulator[p] = ({1'b0, accumulator[p][7:1]} & active[p]) | (accumulator[p] & ~active[p]);
                12: for (p = 0; p < ALL; p = p + 1) active[p] = active[p] & {8{accumulator[p] >= constant}};
                14: for (p = 0; p < ALL; p = p + 1) accumulator[p] = accumulator[p] ^ (constant & active[p]);
                15: for (p = 0; p < ALL; p = p + 1) active[p] = ~active[p];
                default: ;
            endcase
            // The operand is read before the result is written.
            for (p = 0; p < ALL; p = p + 1) operand[p] = memory[read_base + p];
            if (opcode == 2)
                for (p = 0; p < ALL; p = p + 1)
                    memory[write_base + p] = (accumulator[p] & active[p]) | (memory[write_base + p] & ~active[p]);
        end
    end

    always @(posedge clk) begin
        pc <= rst ? 5'd0 : pc + 5'd1;
        random <= rst ? 32'h01234567 : mixed2 ^ (mixed2 << 5);
        opcode <= PROGRAM[4 * pc +: 4];
        {constant, write_address} <= random[23:8];
        {a, c, b} <= {random[31:24], random[19:12], random[11:4]};
    end

    initial begin
        {pc, opcode, write_address, constant, a, b, c, csum} = 0;
        random = 32'h01234567;
        for (p = 0; p < ALL; p = p + 1) begin
            operand[p] = 0;
            accumulator[p] = 0;
            active[p] = 8'hff;
        end
        for (p = 0; p < 256 * ALL; p = p + 1) memory[p] = 0;
        for (y = 0; y < EDGE; y = y + 1) sum[y] = 0;
    end
endmodule
