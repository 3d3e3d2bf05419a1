//! A sequence of boxes in which most arrows point from one box to a later one that is near.

use super::super::model::{BoxKind, Diagram};

/// All boxes. An input comes just before the first box that it feeds, an output just after the last box that feeds it. Boxes of a frame follow
/// one another.
pub(super) fn sequence(diagram: &Diagram, forward: &[bool]) -> Vec<usize> {
    let mut feeding: Vec<Vec<usize>> = vec![Vec::new(); diagram.boxes.len()];
    for (arrow, forward) in diagram.arrows.iter().zip(forward).filter(|(arrow, _)| arrow.from != arrow.to) {
        let (from, to) = if *forward { (arrow.from, arrow.to) } else { (arrow.to, arrow.from) };
        feeding[to].push(from);
    }
    let mut places: Vec<Option<usize>> = vec![None; diagram.boxes.len()];
    let is_input = |index: &usize| diagram.boxes[*index].kind == BoxKind::Input && feeding[*index].is_empty();
    let mut next = 0;
    let mut put = |places: &mut Vec<Option<usize>>, index: usize| {
        places[index] = Some(next);
        next += 1;
    };
    loop {
        // A box that only inputs keep waiting. The fewest are best, then the box that is nearest to what feeds it.
        let missing = |index: &usize| feeding[*index].iter().filter(|it| places[**it].is_none()).count();
        let is_next = |index: &usize| {
            let inputs_alone = |it: &usize| places[*it].is_some() || is_input(it);
            places[*index].is_none() && !is_input(index) && feeding[*index].iter().all(inputs_alone)
        };
        let latest = |index: usize| feeding[index].iter().filter_map(|it| places[*it]).max();
        let best = (0..places.len()).filter(is_next).max_by_key(|index| {
            let few = std::cmp::Reverse(missing(index));
            (few, latest(*index), std::cmp::Reverse(*index))
        });
        let Some(best) = best else { break };
        let mut inputs: Vec<usize> = feeding[best].iter().copied().filter(|it| places[*it].is_none()).collect();
        inputs.sort_unstable();
        inputs.dedup();
        inputs.into_iter().chain([best]).for_each(|index| put(&mut places, index));
    }
    let rest: Vec<usize> = (0..places.len()).filter(|index| places[*index].is_none()).collect();
    rest.into_iter().for_each(|index| put(&mut places, index));
    let places: Vec<usize> = places.into_iter().flatten().collect();
    by_frames(diagram, &places)
}

/// The boxes by their places, those of a frame together where the first of them is.
fn by_frames(diagram: &Diagram, places: &[usize]) -> Vec<usize> {
    let mut firsts = vec![usize::MAX; diagram.frames.len()];
    let around = |frame: Option<usize>| std::iter::successors(frame, |it| diagram.frames[*it].frame);
    for (it, place) in diagram.boxes.iter().zip(places) {
        around(it.frame).for_each(|frame| firsts[frame] = firsts[frame].min(*place));
    }
    let key = |index: &usize| {
        let mut key: Vec<usize> = around(diagram.boxes[*index].frame).map(|frame| firsts[frame]).collect();
        key.reverse();
        key.push(places[*index]);
        key
    };
    let mut sequence: Vec<usize> = (0..places.len()).collect();
    sequence.sort_by_key(key);
    sequence
}
