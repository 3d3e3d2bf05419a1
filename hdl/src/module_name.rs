//! The names of modules, made from the block's type name and the `Debug` text of its parameters.

use crate::names::{is_reserved, short};

/// A longer name has a number in place of the parameters.
const LONGEST: usize = 80;

/// `Counter { width: 8, limit: 10 }` makes `counter_width8_limit10`.
///
/// - A parameter has the name of its field. If two fields share a name, the name of the record around each comes
///   first.
/// - A record's own name is omitted if its field has the same one: in `screen: Screen { .. }`, but not in
///   `mode: Fast { .. }`.
/// - A field that is `true` appears by its name; a field that is `false` is omitted.
/// - A clock appears by its name only, because clocks of one name are one clock in a design: `read: VIDEO` makes
///   `read_video`.
/// - A value with the same name as its field appears once: a clock `read` as `read`.
/// - Type arguments follow the block's name: `Queue<Pixel>` makes `queue_pixel`.
/// - If the name cannot show everything (text with spaces, lists of lists), a number made from the whole `Debug` text
///   distinguishes it.
/// - A name that would be too long is the block's and that number: `video_timing_cf621dd1`. The header of the Verilog
///   has the parameters.
pub(crate) fn module_name(type_name: &'static str, parameters: &str) -> String {
    let mut name = snake_case(short(type_name));
    let arguments = type_name.split_once('<').map_or("", |(_, arguments)| arguments);
    for argument in arguments.split(|c: char| !c.is_ascii_alphanumeric() && c != '_' && c != ':') {
        let argument = argument.rsplit("::").next().unwrap_or(argument);
        if !argument.is_empty() && argument != "Signal" {
            name += &format!("_{}", snake_case(argument));
        }
    }
    let values = parameters.strip_prefix(short(type_name)).unwrap_or(parameters);
    let (parameters_in_words, is_whole) = in_words(values);
    let number = || format!("_{:08x}", hash(&format!("{arguments} {parameters}")));
    let end = if is_whole { parameters_in_words } else { parameters_in_words + &number() };
    if name.len() + end.len() > LONGEST {
        let number = number();
        name.truncate(LONGEST - number.len());
        name += &number;
    } else {
        name += &end;
    }
    if is_reserved(&name) { format!("{name}_") } else { name }
}

/// The parameters, each after a `_`, and whether the text is complete.
fn in_words(parameters: &str) -> (String, bool) {
    let (values, is_whole) = Reader::default().read(parameters);
    let mut words = String::new();
    let mut before = None;
    for (index, (path, value)) in values.iter().enumerate() {
        let is_list = before == Some(path) || values.get(index + 1).is_some_and(|(next, _)| next == path);
        let key = if before == Some(path) { String::new() } else { key(path, &values) };
        before = Some(path);
        words += &match value.as_str() {
            "true" if !is_list && !key.is_empty() => format!("_{key}"),
            "false" if !is_list && !key.is_empty() => String::new(),
            _ if key.is_empty() => format!("_{value}"),
            word if word == key => format!("_{key}"),
            number if number.starts_with(digit) && !key.ends_with(digit) => format!("_{key}{number}"),
            word => format!("_{key}_{word}"),
        };
    }
    (words, is_whole)
}

/// The last field of a path, after as many others as distinguish it from the other paths.
fn key(path: &[String], values: &[Value]) -> String {
    let tells = |count: &usize| {
        let end = &path[path.len() - count..];
        values.iter().all(|(other, _)| other == path || !other.ends_with(end))
    };
    let count = (1..=path.len()).find(tells).unwrap_or(path.len());
    path[path.len() - count..].join("_")
}

/// A number, a variant or a text as a part of a name, with the path of its field.
type Value = (Vec<String>, String);

/// Reads the `Debug` text.
#[derive(Default)]
struct Reader {
    values: Vec<Value>,
    /// For each open bracket: its character, the field before it, and the number of values so far.
    around: Vec<(char, Option<String>, usize)>,
    /// The field whose value is being read.
    field: Option<String>,
    is_shortened: bool,
}

impl Reader {
    fn read(mut self, mut text: &str) -> (Vec<Value>, bool) {
        while let Some(c) = text.chars().next() {
            let rest = &text[c.len_utf8()..];
            text = match c {
                '"' | '\'' => self.text(rest, c),
                '-' if rest.starts_with(digit) => {
                    let end = rest.find(|c| !digit(c)).unwrap_or(rest.len());
                    self.value(format!("minus{}", &rest[..end]));
                    &rest[end..]
                }
                _ if c.is_ascii_alphanumeric() || c == '_' => self.word(text),
                _ => {
                    self.mark(c);
                    rest
                }
            };
        }
        (self.values, !self.is_shortened)
    }

    fn mark(&mut self, c: char) {
        match c {
            '{' | '(' | '[' => {
                // The boundary between two lists is not visible.
                self.is_shortened |= c == '[' && self.around.iter().any(|(open, ..)| *open == '[');
                self.is_shortened |= c == '[' && self.values.iter().any(|(path, _)| *path == self.path());
                self.around.push((c, self.field.take(), self.values.len()));
            }
            '}' | ')' | ']' => {
                if let Some((open, field, count)) = self.around.pop() {
                    self.field = field;
                    if open == '[' && count == self.values.len() {
                        self.value("empty".to_owned());
                    }
                }
            }
            ',' => self.field = None,
            _ => {}
        }
    }

