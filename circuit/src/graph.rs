//! The graph algorithms that the checks need, all iterative and in linear time.

use std::collections::BTreeMap;

/// A directed graph of `0..count`: the targets of all edges in one list, and the strongly connected components.
pub struct Graph {
    edges: Lists,
    components: Lists,
    /// Whether all edges lead to smaller vertices, so that there is no cycle.
    points_back: bool,
}

impl Graph {
    /// `list` calls its second argument with each target of the vertex.
    pub fn new(count: usize, mut list: impl FnMut(u32, &mut dyn FnMut(u32))) -> Graph {
        let (mut edges, mut points_back) = (Lists::new(), true);
        for vertex in 0..count as u32 {
            list(vertex, &mut |target| {
                points_back &= target < vertex;
                edges.members.push(target);
            });
            edges.close();
        }
        let components = if points_back { Lists::single(count) } else { components(&edges) };
        Graph { edges, components, points_back }
    }

    /// The targets of a vertex's edges.
    pub fn of(&self, vertex: u32) -> &[u32] {
        self.edges.at(vertex as usize)
    }

    /// The strongly connected components, each after all components that it has edges to.
    pub fn components(&self) -> impl Iterator<Item = &[u32]> {
        (0..self.components.count()).map(|place| self.components.at(place))
    }

    /// Whether the vertices of a component reach themselves.
    pub fn is_cyclic(&self, component: &[u32]) -> bool {
        component.len() > 1 || self.of(component[0]).contains(&component[0])
    }

    /// The components whose vertices reach themselves, each sorted.
    pub fn cyclic_components(&self) -> Vec<Vec<u32>> {
        if self.points_back {
            return Vec::new();
        }
        let cyclic = self.components().filter(|component| self.is_cyclic(component));
        let mut found: Vec<Vec<u32>> = cyclic.map(<[u32]>::to_vec).collect();
        found.iter_mut().for_each(|component| component.sort_unstable());
        found.sort();
        found
    }

    /// The vertices in topological order, targets first, except within cycles.
    pub fn targets_first(&self) -> Vec<u32> {
        let (mut order, mut begun, mut work) = (Vec::new(), vec![false; self.edges.count()], Vec::new());
        for root in 0..self.edges.count() as u32 {
            work.push((root, 0));
            while let Some((vertex, edge)) = work.pop() {
                if edge == 0 && std::mem::replace(&mut begun[vertex as usize], true) {
                    continue;
                }
                match self.of(vertex).get(edge) {
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
    pub fn cycle_through(&self, component: &[u32], start: u32) -> Vec<u32> {
        let place = |vertex: u32| component.binary_search(&vertex).ok();
        let mut from = vec![None; component.len()];
        let mut queue = std::collections::VecDeque::from([start]);
        while let Some(vertex) = queue.pop_front() {
            for &to in self.of(vertex) {
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
}

/// Lists of vertices, one after the other.
struct Lists {
    /// Where each list starts, and where the last one ends.
    starts: Vec<u32>,
    members: Vec<u32>,
}

impl Lists {
    fn new() -> Lists {
        Lists { starts: vec![0], members: Vec::new() }
    }

    /// A list for each vertex, of itself.
    fn single(count: usize) -> Lists {
        Lists { starts: (0..=count as u32).collect(), members: (0..count as u32).collect() }
    }

    /// Ends a list.
    fn close(&mut self) {
        self.starts.push(self.members.len() as u32);
    }

    fn count(&self) -> usize {
        self.starts.len() - 1
    }

    fn at(&self, place: usize) -> &[u32] {
        &self.members[self.starts[place] as usize..self.starts[place + 1] as usize]
    }
}

/// Tarjan's algorithm with an explicit stack.
fn components(edges: &Lists) -> Lists {
    const NEW: u32 = u32::MAX;
    let count = edges.count();
    let (mut index, mut low, mut on_stack) = (vec![NEW; count], vec![0; count], vec![false; count]);
    let (mut stack, mut work, mut next, mut found) = (Vec::new(), Vec::new(), 0, Lists::new());
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
            if let Some(&to) = edges.at(v).get(edge) {
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
                found.members.extend(stack.drain(at..));
                found.close();
            }
        }
    }
    found
}

/// Joined sets of `0..count`, each known by its first member.
pub struct Union(Vec<usize>);

impl Union {
    /// Each number is a set of its own.
    pub fn new(count: usize) -> Union {
        Union((0..count).collect())
    }

    /// The first member of a number's set.
    pub fn first(&mut self, mut member: usize) -> usize {
        while self.0[member] != member {
            self.0[member] = self.0[self.0[member]];
            member = self.0[member];
        }
        member
    }

    /// Joins the sets of two numbers.
    pub fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.first(a), self.first(b));
        self.0[a.max(b)] = a.min(b);
    }

    /// These members by their sets, in the sequence of the first members.
    pub fn sets(&mut self, of: impl IntoIterator<Item = usize>) -> Vec<Vec<usize>> {
        let mut sets: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for member in of {
            let first = self.first(member);
            sets.entry(first).or_default().push(member);
        }
        sets.into_values().collect()
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
    pub fn spread(&mut self, operands: &Graph) {
        for component in operands.components() {
            // All vertices of a component have the same members. The first one collects them.
            let (first, others) = (component[0], &component[1..]);
            others.iter().for_each(|&vertex| self.add(first, vertex));
            for &vertex in component {
                operands.of(vertex).iter().for_each(|&from| self.add(first, from));
            }
            others.iter().for_each(|&vertex| self.add(vertex, first));
        }
    }

    /// Adds the members of one vertex to another.
    fn add(&mut self, to: u32, from: u32) {
        let (to, from) = (to as usize * self.words, from as usize * self.words);
        // Most modules have few inputs.
        if self.words == 1 {
            self.bits[to] |= self.bits[from];
        } else {
            (0..self.words).for_each(|word| self.bits[to + word] |= self.bits[from + word]);
        }
    }
}
