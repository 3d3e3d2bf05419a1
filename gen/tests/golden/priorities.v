// priorities
//
// Registers that say what they take when: alone and together, with and without reset, and
// one with an enable and a last word.
//
// Parameters  Updates
// Described   gen/tests/blocks/mod.rs:170
`default_nettype none

module priorities (
    input  wire       clk,
    input  wire       rst,
    input  wire       clear,
    input  wire       load,
    input  wire       step,
    input  wire [7:0] value,
    output reg  [7:0] count,
    output reg  [7:0] loads,
    output reg  [7:0] last,
    output reg  [1:0] moved
);

    always @(posedge clk) begin
        if (load) last <= value;
        else if (clear) last <= 8'd255;
    end

    always @(posedge clk) begin
        if (!clear) begin
            if (load) moved <= 2'd2;
            else if (step) moved <= 2'd1;
            else moved <= 2'd0;
        end
    end

    always @(posedge clk) begin
        if (rst) begin
            count <= 8'd0;
            loads <= 8'd0;
        end else begin
            if (clear) count <= 8'd0;
            else if (load) count <= value;
            else if (step) count <= count + 8'd1;
            if (clear) loads <= 8'd0;
            else if (load) loads <= loads + 8'd1;
        end
    end
endmodule
`default_nettype wire
