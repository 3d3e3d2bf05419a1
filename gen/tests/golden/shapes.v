// shapes
//
// Expressions that are short, long, used twice, or that need a name; choices that nest.
//
// Parameters  Shapes
// Described   gen/tests/shapes/mod.rs:6
`default_nettype none

module shapes (
    input  wire        clk,
    input  wire        rst,
    input  wire        slow_clk,
    input  wire        slow_rst,
    input  wire [7:0]  a,
    input  wire [7:0]  b,
    input  wire [99:0] wide,
    input  wire [2:0]  which,
    input  wire        go,
    output wire [7:0]  twice,
    output wire [7:0]  chain,
    output wire [9:0]  masked,
    output wire [64:0] signs,
    output wire [15:0] products,
    output wire [56:0] parts,
    output wire [7:0]  few,
    output reg  [7:0]  many,
    output reg  [7:0]  first,
    output reg  [7:0]  picked,
    (* ASYNC_REG = "TRUE" *) output reg         sampled
);

    reg [7:0] nested;                                            // gen/tests/shapes/mod.rs:52
    reg [7:0] cased;                                             // gen/tests/shapes/mod.rs:55
    reg [7:0] kept;                                              // gen/tests/shapes/mod.rs:57
    reg [7:0] last;                                              // gen/tests/shapes/mod.rs:59
    reg [7:0] held;                                              // gen/tests/shapes/mod.rs:61
    reg [7:0] once;                                              // gen/tests/shapes/mod.rs:64
    reg [7:0] again;                                             // gen/tests/shapes/mod.rs:64
    (* ASYNC_REG = "TRUE" *) reg sampled_meta;                   // gen/tests/shapes/mod.rs:79

    wire [7:0] a_plus_b = a + b;                                 // gen/tests/shapes/mod.rs:28
    wire [7:0] chain_xor_7 = ((a ^ (b + 8'd1)) & (a | (b - 8'd1))) ^ (b + 8'd2); // gen/tests/shapes/mod.rs:29
    wire [7:0] chain_xor_6 = (chain_xor_7 & (a | (b - 8'd2))) ^ (b + 8'd3); // gen/tests/shapes/mod.rs:29
    wire [7:0] chain_xor_5 = (chain_xor_6 & (a | (b - 8'd3))) ^ (b + 8'd4); // gen/tests/shapes/mod.rs:29
    wire [7:0] chain_xor_4 = (chain_xor_5 & (a | (b - 8'd4))) ^ (b + 8'd5); // gen/tests/shapes/mod.rs:29
    wire [7:0] chain_xor_3 = (chain_xor_4 & (a | (b - 8'd5))) ^ (b + 8'd6); // gen/tests/shapes/mod.rs:29
    wire [7:0] chain_xor_2 = (chain_xor_3 & (a | (b - 8'd6))) ^ (b + 8'd7); // gen/tests/shapes/mod.rs:29
    wire [7:0] chain_xor = (chain_xor_2 & (a | (b - 8'd7))) ^ (b + 8'd8); // gen/tests/shapes/mod.rs:29
    assign chain = chain_xor & (a | (b - 8'd8));                 // gen/tests/shapes/mod.rs:29
    wire [63:0] masked_and = wide[63:0] & 64'h123456789abcdef0;  // gen/tests/shapes/mod.rs:30
    assign masked = masked_and[9:0];                             // gen/tests/shapes/mod.rs:30
    wire [7:0] a_xor_b = a ^ b;                                  // gen/tests/shapes/mod.rs:31
    wire [11:0] signs_extended = {{4{a_xor_b[7]}}, a_xor_b};     // gen/tests/shapes/mod.rs:31
    assign signs = {signs_extended, {{4{a[4]}}, a[4:1]}, {4{a[0]}}, {b[7], b}, {{29{which[2]}}, which}}; // gen/tests/shapes/mod.rs:31
    wire parts_at_least = $signed(b ^ 8'h03) >= $signed(a ^ 8'h05); // gen/tests/shapes/mod.rs:32
    wire parts_and = ($signed(a + 8'd1) < $signed(b + 8'd1)) & parts_at_least; // gen/tests/shapes/mod.rs:32
    wire parts_xor_2 = ($signed(a) < $signed(b)) ^ ($signed(a) > 8'sd3); // gen/tests/shapes/mod.rs:33
    wire parts_xor = parts_xor_2 ^ ($signed(b) <= -8'sd2);       // gen/tests/shapes/mod.rs:33
    assign parts = {wide[89:76], wide[74:70], wide[64], a_plus_b[4:2], ~a, {3{a}}, parts_and, parts_xor}; // gen/tests/shapes/mod.rs:34
    assign few = which[0] ? a : (which[1] ? b : 8'd3);           // gen/tests/shapes/mod.rs:46
    always @* begin
        if (which[0]) many = a;
        else if (which[1]) many = b;
        else if (which[2]) many = a_plus_b;
        else many = 8'd4;
    end
    always @* begin
        if (which[0]) begin
            first = (a ^ b) + (a & b);
        end else if (which[1]) begin
            if (go) first = b;
            else first = few;
        end else if (which[2]) begin
            first = (a | b) - (b ^ 8'h09);
        end else begin
            first = 8'd9;
        end
    end
    always @* begin
        case (which)
            3'd0: picked = a;
            3'd3: begin
                if (go) picked = b;
                else picked = 8'd7;
            end
            3'd5: picked = a_plus_b;
            default: picked = many;
        endcase
    end
    wire [7:0] nested_choice_3 = b[1] ? (a[0] ? (b[0] ? b : nested) : 8'd0) : nested; // gen/tests/shapes/mod.rs:53
    wire [7:0] nested_choice_2 = b[2] ? (a[1] ? nested_choice_3 : 8'd1) : nested; // gen/tests/shapes/mod.rs:53
    wire [7:0] nested_choice = b[3] ? (a[2] ? nested_choice_2 : 8'd2) : nested; // gen/tests/shapes/mod.rs:53
    reg [7:0] cased_choice;                                      // gen/tests/shapes/mod.rs:56
    always @* begin
        case (b[2:1])
            2'd1: cased_choice = a;
            default: begin
                case (b[1:0])
                    2'd1: cased_choice = a;
                    default: cased_choice = b;
                endcase
            end
        endcase
    end
    wire stopped = !go;                                          // gen/tests/shapes/mod.rs:63
    assign twice = a_plus_b ^ (a_plus_b + 8'd1);                 // gen/tests/shapes/mod.rs:69
    wire [15:0] products_joined = {kept, last ^ held ^ once ^ again ^ cased}; // gen/tests/shapes/mod.rs:73
    assign products = ({8'd0, a} * {8'd0, b}) + products_joined; // gen/tests/shapes/mod.rs:73

    always @(posedge clk) begin
        case (b[6:5])
            2'd1: cased <= a;
            default: begin
                case (b[5:4])
                    2'd1: cased <= a;
                    default: begin
                        case (b[4:3])
                            2'd1: cased <= a;
                            default: begin
                                case (b[3:2])
                                    2'd1: cased <= a;
                                    default: cased <= cased_choice;
                                endcase
                            end
                        endcase
                    end
                endcase
            end
        endcase
        if (!go) kept <= kept;
        else if (which == 3'd4) kept <= nested;
        else kept <= a;
        if (go) last <= a;
        else if (which[0]) last <= last;
        else if (which[1]) last <= b;
        if (go) held <= a;
        else if (which[0]) held <= b;
        if (go) once <= a;
        if (!stopped) again <= b;
    end

    always @(posedge clk) begin
        if (rst) begin
            nested <= 8'd1;
        end else if (go) begin
            if (a[5]) begin
                if (b[5]) begin
                    if (a[4]) begin
                        if (b[4]) nested <= a[3] ? nested_choice : 8'd3;
                    end else begin
                        nested <= 8'd4;
                    end
                end
            end else begin
                nested <= 8'd5;
            end
        end
    end

    always @(posedge slow_clk) begin
        if (slow_rst) begin
            sampled_meta <= 1'b0;
            sampled <= 1'b0;
        end else begin
            sampled_meta <= kept[0];
            sampled <= sampled_meta;
        end
    end

    wire _unused_ok = &{1'b0, wide[99:90], wide[75], wide[69:65], masked_and[63:10]};
endmodule
`default_nettype wire