    fn value(&mut self, value: String) {
        self.values.push((self.path(), value));
    }

    /// The fields that lead to the present place.
    fn path(&self) -> Vec<String> {
        let fields = self.around.iter().map(|(_, field, _)| field).chain([&self.field]);
        fields.flatten().cloned().collect()
    }

    /// The name of a field, a record, a clock or a variant, or a number.
    fn word<'a>(&mut self, text: &'a str) -> &'a str {
        if let Some((name, rest)) = clock(text) {
            self.words(name);
            return rest;
        }
        let end = text.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(text.len());
        let (word, rest) = text.split_at(end);
        let name = snake_case(word);
        if rest.starts_with(':') && !rest.starts_with("::") {
            self.field = Some(name);
        } else if rest.starts_with(" {") || rest.starts_with('(') {
            let says_it = |field: &String| name.starts_with(field);
            if word != "Some" && !self.field.as_ref().is_some_and(says_it) {
                self.value(name);
            }
        } else if word == "PhantomData" {
            // Its type is an argument of the block's.
            return rest.find([',', '}', ')']).map_or("", |end| &rest[end..]);
        } else {
            self.value(name);
        }
        rest
    }

    /// The text between quotes.
    fn text<'a>(&mut self, text: &'a str, quote: char) -> &'a str {
        let mut escaped = false;
        let end = text.find(|c| {
            let ends = c == quote && !escaped;
            escaped = c == '\\' && !escaped;
            ends
        });
        let (text, rest) = text.split_at(end.unwrap_or(text.len()));
        self.words(text);
        rest.get(1..).unwrap_or("")
    }

    /// The words of a text in small letters.
    fn words(&mut self, text: &str) {
        let words = text.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
        let words = words.collect::<Vec<_>>().join("_").to_ascii_lowercase();
        self.is_shortened |= words != text;
        if words.is_empty() {
            self.value("empty".to_owned());
        } else {
            self.value(words);
        }
    }
}

/// The name of the [`Clock`](crate::Clock) that is printed first, and the text after it.
fn clock(printed: &str) -> Option<(&str, &str)> {
    let (name, rest) = printed.strip_prefix("Clock { name: \"")?.split_once("\", period: Period(")?;
    let (_, rest) = rest.split_once(')')?;
    // A reset and an edge that are not the usual ones may follow.
    let (_, rest) = rest.split_once('}')?;
    Some((name, rest))
}

fn digit(c: char) -> bool {
    c.is_ascii_digit()
}

fn snake_case(name: &str) -> String {
    let mut snake = String::new();
    let mut previous = '_';
    for c in name.chars() {
        if c.is_ascii_uppercase() && (previous.is_ascii_lowercase() || previous.is_ascii_digit()) {
            snake.push('_');
        }
        snake.push(c.to_ascii_lowercase());
        previous = c;
    }
    snake
}

