//! Why statements differ with the full number of polygons, and what would make them true.

type Why = [&'static str; 2];

/// Windows above equation 1 (MPG-EQ1).
pub const BORDER: Why = [
    "One of the gaps between coarse windows lies at the border of the screen. Rectangles that are entirely on the screen are there less often. So 33 of 570 means are above the bound, by 0.86 % at \
     most. All of them are of rectangles below 24 pixels, on the first levels of 64 and 256 processors.",
    "The rectangles would have to lie anywhere in the spacing of windows, as on a screen without a border. In that count the bound holds on every level.",
];

/// Growth at S = 1000 (MPG-F6A).
pub const COARSE: Why = [
    "A stage tests four parts of each window of the level before it, where the outline of a polygon meets disproportionately many windows. By equation 1 one processor has 342 windows on that level and 1244 on its last. Each \
     of 256 processors has 3.4 and 4.9.",
    "“Almost in proportion” would have to allow for 57 %. At S = 100 000 it holds, with 237 of 256.",
];

/// The load at S_k (MPG-F6B).
pub const BELOW: Why = [
    "At S_k the last level has one window, but by equation 1 the levels before it have up to 1.31 with 256 processors. So stages take unequal times, and their load is 92 to 98 %.",
    "“Near S_k” would have to be read as below it: by the formulas the load is greatest at 0.5 to 0.7 of S_k, and there it is 97 to 99 %.",
];

/// The load of small polygons (MPG-F6B).
pub const SMALL: Why = [
    "Below S_k polygons can lie between windows, more often in a larger matrix. Then the last stages of its pipelines are idle. At S = 1 the last level has 0.75 windows with 16 processors, and 0.05 with 256.",
    "The statement would have to be limited to areas above S_k. At S = 200 it holds: the load grows from 20 to 86 %.",
];

/// Short queues before stacks (MPG-LIM).
pub const SHORT: Why = [
    "A packet goes to all video processors at once, so a full queue of one stalls the others. With room for one packet 256 stacks lose 6.7 % at S = 1 and 0.9 % at S = 10 000.",
    "The queues would have to be deeper, as the paper assumes: with four packets the statement holds for every area, and with 64 no area loses more than 1 %.",
];
