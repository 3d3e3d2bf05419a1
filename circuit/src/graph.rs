//! The graph algorithms that the checks need, all iterative and in linear time.

/// The strongly connected components of `0..count` that have several vertices or an edge to themselves, each sorted:
/// the vertices that can reach themselves.
pub fn cyclic_components(edges: &Edges) -> Vec<Vec<u32>> {
    let mut found = Vec::new();
    components(edges, |component| {
        if is_cyclic(edges, component) {
            let mut component = component.to_vec();
            component.sort_unstable();
            found.push(component);
        }
    });
    found.sort();
    found
}

/// Whether the vertices of a component reach themselves.
pub fn is_cyclic(edges: &Edges, component: &[u32]) -> bool {
    component.len() > 1 || edges.of(component[0]).contains(&component[0])
}

/// Calls `visit` with each strongly connected component, after all components that it has edges to (Tarjan's
/// algorithm with an explicit stack).
pub fn components(edges: &Edges, mut visit: impl FnMut(&[u32])) {
    const NEW: u32 = u32::MAX;
    let count = edges.count();
    let (mut index, mut low, mut on_stack) = (vec![NEW; count], vec![0; count], vec![false; count]);
    let (mut stack, mut work, mut next) = (Vec::new(), Vec::new(), 0);
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
                stack[at..].iter().for_each(|&member| on_stack[member as usize] = false);
                visit(&stack[at..]);
                stack.truncate(at);
            }
        }
    }
}

/// The vertices in topological order, targets first, except within cycles.
pub fn targets_first(edges: &Edges) -> Vec<u32> {
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
pub fn cycle_through(edges: &Edges, component: &[u32], start: u32) -> Vec<u32> {
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

/// For each vertex, the targets of its edges, all in one list.
pub struct Edges {
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
}

/// A set of small numbers for each vertex.
#[derive(Clone)]
pub struct Sets {
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

    /// Adds to every vertex the members of all vertices that it is computed from.
    pub fn spread(&mut self, operands: &Edges) {
        let mut union = vec![0; self.words];
        components(operands, |component| {
            union.fill(0);
            for &vertex in component {
                for &from in operands.of(vertex).iter().chain([&vertex]) {
                    let from = &self.bits[from as usize * self.words..][..self.words];
                    union.iter_mut().zip(from).for_each(|(all, some)| *all |= some);
                }
            }
            for &vertex in component {
                self.bits[vertex as usize * self.words..][..self.words].copy_from_slice(&union);
            }
        });
    }
}
