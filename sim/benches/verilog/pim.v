// A chain of merging units with local frame buffers, written by hand: the function of the design `pim`.

module pim #(
    parameter STAGES  = 16,
    parameter COLUMNS = 160, // patches of 4 x 4 pixels in a row of the screen
    parameter ROWS    = 120
) (
    input  wire        clk,
    input  wire        rst,
    output reg  [31:0] csum
);
    genvar s;
    generate
        for (s = 0; s < STAGES; s = s + 1) begin : stage
            // A pixel is {valid, rgb, z}.
            wire [48:0] left, right, merged;
            if (s == 0) begin : first
                assign left = 49'd0;
            end else begin : later
                assign left = stage[s - 1].merged;
            end
            pim_frame_buffer #(
                .SEED(32'h9e3779b1 * (s + 1)),
                .COLUMNS(COLUMNS),
                .ROWS(ROWS),
                .START_X((4 * (STAGES - 1 - s)) % (4 * COLUMNS))
            ) frame_buffer (
                .clk(clk), .rst(rst), .pixel(right)
            );
            pim_merger merger (.clk(clk), .left(left), .right(right), .nearer(merged));
        end
    endgenerate

    wire [48:0] last = stage[STAGES - 1].merged;
    wire [31:0] turned = {csum[30:0], csum[31]};
    initial csum = 0;
    always @(posedge clk) begin
        if (rst) csum <= 0;
        else csum <= (turned + {last[48], 7'b0, last[47:24]}) ^ {8'b0, last[23:0]};
    end
endmodule

module pim_merger (
    input  wire        clk,
    input  wire [48:0] left,
    input  wire [48:0] right,
    output reg  [48:0] nearer
);
    reg [48:0] l1, r1, l2, r2, l3, r3;
    reg        high_nearer, high_equal, low_nearer, take_left;
    wire       left_nearer = high_nearer || (high_equal && low_nearer);

    always @(posedge clk) begin
        {l1, r1} <= {left, right};
        {l2, r2} <= {l1, r1};
        {l3, r3} <= {l2, r2};
        high_nearer <= l1[23:12] < r1[23:12];
        high_equal <= l1[23:12] == r1[23:12];
        low_nearer <= l1[11:0] < r1[11:0];
        take_left <= l2[48] && (!r2[48] || left_nearer);
        nearer[48] <= l3[48] || r3[48];
        nearer[47:0] <= take_left ? l3[47:0] : r3[47:0];
    end
    initial begin
        {l1, r1, l2, r2, l3, r3, nearer} = 0;
        {high_nearer, high_equal, low_nearer, take_left} = 0;
    end
endmodule

module pim_frame_buffer #(
    parameter [31:0] SEED    = 1,
    parameter        COLUMNS = 160,
    parameter        ROWS    = 120,
    parameter        START_X = 0
) (
    input  wire        clk,
    input  wire        rst,
    output wire [48:0] pixel
);
    // Patches of 4 x 4 pixels; entry 0 means no page. A page has 16 words of {rgb, z}.
    localparam PATCHES = COLUMNS * ROWS, PAGES = PATCHES / 4;
    // The widths of a column, a row, a patch and an address of the image.
    localparam CW = $clog2(COLUMNS), RW = $clog2(ROWS), PW = $clog2(PATCHES), AW = $clog2(16 * PAGES);
    localparam [CW+1:0] LAST_X = 4 * COLUMNS - 1, BEGIN_X = START_X;
    localparam [RW+1:0] LAST_Y = 4 * ROWS - 1;
    localparam [PW-1:0] PATCHES_IN_ROW = COLUMNS;
    localparam [CW-1:0] TOO_FAR = 2**CW - COLUMNS;
    localparam [RW-1:0] TOO_LOW = 2**(RW-1);
    reg [12:0] patch_table [0:PATCHES - 1];
    reg [47:0] image [0:16 * PAGES - 1];

    function [PW-1:0] patch(input [CW-1:0] column, input [RW-1:0] row);
        patch = PATCHES_IN_ROW * {{(PW-RW){1'b0}}, row} + {{(PW-CW){1'b0}}, column};
    endfunction
    function [AW-1:0] address(input [12:0] page, input [3:0] offset);
        reg [16:0] whole;
        begin
            whole = {page, offset};
            address = whole[AW-1:0];
        end
    endfunction

    // The scan.
    reg  [CW+1:0] x;
    reg  [RW+1:0] y;
    reg  [12:0] page;
    reg  [3:0]  offset;
    reg  [47:0] word;
    reg         valid;
    assign pixel = {valid, word};
    always @(posedge clk) begin
        if (rst) begin
            x <= BEGIN_X;
            y <= 0;
        end else if (x != LAST_X) x <= x + 1;
        else begin
            x <= 0;
            y <= y == LAST_Y ? 0 : y + 1;
        end
        page <= patch_table[patch(x[CW+1:2], y[RW+1:2])];
        offset <= {y[1:0], x[1:0]};
        word <= image[address(page, offset)];
        valid <= page != 0;
    end

    // The drawing.
    reg  [31:0] random;
    wire [31:0] mixed1 = random ^ (random << 13);
    wire [31:0] mixed2 = mixed1 ^ (mixed1 >> 17);
    wire [CW-1:0] column = random[CW-1:0] < COLUMNS ? random[CW-1:0] : random[CW-1:0] - TOO_FAR;
    wire [RW-1:0] row = random[RW+7:8] < ROWS ? random[RW+7:8] : random[RW+7:8] - TOO_LOW;
    reg  [3:0]  pixel_number, drawn;
    reg  [PW-1:0] target, looked_up;
    reg  [12:0] entry, next_page, page_before;
    reg  [47:0] drawn_word;
    reg         draws_before;
    reg         takes, draws;
    reg  [12:0] drawn_page;

    always @* begin
        takes = 0;
        draws = draws_before;
        drawn_page = page_before;
        if (drawn == 0) begin
            takes = entry == 0 && next_page != PAGES;
            draws = entry != 0 || next_page != PAGES;
            drawn_page = entry != 0 ? entry : next_page;
        end
    end

    always @(posedge clk) begin
        if (rst) begin
            random <= SEED;
            pixel_number <= 0;
            target <= 0;
            drawn <= 1;
            next_page <= 1;
            page_before <= 0;
            draws_before <= 0;
        end else begin
            random <= mixed2 ^ (mixed2 << 5);
            pixel_number <= pixel_number + 1;
            if (pixel_number == 15) target <= patch(column, row);
            drawn <= pixel_number;
            if (takes) next_page <= next_page + 1;
            page_before <= drawn_page;
            draws_before <= draws;
        end
        looked_up <= target;
        entry <= patch_table[target];
        drawn_word <= {random[23:0], random[31:8] ^ {random[7:0], 16'b0}};
        if (takes) patch_table[looked_up] <= next_page;
        if (draws) image[address(drawn_page, drawn)] <= drawn_word;
    end

    integer i;
    initial begin
        {x, y, page, offset, word, valid} = 0;
        {pixel_number, target, looked_up, entry, page_before, draws_before, drawn_word} = 0;
        random = SEED;
        drawn = 1;
        next_page = 1;
        for (i = 0; i < PATCHES; i = i + 1) patch_table[i] = 0;
        for (i = 0; i < 16 * PAGES; i = i + 1) image[i] = 0;
    end
endmodule
