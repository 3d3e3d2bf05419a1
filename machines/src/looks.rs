//! Nets of a simulation that are looked at in many clocks.

use tilewright_sim::{Bundle, Memory, Nets, Simulation};

/// Nets of a simulation, which are read together. One of more than 64 bits has several values, the lowest bits first.
#[derive(Debug, Default)]
pub(crate) struct Looks {
    paths: Vec<String>,
    nets: Option<Nets>,
    values: Vec<u64>,
}

impl Looks {
    /// Adds nets whose paths have that beginning, before the first look. Returns the place of the first.
    pub fn add<'a>(&mut self, path: &str, names: impl IntoIterator<Item = &'a str>) -> usize {
        let first = self.paths.len();
        self.paths.extend(names.into_iter().map(|name| format!("{path}{name}")));
        first
    }

    /// Reads the settled values of all.
    pub fn look<I: Bundle, O: Bundle>(&mut self, sim: &mut Simulation<I, O>) {
        if self.nets.is_none() {
            let nets = sim.nets(&self.paths).unwrap_or_else(|unknown| panic!("{unknown}"));
            self.values.resize(nets.count(), 0);
            self.nets = Some(nets);
        }
        if let Some(nets) = &self.nets {
            sim.numbers(nets, &mut self.values);
        }
    }

    /// The value of the net at that place.
    pub fn at(&self, place: usize) -> u64 {
        self.values[place]
    }

    /// All values.
    pub fn values(&self) -> &[u64] {
        &self.values
    }

    /// The path of the net at that place.
    pub fn path(&self, place: usize) -> &str {
        &self.paths[place]
    }

    /// The bits of the net at that place, after a look.
    pub fn width(&self, place: usize) -> u32 {
        self.nets.as_ref().map_or(0, |nets| nets.width(place))
    }

    /// The values from a place on.
    pub fn from<const N: usize>(&self, first: usize) -> [u64; N] {
        std::array::from_fn(|place| self.values[first + place])
    }
}

/// The nets of a port's fields, in their sequence; `like` is any record of its kind.
pub(crate) fn fields<B: Bundle>(port: &str, like: &B::Of<u64>) -> Vec<String> {
    let mut names = Vec::new();
    B::convert(like, &mut |field: &str, number: &u64| {
        names.push(format!("{port}_{}", field.replace('.', "_")));
        *number
    });
    names
}

/// A memory of a simulation.
#[derive(Debug)]
pub(crate) struct Words {
    /// Its name.
    pub name: String,
    memory: Option<Memory>,
}

impl Words {
    pub fn of(name: String) -> Words {
        Words { name, memory: None }
    }

    /// A word.
    pub fn word<I: Bundle, O: Bundle>(&mut self, sim: &Simulation<I, O>, address: u32) -> u64 {
        let find = || sim.memory(&self.name).unwrap_or_else(|unknown| panic!("{unknown}"));
        let memory = *self.memory.get_or_insert_with(find);
        sim.word(memory, address).to_u64().expect("it has at most 64 bits")
    }
}
