//! Why statements differ on the paper’s screen, where a count shows it. A page has a reason only beside a statement that differs.

/// The wait of an overflow (VC1-SW4).
pub const GUARDS: &str = "A swap waits for T_m since the last one and for the swap of the global frame buffer, which comes in a blanking. Behind a swap in a blanking that is 33.3 ms at most. But all may \
     have swapped at any time of a refresh: then it is up to T_m and a refresh, 42.0 ms. And one that overflowed late holds the global frame buffer’s swap back, so another waits for up to 2 T_m and a \
     refresh, 67.4 ms.";

/// Rates and speed-up of ter250 (VC1-F7, VC1-RATE).
pub const COSTS: &str = "The costs are fitted to ter1k. ter250 is the same terrain in 16 times as many polygons, each of fewer rows and pixels, and by those costs one takes 1082 clocks, where the paper’s \
     numbers make 1246.";

/// What a threshold saves (VC1-F9).
pub const REFRESHES: &str = "A frame is shown at a whole refresh. With one overflow it takes 4 of them, as 2 T_m is more than 3, and with more overflows 5 and more. So a ratio of times is one of small whole \
     numbers, unless frames differ.";

/// Pages of small polygons (VC1-LOC).
pub const BORDERS: &str = "A cluster of 32 small polygons covers less of the screen than one of large ones, and has more patches at its border for each that it fills. So the pages of a processing element grow \
     with the number of polygons, while its pixels do not.";

/// Regions (VC1-T1).
pub const CLIPPING: &str = "Each region has a busiest processing element of its own, so waiting adds up over regions. The clocks of clipping are fitted to sums of all processing elements; how they are spread \
     over packets, and so over processing elements, is a choice here.";
