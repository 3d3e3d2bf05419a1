// Quadtree units, written by hand: the function of the design `qt`.

module qt #(
    parameter UNITS = 16,
    parameter LEVEL = 10 // a screen is 2 ** LEVEL pixels wide
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
            qt_unit #(.SEED(32'h9e3779b1 * (u + 1)), .LEVEL(LEVEL)) walker (.clk(clk), .rst(rst), .hash(hash));
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
module qt_edge #(
    parameter VALUE = 20
) (
    input  wire [7:0]       a,
    input  wire [7:0]       b,
    input  wire [VALUE-1:0] value,
    input  wire [3:0]       half,
    output wire [3:0]       outside, // all of the quarter is outside
    output wire [3:0]       partly   // some of it is
);
    wire [VALUE-1:0] right = {{(VALUE-8){a[7]}}, a} << half;
    wire [VALUE-1:0] down = {{(VALUE-8){b[7]}}, b} << half;
    wire [VALUE-1:0] least = (right & {VALUE{a[7]}}) + (down & {VALUE{b[7]}});
    wire [VALUE-1:0] most = half == 0 ? {VALUE{1'b0}} : (right & {VALUE{!a[7]}}) + (down & {VALUE{!b[7]}});
    wire [VALUE-1:0] value1 = value + right;
    wire [VALUE-1:0] value2 = value + down;
    wire [VALUE-1:0] value3 = value1 + down;

    function is_negative(input [VALUE-1:0] left, input [VALUE-1:0] other);
        reg [VALUE-1:0] sum;
        begin
            sum = left + other;
            is_negative = sum[VALUE-1];
        end
    endfunction

    assign outside = {is_negative(value3, most), is_negative(value2, most),
                      is_negative(value1, most), is_negative(value, most)};
    assign partly = {is_negative(value3, least), is_negative(value2, least),
                     is_negative(value1, least), is_negative(value, least)};
endmodule

module qt_unit #(
    parameter [31:0] SEED  = 1,
    parameter        LEVEL = 10
) (
    input  wire        clk,
    input  wire        rst,
    output reg  [31:0] hash
);
    // The widths of an edge's value, and of the stack's addresses.
    localparam VALUE = LEVEL + 10, DEPTH = $clog2(LEVEL);

    reg [31:0] random;
    wire [31:0] mixed1 = random ^ (random << 13);
    wire [31:0] mixed2 = mixed1 ^ (mixed1 >> 17);

    // The window and the triangle.
    reg         busy;
    reg  [3:0]  level;
    reg  [LEVEL-1:0] x, y;
    reg  [7:0]  a0, a1, a2, b0, b1, b2;
    reg  [VALUE-1:0] value0, value1, value2;
    wire [3:0]  half = level - 1;
    wire [3:0]  outside0, outside1, outside2, partly0, partly1, partly2;
    qt_edge #(.VALUE(VALUE)) edge0 (.a(a0), .b(b0), .value(value0), .half(half), .outside(outside0), .partly(partly0));
    qt_edge #(.VALUE(VALUE)) edge1 (.a(a1), .b(b1), .value(value1), .half(half), .outside(outside1), .partly(partly1));
    qt_edge #(.VALUE(VALUE)) edge2 (.a(a2), .b(b2), .value(value2), .half(half), .outside(outside2), .partly(partly2));
    wire [3:0]  reached = ~(outside0 | outside1 | outside2);
    wire [3:0]  whole = half == 0 ? 4'b1111 : ~(partly0 | partly1 | partly2);
    wire [3:0]  found = reached & whole;
    wire [3:0]  divided = reached & ~whole;

    // The stack.
    reg  [DEPTH-1:0]     depth;
    reg  [2*LEVEL+7:0]   stack [0:2**DEPTH-1];
    reg  [3*VALUE-1:0]   stack_values [0:2**DEPTH-1];
    wire [DEPTH-1:0]     top = depth - 1;

    // The next window: a quarter of this one, or of the one on top of the stack.
    wire        down = divided != 0;
    wire        back = !down && depth != 0;
    wire [2*LEVEL+7:0] parent = down ? {divided, level, y, x} : stack[top];
    wire [3*VALUE-1:0] parent_values = down ? {value2, value1, value0} : stack_values[top];
    wire [3:0]  todo = parent[2*LEVEL+7:2*LEVEL+4];
    wire [3:0]  rest = todo & (todo - 4'd1);
    wire [3:0]  child_level = parent[2*LEVEL+3:2*LEVEL] - 4'd1;
    wire        to_right = !todo[0] && (todo[1] || !todo[2]);
    wire        to_below = todo[1:0] == 0;
    wire        push = busy && down && rest != 0;

    function [VALUE-1:0] moved(input [VALUE-1:0] value, input [7:0] a, input [7:0] b);
        moved = value + (to_right ? {{(VALUE-8){a[7]}}, a} << child_level : {VALUE{1'b0}})
                      + (to_below ? {{(VALUE-8){b[7]}}, b} << child_level : {VALUE{1'b0}});
    endfunction

    // A new triangle.
    reg  [1:0]  loaded;
    wire [7:0]  a = random[7:0];
    wire [7:0]  b = random[15:8];
    wire [VALUE-1:0] value = {8'b0, random[LEVEL+17:16]} - {{3{a[7]}}, a, {(LEVEL-1){1'b0}}}
                                                         - {{3{b[7]}}, b, {(LEVEL-1){1'b0}}};
    wire [LEVEL-1:0] pixel = 1;

    always @(posedge clk) begin
        if (rst) begin
            random <= SEED;
            {busy, loaded, depth, hash} <= 0;
            level <= LEVEL;
            {x, y} <= 0;
        end else begin
            random <= mixed2 ^ (mixed2 << 5);
            if (busy) begin
                hash <= {hash[30:0], hash[31]} + {found, divided, level, y, x};
                level <= child_level;
                x <= parent[LEVEL-1:0] + (to_right ? pixel << child_level : {LEVEL{1'b0}});
                y <= parent[2*LEVEL-1:LEVEL] + (to_below ? pixel << child_level : {LEVEL{1'b0}});
                value0 <= moved(parent_values[VALUE-1:0], a0, b0);
                value1 <= moved(parent_values[2*VALUE-1:VALUE], a1, b1);
                value2 <= moved(parent_values[3*VALUE-1:2*VALUE], a2, b2);
                if (push) depth <= depth + 1;
                else if (back && rest == 0) depth <= top;
                busy <= down || back;
            end else begin
                level <= LEVEL;
                {x, y} <= 0;
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
            stack[depth] <= {rest, parent[2*LEVEL+3:0]};
            stack_values[depth] <= parent_values;
        end else if (busy && back) stack[top] <= {rest, parent[2*LEVEL+3:0]};
    end

    integer i;
    initial begin
        random = SEED;
        {busy, loaded, depth, hash} = 0;
        level = LEVEL;
        {x, y} = 0;
        {a0, a1, a2, b0, b1, b2, value0, value1, value2} = 0;
        for (i = 0; i < 2**DEPTH; i = i + 1) begin
            stack[i] = 0;
            stack_values[i] = 0;
        end
    end
endmodule
