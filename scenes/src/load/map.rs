//! The operand of `map_Kd`: options, and a file name, which may itself have blanks and dashes.
//!
//! Source: the MTL format, Wavefront's Advanced Visualizer; some programs write options after the name.

use super::files::words;
use super::lines::trimmed;
use super::numbers::parsed;
use crate::quote::quote_bytes;
use glam::{DVec2, dvec2};

/// The placement of a texture on a surface.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Placement {
    /// The factor of texture coordinates.
    pub(super) scale: DVec2,
    /// The offset that is then added.
    pub(super) offset: DVec2,
    /// Whether the texture appears only once, with its edge colours continued beyond its edges.
    pub(super) is_clamped: bool,
}

impl Default for Placement {
    fn default() -> Placement {
        Placement { scale: DVec2::ONE, offset: DVec2::ZERO, is_clamped: false }
    }
}

/// The operand of `map_Kd`.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Map {
    /// The name of the file; if no file matches, the name as written.
    pub(super) name: Vec<u8>,
    pub(super) placement: Placement,
    /// Options that would change the picture, but are not supported.
    pub(super) undrawn: Vec<&'static str>,
}

/// What is wrong with an option, and what to do.
pub(super) type Wrong = (String, &'static str);

/// How many words behind a name are searched for options.
const MOST_WORDS: usize = 32;

/// Reads the operand of `map_Kd`; `exists` tells whether there is a file of a name.
pub(super) fn read(operand: &[u8], exists: impl Fn(&[u8]) -> bool) -> Result<Map, Wrong> {
    let mut map = Map { name: operand.to_vec(), ..Map::default() };
    if exists(operand) {
        return Ok(map);
    }
    let mut rest = operand;
    while let Some(behind) = map.option(rest, true)? {
        rest = trimmed(behind);
    }
    // Shorter and shorter names, without a comment or options behind them.
    let mut shorter: Option<Map> = None;
    if !exists(rest) {
        let begins: Vec<usize> = words(rest).map(|(begin, _)| begin).skip(1).collect();
        for &begin in begins.iter().rev().take(MOST_WORDS) {
            let (name, behind) = (trimmed(&rest[..begin]), &rest[begin..]);
            let cut = match behind[0] {
                b'#' => Some(map.clone()),
                b'-' => map.clone().with_options(behind),
                _ => None,
            };
            if let Some(cut) = cut {
                shorter = Some(Map { name: name.to_vec(), ..cut });
                if exists(name) {
                    break;
                }
            }
        }
    }
    map.name = rest.to_vec();
    Ok(shorter.unwrap_or(map))
}

impl Map {
    /// Parses options only, if this is what they are.
    fn with_options(mut self, mut text: &[u8]) -> Option<Map> {
        while !text.is_empty() {
            text = trimmed(self.option(text, false).ok()??);
        }
        Some(self)
    }

    /// Parses the option that the text begins with, if any; returns the rest. `has_name` says whether a name must follow.
    fn option<'t>(&mut self, text: &'t [u8], has_name: bool) -> Result<Option<&'t [u8]>, Wrong> {
        // As many words as an option has, and one behind it.
        let words: Vec<(usize, usize)> = words(text).take(5).collect();
        let word = |i: usize| words.get(i).map_or(&b""[..], |&(begin, end)| &text[begin..end]);
        let behind = |i: usize| Ok(Some(words.get(i).map_or(&b""[..], |&(begin, _)| &text[begin..])));
        let option = word(0).to_ascii_lowercase();
        // The last word is the name.
        let most = words.len() - usize::from(has_name && !words.is_empty());
        let malformed = |remedy| (format!("`map_Kd` with {} {}", quote_bytes(word(0)), quote_bytes(word(1))), remedy);
        let is_on = || match &word(1).to_ascii_lowercase()[..] {
            b"on" => Ok(true),
            b"off" => Ok(false),
            _ => Err(malformed("give on or off after the option")),
        };
        match &option[..] {
            b"-s" | b"-o" | b"-t" => {
                let given: Vec<f64> = (1..most.min(4)).map_while(|i| parsed(word(i))).collect();
                let is_sound = !given.is_empty() && given.iter().all(|number| number.abs() < 1e30);
                if !is_sound {
                    return Err(malformed("give one to three finite numbers after the option"));
                }
                let number = |i: usize, other: f64| given.get(i).copied().unwrap_or(other);
                match option[1] {
                    b's' => self.placement.scale = dvec2(number(0, 1.0), number(1, 1.0)),
                    b'o' => self.placement.offset = dvec2(number(0, 0.0), number(1, 0.0)),
                    _ if given.iter().any(|&number| number != 0.0) => self.undrawn.push("map_Kd -t"),
                    _ => {}
                }
                behind(1 + given.len())
            }
            b"-clamp" => {
                self.placement.is_clamped = is_on()?;
                behind(2)
            }
            b"-blendu" | b"-blendv" if !is_on()? => {
                self.undrawn.push(if option[6] == b'u' { "map_Kd -blendu" } else { "map_Kd -blendv" });
                behind(2)
            }
            b"-cc" if is_on()? => {
                self.undrawn.push("map_Kd -cc");
                behind(2)
            }
            b"-mm" => {
                if [parsed(word(1)), parsed(word(2))] != [Some(0.0), Some(1.0)] {
                    self.undrawn.push("map_Kd -mm");
                }
                behind(3)
            }
            b"-boost" | b"-texres" => {
                self.undrawn.push(if option[1] == b'b' { "map_Kd -boost" } else { "map_Kd -texres" });
                behind(2)
            }
            // Options for other kinds of maps, and options that ask for what is drawn anyway.
            b"-blendu" | b"-blendv" | b"-cc" | b"-bm" | b"-imfchan" | b"-type" | b"-colorspace" => behind(2),
            _ => Ok(None),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(operand: &str) -> Map {
        read(operand.as_bytes(), |name| [&b"a b.png"[..], b"-x.png", b"2", b"c -s.png"].contains(&name)).expect("sound")
    }

    #[test]
    fn options_stand_before_a_name_or_behind_it() {
        let of = |scale: [f64; 2], offset: [f64; 2], is_clamped| Placement {
            scale: scale.into(),
            offset: offset.into(),
            is_clamped,
        };
        let cases = [
            ("a b.png", "a b.png", Placement::default()),
            ("-x.png", "-x.png", Placement::default()),
            ("c -s.png", "c -s.png", Placement::default()),
            ("-s 2 3 4 a b.png", "a b.png", of([2.0, 3.0], [0.0; 2], false)),
            ("-S 2 a b.png", "a b.png", of([2.0, 1.0], [0.0; 2], false)),
            ("-s 4 5 2", "2", of([4.0, 5.0], [0.0; 2], false)),
            ("-o .5 -s -1 1 1 -clamp on a b.png", "a b.png", of([-1.0, 1.0], [0.5, 0.0], true)),
            ("-clamp OFF -bm 1.5 -imfchan l a b.png", "a b.png", Placement::default()),
            ("a b.png -s 2 2 2 -clamp on", "a b.png", of([2.0; 2], [0.0; 2], true)),
            ("a b.png # -s 2 2 2", "a b.png", Placement::default()),
            ("-s 2 2 lost one.png", "lost one.png", of([2.0; 2], [0.0; 2], false)),
            ("lost - one.png -o 1", "lost - one.png", of([1.0; 2], [1.0, 0.0], false)),
            ("-foo 1 a b.png", "-foo 1 a b.png", Placement::default()),
            ("", "", Placement::default()),
            ("-clamp on", "", of([1.0; 2], [0.0; 2], true)),
        ];
        for (operand, name, placement) in cases {
            let map = map(operand);
            assert_eq!((String::from_utf8_lossy(&map.name), map.placement), (name.into(), placement), "{operand}");
        }
    }

    #[test]
    fn what_is_not_drawn_is_told_from_what_is_as_drawn() {
        let all = "-blendu off -blendv off -cc on -mm 0.1 1 -t 0 1 -boost 2 -texres 64 a b.png";
        let undrawn =
            ["-blendu", "-blendv", "-cc", "-mm", "-t", "-boost", "-texres"].map(|option| format!("map_Kd {option}"));
        assert_eq!(map(all).undrawn, undrawn);
        let as_drawn = "-blendu on -blendv on -cc off -mm 0 1 -t 0 0 0 -bm 9 -imfchan r -type sphere a b.png";
        assert_eq!((map(as_drawn).undrawn, &map(as_drawn).name[..]), (vec![], &b"a b.png"[..]));
    }

    #[test]
    fn malformed_options_are_refused() {
        let wrong = |operand: &str| read(operand.as_bytes(), |_| false).expect_err("malformed").0;
        assert_eq!(wrong("-s x a.png"), "`map_Kd` with `-s` `x`");
        assert_eq!(wrong("-o nan a.png"), "`map_Kd` with `-o` `nan`");
        assert_eq!(wrong("-clamp a.png"), "`map_Kd` with `-clamp` `a.png`");
    }
}
