// communication_registers_width8_height4_bytes64_port_array
//
// Registers of a region's pixels, with a port that accesses one pixel of each chip.
//
// Parameters  CommunicationRegisters { width: 8, height: 4, bytes: 64, port: Clock { name: "array", period: Period(10000) } }
// Latency     0 clocks to read; a write takes effect at the edge
// Source      Reducing Latency on PixelFlow, section 3 (PFL-NODE)
// Described   rtl/src/pixelflow/registers.rs:25
// Stable      kept: port and array never access the same registers at the same time (rtl/src/pixelflow/registers.rs:83)
// Stable      port and array never access the same registers at the same time (rtl/src/pixelflow/registers.rs:80)
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
    reg [255:0] by_array [0:63];                                 // rtl/src/pixelflow/registers.rs:77
    (* no_rw_check *)
    reg [255:0] by_port [0:63];                                  // rtl/src/pixelflow/registers.rs:78

    initial begin : by_array_contents
        integer word_i;
        for (word_i = 0; word_i < 64; word_i = word_i + 1) by_array[word_i] = 256'h0000000000000000000000000000000000000000000000000000000000000000;
    end

    initial begin : by_port_contents
        integer word_i;
        for (word_i = 0; word_i < 64; word_i = word_i + 1) by_port[word_i] = 256'h0000000000000000000000000000000000000000000000000000000000000000;
    end

    wire [255:0] by_array_write_data;                            // rtl/src/pixelflow/registers.rs:84
    wire [31:0] by_port_write_enable;                            // rtl/src/pixelflow/registers.rs:92
    wire [255:0] by_port_write_data;                             // rtl/src/pixelflow/registers.rs:92
    wire [255:0] by_port_word0 = by_port[write];                 // rtl/src/pixelflow/registers.rs:81
    wire [255:0] by_array_word0 = by_array[read];                // rtl/src/pixelflow/registers.rs:81
    wire [255:0] by_port_word1 = by_port[read];                  // rtl/src/pixelflow/registers.rs:81
    wire [255:0] by_array_word1 = by_array[port_address];        // rtl/src/pixelflow/registers.rs:81
    wire [255:0] by_port_word2 = by_port[port_address];          // rtl/src/pixelflow/registers.rs:81

    genvar i;
    genvar j;

    generate
        for (i = 0; i < 2; i = i + 1) begin : kept_cells
            for (j = 0; j < 16; j = j + 1) begin : col
                wire [7:0] kept = by_port_word0[(i * 16 + j) * 8 +: 8];
                wire [7:0] by_array_write_xor = result[(i * 16 + j) * 8 +: 8] ^ kept;
            end
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : word_xor_cells
            for (j = 0; j < 16; j = j + 1) begin : col
                wire [7:0] word_xor = by_array_word0[(i * 16 + j) * 8 +: 8] ^ by_port_word1[(i * 16 + j) * 8 +: 8];
            end
        end
    endgenerate

    generate
        for (i = 0; i < 16; i = i + 1) begin : here_row
            localparam [31:0] here_listed = i;
            wire here = (here_listed[3:0] == port_pixel) & port_writes;
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : array_byte_row
            wire [7:0] array_byte;
            wire [7:0] array_byte_lanes [0:15];
            for (j = 0; j < 16; j = j + 1) begin : array_byte_of
                assign array_byte_lanes[j] = by_array_word1[(i * 16 + j) * 8 +: 8];
            end
            assign array_byte = array_byte_lanes[port_pixel];
            wire [7:0] port_byte;
            wire [7:0] port_byte_lanes [0:15];
            for (j = 0; j < 16; j = j + 1) begin : port_byte_of
                assign port_byte_lanes[j] = by_port_word2[(i * 16 + j) * 8 +: 8];
            end
            assign port_byte = port_byte_lanes[port_pixel];
            wire [7:0] array_byte_xor_port_byte = array_byte ^ port_byte;
            wire [127:0] by_port_write_joined = {16{port_bytes[i * 8 +: 8] ^ array_byte}};
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : by_array_write_data_of
            for (j = 0; j < 16; j = j + 1) begin : by_array_write_data_col
                assign by_array_write_data[(i * 16 + j) * 8 +: 8] = kept_cells[i].col[j].by_array_write_xor;
            end
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : by_port_write_enable_of
            for (j = 0; j < 16; j = j + 1) begin : by_port_write_enable_col
                assign by_port_write_enable[i * 16 + j] = here_row[j].here;
            end
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : by_port_write_data_of
            assign by_port_write_data[i * 128 +: 128] = array_byte_row[i].by_port_write_joined;
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : word_of
            for (j = 0; j < 16; j = j + 1) begin : word_col
                assign word[(i * 16 + j) * 8 +: 8] = word_xor_cells[i].col[j].word_xor;
            end
        end
    endgenerate
    generate
        for (i = 0; i < 2; i = i + 1) begin : seen_of
            assign seen[i * 8 +: 8] = array_byte_row[i].array_byte_xor_port_byte;
        end
    endgenerate

    generate
        for (i = 0; i < 32; i = i + 1) begin : by_array_lane
            always @(posedge array_clk) begin
                if (writes[i]) begin
                    by_array[write][i * 8 +: 8] <= by_array_write_data[i * 8 +: 8];
                end
            end
        end
    endgenerate

    generate
        for (i = 0; i < 32; i = i + 1) begin : by_port_lane
            always @(posedge array_clk) begin
                if (by_port_write_enable[i]) begin
                    by_port[port_address][i * 8 +: 8] <= by_port_write_data[i * 8 +: 8];
                end
            end
        end
    endgenerate
endmodule
`default_nettype wire
