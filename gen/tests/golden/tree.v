// tree
//
// Parameters  tree
// Described   gen/tests/lanes/modules.rs:40
`default_nettype none

module tree (
    input  wire        clk,
    input  wire        rst,
    input  wire [3:0]  root,
    output wire [31:0] leaves,
    output wire [31:0] order
);

    genvar i;

    generate
        for (i = 0; i < 15; i = i + 1) begin : value_row
            reg [3:0] value;
            wire [3:0] value_linked;
            if (i < 1) begin : value_linked_edge
                assign value_linked = root;
            end else begin : value_linked_link
                assign value_linked = value_row[(i - 1) / 2].value;
            end
            localparam [31:0] value_listed = i;

            always @(posedge clk) begin
                if (rst) value <= 4'd0;
                else value <= value_linked ^ value_listed[3:0];
            end
        end
    endgenerate

    generate
        for (i = 0; i < 8; i = i + 1) begin : order_lane_row
            wire [3:0] order_lane;
            case (i % 2)
                0: begin : order_lane_0 assign order_lane = value_row[2 * (i / 2) + 7].value; end
                default: begin : order_lane_1 assign order_lane = value_row[14 - 2 * (i / 2)].value; end
            endcase
        end
    endgenerate

    generate
        for (i = 0; i < 8; i = i + 1) begin : leaves_of
            assign leaves[i * 4 +: 4] = value_row[i + 7].value;
        end
    endgenerate
    generate
        for (i = 0; i < 8; i = i + 1) begin : order_of
            assign order[i * 4 +: 4] = order_lane_row[i].order_lane;
        end
    endgenerate
endmodule
`default_nettype wire
