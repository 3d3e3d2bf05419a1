//! The colours of the style sheet can be told from what is behind them, by the WCAG's measure: text 4.5 to 1, lines and marks 3 to 1.

const SHEET: &str = include_str!("../src/colours.css");

/// A colour of the light or of the dark block, which is the second one.
fn colour(name: &str, is_dark: bool) -> [f64; 3] {
    let block = SHEET.split(":root {").nth(1 + usize::from(is_dark)).unwrap();
    let value = block.split(&format!("--{name}: #")).nth(1).unwrap_or_else(|| panic!("no colour {name}"));
    [0, 2, 4].map(|at| f64::from(u8::from_str_radix(&value[at..at + 2], 16).unwrap()) / 255.0)
}

fn luminance(colour: [f64; 3]) -> f64 {
    let linear = colour.map(|it| if it <= 0.04045 { it / 12.92 } else { ((it + 0.055) / 1.055).powf(2.4) });
    0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
}

fn contrast(one: &str, other: &str, is_dark: bool) -> f64 {
    let [one, other] = [one, other].map(|name| luminance(colour(name, is_dark)) + 0.05);
    (one / other).max(other / one)
}

#[test]
fn colours_stand_out() {
    assert!((luminance([1.0; 3]) + 0.05) / (luminance([0.0; 3]) + 0.05) > 20.9, "white on black");
    for is_dark in [false, true] {
        let least = |one: &str, other: &str, wanted: f64| {
            let found = contrast(one, other, is_dark);
            assert!(found >= wanted, "--{one} on --{other} has {found:.2} (dark: {is_dark})");
        };
        for text in ["ink", "muted", "link", "holds", "differs", "unknown"] {
            least(text, "page", 4.5);
        }
        // Statements that differ are on a raised ground.
        for text in ["ink", "muted", "differs"] {
            least(text, "raised", 4.5);
        }
        // Names at the ends of curves have their colours.
        (0..6).for_each(|look| least(&format!("look{look}"), "page", 4.5));
        // Of a scale, the colours between two have a contrast between theirs.
        for (text, cell) in [("on-low", "low"), ("on-low", "middle"), ("on-high", "middle"), ("on-high", "high")] {
            least(text, cell, 4.5);
        }
    }
}
