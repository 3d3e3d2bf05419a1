// The lamp of chapter 0 on a Lattice iCEstick: it changes twice a second.
`default_nettype none

module blink_board (
    input  wire clk12, // 12 MHz
    output wire led
);
    wire rst;

    power_on_reset_clocks16 u_reset (.clk(clk12), .again(1'b0), .reset(rst));

    blink_clocks6000000 u_blink (.clk(clk12), .rst(rst), .enable(1'b1), .lamp(led));
endmodule
`default_nettype wire
