// In a design of several clocks a state is an instant, and a clock's port says whether the clock has an edge there.

(* techmap_celltype = "$dff" *)
module _instants_register (CLK, D, Q);
    parameter WIDTH = 1;
    parameter CLK_POLARITY = 1;
    input CLK;
    input [WIDTH-1:0] D;
    output [WIDTH-1:0] Q;

    \$ff #(.WIDTH(WIDTH)) _TECHMAP_REPLACE_ (.D(CLK ? D : Q), .Q(Q));
endmodule

// An asynchronous reset acts without an edge.
(* techmap_celltype = "$adff" *)
module _instants_register_with_reset (CLK, ARST, D, Q);
    parameter WIDTH = 1;
    parameter CLK_POLARITY = 1;
    parameter ARST_POLARITY = 1;
    parameter [WIDTH-1:0] ARST_VALUE = 0;
    parameter [WIDTH-1:0] _TECHMAP_WIREINIT_Q_ = 0;
    input CLK, ARST;
    input [WIDTH-1:0] D;
    output [WIDTH-1:0] Q;

    wire [WIDTH-1:0] _TECHMAP_REMOVEINIT_Q_ = {WIDTH{1'b1}};
    wire active = ARST == ARST_POLARITY;
    (* init = _TECHMAP_WIREINIT_Q_ *) wire [WIDTH-1:0] stored;
    \$ff #(.WIDTH(WIDTH)) _TECHMAP_REPLACE_ (.D(active ? ARST_VALUE : CLK ? D : stored), .Q(stored));
    assign Q = active ? ARST_VALUE : stored;
endmodule

// All ports write at each instant, if their own clock has an edge. So a memory may be written on several clocks.
(* techmap_celltype = "$mem_v2" *)
module _instants_memory (
    RD_CLK, RD_EN, RD_ARST, RD_SRST, RD_ADDR, RD_DATA, WR_CLK, WR_EN, WR_ADDR, WR_DATA
);
    parameter MEMID = "";
    parameter signed SIZE = 4;
    parameter signed OFFSET = 0;
    parameter signed ABITS = 2;
    parameter signed WIDTH = 8;
    parameter INIT = 1'bx;
    parameter signed RD_PORTS = 1;
    parameter RD_CLK_ENABLE = 1'b0;
    parameter RD_CLK_POLARITY = 1'b0;
    parameter RD_TRANSPARENCY_MASK = 1'b0;
    parameter RD_COLLISION_X_MASK = 1'b0;
    parameter RD_WIDE_CONTINUATION = 1'b0;
    parameter RD_CE_OVER_SRST = 1'b0;
    parameter RD_ARST_VALUE = 1'b0;
    parameter RD_SRST_VALUE = 1'b0;
    parameter RD_INIT_VALUE = 1'b0;
    parameter signed WR_PORTS = 1;
    parameter WR_CLK_ENABLE = 1'b0;
    parameter WR_CLK_POLARITY = 1'b0;
    parameter WR_PRIORITY_MASK = 1'b0;
    parameter WR_WIDE_CONTINUATION = 1'b0;
    parameter _TECHMAP_CONSTMSK_WR_CLK_ = 1'b0;
    input [RD_PORTS-1:0] RD_CLK, RD_EN, RD_ARST, RD_SRST;
    input [RD_PORTS*ABITS-1:0] RD_ADDR;
    output [RD_PORTS*WIDTH-1:0] RD_DATA;
    input [WR_PORTS-1:0] WR_CLK;
    input [WR_PORTS*WIDTH-1:0] WR_EN, WR_DATA;
    input [WR_PORTS*ABITS-1:0] WR_ADDR;

    // The result is not changed again.
    wire _TECHMAP_FAIL_ = &_TECHMAP_CONSTMSK_WR_CLK_;
    wire [WR_PORTS*WIDTH-1:0] enable;
    genvar port;
    generate
        for (port = 0; port < WR_PORTS; port = port + 1) begin : each
            assign enable[port*WIDTH +: WIDTH] = WR_EN[port*WIDTH +: WIDTH] & {WIDTH{WR_CLK[port]}};
        end
    endgenerate

    \$mem_v2 #(
        .MEMID(MEMID), .SIZE(SIZE), .OFFSET(OFFSET), .ABITS(ABITS), .WIDTH(WIDTH), .INIT(INIT),
        .RD_PORTS(RD_PORTS), .RD_CLK_ENABLE(RD_CLK_ENABLE), .RD_CLK_POLARITY(RD_CLK_POLARITY),
        .RD_TRANSPARENCY_MASK(RD_TRANSPARENCY_MASK), .RD_COLLISION_X_MASK(RD_COLLISION_X_MASK),
        .RD_WIDE_CONTINUATION(RD_WIDE_CONTINUATION), .RD_CE_OVER_SRST(RD_CE_OVER_SRST),
        .RD_ARST_VALUE(RD_ARST_VALUE), .RD_SRST_VALUE(RD_SRST_VALUE), .RD_INIT_VALUE(RD_INIT_VALUE),
        .WR_PORTS(WR_PORTS), .WR_CLK_ENABLE({WR_PORTS{1'b1}}), .WR_CLK_POLARITY({WR_PORTS{1'b1}}),
        .WR_PRIORITY_MASK(WR_PRIORITY_MASK), .WR_WIDE_CONTINUATION(WR_WIDE_CONTINUATION)
    ) _TECHMAP_REPLACE_ (
        .RD_CLK(RD_CLK), .RD_EN(RD_EN), .RD_ARST(RD_ARST), .RD_SRST(RD_SRST), .RD_ADDR(RD_ADDR), .RD_DATA(RD_DATA),
        .WR_CLK({WR_PORTS{1'b1}}), .WR_EN(enable), .WR_ADDR(WR_ADDR), .WR_DATA(WR_DATA)
    );
endmodule
