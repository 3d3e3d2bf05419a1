//! Steps that hold a record: in a register, in the words of a memory, in the stages of a pipeline.

use super::{Builder, Kind, Late, narrow};
use crate::features::Feature;
use crate::spec::*;
use tilewright_hdl::*;

bundle! {
    /// Two values.
    pub struct Pair<T> {
        pub low: T,
        pub high: T,
    }

    /// A field, an array of records, and a list.
    pub struct Mixed<T> {
        pub head: T,
        pub pairs: [Pair<T>; 2],
        pub rest: Vec<T>,
    }
}

impl Records {
    /// The form of each field.
    fn forms(&self) -> Mixed<Form> {
        let [head, low, high, rest] = self.forms;
        Mixed { head, pairs: [Pair { low, high }; 2], rest: vec![rest; self.list as usize] }
    }

    fn layout(&self) -> Mixed<Width> {
        self.forms().map(|form| form.layout())
    }

    fn has_codes(&self) -> bool {
        self.forms.iter().any(|form| form.meaning == Meaning::Code)
    }

    /// The pattern in each field, as a description writes it.
    fn constant(&self, pattern: Pattern) -> Mixed<Value> {
        self.forms().map(|form| form.meaning.constant(pattern, form.width))
    }
}

/// A value for each field.
fn each(pick: Pick) -> impl FnMut() -> Pick {
    let mut picks = (0..).map(move |field: u16| Pick(pick.0.wrapping_add(field.wrapping_mul(3))));
    move || picks.next().expect("a record has few fields")
}

impl Builder<'_> {
    pub fn records(&mut self, d: usize, number: usize, records: &Records) {
        let (layout, [head, low, ..]) = (records.layout(), records.forms.map(|form| form.meaning));
        records.forms.iter().for_each(|form| form.meaning.used(Feature::SignedField, Feature::CodeField));
        let paths: Vec<String> =
            layout.leaves().iter().map(|(path, _)| format!("_{}", path.replace('.', "_"))).collect();
        let mut name =
            |plain: &str, ends: &[String]| self.namer.draw_with(&format!("e{number}{plain}"), Kind::Inner, ends);
        let [register_name, read_name, net_name] = ["", "_found", "_net"].map(|plain| name(plain, &paths));
        let memory_name = name("_words", &["_read".to_owned()]);
        let staged = |stage| paths.iter().map(move |path| format!("{path}{stage}"));
        let pipe_name = name("_pipe", &(1..=records.stages).flat_map(staged).collect::<Vec<_>>());
        let full = (1..=records.stages).map(|stage| format!("_full{stage}"));
        let stream_name = name("_stream", &(1..=records.stages).flat_map(staged).chain(full).collect::<Vec<_>>());

        let m = self.on(d);
        let mut register = m.reg(&register_name, layout.clone());
        if let Some(reset) = records.reset {
            register = register.reset(records.constant(reset));
        }
        if let Some(initial) = records.initial {
            Feature::InitialOfARecord.used();
            register = register.initial(records.constant(initial));
        }
        if records.attribute {
            Feature::AttributeOfARecord.used();
            register = register.attribute("keep", "true");
        }
        self.push_fields(d, &register);

        let contents = records.contents.iter().take(records.depth as usize).map(|word| records.constant(*word));
        let memory = m.memory(&memory_name, records.depth, layout.clone(), ReadUnderWrite::Old).words(contents);
        let [read, enable, write] = records.ports;
        let read = self.pick_fit(d, read, memory.address_width());
        let found = if records.asynchronous { memory.read_async(read) } else { memory.read(read) }.named(&read_name);
        let (enable, write) = (self.pick_fit(d, enable, 1), self.pick_fit(d, write, memory.address_width()));
        memory.write(enable, write, register.clone());

        let wire = m.wire(&net_name, layout.clone());
        // Among what is chosen from, 0 is no code.
        let zero = records.constant(Pattern::Zero);
        let kept = match records.has_codes() {
            true => select(arms![found.head.any_one() => register.clone()], zero),
            false => select(arms![found.head.any_one() => register.clone()], 0),
        };
        wire.drive(mux(enable, found.clone(), kept));
        // What is found enters a pipeline below, and later steps may look records up by it, a stage behind.
        self.push(d, narrow(layout.unpack(wire.pack()).pack()).any_stage());
        self.push_fields(d, &found.any_stage());

        let accepts = found.head.any_one();
        // A code cannot be cleared.
        let cleared = |start: Mixed<usize>| {
            let fields = [(head, start.head), (low, start.pairs[1].low)].into_iter();
            fields.filter(|(meaning, _)| *meaning != Meaning::Code).map(|(_, field)| field).collect::<Vec<_>>()
        };
        let start = found.cleared(cleared);
        let stage = |stage, now: Mixed| {
            let [left, right] = now.pairs;
            let pairs = [right, Pair { low: if stage % 2 == 0 { left.low } else { low.changed(left.low) }, ..left }];
            Mixed { pairs, ..now }
        };
        let last = m.within(&pipe_name, || m.stages(records.stages, enable, start, stage));
        // Later steps let these meet what entered.
        self.push_fields(d, &last.any_stage());

        let (sent, _) = m.offer(enable, last.clone());
        let stage = |_, now: Mixed| {
            let [left, right] = now.pairs;
            Mixed { pairs: [right, left], head: head.changed(now.head), ..now }
        };
        let taken = m.within(&stream_name, || m.stream_stages(records.stages, sent, stage));
        let taken = taken.take_when(accepts);
        self.push(d, taken.taken.any_stage());
        self.push_fields(d, &taken.any_stage());
        self.late.push((d, Late::Records { register, records: records.clone() }));
    }

    fn push_fields(&mut self, d: usize, record: &Mixed) {
        record.leaves().into_iter().for_each(|(_, signal)| self.push(d, signal));
    }

    /// What the record's register takes.
    pub fn update_record(&self, d: usize, register: &Reg<Mixed>, records: &Records) {
        let value = |pick: Pick| {
            let mut pick = each(pick);
            records.forms().map(|form| form.meaning.made_of(self.pick_late(d, pick(), form.width())))
        };
        let condition = |pick: Pick| self.pick_late(d, pick, 1);
        let Some(((first, taken), rest)) = records.updates.split_first() else {
            return match records.otherwise {
                Some(otherwise) => register.next(value(otherwise)),
                None => register.next(0),
            };
        };
        let mut chain = match taken {
            Some(taken) => register.when(condition(*first), value(*taken)),
            None => register.when(condition(*first), 0),
        };
        for (when, taken) in rest {
            chain = match taken {
                Some(taken) => chain.when(condition(*when), value(*taken)),
                None => chain.when(condition(*when), records.constant(Pattern::Alternating)),
            };
        }
        if let Some(otherwise) = records.otherwise {
            chain.otherwise(value(otherwise));
        }
    }
}