/// A hash that does not depend on the build, so that another compiler changes no name (FNV-1a).
fn hash(text: &str) -> u32 {
    text.bytes().fold(0x811c_9dc5, |hash, byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;
    use std::marker::PhantomData;

    use super::*;
    use tilewright_circuit::Reset;
    use tilewright_circuit::{Clock, Period};

    fn named<B: std::fmt::Debug>(block: B) -> String {
        module_name(std::any::type_name::<B>(), &format!("{block:?}"))
    }

    #[derive(Debug)]
    struct Size {
        #[expect(dead_code, reason = "Debug shows it")]
        width: u32,
        #[expect(dead_code, reason = "Debug shows it")]
        height: u32,
    }

    #[derive(Debug)]
    enum Mode {
        Off,
        RoundRobin {
            #[expect(dead_code, reason = "Debug shows it")]
            ports: u32,
        },
    }

    /// A block of one parameter.
    #[derive(Debug)]
    struct Table<T> {
        #[expect(dead_code, reason = "Debug shows it")]
        of: T,
    }

    /// Blocks whose `Debug` text is the text given here.
    fn printed(block: &'static str) -> String {
        module_name(block.split([' ', '(']).next().unwrap(), block)
    }

    #[test]
    fn parameters_have_the_names_of_their_fields() {
        assert_eq!(printed("Counter { width: 8, limit: 10 }"), "counter_width8_limit10");
        assert_eq!(printed("Pim"), "pim");
        assert_eq!(printed("PageIdGenerator(12)"), "page_id_generator_12");
        assert_eq!(printed("Table"), "table_");
        assert_eq!(printed("Delay { stage2: 3, offset: -4 }"), "delay_stage2_3_offset_minus4");
    }

    #[test]
    fn records_among_the_parameters() {
        assert_eq!(
            printed("Loopback { baud: Baud { clock_hz: 100000000, baud: 10000000 }, depth: 16 }"),
            "loopback_clock_hz100000000_baud10000000_depth16"
        );
        assert_eq!(
            printed(
                "Vc1 { lfb: LfbUnit { patches: Patches { screen: Screen { width: 16 }, edge: 4 }, pages: 4 }, processors: 2 }"
            ),
            "vc1_width16_edge4_pages4_processors2"
        );
        let scaler = "Scaler { from: Size { width: 4, height: 3 }, to: Size { width: 8, height: 6 }, taps: 2 }";
        assert_eq!(printed(scaler), "scaler_from_size_from_width4_from_height3_to_size_to_width8_to_height6_taps2");
        assert_eq!(printed("Crossing { clocks: [3, 1, 2], last: 1 }"), "crossing_clocks3_1_2_last1");
    }

    #[test]
    fn enums_truth_and_what_is_missing() {
        assert_eq!(printed("Inverter { registered: true }"), "inverter_registered");
        assert_eq!(printed("Inverter { registered: false }"), "inverter");
        assert_eq!(
            printed("Queue { depth: Some(4), limit: None, mask: [true, false] }"),
            "queue_depth4_limit_none_mask_true_false"
        );
        assert!(named(Table { of: Mode::Off }).ends_with("_of_off"));
        assert!(named(Table { of: Mode::RoundRobin { ports: 3 } }).ends_with("_of_round_robin_ports3"));
        assert_eq!(printed("Rom { words: [] }"), "rom_words_empty");
    }

    #[test]
    fn types_count() {
        let names = [named(Table { of: 1u8 }), named(Table { of: 1u64 }), named(Table { of: PhantomData::<Size> })];
        assert_eq!(names, ["table_u8_of1", "table_u64_of1", "table_phantom_data_size"]);
        assert_eq!(named(Table { of: Size { width: 1, height: 2 } }), "table_size_of_size_width1_height2");
    }

    #[test]
    fn clocks_are_there_by_their_names() {
        #[derive(Debug)]
        #[expect(dead_code, reason = "Debug shows them")]
        struct Crossing {
            depth: u32,
            write: Clock,
            read: Option<Clock>,
            others: Vec<Clock>,
        }
        let clock = |name| Clock::new(name, Period::ns(10));
        let crossing = Crossing { depth: 4, write: clock("host"), read: Some(clock("read")), others: Vec::new() };
        assert_eq!(named(crossing), "crossing_depth4_write_host_read_others_empty");
        let others = vec![clock("a").reset(Reset::AsynchronousLow), clock("b2")];
        let crossing = Crossing { depth: 4, write: clock("write").reset(Reset::PowerOn), read: None, others };
        assert_eq!(named(crossing), "crossing_depth4_write_read_none_others_a_b2");
        let others = vec![clock("a"), clock("b2")];
        let crossing = Crossing { depth: 4, write: clock("write"), read: None, others };
        assert_eq!(named(crossing), "crossing_depth4_write_read_none_others_a_b2");
        assert_eq!(printed("Timed(Clock { name: \"video\", period: Period(40000) })"), "timed_video");
        assert_eq!(printed("Timed { clock: Clock { hz: 5 } }"), "timed_hz5", "another type of that name");
    }

    #[test]
    fn text_is_whole_or_has_a_number() {
        assert_eq!(printed("Font { face: \"serif_8\" }"), "font_face_serif_8");
        let [space, dash, upper] = ["a b", "a-b", "A b"].map(|face| named(Table { of: face }));
        assert!(space.starts_with("table_str_of_a_b_") && dash.starts_with("table_str_of_a_b_"), "{space}, {dash}");
        assert!(space != dash && space != upper && dash != upper);
        assert_eq!(named(Table { of: "" }), "table_str_of_empty");
        assert_eq!(named(Table { of: r#"say "}" {"# }), named(Table { of: r#"say "}" {"# }));
    }

    #[test]
    fn what_differs_has_another_name_and_no_name_is_long() {
        let mut names = BTreeMap::new();
        let lists = [vec![vec![1, 2], vec![3]], vec![vec![1], vec![2, 3]], vec![vec![], vec![1, 2, 3]]];
        for list in lists {
            assert_eq!(names.insert(named(Table { of: list.clone() }), list), None);
        }
        assert_ne!(printed("Ports([1, 2], [3])"), printed("Ports([1], [2, 3])"));
        let long = |last: u32| named(Table { of: (0..100).chain([last]).collect::<Vec<u32>>() });
        assert_ne!(long(1), long(2));
        let number = long(1).strip_prefix("table_vec_u32_").map(str::len);
        assert_eq!(number, Some(8), "{}", long(1));
        let timing = "VideoTiming { h_visible: 640, h_front: 16, h_sync: 96, h_back: 48, v_visible: 480, v_front: 10, v_sync: 2 }";
        assert_eq!(printed(timing), format!("video_timing_{:08x}", hash(&format!(" {timing}"))));
        let type_name = "Abcdefghijklmnopqrstuvwxyzabcdefghijklmnopqrstuvwxyzabcdefghijklmnopqrstuvwxyzabcdefgh";
        assert_eq!(printed(type_name).len(), LONGEST);
    }
}
