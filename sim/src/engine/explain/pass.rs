//! The passes by name.

/// A pass on the way from a design to code, in the order in which they are made.
///
/// ```
/// use tilewright_sim::Pass;
///
/// assert!(Pass::Flatten < Pass::Fold && Pass::Fold < Pass::Sequence);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Pass {
    /// Instances are put in their places; each node of the description is a value.
    Flatten,
    /// Instances of one module that were written one by one become an array.
    Siblings,
    /// Names for one value become one, and equal expressions too.
    Share,
    /// Constants are computed, and operations that do nothing left out.
    Fold,
    /// What is the same in all lanes is computed once.
    Uniform,
    /// Lanes that are computed alike, but were written one by one, are computed together.
    Lift,
    /// Words wider than a register of the machine are split into the fields that they are made of.
    Fields,
    /// Lanes of one bit are packed in words.
    Pack,
    /// What one edge of a clock does.
    Edge,
    /// The same, where all inputs of up to 8 bits are held at 0.
    Hold,
    /// Operations that the machine has take the place of those that it has not.
    Lower,
    /// Values of one lane and loops over lanes are put in order.
    Plan,
    /// Loops get branches around them.
    Branch,
    /// Everything is one after the other, cut into functions where it is long.
    Sequence,
}

impl Pass {
    /// All of them, in order.
    ///
    /// ```
    /// use tilewright_sim::Pass;
    ///
    /// let by_name = |name: &str| Pass::ALL.into_iter().find(|pass| pass.name() == name);
    /// assert_eq!(by_name("fold"), Some(Pass::Fold));
    /// ```
    pub const ALL: [Pass; 14] = [
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
    ];

    /// Its name, as `tilewright explain --pass` takes it.
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
        }
    }

    /// What it does, in a sentence.
    ///
    /// ```
    /// use tilewright_sim::Pass;
    ///
    /// assert_eq!(Pass::Share.about(), "Names for one value become one, and equal expressions are computed once.");
    /// ```
    pub fn about(self) -> &'static str {
        match self {
            Pass::Flatten => "Instances are put in their places; each node of the description is a value.",
            Pass::Siblings => "Instances of one module that were written one by one run as an array.",
            Pass::Share => "Names for one value become one, and equal expressions are computed once.",
            Pass::Fold => "Constants are computed, and operations that do nothing are left out.",
            Pass::Uniform => "What is the same in all lanes, or in all rows, is computed once.",
            Pass::Lift => "Lanes that are computed alike, but were written one by one, are computed together.",
            Pass::Fields => {
                "Words wider than a register of the machine are split into the fields that they are made of."
            }
            Pass::Pack => "The bits of lanes that have one each are packed in words of the machine.",
            Pass::Edge => "What one edge of each clock does.",
            Pass::Hold => "The same, where all inputs of up to 8 bits are held at 0.",
            Pass::Lower => "Operations that the machine has take the place of those that it has not.",
            Pass::Plan => "Values of one lane stay in registers of the machine; loops go over lanes.",
            Pass::Branch => "A loop in which all lanes choose by one small value has a variant for each number.",
            Pass::Sequence => "Everything stands one after the other, cut into functions where it is long.",
        }
    }
}
