//! Records whose fields lie side by side in words.

use super::Kind;

/// A record that a module packs into words or takes out of them. A viewer of waves shows such a word by its fields.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { at: bits(4) } out { page: bits(6) }
/// bundle! { struct Entry<T> { resident: T, page: T } }
///
/// let layout = Entry { resident: bit(), page: bits(6) };
/// let page = m.memory("table", 16, layout, ReadUnderWrite::Any).fill(0).read(i.at).page;
/// #     ShownOut { page }
/// # };
/// let entry = &design.top().records[0];
/// assert_eq!((entry.of, entry.width()), ("Entry", 7));
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Record {
    /// The name of its type.
    pub of: &'static str,
    /// Its fields, the first most significant.
    pub fields: Vec<Field>,
}

impl Record {
    /// The width of its words in bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_hdl::ir::{Field, Kind, Record};
    ///
    /// let field = |name: &str, width| Field { name: name.to_owned(), width, kind: Kind::Number };
    /// assert_eq!(Record { of: "Pixel", fields: vec![field("z", 24), field("colour", 24)] }.width(), 48);
    /// ```
    pub fn width(&self) -> u64 {
        self.fields.iter().map(|field| u64::from(field.width)).sum()
    }
}

/// A field of a record.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { x: bits(8), y: bits(8) } out { point: bits(16) }
/// bundle! { struct Point<T> { x: T, y: T } }
///
/// let point = Point { x: i.x, y: i.y }.pack();
/// #     ShownOut { point }
/// # };
/// let fields = design.top().records[0].fields.iter().map(|field| (field.name.as_str(), field.width));
/// assert_eq!(fields.collect::<Vec<_>>(), [("x", 8), ("y", 8)]);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Field {
    /// Its name, such as `page`; in a record within the record `entry_page`, as nets are called.
    pub name: String,
    /// Its width in bits.
    pub width: u32,
    /// The meaning of its bits.
    pub kind: Kind,
}
