//! The places of all values of a function.

use crate::engine::function::Function;
use crate::engine::layout::{Layout, Place};
use crate::engine::plan::Plan;
use crate::engine::program::{Kind, ValueId};
use tilewright_circuit::ir::Binary;

/// The addresses of everything.
#[derive(Clone)]
pub(crate) struct Addresses {
    /// For each cell its place, if it is stored.
    pub places: Vec<Option<Place>>,
    /// For each register that changes late, the place where the new value waits.
    pub waiting: Vec<(ValueId, Place)>,
    /// Arrays of constant lanes, which must be in memory before the function runs.
    pub tables: Vec<ValueId>,
}

impl Addresses {
    /// Gives places to the stored values of a function; `state` has those of its state.
    pub fn new(function: &Function, plan: &Plan, state: impl Iterator<Item = Place>, layout: &mut Layout) -> Addresses {
        let mut places: Vec<Option<Place>> = state.map(Some).collect();
        places.resize(function.circuit().len(), None);
        let tables: Vec<ValueId> = function.needed().into_iter().filter(|id| function.is_table(*id)).collect();
        let own = plan.live_out.iter().filter(|id| !plan.homes.contains_key(id));
        for id in tables.iter().chain(own) {
            let cell = function.cell(*id);
            let place = *places[id.index()].get_or_insert_with(|| layout.place(cell.lanes, cell.width));
            // An address that pieces of a function pass on, or the next one.
            if let Kind::Alias(of) | Kind::Binary(Binary::Add, of, _) = cell.kind
                && let Some(of) = places[of.index()]
            {
                layout.same_address(place, of);
            }
        }
        for (&new, &of) in &plan.homes {
            places[new.index()] = places[of.index()];
        }
        let waiting = plan.hazards.iter().map(|&id| {
            let cell = function.cell(id);
            (id, layout.place(cell.lanes, cell.width))
        });
        let waiting = waiting.collect();
        Addresses { places, waiting, tables }
    }

    /// Whether it is stored.
    pub(crate) fn has(&self, id: ValueId) -> bool {
        self.places.get(id.index()).is_some_and(Option::is_some)
    }

    pub(crate) fn of(&self, id: ValueId) -> Place {
        self.places[id.index()].expect("what is read from memory has a place")
    }

    /// The value at an offset in the state.
    pub(crate) fn value_at(&self, offset: usize) -> Option<ValueId> {
        let placed = self.places.iter().enumerate().filter_map(|(id, place)| Some((ValueId(id as u32), (*place)?)));
        let mut all = placed.chain(self.waiting.iter().copied());
        all.find(|(_, place)| (place.offset..place.lane(place.lanes)).contains(&offset)).map(|(id, _)| id)
    }
}
