//! Parts of the screen that units work on for some time, as the page reads them.

use crate::columns::{differences, packed_columns};
use serde::{Serialize, Serializer};

/// The areas of a frame, which the page lays over the picture.
///
/// ```
/// use tilewright_view::{Area, Areas};
///
/// let area = Area { from: 3, to: 9, unit: 0, level: 1, place: [4, 0], size: [4, 4] };
/// let areas = Areas { name: "pages".to_owned(), levels: 1, list: vec![area] };
/// assert!(String::from_utf8(areas.json()).unwrap().contains("\"count\":1"));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Areas {
    /// What they are, such as `pages`.
    pub name: String,
    /// The greatest level, or 0 if there is only one.
    pub levels: u32,
    /// All of them, by their begin.
    pub list: Vec<Area>,
}

/// A part of the screen, and the clocks from its begin up to the one after its end.
///
/// ```
/// let area = tilewright_view::Area { from: 3, to: 9, unit: 0, level: 1, place: [4, 0], size: [4, 4] };
/// assert_eq!(area.to - area.from, 6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Area {
    /// The first clock.
    pub from: u32,
    /// The clock after the last one.
    pub to: u32,
    /// The number of the unit.
    pub unit: u32,
    /// The number of divisions of the screen that lead to it.
    pub level: u32,
    /// The column and the row of the upper left pixel.
    pub place: [u16; 2],
    /// The width and the height in pixels.
    pub size: [u16; 2],
}

impl Areas {
    /// The data of the page, as JSON.
    ///
    /// ```
    /// let areas = tilewright_view::Areas { name: "pages".to_owned(), levels: 0, list: Vec::new() };
    /// assert!(areas.json().starts_with(b"{\"name\":\"pages\""));
    /// ```
    pub fn json(&self) -> Vec<u8> {
        serde_json::to_vec(self).expect("it has names for keys")
    }
}

impl Serialize for Areas {
    /// Five columns: begins as differences, lengths, units with levels, places and sizes.
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        let column = |of: fn(&Area) -> u32| self.list.iter().map(of).collect::<Vec<u32>>();
        let columns = [
            differences(&column(|it| it.from)),
            column(|it| it.to - it.from),
            column(|it| it.level << 16 | it.unit),
            column(|it| u32::from(it.place[1]) << 16 | u32::from(it.place[0])),
            column(|it| u32::from(it.size[1]) << 16 | u32::from(it.size[0])),
        ];
        let mut areas = to.serialize_struct("Areas", 4)?;
        areas.serialize_field("name", &self.name)?;
        areas.serialize_field("levels", &self.levels)?;
        areas.serialize_field("count", &self.list.len())?;
        areas.serialize_field("list", &packed_columns(&columns))?;
        areas.end()
    }
}
