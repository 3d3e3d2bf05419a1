//! Inputs and outputs of the runs of a batch.

use tilewright_circuit::Bits;
use tilewright_hdl::{Bundle, Leaf};

use super::Batch;
use crate::testbench::port::{IntoValue, Port};
use crate::testbench::simulation::in_step;

impl<I: Bundle, O: Bundle> Batch<I, O> {
    /// Sets an input of one run from now on; the circuit does not change before the next step.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// batch.set(batch.i.enable, 3, 1);
    /// batch.run(10);
    /// assert_eq!((batch.get(batch.o.count, 2).to_u64(), batch.get(batch.o.count, 3).to_u64()), (Some(0), Some(10)));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// The value does not fit, the port is an output, or there is no such run.
    #[track_caller]
    pub fn set(&mut self, port: Port, run: u32, value: impl IntoValue) {
        self.check(run);
        let bits = self.all.circuit.fitting(port, value);
        self.inputs[port.index as usize].set(run, &bits);
    }

    /// Sets an input of every run to the value that `value` returns for it.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// for cycle in 0..10 {
    ///     batch.set_each(batch.i.enable, |run| cycle < run);
    ///     batch.step();
    /// }
    /// assert_eq!(batch.get(batch.o.count, 3), 3); // run 3 counts in cycles 0, 1 and 2
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// As [`Batch::set`].
    #[track_caller]
    pub fn set_each<V: IntoValue>(&mut self, port: Port, mut value: impl FnMut(u32) -> V) {
        for run in 0..self.runs() {
            self.set(port, run, value(run));
        }
    }

    /// Sets an input of all runs to one value.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// batch.set_all(batch.i.enable, 1);
    /// batch.run(10);
    /// assert!(batch.get_each(batch.o.count).iter().all(|count| *count == 10));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// As [`Batch::set`].
    #[track_caller]
    pub fn set_all(&mut self, port: Port, value: impl IntoValue) {
        let bits = self.all.circuit.fitting(port, value);
        let input = &mut self.inputs[port.index as usize];
        input.limbs.chunks_exact_mut(input.size).for_each(|run| run.copy_from_slice(bits.limbs()));
        input.waits = true;
    }

    /// Sets a list of inputs of one run; see [`Simulation::set_list`](crate::Simulation::set_list).
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Products};
    /// let mut batch = Batch::of(&Products, 4)?;
    /// batch.set_list(2, |i| &i.left, [1, 2, 3]);
    /// batch.set_list(2, |i| &i.right, [9; 3]);
    /// assert_eq!(batch.get_list(2, |o| &o.products), [9, 18, 27]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// There are more or fewer values than inputs; or as [`Batch::set`].
    #[track_caller]
    pub fn set_list<V: IntoValue>(
        &mut self,
        run: u32,
        list: impl FnOnce(&I::Of<Port>) -> &[Port],
        values: impl IntoIterator<Item = V>,
    ) {
        self.check(run);
        let (all, inputs) = (&self.all, &mut self.inputs);
        in_step(list(&self.i), values, |port, value| {
            inputs[port.index as usize].set(run, &all.circuit.fitting(port, value));
        });
    }

    /// The values of a list of outputs in one run; see [`Simulation::get_list`](crate::Simulation::get_list).
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Products};
    /// let mut batch = Batch::of(&Products, 4)?;
    /// batch.set_list(2, |i| &i.left, [1, 2, 3]);
    /// assert_eq!(batch.get_list(2, |o| &o.products), [0; 3]); // the other factors are still zero
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// One of them is wider than 64 bits, or there is no such run.
    #[track_caller]
    pub fn get_list(&mut self, run: u32, list: impl FnOnce(&O::Of<Port>) -> &[Port]) -> Vec<u64> {
        self.check(run);
        let all = self.ready();
        list(&all.o).iter().map(|port| all.circuit.narrow(*port, run)).collect()
    }

    /// Sets every input of one run; [`Batch::drive_bits`] takes values wider than 64 bits.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// # use tilewright_sim::for_examples::CounterIn;
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// batch.drive(1, CounterIn { enable: 1 });
    /// batch.run(10);
    /// assert_eq!(batch.get(batch.o.count, 1), 10);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// As [`Batch::set`].
    #[track_caller]
    pub fn drive(&mut self, run: u32, values: I::Of<u64>) {
        self.drive_run(run, &values);
    }

    /// Sets every input of one run.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// # use tilewright_hdl::Bits;
    /// # use tilewright_sim::for_examples::CounterIn;
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// batch.drive_bits(1, CounterIn { enable: Bits::ones(1) });
    /// batch.run(10);
    /// assert_eq!(batch.get(batch.o.count, 1), 10);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// As [`Batch::set`].
    #[track_caller]
    pub fn drive_bits(&mut self, run: u32, values: I::Of<Bits>) {
        self.drive_run(run, &values);
    }

    #[track_caller]
    fn drive_run<V: IntoValue + Leaf>(&mut self, run: u32, values: &I::Of<V>) {
        self.check(run);
        let (all, inputs) = (&self.all, &mut self.inputs);
        all.inputs.pair::<I, V>(&self.i, values, |port, value| {
            inputs[port.index as usize].set(run, &all.circuit.fitting(port, value.clone()));
        });
    }

    /// The settled value of a port in one run.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// batch.set_all(batch.i.enable, 1);
    /// batch.run(10);
    /// assert_eq!(batch.get(batch.o.square, 0), 100);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// There is no such run.
    #[track_caller]
    pub fn get(&mut self, port: Port, run: u32) -> Bits {
        self.check(run);
        self.ready().circuit.get(port, run)
    }

    /// The settled value of a port in every run.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// batch.set_each(batch.i.enable, |run| run % 2);
    /// batch.run(10);
    /// let counts = batch.get_each(batch.o.count);
    /// assert_eq!(counts.iter().map(|count| count.to_u64().unwrap()).collect::<Vec<_>>(), [0, 10, 0, 10]);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    #[track_caller]
    pub fn get_each(&mut self, port: Port) -> Vec<Bits> {
        let id = self.all.circuit.declared(port).value;
        let value = self.all.circuit.program.value(id);
        let limbs = self.ready().circuit.engine.read(id);
        limbs.chunks_exact(value.limbs()).map(|run| Bits::from_limbs(value.width, run)).collect()
    }

    /// The settled values of all outputs of one run.
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// batch.set(batch.i.enable, 1, 1);
    /// batch.run(5);
    /// assert_eq!(batch.read(1).square, 25);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// There is no such run.
    #[track_caller]
    pub fn read(&mut self, run: u32) -> O::Of<Bits> {
        self.check(run);
        self.ready().read_run(run)
    }

    /// The settled values of all outputs of one run, as numbers; see
    /// [`Simulation::read_u64`](crate::Simulation::read_u64).
    ///
    /// ```
    /// # use tilewright_sim::{Batch, for_examples::Counter};
    /// # use tilewright_sim::for_examples::CounterOut;
    /// let mut batch = Batch::of(&Counter, 4)?;
    /// batch.set(batch.i.enable, 1, 1);
    /// batch.run(5);
    /// assert_eq!(batch.read_u64(1), CounterOut { count: 5, square: 25 });
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// An output's value does not fit in 64 bits, or there is no such run.
    #[track_caller]
    pub fn read_u64(&mut self, run: u32) -> O::Of<u64> {
        self.check(run);
        self.ready().read_run_u64(run)
    }
}
