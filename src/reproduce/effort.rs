//! How much is measured: everything that a page needs, or a quick look.

/// How much is measured, and with which seed.
#[derive(Clone, Copy)]
pub struct Effort {
    /// The seed of all random choices.
    pub seed: u64,
    /// The most random polygons, or vectors, of a kind. If it is given, everything else is small, too.
    pub most: Option<u64>,
}

impl Effort {
    /// Whether a quick look is enough.
    pub fn is_quick(&self) -> bool {
        self.most.is_some()
    }

    /// The number of random polygons or vectors, within that limit.
    pub fn at_most(&self, count: u64) -> u64 {
        count.min(self.most.unwrap_or(u64::MAX))
    }

    /// The note beside the statements of a quick look.
    pub fn note(&self) -> &'static str {
        match self.is_quick() {
            true => {
                "This is a quick look, in which more statements differ. The reasons are those of the full page, with its numbers."
            }
            false => "",
        }
    }

    /// The command that makes the same page.
    pub fn command(&self, paper: &str, option: &str) -> String {
        let most = self.most.map_or(String::new(), |most| format!(" {option} {most}"));
        format!("tilewright reproduce {paper} -o report/ --seed {}{most}", self.seed)
    }
}
