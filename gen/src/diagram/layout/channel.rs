//! The vertical pieces of lines in the channels between columns.

use super::layers::Layers;
use super::slots::Stops;
use std::collections::BTreeMap;

/// Lines that share a vertical piece: all arrows from one exit, or a later step of one arrow.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Net {
    Exit(usize),
    Step(usize, usize),
}

/// The space between two columns.
#[derive(Default)]
pub(super) struct Channel {
    /// The track of each net with a vertical piece, counted from the left.
    pub tracks: BTreeMap<Net, usize>,
    /// The number of tracks.
    pub count: usize,
}

/// The net of a step of an arrow.
pub(super) fn net(stops: &[Stops], arrow: usize, step: usize) -> Net {
    if step == 0 { Net::Exit(stops[arrow].exit) } else { Net::Step(arrow, step) }
}

/// The heights of a net on both sides of a channel.
#[derive(Default)]
struct Heights {
    left: Vec<f64>,
    right: Vec<f64>,
}

/// The channels right of each column.
pub(super) fn channels(layers: &Layers, stops: &[Stops]) -> Vec<Channel> {
    let mut nets: Vec<BTreeMap<Net, Heights>> = Vec::new();
    nets.resize_with(layers.columns, BTreeMap::new);
    for (arrow, way) in stops.iter().enumerate() {
        for (step, ends) in way.at.windows(2).enumerate() {
            let [left, right] = if ends[0].0 < ends[1].0 { [ends[0], ends[1]] } else { [ends[1], ends[0]] };
            let heights = nets[left.0].entry(net(stops, arrow, step)).or_default();
            heights.left.push(left.1);
            heights.right.push(right.1);
        }
    }
    nets.iter().map(channel).collect()
}

/// A vertical piece.
struct Piece<'a> {
    net: Net,
    heights: &'a Heights,
    top: f64,
    bottom: f64,
    goes_down: bool,
}

impl Piece<'_> {
    fn meets(&self, other: &Piece) -> bool {
        self.top < other.bottom + NEAR && other.top < self.bottom + NEAR
    }

    /// Whether the other has to be further left: it starts at the height where this one ends, and would lie on it.
    fn is_behind(&self, other: &Piece) -> bool {
        let near = |y: &f64| other.heights.left.iter().any(|it| (it - y).abs() < 1.0);
        self.heights.right.iter().any(near)
    }
}

/// The least gap between pieces of one track.
const NEAR: f64 = 4.0;

fn channel(nets: &BTreeMap<Net, Heights>) -> Channel {
    let mut pieces: Vec<Piece> = nets.iter().filter_map(|(net, heights)| piece(*net, heights)).collect();
    // Pieces that go down do not cross if the lowest is leftmost; those that go up, if the highest is.
    pieces.sort_by(|a, b| {
        let key = |it: &Piece| {
            let first = it.heights.left.iter().copied().fold(f64::INFINITY, f64::min);
            if it.goes_down { -first } else { first }
        };
        (!a.goes_down).cmp(&!b.goes_down).then(key(a).total_cmp(&key(b)))
    });
    let mut channel = Channel::default();
    let mut placed: Vec<(Piece, usize)> = Vec::new();
    while !pieces.is_empty() {
        let waits = |piece: &Piece| pieces.iter().any(|other| other.net != piece.net && piece.is_behind(other));
        let next = pieces.iter().position(|piece| !waits(piece)).unwrap_or(0);
        let piece = pieces.remove(next);
        let follows =
            |other: &Piece| piece.is_behind(other) || (other.goes_down == piece.goes_down && other.meets(&piece));
        let after = placed.iter().filter(|(other, _)| follows(other)).map(|(_, track)| track + 1).max().unwrap_or(0);
        let is_free = |track: &usize| !placed.iter().any(|(other, it)| it == track && other.meets(&piece));
        let track = (after..).find(is_free).expect("a track is free");
        channel.tracks.insert(piece.net, track);
        channel.count = channel.count.max(track + 1);
        placed.push((piece, track));
    }
    channel
}

/// The vertical piece of a net, unless it is straight.
fn piece(net: Net, heights: &Heights) -> Option<Piece<'_>> {
    let all = || heights.left.iter().chain(&heights.right).copied();
    let (top, bottom) = (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
    let mean = |ys: &[f64]| ys.iter().sum::<f64>() / ys.len() as f64;
    let goes_down = mean(&heights.right) >= mean(&heights.left);
    (bottom - top > 0.01).then_some(Piece { net, heights, top, bottom, goes_down })
}
