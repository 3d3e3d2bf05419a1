//! Why statements differ on the paper’s screen, and what would make them true.

type Why = [&'static str; 2];

/// Regions of a polygon (PP5-ARCH).
pub const LARGE: Why = [
    "The border of a region cuts larger polygons more often. On the mean, each of the 176,245 polygons of ter250 is in 1.05 regions. Those of ter1k, 11,174, are in 1.20, and the 4025 of the teapot in 1.43.",
    "“Complex scenes” would have to mean scenes with polygons as small as the terrains’: both are within 25 %.",
];

/// Balance by a plain count (PP5-ARCH).
pub const FULLEST: Why = [
    "One renderer draws a whole region. The fullest region of the teapot has 479 of 5760 primitives, 1.33 times the balanced load of 16 renderers. The wireframe has 127 of 1534, nearly the same ratio.",
    "Regions would have to be smaller where a scene is dense, or the statement would have to be limited to scenes of even density. The terrains, the star and random vectors are within 4 %.",
];

/// Balance of the circuit's frames (PP5-ARCH).
pub const SENDING: Why = [
    "Sending takes longer than drawing in these frames: 80 regions are 491,520 lines of pixels, one a clock, whatever they show. So a renderer gets its next region when the one before is sent, not when its primitives are drawn.",
    "The ring would have to take more than a line a clock, or frames would need enough primitives to make drawing take longer. With 4000 random vectors the load is within 10 %.",
];

/// Renderers that do not divide the regions (PP5-PW).
pub const WHOLE: Why = [
    "One renderer draws a whole region. If the number of renderers does not divide 80, some renderer has ⌈80/B⌉ regions. With 26 renderers that is 4 instead of 3.08, 30 % more.",
    "The upper bound would have to be P ⌈R/B⌉, which holds for all numbers of renderers.",
];

/// The paper's example (PP5-HVB).
pub const FALLEN_OUT: Why = [
    "The formula above the example is that of binning by columns, which gives 2.55. The number 1.63 follows from the bounding box, (1 + L cos θ/S)(1 + L sin θ/S), whose formula is missing in the text.",
    "The text would have to print the formula of the bounding box for its example. By that formula the statement holds, and a count of random vectors confirms it.",
];

/// The update time with many renderers (PP5-UT).
pub const LINES: Why = [
    "Random vectors fill regions evenly, so renderers finish together. Then they wait until their regions are sent, which takes 6144 clocks a region and 12.3 ms for all 80. With up to 20 renderers drawing takes longer and hides \
     that. With 32 it is longer than the 12.1 ms of N P_w T.",
    "The formula would have to have a term for sending regions, or the statement would have to be limited to 20 renderers: up to there it is within 1 %.",
];

/// Waiting for instructions (PP5-UT).
pub const RING: Why = [
    "Each renderer needs its own instructions. They load a ring of 5 Gbit/s to 97 % with 8 renderers and to 100 % with 12. So renderers wait in 29 % of their clocks with 12, and in 57 % with 32.",
    "The ring would need more than 5 Gbit/s, or there would have to be at most 8 renderers. Eight wait in 0.01 % of their clocks.",
];
