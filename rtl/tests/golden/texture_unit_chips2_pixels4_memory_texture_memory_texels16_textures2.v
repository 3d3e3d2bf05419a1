// texture_unit_chips2_pixels4_memory_texture_memory_texels16_textures2
//
// Looks up texels for the requests in the texture registers of a region.
//
// Parameters  TextureUnit { chips: 2, pixels: 4, memory: TextureMemory { texels: 16, textures: 2 } }
// Latency     180 clocks for a region
// Source      Reducing Latency on PixelFlow, section 4 (PFL-SHADE)
// Described   rtl/src/pixelflow/texture_unit.rs:36
`default_nettype none

module texture_unit_chips2_pixels4_memory_texture_memory_texels16_textures2 (
    input  wire        clk,
    input  wire        rst,
    // A texel that the geometry processors write.
    input  wire        write_valid,      // A texel is written.
    // The texel's bank: the parity of the level, then of the row, then of the column.
    input  wire [2:0]  write_bank,
    input  wire [3:0]  write_address,    // The texel's address in its bank.
    input  wire [23:0] write_texel,      // The texel, red in the lowest byte, then green, then blue.
    // The location of a texture, from the geometry processors.
    input  wire        describe_valid,   // The location of a texture is written.
    input  wire        describe_texture, // The number of the texture.
    input  wire [3:0]  describe_base,    // The texture's first address in each bank.
    input  wire [3:0]  describe_finest,  // The texture's finest level.
    input  wire        start,            // For one clock: begin a region.
    input  wire [15:0] seen,             // The byte of each chip that the port addresses.
    // The access to the texture registers.
    output wire [1:0]  port_pixel,       // The pixel of each chip, counted line by line.
    output wire [5:0]  port_address,     // The register of the pixel.
    output wire        port_writes,      // The register is written.
    output wire [15:0] port_bytes,       // The bytes to write, one of each chip.
    output wire        done              // For one clock: all pixels have their texels.
);

    reg busy;                                                    // rtl/src/pixelflow/texture_unit.rs:93
    reg [4:0] clock;                                             // rtl/src/pixelflow/texture_unit.rs:94
    reg [2:0] turn;                                              // rtl/src/pixelflow/texture_unit.rs:95

    wire u_memory_valid;                                         // rtl/src/pixelflow/texture_unit.rs:120
    wire [191:0] u_memory_texels;                                // rtl/src/pixelflow/texture_unit.rs:120

    wire turn_ends = busy & (clock == 5'd29);                    // rtl/src/pixelflow/texture_unit.rs:96
    wire ends = turn_ends & (turn == 3'd5);                      // rtl/src/pixelflow/texture_unit.rs:97
    wire reads = busy & (turn < 3'd4) & (clock < 5'd6);          // rtl/src/pixelflow/texture_unit.rs:104
    wire seeks = busy & (turn != 3'd0) & (turn <= 3'd4) & (clock < 5'd2); // rtl/src/pixelflow/texture_unit.rs:109
    wire writes = busy & (turn >= 3'd2) & (clock >= 5'd6) & (clock < 5'd30); // rtl/src/pixelflow/texture_unit.rs:125
    wire [2:0] port_pixel_choice = reads ? turn : (turn - 3'd2); // rtl/src/pixelflow/texture_unit.rs:129
    assign port_pixel = port_pixel_choice[1:0];                  // rtl/src/pixelflow/texture_unit.rs:129
    wire [7:0] port_address_choice = reads ? {3'd0, clock} : ({3'd0, clock} + 8'd2); // rtl/src/pixelflow/texture_unit.rs:130
    assign port_address = port_address_choice[5:0];              // rtl/src/pixelflow/texture_unit.rs:130

    genvar i;

    generate
        for (i = 0; i < 2; i = i + 1) begin : asked_row
            reg [47:0] asked;
            reg [47:0] sought;
            wire [47:0] sought_linked;
            if (i >= 1) begin : sought_linked_edge
                assign sought_linked = 48'd0;
            end else begin : sought_linked_link
                assign sought_linked = asked_row[i + 1].sought;
            end

            always @(posedge clk) begin
                if (reads) asked <= {seen[i * 8 +: 8], asked[47:8]};
                if (turn_ends) sought <= asked;
                else sought <= sought_linked;
            end
            wire _unused_lane = &{1'b0, sought};
        end
    endgenerate

    generate
        for (i = 0; i < 2; i = i + 1) begin : collected_row
            reg [191:0] collected;
            reg [191:0] given;
            wire [191:0] collected_linked;
            if (i >= 1) begin : collected_linked_edge
                assign collected_linked = u_memory_texels;
            end else begin : collected_linked_link
                assign collected_linked = collected_row[i + 1].collected;
            end
            wire [7:0] given_7_0 = given[7:0];

            always @(posedge clk) begin
                if (u_memory_valid) collected <= collected_linked;
                if (clock == 5'd3) given <= collected;
                else if (writes) given <= {8'd0, given[191:8]};
            end
        end
    endgenerate

    texture_memory_texels16_textures2 u_memory (                 // rtl/src/pixelflow/texture_unit.rs:120
        .clk              (clk),
        .rst              (rst),
        .write_valid      (write_valid),
        .write_bank       (write_bank),
        .write_address    (write_address),
        .write_texel      (write_texel),
        .describe_valid   (describe_valid),
        .describe_texture (describe_texture),
        .describe_base    (describe_base),
        .describe_finest  (describe_finest),
        .request_valid    (seeks),
        .request_u        (asked_row[0].sought[15:0]),
        .request_v        (asked_row[0].sought[31:16]),
        .request_level    (asked_row[0].sought[39:32]),
        .request_texture  (asked_row[0].sought[47:40]),
        .valid            (u_memory_valid),
        .texels           (u_memory_texels)
    );

    generate
        for (i = 0; i < 2; i = i + 1) begin : port_bytes_of
            assign port_bytes[i * 8 +: 8] = collected_row[i].given_7_0;
        end
    endgenerate

    always @(posedge clk) begin
        if (start | turn_ends) clock <= 5'd0;
        else clock <= clock + 5'd1;
        if (start) turn <= 3'd0;
        else if (turn_ends) turn <= turn + 3'd1;
    end

    always @(posedge clk) begin
        if (rst) busy <= 1'b0;
        else if (start) busy <= 1'b1;
        else if (ends) busy <= 1'b0;
    end

    assign port_writes = writes;
    assign done = ends;

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
        if (!rst) assume (!start | !busy);                           // rtl/src/pixelflow/texture_unit.rs:98
    end
`else
    always @(posedge clk) begin
        if (!rst && !(!start | !busy)) begin                         // rtl/src/pixelflow/texture_unit.rs:98
            $display("FAIL: time %0t: %m: the stimulus breaks an assumption: the texture unit begins only when it is done", $time);
            stop;
        end
    end
`endif
`endif

    wire _unused_ok = &{1'b0, port_pixel_choice[2], port_address_choice[7:6]};
endmodule
`default_nettype wire
