//! Appendix F: memories that FPGAs build differently.

use tilewright_hdl::*;

block! {
    /// A memory of bytes with a port that writes and one that reads.
    pub struct Words {
        /// How many bytes.
        pub depth: u32,
        /// It is read at once, not at the edge.
        pub at_once: bool,
        /// What a read at the edge gives whose word is written: the old word, or anything.
        pub old: bool,
    }
    in(self) WordsIn {
        /// Writes.
        write: bit(),
        /// Where.
        to: below(self.depth),
        /// What.
        data: bits(8),
        /// Where it reads.
        from: below(self.depth),
    }
    out WordsOut {
        /// What it reads.
        word: bits(8),
    }
}

impl Words {
    fn build(&self, m: Module, i: WordsIn) -> WordsOut {
        let policy = if self.old { ReadUnderWrite::Old } else { ReadUnderWrite::Any };
        def!(words = m.memory(self.depth, 8, policy));
        words.write(i.write, i.to, i.data);
        WordsOut { word: if self.at_once { words.read_async(i.from) } else { words.read(i.from) } }
    }
}

/// A memory of each kind: depth, whether it is read at once, whether it gives the old word.
pub const KINDS: [(u32, bool, bool); 5] =
    [(16, true, false), (64, true, false), (16, false, false), (512, false, false), (512, false, true)];

block! {
    /// A memory of each kind, for one run of a synthesizer.
    pub struct AllWords;
    in AllWordsIn {
        /// As of [`Words`].
        write: bit(),
        /// As of [`Words`].
        to: bits(9),
        /// As of [`Words`].
        data: bits(8),
        /// As of [`Words`].
        from: bits(9),
    }
    out AllWordsOut {
        /// The word of each.
        words: [bits(8); KINDS.len()],
    }
}

impl AllWords {
    fn build(&self, m: Module, i: AllWordsIn) -> AllWordsOut {
        let word = |(number, (depth, at_once, old))| {
            let (to, from) = (i.to.trunc(below(depth)), i.from.trunc(below(depth)));
            let inputs = WordsIn { write: i.write, to, data: i.data, from };
            m.instance(&format!("u_words{number}"), &Words { depth, at_once, old }, inputs).word
        };
        AllWordsOut { words: KINDS.into_iter().enumerate().map(word).collect() }
    }
}
