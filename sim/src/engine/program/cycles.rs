//! Combinational cycles, found without recursion, so that chains may have any depth.

use super::{Circuit, ValueId};

/// The cells of combinational cycles, and those on paths between cycles.
pub(super) fn cycles(circuit: &Circuit) -> Vec<ValueId> {
    let graph = Graph::new(circuit);
    let count = circuit.len();
    let forward = graph.peel(&graph.operands, &graph.users, vec![true; count]);
    if forward.len() == count {
        return Vec::new();
    }
    let mut left = vec![true; count];
    forward.into_iter().for_each(|cell| left[cell as usize] = false);
    for cell in graph.peel(&graph.users, &graph.operands, left.clone()) {
        left[cell as usize] = false;
    }
    circuit.ids().filter(|id| left[id.index()]).collect()
}

/// Both directions of the circuit's edges.
struct Graph {
    operands: Edges,
    users: Edges,
}

/// For each cell the cells at the other end, in one list.
struct Edges {
    starts: Vec<u32>,
    ends: Vec<u32>,
}

impl Edges {
    fn of(&self, cell: u32) -> &[u32] {
        &self.ends[self.starts[cell as usize] as usize..self.starts[cell as usize + 1] as usize]
    }

    fn reversed(&self) -> Edges {
        let count = self.starts.len() - 1;
        let mut starts = vec![0; count + 1];
        self.ends.iter().for_each(|&end| starts[end as usize + 1] += 1);
        (0..count).for_each(|i| starts[i + 1] += starts[i]);
        let mut next = starts.clone();
        let mut ends = vec![0; self.ends.len()];
        for cell in 0..count as u32 {
            for &end in self.of(cell) {
                ends[next[end as usize] as usize] = cell;
                next[end as usize] += 1;
            }
        }
        Edges { starts, ends }
    }
}

impl Graph {
    fn new(circuit: &Circuit) -> Graph {
        let mut operands = Edges { starts: vec![0], ends: Vec::new() };
        for (_, cell) in circuit.cells() {
            cell.kind.for_each_operand(|operand| operands.ends.push(operand.0));
            operands.starts.push(operands.ends.len() as u32);
        }
        Graph { users: operands.reversed(), operands }
    }

    /// Removes, in sequence, every cell in `among` that has no `before` left there.
    fn peel(&self, before: &Edges, after: &Edges, among: Vec<bool>) -> Vec<u32> {
        let cells = || (0..among.len() as u32).filter(|&cell| among[cell as usize]);
        let mut waiting = vec![0; among.len()];
        for cell in cells() {
            waiting[cell as usize] = before.of(cell).iter().filter(|&&other| among[other as usize]).count();
        }
        let mut taken: Vec<u32> = cells().filter(|&cell| waiting[cell as usize] == 0).collect();
        let mut next = 0;
        while next < taken.len() {
            for &user in after.of(taken[next]).iter().filter(|&&user| among[user as usize]) {
                waiting[user as usize] -= 1;
                if waiting[user as usize] == 0 {
                    taken.push(user);
                }
            }
            next += 1;
        }
        taken
    }
}
