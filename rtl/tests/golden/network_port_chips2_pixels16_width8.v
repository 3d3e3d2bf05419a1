// network_port_chips2_pixels16_width8
//
// Connects a node to the network that composes images.
//
// Parameters  NetworkPort { chips: 2, pixels: 16, width: 8 }
// Latency     1 clock; a byte of all pixels takes 16
// Source      Reducing Latency on PixelFlow, section 3 (PFL-NET, PFL-TCB)
// Described   rtl/src/pixelflow/network_port.rs:25
`default_nettype none

module network_port_chips2_pixels16_width8 (
    input  wire        clk,
    input  wire        rst,
    input  wire [1:0]  mode,             // The mode of the node, constant during a word: a `Mode`.
    input  wire        sends,            // A node in mode `Load` sends a byte of each chip.
    input  wire        first,            // The byte is the first of a word.
    // The bytes from the previous node.
    input  wire        upstream_valid,   // A byte of each chip is transferred.
    input  wire        upstream_first,   // The byte is the first of a word.
    input  wire [15:0] upstream_bytes,   // The bytes, one of each chip.
    input  wire [15:0] own,              // The node's own bytes of the pixels at `pixel`.
    output reg  [3:0]  pixel,            // The current pixel of each chip.
    output wire        advances,         // A byte of the current pixel is transferred.
    output wire        unloaded,         // The bytes from upstream are for this node.
    // The bytes to the next node.
    output reg         downstream_valid, // A byte of each chip is transferred.
    output reg         downstream_first, // The byte is the first of a word.
    output wire [15:0] downstream_bytes  // The bytes, one of each chip.
);

    localparam [1:0] MODE_LOAD   = 2'd1;
    localparam [1:0] MODE_UNLOAD = 2'd3;
    // Not used here: MODE_FORWARD = 0, MODE_COMPOSITE = 2.

    wire loads = mode == MODE_LOAD;                              // rtl/src/pixelflow/network_port.rs:76
    assign advances = loads ? sends : upstream_valid;            // rtl/src/pixelflow/network_port.rs:77
    wire is_first = loads ? first : upstream_first;              // rtl/src/pixelflow/network_port.rs:78
    assign unloaded = (mode == MODE_UNLOAD) & upstream_valid;    // rtl/src/pixelflow/network_port.rs:98

    genvar i;

    generate
        for (i = 0; i < 2; i = i + 1) begin : u_compositor           // rtl/src/pixelflow/network_port.rs:84
            wire [7:0] downstream;

            compositor_pixels16_width8 lane (
                .clk        (clk),
                .mode       (mode),
                .advances   (advances),
                .first      (is_first),
                .pixel      (pixel),
                .upstream   (upstream_bytes[i * 8 +: 8]),
                .own        (own[i * 8 +: 8]),
                .downstream (downstream)
            );
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : downstream_bytes_of
            assign downstream_bytes[i * 8 +: 8] = u_compositor[i].downstream;
        end
    endgenerate

    always @(posedge clk) begin
        downstream_first <= is_first;
    end

    always @(posedge clk) begin
        if (rst) begin
            pixel <= 4'd0;
            downstream_valid <= 1'b0;
        end else begin
            if (advances) begin
                if (pixel == 4'd15) pixel <= 4'd0;
                else pixel <= pixel + 4'd1;
            end
            downstream_valid <= advances;
        end
    end

`ifndef SYNTHESIS
`ifndef FORMAL
    task stop;
        begin
`ifdef __ICARUS__
            $finish_and_return(1);
`else
            $stop;
`endif
        end
    endtask
`endif
`endif

`ifndef SYNTHESIS
`ifdef FORMAL
    always @(posedge clk) begin
        if (!rst) assume (!(loads & upstream_valid));                // rtl/src/pixelflow/network_port.rs:81
    end
`else
    always @(posedge clk) begin
        if (!rst && (loads & upstream_valid)) begin                  // rtl/src/pixelflow/network_port.rs:81
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: no byte arrives while a node loads", $time);
            stop;
        end
    end
`endif
`endif
endmodule
`default_nettype wire
