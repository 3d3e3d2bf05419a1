//! The width of columns and channels, which gives everything its place.

use super::super::model::{Arrow, BoxKind, Diagram};
use super::channel::{Channel, net};
use super::dots::dots;
use super::layers::Layers;
use super::slots::{Stops, is_port};
use super::{Layout, Measure, Rect, Route};
use std::collections::BTreeSet;

/// Places everything.
pub(super) fn place(
    diagram: &Diagram,
    layers: &Layers,
    stops: &[Stops],
    channels: &[Channel],
    measure: &Measure,
) -> Layout {
    let spans = frame_columns(diagram, layers);
    let columns = Columns::of(layers, channels, &spans, measure);
    let rect = |index: usize| {
        let (column, rect) = layers.boxes[index];
        let room = columns.widths[column] - rect.width;
        let share = match diagram.boxes[index].kind {
            BoxKind::Input => 1.0,
            BoxKind::Output => 0.0,
            _ => 0.5,
        };
        let left = room * share;
        let left = if measure.is_whole { left.floor() } else { left };
        Rect { x: columns.lefts[column] + left, ..rect }
    };
    let boxes: Vec<Rect> = (0..diagram.boxes.len()).map(rect).collect();
    let frames = frames(diagram, &boxes, measure);
    let end = |of: usize| (&boxes[of], is_port(&diagram.boxes[of]));
    let route = |(index, arrow): (usize, &Arrow)| {
        columns.route(index, [end(arrow.from), end(arrow.to)], layers, stops, channels, measure)
    };
    let routes: Vec<Route> = diagram.arrows.iter().enumerate().map(route).collect();
    let dots = dots(&routes);
    let mut layout = Layout { width: 0.0, height: 0.0, boxes, frames, routes, dots };
    layout.normalize();
    layout
}

/// The first and the last column of each frame.
fn frame_columns(diagram: &Diagram, layers: &Layers) -> Vec<Option<[usize; 2]>> {
    let mut spans: Vec<Option<[usize; 2]>> = vec![None; diagram.frames.len()];
    for (it, (column, _)) in diagram.boxes.iter().zip(&layers.boxes) {
        let mut frame = it.frame;
        while let Some(index) = frame {
            let [first, last] = spans[index].unwrap_or([*column; 2]);
            spans[index] = Some([first.min(*column), last.max(*column)]);
            frame = diagram.frames[index].frame;
        }
    }
    spans
}

/// The rectangles of frames, around their contents.
fn frames(diagram: &Diagram, boxes: &[Rect], measure: &Measure) -> Vec<Rect> {
    let mut found: Vec<Option<Rect>> = vec![None; diagram.frames.len()];
    // Inner frames come later.
    for index in (0..diagram.frames.len()).rev() {
        let own = diagram.boxes.iter().zip(boxes).filter(|(it, _)| it.frame == Some(index)).map(|(_, rect)| *rect);
        let inner = (index + 1..diagram.frames.len()).filter(|it| diagram.frames[*it].frame == Some(index));
        let inside: Vec<Rect> = own.chain(inner.filter_map(|it| found[it])).collect();
        let title =
            (diagram.frames[index].name.chars().count() + 2 + diagram.frames[index].count.chars().count()) as f64;
        found[index] = around(&inside).map(|it| Rect {
            x: it.x - measure.frame,
            y: it.y - measure.frame_title,
            width: (it.width + 2.0 * measure.frame).max(title * measure.name + 2.0 * measure.pad[0]),
            height: it.height + measure.frame_title + measure.frame,
        });
    }
    found.into_iter().map(Option::unwrap_or_default).collect()
}

fn around(rects: &[Rect]) -> Option<Rect> {
    let least = |of: &dyn Fn(&Rect) -> f64| rects.iter().map(of).reduce(f64::min);
    let most = |of: &dyn Fn(&Rect) -> f64| rects.iter().map(of).reduce(f64::max);
    let (x, y) = (least(&|it| it.x)?, least(&|it| it.y)?);
    Some(Rect { x, y, width: most(&Rect::right)? - x, height: most(&Rect::bottom)? - y })
}

struct Columns {
    lefts: Vec<f64>,
    widths: Vec<f64>,
    /// The x of the first track right of each column.
    tracks: Vec<f64>,
}

