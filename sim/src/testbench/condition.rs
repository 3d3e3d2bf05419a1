//! The condition at which a run stops.

use tilewright_hdl::Bundle;

use crate::engine::until::{Order, Until};
use crate::testbench::error::Error;
use crate::testbench::port::{IntoValue, Port};
use crate::testbench::run::done;
use crate::testbench::running::{Running, bits};
use crate::testbench::simulation::Simulation;

/// A condition on a port, made by [`Port::is`] and similar methods. A 1-bit [`Port`] by itself means that it is 1.
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// sim.set(sim.i.enable, 1);
/// let nine = sim.o.square.is(9);
/// assert_eq!(sim.run_until(nine, 100), Some(3)); // 3
/// assert_eq!(sim.run_until(nine, 100), Some(16)); // 19, whose lower 4 bits are 3
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Condition {
    port: Port,
    /// `None` for a port that must be 1.
    compared: Option<(Order, u64)>,
}

/// Conditions for [`Simulation::run_until`]; numbers are unsigned.
impl Port {
    /// The port equals this number.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// assert_eq!(sim.run_until(sim.o.count.is(7), 100), Some(7));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn is(self, number: u64) -> Condition {
        self.compared(Order::Is, number)
    }

    /// The port differs from this number.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// assert_eq!(sim.run_until(sim.o.count.is_not(0), 100), Some(1)); // any other value
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn is_not(self, number: u64) -> Condition {
        self.compared(Order::IsNot, number)
    }

    /// The port is less than this number.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// sim.run(10);
    /// // The square has 8 bits, and is 0 again at 16.
    /// assert_eq!(sim.run_until(sim.o.square.is_below(100), 100), Some(6));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn is_below(self, number: u64) -> Condition {
        self.compared(Order::Below, number)
    }

    /// The port is at least this number.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// assert_eq!(sim.run_until(sim.o.square.is_at_least(50), 100), Some(8)); // 64 is the first
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn is_at_least(self, number: u64) -> Condition {
        self.compared(Order::AtLeast, number)
    }

    fn compared(self, order: Order, number: u64) -> Condition {
        Condition { port: self, compared: Some((order, number)) }
    }
}

impl From<Port> for Condition {
    fn from(port: Port) -> Condition {
        Condition { port, compared: None }
    }
}

impl<I: Bundle, O: Bundle> Simulation<I, O> {
    /// Advances from instant to instant until a condition is true, but at most `limit` instants. Returns the number
    /// of instants, or `None` if the condition is still not true after `limit`.
    ///
    /// The condition is checked after each instant, settled with the present inputs. So there is always at least one
    /// instant, even if the condition is true before. With one clock and no observer, this is as fast as
    /// [`Simulation::run`].
    ///
    /// ```
    /// # use tilewright_hdl::{Block, Module, Width, bit, bundle, def};
    /// # bundle! {
    /// #     /// The event.
    /// #     pub struct CounterIn<T> { pub enable: T }
    /// #     /// The number of events.
    /// #     pub struct CounterOut<T> { pub count: T, pub full: T }
    /// # }
    /// # #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    /// # struct Counter;
    /// # impl Block for Counter {
    /// #     type In = CounterIn;
    /// #     type Out = CounterOut;
    /// #     fn inputs(&self) -> CounterIn<Width> { CounterIn { enable: bit() } }
    /// #     fn build(&self, m: Module, i: CounterIn) -> CounterOut {
    /// #         def!(count = m.reg(8).reset(0));
    /// #         count.enable(i.enable).next(count + 1);
    /// #         CounterOut { count: *count, full: count.all_ones() }
    /// #     }
    /// # }
    /// # let mut sim = tilewright_sim::Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// assert_eq!(sim.run_until(sim.o.count.is_at_least(100), 1000), Some(100));
    /// assert_eq!(sim.run_until(sim.o.full, 1000), Some(155));
    /// assert_eq!(sim.run_until(sim.o.full, 100), None);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// The number of the condition does not fit in its port, or a port of several bits is not compared with a number;
    /// or as [`Simulation::step`].
    #[track_caller]
    pub fn run_until(&mut self, condition: impl Into<Condition>, limit: u64) -> Option<u64> {
        let until = self.circuit.until(condition.into());
        match self.circuit.try_run_until(&until, limit) {
            Ok(instants) => instants,
            Err(error) => {
                done(Err(error));
                None
            }
        }
    }

    /// Like [`Simulation::run_until`].
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// sim.set(sim.i.enable, 1);
    /// let error = sim.try_run_until(sim.o.count.is(250), 1000).unwrap_err();
    /// assert!(error.to_string().contains("it counts to less than 200"));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Simulation::try_step`].
    ///
    /// # Panics
    ///
    /// The condition is invalid for its port, as in [`Simulation::run_until`].
    #[track_caller]
    pub fn try_run_until(&mut self, condition: impl Into<Condition>, limit: u64) -> Result<Option<u64>, Error> {
        let until = self.circuit.until(condition.into());
        self.circuit.try_run_until(&until, limit)
    }
}

impl Running {
    /// The condition on the port's value.
    #[track_caller]
    pub fn until(&self, condition: Condition) -> Until {
        let Condition { port, compared } = condition;
        let declared = self.declared(port);
        let (name, value) = (&declared.name, declared.value);
        let width = self.program.value(value).width;
        assert!(
            compared.is_some() || width == 1,
            "`{name}` has {width} bits: compare it with a number, as in `sim.o.{name}.is(5)`"
        );
        let (order, number) = compared.unwrap_or((Order::Is, 1));
        match number.into_value(width) {
            Ok(number) => Until { value, order, number },
            Err(problem) => panic!("the condition compares `{name}`, which has {} and {problem}", bits(width)),
        }
    }

    /// The condition in words, such as `count` to be below 5.
    pub fn condition_text(&self, Condition { port, compared }: Condition) -> String {
        let (order, number) = match compared.unwrap_or((Order::Is, 1)) {
            (Order::Is, number) => ("", number),
            (Order::IsNot, number) => ("other than ", number),
            (Order::Below, number) => ("below ", number),
            (Order::AtLeast, number) => ("at least ", number),
        };
        format!("`{}` to be {order}{number}", self.declared(port).name)
    }

    /// Advances until the condition is true; returns the number of instants.
    fn try_run_until(&mut self, until: &Until, limit: u64) -> Result<Option<u64>, Error> {
        let mut instants = 0;
        while instants < limit {
            let (done, holds) = match self.is_plain() {
                true => self.repeat_until(until, limit - instants)?,
                false => {
                    self.try_step()?;
                    (1, until.holds(self.engine.read(until.value)))
                }
            };
            instants += done;
            if holds {
                return Ok(Some(instants));
            }
        }
        Ok(None)
    }

    /// The same for one clock, until there is an observer: the number of instants, and whether the condition is true.
    fn repeat_until(&mut self, until: &Until, limit: u64) -> Result<(u64, bool), Error> {
        let mut instants = 0;
        while instants < limit {
            self.attend();
            if !self.is_plain() {
                break;
            }
            let fits = (limit - instants).min(self.timeline.room()).min(self.until_pause());
            if fits == 0 {
                return Err(Error::Late);
            }
            let (done, holds) = self.engine.edges_until(&[0], fits, until)?;
            self.timeline.repeat(done.edges);
            instants += done.edges;
            match holds {
                true => return Ok((instants, true)),
                false if done.edges < fits => return Err(self.stopped()),
                false => {}
            }
        }
        Ok((instants, false))
    }
}
