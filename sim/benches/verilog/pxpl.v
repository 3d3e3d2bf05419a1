// EDGE x EDGE processors of one bit under one instruction, fed by a tree that adds bit by bit; a module for each processor.

// One axis of the tree: at place i the base plus i times the coefficient, least significant bit first.
module pxpl_axis #(
    parameter EDGE = 32
) (
    input  wire            clk,
    input  wire            rst,
    input  wire            first,
    input  wire            base,
    input  wire            coefficient,
    output wire [EDGE-1:0] values
);
    localparam LEVELS = $clog2(EDGE);
    wire [LEVELS:0] coefficients, firsts;
    wire [2*EDGE-1:1] node; // the children of node n are 2n and 2n + 1
    assign coefficients[0] = coefficient;
    assign firsts[0] = first;
    assign node[1] = base;
    assign values = node[2*EDGE-1:EDGE];

    genvar level, n;
    generate
        for (level = 0; level < LEVELS; level = level + 1) begin : levels
            localparam LATER = LEVELS - 1 - level;
            wire weighted;
            reg  coefficient_here, first_here;
            if (LATER == 0) begin : now
                assign weighted = coefficients[level];
            end else begin : later
                reg [LATER-1:0] delay;
                wire [LATER:0]  shifted = {delay, coefficients[level]};
                always @(posedge clk)
                    if (rst | firsts[level]) delay <= 0;
                    else delay <= shifted[LATER-1:0];
                assign weighted = delay[LATER-1];
            end
            always @(posedge clk) begin
                coefficient_here <= ~rst & coefficients[level];
                first_here <= ~rst & firsts[level];
            end
            assign coefficients[level + 1] = coefficient_here;
            assign firsts[level + 1] = first_here;
            for (n = 1 << level; n < 2 << level; n = n + 1) begin : nodes
                reg  left, right, carry;
                wire carried = carry & ~firsts[level];
                always @(posedge clk) begin
                    left <= ~rst & node[n];
                    right <= ~rst & (node[n] ^ weighted ^ carried);
                    carry <= ~rst & ((node[n] & weighted) | (node[n] & carried) | (weighted & carried));
                end
                assign node[2*n] = left;
                assign node[2*n+1] = right;
            end
        end
    endgenerate
endmodule

module pxpl_pixel (
    input  wire       clk,
    input  wire       rst,
    input  wire       first,
    input  wire [2:0] operation,
    input  wire [7:0] read,
    input  wire [7:0] write,
    input  wire       x,
    input  wire       y,
    output reg        result,
    output reg        enable
);
    localparam [2:0] STORE = 1, ADD = 2, KEEP_POSITIVE = 3, EVERYBODY = 4, COMPARE = 5, KEEP_LESS = 6, COPY = 7;
    reg  memory [0:207];
    reg  sum_carry, carry, less;
    wire sum_carried = sum_carry & ~first;
    wire sum = x ^ y ^ sum_carried;
    wire word = memory[read];
    wire carried = carry & ~first;
    wire value = operation == ADD ? sum ^ word ^ carried : operation == COPY ? word : sum;
    integer address;
    initial for (address = 0; address < 208; address = address + 1) memory[address] = 0;

    always @(posedge clk) begin
        if (rst) begin
            {sum_carry, carry, less, result} <= 0;
            enable <= 1;
        end else begin
            sum_carry <= (x & y) | (x & sum_carried) | (y & sum_carried);
            result <= value & enable;
            case (operation)
                ADD: carry <= (sum & word) | (sum & carried) | (word & carried);
                COMPARE: less <= sum != word ? word : less & ~first;
                KEEP_POSITIVE: enable <= enable & ~sum;
                KEEP_LESS: enable <= enable & less;
                EVERYBODY: enable <= 1;
                default: ;
            endcase
            if (enable && (operation == STORE || operation == ADD || operation == COPY)) memory[write] <= value;
        end
    end
endmodule

module pxpl #(
    parameter EDGE = 32
) (
    input  wire        clk,
    input  wire        rst,
    output reg  [31:0] csum
);
    localparam ALL = EDGE * EDGE;
    localparam [23:0] PROGRAM = {3'd4, 3'd3, 3'd7, 3'd1, 3'd6, 3'd5, 3'd2, 3'd1};
    reg  [31:0] random;
    wire [31:0] mixed1 = random ^ (random << 13);
    wire [31:0] mixed2 = mixed1 ^ (mixed1 >> 17);
    reg  [4:0]  clock;
    reg  [2:0]  step, operation;
    reg  [7:0]  base, read, write;
    reg         a, b, c, first;
    wire [2:0]  next = PROGRAM[3*step +: 3];
    wire        is_kept = next == 3'd3 || next == 3'd6;
    wire [7:0]  from = base + {3'b0, clock};
    wire [7:0]  to = from + 8'd37;

    always @(posedge clk) begin
        if (rst) begin
            random <= 32'h01234567;
            {clock, step, base, operation, read, write, a, b, c, first} <= 0;
        end else begin
            random <= mixed2 ^ (mixed2 << 5);
            clock <= clock + 1;
            if (clock == 31) begin
                step <= step + 1;
                base <= random[15:8];
            end
            operation <= is_kept && clock != 31 ? 3'd0 : next;
            read <= from >= 208 ? from - 8'd208 : from;
            write <= to >= 208 ? to - 8'd208 : to;
            {a, b, c} <= {random[3], random[7], random[23]};
            first <= clock == 0;
        end
    end

    wire [EDGE-1:0] x, y;
    pxpl_axis #(.EDGE(EDGE)) u_x (.clk(clk), .rst(rst), .first(first), .base(c), .coefficient(a), .values(x));
    pxpl_axis #(.EDGE(EDGE)) u_y (.clk(clk), .rst(rst), .first(first), .base(1'b0), .coefficient(b), .values(y));
    wire [ALL-1:0] result, enable;
    genvar i, j;
    generate
        for (i = 0; i < EDGE; i = i + 1) begin : rows
            for (j = 0; j < EDGE; j = j + 1) begin : pixels
                pxpl_pixel u_pixel (
                    .clk(clk), .rst(rst), .first(first), .operation(operation), .read(read), .write(write),
                    .x(x[j]), .y(y[i]), .result(result[EDGE*i+j]), .enable(enable[EDGE*i+j])
                );
            end
        end
    endgenerate
    always @(posedge clk)
        csum <= rst ? 0 : {csum[30:0], csum[31]} + (result[31:0] ^ result[ALL-1 -: 32]) + {31'b0, ^enable};
endmodule
