//! Why statements differ on the paper’s screen, and what would have to change.

type Why = [&'static str; 2];

/// Regions of a polygon (PP5-ARCH).
pub const LARGE: Why = [
    "The larger a polygon is, the more often a border of regions cuts it. One of ter250’s 176,245 is in 1.05 regions on the mean, one of ter1k’s 11,174 in 1.20, and one of the teapot’s 4025 in 1.43.",
    "“Complex scenes” would have to mean those with polygons as small as the terrains’: both keep within 25 %.",
];

/// Balance by a plain count (PP5-ARCH).
pub const FULLEST: Why = [
    "A region is drawn by one renderer as a whole. The fullest one of the teapot has 479 of 5760 primitives, which is 1.33 times what each of 16 renderers would have in balance; so it is with the wireframe, 127 of 1534.",
    "Regions would have to be smaller where a scene is dense, or the statement would have to be limited to scenes of even density: the terrains, the star and random vectors keep within 4 %.",
];

/// Balance of the circuit's frames (PP5-ARCH).
pub const SENDING: Why = [
    "Sending takes longer than drawing in these frames: 80 regions are 491,520 lines of pixels, one a clock, whatever is drawn in them. So a renderer gets its next region when the one before is sent, not when its primitives are drawn.",
    "The ring would have to take more than a line a clock, or frames would have to have so many primitives that drawing takes longer. Of random vectors 4000 are enough to keep within 10 %.",
];

/// Renderers that do not divide the regions (PP5-PW).
pub const WHOLE: Why = [
    "Regions are drawn as a whole, so if the number of renderers does not divide 80, some renderer has ⌈80/B⌉ of them. With 26 renderers these are 4 in place of 3.08, 30 % more.",
    "The upper bound would have to be P ⌈R/B⌉, which holds for all numbers of renderers.",
];

/// The paper's example (PP5-HVB).
pub const FALLEN_OUT: Why = [
    "The formula that is printed above the example is that of binning by columns, which gives 2.55. 1.63 follows from the bounding box, (1 + L cos θ/S)(1 + L sin θ/S), whose formula is missing in the text.",
    "The text would have to print the formula of the bounding box for its example. By that one the statement holds, and a count of random vectors finds the same.",
];

/// The update time with many renderers (PP5-UT).
pub const LINES: Why = [
    "Renderers finish together, as random vectors fill regions evenly, and then wait until what they drew is sent: 6144 clocks a region, 12.3 ms for all 80. Drawing hides that with up to 20 renderers. With 32 it is longer than \
     the 12.1 ms of N P_w T.",
    "The formula would have to have a term for sending regions, or the statement would have to be limited to 20 renderers: up to there it is within 1 %.",
];

/// Waiting for instructions (PP5-UT).
pub const RING: Why = [
    "Each renderer has to be sent its own instructions, and a ring of 5 Gbit/s is loaded to 97 % with 8 renderers and to 100 % with 12. Then renderers wait: 29 % of their clocks with 12, 57 % with 32.",
    "The ring would have to bring more than 5 Gbit/s, or there would have to be at most 8 renderers, which wait 0.01 % of their clocks.",
];
