//! The passes by name.

/// A pass on the way from a design to code, in sequence.
///
/// ```
/// use tilewright_sim::Pass;
///
/// assert!(Pass::Flatten < Pass::Fold && Pass::Fold < Pass::Sequence);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Pass {
    /// Replaces instances by their contents; each node of the description is a value.
    Flatten,
    /// Makes an array of separate instances of one module.
    Siblings,
    /// Merges names for one value, and equal expressions.
    Share,
    /// Computes constants and removes operations without effect.
    Fold,
    /// Computes once what is the same in all lanes.
    Uniform,
    /// Computes lanes together that are described one by one but computed alike.
    Lift,
    /// Splits words wider than a machine register into the fields that they consist of.
    Fields,
    /// Packs lanes of one bit into words.
    Pack,
    /// The changes of one edge of a clock.
    Edge,
    /// The same, with all inputs of up to 8 bits held at 0.
    Hold,
    /// Replaces operations that the machine lacks by those that it has.
    Lower,
    /// Orders scalars and loops over lanes.
    Plan,
    /// Puts branches around loops.
    Branch,
    /// Puts everything in sequence, cut into functions where it is long.
    Sequence,
    /// Makes loops over rows and strips of lanes.
    Loops,
    /// Writes the instructions: loads, vectors, branches, stores.
    Strips,
}

impl Pass {
    /// All of them, in sequence.
    ///
    /// ```
    /// use tilewright_sim::Pass;
    ///
    /// let by_name = |name: &str| Pass::ALL.into_iter().find(|pass| pass.name() == name);
    /// assert_eq!(by_name("fold"), Some(Pass::Fold));
    /// ```
    pub const ALL: [Pass; 16] = [
        Pass::Flatten,
        Pass::Siblings,
        Pass::Share,
        Pass::Fold,
        Pass::Uniform,
        Pass::Lift,
        Pass::Fields,
        Pass::Pack,
        Pass::Edge,
        Pass::Hold,
        Pass::Lower,
        Pass::Plan,
        Pass::Branch,
        Pass::Sequence,
        Pass::Loops,
        Pass::Strips,
    ];

    /// Its name, as `tilewright explain --pass` accepts it.
    ///
    /// ```
    /// use tilewright_sim::Pass;
    ///
    /// assert_eq!(Pass::ALL.map(Pass::name)[..3], ["flatten", "siblings", "share"]);
    /// ```
    pub fn name(self) -> &'static str {
        match self {
            Pass::Flatten => "flatten",
            Pass::Siblings => "siblings",
            Pass::Share => "share",
            Pass::Fold => "fold",
            Pass::Uniform => "uniform",
            Pass::Lift => "lift",
            Pass::Fields => "fields",
            Pass::Pack => "pack",
            Pass::Edge => "edge",
            Pass::Hold => "hold",
            Pass::Lower => "lower",
            Pass::Plan => "plan",
            Pass::Branch => "branch",
            Pass::Sequence => "sequence",
            Pass::Loops => "loops",
            Pass::Strips => "strips",
        }
    }

    /// Its effect, in a sentence.
    ///
    /// ```
    /// use tilewright_sim::Pass;
    ///
    /// assert_eq!(Pass::Share.about(), "Names for one value become one, and equal expressions are computed once.");
    /// ```
    pub fn about(self) -> &'static str {
        match self {
            Pass::Flatten => "Instances are replaced by their contents; each node of the description is a value.",
            Pass::Siblings => "Separate instances of one module run as an array.",
            Pass::Share => "Names for one value become one, and equal expressions are computed once.",
            Pass::Fold => "Constants are computed, and operations without effect are removed.",
            Pass::Uniform => "A value that is the same in all lanes, or in all rows, is computed once.",
            Pass::Lift => "Lanes that are described one by one but computed alike are computed together.",
            Pass::Fields => "Words wider than a machine register are split into the fields that they consist of.",
            Pass::Pack => "Lanes of one bit are packed into machine words.",
            Pass::Edge => "The changes of one edge of each clock.",
            Pass::Hold => "The same, with all inputs of up to 8 bits held at 0.",
            Pass::Lower => "Operations that the machine lacks are replaced by those that it has.",
            Pass::Plan => "Values of one lane stay in machine registers; loops go over lanes.",
            Pass::Branch => "A loop in which all lanes choose by one small value gets a variant for each number.",
            Pass::Sequence => "Everything is put in sequence, cut into functions where it is long.",
            Pass::Loops => {
                "Each loop goes over rows and strips of lanes; what is the same in all of them stands before it."
            }
            Pass::Strips => "Each function is a program of loops over strips of lanes, loads, vectors and stores.",
        }
    }
}
