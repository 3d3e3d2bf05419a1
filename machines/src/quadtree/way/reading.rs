//! The read-out: the video controller asks the video buffers for the pixel, and puts it into its group.

use tilewright_scenes::frame::blank;

use super::buffer::Buffer;
use super::{Followed, Sim, net, nothing};
use crate::looks::Looks;
use crate::told::{At, Edge, Told, compared, hex};

/// The model of the controller: a counter of the groups that it has asked for.
pub(super) struct Reading {
    followed: Followed,
    background: u64,
    /// Groups that were asked for.
    asked: u32,
    /// The followed pixel's group was asked for at the last edge.
    is_due: bool,
    /// The word that the buffer sent, and whether the group with it has come.
    sent: Option<u64>,
    is_read: bool,
    /// Whether it asks for a group, and which one; then what the video processor is asked for.
    looks: Looks,
}

impl Reading {
    pub fn new(followed: &Followed, background: [u8; 3]) -> Reading {
        let (followed, mut looks) = (followed.clone(), Looks::default());
        looks.add("u_controller.", ["asks", "column", "line"]);
        looks.add(&format!("u_processor[{}].scan_", followed.processor), ["x", "y", "enable"]);
        Reading { followed, background: blank(background), asked: 0, is_due: false, sent: None, is_read: false, looks }
    }

    fn at(edge: Edge) -> At {
        At { unit: "video controller".to_owned(), block: "video-controller", edge }
    }

    /// Looks before an edge.
    pub fn look(&mut self, sim: &mut Sim, edge: Edge, buffer: &Buffer, told: &mut Told) {
        self.sends(sim, edge, buffer, told);
        self.looks.look(sim);
        if self.looks.at(0) == 1 {
            self.asks(edge, told);
        }
    }

    /// The buffer sends the word in the clock after it was asked for.
    fn sends(&mut self, sim: &mut Sim, edge: Edge, buffer: &Buffer, told: &mut Told) {
        if std::mem::take(&mut self.is_due) {
            let name = format!("u_processor[{}].word", self.followed.processor);
            let (sent, golden) = (net(sim, &name), buffer.word());
            let unit = format!("video buffer of processor {}", self.followed.processor);
            let at = At { unit, block: "video-buffer", edge };
            told.tell(at.step("sends the pixel", vec![compared("word", hex(sent), hex(golden))]).on(name));
            self.sent = Some(sent);
        }
    }

    fn asks(&mut self, edge: Edge, told: &mut Told) {
        let columns = self.followed.format.columns();
        let [column, line] = [self.asked % columns, self.asked / columns];
        self.asked += 1;
        let seen = self.looks.from(1).map(|number| number as u32);
        let matrix = self.followed.format.matrix();
        let Followed { x, y, row, .. } = self.followed;
        let is_it = [column, line] == [x, y * matrix.rows() + row];
        if is_it || seen != [column, line] {
            let [scan_x, scan_y, enable] = self.looks.from(3).map(|number| number as u32);
            told.check("asks", 0, is_it, || {
                let mut values = vec![compared(
                    "group",
                    format!("{} of line {}", seen[0], seen[1]),
                    format!("{column} of line {line}"),
                )];
                if is_it {
                    let asked = if enable == 1 { format!("{scan_x},{scan_y}") } else { "nothing".to_owned() };
                    values.push(compared("sample", asked, format!("{x},{y}")));
                }
                Reading::at(edge).step("asks for the pixel's group", values).on("u_controller.column")
            });
        }
        self.is_due = is_it;
    }

    /// The host gets a group of pixels from that number on, of which that many are on the line.
    pub fn group(
        &mut self,
        sim: &mut Sim,
        edge: Edge,
        ([first, count], buffer): ([usize; 2], &Buffer),
        told: &mut Told,
    ) {
        self.sends(sim, edge, buffer, told);
        let pixel = self.followed.pixel as usize;
        if !(first..first + count).contains(&pixel) {
            return;
        }
        self.is_read = true;
        let lane = pixel - first;
        let name = format!("pixels_payload[{lane}]");
        let word = net(sim, &name);
        let empty = (1 << self.followed.format.word()) - 1;
        let golden = self.sent.map(|sent| if sent == empty { self.background } else { sent });
        let golden = golden.map_or("nothing".to_owned(), hex);
        told.tell(Reading::at(edge).step("puts out the pixel", vec![compared("word", hex(word), golden)]).on(name));
    }

    /// All pixels have been read.
    pub fn ends(&mut self, edge: Edge, told: &mut Told) {
        if !self.is_read {
            let does = "puts out the pixel".to_owned();
            told.tell(nothing("video controller".to_owned(), "video-controller", edge, does, "a word"));
        }
    }
}