impl Columns {
    fn of(layers: &Layers, channels: &[Channel], spans: &[Option<[usize; 2]>], measure: &Measure) -> Columns {
        let mut widths = vec![0.0f64; layers.columns];
        for (column, rect) in &layers.boxes {
            widths[*column] = widths[*column].max(rect.width);
        }
        for (passes, label) in layers.passes.iter().zip(&layers.labels) {
            if let Some((at, width)) = label {
                let column = passes[*at].0;
                widths[column] = widths[column].max(*width);
            }
        }
        let edges = |side: usize, column: usize| {
            spans.iter().flatten().filter(|span| span[side] == column).count() as f64 * measure.frame
        };
        let has_box: BTreeSet<usize> = layers.boxes.iter().map(|it| it.0).collect();
        let (mut lefts, mut tracks) = (Vec::new(), Vec::new());
        let mut x = edges(0, 0);
        for (column, width) in widths.iter().enumerate() {
            lefts.push(x);
            x += width + edges(1, column);
            let end = |column: usize| if has_box.contains(&column) { measure.channel } else { measure.track };
            x += end(column);
            tracks.push(x);
            let count = channels.get(column).map_or(0, |channel| channel.count);
            x += (count as f64 - 1.0).max(0.0) * measure.track + end(column + 1) + edges(0, column + 1);
        }
        Columns { lefts, widths, tracks }
    }

    fn route(
        &self,
        arrow: usize,
        ends: [(&Rect, bool); 2],
        layers: &Layers,
        stops: &[Stops],
        channels: &[Channel],
        measure: &Measure,
    ) -> Route {
        let at = &stops[arrow].at;
        let last = at.len() - 1;
        // The side of a port slopes towards its point.
        let side = |end: usize, is_right: bool, y: f64| {
            let (rect, is_port) = ends[end];
            let off = (y - rect.middle()[1]).abs() / (rect.height / 2.0);
            match is_right {
                true => rect.right() - if is_port { off * measure.point } else { 0.0 },
                false => rect.x,
            }
        };
        let mut points = vec![[side(0, at[1].0 > at[0].0, at[0].1), at[0].1]];
        for step in 0..last {
            let column = at[step].0.min(at[step + 1].0);
            if let Some(track) =
                channels[column].tracks.get(&net(stops, arrow, step)).filter(|_| at[step].1 != at[step + 1].1)
            {
                let x = self.tracks[column] + *track as f64 * measure.track;
                points.extend([[x, at[step].1], [x, at[step + 1].1]]);
            }
        }
        points.push([side(1, at[last - 1].0 > at[last].0, at[last].1), at[last].1]);
        let label = layers.labels[arrow].map(|(pass, width)| {
            let (column, y) = layers.passes[arrow][pass];
            let left = (self.widths[column] - width) / 2.0;
            let left = if measure.is_whole { left.floor() } else { left };
            let height = if measure.is_whole { 1.0 } else { measure.label_line / 2.0 };
            Rect { x: self.lefts[column] + left, y: y - height, width, height }
        });
        Route { points, exit: stops[arrow].exit, label }
    }
}

impl Layout {
    /// Moves everything to start at zero, and measures it.
    pub(super) fn normalize(&mut self) {
        let lines = self.routes.iter().flat_map(|route| {
            let points = route.points.iter().map(|[x, y]| Rect { x: *x, y: *y, width: 0.0, height: 0.0 });
            points.chain(route.label)
        });
        let all: Vec<Rect> = self.boxes.iter().chain(&self.frames).copied().chain(lines).collect();
        let Some(whole) = around(&all) else { return };
        let shift = |[x, y]: &mut [f64; 2]| {
            *x -= whole.x;
            *y -= whole.y;
        };
        let move_rect = |rect: &mut Rect| {
            rect.x -= whole.x;
            rect.y -= whole.y;
        };
        self.boxes.iter_mut().chain(&mut self.frames).for_each(move_rect);
        self.dots.iter_mut().for_each(|(dot, _)| shift(dot));
        for route in &mut self.routes {
            route.points.iter_mut().for_each(shift);
            route.label.iter_mut().for_each(move_rect);
        }
        (self.width, self.height) = (whole.width, whole.height);
    }
}
