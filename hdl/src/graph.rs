//! The graph algorithms that the checks need, all iterative and in linear time.

/// Which of `0..count` can reach themselves: the strongly connected components of more than one vertex or with an
/// edge to itself, each sorted (Tarjan's algorithm with an explicit stack).
pub(crate) fn cyclic_components(edges: &Edges) -> Vec<Vec<u32>> {
    const NEW: u32 = u32::MAX;
    let count = edges.count();
    let (mut index, mut low, mut on_stack) = (vec![NEW; count], vec![0; count], vec![false; count]);
    let (mut stack, mut work, mut next, mut found) = (Vec::new(), Vec::new(), 0, Vec::new());
    for root in 0..count as u32 {
        if index[root as usize] != NEW {
            continue;
        }
        work.push((root, 0));
        while let Some((vertex, edge)) = work.pop() {
            let v = vertex as usize;
            if edge == 0 {
                (index[v], low[v], on_stack[v]) = (next, next, true);
                next += 1;
                stack.push(vertex);
            }
            if let Some(&to) = edges.of(vertex).get(edge) {
                work.push((vertex, edge + 1));
                match index[to as usize] {
                    NEW => work.push((to, 0)),
                    seen if on_stack[to as usize] => low[v] = low[v].min(seen),
                    _ => {}
                }
                continue;
            }
            if let Some(&(parent, _)) = work.last() {
                low[parent as usize] = low[parent as usize].min(low[v]);
            }
            if low[v] == index[v] {
                let at = stack.iter().rposition(|&member| member == vertex).expect("a root is on the stack");
                let mut component = stack.split_off(at);
                component.iter().for_each(|&member| on_stack[member as usize] = false);
                if component.len() > 1 || edges.of(vertex).contains(&vertex) {
                    component.sort_unstable();
                    found.push(component);
                }
            }
        }
    }
    found.sort();
    found
}

/// Every vertex after those that it has edges to, where no cycle forbids it.
pub(crate) fn targets_first(edges: &Edges) -> Vec<u32> {
    let (mut order, mut begun, mut work) = (Vec::new(), vec![false; edges.count()], Vec::new());
    for root in 0..edges.count() as u32 {
        work.push((root, 0));
        while let Some((vertex, edge)) = work.pop() {
            if edge == 0 && std::mem::replace(&mut begun[vertex as usize], true) {
                continue;
            }
            match edges.of(vertex).get(edge) {
                Some(&to) => {
                    work.push((vertex, edge + 1));
                    work.push((to, 0));
                }
                None => order.push(vertex),
            }
        }
    }
    order
}

/// A shortest cycle through `start` within `component`, which is sorted.
pub(crate) fn cycle_through(edges: &Edges, component: &[u32], start: u32) -> Vec<u32> {
    let place = |vertex: u32| component.binary_search(&vertex).ok();
    let mut from = vec![None; component.len()];
    let mut queue = std::collections::VecDeque::from([start]);
    while let Some(vertex) = queue.pop_front() {
        for &to in edges.of(vertex) {
            if to == start {
                let mut cycle = vec![vertex];
                while *cycle.last().expect("not empty") != start {
                    let at = place(*cycle.last().expect("not empty")).expect("in the component");
                    cycle.push(from[at].expect("reached from the start"));
                }
                cycle.reverse();
                return cycle;
            }
            if let Some(at) = place(to)
                && from[at].is_none()
            {
                from[at] = Some(vertex);
                queue.push_back(to);
            }
        }
    }
    unreachable!("every vertex of a cyclic component is on a cycle")
}

/// For each vertex the vertices it has edges to, side by side in one list.
pub(crate) struct Edges {
    starts: Vec<u32>,
    targets: Vec<u32>,
}

impl Edges {
    /// `list` calls its second argument with each target of the vertex.
    pub fn new(count: usize, mut list: impl FnMut(u32, &mut dyn FnMut(u32))) -> Edges {
        let (mut starts, mut targets) = (vec![0], Vec::new());
        for vertex in 0..count as u32 {
            list(vertex, &mut |target| targets.push(target));
            starts.push(targets.len() as u32);
        }
        Edges { starts, targets }
    }

    pub fn count(&self) -> usize {
        self.starts.len() - 1
    }

    pub fn of(&self, vertex: u32) -> &[u32] {
        &self.targets[self.starts[vertex as usize] as usize..self.starts[vertex as usize + 1] as usize]
    }

    /// The same edges the other way round.
    pub fn reversed(&self) -> Edges {
        let mut lists = vec![Vec::new(); self.count()];
        for vertex in 0..self.count() as u32 {
            self.of(vertex).iter().for_each(|&to| lists[to as usize].push(vertex));
        }
        Edges::new(self.count(), |vertex, push| lists[vertex as usize].iter().for_each(|&to| push(to)))
    }
}

/// A set of small numbers for each vertex.
#[derive(Clone)]
pub(crate) struct Sets {
    words: usize,
    bits: Vec<u64>,
}

impl Sets {
    pub fn new(vertices: usize, members: usize) -> Sets {
        let words = members.div_ceil(64).max(1);
        Sets { words, bits: vec![0; vertices * words] }
    }

    pub fn insert(&mut self, vertex: u32, member: usize) {
        self.bits[vertex as usize * self.words + member / 64] |= 1 << (member % 64);
    }

    pub fn members(&self, vertex: u32) -> impl Iterator<Item = usize> + '_ {
        let row = &self.bits[vertex as usize * self.words..][..self.words];
        row.iter()
            .enumerate()
            .flat_map(|(i, &word)| (0..64).filter(move |bit| word >> bit & 1 == 1).map(move |b| i * 64 + b))
    }

    /// Adds to every vertex the members of its operands, until nothing changes.
    pub fn spread(&mut self, operands: &Edges) {
        let users = operands.reversed();
        let mut queue: std::collections::VecDeque<u32> = (0..operands.count() as u32).collect();
        let mut queued = vec![true; operands.count()];
        while let Some(vertex) = queue.pop_front() {
            queued[vertex as usize] = false;
            for &user in users.of(vertex) {
                let mut changed = false;
                for word in 0..self.words {
                    let add = self.bits[vertex as usize * self.words + word];
                    let into = &mut self.bits[user as usize * self.words + word];
                    changed |= add & !*into != 0;
                    *into |= add;
                }
                if changed && !queued[user as usize] {
                    queued[user as usize] = true;
                    queue.push_back(user);
                }
            }
        }
    }
}
