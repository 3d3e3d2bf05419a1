//! The texts that a circuit displays.

use std::sync::{Arc, Mutex};

use tilewright_circuit::ir::Piece;

use super::{Observer, View};
use crate::engine::lane;
use crate::engine::program::Display;
use crate::testbench::error::Error;

/// A text that a [`display`](tilewright_hdl::Module::display) showed.
///
/// ```
/// use tilewright_hdl::*;
///
/// # let design = tilewright_sim::shown! { |m, i| in { enable: bit() } out { count: bits(4) }
/// def!(count = m.reg(4).reset(0));
/// count.when(i.enable, count + 5);
/// m.display(i.enable, "it is {:x}", &[*count]);
/// #     ShownOut { count: *count }
/// # };
/// let mut sim = tilewright_sim::Simulation::from_design(&design)?;
/// let messages = sim.messages();
/// sim.step();
/// sim.set(sim.port("enable")?, 1);
/// sim.run(3);
/// let shown: Vec<_> = messages.take().into_iter().map(|message| (message.time, message.text)).collect();
/// assert_eq!(shown, [(20_000, "it is 0".into()), (30_000, "it is 5".into()), (40_000, "it is a".into())]);
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Message {
    /// The instant of the edge, in picoseconds.
    pub time: u64,
    /// The instance: `u_row[2].u_cell`. Empty at the top.
    pub path: String,
    /// The text, with the values before the edge.
    pub text: String,
}

/// What the displays of a simulation show, from [`Simulation::messages`](crate::Simulation::messages) on.
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// let mut sim = Simulation::of(&Counter)?;
/// let messages = sim.messages();
/// sim.run(3);
/// assert!(messages.lines().is_empty()); // the block displays nothing
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Messages {
    shown: Arc<Mutex<Vec<Message>>>,
    /// The run of a batch.
    run: u32,
}

impl Messages {
    pub(crate) fn of(run: u32) -> Messages {
        Messages { run, ..Messages::default() }
    }

    /// The messages so far; later ones are collected anew. Those of one edge are in the sequence of declaration.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let messages = sim.messages();
    /// sim.run(3);
    /// assert_eq!(messages.take(), []);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn take(&self) -> Vec<Message> {
        std::mem::take(&mut self.shown.lock().expect("no panic while messages are collected"))
    }

    /// The texts of the messages so far, as [`Messages::take`] takes them.
    ///
    /// ```
    /// # use tilewright_sim::{Simulation, for_examples::Counter};
    /// let mut sim = Simulation::of(&Counter)?;
    /// let messages = sim.messages();
    /// sim.run(3);
    /// assert!(messages.lines().is_empty());
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub fn lines(&self) -> Vec<String> {
        self.take().into_iter().map(|message| message.text).collect()
    }

    /// Collects what a display shows at an edge, in all of its lanes.
    fn show(&self, view: &mut View, display: &Display) {
        let program = view.program;
        for number in 0..program.value(display.condition).lanes {
            let place = program.hierarchy.instance(&display.scopes, number / display.group);
            if program.hierarchy.run(place) != self.run
                || lane(program, &mut **view.engine, display.condition, number).is_zero()
            {
                continue;
            }
            let (mut text, mut values) = (String::new(), display.values.iter());
            for piece in &display.pieces {
                match piece {
                    Piece::Text(plain) => text += plain,
                    Piece::Value(format) => {
                        let (value, kind) = *values.next().expect("a value for each place");
                        text += &format.write(&lane(program, &mut **view.engine, value, number), kind);
                    }
                }
            }
            let message = Message { time: view.until, path: program.hierarchy.path(place), text };
            self.shown.lock().expect("no panic while messages are collected").push(message);
        }
    }
}

impl Observer for Messages {
    fn sample(&mut self, view: &mut View) -> Result<(), Error> {
        for display in &view.program.displays {
            let clock = display.clock as usize;
            if view.rising.contains(&clock) && !view.resets[clock] {
                self.show(view, display);
            }
        }
        Ok(())
    }
}
