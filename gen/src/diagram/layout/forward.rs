//! Which arrows point from left to right. With the others reversed, there are no cycles.

use super::super::model::Diagram;

/// For each arrow, whether it points from left to right.
pub(super) fn forward(diagram: &Diagram) -> Vec<bool> {
    let mut search = Search {
        diagram,
        leaving: vec![Vec::new(); diagram.boxes.len()],
        state: vec![State::New; diagram.boxes.len()],
        forward: vec![true; diagram.arrows.len()],
    };
    for (index, arrow) in diagram.arrows.iter().enumerate() {
        search.leaving[arrow.from].push(index);
    }
    // Streams and data are followed first, so that control points back rather than they.
    search.leaving.iter_mut().for_each(|arrows| arrows.sort_by_key(|index| (diagram.arrows[*index].kind, *index)));
    (0..diagram.boxes.len()).for_each(|index| search.visit(index));
    search.forward
}

#[derive(Clone, Copy, PartialEq)]
enum State {
    New,
    /// It is on the path from the start of the search.
    OnTheWay,
    Done,
}

struct Search<'a> {
    diagram: &'a Diagram,
    leaving: Vec<Vec<usize>>,
    state: Vec<State>,
    forward: Vec<bool>,
}

impl Search<'_> {
    /// Visits a box and all that it reaches. An arrow back to the path is reversed.
    fn visit(&mut self, from: usize) {
        if self.state[from] != State::New {
            return;
        }
        self.state[from] = State::OnTheWay;
        let mut way = vec![(from, 0)];
        while let Some((at, next)) = way.pop() {
            let Some(arrow) = self.leaving[at].get(next).copied() else {
                self.state[at] = State::Done;
                continue;
            };
            way.push((at, next + 1));
            let to = self.diagram.arrows[arrow].to;
            match self.state[to] {
                State::New => {
                    self.state[to] = State::OnTheWay;
                    way.push((to, 0));
                }
                State::OnTheWay => self.forward[arrow] = false,
                State::Done => {}
            }
        }
    }
}
