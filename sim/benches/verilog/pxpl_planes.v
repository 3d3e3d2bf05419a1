// The function of pxpl.v in the form that suits a compiled simulator best: each kind of state of all processors is one vector, and
// the memory is a list of such vectors.

module pxpl_planes_axis #(
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
    wire [EDGE-1:0] sums [0:LEVELS];
    assign coefficients[0] = coefficient;
    assign firsts[0] = first;
    assign sums[0] = {{EDGE-1{1'b0}}, base};
    assign values = sums[LEVELS];

    genvar level;
    generate
        for (level = 0; level < LEVELS; level = level + 1) begin : levels
            localparam LATER = LEVELS - 1 - level;
            localparam NODES = 1 << level;
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

            reg  [NODES-1:0] left, right, carry;
            wire [NODES-1:0] parents = sums[level][NODES-1:0];
            wire [NODES-1:0] weights = {NODES{weighted}};
            wire [NODES-1:0] carried = carry & {NODES{~firsts[level]}};
            always @(posedge clk) begin
                left <= parents & {NODES{~rst}};
                right <= (parents ^ weights ^ carried) & {NODES{~rst}};
                carry <= ((parents & weights) | (parents & carried) | (weights & carried)) & {NODES{~rst}};
            end
            reg [EDGE-1:0] children;
            integer n;
            always @* begin
                children = 0;
                for (n = 0; n < NODES; n = n + 1) begin
                    children[2*n] = left[n];
                    children[2*n+1] = right[n];
                end
            end
            assign sums[level + 1] = children;
        end
    endgenerate
endmodule

module pxpl_planes #(
    parameter EDGE = 32
) (
    input  wire        clk,
    input  wire        rst,
    output reg  [31:0] csum
);
    localparam ALL = EDGE * EDGE;
    localparam [2:0] STORE = 1, ADD = 2, KEEP_POSITIVE = 3, EVERYBODY = 4, COMPARE = 5, KEEP_LESS = 6, COPY = 7;
    localparam [23:0] PROGRAM = {EVERYBODY, KEEP_POSITIVE, COPY, STORE, KEEP_LESS, COMPARE, ADD, STORE};
    reg  [31:0] random;
    wire [31:0] mixed1 = random ^ (random << 13);
    wire [31:0] mixed2 = mixed1 ^ (mixed1 >> 17);
    reg  [4:0]  clock;
    reg  [2:0]  step, operation;
    reg  [7:0]  base, read, write;
    reg         a, b, c, first;
    wire [2:0]  next = PROGRAM[3*step +: 3];
    wire        is_kept = next == KEEP_POSITIVE || next == KEEP_LESS;
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

    wire [EDGE-1:0] row, column;
    pxpl_planes_axis #(.EDGE(EDGE)) u_x (.clk(clk), .rst(rst), .first(first), .base(c), .coefficient(a), .values(row));
    pxpl_planes_axis #(.EDGE(EDGE)) u_y (.clk(clk), .rst(rst), .first(first), .base(1'b0), .coefficient(b), .values(column));
    wire [ALL-1:0] x = {EDGE{row}};
    wire [ALL-1:0] y;
    genvar i;
    generate for (i = 0; i < EDGE; i = i + 1) begin : rows
        assign y[EDGE*i +: EDGE] = {EDGE{column[i]}};
    end endgenerate

    reg  [ALL-1:0] memory [0:207];
    reg  [ALL-1:0] sum_carry, carry, less, enable, result;
    wire [ALL-1:0] sum_carried = first ? {ALL{1'b0}} : sum_carry;
    wire [ALL-1:0] sum = x ^ y ^ sum_carried;
    wire [ALL-1:0] word = memory[read];
    wire [ALL-1:0] carried = first ? {ALL{1'b0}} : carry;
    wire [ALL-1:0] so_far = first ? {ALL{1'b0}} : less;
    wire [ALL-1:0] value = operation == ADD ? sum ^ word ^ carried : operation == COPY ? word : sum;
    integer address;
    initial for (address = 0; address < 208; address = address + 1) memory[address] = 0;

    always @(posedge clk) begin
        if (rst) begin
            {sum_carry, carry, less, result} <= 0;
            enable <= {ALL{1'b1}};
        end else begin
            sum_carry <= (x & y) | (x & sum_carried) | (y & sum_carried);
            result <= value & enable;
            case (operation)
                ADD: carry <= (sum & word) | (sum & carried) | (word & carried);
                COMPARE: less <= ((sum ^ word) & word) | (~(sum ^ word) & so_far);
                KEEP_POSITIVE: enable <= enable & ~sum;
                KEEP_LESS: enable <= enable & less;
                EVERYBODY: enable <= {ALL{1'b1}};
                default: ;
            endcase
            if (operation == STORE || operation == ADD || operation == COPY)
                memory[write] <= (value & enable) | (memory[write] & ~enable);
        end
    end
    always @(posedge clk)
        csum <= rst ? 0 : {csum[30:0], csum[31]} + (result[31:0] ^ result[ALL-1 -: 32]) + {31'b0, ^enable};
endmodule
