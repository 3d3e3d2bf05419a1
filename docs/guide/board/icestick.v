// The echo on a Lattice iCEstick: its oscillator, the reset after power-on, and four pins.
`default_nettype none

module icestick (
    input  wire clk12, // 12 MHz
    input  wire rx,
    output wire tx,
    output reg  led    // A byte was lost.
);
    wire rst;
    wire overrun;

    power_on_reset_clocks16 u_reset (.clk(clk12), .again(1'b0), .reset(rst));

    echo_clocks_per_bit104_depth16 u_echo (
        .clk(clk12), .rst(rst), .rx(rx), .tx(tx), .overrun(overrun)
    );

    always @(posedge clk12) begin
        if (rst) led <= 1'b0;
        else if (overrun) led <= 1'b1;
    end
endmodule
`default_nettype wire
