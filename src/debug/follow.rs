//! What the page does when the user of a viewer of waveforms does something.

use super::state::State;
use crate::wcp::Event;
use tilewright_sim::Error;

impl State {
    /// Goes along with what happens in a viewer.
    ///
    /// # Errors
    /// The simulation cannot go to a time.
    pub fn follow(&mut self, event: &Event) -> Result<(), Error> {
        self.message.clear();
        match event {
            Event::CursorMoved { timestamp } => self.go_to_instant(*timestamp),
            Event::GotoDeclaration { variable, timestamp } => {
                if let Some(time) = timestamp {
                    self.go_to_instant(*time);
                }
                self.select_variable(variable);
            }
            Event::AddDrivers { variable } => {
                if self.select_variable(variable) {
                    return self.ask_why();
                }
            }
            Event::Other => {}
        }
        Ok(())
    }

    /// Goes to the last instant up to a time.
    fn go_to_instant(&mut self, time: u64) {
        self.now = self.instants.before(time.saturating_add(1)).min(self.instants.end);
    }

    /// Selects the net of a variable of the waveform; whether there is one.
    fn select_variable(&mut self, variable: &str) -> bool {
        let name = net_of(variable);
        let net = self.nets.iter().position(|net| net.name == name);
        match net {
            Some(net) => self.select_net(net),
            None => self.message = format!("the viewer's {name} is no net of this block"),
        }
        net.is_some()
    }
}

/// The name of the net that a variable shows. The variable has the top module in front, the scope `lane` in each element of an
/// array, lanes as `words.[3]`, and a code's name beside its number.
fn net_of(variable: &str) -> String {
    let below = variable.split_once('.').map_or(variable, |(_, below)| below);
    let name = below.replace(".[", "[").replace("].lane.", "].");
    name.strip_suffix("_state").map_or(name.clone(), str::to_owned)
}
