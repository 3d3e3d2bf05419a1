//! The causes of values in random designs.
//!
//! `CAUSES_DESIGNS` is the number of designs, and `CAUSES_SEED` their seed, for a longer run by hand.

use tilewright_cosim::causes::run;
use tilewright_cosim::drawn::Kind;

#[test]
fn forcing_what_is_no_cause_changes_nothing_in_40_designs() {
    let (found, failing) = run(Kind::Mixed, number("CAUSES_SEED", 1), 0, number("CAUSES_DESIGNS", 40));
    println!("{found}");
    assert!(found.cones >= 2 * found.designs && found.forced >= 2 * found.cones, "{found}");
    // Few causes are without effect, where a second one decides as well, or it takes rare values to see it.
    assert!(2 * found.live >= found.flipped && 20 * found.deaf <= found.cones, "{found}");
    assert!(failing.is_empty(), "designs that fail: {failing:?}");
}

/// The number in an environment variable, or another one.
fn number(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).map_or(otherwise, |text| text.parse().unwrap_or_else(|_| panic!("{name} is no number: {text}")))
}
