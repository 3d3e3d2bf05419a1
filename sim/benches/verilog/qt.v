// Quadtree units, written by hand: the function of the design `qt`.

module qt #(
    parameter UNITS = 16
) (
    input  wire        clk,
    input  wire        rst,
    output reg  [31:0] csum
);
    // folded[u + 1] has the hashes of the units up to u.
    genvar u;
    generate
        for (u = 0; u < UNITS; u = u + 1) begin : unit
            wire [31:0] hash, folded;
            qt_unit #(.SEED(32'h9e3779b1 * (u + 1))) walker (.clk(clk), .rst(rst), .hash(hash));
            if (u == 0) begin : first
                assign folded = hash;
            end else begin : later
                assign folded = {unit[u - 1].folded[30:0], unit[u - 1].folded[31]} ^ hash;
            end
        end
    endgenerate

    initial csum = 0;
    always @(posedge clk) begin
        if (rst) csum <= 0;
        else csum <= {csum[28:0], csum[31:29]} + unit[UNITS - 1].folded;
    end
endmodule

// An edge a x + b y + value of a triangle, for a window that is `2 ** (half + 1)` wide and for its quarters.
module qt_edge (
    input  wire [7:0]  a,
    input  wire [7:0]  b,
    input  wire [19:0] value,
    input  wire [3:0]  half,
    output wire [3:0]  outside, // all of the quarter is outside
    output wire [3:0]  partly   // some of it is
);
    wire [19:0] right = {{12{a[7]}}, a} << half;
    wire [19:0] down = {{12{b[7]}}, b} << half;
    wire [19:0] least = (right & {20{a[7]}}) + (down & {20{b[7]}});
    wire [19:0] most = half == 0 ? 20'd0 : (right & {20{!a[7]}}) + (down & {20{!b[7]}});
    wire [19:0] value1 = value + right;
    wire [19:0] value2 = value + down;
    wire [19:0] value3 = value1 + down;

    function is_negative(input [19:0] left, input [19:0] other);
        reg [19:0] sum;
        begin
            sum = left + other;
            is_negative = sum[19];
        end
    endfunction

    assign outside = {is_negative(value3, most), is_negative(value2, most),
                      is_negative(value1, most), is_negative(value, most)};
    assign partly = {is_negative(value3, least), is_negative(value2, least),
                     is_negative(value1, least), is_negative(value, least)};
endmodule

module qt_unit #(
    parameter [31:0] SEED = 1
) (
    input  wire        clk,
    input  wire        rst,
    output reg  [31:0] hash
);
    reg [31:0] random;
    wire [31:0] mixed1 = random ^ (random << 13);
    wire [31:0] mixed2 = mixed1 ^ (mixed1 >> 17);

    // The window and the triangle.
    reg         busy;
    reg  [3:0]  level;
    reg  [9:0]  x, y;
    reg  [7:0]  a0, a1, a2, b0, b1, b2;
    reg  [19:0] value0, value1, value2;
    wire [3:0]  half = level - 1;
    wire [3:0]  outside0, outside1, outside2, partly0, partly1, partly2;
    qt_edge edge0 (.a(a0), .b(b0), .value(value0), .half(half), .outside(outside0), .partly(partly0));
    qt_edge edge1 (.a(a1), .b(b1), .value(value1), .half(half), .outside(outside1), .partly(partly1));
    qt_edge edge2 (.a(a2), .b(b2), .value(value2), .half(half), .outside(outside2), .partly(partly2));
    wire [3:0]  reached = ~(outside0 | outside1 | outside2);
    wire [3:0]  whole = half == 0 ? 4'b1111 : ~(partly0 | partly1 | partly2);
    wire [3:0]  found = reached & whole;
    wire [3:0]  divided = reached & ~whole;

    // The stack.
    reg  [3:0]  depth;
    reg  [27:0] stack [0:15];
    reg  [59:0] stack_values [0:15];
    wire [3:0]  top = depth - 1;

    // The next window: a quarter of this one, or of the one on top of the stack.
    wire        down = divided != 0;
    wire        back = !down && depth != 0;
    wire [27:0] parent = down ? {divided, level, y, x} : stack[top];
    wire [59:0] parent_values = down ? {value2, value1, value0} : stack_values[top];
    wire [3:0]  todo = parent[27:24];
    wire [3:0]  rest = todo & (todo - 4'd1);
    wire [3:0]  child_level = parent[23:20] - 4'd1;
    wire        to_right = !todo[0] && (todo[1] || !todo[2]);
    wire        to_below = todo[1:0] == 0;
    wire        push = busy && down && rest != 0;

    function [19:0] moved(input [19:0] value, input [7:0] a, input [7:0] b);
        moved = value + (to_right ? {{12{a[7]}}, a} << child_level : 20'd0)
                      + (to_below ? {{12{b[7]}}, b} << child_level : 20'd0);
    endfunction

    // A new triangle.
    reg  [1:0]  loaded;
    wire [7:0]  a = random[7:0];
    wire [7:0]  b = random[15:8];
    wire [19:0] value = {8'b0, random[27:16]} - {{3{a[7]}}, a, 9'b0} - {{3{b[7]}}, b, 9'b0};

    always @(posedge clk) begin
        if (rst) begin
            random <= SEED;
            {busy, loaded, depth, hash} <= 0;
            {level, x, y} <= {4'd10, 20'd0};
        end else begin
            random <= mixed2 ^ (mixed2 << 5);
            if (busy) begin
                hash <= {hash[30:0], hash[31]} + {found, divided, level, y, x};
                level <= child_level;
                x <= parent[9:0] + (to_right ? 10'd1 << child_level : 10'd0);
                y <= parent[19:10] + (to_below ? 10'd1 << child_level : 10'd0);
                value0 <= moved(parent_values[19:0], a0, b0);
                value1 <= moved(parent_values[39:20], a1, b1);
                value2 <= moved(parent_values[59:40], a2, b2);
                if (push) depth <= depth + 1;
                else if (back && rest == 0) depth <= top;
                busy <= down || back;
            end else begin
                {level, x, y} <= {4'd10, 20'd0};
                case (loaded)
                    0: {a0, b0, value0} <= {a, b, value};
                    1: {a1, b1, value1} <= {a, b, value};
                    2: {a2, b2, value2} <= {a, b, value};
                    default: ;
                endcase
                loaded <= loaded == 2 ? 2'd0 : loaded + 2'd1;
                busy <= loaded == 2;
            end
        end
        if (push) begin
            stack[depth] <= {rest, parent[23:0]};
            stack_values[depth] <= parent_values;
        end else if (busy && back) stack[top] <= {rest, parent[23:0]};
    end

    integer i;
    initial begin
        random = SEED;
        {busy, loaded, depth, hash} = 0;
        {level, x, y} = {4'd10, 20'd0};
        {a0, a1, a2, b0, b1, b2, value0, value1, value2} = 0;
        for (i = 0; i < 16; i = i + 1) begin
            stack[i] = 0;
            stack_values[i] = 0;
        end
    end
endmodule
