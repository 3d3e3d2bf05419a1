// texture_memory_texels16_textures2
//
// Reads the texels around a point of a texture on two levels.
//
// Parameters  TextureMemory { texels: 16, textures: 2 }
// Latency     3 clocks; a point per clock
// Source      Reducing Latency on PixelFlow, section 4 (PFL-SHADE)
// Described   rtl/src/pixelflow/texture_memory.rs:25
`default_nettype none

module texture_memory_texels16_textures2 (
    input  wire         clk,
    input  wire         rst,
    // A texel that the geometry processors write.
    input  wire         write_valid,      // A texel is written.
    // The texel's bank: the parity of the level, then of the row, then of the column.
    input  wire [2:0]   write_bank,
    input  wire [3:0]   write_address,    // The texel's address in its bank.
    input  wire [23:0]  write_texel,      // The texel, red in the lowest byte, then green, then blue.
    // The location of a texture, from the geometry processors.
    input  wire         describe_valid,   // The location of a texture is written.
    input  wire         describe_texture, // The number of the texture.
    input  wire [3:0]   describe_base,    // The texture's first address in each bank.
    input  wire [3:0]   describe_finest,  // The texture's finest level.
    // The point to look up.
    input  wire         request_valid,    // There is a point to look up.
    input  wire [15:0]  request_u,        // The distance from the left, in 1/2^16 of the texture.
    input  wire [15:0]  request_v,        // The distance from the bottom, in 1/2^16 of the texture.
    input  wire [7:0]   request_level,    // The coarser of the two levels.
    input  wire [7:0]   request_texture,  // The number of the texture.
    output wire         valid,            // The texels of a point are at the output.
    // Texel 4 s + 2 y + x is on level `level + s`: on the right if x is 1, and above if y is 1.
    output wire [191:0] texels
);

    reg valid1;                                                  // rtl/src/pixelflow/texture_memory.rs:126
    reg valid2;                                                  // rtl/src/pixelflow/texture_memory.rs:126
    reg valid3;                                                  // rtl/src/pixelflow/texture_memory.rs:126
    reg [15:0] u;                                                // rtl/src/pixelflow/texture_memory.rs:135
    reg [15:0] v;                                                // rtl/src/pixelflow/texture_memory.rs:135
    reg [7:0] level;                                             // rtl/src/pixelflow/texture_memory.rs:136
    reg [3:0] base;                                              // rtl/src/pixelflow/texture_memory.rs:139
    reg [3:0] coarser_level;                                     // rtl/src/pixelflow/texture_memory.rs:145
    reg [9:0] coarser_left;                                      // rtl/src/pixelflow/texture_memory.rs:145
    reg [9:0] coarser_right;                                     // rtl/src/pixelflow/texture_memory.rs:145
    reg [9:0] coarser_below;                                     // rtl/src/pixelflow/texture_memory.rs:145
    reg [9:0] coarser_above;                                     // rtl/src/pixelflow/texture_memory.rs:145
    reg [3:0] finer_level;                                       // rtl/src/pixelflow/texture_memory.rs:146
    reg [9:0] finer_left;                                        // rtl/src/pixelflow/texture_memory.rs:146
    reg [9:0] finer_right;                                       // rtl/src/pixelflow/texture_memory.rs:146
    reg [9:0] finer_below;                                       // rtl/src/pixelflow/texture_memory.rs:146
    reg [9:0] finer_above;                                       // rtl/src/pixelflow/texture_memory.rs:146

    reg [3:0] bases [0:1];                                       // rtl/src/pixelflow/texture_memory.rs:131
    reg [3:0] bases_read;                                        // rtl/src/pixelflow/texture_memory.rs:133
    reg [3:0] finests [0:1];                                     // rtl/src/pixelflow/texture_memory.rs:131
    reg [3:0] finests_read;                                      // rtl/src/pixelflow/texture_memory.rs:133
    reg [23:0] bank0 [0:15];                                     // rtl/src/pixelflow/texture_memory.rs:150
    reg [23:0] bank0_read;                                       // rtl/src/pixelflow/texture_memory.rs:152
    reg [23:0] bank1 [0:15];                                     // rtl/src/pixelflow/texture_memory.rs:150
    reg [23:0] bank1_read;                                       // rtl/src/pixelflow/texture_memory.rs:152
    reg [23:0] bank2 [0:15];                                     // rtl/src/pixelflow/texture_memory.rs:150
    reg [23:0] bank2_read;                                       // rtl/src/pixelflow/texture_memory.rs:152
    reg [23:0] bank3 [0:15];                                     // rtl/src/pixelflow/texture_memory.rs:150
    reg [23:0] bank3_read;                                       // rtl/src/pixelflow/texture_memory.rs:152
    reg [23:0] bank4 [0:15];                                     // rtl/src/pixelflow/texture_memory.rs:150
    reg [23:0] bank4_read;                                       // rtl/src/pixelflow/texture_memory.rs:152
    reg [23:0] bank5 [0:15];                                     // rtl/src/pixelflow/texture_memory.rs:150
    reg [23:0] bank5_read;                                       // rtl/src/pixelflow/texture_memory.rs:152
    reg [23:0] bank6 [0:15];                                     // rtl/src/pixelflow/texture_memory.rs:150
    reg [23:0] bank6_read;                                       // rtl/src/pixelflow/texture_memory.rs:152
    reg [23:0] bank7 [0:15];                                     // rtl/src/pixelflow/texture_memory.rs:150
    reg [23:0] bank7_read;                                       // rtl/src/pixelflow/texture_memory.rs:152

    wire [20:0] even_line0_picked;                               // rtl/src/pixelflow/texture_memory.rs:166
    wire [20:0] odd_line0_picked;                                // rtl/src/pixelflow/texture_memory.rs:166
    wire [3:0] coarser_level_next = ({1'd0, level} < {5'd0, finests_read}) ? level[3:0] : finests_read; // rtl/src/pixelflow/texture_memory.rs:141
    wire [25:0] coarser_left_shifted = {10'd0, u} << coarser_level_next; // rtl/src/pixelflow/texture_memory.rs:206
    wire [25:0] coarser_left_difference = {8'd0, coarser_left_shifted[25:8]} - 26'd128; // rtl/src/pixelflow/texture_memory.rs:206
    wire [10:0] coarser_left_difference_2 = (11'd1 << coarser_level_next) - 11'd1; // rtl/src/pixelflow/texture_memory.rs:207
    wire [9:0] coarser_left_next = coarser_left_difference[17:8] & coarser_left_difference_2[9:0]; // rtl/src/pixelflow/texture_memory.rs:209
    wire [25:0] coarser_below_shifted = {10'd0, v} << coarser_level_next; // rtl/src/pixelflow/texture_memory.rs:206
    wire [25:0] coarser_below_difference = {8'd0, coarser_below_shifted[25:8]} - 26'd128; // rtl/src/pixelflow/texture_memory.rs:206
    wire [10:0] coarser_below_difference_2 = (11'd1 << coarser_level_next) - 11'd1; // rtl/src/pixelflow/texture_memory.rs:207
    wire [9:0] coarser_below_next = coarser_below_difference[17:8] & coarser_below_difference_2[9:0]; // rtl/src/pixelflow/texture_memory.rs:209
    wire [8:0] finer_level_sum = {1'd0, level} + 9'd1;           // rtl/src/pixelflow/texture_memory.rs:146
    wire finer_level_less = finer_level_sum < {5'd0, finests_read}; // rtl/src/pixelflow/texture_memory.rs:141
    wire [3:0] finer_level_next = finer_level_less ? finer_level_sum[3:0] : finests_read; // rtl/src/pixelflow/texture_memory.rs:141
    wire [25:0] finer_left_shifted = {10'd0, u} << finer_level_next; // rtl/src/pixelflow/texture_memory.rs:206
    wire [25:0] finer_left_difference = {8'd0, finer_left_shifted[25:8]} - 26'd128; // rtl/src/pixelflow/texture_memory.rs:206
    wire [10:0] finer_left_difference_2 = (11'd1 << finer_level_next) - 11'd1; // rtl/src/pixelflow/texture_memory.rs:207
    wire [9:0] finer_left_next = finer_left_difference[17:8] & finer_left_difference_2[9:0]; // rtl/src/pixelflow/texture_memory.rs:209
    wire [25:0] finer_below_shifted = {10'd0, v} << finer_level_next; // rtl/src/pixelflow/texture_memory.rs:206
    wire [25:0] finer_below_difference = {8'd0, finer_below_shifted[25:8]} - 26'd128; // rtl/src/pixelflow/texture_memory.rs:206
    wire [10:0] finer_below_difference_2 = (11'd1 << finer_level_next) - 11'd1; // rtl/src/pixelflow/texture_memory.rs:207
    wire [9:0] finer_below_next = finer_below_difference[17:8] & finer_below_difference_2[9:0]; // rtl/src/pixelflow/texture_memory.rs:209
    wire even_level_inverse = !coarser_level[0];                 // rtl/src/pixelflow/texture_memory.rs:165
    wire [3:0] even_level = even_level_inverse ? coarser_level : finer_level; // rtl/src/pixelflow/texture_memory.rs:165
    wire [9:0] even_left = even_level_inverse ? coarser_left : finer_left; // rtl/src/pixelflow/texture_memory.rs:165
    wire [9:0] even_right = even_level_inverse ? coarser_right : finer_right; // rtl/src/pixelflow/texture_memory.rs:165
    wire [9:0] even_below = even_level_inverse ? coarser_below : finer_below; // rtl/src/pixelflow/texture_memory.rs:165
    wire [9:0] even_above = even_level_inverse ? coarser_above : finer_above; // rtl/src/pixelflow/texture_memory.rs:165
    wire [9:0] even_line0_choice = !even_below[0] ? even_below : even_above; // rtl/src/pixelflow/texture_memory.rs:162
    wire [20:0] even_line0_shifted = {12'd0, even_line0_choice[9:1]} << even_level; // rtl/src/pixelflow/texture_memory.rs:169
    wire [20:0] even_line0 = even_line0_picked + {1'd0, even_line0_shifted[20:1]}; // rtl/src/pixelflow/texture_memory.rs:169
    wire [9:0] even_line1_choice = even_below[0] ? even_below : even_above; // rtl/src/pixelflow/texture_memory.rs:162
    wire [20:0] even_line1_shifted = {12'd0, even_line1_choice[9:1]} << even_level; // rtl/src/pixelflow/texture_memory.rs:169
    wire [20:0] even_line1 = even_line0_picked + {1'd0, even_line1_shifted[20:1]}; // rtl/src/pixelflow/texture_memory.rs:169
    wire [9:0] even_column0_choice = !even_left[0] ? even_left : even_right; // rtl/src/pixelflow/texture_memory.rs:162
    wire [20:0] even_column0 = {12'd0, even_column0_choice[9:1]}; // rtl/src/pixelflow/texture_memory.rs:173
    wire [9:0] even_column1_choice = even_left[0] ? even_left : even_right; // rtl/src/pixelflow/texture_memory.rs:162
    wire [20:0] even_column1 = {12'd0, even_column1_choice[9:1]}; // rtl/src/pixelflow/texture_memory.rs:173
    wire [20:0] even_line0_plus_even_column0 = even_line0 + even_column0; // rtl/src/pixelflow/texture_memory.rs:176
    wire [3:0] bank0_read_address = base + even_line0_plus_even_column0[3:0]; // rtl/src/pixelflow/texture_memory.rs:176
    wire [20:0] even_line0_plus_even_column1 = even_line0 + even_column1; // rtl/src/pixelflow/texture_memory.rs:176
    wire [3:0] bank1_read_address = base + even_line0_plus_even_column1[3:0]; // rtl/src/pixelflow/texture_memory.rs:176
    wire [20:0] even_line1_plus_even_column0 = even_line1 + even_column0; // rtl/src/pixelflow/texture_memory.rs:176
    wire [3:0] bank2_read_address = base + even_line1_plus_even_column0[3:0]; // rtl/src/pixelflow/texture_memory.rs:176
    wire [20:0] even_line1_plus_even_column1 = even_line1 + even_column1; // rtl/src/pixelflow/texture_memory.rs:176
    wire [3:0] bank3_read_address = base + even_line1_plus_even_column1[3:0]; // rtl/src/pixelflow/texture_memory.rs:176
    wire [3:0] odd_level = coarser_level[0] ? coarser_level : finer_level; // rtl/src/pixelflow/texture_memory.rs:165
    wire [9:0] odd_left = coarser_level[0] ? coarser_left : finer_left; // rtl/src/pixelflow/texture_memory.rs:165
    wire [9:0] odd_right = coarser_level[0] ? coarser_right : finer_right; // rtl/src/pixelflow/texture_memory.rs:165
    wire [9:0] odd_below = coarser_level[0] ? coarser_below : finer_below; // rtl/src/pixelflow/texture_memory.rs:165
    wire [9:0] odd_above = coarser_level[0] ? coarser_above : finer_above; // rtl/src/pixelflow/texture_memory.rs:165
    wire [9:0] odd_line0_choice = !odd_below[0] ? odd_below : odd_above; // rtl/src/pixelflow/texture_memory.rs:162
    wire [20:0] odd_line0_shifted = {12'd0, odd_line0_choice[9:1]} << odd_level; // rtl/src/pixelflow/texture_memory.rs:169
    wire [20:0] odd_line0 = odd_line0_picked + {1'd0, odd_line0_shifted[20:1]}; // rtl/src/pixelflow/texture_memory.rs:169
    wire [9:0] odd_line1_choice = odd_below[0] ? odd_below : odd_above; // rtl/src/pixelflow/texture_memory.rs:162
    wire [20:0] odd_line1_shifted = {12'd0, odd_line1_choice[9:1]} << odd_level; // rtl/src/pixelflow/texture_memory.rs:169
    wire [20:0] odd_line1 = odd_line0_picked + {1'd0, odd_line1_shifted[20:1]}; // rtl/src/pixelflow/texture_memory.rs:169
    wire [9:0] odd_column0_choice = !odd_left[0] ? odd_left : odd_right; // rtl/src/pixelflow/texture_memory.rs:162
    wire [20:0] odd_column0 = {12'd0, odd_column0_choice[9:1]};  // rtl/src/pixelflow/texture_memory.rs:173
    wire [9:0] odd_column1_choice = odd_left[0] ? odd_left : odd_right; // rtl/src/pixelflow/texture_memory.rs:162
    wire [20:0] odd_column1 = {12'd0, odd_column1_choice[9:1]};  // rtl/src/pixelflow/texture_memory.rs:173
    wire [20:0] odd_line0_plus_odd_column0 = odd_line0 + odd_column0; // rtl/src/pixelflow/texture_memory.rs:176
    wire [3:0] bank4_read_address = base + odd_line0_plus_odd_column0[3:0]; // rtl/src/pixelflow/texture_memory.rs:176
    wire [20:0] odd_line0_plus_odd_column1 = odd_line0 + odd_column1; // rtl/src/pixelflow/texture_memory.rs:176
    wire [3:0] bank5_read_address = base + odd_line0_plus_odd_column1[3:0]; // rtl/src/pixelflow/texture_memory.rs:176
    wire [20:0] odd_line1_plus_odd_column0 = odd_line1 + odd_column0; // rtl/src/pixelflow/texture_memory.rs:176
    wire [3:0] bank6_read_address = base + odd_line1_plus_odd_column0[3:0]; // rtl/src/pixelflow/texture_memory.rs:176
    wire [20:0] odd_line1_plus_odd_column1 = odd_line1 + odd_column1; // rtl/src/pixelflow/texture_memory.rs:176
    wire [3:0] bank7_read_address = base + odd_line1_plus_odd_column1[3:0]; // rtl/src/pixelflow/texture_memory.rs:176
    wire [2:0] from_joined = {coarser_level[0], coarser_below[0], coarser_left[0]}; // rtl/src/pixelflow/texture_memory.rs:198
    wire [2:0] from_joined_2 = {coarser_level[0], coarser_below[0], coarser_right[0]}; // rtl/src/pixelflow/texture_memory.rs:198
    wire [2:0] from_joined_3 = {coarser_level[0], coarser_above[0], coarser_left[0]}; // rtl/src/pixelflow/texture_memory.rs:198
    wire [2:0] from_joined_4 = {coarser_level[0], coarser_above[0], coarser_right[0]}; // rtl/src/pixelflow/texture_memory.rs:198
    wire [2:0] from_joined_5 = {finer_level[0], finer_below[0], finer_left[0]}; // rtl/src/pixelflow/texture_memory.rs:198
    wire [2:0] from_joined_6 = {finer_level[0], finer_below[0], finer_right[0]}; // rtl/src/pixelflow/texture_memory.rs:198
    wire [2:0] from_joined_7 = {finer_level[0], finer_above[0], finer_left[0]}; // rtl/src/pixelflow/texture_memory.rs:198
    wire [2:0] from_joined_8 = {finer_level[0], finer_above[0], finer_right[0]}; // rtl/src/pixelflow/texture_memory.rs:198

    genvar i;
    genvar j;

    localparam [230:0] even_line0_listed_row_even_line0_listed = {
        21'h004445, 21'h001111, 21'h000445, 21'h000111, 21'h000045, 21'h000011, 21'h000005,
        21'h000001, 21'h000001, 21'h000000, 21'h000000
    };
    generate
        for (i = 0; i < 11; i = i + 1) begin : even_line0_listed_row
            wire [20:0] even_line0_listed = even_line0_listed_row_even_line0_listed[i * 21 +: 21];
        end
    endgenerate

    generate
        for (i = 0; i < 8; i = i + 1) begin : texels_listed_row
            wire [23:0] texels_listed;
            case (i)
                0: begin : texels_listed_0 assign texels_listed = bank0_read; end
                1: begin : texels_listed_1 assign texels_listed = bank1_read; end
                2: begin : texels_listed_2 assign texels_listed = bank2_read; end
                3: begin : texels_listed_3 assign texels_listed = bank3_read; end
                4: begin : texels_listed_4 assign texels_listed = bank4_read; end
                5: begin : texels_listed_5 assign texels_listed = bank5_read; end
                6: begin : texels_listed_6 assign texels_listed = bank6_read; end
                default: begin : texels_listed_7 assign texels_listed = bank7_read; end
            endcase
        end
    endgenerate

    generate
        for (i = 0; i < 8; i = i + 1) begin : from_row
            reg [2:0] from;
            wire [2:0] from_next;
            case (i)
                0: begin : from_next_0 assign from_next = from_joined; end
                1: begin : from_next_1 assign from_next = from_joined_2; end
                2: begin : from_next_2 assign from_next = from_joined_3; end
                3: begin : from_next_3 assign from_next = from_joined_4; end
                4: begin : from_next_4 assign from_next = from_joined_5; end
                5: begin : from_next_5 assign from_next = from_joined_6; end
                6: begin : from_next_6 assign from_next = from_joined_7; end
                default: begin : from_next_7 assign from_next = from_joined_8; end
            endcase
            wire [23:0] texels_picked;
            wire [23:0] texels_picked_lanes [0:7];
            for (j = 0; j < 8; j = j + 1) begin : texels_picked_of
                assign texels_picked_lanes[j] = texels_listed_row[j].texels_listed;
            end
            assign texels_picked = texels_picked_lanes[from];

            always @(posedge clk) begin
                from <= from_next;
            end
        end
    endgenerate

    wire [20:0] even_line0_picked_lanes [0:10];
    generate
        for (i = 0; i < 11; i = i + 1) begin : even_line0_picked_of
            assign even_line0_picked_lanes[i] = even_line0_listed_row[i].even_line0_listed;
        end
    endgenerate
    assign even_line0_picked = (even_level < 4'd11) ? even_line0_picked_lanes[even_level] : 21'd0; // rtl/src/pixelflow/texture_memory.rs:166
    wire [20:0] odd_line0_picked_lanes [0:10];
    generate
        for (i = 0; i < 11; i = i + 1) begin : odd_line0_picked_of
            assign odd_line0_picked_lanes[i] = even_line0_listed_row[i].even_line0_listed;
        end
    endgenerate
    assign odd_line0_picked = (odd_level < 4'd11) ? odd_line0_picked_lanes[odd_level] : 21'd0; // rtl/src/pixelflow/texture_memory.rs:166
    generate
        for (i = 0; i < 8; i = i + 1) begin : texels_of
            assign texels[i * 24 +: 24] = from_row[i].texels_picked;
        end
    endgenerate

    always @(posedge clk) begin
        if (describe_valid) bases[describe_texture] <= describe_base;
        bases_read <= bases[request_texture[0]];
    end

    always @(posedge clk) begin
        if (describe_valid) finests[describe_texture] <= describe_finest;
        finests_read <= finests[request_texture[0]];
    end

    always @(posedge clk) begin
        if (write_valid & (write_bank == 3'd0)) bank0[write_address] <= write_texel;
        bank0_read <= bank0[bank0_read_address];
    end

    always @(posedge clk) begin
        if (write_valid & (write_bank == 3'd1)) bank1[write_address] <= write_texel;
        bank1_read <= bank1[bank1_read_address];
    end

    always @(posedge clk) begin
        if (write_valid & (write_bank == 3'd2)) bank2[write_address] <= write_texel;
        bank2_read <= bank2[bank2_read_address];
    end

    always @(posedge clk) begin
        if (write_valid & (write_bank == 3'd3)) bank3[write_address] <= write_texel;
        bank3_read <= bank3[bank3_read_address];
    end

    always @(posedge clk) begin
        if (write_valid & (write_bank == 3'd4)) bank4[write_address] <= write_texel;
        bank4_read <= bank4[bank4_read_address];
    end

    always @(posedge clk) begin
        if (write_valid & (write_bank == 3'd5)) bank5[write_address] <= write_texel;
        bank5_read <= bank5[bank5_read_address];
    end

    always @(posedge clk) begin
        if (write_valid & (write_bank == 3'd6)) bank6[write_address] <= write_texel;
        bank6_read <= bank6[bank6_read_address];
    end

    always @(posedge clk) begin
        if (write_valid & (write_bank == 3'd7)) bank7[write_address] <= write_texel;
        bank7_read <= bank7[bank7_read_address];
    end

    always @(posedge clk) begin
        u <= request_u;
        v <= request_v;
        level <= request_level;
        base <= bases_read;
        coarser_level <= coarser_level_next;
        coarser_left <= coarser_left_next;
        coarser_right <= (coarser_left_next + 10'd1) & coarser_left_difference_2[9:0];
        coarser_below <= coarser_below_next;
        coarser_above <= (coarser_below_next + 10'd1) & coarser_below_difference_2[9:0];
        finer_level <= finer_level_next;
        finer_left <= finer_left_next;
        finer_right <= (finer_left_next + 10'd1) & finer_left_difference_2[9:0];
        finer_below <= finer_below_next;
        finer_above <= (finer_below_next + 10'd1) & finer_below_difference_2[9:0];
    end

    always @(posedge clk) begin
        if (rst) begin
            valid1 <= 1'b0;
            valid2 <= 1'b0;
            valid3 <= 1'b0;
        end else begin
            valid1 <= request_valid;
            valid2 <= valid1;
            valid3 <= valid2;
        end
    end

    assign valid = valid3;

    wire _unused_ok = &{1'b0, request_texture[7:1], coarser_left_shifted[7:0],
            coarser_left_difference[25:18], coarser_left_difference[7:0],
            coarser_left_difference_2[10], coarser_below_shifted[7:0],
            coarser_below_difference[25:18], coarser_below_difference[7:0],
            coarser_below_difference_2[10], finer_left_shifted[7:0],
            finer_left_difference[25:18], finer_left_difference[7:0],
            finer_left_difference_2[10], finer_below_shifted[7:0],
            finer_below_difference[25:18], finer_below_difference[7:0],
            finer_below_difference_2[10], even_line0_choice[0], even_line0_shifted[0],
            even_line1_choice[0], even_line1_shifted[0], even_column0_choice[0],
            even_column1_choice[0], even_line0_plus_even_column0[20:4],
            even_line0_plus_even_column1[20:4], even_line1_plus_even_column0[20:4],
            even_line1_plus_even_column1[20:4], odd_line0_choice[0], odd_line0_shifted[0],
            odd_line1_choice[0], odd_line1_shifted[0], odd_column0_choice[0],
            odd_column1_choice[0], odd_line0_plus_odd_column0[20:4],
            odd_line0_plus_odd_column1[20:4], odd_line1_plus_odd_column0[20:4],
            odd_line1_plus_odd_column1[20:4]};
endmodule
`default_nettype wire
