//! Steps that are instances of a block declared by `block!`, with records and lists of records for ports, alone and in arrays whose lanes get
//! constant records.

use super::records::Pair;
use super::{Builder, Kind};
use crate::features::Feature;
use crate::spec::*;
use crate::stimulus::Numbers;
use tilewright_hdl::*;

block! {
    /// Holds a record, and mixes it with those of a list.
    pub struct Mixer {
        low: u32,
        high: u32,
        meaning: Meaning,
        list: u32,
    }
    in(self) MixerIn {
        /// What it takes.
        pair: Pair = self.pair(),
        /// What it is mixed with.
        list: [Pair = self.pair(); self.list],
        /// When, and what is added.
        control: pub struct Control {
            /// It takes.
            takes: bit(),
            /// What is added to the lower field.
            adds: self.pair().low,
        },
    }
    out(self) MixerOut {
        /// What it holds.
        held: Pair = self.pair(),
        /// The list, mixed.
        mixed: [Pair] = _,
        /// All of it has some bit.
        any: _,
    }
}

impl Mixer {
    /// What its fields are; the lower one is computed with, which codes are not.
    fn forms(&self) -> Pair<Form> {
        let low = if self.meaning == Meaning::Code { Meaning::Number } else { self.meaning };
        Pair { low: Form { width: self.low, meaning: low }, high: Form { width: self.high, meaning: self.meaning } }
    }

    fn pair(&self) -> Pair<Width> {
        self.forms().map(|form| form.layout())
    }

    fn build(&self, m: Module, i: MixerIn) -> MixerOut {
        def!(held = m.reg(self.pair()).reset(0));
        def!(turned = m.toggle(i.control.takes));
        let high = |pair: Pair| match self.meaning {
            Meaning::Code => mux(turned, pair.high, held.high),
            Meaning::Number | Meaning::Signed => pair.high & !held.high,
        };
        let mixed: Vec<Pair> = i.list.iter().map(|pair| Pair { low: pair.low ^ held.low, high: high(*pair) }).collect();
        held.when(i.control.takes, Pair { low: i.pair.low + i.control.adds, ..i.pair });
        def!(some = held.low.any_one());
        let any = mixed.iter().fold(some, |any, pair| any & pair.low.ne(0) | pair.high.all_ones());
        MixerOut { held: *held, mixed, any }
    }
}

impl Builder<'_> {
    pub fn declared(&mut self, d: usize, number: usize, declared: &Declared) {
        let Declared { widths: [low, high], meaning, list, lanes, numbers, picks: [takes, adds, pair, others] } =
            *declared;
        meaning.used(Feature::SignedPort, Feature::CodePort);
        meaning.used(Feature::SignedField, Feature::CodeField);
        let mixer = Mixer { low, high, meaning, list };
        let forms = mixer.forms();
        let mut pair_of = |pick: Pick| {
            let mut pick = (0..).map(|more| Pick(pick.0.wrapping_add(more)));
            forms.map(|form| {
                let pick = pick.next().expect("endless");
                self.pick_fit_as(d, pick, form.meaning, form.width)
            })
        };
        let pair = pair_of(pair);
        let list = (0..list as u16).map(|place| pair_of(Pick(others.0.wrapping_add(2 * place)))).collect();
        let adds = self.pick_fit_as(d, adds, forms.low.meaning, low);
        let control = Control { takes: self.pick_fit(d, takes, 1), adds };
        if lanes == 0 {
            let name = self.instance_name(number);
            let MixerOut { held, mixed, any } = self.on(d).instance(&name, &mixer, MixerIn { pair, list, control });
            let fields = mixed.into_iter().chain([held]).flat_map(|pair| [pair.low, pair.high]);
            fields.chain([any]).for_each(|signal| self.push(d, signal));
            return;
        }
        let number_of = |lane: u32, form: Form| {
            let bits = Numbers(numbers.wrapping_add(lane.into())).bits(form.width.min(64));
            let number = i128::from(bits.limbs()[0]);
            match form.meaning {
                Meaning::Number => number,
                Meaning::Signed => bits.to_i128().expect("at most 64 bits"),
                Meaning::Code => number % 5,
            }
        };
        let layout = mixer.pair().map(|width| width.of(row(lanes)));
        let own =
            constants(layout, |lane| Pair { low: number_of(lane, forms.low), high: number_of(!lane, forms.high) });
        let name = self.namer.draw(&format!("u{}_{number}", self.block.index), Kind::Inner);
        let module = self.on(d);
        let out = module.array(&name, lanes, &mixer, |mixers| {
            // What a lane holds goes on to the next one, for those that take nothing of their own.
            let held = Pair { low: mixers.held.low.previous(pair.low), high: mixers.held.high.previous(pair.high) };
            MixerIn { pair: mux(own.low.bit(0), own, held), list: list.clone(), control }
        });
        for lanes in out.mixed.into_iter().chain([out.held]).flat_map(|pair| [pair.low, pair.high]).chain([out.any]) {
            self.push(d, lanes.bits().xor_all());
            self.rows[d].push(lanes.bits());
        }
    }
}
