//! Inputs and outputs of a simulation: single ones, lists, and whole bundles.

use tilewright_circuit::Bits;
use tilewright_hdl::{Bundle, Fields, Leaf, Visited};

use crate::testbench::port::{IntoValue, Port};
use crate::testbench::simulation::{Simulation, in_step};

impl<I: Bundle, O: Bundle> Simulation<I, O> {
    /// Sets an input from now on. The sequence in which inputs are set does not matter; the circuit does not change
    /// before the next step.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, true);
    /// sim.step();
    /// sim.set(sim.i.enable, 0);
    /// sim.run(5);
    /// assert_eq!(sim.get(sim.o.count), 1);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// The value does not fit, or the port is an output.
    #[track_caller]
    #[inline]
    pub fn set(&mut self, port: Port, value: impl IntoValue) {
        self.circuit.set(port, value);
    }

    /// Sets a list of inputs, which is a field of the bundle, element by element.
    ///
    /// ```
    /// # use tilewright_hdl::{Block, Module, Width, bits, bundle};
    /// # bundle! {
    /// #     /// The factors.
    /// #     pub struct DotIn<T> { pub left: Vec<T>, pub right: Vec<T> }
    /// #     /// The products.
    /// #     pub struct DotOut<T> { pub products: Vec<T> }
    /// # }
    /// # #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    /// # struct Dot;
    /// # impl Block for Dot {
    /// #     type In = DotIn;
    /// #     type Out = DotOut;
    /// #     fn inputs(&self) -> DotIn<Width> { DotIn { left: vec![bits(8); 3], right: vec![bits(8); 3] } }
    /// #     fn build(&self, _: Module, i: DotIn) -> DotOut {
    /// #         DotOut { products: i.left.iter().zip(&i.right).map(|(left, right)| left.times(*right)).collect() }
    /// #     }
    /// # }
    /// # let mut sim = tilewright_sim::Simulation::of(&Dot)?;
    /// sim.set_list(|i| &i.left, [1, 2, 3]);
    /// sim.set_list(|i| &i.right, [10, 10, 5]);
    /// assert_eq!(sim.get_list(|o| &o.products), [10, 20, 15]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// There are more or fewer values than inputs; or as [`Simulation::set`].
    #[track_caller]
    pub fn set_list<V: IntoValue>(
        &mut self,
        list: impl FnOnce(&I::Of<Port>) -> &[Port],
        values: impl IntoIterator<Item = V>,
    ) {
        let circuit = &mut self.circuit;
        in_step(list(&self.i), values, |port, value| circuit.set(port, value));
    }

    /// Sets the inputs of a record, which is a field of the bundle.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// bundle! {
    ///     /// A pixel.
    ///     pub struct Pixel<T> { pub z: T, pub rgb: T }
    /// }
    ///
    /// block! {
    ///     struct Nearer;
    ///     in NearerIn { limit: bits(8), pixel: Pixel = Pixel { z: bits(8), rgb: bits(24) } }
    ///     out NearerOut { rgb: bits(24) }
    /// }
    ///
    /// impl Nearer {
    ///     fn build(&self, _: Module, i: NearerIn) -> NearerOut {
    ///         NearerOut { rgb: mux(i.pixel.z.lt(i.limit), i.pixel.rgb, 0) }
    ///     }
    /// }
    ///
    /// let mut sim = tilewright_sim::Simulation::of(&Nearer)?;
    /// sim.set(sim.i.limit, 10);
    /// sim.set_record(sim.i.pixel, Pixel { z: 9, rgb: 0xff00ff });
    /// assert_eq!(sim.get(sim.o.rgb), 0xff00ff);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// A list in it is not as long as that of the ports; or as [`Simulation::set`].
    #[track_caller]
    pub fn set_record<P: Fields<Port>, V: IntoValue + Leaf>(&mut self, ports: P, values: P::With<V>) {
        let mut given = Vec::new();
        values.visit(&mut |part| {
            if let Visited::Leaf(value) = part {
                given.push(value.clone());
            }
        });
        let mut sought = Vec::with_capacity(given.len());
        ports.visit(&mut |part| {
            if let Visited::Leaf(port) = part {
                sought.push(*port);
            }
        });
        let circuit = &mut self.circuit;
        in_step(&sought, given, |port, value| circuit.set(port, value));
    }

    /// The settled values of a list of outputs, which is a field of the bundle, as numbers.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Products};
    /// let mut sim = Simulation::of(&Products)?;
    /// sim.set_list(|i| &i.left, [1, 2, 3]);
    /// sim.set_list(|i| &i.right, [200; 3]);
    /// assert_eq!(sim.get_list(|o| &o.products), [200, 400, 600]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// One of them is wider than 64 bits.
    #[track_caller]
    pub fn get_list(&mut self, list: impl FnOnce(&O::Of<Port>) -> &[Port]) -> Vec<u64> {
        let circuit = &mut self.circuit;
        list(&self.o).iter().map(|port| circuit.narrow(*port, 0)).collect()
    }

    /// Sets an input with lanes, one value for each; a grid is given row by row.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Products};
    /// let mut sim = Simulation::of(&Products)?;
    /// sim.set_lanes(sim.i.lanes, [1, 2, 3, 200]);
    /// assert_eq!(sim.lanes(sim.o.squares), [1, 4, 9, 40_000]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// There are more or fewer values than lanes; or as [`Simulation::set`].
    #[track_caller]
    pub fn set_lanes<V: IntoValue>(&mut self, port: Port, values: impl IntoIterator<Item = V>) {
        self.circuit.set_lanes(port, values);
    }

