//! The kinds of mistakes in a description, each with its number in the index of messages.

use std::fmt;

macro_rules! mistakes {
    ($($(#[$doc:meta])+ $name:ident = $number:literal,)+) => {
        /// What a description can get wrong. Each kind has a number, which ends the sentence of its
        /// [`Problem`](crate::Problem) and never changes: the index of messages in the guide lists cause and mend by it.
        ///
        /// The hundreds are the subjects: widths (1), signs and codes (2), registers, wires and memories (3), names (4),
        /// blocks and records (5), lanes (6), streams and pipelines (7), clocks (8), statements and edited circuits (9).
        ///
        /// ```
        /// # use tilewright_hdl::*;
        /// # block! {
        /// #     struct Half;
        /// #     in HalfIn { word: bits(8) }
        /// #     out HalfOut { half: bits(4) }
        /// # }
        /// # impl Half {
        /// #     fn build(&self, _: Module, i: HalfIn) -> HalfOut {
        /// HalfOut { half: i.word.slice(4..9) }
        /// #     }
        /// # }
        /// let problem = &elaborate(&Half).unwrap_err().0[0];
        /// assert_eq!(problem.mistake, Mistake::SliceOutside);
        /// assert_eq!(problem.mistake.to_string(), "T103");
        /// ```
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[non_exhaustive]
        pub enum Mistake {
            $($(#[$doc])+ $name = $number,)+
        }

        impl Mistake {
            /// All kinds, by number.
            ///
            /// ```
            /// # use tilewright_hdl::Mistake;
            /// assert!(Mistake::ALL.is_sorted());
            /// ```
            pub const ALL: &[Mistake] = &[$(Mistake::$name,)+];
        }
    };
}

mistakes! {
    /// Two widths meet that differ.
    UnequalWidths = 101,
    /// A number does not fit its width or sign.
    TooLarge = 102,
    /// A slice goes beyond the bits that there are.
    SliceOutside = 103,
    /// `.trunc` would widen.
    CutsNothing = 104,
    /// `.zext` or `.sext` would cut.
    WidensNothing = 105,
    /// A condition has several bits.
    WideCondition = 106,
    /// A width is 0.
    NoBits = 107,
    /// A width is above a million bits.
    TooWide = 108,
    /// A concatenation of nothing.
    EmptyConcatenation = 109,
    /// A shift by less than 0 bits.
    NegativeShift = 110,
    /// A rotation by less than 0 places.
    NegativeRotation = 111,
    /// A count is less than 0.
    NegativeCount = 112,
    /// A signal is repeated less than once.
    NoRepetition = 113,
    /// None of the values to choose from has a width.
    UnknownWidth = 114,
    /// A reset value, or a word of a memory, is not known while the block is built.
    NotConstant = 115,

    /// Numbers, signed values and codes meet.
    MixedKinds = 201,
    /// A minus sign before an unsigned number.
    UnsignedMinus = 202,
    /// `.zext` would lose a sign.
    LostSign = 203,
    /// Arithmetic with a code of an enum.
    ArithmeticOnCode = 204,
    /// Bits are read as a code of another width.
    CodeWidth = 205,
    /// A code of an enum is needed, but something else is given.
    NoCode = 206,
    /// A number is none of the codes of its enum.
    UnknownCode = 207,
    /// A key of `case` is no value of the subject.
    ImpossibleKey = 208,
    /// A key of `case`, or a code of `choose!`, occurs twice.
    RepeatedKey = 209,

    /// A register or wire has no driver.
    Undriven = 301,
    /// A register or wire has two drivers.
    DrivenTwice = 302,
    /// What is said once is said twice: a reset value, contents, an attribute.
    GivenTwice = 303,
    /// A chain of `.when` goes on after `.otherwise`.
    EndedChain = 304,
    /// A memory that has one write port gets a second one.
    SecondWritePort = 305,
    /// A memory has fewer words than its contents.
    TooMuchContents = 306,
    /// A memory has no words, or words of no bits.
    EmptyMemory = 307,
    /// A memory has more words than can be addressed.
    TooManyWords = 308,
    /// An address or a word of a memory has another width.
    MemoryWidth = 309,
    /// A value depends on itself within a clock.
    CombinationalLoop = 310,
    /// A path that comes back has too many lanes to be checked.
    UncheckedLoop = 311,
    /// An input is not used.
    UnusedInput = 312,

    /// Two things in a module have one name.
    TakenName = 401,
    /// A port is named by a reserved word.
    ReservedName = 402,
    /// A name has characters that no name has.
    IllegalName = 403,
    /// An instance has the name of something in it.
    HidingName = 404,
    /// Two blocks have one module name.
    ModuleNamedTwice = 405,
    /// The value of an attribute ends the attribute.
    AttributeEnd = 406,

    /// A parameter is out of its range.
    ParameterOutOfRange = 501,
    /// An output is not as it is declared.
    OutputDiffers = 502,
    /// An instance is fed something else than its input declares.
    InputDiffers = 503,
    /// A list has another length than is needed.
    ListLength = 504,
    /// A signal is used in another block than its own.
    ForeignSignal = 505,
    /// Instances nest without end.
    EndlessNesting = 506,
    /// A word does not have the bits of the record that it is unpacked to.
    RecordWidth = 507,
    /// A number stands where a record is needed.
    NumberForRecord = 508,
    /// A list of ports is too long.
    TooManyPorts = 509,
    /// A foreign module names a port that its block does not have.
    NoSuchPort = 510,
    /// The model of a foreign module has state, whose clock or reset is none of its ports.
    NoClockPort = 511,
    /// A foreign module without a model is simulated.
    NoModel = 512,
    /// A block without a circuit is no foreign module.
    NoForeignModule = 513,
    /// A parameter of a foreign module has no value in Verilog.
    NoValue = 514,
    /// A pad is not an instance of its own in the top.
    PadElsewhere = 515,
    /// The outside of a pad is not an input for it alone.
    PadOutside = 516,

    /// Two shapes meet that differ.
    UnequalShapes = 601,
    /// A row or a grid is needed.
    NeedsLanes = 602,
    /// There is no such lane.
    NoSuchLane = 603,
    /// A stack of nothing.
    EmptyStack = 604,
    /// The values for the lanes of a register are too few or too many.
    ValuesForLanes = 605,
    /// The lanes of a stack have different widths.
    UnequalLanes = 606,
    /// A shape would have three axes.
    ThreeAxes = 607,
    /// A shape has no lanes.
    NoLanes = 608,
    /// A shape has too many lanes.
    TooManyLanes = 609,
    /// A word cannot be cut into lanes of equal widths.
    UnevenCut = 610,
    /// Wires cannot follow the rule of `.take`.
    UnfollowedRule = 611,
    /// What goes along with lanes is laid out in another way.
    OtherLayout = 612,
    /// The fields of a record in lanes, or in a memory, have different lanes.
    UnequalFields = 613,

    /// A stream has no receiver.
    UntakenStream = 701,
    /// A stream has two receivers.
    TakenTwice = 702,
    /// A signal is used as a stream's `ready`.
    NoStream = 703,
    /// A sender waits for its receiver.
    WaitingSender = 704,
    /// A stream is taken by lanes that it does not have, or would be moved to others.
    StreamLanes = 705,
    /// Two stages of a pipeline meet.
    MixedStages = 751,
    /// A stage does not take what the one before it gave.
    SkippedStage = 752,
    /// A latency is stated that is not the one counted.
    WrongLatency = 753,
    /// A pipeline has too many stages.
    TooManyStages = 754,

    /// A signal of one clock reaches another.
    Crossing = 801,
    /// An input does not say on which of several clocks it is.
    UnknownClock = 802,
    /// An output depends on two clocks.
    MixedClocks = 803,
    /// Logic enters a synchronizer.
    GlitchySynchronizer = 804,
    /// A clock has two periods.
    TwoPeriods = 805,
    /// A period is too long.
    LongPeriod = 806,
    /// An output is declared on a clock.
    OutputOnClock = 807,
    /// A clock is made elsewhere than once in the top.
    MadeClock = 808,
    /// A clock resets in two ways.
    TwoResets = 809,
    /// A clock acts on two edges.
    TwoEdges = 810,
    /// What is within `enabled` runs on another clock.
    EnabledElsewhere = 831,
    /// A clock runs in place of one with another period.
    OtherPeriod = 832,
    /// A foreign module runs in an enabled part.
    EnabledForeign = 833,

    /// Two covers have one name.
    SecondCover = 901,
    /// A circuit that was edited breaks a rule.
    BrokenRule = 902,
    /// A design is too large.
    TooLargeDesign = 903,
    /// The text of a display does not show its values.
    DisplayText = 911,
}

/// The number, as it stands in messages and in their index.
impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(&format!("T{}", *self as u16))
    }
}
