//! The tree of causes, made of the nodes of a walk.

use std::collections::VecDeque;

use super::names::Shown;
use super::operation::Place;
use super::walk::{Node, Walk};
use super::{Cause, End, Part};
use crate::engine::program::hierarchy::Role;

/// A part of the tree below a node: the node, whether it chose, and whether it is told at another place.
type Below = (usize, bool, bool);

impl Walk<'_> {
    /// The tree, whose root is the first node.
    pub(super) fn tree(&self) -> Cause {
        // Each node is told where it is closest to the root.
        let mut below: Vec<Vec<Below>> = vec![Vec::new(); self.nodes.len()];
        let mut is_told = vec![false; self.nodes.len()];
        let mut is_cut = vec![false; self.nodes.len()];
        is_told[0] = true;
        let (mut open, mut sequence) = (VecDeque::from([0]), Vec::new());
        while let Some(node) = open.pop_front() {
            sequence.push(node);
            let (all, cut) = self.shown_below(node);
            is_cut[node] = cut;
            for (to, chooses) in all {
                let is_again = std::mem::replace(&mut is_told[to], true);
                below[node].push((to, chooses, is_again));
                if !is_again {
                    open.push_back(to);
                }
            }
        }
        let mut told: Vec<Option<Cause>> = self.nodes.iter().map(|_| None).collect();
        for node in sequence.into_iter().rev() {
            let causes = below[node].iter().map(|&(to, chooses, is_again)| {
                let mut cause =
                    if is_again { self.cause(&self.nodes[to]) } else { told[to].take().expect("it is below") };
                cause.chooses = chooses;
                cause.end = if is_again { cause.end.or(Some(End::Elsewhere)) } else { cause.end };
                cause
            });
            let causes = causes.collect();
            let it = self.cause(&self.nodes[node]);
            let end = it.end.or(is_cut[node].then_some(End::Cut));
            told[node] = Some(Cause { causes, end, ..it });
        }
        told[0].take().expect("the root is told")
    }

    /// The shown nodes that decided a node, data first, and whether some of it was not followed.
    fn shown_below(&self, node: usize) -> (Vec<(usize, bool)>, bool) {
        let mut found: Vec<(usize, bool)> = Vec::new();
        let (mut seen, mut is_cut) = (std::collections::BTreeSet::new(), false);
        let edges = |node: usize, chooses: bool| {
            self.nodes[node].edges.iter().rev().map(move |(to, control)| (*to, chooses | control))
        };
        let mut open: Vec<(usize, bool)> = edges(node, false).collect();
        while let Some((node, chooses)) = open.pop() {
            if self.nodes[node].is_shown {
                match found.iter_mut().find(|(other, _)| *other == node) {
                    Some((_, also)) => *also &= chooses,
                    None => found.push((node, chooses)),
                }
            } else if seen.insert((node, chooses)) {
                is_cut |= self.nodes[node].end == Some(End::Cut);
                open.extend(edges(node, chooses));
            }
        }
        if !self.limits.operations {
            found.retain(|(node, _)| self.nodes[*node].end != Some(End::Constant));
        }
        found.sort_by_key(|(_, chooses)| *chooses);
        (found, is_cut)
    }

    /// A node without what is below it.
    fn cause(&self, node: &Node) -> Cause {
        let Node { place, lane, clock, cycle, time, .. } = *node;
        let Shown { name, value, bits, meaning, role } =
            self.names.show(&self.program, place, lane, &node.value, &node.bits);
        let (loc, part) = match place {
            Place::Word(..) => (None, Part::Word),
            Place::Value(id) => {
                let part = match role {
                    Some(Role::Register) => Part::Register,
                    Some(Role::ReadData) => Part::ReadData,
                    _ if node.end == Some(End::Input) => Part::Input,
                    Some(_) => Part::Net,
                    None => Part::Operation,
                };
                (self.program.circuit.loc(id), part)
            }
        };
        let clocks = &self.program.clocks;
        let clock = if clocks.len() > 1 { Some(clocks[clock].name.clone()) } else { None };
        let (chooses, causes, end) = (false, Vec::new(), node.end);
        Cause { name, part, value, bits, meaning, clock, cycle, time, loc, chooses, end, causes }
    }
}
