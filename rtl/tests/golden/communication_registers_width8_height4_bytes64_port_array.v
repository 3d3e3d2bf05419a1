// communication_registers_width8_height4_bytes64_port_array
//
// Registers of a region's pixels, with a port that accesses one pixel of each chip.
//
// Parameters  CommunicationRegisters { width: 8, height: 4, bytes: 64, port: Clock { name: "array", period: Period(10000) } }
// Latency     0 clocks to read; a write takes effect at the edge
// Source      Reducing Latency on PixelFlow, section 3 (PFL-NODE)
// Described   rtl/src/pixelflow/registers.rs:22
// Stable      port and array never access the same registers at the same time (rtl/src/pixelflow/registers.rs:82)
`default_nettype none

module communication_registers_width8_height4_bytes64_port_array (
    input  wire         array_clk,
    input  wire [5:0]   read,         // The register that the array reads.
    input  wire [5:0]   write,        // The register that the array writes.
    input  wire [31:0]  writes,       // The pixels whose register the array writes.
    // The byte that each pixel writes: a row for each chip, with its upper line before its lower one.
    input  wire [255:0] result,
    // The access of the port.
    input  wire [3:0]   port_pixel,   // The pixel of each chip, counted line by line.
    input  wire [5:0]   port_address, // The register of the pixel.
    input  wire         port_writes,  // The register is written.
    input  wire [15:0]  port_bytes,   // The bytes to write, one of each chip.
    output wire [255:0] word,         // The byte that each pixel reads.
    output wire [15:0]  seen          // The byte of each chip that the port reads.
);

    (* no_rw_check *)
    reg [255:0] bytes [0:63];                                    // rtl/src/pixelflow/registers.rs:73

    wire [31:0] bytes_write_enable;                              // rtl/src/pixelflow/registers.rs:80
    wire [255:0] bytes_write_data;                               // rtl/src/pixelflow/registers.rs:80
    wire [255:0] bytes_word0 = bytes[port_address];              // rtl/src/pixelflow/registers.rs:83
    assign word = bytes[read];                                   // rtl/src/pixelflow/registers.rs:84

    genvar i;
    genvar j;

    generate
        for (i = 0; i < 16; i = i + 1) begin : here_row
            localparam [31:0] here_listed = i;
            wire here = (here_listed[3:0] == port_pixel) & port_writes;
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : seen_picked_row
            wire [7:0] seen_picked;
            wire [7:0] seen_picked_lanes [0:15];
            for (j = 0; j < 16; j = j + 1) begin : seen_picked_of
                assign seen_picked_lanes[j] = bytes_word0[(i * 16 + j) * 8 +: 8];
            end
            assign seen_picked = seen_picked_lanes[port_pixel];
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : bytes_write_joined_row
            wire [127:0] bytes_write_joined = {16{port_bytes[i * 8 +: 8]}};
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : bytes_write_enable_of
            for (j = 0; j < 16; j = j + 1) begin : bytes_write_enable_col
                assign bytes_write_enable[i * 16 + j] = here_row[j].here;
            end
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : bytes_write_data_of
            assign bytes_write_data[i * 128 +: 128] = bytes_write_joined_row[i].bytes_write_joined;
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : seen_of
            assign seen[i * 8 +: 8] = seen_picked_row[i].seen_picked;
        end
    endgenerate

    generate
        for (i = 0; i < 32; i = i + 1) begin : bytes_lane
            always @(posedge array_clk) begin
                if (writes[i]) bytes[write][i * 8 +: 8] <= result[i * 8 +: 8];
                if (bytes_write_enable[i]) begin
                    bytes[port_address][i * 8 +: 8] <= bytes_write_data[i * 8 +: 8];
                end
            end
        end
    endgenerate
endmodule
`default_nettype wire
