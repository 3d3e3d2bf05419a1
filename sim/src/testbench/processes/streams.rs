//! Processes on streams: sending, receiving, comparing and watching.

use std::fmt::Debug;
use std::future::Future;

use tilewright_circuit::{Bits, Loc};
use tilewright_hdl::{Fields, Leaf, Stream, Visited};

use super::{Pauses, Testbench};
use crate::testbench::port::{IntoValue, Port};

impl Testbench<'_> {
    /// Sends a word to the block: offers it until the block takes it. Two words in sequence take two clocks. The
    /// values have one type, any that [`Testbench::set`] accepts, such as `i64` for negative numbers.
    ///
    /// ```
    /// # use tilewright_sim::{Pauses, Simulation, for_examples::Increment};
    /// # let mut sim = Simulation::of(&Increment)?;
    /// # sim.reset();
    /// # let start = sim.time();
    /// let (words, sums, t) = (sim.i.words, sim.o.sums, sim.testbench());
    /// t.run((t.send(words, 7), t.expect_all(sums, [8], Pauses::NONE)));
    /// assert_eq!(t.time(), start + 20_000);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// A negative word is a signed integer. All numbers of a record have one type, so a code among them is cast:
    /// `Step { operation: Operation::Add as i64, least: -3 }`.
    ///
    /// # Panics
    ///
    /// A value does not fit, or a list is not as long as that of the ports.
    #[track_caller]
    pub fn send<P: Fields<Port>, V: IntoValue + Leaf>(
        &self,
        stream: Stream<P, Port>,
        word: P::With<V>,
    ) -> impl Future<Output = ()> {
        let loc = Loc::caller();
        async move { self.send_at::<P, V>(&stream, &word, loc).await }
    }

    /// Like [`Testbench::send`], for a word with values wider than 64 bits.
    ///
    /// ```
    /// # use tilewright_hdl::Bits;
    /// # use tilewright_sim::{Simulation, for_examples::Increment};
    /// # let mut sim = Simulation::of(&Increment)?;
    /// # sim.reset();
    /// let (words, sums, t) = (sim.i.words, sim.o.sums, sim.testbench());
    /// let (seen, ()) = t.run((t.receive_bits(sums), t.send_bits(words, Bits::new(8, 7))));
    /// assert_eq!(seen, Bits::new(8, 8));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// As [`Testbench::send`].
    #[track_caller]
    pub fn send_bits<P: Fields<Port>>(&self, stream: Stream<P, Port>, word: P::With<Bits>) -> impl Future<Output = ()> {
        let loc = Loc::caller();
        async move { self.send_at::<P, Bits>(&stream, &word, loc).await }
    }

    /// Receives a word from the block: takes the first one that it offers.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Increment};
    /// # let mut sim = Simulation::of(&Increment)?;
    /// # sim.reset();
    /// # let start = sim.time();
    /// let (words, sums, t) = (sim.i.words, sim.o.sums, sim.testbench());
    /// let (seen, ()) = t.run((t.receive(sums), t.send(words, 7)));
    /// assert_eq!(seen, 8);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// A value does not fit in 64 bits.
    #[track_caller]
    pub fn receive<P: Fields<Port>>(&self, stream: Stream<P, Port>) -> impl Future<Output = P::With<u64>> {
        let loc = Loc::caller();
        async move { self.receive_at(&stream, loc).await }
    }

    /// Like [`Testbench::receive`], with negative numbers: signed fields are read in two's complement.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_sim::Simulation;
    /// block! {
    ///     /// Negates each number.
    ///     struct Negate;
    ///     in NegateIn { numbers: stream(bits(8).signed()) }
    ///     out NegateOut { negated: stream(bits(8).signed()) }
    /// }
    ///
    /// impl Negate {
    ///     fn build(&self, m: Module, i: NegateIn) -> NegateOut {
    ///         def!(full = m.reg(bit()).reset(0));
    ///         def!(negative = m.reg(bits(8).signed()));
    ///         let (negated, sent) = m.offer(full, *negative);
    ///         let numbers = i.numbers.take_when(!full | sent);
    ///         negative.when(numbers.taken, -*numbers);
    ///         full.when(numbers.taken, 1).when(sent, 0);
    ///         NegateOut { negated }
    ///     }
    /// }
    ///
    /// let mut sim = Simulation::of(&Negate)?;
    /// sim.reset();
    /// let (numbers, negated, t) = (sim.i.numbers, sim.o.negated, sim.testbench());
    /// let ((), seen) = t.run((t.send(numbers, 3), t.receive_i64(negated)));
    /// assert_eq!(seen, -3);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// A value with its sign does not fit in 64 bits.
    #[track_caller]
    pub fn receive_i64<P: Fields<Port>>(&self, stream: Stream<P, Port>) -> impl Future<Output = P::With<i64>> {
        let loc = Loc::caller();
        async move {
            self.take_at(&stream, loc).await;
            stream.payload.map(|port| self.signed(*port))
        }
    }

    /// Like [`Testbench::receive`], for a word with values wider than 64 bits.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Increment};
    /// # let mut sim = Simulation::of(&Increment)?;
    /// # sim.reset();
    /// let (words, sums, t) = (sim.i.words, sim.o.sums, sim.testbench());
    /// let (seen, ()) = t.run((t.receive_bits(sums), t.send(words, 7)));
    /// assert_eq!(seen.to_string(), "8'h08");
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    #[track_caller]
    pub fn receive_bits<P: Fields<Port>>(&self, stream: Stream<P, Port>) -> impl Future<Output = P::With<Bits>> {
        let loc = Loc::caller();
        async move {
            self.take_at(&stream, loc).await;
            stream.payload.map(|port| self.get(*port))
        }
    }

    /// Sends words, one a clock except for the pauses.
    ///
    /// ```
    /// # use tilewright_sim::{Pauses, Simulation, for_examples::Increment};
    /// # let mut sim = Simulation::of(&Increment)?;
    /// # sim.reset();
    /// # let start = sim.time();
    /// let (words, sums, t) = (sim.i.words, sim.o.sums, sim.testbench());
    /// t.run((t.send_all(words, [1, 2, 3], Pauses::NONE), t.expect_all(sums, [2, 3, 4], Pauses::NONE)));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// As [`Testbench::send`].
    #[track_caller]
    pub fn send_all<P: Fields<Port>, V: IntoValue + Leaf>(
        &self,
        stream: Stream<P, Port>,
        words: impl IntoIterator<Item = P::With<V>>,
        mut pauses: Pauses,
    ) -> impl Future<Output = ()> {
        let loc = Loc::caller();
        async move {
            for word in words {
                self.wait_at(pauses.next_length().into(), loc).await;
                self.send_at::<P, V>(&stream, &word, loc).await;
            }
        }
    }

    /// Receives `count` words, one a clock except for the pauses.
    ///
    /// ```
    /// # use tilewright_sim::{Pauses, Simulation, for_examples::Increment};
    /// # let mut sim = Simulation::of(&Increment)?;
    /// # sim.reset();
    /// # let start = sim.time();
    /// let (words, sums, t) = (sim.i.words, sim.o.sums, sim.testbench());
    /// let ((), seen) = t.run((t.send_all(words, [1, 2, 3], Pauses::NONE), t.receive_all(sums, 3, Pauses::percent(50, 1))));
    /// assert_eq!(seen, [2, 3, 4]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// As [`Testbench::receive`].
    #[track_caller]
    pub fn receive_all<P: Fields<Port>>(
        &self,
        stream: Stream<P, Port>,
        count: usize,
        mut pauses: Pauses,
    ) -> impl Future<Output = Vec<P::With<u64>>> {
        let loc = Loc::caller();
        async move {
            let mut words = Vec::with_capacity(count);
            for _ in 0..count {
                self.wait_at(pauses.next_length().into(), loc).await;
                words.push(self.receive_at(&stream, loc).await);
            }
            words
        }
    }

    /// Receives these words, one a clock except for the pauses.
    ///
    /// ```
    /// # use tilewright_sim::{Pauses, Simulation, for_examples::Increment};
    /// # let mut sim = Simulation::of(&Increment)?;
    /// # sim.reset();
    /// # let start = sim.time();
    /// let (words, sums, t) = (sim.i.words, sim.o.sums, sim.testbench());
    /// // The receiver pauses, and misses nothing.
    /// t.run((t.send_all(words, 1..=9, Pauses::NONE), t.expect_all(sums, 2..=10, Pauses::percent(50, 2))));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// A word differs from the expected one; the message says which. Or as [`Testbench::receive`].
    #[track_caller]
    pub fn expect_all<P: Fields<Port>, V: IntoValue + Leaf>(
        &self,
        stream: Stream<P, Port>,
        expected: impl IntoIterator<Item = P::With<V>>,
        mut pauses: Pauses,
    ) -> impl Future<Output = ()>
    where
        P::With<V>: Debug,
        P::With<i128>: Debug,
    {
        let loc = Loc::caller();
        async move {
            for (number, expected) in expected.into_iter().enumerate() {
                self.wait_at(pauses.next_length().into(), loc).await;
                self.take_at(&stream, loc).await;
                let ports = leaves(&stream.payload);
                let values: Vec<V> = leaves(&expected);
                let fits = |(port, value): (&Port, V)| value.into_value(self.get(*port).width()) == Ok(self.get(*port));
                if ports.len() == values.len() && ports.iter().zip(values).all(fits) {
                    continue;
                }
                let word = stream.payload.map(|port| self.signed::<i128>(*port));
                let (name, time) = (self.name(&stream), self.time());
                panic!("word {number} of `{name}`, at {time} ps, is {word:?}, not {expected:?}\n  --> {loc}");
            }
        }
    }

    /// Waits for `edges` edges at which the block must not offer a word; it shows that no word is sent twice.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Increment};
    /// # let mut sim = Simulation::of(&Increment)?;
    /// # sim.reset();
    /// # let start = sim.time();
    /// let (words, sums, t) = (sim.i.words, sim.o.sums, sim.testbench());
    /// t.run((t.send(words, 7), t.receive(sums)));
    /// t.run((t.expect_silence(sums, 10),));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// The block offers a word.
    #[track_caller]
    pub fn expect_silence<P: Fields<Port>>(&self, stream: Stream<P, Port>, edges: u64) -> impl Future<Output = ()>
    where
        P::With<u64>: Debug,
    {
        let loc = Loc::caller();
        async move {
            for _ in 0..edges {
                self.wait_at(1, loc).await;
                if let Some(word) = self.shown(&stream) {
                    panic!(
                        "`{}` shows one more word, {word:?}, at {} ps\n  --> {loc}",
                        self.name(&stream),
                        self.time()
                    );
                }
            }
        }
    }

    /// Watches without end that an offered word stays until it is taken; pass it to [`monitor`](crate::monitor).
    ///
    /// ```
    /// # use tilewright_sim::{Pauses, Simulation, for_examples::Increment, monitor};
    /// # let mut sim = Simulation::of(&Increment)?;
    /// # sim.reset();
    /// # let start = sim.time();
    /// let (words, sums, t) = (sim.i.words, sim.o.sums, sim.testbench());
    /// t.run((
    ///     t.send_all(words, 1..=9, Pauses::NONE),
    ///     t.expect_all(sums, 2..=10, Pauses::percent(50, 2)),
    ///     monitor(t.holds(sums)),
    /// ));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// An offered word is withdrawn or changes.
    #[track_caller]
    pub fn holds<P: Fields<Port>>(&self, stream: Stream<P, Port>) -> impl Future<Output = ()>
    where
        P::With<u64>: Debug + PartialEq,
    {
        self.holds_as(stream, |port| self.number(*port, "holds_bits"), Loc::caller())
    }

    /// Like [`Testbench::holds`], for words with values wider than 64 bits.
    ///
    /// ```
    /// # use tilewright_sim::{Pauses, Simulation, for_examples::Increment, monitor};
    /// # let mut sim = Simulation::of(&Increment)?;
    /// # sim.reset();
    /// let (words, sums, t) = (sim.i.words, sim.o.sums, sim.testbench());
    /// t.run((
    ///     t.send_all(words, 1..=9, Pauses::NONE),
    ///     t.expect_all(sums, 2..=10, Pauses::percent(50, 2)),
    ///     monitor(t.holds_bits(sums)),
    /// ));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// As [`Testbench::holds`].
    #[track_caller]
    pub fn holds_bits<P: Fields<Port>>(&self, stream: Stream<P, Port>) -> impl Future<Output = ()>
    where
        P::With<Bits>: Debug + PartialEq,
    {
        self.holds_as(stream, |port| self.get(*port), Loc::caller())
    }

    async fn holds_as<P: Fields<Port>, V: Leaf>(&self, stream: Stream<P, Port>, value: impl Fn(&Port) -> V, loc: Loc)
    where
        P::With<V>: Debug + PartialEq,
    {
        let mut waits: Option<P::With<V>> = None;
        loop {
            self.wait_at(1, loc).await;
            let shown = (self.get_u64(stream.valid) == 1).then(|| stream.payload.map(&value));
            assert!(
                waits.is_none() || waits == shown,
                "`{}` showed {waits:?} and, before it was taken, at {} ps, shows {shown:?}\n  --> {loc}",
                self.name(&stream),
                self.time(),
            );
            waits = shown.filter(|_| self.get_u64(stream.ready) == 0);
        }
    }

    /// The word that a stream offers before the edge, if any.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Increment};
    /// # let mut sim = Simulation::of(&Increment)?;
    /// # sim.reset();
    /// # let start = sim.time();
    /// let (words, sums, t) = (sim.i.words, sim.o.sums, sim.testbench());
    /// assert_eq!(t.shown(&sums), None);
    /// t.run((t.send(words, 7),));
    /// assert_eq!(t.shown(&sums), Some(8)); // nobody takes it
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    #[track_caller]
    pub fn shown<P: Fields<Port>>(&self, stream: &Stream<P, Port>) -> Option<P::With<u64>> {
        (self.get_u64(stream.valid) == 1).then(|| stream.payload.map(|port| self.number(*port, "get")))
    }

    async fn send_at<P, V>(&self, stream: &Stream<P, Port>, word: &P::With<V>, loc: Loc)
    where
        P: Fields<Port>,
        V: IntoValue + Leaf,
    {
        let (ports, values) = (leaves(&stream.payload), leaves(word));
        assert!(
            ports.len() == values.len(),
            "a word with {} values is sent to `{}`, which takes {}\n  --> {loc}",
            values.len(),
            self.name(stream),
            ports.len()
        );
        self.set_at(stream.valid, 1, loc);
        ports.iter().zip(values).for_each(|(port, value)| self.set_at(*port, value, loc));
        self.until_at(stream.ready.into(), loc).await;
        // The payload of an invalid word is random: a block that reads it nevertheless fails its test.
        self.set_at(stream.valid, 0, loc);
        ports.iter().for_each(|port| self.set_at(*port, 0, loc));
    }

    async fn receive_at<P: Fields<Port>>(&self, stream: &Stream<P, Port>, loc: Loc) -> P::With<u64> {
        self.take_at(stream, loc).await;
        stream.payload.map(|port| self.number(*port, "receive_bits"))
    }

    /// Waits for a word and takes it; its payload must be read before the edge.
    async fn take_at<P: Fields<Port>>(&self, stream: &Stream<P, Port>, loc: Loc) {
        self.set_at(stream.ready, 1, loc);
        self.until_at(stream.valid.into(), loc).await;
        self.set_at(stream.ready, 0, loc);
    }

    #[track_caller]
    fn number(&self, port: Port, instead: &str) -> u64 {
        self.shared.borrow_mut().circuit.number(port, 0, instead)
    }

    /// The value of a port as a number, negative if the port is signed and the value is.
    #[track_caller]
    fn signed<N: TryFrom<i128>>(&self, port: Port) -> N {
        let circuit = &mut self.shared.borrow_mut().circuit;
        match circuit.signed(port).and_then(|number| number.try_into().ok()) {
            Some(number) => number,
            None => {
                let (path, bits) = (&circuit.declared(port).path, 8 * size_of::<N>());
                panic!("`{path}` does not fit in {bits} bits with its sign: use `receive_bits`")
            }
        }
    }

    /// The stream's name for messages.
    fn name<P>(&self, stream: &Stream<P, Port>) -> String {
        let shared = self.shared.borrow();
        let valid = &shared.circuit.declared(stream.valid).name;
        valid.strip_suffix("_valid").unwrap_or(valid).to_owned()
    }
}

/// The leaves of a record, in sequence.
fn leaves<T: Leaf, F: Fields<T>>(record: &F) -> Vec<T> {
    let mut leaves = Vec::new();
    record.visit(&mut |part| {
        if let Visited::Leaf(leaf) | Visited::Back(leaf) = part {
            leaves.push(leaf.clone());
        }
    });
    leaves
}
