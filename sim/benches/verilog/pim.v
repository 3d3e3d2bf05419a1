// A chain of merging units with local frame buffers, written by hand: the function of the design `pim`.

module pim #(
    parameter STAGES = 16
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
                .START_X((4 * (STAGES - 1 - s)) % 640)
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
    parameter [9:0]  START_X = 0
) (
    input  wire        clk,
    input  wire        rst,
    output wire [48:0] pixel
);
    // 160 x 120 patches of 4 x 4 pixels; entry 0 means no page. A page has 16 words of {rgb, z}.
    localparam PATCHES = 19200, PAGES = 4800;
    reg [12:0] patch_table [0:PATCHES - 1];
    reg [47:0] image [0:16 * PAGES - 1];

    function [14:0] patch(input [7:0] column, input [6:0] row);
        patch = 15'd160 * {8'b0, row} + {7'b0, column};
    endfunction

    // The scan.
    reg  [9:0]  x;
    reg  [8:0]  y;
    reg  [12:0] page;
    reg  [3:0]  offset;
    reg  [47:0] word;
    reg         valid;
    assign pixel = {valid, word};
    always @(posedge clk) begin
        if (rst) begin
            x <= START_X;
            y <= 0;
        end else if (x != 639) x <= x + 1;
        else begin
            x <= 0;
            y <= y == 479 ? 9'd0 : y + 9'd1;
        end
        page <= patch_table[patch(x[9:2], y[8:2])];
        offset <= {y[1:0], x[1:0]};
        word <= image[{page, offset}];
        valid <= page != 0;
    end

    // The drawing.
    reg  [31:0] random;
    wire [31:0] mixed1 = random ^ (random << 13);
    wire [31:0] mixed2 = mixed1 ^ (mixed1 >> 17);
    wire [7:0]  column = random[7:0] < 160 ? random[7:0] : random[7:0] - 8'd96;
    wire [6:0]  row = random[14:8] < 120 ? random[14:8] : random[14:8] - 7'd64;
    reg  [3:0]  pixel_number, drawn;
    reg  [14:0] target, looked_up;
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
        if (draws) image[{drawn_page, drawn}] <= drawn_word;
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
