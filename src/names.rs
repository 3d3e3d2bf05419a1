//! Names on the command line: `_` and `-` mean the same, and the error for a wrong name suggests a similar one.

use clap::builder::{PossibleValue, TypedValueParser};
use clap::error::ErrorKind;
use clap::{Arg, Command, Error, ValueEnum};
use std::ffi::OsStr;

/// The least similarity of a suggested name, from 0 to 1. clap uses 0.7 for options, by which `nothing` is near `join`.
const NEAR: f64 = 0.75;

/// A parser of one of several names; completions get all of them.
#[derive(Clone)]
pub struct Names<T> {
    /// The kind of thing that is named, such as `machine`.
    what: &'static str,
    all: Vec<(PossibleValue, T)>,
    /// The command that lists all names, if they are too many for a sentence.
    list: Option<&'static str>,
}

impl<T> Names<T> {
    /// The names of some values.
    pub fn new(what: &'static str, all: impl IntoIterator<Item = (&'static str, T)>) -> Names<T> {
        Names::described(what, all.into_iter().map(|(name, value)| (PossibleValue::new(name), value)))
    }

    /// The names of some values that the help describes.
    pub fn described(what: &'static str, all: impl IntoIterator<Item = (PossibleValue, T)>) -> Names<T> {
        Names { what, all: all.into_iter().collect(), list: None }
    }

    /// Makes errors name this command instead of all names.
    pub fn listed_by(self, command: &'static str) -> Names<T> {
        Names { list: Some(command), ..self }
    }
}

/// The names of an enum.
pub fn of<T: ValueEnum>(what: &'static str) -> Names<T> {
    let all = T::value_variants().iter().filter_map(|value| Some((value.to_possible_value()?, value.clone())));
    Names::described(what, all)
}

impl<T: Clone> Names<T> {
    /// What a name means.
    ///
    /// # Errors
    /// There is no such name; the sentence suggests one.
    pub fn find(&self, given: &OsStr) -> Result<T, String> {
        let given = given.to_string_lossy();
        let found = self.all.iter().find(|(name, _)| are_alike(&given, name.get_name()));
        found.map(|(_, value)| value.clone()).ok_or_else(|| {
            let known: Vec<&str> = self.all.iter().map(|(name, _)| name.get_name()).collect();
            let lead = format!("there is no {} `{given}`", self.what);
            match self.list {
                Some(command) => not_listed(&lead, &given, &known, command),
                None => unknown(&lead, &given, &known),
            }
        })
    }
}

impl<T: Clone + Send + Sync + 'static> TypedValueParser for Names<T> {
    type Value = T;

    fn parse_ref(&self, _: &Command, _: Option<&Arg>, given: &OsStr) -> Result<T, Error> {
        self.find(given).map_err(|sentence| Error::raw(ErrorKind::InvalidValue, sentence + "\n"))
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(self.all.iter().map(|(name, _)| name.clone())))
    }
}

/// Whether two names are equal except for `_` and `-`.
pub fn are_alike(given: &str, known: &str) -> bool {
    let plain = |c| if c == '_' { '-' } else { c };
    given.chars().map(plain).eq(known.chars().map(plain))
}

/// The name that is most similar to a wrong one, if any is.
pub fn near<'a>(given: &str, known: &[&'a str]) -> Option<&'a str> {
    let plain = |name: &str| name.to_lowercase().replace('_', "-");
    let given = plain(given);
    let likeness = |name: &str| strsim::jaro(&given, &plain(name));
    let near = known.iter().map(|name| (likeness(name), *name)).filter(|(likeness, _)| *likeness > NEAR);
    // The first of equally similar ones.
    near.rev().max_by(|(left, _), (right, _)| left.total_cmp(right)).map(|(_, name)| name)
}

/// The sentence for a wrong name: `lead`, which says what is wrong, then a similar name, then all names.
pub fn unknown(lead: &str, given: &str, known: &[&str]) -> String {
    let all = known.join(", ");
    match near(given, known) {
        Some(name) => format!("{lead}: did you mean `{name}`? There are {all}"),
        None => format!("{lead}: give one of {all}"),
    }
}

/// As [`unknown`], with a command that lists all names.
pub fn not_listed(lead: &str, given: &str, known: &[&str], command: &str) -> String {
    match near(given, known) {
        Some(name) => format!("{lead}: did you mean `{name}`? `{command}` shows all names"),
        None => format!("{lead}: `{command}` shows all names"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::entries;
    use crate::machine::Machine;

    fn parsed<T: Clone + Send + Sync + 'static>(names: &Names<T>, given: &str) -> Result<T, String> {
        names.parse_ref(&Command::new("test"), None, OsStr::new(given)).map_err(|error| error.to_string())
    }

    #[test]
    fn underscores_and_hyphens_are_alike() {
        let machines = of::<Machine>("machine");
        for name in ["pixel-planes-5", "pixel_planes_5", "pixel-planes_5"] {
            assert_eq!(parsed(&machines, name), Ok(Machine::PixelPlanes), "{name}");
        }
        assert!(parsed(&machines, "pixelplanes5").is_err());
        let blocks: Vec<&str> = entries().map(|entry| entry.name).collect();
        for (i, name) in blocks.iter().enumerate() {
            assert!(!blocks[..i].iter().any(|other| are_alike(name, other)), "{name} is the name of two blocks");
        }
    }

    #[test]
    fn a_wrong_name_is_answered_with_the_nearest() {
        let machines = of::<Machine>("machine");
        let all = "vc1, quadtree, pixel-planes-5, pixelflow\n";
        for (given, sentence) in [
            ("quad_tree", "there is no machine `quad_tree`: did you mean `quadtree`? There are "),
            ("VC1", "there is no machine `VC1`: did you mean `vc1`? There are "),
            ("riva128", "there is no machine `riva128`: give one of "),
            ("", "there is no machine ``: give one of "),
        ] {
            assert_eq!(parsed(&machines, given), Err(format!("error: {sentence}{all}")));
        }
        let few = Names::new("block", [("fifo", 1), ("lifo", 2)]).listed_by("tilewright list blocks");
        assert_eq!(parsed(&few, "lifo"), Ok(2));
        let sentence =
            "error: there is no block `fif`: did you mean `fifo`? `tilewright list blocks` shows all names\n";
        assert_eq!(parsed(&few, "fif"), Err(sentence.to_owned()));
        assert_eq!(
            parsed(&few, "crt"),
            Err("error: there is no block `crt`: `tilewright list blocks` shows all names\n".to_owned())
        );
    }

    #[test]
    fn of_names_equally_near_the_first_is_suggested() {
        assert_eq!(near("fef", &["fif", "faf"]), Some("fif"));
        assert_eq!(near("xyz", &["fif", "faf"]), None);
    }
}