    /// The settled lanes of a port, as numbers; a grid is given row by row. A plain port has one lane.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Products};
    /// let mut sim = Simulation::of(&Products)?;
    /// sim.set(sim.i.lanes, 0x04_03_02_01);
    /// assert_eq!(sim.lanes(sim.i.lanes), [1, 2, 3, 4]); // lane 0 is in the lowest bits
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// They are wider than 64 bits.
    #[track_caller]
    pub fn lanes(&mut self, port: Port) -> Vec<u64> {
        self.circuit.lanes(port)
    }

    /// The settled value of a port: an output as it follows from the state and the present inputs.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// sim.run(5);
    /// assert_eq!(sim.get(sim.o.count).to_string(), "8'h05");
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    #[track_caller]
    #[inline]
    pub fn get(&mut self, port: Port) -> Bits {
        self.circuit.get(port, 0)
    }

    /// Like [`Simulation::get`], as 64-bit limbs, the lowest first. It makes no copy, which helps to read a wide port
    /// in each clock.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// sim.run(5);
    /// assert_eq!(sim.limbs(sim.o.count), [5]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    #[track_caller]
    #[inline]
    pub fn limbs(&mut self, port: Port) -> &[u64] {
        self.circuit.limbs(port, 0)
    }

    /// Like [`Simulation::get`], for a port of up to 64 bits.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// sim.run(5);
    /// assert_eq!(sim.get_u64(sim.o.count) * 3, 15);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// The port is wider.
    #[track_caller]
    #[inline]
    pub fn get_u64(&mut self, port: Port) -> u64 {
        self.circuit.narrow(port, 0)
    }

    /// Sets every input of the input bundle; [`Simulation::drive_bits`] takes values wider than 64 bits. The `ready`
    /// of a stream in it is an output, so its value is ignored.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// # use tilewright_sim::for_examples::CounterIn;
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.drive(CounterIn { enable: 1 });
    /// sim.run(5);
    /// assert_eq!(sim.get(sim.o.count), 5);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// A value does not fit, or a list is not as long as the block's.
    #[track_caller]
    pub fn drive(&mut self, values: I::Of<u64>) {
        self.drive_each(&values);
    }

    /// Sets every input.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// # use tilewright_hdl::Bits;
    /// # use tilewright_sim::for_examples::CounterIn;
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.drive_bits(CounterIn { enable: Bits::ones(1) });
    /// sim.run(5);
    /// assert_eq!(sim.get(sim.o.count), 5);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// A value's width differs from its port's, or a list is not as long as the block's.
    #[track_caller]
    pub fn drive_bits(&mut self, values: I::Of<Bits>) {
        self.drive_each(&values);
    }

    #[track_caller]
    fn drive_each<V: IntoValue + Leaf>(&mut self, values: &I::Of<V>) {
        let circuit = &mut self.circuit;
        self.inputs.pair::<I, V>(&self.i, values, |port, value| circuit.set(port, value.clone()));
    }

    /// The settled values of all outputs.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// sim.run(5);
    /// let outputs = sim.read();
    /// assert_eq!((outputs.count.width(), outputs.square.to_u64()), (8, Some(25)));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn read(&mut self) -> O::Of<Bits> {
        self.read_run(0)
    }

    pub(crate) fn read_run(&mut self, run: u32) -> O::Of<Bits> {
        let circuit = &mut self.circuit;
        O::convert_leaves(&self.o, &mut |port: &Port| circuit.get(*port, run))
    }

    /// The settled values of all outputs as numbers; easy to compare with an expected bundle.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// # use tilewright_sim::for_examples::CounterOut;
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// sim.run(5);
    /// assert_eq!(sim.read_u64(), CounterOut { count: 5, square: 25 });
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// An output's value does not fit in 64 bits.
    #[track_caller]
    pub fn read_u64(&mut self) -> O::Of<u64> {
        self.read_run_u64(0)
    }

    #[track_caller]
    pub(crate) fn read_run_u64(&mut self, run: u32) -> O::Of<u64> {
        let circuit = &mut self.circuit;
        O::convert_leaves(&self.o, &mut |port: &Port| circuit.number(*port, run, "read"))
    }

    /// Drives one bundle of inputs after another, one per instant, and returns the settled outputs before each edge.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// # use tilewright_sim::for_examples::CounterIn;
    /// let mut sim = Simulation::of(&Counter)?;
    /// let outputs = sim.stream([1, 1, 0, 1].map(|enable| CounterIn { enable }));
    /// assert_eq!(outputs.iter().map(|output| output.count).collect::<Vec<_>>(), [0, 1, 2, 2]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// As [`Simulation::drive`], [`Simulation::read_u64`] and [`Simulation::step`].
    #[track_caller]
    pub fn stream(&mut self, inputs: impl IntoIterator<Item = I::Of<u64>>) -> Vec<O::Of<u64>> {
        let mut outputs = Vec::new();
        for bundle in inputs {
            self.drive(bundle);
            outputs.push(self.read_u64());
            self.step();
        }
        outputs
    }
}
