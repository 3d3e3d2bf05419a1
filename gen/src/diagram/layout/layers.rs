//! The columns of boxes, by `dagre`.

use super::super::model::Diagram;
use super::{Measure, Rect};
use dagre::graph::{Graph, GraphOptions};
use dagre::{EdgeLabel, LayoutOptions, NodeLabel, RankDir, layout};

/// The column and height of boxes and lines.
pub(super) struct Layers {
    pub columns: usize,
    /// The column of each box and its rectangle, whose `x` is not known yet.
    pub boxes: Vec<(usize, Rect)>,
    /// For each arrow, the columns between its ends and the height at which it passes them.
    pub passes: Vec<Vec<(usize, f64)>>,
    /// Which of these passes has the label, and the label's width.
    pub labels: Vec<Option<(usize, f64)>>,
}

/// Layers of a diagram.
pub(super) fn layers(diagram: &Diagram, forward: &[bool], sizes: &[[f64; 2]], measure: &Measure) -> Layers {
    let graph = laid_out(diagram, forward, sizes, measure);
    let centre = |index: usize| {
        let node = graph.node(&box_name(index)).expect("every box is in the graph");
        [node.x.unwrap_or(0.0), node.y.unwrap_or(0.0)]
    };
    let centres: Vec<[f64; 2]> = (0..sizes.len()).map(centre).collect();
    let edges: Vec<&EdgeLabel> = (0..diagram.arrows.len())
        .map(|index| {
            let [from, to] = ends(diagram, forward, index);
            let edge = graph.edge(&from, &to, Some(&index.to_string()));
            edge.expect("every arrow is in the graph")
        })
        .collect();
    // The first and the last point lie on the boxes.
    let between = |(edge, forward): (&&EdgeLabel, &bool)| {
        let points = edge.points.get(1..edge.points.len().saturating_sub(1)).unwrap_or_default();
        let mut points: Vec<[f64; 2]> = points.iter().map(|point| [point.x, point.y]).collect();
        if !forward {
            points.reverse();
        }
        points
    };
    let passes: Vec<Vec<[f64; 2]>> = edges.iter().zip(forward).map(between).collect();
    let columns = columns(centres.iter().chain(passes.iter().flatten()).map(|point| point[0]));
    let column = |x: f64| columns.partition_point(|it| *it < x - SAME);
    let labels = edges.iter().zip(&passes).map(|(edge, passes)| {
        let x = edge.x.filter(|_| edge.width > 0.0)?;
        let at = passes.iter().position(|point| (point[0] - x).abs() < SAME)?;
        Some((at, edge.width))
    });
    let mut layers = Layers {
        columns: columns.len(),
        boxes: centres
            .iter()
            .zip(sizes)
            .map(|([x, y], [width, height])| {
                (column(*x), Rect { x: 0.0, y: y - height / 2.0, width: *width, height: *height })
            })
            .collect(),
        labels: labels.collect(),
        passes: passes.iter().map(|it| it.iter().map(|[x, y]| (column(*x), *y)).collect()).collect(),
    };
    if measure.is_whole {
        layers.round(measure);
    }
    layers
}

/// Smaller differences are rounding errors.
const SAME: f64 = 0.01;

fn box_name(index: usize) -> String {
    format!("b{index}")
}

fn frame_name(index: usize) -> String {
    format!("f{index}")
}

/// The boxes at the ends of an arrow, left one first.
fn ends(diagram: &Diagram, forward: &[bool], index: usize) -> [String; 2] {
    let arrow = &diagram.arrows[index];
    let [from, to] = [arrow.from, arrow.to].map(box_name);
    if forward[index] { [from, to] } else { [to, from] }
}

fn laid_out(diagram: &Diagram, forward: &[bool], sizes: &[[f64; 2]], measure: &Measure) -> Graph<NodeLabel, EdgeLabel> {
    let compound = !diagram.frames.is_empty();
    let mut graph = Graph::with_options(GraphOptions { directed: true, multigraph: true, compound });
    for index in 0..diagram.frames.len() {
        graph.set_node(frame_name(index), Some(NodeLabel::default()));
    }
    for (index, [width, height]) in sizes.iter().enumerate() {
        graph.set_node(box_name(index), Some(NodeLabel { width: *width, height: *height, ..NodeLabel::default() }));
    }
    for (index, frame) in diagram.frames.iter().enumerate() {
        if let Some(of) = frame.frame {
            graph.set_parent(&frame_name(index), Some(&frame_name(of)));
        }
    }
    for (index, it) in diagram.boxes.iter().enumerate() {
        if let Some(of) = it.frame {
            graph.set_parent(&box_name(index), Some(&frame_name(of)));
        }
    }
    for (index, arrow) in diagram.arrows.iter().enumerate() {
        let label = arrow.label();
        let [width, height] = match label.chars().count() {
            0 => [0.0, 0.0],
            count => [count as f64 * measure.label, measure.label_line],
        };
        let edge =
            EdgeLabel { width, height, labelpos: dagre::layout::types::LabelPos::Center, ..EdgeLabel::default() };
        let [from, to] = ends(diagram, forward, index);
        graph.set_edge(from, to, Some(edge), Some(&index.to_string()));
    }
    let level = |index: usize| std::iter::successors(Some(index), |index| diagram.frames[*index].frame).count();
    let levels = (0..diagram.frames.len()).map(level).max().unwrap_or(0);
    // `dagre` keeps room between the borders of frames that is enough for one level.
    let room = levels.saturating_sub(1) as f64 * measure.frame_title + if compound { measure.frame } else { 0.0 };
    let options = LayoutOptions {
        rankdir: RankDir::LR,
        nodesep: measure.box_gap + room,
        edgesep: measure.line_gap,
        ranksep: 10.0,
        ..LayoutOptions::default()
    };
    layout(&mut graph, Some(options));
    graph
}

/// The x of the columns' middles, from left to right.
fn columns(middles: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut columns: Vec<f64> = middles.collect();
    columns.sort_by(f64::total_cmp);
    columns.dedup_by(|a, b| (*a - *b).abs() < SAME);
    columns
}

impl Layers {
    /// Rounds heights to whole numbers without overlaps in a column.
    fn round(&mut self, measure: &Measure) {
        for column in 0..self.columns {
            let mut parts: Vec<(f64, f64, &mut f64, bool)> = Vec::new();
            for (_, rect) in self.boxes.iter_mut().filter(|it| it.0 == column) {
                parts.push((rect.y, rect.height, &mut rect.y, true));
            }
            for (passes, label) in self.passes.iter_mut().zip(&self.labels) {
                for (at, (_, y)) in passes.iter_mut().enumerate().filter(|(_, it)| it.0 == column) {
                    // A label takes the line above.
                    let above = if label.is_some_and(|it| it.0 == at) { measure.label_line - 1.0 } else { 0.0 };
                    parts.push((*y - above, above + 1.0, y, false));
                }
            }
            parts.sort_by(|a, b| a.0.total_cmp(&b.0));
            let (mut next, mut after_box) = (f64::NEG_INFINITY, false);
            for (top, height, y, is_box) in parts {
                let gap = if is_box && after_box { measure.box_gap } else { 0.0 };
                let top = top.round().max(next + gap);
                *y = if is_box { top } else { top + height - 1.0 };
                (next, after_box) = (top + height, is_box);
            }
        }
    }
}
