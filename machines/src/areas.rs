//! Parts of the screen that a unit works on as a whole for some time: windows of a quadtree, pages of a local frame buffer.

use std::collections::BTreeMap;

/// A part of the screen that a unit works on as a whole for some time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Area {
    /// The begin, in picoseconds from the beginning of the run.
    pub from: u64,
    /// The end; [`u64::MAX`] if it lasts to the end of the run.
    pub to: u64,
    /// The number of the unit that draws.
    pub painter: u32,
    /// The number of divisions of the screen that lead to it; 0 if it is not one of several levels.
    pub level: u32,
    /// The column and the row of the upper left pixel.
    pub place: [u32; 2],
    /// The width and the height in pixels.
    pub size: [u32; 2],
}

/// The areas of a run while it goes on, each of which has a key until it ends.
#[derive(Debug)]
pub(crate) struct Areas<K> {
    open: BTreeMap<K, usize>,
    all: Vec<Area>,
}

impl<K: Ord> Areas<K> {
    pub fn new() -> Areas<K> {
        Areas { open: BTreeMap::new(), all: Vec::new() }
    }

    /// Whether the area of that key goes on.
    pub fn has(&self, key: &K) -> bool {
        self.open.contains_key(key)
    }

    /// An area begins.
    pub fn begin(&mut self, key: K, area: Area) {
        self.open.insert(key, self.all.len());
        self.all.push(area);
    }

    /// The area of that key ends at that time, if there is one.
    pub fn end(&mut self, time: u64, key: &K) {
        if let Some(number) = self.open.remove(key) {
            self.all[number].to = time;
        }
    }

    /// The areas of all such keys end at that time.
    pub fn end_all(&mut self, time: u64, is_meant: impl Fn(&K) -> bool) {
        let all = &mut self.all;
        self.open.retain(|key, number| {
            let ends = is_meant(key);
            if ends {
                all[*number].to = time;
            }
            !ends
        });
    }

    /// All areas, sorted by their begin.
    pub fn take(mut self) -> Vec<Area> {
        self.all.sort_by_key(|area| area.from);
        self.all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_area_lasts_until_its_key_ends() {
        let area = |from| Area { from, to: u64::MAX, painter: 0, level: 0, place: [0; 2], size: [4; 2] };
        let mut areas = Areas::new();
        areas.begin((0, 7), area(10));
        areas.begin((1, 7), area(20));
        assert!(areas.has(&(0, 7)) && !areas.has(&(0, 8)));
        areas.end_all(30, |(unit, _)| *unit == 0);
        assert!(!areas.has(&(0, 7)));
        areas.begin((0, 7), area(40));
        areas.end(50, &(0, 8));
        areas.end(60, &(1, 7));
        let times: Vec<_> = areas.take().iter().map(|area| (area.from, area.to)).collect();
        assert_eq!(times, [(10, 30), (20, 60), (40, u64::MAX)]);
    }
}
