//! Appendix F: memories that FPGAs build differently.

use tilewright_hdl::*;

block! {
    /// A memory of bytes with a port that writes and one that reads.
    pub struct Words {
        /// How many bytes.
        pub depth: u32,
        /// It is read at once, not at the edge.
        pub at_once: bool,
        /// What a read at the edge gives whose word is written.
        pub policy: ReadUnderWrite,
        /// No address reaches beyond the last word.
        pub in_bounds: bool,
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
        def!(words = m.memory(self.depth, 8, self.policy));
        let words = if self.in_bounds { words.in_bounds() } else { words };
        words.write(i.write, i.to, i.data);
        WordsOut { word: if self.at_once { words.read_async(i.from) } else { words.read(i.from) } }
    }
}

/// A memory of each kind.
pub const KINDS: [Words; 8] = [
    Words { at_once: true, ..BLOCK_RAM },
    Words { depth: 64, at_once: true, ..BLOCK_RAM },
    BLOCK_RAM,
    Words { depth: 512, ..BLOCK_RAM },
    Words { depth: 512, policy: ReadUnderWrite::Old, ..BLOCK_RAM },
    Words { depth: 512, policy: ReadUnderWrite::New, ..BLOCK_RAM },
    Words { depth: 400, ..BLOCK_RAM },
    Words { depth: 400, in_bounds: true, ..BLOCK_RAM },
];

/// The smallest memory that could be block RAM.
const BLOCK_RAM: Words = Words { depth: 16, at_once: false, policy: ReadUnderWrite::Any, in_bounds: false };

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
        let word = |(number, words): (usize, Words)| {
            let (to, from) = (i.to.trunc(below(words.depth)), i.from.trunc(below(words.depth)));
            let inputs = WordsIn { write: i.write, to, data: i.data, from };
            m.instance(&format!("u_words{number}"), &words, inputs).word
        };
        AllWordsOut { words: KINDS.into_iter().enumerate().map(word).collect() }
    }
}
