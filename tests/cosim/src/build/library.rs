//! Steps that are blocks of the library, without streams.

use super::Builder;
use super::form::Colour;
use crate::features::Feature;
use crate::spec::*;
use tilewright_blocks::*;
use tilewright_hdl::*;

impl Builder<'_> {
    pub fn library(&mut self, d: usize, number: usize, library: &Library) {
        if library.block == LibraryBlock::Encoders {
            return self.encoders(d, library);
        }
        let (m, name) = (self.on(d), self.instance_name(number));
        let Library { block, width, picks: [enable, word, other, more] } = *library;
        let enable = self.pick_fit(d, enable, 1);
        let result = match block {
            LibraryBlock::Encoders => unreachable!("they are functions"),
            LibraryBlock::Counter => {
                Feature::Counter.used();
                let restart = self.pick_fit(d, word, 1);
                let CounterOut { count, wraps } =
                    m.instance(&name, &Counter::new(u64::from(width)), CounterIn { restart, enable });
                cat![wraps, count]
            }
            LibraryBlock::ShiftRegister => {
                Feature::ShiftRegister.used();
                let width = width + 1;
                let (load, word) = (self.pick_fit(d, other, 1), self.pick_fit(d, word, width));
                let into = ShiftRegisterIn { load, word, shift: enable, bit_in: self.pick_fit(d, more, 1) };
                let ShiftRegisterOut { held, bit_out } = m.instance(&name, &ShiftRegister::new(width), into);
                cat![bit_out, held]
            }
            LibraryBlock::Lfsr => {
                Feature::Lfsr.used();
                m.instance(&name, &Lfsr::new(2 + width % 31), LfsrIn { enable }).number
            }
            LibraryBlock::Shifter => {
                Feature::Shifter.used();
                let width = width + 1;
                let (word, places) = (self.pick_fit(d, word, width), self.pick_fit(d, other, below(width).bits()));
                let kind = self.pick_fit(d, more, 2).code::<Shifting>();
                // What enters says which way.
                let kind = mux(kind.is_code(), kind, Shifting::Right);
                m.instance(&name, &Shifter::new(width), ShifterIn { enable, word, places, kind }).shifted
            }
            LibraryBlock::Multiplier => {
                Feature::Multiplier.used();
                let stages = 1 + width % 3;
                let width = stages * (1 + width % 7);
                let [left, right] = [word, other].map(|pick| self.pick_fit(d, pick, width));
                m.instance(&name, &Multiplier::new(width, stages), MultiplierIn { enable, left, right }).product
            }
            LibraryBlock::Crc => {
                Feature::Crc.used();
                let order = if width % 2 == 0 { BitOrder::LeastFirst } else { BitOrder::MostFirst };
                let crc = Crc::new(8 + width % 9, 0x1d, u64::from(width), order);
                let (restart, data) = (self.pick_fit(d, other, 1), self.pick_fit(d, word, 8));
                m.instance(&name, &crc, CrcIn { restart, take: enable, data }).crc
            }
        };
        self.push(d, result);
    }

    /// Requests, the first of them, and its number.
    fn encoders(&mut self, d: usize, library: &Library) {
        Feature::Encoders.used();
        let [requests, index, ..] = library.picks;
        let requests = self.pick_fit(d, requests, 1 + library.width);
        let index = self.pick_fit(d, index, below(library.width).bits());
        self.push(d, first(requests));
        self.push(d, first_index(requests));
        self.push(d, one_hot(index, u64::from(library.width)));
        let colour = Meaning::Code.made_of(self.pick_fit(d, library.picks[2], 3));
        // Codes are numbers of places, too.
        self.push(d, one_hot(colour.bits(), Colour::Black.code() + 1));
    }
}
