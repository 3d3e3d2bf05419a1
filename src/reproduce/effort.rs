//! How much is measured: all that a page needs, or a quick look.

/// How much is measured, and of what.
#[derive(Clone, Copy)]
pub struct Effort {
    /// What random things follow from.
    pub seed: u64,
    /// The most random polygons, or vectors, of a kind. Where it is given, all else is small, too.
    pub most: Option<u64>,
}

impl Effort {
    /// Whether a quick look is enough.
    pub fn is_quick(&self) -> bool {
        self.most.is_some()
    }

    /// So many random polygons or vectors, or fewer.
    pub fn at_most(&self, count: u64) -> u64 {
        count.min(self.most.unwrap_or(u64::MAX))
    }

    /// What is said beside the statements of a quick look.
    pub fn note(&self) -> &'static str {
        match self.is_quick() {
            true => {
                "This is a quick look, in which more differs. The reasons given are those of the full page, with its numbers."
            }
            false => "",
        }
    }

    /// What makes the same page.
    pub fn command(&self, paper: &str, option: &str) -> String {
        let most = self.most.map_or(String::new(), |most| format!(" {option} {most}"));
        format!("tilewright reproduce {paper} -o report/ --seed {}{most}", self.seed)
    }
}
