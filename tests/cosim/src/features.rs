//! Features of the language that random designs use, noted while a design is built: the circuit does not tell most of them apart.

use std::cell::RefCell;
use std::collections::BTreeSet;
use tilewright_hdl::Reset;

macro_rules! features {
    ($($name:ident)*) => {
        /// A feature of the language, or a block of the library.
        #[allow(missing_docs, reason = "each has the name of what it is")]
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Feature { $($name),* }

        impl Feature {
            /// Every feature.
            pub const ALL: &[Feature] = &[$(Feature::$name),*];
        }
    };
}

features! {
    SignedPort SignedRegister SignedWire SignedField SignedWord SignedArm SignedPipe SignedShift SignedNumber
    CodePort CodeRegister CodeWire CodeField CodeWord CodeArm CodePipe CodeLanes
    Is IsCode ChooseASignal ChooseARecord ChooseByLanes
    Leaves Enters Goes Constants
    Rom Toggle AttributeOfARegister AttributeOfAMemory AttributeOfARecord
    Hex Binary NumberOnTheLeft ProductWithANumber
    Assigned Implies PipeWhen PipeOfARecord SynchronizeFrom RotateLeft RotateRight
    MixedArmsOfSelect MixedArmsOfCase Part Low Def
    InitialOfLanes InitialOfARecord ResetEach TakeOr Interleave TreeOfRecords
    CrossByFifo StreamStages ForkToMany SplitToMany ArbiterOfMany CodeInAStream SignedInAStream
    Counter ShiftRegister Lfsr Encoders Shifter Multiplier Crc
    Enabled Displayed WriteFirst Foreign
    InputPad OutputPad OpenDrain BothWays PullUp Renamed NamesItsClocks CalledAgain
    Synchronous SynchronousLow Asynchronous AsynchronousLow PowerOn Falling
    InitialInShapes UpdatesInShapes RecordInShapes CoverInShapes PastInShapes
}

thread_local! {
    static USED: RefCell<BTreeSet<Feature>> = const { RefCell::new(BTreeSet::new()) };
}

impl Feature {
    /// Notes that the design that is being built uses it.
    pub fn used(self) {
        USED.with_borrow_mut(|used| used.insert(self));
    }
}

impl From<Reset> for Feature {
    fn from(reset: Reset) -> Feature {
        match reset {
            Reset::Synchronous => Feature::Synchronous,
            Reset::SynchronousLow => Feature::SynchronousLow,
            Reset::Asynchronous => Feature::Asynchronous,
            Reset::AsynchronousLow => Feature::AsynchronousLow,
            Reset::PowerOn => Feature::PowerOn,
        }
    }
}

/// What `build` gives, and the features that it uses.
pub fn used_by<T>(build: impl FnOnce() -> T) -> (T, BTreeSet<Feature>) {
    USED.take();
    let built = build();
    (built, USED.take())
}
