//! Why statements differ with the full number of polygons, and what would have to change.

type Why = [&'static str; 2];

/// Windows above equation 1 (MPG-EQ1).
pub const BORDER: Why = [
    "One of the gaps between coarse windows lies at the border of the screen, and rectangles that are on the screen as a whole are there less often. So 33 of 570 means are above the bound, by 0.86 % at \
     most, all of rectangles below 24 pixels on the first levels of 64 and 256 processors.",
    "The rectangles would have to lie anywhere in the spacing of windows, as on a screen without a border. Counted so, the bound holds on every level.",
];

/// Growth at S = 1000 (MPG-F6A).
pub const COARSE: Why = [
    "A stage tests four parts of each window of the level before it. By equation 1 one processor has 342 windows on that level for the 1244 of its last one, and each of 256 has 3.4 for 4.9: the outline of a \
     polygon meets large windows out of proportion.",
    "“Almost in proportion” would have to allow for 57 %. At S = 100 000 it holds, with 237 of 256.",
];

/// The load at S_k (MPG-F6B).
pub const BELOW: Why = [
    "At S_k the last level has one window, but by equation 1 the levels before it have up to 1.31 with 256 processors. So stages do not take equally long, and their load is 92 to 98 %.",
    "“Near S_k” would have to be read as below it: by the formulas the load is greatest at 0.5 to 0.7 of S_k, and there it is 97 to 99 %.",
];

/// The load of small polygons (MPG-F6B).
pub const SMALL: Why = [
    "Below S_k polygons lie between windows, the more often the larger the matrix is, and the last stages of its pipelines idle. At S = 1 the last level has 0.75 windows with 16 processors, and 0.05 with 256.",
    "The statement would have to be limited to areas above S_k. At S = 200 it holds: the load grows from 20 to 86 %.",
];

/// Short queues before stacks (MPG-LIM).
pub const SHORT: Why = [
    "A packet goes to all video processors at once, so one whose queue is full holds up the others. With room for one packet 256 stacks lose 6.7 % at S = 1 and 0.9 % at S = 10 000.",
    "The queues would have to be deeper, as the paper assumes: with four packets the statement holds for every area, and with 64 no area loses more than 1 %.",
];
