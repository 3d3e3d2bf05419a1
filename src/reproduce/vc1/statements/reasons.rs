//! Why statements differ on the paper’s screen, and what would make them true. The page gives a reason only for a statement that differs.

type Why = [&'static str; 2];

/// The wait of an overflow (VC1-SW4).
pub const SWAPS: Why = [
    "A swap waits until T_m has passed since the last one, and for the swap of the global frame buffer, which comes in a blanking. If all swapped together at any time of a refresh, \
     these add up to T_m and a refresh, 42.0 ms. A processing element that overflows late delays the global frame buffer’s swap. Then another one waits for up to 2 T_m and a refresh, 67.4 ms.",
    "The paper would have to limit its statement to overflows after a swap in a blanking. For those 33.3 ms is true here, too.",
];

/// Time by the number of processing elements (VC1-F7).
pub const OVERFLOWS: Why = [
    "With one, two and four processing elements the table overflows. A frame waits 50, 58 and 67 ms for these swaps: the wait does not shrink as the work of each does.",
    "The processing elements would need pages for all that they draw, or the statement would have to except scenes that overflow.",
];

/// Rates and speed-up of ter250 (VC1-F7, VC1-RATE).
pub const COSTS: Why = [
    "The costs of the programs are fitted to ter1k. ter250 is the same terrain with 16 times the polygons, each with fewer rows and pixels. By the fitted costs a polygon takes 1082 clocks; by the \
     paper’s numbers it takes 1246.",
    "The paper would have to print the costs of its programs. Otherwise the costs would have to be fitted to ter250 instead of Table 1’s ter1k.",
];

/// Pages of small polygons (VC1-LOC).
pub const BORDERS: Why = [
    "A cluster of 32 small polygons covers less of the screen than one of large polygons. So a larger part of its patches is at its border. The pages of a processing element grow with the \
     number of polygons, while its pixels do not.",
    "The size of a cluster would have to grow with the number of polygons, so that it covers the same area of the screen. The paper tunes it, and prints no number.",
];

/// What a threshold saves (VC1-F9).
pub const REFRESHES: Why = [
    "A frame takes whole refreshes: 2 without overflow, 4 with one, and 5 with two. With one it takes 4, because 2 T_m is more than 3 refreshes. With the threshold there is no overflow; without it a frame takes 5 refreshes with 1/4.7 of \
     the screen, and 10 with 1/8.",
    "The paper’s table would have to overflow less without the threshold: 75 % is the ratio of 3 refreshes to 4. The text states neither the memory of the figure’s machine nor the polygons of its table, so both are choices here.",
];

/// Balance by the threshold (VC1-F9).
pub const DEALT: Why = [
    "Clusters are assigned by the clocks of all their polygons. Then the large polygons leave their owners, which lose unequal numbers of clocks. Of the rest the busiest has 10 % more than the mean \
     with a threshold of 500 pixels, 6 % with 20,000, and 2 % with none. With none, tables that are cleared again after overflows add to the busiest.",
    "Clusters would have to be assigned by the polygons that stay with their owners.",
];

/// Times and waiting in Table 1 (VC1-T1).
pub const REGIONS: Why = [
    "Each region has a busiest processing element of its own, so waiting adds up over regions. The spread of the clocks of clipping over packets is a choice here. With virtual local frame buffers \
     the wait depends on the view in which clusters are assigned: 2.28 ms from the first view, 1.17 to 2.46 from others, and 0.62 if they are assigned anew for each.",
    "The paper would have to say how clipping is spread over its processing elements, and in which view it assigns clusters.",
];

/// The polygons that are sent (VC1-THRN).
pub const EQUALS: Why = [
    "T is the same with several thresholds, so the least D decides. With 16 and with 64 processing elements it is at the same one of the twelve thresholds, so the same polygons are sent.",
    "“Smaller” would have to be read as “not larger”, or finer thresholds would have to tell the two machines apart.",
];

/// Immediate mode (VC1-IMM).
pub const COMMAND: Why = [
    "The command to draw follows the scene on the bus, so drawing and the bus do not overlap. The bus takes 184 ms, and drawing takes 88 ms with 64 processing elements and 24 ms with 256.",
    "Processing elements would have to draw polygons while the rest of the scene is on the bus. The paper does not say so.",
];
