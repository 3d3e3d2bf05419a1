// network_nodes3_port_network_port_chips2_pixels4_width8
//
// Connects the ports of all nodes in a chain, in one direction.
//
// Parameters  Network { nodes: 3, port: NetworkPort { chips: 2, pixels: 4, width: 8 } }
// Latency     1 clock per node; a byte of all pixels takes 4
// Source      Reducing Latency on PixelFlow, section 3 (PFL-NET)
// Described   rtl/src/pixelflow/network.rs:20
`default_nettype none

module network_nodes3_port_network_port_chips2_pixels4_width8 (
    input  wire        clk,
    input  wire        rst,
    // The inputs of each node.
    input  wire [1:0]  nodes_0_mode,     // The mode of the node, constant during a word: a `Mode`.
    input  wire        nodes_0_sends,    // A node in mode `Load` sends a byte of each chip.
    input  wire        nodes_0_first,    // The byte is the first of a word.
    input  wire [15:0] nodes_0_own,      // The node's own bytes of the current pixels.
    input  wire [1:0]  nodes_1_mode,
    input  wire        nodes_1_sends,
    input  wire        nodes_1_first,
    input  wire [15:0] nodes_1_own,
    input  wire [1:0]  nodes_2_mode,
    input  wire        nodes_2_sends,
    input  wire        nodes_2_first,
    input  wire [15:0] nodes_2_own,
    // The outputs to each node.
    output wire [1:0]  nodes_0_pixel,    // The current pixel of each chip.
    output wire        nodes_0_advances, // A byte of the current pixel is transferred.
    output wire        nodes_0_unloaded, // The incoming bytes are for this node.
    output wire [15:0] nodes_0_bytes,    // The incoming bytes, one of each chip.
    output wire [1:0]  nodes_1_pixel,
    output wire        nodes_1_advances,
    output wire        nodes_1_unloaded,
    output wire [15:0] nodes_1_bytes,
    output wire [1:0]  nodes_2_pixel,
    output wire        nodes_2_advances,
    output wire        nodes_2_unloaded,
    output wire [15:0] nodes_2_bytes
);

    wire u_port0_downstream_valid;                               // rtl/src/pixelflow/network.rs:75
    wire u_port0_downstream_first;                               // rtl/src/pixelflow/network.rs:75
    wire u_port1_downstream_valid;                               // rtl/src/pixelflow/network.rs:75
    wire u_port1_downstream_first;                               // rtl/src/pixelflow/network.rs:75
    wire u_port2_downstream_valid;                               // rtl/src/pixelflow/network.rs:75
    wire u_port2_downstream_first;                               // rtl/src/pixelflow/network.rs:75
    wire [15:0] u_port2_downstream_bytes;                        // rtl/src/pixelflow/network.rs:75

    network_port_chips2_pixels4_width8 u_port0 (                 // rtl/src/pixelflow/network.rs:75
        .clk              (clk),
        .rst              (rst),
        .mode             (nodes_0_mode),
        .sends            (nodes_0_sends),
        .first            (nodes_0_first),
        .upstream_valid   (1'b0),
        .upstream_first   (1'b0),
        .upstream_bytes   (16'd0),
        .own              (nodes_0_own),
        .pixel            (nodes_0_pixel),
        .advances         (nodes_0_advances),
        .unloaded         (nodes_0_unloaded),
        .downstream_valid (u_port0_downstream_valid),
        .downstream_first (u_port0_downstream_first),
        .downstream_bytes (nodes_1_bytes)
    );

    network_port_chips2_pixels4_width8 u_port1 (                 // rtl/src/pixelflow/network.rs:75
        .clk              (clk),
        .rst              (rst),
        .mode             (nodes_1_mode),
        .sends            (nodes_1_sends),
        .first            (nodes_1_first),
        .upstream_valid   (u_port0_downstream_valid),
        .upstream_first   (u_port0_downstream_first),
        .upstream_bytes   (nodes_1_bytes),
        .own              (nodes_1_own),
        .pixel            (nodes_1_pixel),
        .advances         (nodes_1_advances),
        .unloaded         (nodes_1_unloaded),
        .downstream_valid (u_port1_downstream_valid),
        .downstream_first (u_port1_downstream_first),
        .downstream_bytes (nodes_2_bytes)
    );

    network_port_chips2_pixels4_width8 u_port2 (                 // rtl/src/pixelflow/network.rs:75
        .clk              (clk),
        .rst              (rst),
        .mode             (nodes_2_mode),
        .sends            (nodes_2_sends),
        .first            (nodes_2_first),
        .upstream_valid   (u_port1_downstream_valid),
        .upstream_first   (u_port1_downstream_first),
        .upstream_bytes   (nodes_2_bytes),
        .own              (nodes_2_own),
        .pixel            (nodes_2_pixel),
        .advances         (nodes_2_advances),
        .unloaded         (nodes_2_unloaded),
        .downstream_valid (u_port2_downstream_valid),
        .downstream_first (u_port2_downstream_first),
        .downstream_bytes (u_port2_downstream_bytes)
    );

    assign nodes_0_bytes = 16'd0;

    wire _unused_ok = &{1'b0, u_port2_downstream_valid, u_port2_downstream_first,
            u_port2_downstream_bytes};
endmodule
`default_nettype wire
