// texture_memory_texels16_textures2
//
// Reads the texels around a place.
//
// Parameters  TextureMemory { texels: 16, textures: 2 }
// Latency     3 clocks, a place a clock
// Source      Reducing Latency on PixelFlow, section 4 (PFL-SHADE)
// Described   rtl/src/pixelflow/texture_memory.rs:135
`default_nettype none

module texture_memory_texels16_textures2 (
    input  wire         clk,
    input  wire         rst,
    // What the geometry processors write.
    input  wire         write_valid,      // There is one.
    input  wire [2:0]   write_bank,       // Its bank: the parity of the level, then of the row, then of the column.
    input  wire [3:0]   write_address,    // Its address there.
    input  wire [23:0]  write_texel,      // Red in the lowest byte, then green, then blue.
    // Where they say that a texture is.
    input  wire         describe_valid,   // It is said.
    input  wire         describe_texture, // Of which.
    input  wire [3:0]   describe_base,    // Its first address in each bank.
    input  wire [3:0]   describe_finest,  // Its finest level.
    // What is sought.
    input  wire         request_valid,    // There is one.
    input  wire [15:0]  request_u,        // From the left, in 1/2^16 of the texture.
    input  wire [15:0]  request_v,        // From below, likewise.
    input  wire [7:0]   request_level,    // The coarser level.
    input  wire [7:0]   request_texture,  // The texture.
    output wire         valid,            // There are texels.
    // Texel 4 s + 2 y + x is on level `level + s`, and to the left or, with x, to the right, below or, with y, above.
    output wire [191:0] texels
);

    reg valid1;                                                  // rtl/src/pixelflow/texture_memory.rs:135
    reg valid2;                                                  // rtl/src/pixelflow/texture_memory.rs:135
    reg valid3;                                                  // rtl/src/pixelflow/texture_memory.rs:135
    reg [15:0] u;                                                // rtl/src/pixelflow/texture_memory.rs:147
    reg [15:0] v;                                                // rtl/src/pixelflow/texture_memory.rs:147
    reg [7:0] level;                                             // rtl/src/pixelflow/texture_memory.rs:148
    reg [3:0] base;                                              // rtl/src/pixelflow/texture_memory.rs:151
    reg [9:0] u0_low;                                            // rtl/src/pixelflow/texture_memory.rs:223
    reg [9:0] u0_high;                                           // rtl/src/pixelflow/texture_memory.rs:223
    reg [9:0] v0_low;                                            // rtl/src/pixelflow/texture_memory.rs:223
    reg [9:0] v0_high;                                           // rtl/src/pixelflow/texture_memory.rs:223
    reg [3:0] level0;                                            // rtl/src/pixelflow/texture_memory.rs:156
    reg [9:0] u1_low;                                            // rtl/src/pixelflow/texture_memory.rs:223
    reg [9:0] u1_high;                                           // rtl/src/pixelflow/texture_memory.rs:223
    reg [9:0] v1_low;                                            // rtl/src/pixelflow/texture_memory.rs:223
    reg [9:0] v1_high;                                           // rtl/src/pixelflow/texture_memory.rs:223
    reg [3:0] level1;                                            // rtl/src/pixelflow/texture_memory.rs:156
    reg [2:0] from0;                                             // rtl/src/pixelflow/texture_memory.rs:175
    reg [2:0] from1;                                             // rtl/src/pixelflow/texture_memory.rs:175
    reg [2:0] from2;                                             // rtl/src/pixelflow/texture_memory.rs:175
    reg [2:0] from3;                                             // rtl/src/pixelflow/texture_memory.rs:175
    reg [2:0] from4;                                             // rtl/src/pixelflow/texture_memory.rs:175
    reg [2:0] from5;                                             // rtl/src/pixelflow/texture_memory.rs:175
    reg [2:0] from6;                                             // rtl/src/pixelflow/texture_memory.rs:175
    reg [2:0] from7;                                             // rtl/src/pixelflow/texture_memory.rs:175

    reg [3:0] bases [0:1];                                       // rtl/src/pixelflow/texture_memory.rs:143
    reg [3:0] bases_read;                                        // rtl/src/pixelflow/texture_memory.rs:145
    reg [3:0] finests [0:1];                                     // rtl/src/pixelflow/texture_memory.rs:143
    reg [3:0] finests_read;                                      // rtl/src/pixelflow/texture_memory.rs:145
    reg [23:0] bank0 [0:15];                                     // rtl/src/pixelflow/texture_memory.rs:162
    reg [23:0] bank0_read;                                       // rtl/src/pixelflow/texture_memory.rs:164
    reg [23:0] bank1 [0:15];                                     // rtl/src/pixelflow/texture_memory.rs:162
    reg [23:0] bank1_read;                                       // rtl/src/pixelflow/texture_memory.rs:164
    reg [23:0] bank2 [0:15];                                     // rtl/src/pixelflow/texture_memory.rs:162
    reg [23:0] bank2_read;                                       // rtl/src/pixelflow/texture_memory.rs:164
    reg [23:0] bank3 [0:15];                                     // rtl/src/pixelflow/texture_memory.rs:162
    reg [23:0] bank3_read;                                       // rtl/src/pixelflow/texture_memory.rs:164
    reg [23:0] bank4 [0:15];                                     // rtl/src/pixelflow/texture_memory.rs:162
    reg [23:0] bank4_read;                                       // rtl/src/pixelflow/texture_memory.rs:164
    reg [23:0] bank5 [0:15];                                     // rtl/src/pixelflow/texture_memory.rs:162
    reg [23:0] bank5_read;                                       // rtl/src/pixelflow/texture_memory.rs:164
    reg [23:0] bank6 [0:15];                                     // rtl/src/pixelflow/texture_memory.rs:162
    reg [23:0] bank6_read;                                       // rtl/src/pixelflow/texture_memory.rs:164
    reg [23:0] bank7 [0:15];                                     // rtl/src/pixelflow/texture_memory.rs:162
    reg [23:0] bank7_read;                                       // rtl/src/pixelflow/texture_memory.rs:164

    wire [20:0] bank0_read_picked;                               // rtl/src/pixelflow/texture_memory.rs:197
    wire [20:0] bank1_read_picked;                               // rtl/src/pixelflow/texture_memory.rs:197
    wire [20:0] bank2_read_picked;                               // rtl/src/pixelflow/texture_memory.rs:197
    wire [20:0] bank3_read_picked;                               // rtl/src/pixelflow/texture_memory.rs:197
    wire [20:0] bank4_read_picked;                               // rtl/src/pixelflow/texture_memory.rs:197
    wire [20:0] bank5_read_picked;                               // rtl/src/pixelflow/texture_memory.rs:197
    wire [20:0] bank6_read_picked;                               // rtl/src/pixelflow/texture_memory.rs:197
    wire [20:0] bank7_read_picked;                               // rtl/src/pixelflow/texture_memory.rs:197
    wire [23:0] texels_picked_8;                                 // rtl/src/pixelflow/texture_memory.rs:175
    wire [23:0] texels_picked_7;                                 // rtl/src/pixelflow/texture_memory.rs:175
    wire [23:0] texels_picked_6;                                 // rtl/src/pixelflow/texture_memory.rs:175
    wire [23:0] texels_picked_5;                                 // rtl/src/pixelflow/texture_memory.rs:175
    wire [23:0] texels_picked_4;                                 // rtl/src/pixelflow/texture_memory.rs:175
    wire [23:0] texels_picked_3;                                 // rtl/src/pixelflow/texture_memory.rs:175
    wire [23:0] texels_picked_2;                                 // rtl/src/pixelflow/texture_memory.rs:175
    wire [23:0] texels_picked;                                   // rtl/src/pixelflow/texture_memory.rs:175
    wire [3:0] u0_low_choice = ({1'd0, level} < {5'd0, finests_read}) ? level[3:0] : finests_read; // rtl/src/pixelflow/texture_memory.rs:154
    wire [25:0] u0_low_shifted = {10'd0, u} << u0_low_choice;    // rtl/src/pixelflow/texture_memory.rs:218
    wire [25:0] u0_low_difference = {8'd0, u0_low_shifted[25:8]} - 26'd128; // rtl/src/pixelflow/texture_memory.rs:218
    wire [10:0] u0_low_difference_2 = (11'd1 << u0_low_choice) - 11'd1; // rtl/src/pixelflow/texture_memory.rs:219
    wire [9:0] u0_low_next = u0_low_difference[17:8] & u0_low_difference_2[9:0]; // rtl/src/pixelflow/texture_memory.rs:221
    wire [25:0] v0_low_shifted = {10'd0, v} << u0_low_choice;    // rtl/src/pixelflow/texture_memory.rs:218
    wire [25:0] v0_low_difference = {8'd0, v0_low_shifted[25:8]} - 26'd128; // rtl/src/pixelflow/texture_memory.rs:218
    wire [10:0] v0_low_difference_2 = (11'd1 << u0_low_choice) - 11'd1; // rtl/src/pixelflow/texture_memory.rs:219
    wire [9:0] v0_low_next = v0_low_difference[17:8] & v0_low_difference_2[9:0]; // rtl/src/pixelflow/texture_memory.rs:221
    wire [8:0] u1_low_sum = {1'd0, level} + 9'd1;                // rtl/src/pixelflow/texture_memory.rs:153
    wire u1_low_less = u1_low_sum < {5'd0, finests_read};        // rtl/src/pixelflow/texture_memory.rs:154
    wire [3:0] u1_low_choice = u1_low_less ? u1_low_sum[3:0] : finests_read; // rtl/src/pixelflow/texture_memory.rs:154
    wire [25:0] u1_low_shifted = {10'd0, u} << u1_low_choice;    // rtl/src/pixelflow/texture_memory.rs:218
    wire [25:0] u1_low_difference = {8'd0, u1_low_shifted[25:8]} - 26'd128; // rtl/src/pixelflow/texture_memory.rs:218
    wire [10:0] u1_low_difference_2 = (11'd1 << u1_low_choice) - 11'd1; // rtl/src/pixelflow/texture_memory.rs:219
    wire [9:0] u1_low_next = u1_low_difference[17:8] & u1_low_difference_2[9:0]; // rtl/src/pixelflow/texture_memory.rs:221
    wire [25:0] v1_low_shifted = {10'd0, v} << u1_low_choice;    // rtl/src/pixelflow/texture_memory.rs:218
    wire [25:0] v1_low_difference = {8'd0, v1_low_shifted[25:8]} - 26'd128; // rtl/src/pixelflow/texture_memory.rs:218
    wire [10:0] v1_low_difference_2 = (11'd1 << u1_low_choice) - 11'd1; // rtl/src/pixelflow/texture_memory.rs:219
    wire [9:0] v1_low_next = v1_low_difference[17:8] & v1_low_difference_2[9:0]; // rtl/src/pixelflow/texture_memory.rs:221
    wire bank0_read_inverse = !level0[0];                        // rtl/src/pixelflow/texture_memory.rs:183
    wire [3:0] bank0_read_choice = bank0_read_inverse ? level0 : level1; // rtl/src/pixelflow/texture_memory.rs:184
    wire [9:0] bank0_read_choice_6 = !u0_low[0] ? u0_low : u0_high; // rtl/src/pixelflow/texture_memory.rs:188
    wire [9:0] bank0_read_choice_7 = !u1_low[0] ? u1_low : u1_high; // rtl/src/pixelflow/texture_memory.rs:188
    wire [9:0] bank0_read_choice_5 = bank0_read_inverse ? bank0_read_choice_6 : bank0_read_choice_7; // rtl/src/pixelflow/texture_memory.rs:190
    wire [9:0] bank0_read_choice_3 = !v0_low[0] ? v0_low : v0_high; // rtl/src/pixelflow/texture_memory.rs:188
    wire [9:0] bank0_read_choice_4 = !v1_low[0] ? v1_low : v1_high; // rtl/src/pixelflow/texture_memory.rs:188
    wire [9:0] bank0_read_choice_2 = bank0_read_inverse ? bank0_read_choice_3 : bank0_read_choice_4; // rtl/src/pixelflow/texture_memory.rs:190
    wire [20:0] bank0_read_shifted = {11'd0, {1'd0, bank0_read_choice_2[9:1]}} << bank0_read_choice; // rtl/src/pixelflow/texture_memory.rs:196
    wire [20:0] bank0_read_sum_2 = bank0_read_picked + {1'd0, bank0_read_shifted[20:1]}; // rtl/src/pixelflow/texture_memory.rs:197
    wire [20:0] bank0_read_sum = bank0_read_sum_2 + {11'd0, {1'd0, bank0_read_choice_5[9:1]}}; // rtl/src/pixelflow/texture_memory.rs:197
    wire [3:0] bank0_read_address = base + bank0_read_sum[3:0];  // rtl/src/pixelflow/texture_memory.rs:198
    wire bank1_read_inverse = !level0[0];                        // rtl/src/pixelflow/texture_memory.rs:183
    wire [3:0] bank1_read_choice = bank1_read_inverse ? level0 : level1; // rtl/src/pixelflow/texture_memory.rs:184
    wire [9:0] bank1_read_choice_6 = u1_low[0] ? u1_low : u1_high; // rtl/src/pixelflow/texture_memory.rs:188
    wire [9:0] bank1_read_choice_5 = bank1_read_inverse ? (u0_low[0] ? u0_low : u0_high) : bank1_read_choice_6; // rtl/src/pixelflow/texture_memory.rs:190
    wire [9:0] bank1_read_choice_3 = !v0_low[0] ? v0_low : v0_high; // rtl/src/pixelflow/texture_memory.rs:188
    wire [9:0] bank1_read_choice_4 = !v1_low[0] ? v1_low : v1_high; // rtl/src/pixelflow/texture_memory.rs:188
    wire [9:0] bank1_read_choice_2 = bank1_read_inverse ? bank1_read_choice_3 : bank1_read_choice_4; // rtl/src/pixelflow/texture_memory.rs:190
    wire [20:0] bank1_read_shifted = {11'd0, {1'd0, bank1_read_choice_2[9:1]}} << bank1_read_choice; // rtl/src/pixelflow/texture_memory.rs:196
    wire [20:0] bank1_read_sum_2 = bank1_read_picked + {1'd0, bank1_read_shifted[20:1]}; // rtl/src/pixelflow/texture_memory.rs:197
    wire [20:0] bank1_read_sum = bank1_read_sum_2 + {11'd0, {1'd0, bank1_read_choice_5[9:1]}}; // rtl/src/pixelflow/texture_memory.rs:197
    wire [3:0] bank1_read_address = base + bank1_read_sum[3:0];  // rtl/src/pixelflow/texture_memory.rs:198
    wire bank2_read_inverse = !level0[0];                        // rtl/src/pixelflow/texture_memory.rs:183
    wire [3:0] bank2_read_choice = bank2_read_inverse ? level0 : level1; // rtl/src/pixelflow/texture_memory.rs:184
    wire [9:0] bank2_read_choice_5 = !u0_low[0] ? u0_low : u0_high; // rtl/src/pixelflow/texture_memory.rs:188
    wire [9:0] bank2_read_choice_6 = !u1_low[0] ? u1_low : u1_high; // rtl/src/pixelflow/texture_memory.rs:188
    wire [9:0] bank2_read_choice_4 = bank2_read_inverse ? bank2_read_choice_5 : bank2_read_choice_6; // rtl/src/pixelflow/texture_memory.rs:190
    wire [9:0] bank2_read_choice_3 = v1_low[0] ? v1_low : v1_high; // rtl/src/pixelflow/texture_memory.rs:188
    wire [9:0] bank2_read_choice_2 = bank2_read_inverse ? (v0_low[0] ? v0_low : v0_high) : bank2_read_choice_3; // rtl/src/pixelflow/texture_memory.rs:190
    wire [20:0] bank2_read_shifted = {11'd0, {1'd0, bank2_read_choice_2[9:1]}} << bank2_read_choice; // rtl/src/pixelflow/texture_memory.rs:196
    wire [20:0] bank2_read_sum_2 = bank2_read_picked + {1'd0, bank2_read_shifted[20:1]}; // rtl/src/pixelflow/texture_memory.rs:197
    wire [20:0] bank2_read_sum = bank2_read_sum_2 + {11'd0, {1'd0, bank2_read_choice_4[9:1]}}; // rtl/src/pixelflow/texture_memory.rs:197
    wire [3:0] bank2_read_address = base + bank2_read_sum[3:0];  // rtl/src/pixelflow/texture_memory.rs:198
    wire bank3_read_inverse = !level0[0];                        // rtl/src/pixelflow/texture_memory.rs:183
    wire [3:0] bank3_read_choice = bank3_read_inverse ? level0 : level1; // rtl/src/pixelflow/texture_memory.rs:184
    wire [9:0] bank3_read_choice_5 = u1_low[0] ? u1_low : u1_high; // rtl/src/pixelflow/texture_memory.rs:188
    wire [9:0] bank3_read_choice_4 = bank3_read_inverse ? (u0_low[0] ? u0_low : u0_high) : bank3_read_choice_5; // rtl/src/pixelflow/texture_memory.rs:190
    wire [9:0] bank3_read_choice_3 = v1_low[0] ? v1_low : v1_high; // rtl/src/pixelflow/texture_memory.rs:188
    wire [9:0] bank3_read_choice_2 = bank3_read_inverse ? (v0_low[0] ? v0_low : v0_high) : bank3_read_choice_3; // rtl/src/pixelflow/texture_memory.rs:190
    wire [20:0] bank3_read_shifted = {11'd0, {1'd0, bank3_read_choice_2[9:1]}} << bank3_read_choice; // rtl/src/pixelflow/texture_memory.rs:196
    wire [20:0] bank3_read_sum_2 = bank3_read_picked + {1'd0, bank3_read_shifted[20:1]}; // rtl/src/pixelflow/texture_memory.rs:197
    wire [20:0] bank3_read_sum = bank3_read_sum_2 + {11'd0, {1'd0, bank3_read_choice_4[9:1]}}; // rtl/src/pixelflow/texture_memory.rs:197
    wire [3:0] bank3_read_address = base + bank3_read_sum[3:0];  // rtl/src/pixelflow/texture_memory.rs:198
    wire [3:0] bank4_read_choice = level0[0] ? level0 : level1;  // rtl/src/pixelflow/texture_memory.rs:184
    wire [9:0] bank4_read_choice_5 = !u1_low[0] ? u1_low : u1_high; // rtl/src/pixelflow/texture_memory.rs:188
    wire [9:0] bank4_read_choice_4 = level0[0] ? (!u0_low[0] ? u0_low : u0_high) : bank4_read_choice_5; // rtl/src/pixelflow/texture_memory.rs:190
    wire [9:0] bank4_read_choice_3 = !v1_low[0] ? v1_low : v1_high; // rtl/src/pixelflow/texture_memory.rs:188
    wire [9:0] bank4_read_choice_2 = level0[0] ? (!v0_low[0] ? v0_low : v0_high) : bank4_read_choice_3; // rtl/src/pixelflow/texture_memory.rs:190
    wire [20:0] bank4_read_shifted = {11'd0, {1'd0, bank4_read_choice_2[9:1]}} << bank4_read_choice; // rtl/src/pixelflow/texture_memory.rs:196
    wire [20:0] bank4_read_sum_2 = bank4_read_picked + {1'd0, bank4_read_shifted[20:1]}; // rtl/src/pixelflow/texture_memory.rs:197
    wire [20:0] bank4_read_sum = bank4_read_sum_2 + {11'd0, {1'd0, bank4_read_choice_4[9:1]}}; // rtl/src/pixelflow/texture_memory.rs:197
    wire [3:0] bank4_read_address = base + bank4_read_sum[3:0];  // rtl/src/pixelflow/texture_memory.rs:198
    wire [3:0] bank5_read_choice = level0[0] ? level0 : level1;  // rtl/src/pixelflow/texture_memory.rs:184
    wire [9:0] bank5_read_choice_5 = u1_low[0] ? u1_low : u1_high; // rtl/src/pixelflow/texture_memory.rs:188
    wire [9:0] bank5_read_choice_4 = level0[0] ? (u0_low[0] ? u0_low : u0_high) : bank5_read_choice_5; // rtl/src/pixelflow/texture_memory.rs:190
    wire [9:0] bank5_read_choice_3 = !v1_low[0] ? v1_low : v1_high; // rtl/src/pixelflow/texture_memory.rs:188
    wire [9:0] bank5_read_choice_2 = level0[0] ? (!v0_low[0] ? v0_low : v0_high) : bank5_read_choice_3; // rtl/src/pixelflow/texture_memory.rs:190
    wire [20:0] bank5_read_shifted = {11'd0, {1'd0, bank5_read_choice_2[9:1]}} << bank5_read_choice; // rtl/src/pixelflow/texture_memory.rs:196
    wire [20:0] bank5_read_sum_2 = bank5_read_picked + {1'd0, bank5_read_shifted[20:1]}; // rtl/src/pixelflow/texture_memory.rs:197
    wire [20:0] bank5_read_sum = bank5_read_sum_2 + {11'd0, {1'd0, bank5_read_choice_4[9:1]}}; // rtl/src/pixelflow/texture_memory.rs:197
    wire [3:0] bank5_read_address = base + bank5_read_sum[3:0];  // rtl/src/pixelflow/texture_memory.rs:198
    wire [3:0] bank6_read_choice = level0[0] ? level0 : level1;  // rtl/src/pixelflow/texture_memory.rs:184
    wire [9:0] bank6_read_choice_5 = !u1_low[0] ? u1_low : u1_high; // rtl/src/pixelflow/texture_memory.rs:188
    wire [9:0] bank6_read_choice_4 = level0[0] ? (!u0_low[0] ? u0_low : u0_high) : bank6_read_choice_5; // rtl/src/pixelflow/texture_memory.rs:190
    wire [9:0] bank6_read_choice_3 = v1_low[0] ? v1_low : v1_high; // rtl/src/pixelflow/texture_memory.rs:188
    wire [9:0] bank6_read_choice_2 = level0[0] ? (v0_low[0] ? v0_low : v0_high) : bank6_read_choice_3; // rtl/src/pixelflow/texture_memory.rs:190
    wire [20:0] bank6_read_shifted = {11'd0, {1'd0, bank6_read_choice_2[9:1]}} << bank6_read_choice; // rtl/src/pixelflow/texture_memory.rs:196
    wire [20:0] bank6_read_sum_2 = bank6_read_picked + {1'd0, bank6_read_shifted[20:1]}; // rtl/src/pixelflow/texture_memory.rs:197
    wire [20:0] bank6_read_sum = bank6_read_sum_2 + {11'd0, {1'd0, bank6_read_choice_4[9:1]}}; // rtl/src/pixelflow/texture_memory.rs:197
    wire [3:0] bank6_read_address = base + bank6_read_sum[3:0];  // rtl/src/pixelflow/texture_memory.rs:198
    wire [3:0] bank7_read_choice = level0[0] ? level0 : level1;  // rtl/src/pixelflow/texture_memory.rs:184
    wire [9:0] bank7_read_choice_5 = u1_low[0] ? u1_low : u1_high; // rtl/src/pixelflow/texture_memory.rs:188
    wire [9:0] bank7_read_choice_4 = level0[0] ? (u0_low[0] ? u0_low : u0_high) : bank7_read_choice_5; // rtl/src/pixelflow/texture_memory.rs:190
    wire [9:0] bank7_read_choice_3 = v1_low[0] ? v1_low : v1_high; // rtl/src/pixelflow/texture_memory.rs:188
    wire [9:0] bank7_read_choice_2 = level0[0] ? (v0_low[0] ? v0_low : v0_high) : bank7_read_choice_3; // rtl/src/pixelflow/texture_memory.rs:190
    wire [20:0] bank7_read_shifted = {11'd0, {1'd0, bank7_read_choice_2[9:1]}} << bank7_read_choice; // rtl/src/pixelflow/texture_memory.rs:196
    wire [20:0] bank7_read_sum_2 = bank7_read_picked + {1'd0, bank7_read_shifted[20:1]}; // rtl/src/pixelflow/texture_memory.rs:197
    wire [20:0] bank7_read_sum = bank7_read_sum_2 + {11'd0, {1'd0, bank7_read_choice_4[9:1]}}; // rtl/src/pixelflow/texture_memory.rs:197
    wire [3:0] bank7_read_address = base + bank7_read_sum[3:0];  // rtl/src/pixelflow/texture_memory.rs:198
    assign texels = {texels_picked, texels_picked_2, texels_picked_3, texels_picked_4, texels_picked_5, texels_picked_6, texels_picked_7, texels_picked_8}; // rtl/src/pixelflow/texture_memory.rs:177

    genvar i;

    localparam [230:0] bank0_read_listed_row_bank0_read_listed = {
        21'h004445, 21'h001111, 21'h000445, 21'h000111, 21'h000045, 21'h000011, 21'h000005,
        21'h000001, 21'h000001, 21'h000000, 21'h000000
    };
    generate
        for (i = 0; i < 11; i = i + 1) begin : bank0_read_listed_row
            wire [20:0] bank0_read_listed = bank0_read_listed_row_bank0_read_listed[i * 21 +: 21];
        end
    endgenerate

    localparam [230:0] bank1_read_listed_row_bank1_read_listed = {
        21'h004445, 21'h001111, 21'h000445, 21'h000111, 21'h000045, 21'h000011, 21'h000005,
        21'h000001, 21'h000001, 21'h000000, 21'h000000
    };
    generate
        for (i = 0; i < 11; i = i + 1) begin : bank1_read_listed_row
            wire [20:0] bank1_read_listed = bank1_read_listed_row_bank1_read_listed[i * 21 +: 21];
        end
    endgenerate

    localparam [230:0] bank2_read_listed_row_bank2_read_listed = {
        21'h004445, 21'h001111, 21'h000445, 21'h000111, 21'h000045, 21'h000011, 21'h000005,
        21'h000001, 21'h000001, 21'h000000, 21'h000000
    };
    generate
        for (i = 0; i < 11; i = i + 1) begin : bank2_read_listed_row
            wire [20:0] bank2_read_listed = bank2_read_listed_row_bank2_read_listed[i * 21 +: 21];
        end
    endgenerate

    localparam [230:0] bank3_read_listed_row_bank3_read_listed = {
        21'h004445, 21'h001111, 21'h000445, 21'h000111, 21'h000045, 21'h000011, 21'h000005,
        21'h000001, 21'h000001, 21'h000000, 21'h000000
    };
    generate
        for (i = 0; i < 11; i = i + 1) begin : bank3_read_listed_row
            wire [20:0] bank3_read_listed = bank3_read_listed_row_bank3_read_listed[i * 21 +: 21];
        end
    endgenerate

    localparam [230:0] bank4_read_listed_row_bank4_read_listed = {
        21'h004445, 21'h001111, 21'h000445, 21'h000111, 21'h000045, 21'h000011, 21'h000005,
        21'h000001, 21'h000001, 21'h000000, 21'h000000
    };
    generate
        for (i = 0; i < 11; i = i + 1) begin : bank4_read_listed_row
            wire [20:0] bank4_read_listed = bank4_read_listed_row_bank4_read_listed[i * 21 +: 21];
        end
    endgenerate

    localparam [230:0] bank5_read_listed_row_bank5_read_listed = {
        21'h004445, 21'h001111, 21'h000445, 21'h000111, 21'h000045, 21'h000011, 21'h000005,
        21'h000001, 21'h000001, 21'h000000, 21'h000000
    };
    generate
        for (i = 0; i < 11; i = i + 1) begin : bank5_read_listed_row
            wire [20:0] bank5_read_listed = bank5_read_listed_row_bank5_read_listed[i * 21 +: 21];
        end
    endgenerate

    localparam [230:0] bank6_read_listed_row_bank6_read_listed = {
        21'h004445, 21'h001111, 21'h000445, 21'h000111, 21'h000045, 21'h000011, 21'h000005,
        21'h000001, 21'h000001, 21'h000000, 21'h000000
    };
    generate
        for (i = 0; i < 11; i = i + 1) begin : bank6_read_listed_row
            wire [20:0] bank6_read_listed = bank6_read_listed_row_bank6_read_listed[i * 21 +: 21];
        end
    endgenerate

    localparam [230:0] bank7_read_listed_row_bank7_read_listed = {
        21'h004445, 21'h001111, 21'h000445, 21'h000111, 21'h000045, 21'h000011, 21'h000005,
        21'h000001, 21'h000001, 21'h000000, 21'h000000
    };
    generate
        for (i = 0; i < 11; i = i + 1) begin : bank7_read_listed_row
            wire [20:0] bank7_read_listed = bank7_read_listed_row_bank7_read_listed[i * 21 +: 21];
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

    wire [20:0] bank0_read_picked_lanes [0:10];
    generate
        for (i = 0; i < 11; i = i + 1) begin : bank0_read_picked_of
            assign bank0_read_picked_lanes[i] = bank0_read_listed_row[i].bank0_read_listed;
        end
    endgenerate
    assign bank0_read_picked = (bank0_read_choice < 4'd11) ? bank0_read_picked_lanes[bank0_read_choice] : 21'd0; // rtl/src/pixelflow/texture_memory.rs:197
    wire [20:0] bank1_read_picked_lanes [0:10];
    generate
        for (i = 0; i < 11; i = i + 1) begin : bank1_read_picked_of
            assign bank1_read_picked_lanes[i] = bank1_read_listed_row[i].bank1_read_listed;
        end
    endgenerate
    assign bank1_read_picked = (bank1_read_choice < 4'd11) ? bank1_read_picked_lanes[bank1_read_choice] : 21'd0; // rtl/src/pixelflow/texture_memory.rs:197
    wire [20:0] bank2_read_picked_lanes [0:10];
    generate
        for (i = 0; i < 11; i = i + 1) begin : bank2_read_picked_of
            assign bank2_read_picked_lanes[i] = bank2_read_listed_row[i].bank2_read_listed;
        end
    endgenerate
    assign bank2_read_picked = (bank2_read_choice < 4'd11) ? bank2_read_picked_lanes[bank2_read_choice] : 21'd0; // rtl/src/pixelflow/texture_memory.rs:197
    wire [20:0] bank3_read_picked_lanes [0:10];
    generate
        for (i = 0; i < 11; i = i + 1) begin : bank3_read_picked_of
            assign bank3_read_picked_lanes[i] = bank3_read_listed_row[i].bank3_read_listed;
        end
    endgenerate
    assign bank3_read_picked = (bank3_read_choice < 4'd11) ? bank3_read_picked_lanes[bank3_read_choice] : 21'd0; // rtl/src/pixelflow/texture_memory.rs:197
    wire [20:0] bank4_read_picked_lanes [0:10];
    generate
        for (i = 0; i < 11; i = i + 1) begin : bank4_read_picked_of
            assign bank4_read_picked_lanes[i] = bank4_read_listed_row[i].bank4_read_listed;
        end
    endgenerate
    assign bank4_read_picked = (bank4_read_choice < 4'd11) ? bank4_read_picked_lanes[bank4_read_choice] : 21'd0; // rtl/src/pixelflow/texture_memory.rs:197
    wire [20:0] bank5_read_picked_lanes [0:10];
    generate
        for (i = 0; i < 11; i = i + 1) begin : bank5_read_picked_of
            assign bank5_read_picked_lanes[i] = bank5_read_listed_row[i].bank5_read_listed;
        end
    endgenerate
    assign bank5_read_picked = (bank5_read_choice < 4'd11) ? bank5_read_picked_lanes[bank5_read_choice] : 21'd0; // rtl/src/pixelflow/texture_memory.rs:197
    wire [20:0] bank6_read_picked_lanes [0:10];
    generate
        for (i = 0; i < 11; i = i + 1) begin : bank6_read_picked_of
            assign bank6_read_picked_lanes[i] = bank6_read_listed_row[i].bank6_read_listed;
        end
    endgenerate
    assign bank6_read_picked = (bank6_read_choice < 4'd11) ? bank6_read_picked_lanes[bank6_read_choice] : 21'd0; // rtl/src/pixelflow/texture_memory.rs:197
    wire [20:0] bank7_read_picked_lanes [0:10];
    generate
        for (i = 0; i < 11; i = i + 1) begin : bank7_read_picked_of
            assign bank7_read_picked_lanes[i] = bank7_read_listed_row[i].bank7_read_listed;
        end
    endgenerate
    assign bank7_read_picked = (bank7_read_choice < 4'd11) ? bank7_read_picked_lanes[bank7_read_choice] : 21'd0; // rtl/src/pixelflow/texture_memory.rs:197
    wire [23:0] texels_picked_8_lanes [0:7];
    generate
        for (i = 0; i < 8; i = i + 1) begin : texels_picked_8_of
            assign texels_picked_8_lanes[i] = texels_listed_row[i].texels_listed;
        end
    endgenerate
    assign texels_picked_8 = texels_picked_8_lanes[from0];       // rtl/src/pixelflow/texture_memory.rs:175
    wire [23:0] texels_picked_7_lanes [0:7];
    generate
        for (i = 0; i < 8; i = i + 1) begin : texels_picked_7_of
            assign texels_picked_7_lanes[i] = texels_listed_row[i].texels_listed;
        end
    endgenerate
    assign texels_picked_7 = texels_picked_7_lanes[from1];       // rtl/src/pixelflow/texture_memory.rs:175
    wire [23:0] texels_picked_6_lanes [0:7];
    generate
        for (i = 0; i < 8; i = i + 1) begin : texels_picked_6_of
            assign texels_picked_6_lanes[i] = texels_listed_row[i].texels_listed;
        end
    endgenerate
    assign texels_picked_6 = texels_picked_6_lanes[from2];       // rtl/src/pixelflow/texture_memory.rs:175
    wire [23:0] texels_picked_5_lanes [0:7];
    generate
        for (i = 0; i < 8; i = i + 1) begin : texels_picked_5_of
            assign texels_picked_5_lanes[i] = texels_listed_row[i].texels_listed;
        end
    endgenerate
    assign texels_picked_5 = texels_picked_5_lanes[from3];       // rtl/src/pixelflow/texture_memory.rs:175
    wire [23:0] texels_picked_4_lanes [0:7];
    generate
        for (i = 0; i < 8; i = i + 1) begin : texels_picked_4_of
            assign texels_picked_4_lanes[i] = texels_listed_row[i].texels_listed;
        end
    endgenerate
    assign texels_picked_4 = texels_picked_4_lanes[from4];       // rtl/src/pixelflow/texture_memory.rs:175
    wire [23:0] texels_picked_3_lanes [0:7];
    generate
        for (i = 0; i < 8; i = i + 1) begin : texels_picked_3_of
            assign texels_picked_3_lanes[i] = texels_listed_row[i].texels_listed;
        end
    endgenerate
    assign texels_picked_3 = texels_picked_3_lanes[from5];       // rtl/src/pixelflow/texture_memory.rs:175
    wire [23:0] texels_picked_2_lanes [0:7];
    generate
        for (i = 0; i < 8; i = i + 1) begin : texels_picked_2_of
            assign texels_picked_2_lanes[i] = texels_listed_row[i].texels_listed;
        end
    endgenerate
    assign texels_picked_2 = texels_picked_2_lanes[from6];       // rtl/src/pixelflow/texture_memory.rs:175
    wire [23:0] texels_picked_lanes [0:7];
    generate
        for (i = 0; i < 8; i = i + 1) begin : texels_picked_of
            assign texels_picked_lanes[i] = texels_listed_row[i].texels_listed;
        end
    endgenerate
    assign texels_picked = texels_picked_lanes[from7];           // rtl/src/pixelflow/texture_memory.rs:175

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
        u0_low <= u0_low_next;
        u0_high <= (u0_low_next + 10'd1) & u0_low_difference_2[9:0];
        v0_low <= v0_low_next;
        v0_high <= (v0_low_next + 10'd1) & v0_low_difference_2[9:0];
        level0 <= u0_low_choice;
        u1_low <= u1_low_next;
        u1_high <= (u1_low_next + 10'd1) & u1_low_difference_2[9:0];
        v1_low <= v1_low_next;
        v1_high <= (v1_low_next + 10'd1) & v1_low_difference_2[9:0];
        level1 <= u1_low_choice;
        from0 <= {level0[0], v0_low[0], u0_low[0]};
        from1 <= {level0[0], v0_low[0], u0_high[0]};
        from2 <= {level0[0], v0_high[0], u0_low[0]};
        from3 <= {level0[0], v0_high[0], u0_high[0]};
        from4 <= {level1[0], v1_low[0], u1_low[0]};
        from5 <= {level1[0], v1_low[0], u1_high[0]};
        from6 <= {level1[0], v1_high[0], u1_low[0]};
        from7 <= {level1[0], v1_high[0], u1_high[0]};
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

    wire _unused_ok = &{1'b0, request_texture[7:1], u0_low_shifted[7:0], u0_low_difference[25:18],
            u0_low_difference[7:0], u0_low_difference_2[10], v0_low_shifted[7:0],
            v0_low_difference[25:18], v0_low_difference[7:0], v0_low_difference_2[10],
            u1_low_shifted[7:0], u1_low_difference[25:18], u1_low_difference[7:0],
            u1_low_difference_2[10], v1_low_shifted[7:0], v1_low_difference[25:18],
            v1_low_difference[7:0], v1_low_difference_2[10], bank0_read_choice_5[0],
            bank0_read_choice_2[0], bank0_read_shifted[0], bank0_read_sum[20:4],
            bank1_read_choice_5[0], bank1_read_choice_2[0], bank1_read_shifted[0],
            bank1_read_sum[20:4], bank2_read_choice_4[0], bank2_read_choice_2[0],
            bank2_read_shifted[0], bank2_read_sum[20:4], bank3_read_choice_4[0],
            bank3_read_choice_2[0], bank3_read_shifted[0], bank3_read_sum[20:4],
            bank4_read_choice_4[0], bank4_read_choice_2[0], bank4_read_shifted[0],
            bank4_read_sum[20:4], bank5_read_choice_4[0], bank5_read_choice_2[0],
            bank5_read_shifted[0], bank5_read_sum[20:4], bank6_read_choice_4[0],
            bank6_read_choice_2[0], bank6_read_shifted[0], bank6_read_sum[20:4],
            bank7_read_choice_4[0], bank7_read_choice_2[0], bank7_read_shifted[0],
            bank7_read_sum[20:4]};
endmodule
`default_nettype wire
