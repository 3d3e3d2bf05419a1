//! The packets on the broadcast bus, in words of 32 bits.
//!
//! Source: VC1-APR, VC1-NET. The paper names the contents of packets, but no format; this format is our choice.
//!
//! | packet | words |
//! |---|---|
//! | command of the host | kind and frame, 19 of the view |
//! | scene, in immediate mode | kind and count; up to 1023 words of vertices, 6 each, and triangles, 3 each |
//! | polygon | kind and sender; for each vertex x above y, z, and r, g, b |
//!
//! The words of view and scene take time on the bus, but their contents are not used: the projection of a view is computed beforehand.

use tilewright_scenes::ScreenVertex;

/// Words of a command.
pub(crate) const COMMAND_WORDS: usize = 20;
/// Words of a polygon.
pub(crate) const POLYGON_WORDS: usize = 10;

const COMMAND: u32 = 1 << 24;
const POLYGON: u32 = 2 << 24;
const SCENE: u32 = 3 << 24;
const NUMBER: u32 = (1 << 24) - 1;

/// The most words of a packet with a part of the scene.
const MOST_WORDS: u32 = 1024;

/// A word on the bus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Word {
    pub word: u32,
    /// Whether it is the last word of its packet.
    pub last: bool,
}

/// The content of a packet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Message {
    /// Draw that frame.
    Command { frame: u32 },
    /// Draw your rows of that polygon.
    Polygon { sender: u32, vertices: [ScreenVertex; 3] },
    /// A part of the scene, with this number of words.
    Scene { words: u32 },
}

impl Message {
    /// The packet.
    pub fn words(&self) -> Vec<Word> {
        let words: Vec<u32> = match self {
            Message::Command { frame } => {
                let mut words = vec![0; COMMAND_WORDS];
                words[0] = COMMAND | frame & NUMBER;
                words
            }
            Message::Polygon { sender, vertices } => {
                let of_vertex = |vertex: &ScreenVertex| {
                    let [x, y] = [vertex.x, vertex.y].map(|position| position as u32 & 0xffff);
                    let [r, g, b] = vertex.rgb.map(u32::from);
                    [x << 16 | y, vertex.z, r << 16 | g << 8 | b]
                };
                [POLYGON | sender & NUMBER].into_iter().chain(vertices.iter().flat_map(of_vertex)).collect()
            }
            Message::Scene { words } => (0..=*words).map(|at| if at == 0 { SCENE | words } else { at }).collect(),
        };
        let last = words.len() - 1;
        words.into_iter().enumerate().map(|(at, word)| Word { word, last: at == last }).collect()
    }

    /// The packets for a scene of that number of words.
    fn scene(mut words: u64) -> Vec<Message> {
        let mut packets = Vec::new();
        while words > 0 {
            let part = words.min(u64::from(MOST_WORDS - 1)) as u32;
            packets.push(Message::Scene { words: part });
            words -= u64::from(part);
        }
        packets
    }

    /// The packets with which the host begins a frame: the scene, if it sends one with this number of words, and the command.
    pub fn begin(frame: u32, scene: Option<u64>) -> Vec<Message> {
        let mut packets = scene.map(Message::scene).unwrap_or_default();
        packets.push(Message::Command { frame });
        packets
    }

    /// The content of a complete packet; `None` if these words are not a packet.
    pub fn of_words(words: &[u32]) -> Option<Message> {
        let number = words[0] & NUMBER;
        match (words[0] & !NUMBER, words.len()) {
            (COMMAND, COMMAND_WORDS) => Some(Message::Command { frame: number }),
            (POLYGON, POLYGON_WORDS) => {
                let vertex = |at: usize| {
                    let [position, z, colour] = [words[at], words[at + 1], words[at + 2]];
                    let signed = |half: u32| i32::from(half as u16 as i16);
                    let [_, r, g, b] = colour.to_be_bytes();
                    ScreenVertex { x: signed(position >> 16), y: signed(position), z, rgb: [r, g, b] }
                };
                Some(Message::Polygon { sender: number, vertices: [1, 4, 7].map(vertex) })
            }
            (SCENE, length) if number as usize + 1 == length => Some(Message::Scene { words: number }),
            _ => None,
        }
    }

    /// Whether a packet that begins with that word is a polygon of that sender.
    pub fn is_of(first: u32, sender: u32) -> bool {
        first == POLYGON | sender & NUMBER
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vertex() -> impl Strategy<Value = ScreenVertex> {
        (any::<i16>(), any::<i16>(), 0..1u32 << 24, any::<[u8; 3]>()).prop_map(|(x, y, z, rgb)| ScreenVertex {
            x: x.into(),
            y: y.into(),
            z,
            rgb,
        })
    }

    proptest! {
        #[test]
        fn what_is_sent_is_received(vertices in [vertex(), vertex(), vertex()], number in 0..256_u32) {
            let polygon = Message::Polygon { sender: number, vertices };
            for (message, length) in [(polygon, POLYGON_WORDS), (Message::Command { frame: number }, COMMAND_WORDS)] {
                let words = message.words();
                prop_assert_eq!(words.len(), length);
                prop_assert!(words.iter().enumerate().all(|(at, word)| word.last == (at + 1 == length)));
                let words: Vec<u32> = words.iter().map(|it| it.word).collect();
                prop_assert_eq!(Message::of_words(&words), Some(message));
                prop_assert_eq!(Message::is_of(words[0], number), message == polygon);
                prop_assert!(!Message::is_of(words[0], number + 1));
            }
        }
    }

    #[test]
    fn what_is_no_packet_says_nothing() {
        assert_eq!(Message::of_words(&[COMMAND]), None);
        assert_eq!(Message::of_words(&[4 << 24; POLYGON_WORDS]), None);
        assert_eq!(Message::of_words(&[SCENE | 3; 3]), None);
    }

    #[test]
    fn a_scene_is_sent_in_packets() {
        assert_eq!(Message::scene(0), []);
        assert_eq!(Message::scene(1024), [1023, 1].map(|words| Message::Scene { words }));
        let words: Vec<u32> = Message::Scene { words: 2 }.words().iter().map(|it| it.word).collect();
        assert_eq!(
            (&words[..], Message::of_words(&words)),
            (&[SCENE | 2, 1, 2][..], Some(Message::Scene { words: 2 }))
        );
    }
}
