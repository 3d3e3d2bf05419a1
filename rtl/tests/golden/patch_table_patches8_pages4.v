// patch_table_patches8_pages4
//
// Gives each patch of the screen a page of image memory on its first access, separately for
// the front buffer and the back buffer.
//
// Parameters  PatchTable { patches: 8, pages: 4 }
// Latency     3 clocks for a patch with a page, otherwise 4
// Source      VC-1, section 3.3, patch table (VC1-PT, VC1-ACC)
// Described   rtl/src/lfb/patch_table.rs:33
`default_nettype none

module patch_table_patches8_pages4 (
    input  wire       pe_clk,
    input  wire       pe_rst,
    input  wire       merge_clk,
    // A request for the page of a patch.
    input  wire       look_up_valid,
    input  wire [2:0] look_up_patch,       // The number of the patch.
    // A request to clear an entry. If a look-up is accepted at the same edge, the clear comes first.
    input  wire       clear_valid,
    input  wire [2:0] clear_patch,         // The number of the patch.
    input  wire       front,               // The front buffer, 0 or 1.
    input  wire       settled,             // The scan has left the front buffer.
    input  wire       restart,             // Frees all pages.
    input  wire       resume,              // Retries the waiting look-up.
    // A patch whose page the scan needs.
    input  wire       scan_enable,         // The scan advances; while it is low, the entry does not change.
    input  wire [2:0] scan_patch,          // The number of the patch.
    input  wire       scan_buffer,         // The buffer to look into.
    output wire       overflow,            // A look-up waits, because all pages are taken.
    output wire       idle,                // No look-up is under way.
    output wire [2:0] pages_used,          // The number of pages taken.
    output wire       found,               // The look-up ends in this clock.
    output reg  [1:0] page,                // The page that the look-up found.
    // The entry that the scan looked up one clock earlier.
    output wire       scan_entry_resident, // The page existence flag: the patch has a page.
    output wire [1:0] scan_entry_page,     // The page ID: the page of the patch.
    output wire       look_up_ready,
    output wire       clear_ready
);

    localparam [2:0] STAGE1_IDLE     = 3'd0;
    localparam [2:0] STAGE1_READ     = 3'd1;
    localparam [2:0] STAGE1_EXAMINE  = 3'd2;
    localparam [2:0] STAGE1_ALLOCATE = 3'd3;
    localparam [2:0] STAGE1_FOUND    = 3'd4;
    localparam [2:0] STAGE1_OVERFLOW = 3'd5;

    reg [2:0] stage1;                                            // rtl/src/lfb/patch_table.rs:96
    reg [1:0] clearing;                                          // rtl/src/lfb/patch_table.rs:98
    reg [2:0] patch;                                             // rtl/src/lfb/patch_table.rs:106

    (* no_rw_check *)
    reg [2:0] entries [0:15];                                    // rtl/src/lfb/patch_table.rs:110
    reg [2:0] entry;                                             // rtl/src/lfb/patch_table.rs:113
    reg [2:0] scan_entry;                                        // rtl/src/lfb/patch_table.rs:130

    initial begin : entries_contents
        integer i;
        for (i = 0; i < 16; i = i + 1) entries[i] = 3'd0;
    end

    wire [1:0] u_page_id_generator_page;                         // rtl/src/lfb/patch_table.rs:117
    wire u_page_id_generator_exhausted;                          // rtl/src/lfb/patch_table.rs:117

    assign idle = stage1 == STAGE1_IDLE;                         // rtl/src/lfb/patch_table.rs:97
    assign found = stage1 == STAGE1_FOUND;                       // rtl/src/lfb/patch_table.rs:97
    wire can_accept = idle | found;                              // rtl/src/lfb/patch_table.rs:102
    assign look_up_ready = can_accept;                           // rtl/src/lfb/patch_table.rs:103
    wire cleared = clearing == 2'd0;                             // rtl/src/lfb/patch_table.rs:99
    wire table_free = cleared & settled;                         // rtl/src/lfb/patch_table.rs:101
    assign overflow = stage1 == STAGE1_OVERFLOW;                 // rtl/src/lfb/patch_table.rs:97
    assign clear_ready = table_free & (can_accept | overflow);   // rtl/src/lfb/patch_table.rs:104
    wire look_up_taken = look_up_valid & can_accept;             // rtl/src/lfb/patch_table.rs:103
    wire clear_taken = clear_valid & clear_ready;                // rtl/src/lfb/patch_table.rs:104
    wire [3:0] address = {clear_taken ? clear_patch : patch, front}; // rtl/src/lfb/patch_table.rs:111
    wire read = (stage1 == STAGE1_READ) & table_free;            // rtl/src/lfb/patch_table.rs:112
    wire entry_resident = entry[2];                              // rtl/src/lfb/patch_table.rs:113
    wire [1:0] entry_page = entry[1:0];                          // rtl/src/lfb/patch_table.rs:113
    wire allocate = stage1 == STAGE1_ALLOCATE;                   // rtl/src/lfb/patch_table.rs:115
    assign scan_entry_resident = scan_entry[2];                  // rtl/src/lfb/patch_table.rs:130
    assign scan_entry_page = scan_entry[1:0];                    // rtl/src/lfb/patch_table.rs:130

    page_id_generator_pages4 u_page_id_generator (               // rtl/src/lfb/patch_table.rs:117
        .clk       (pe_clk),
        .rst       (pe_rst),
        .restart   (restart),
        .take      (allocate),
        .page      (u_page_id_generator_page),
        .used      (pages_used),
        .exhausted (u_page_id_generator_exhausted)
    );

    always @(posedge pe_clk) begin
        if (allocate | clear_taken) entries[address] <= {allocate, page};
        if (read) entry <= entries[address];
    end

    always @(posedge merge_clk) begin
        if (scan_enable) scan_entry <= entries[{scan_patch, scan_buffer}];
    end

    always @(posedge pe_clk) begin
        if (look_up_taken) patch <= look_up_patch;
    end

    always @(posedge pe_clk) begin
        if (stage1 == STAGE1_EXAMINE) begin
            if (entry_resident) page <= entry_page;
            else page <= u_page_id_generator_page;
        end
    end

    always @(posedge pe_clk) begin
        if (pe_rst) begin
            stage1 <= STAGE1_IDLE;
            clearing <= 2'd0;
        end else begin
            case (stage1)
                STAGE1_IDLE: if (look_up_taken) stage1 <= STAGE1_READ;
                STAGE1_READ: if (table_free) stage1 <= STAGE1_EXAMINE;
                STAGE1_EXAMINE: begin
                    if (entry_resident) stage1 <= STAGE1_FOUND;
                    else if (u_page_id_generator_exhausted) stage1 <= STAGE1_OVERFLOW;
                    else stage1 <= STAGE1_ALLOCATE;
                end
                STAGE1_ALLOCATE: stage1 <= STAGE1_FOUND;
                STAGE1_FOUND: begin
                    if (look_up_taken) stage1 <= STAGE1_READ;
                    else stage1 <= STAGE1_IDLE;
                end
                default: begin // STAGE1_OVERFLOW
                    if (resume) stage1 <= STAGE1_READ;
                    else stage1 <= STAGE1_OVERFLOW;
                end
            endcase
            if (clear_taken) clearing <= 2'd2;
            else if (!cleared) clearing <= clearing - 2'd1;
        end
    end

`ifndef SYNTHESIS
`ifdef FORMAL
    always @(posedge pe_clk) begin
        if (!pe_rst) cover ((stage1 == STAGE1_EXAMINE) & (!entry_resident & u_page_id_generator_exhausted)); // rtl/src/lfb/patch_table.rs:126
    end
`else
    reg is_covered;
    initial is_covered = 1'b0;
    always @(posedge pe_clk) begin
        if (!pe_rst && ((stage1 == STAGE1_EXAMINE) & (!entry_resident & u_page_id_generator_exhausted)) && !is_covered) begin // rtl/src/lfb/patch_table.rs:126
            `ifdef TILEWRIGHT_COVERS
            $display("COVER: time %0t: %m: a look-up finds no free page", $time);
            `endif
            is_covered <= 1'b1;
        end
    end
`endif
`endif
endmodule
`default_nettype wire
