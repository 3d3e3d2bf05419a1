//! Why statements differ on the paper’s screen, where a count shows it. The page gives a reason only for a statement that differs.

/// The wait of an overflow (VC1-SW4).
pub const SWAPS: &str = "A swap waits until T_m has passed since the last one, and for the swap of the global frame buffer, which comes in a blanking. Behind a swap in a blanking that takes two refreshes \
     at most. But all may have swapped at any time of a refresh: then it takes up to T_m and a refresh, 42.0 ms. And a processing element that overflows late holds the global frame buffer’s swap back. \
     Another one then waits for up to 2 T_m and a refresh, 67.4 ms.";

/// Time by the number of processing elements (VC1-F7).
pub const OVERFLOWS: &str = "With one, two and four processing elements the table overflows. A frame’s wait for these swaps is 50, 58 and 67 ms: it does not shrink as the work of each does.";

/// Rates and speed-up of ter250 (VC1-F7, VC1-RATE).
pub const COSTS: &str = "The costs are fitted to ter1k. ter250 is the same terrain in 16 times as many polygons, each with fewer rows and pixels. By those costs a polygon takes 1082 clocks, where the paper’s \
     numbers make 1246.";

/// Pages of small polygons (VC1-LOC).
pub const BORDERS: &str = "A cluster of 32 small polygons covers less of the screen than one of large ones. It has more patches at its border for each that it fills. So the pages of a processing element grow with \
     the number of polygons, while its pixels do not.";

/// What a threshold saves (VC1-F9).
pub const REFRESHES: &str = "A frame takes whole refreshes: 2 without overflow, 4 with one, as 2 T_m is more than 3, and 5 with two. With the threshold there is no overflow. Without it a frame takes 5 refreshes \
     with 1/4.7 of the screen, and 10 with 1/8.";

/// Balance by the threshold (VC1-F9).
pub const DEALT: &str = "Clusters are dealt by the clocks of all their polygons. The larger ones then leave their owners, some more than others. By a count of what remains, the busiest has 10 % more than the mean \
     with a threshold of 500 pixels, 6 % with 20,000, and 2 % with none. There, tables that are cleared again \
     after overflows make the busiest busier.";

/// Times and waiting in Table 1 (VC1-T1).
pub const REGIONS: &str = "Each region has a busiest processing element of its own, so waiting adds up over regions. The clocks of clipping are fitted to sums over all processing elements. How they are spread over \
     packets, and so over processing elements, is a choice here. With virtual local frame buffers the wait depends on the view in which clusters are dealt. It is 2.28 ms from the first, 1.17 to 2.46 from \
     others, and 0.62 if they are dealt anew for each.";

/// The polygons that are sent (VC1-THRN).
pub const EQUALS: &str = "T is the same with several thresholds, and of these the least D counts. With 16 and with 64 that is at the same one of the twelve that are tried, so the same polygons are sent.";

/// Immediate mode (VC1-IMM).
pub const COMMAND: &str = "The command to draw comes behind the scene. So what a processing element draws is not hidden behind the bus: 184 ms of the bus, and 88 ms of drawing with 64, 24 ms with 256.";
