//! A processing element's local frame buffer while it is drawn into: the patch table, its generator of pages, and what reaches the image memory.

use tilewright_rtl::vc1::Vc1;

use super::image::Image;
use super::{Followed, Sim, net, pe};
use crate::looks::{Looks, Words};
use crate::told::{At, Told, compared, hex, yes};
use crate::vc1::scan_conversion::Pixel;

/// The states of a look-up, as the patch table numbers them.
const IDLE: u64 = 0;
const EXAMINE: u64 = 2;

/// A drawn pixel, whether it is the followed one, and the number of its primitive.
pub(super) type Drawn = (Pixel, bool, Option<usize>);

/// The models of a local frame buffer's units, by their inputs.
pub(super) struct Drawing {
    number: u32,
    nets: Nets,
    followed: Followed,
    patches: tilewright_rtl::lfb::Patches,
    page_bits: u32,
    /// By patch and buffer, the page.
    table: Vec<Option<u32>>,
    /// Pages that the generator has given since its restart.
    taken: u32,
    /// The front buffer.
    front: u32,
    look_up: Option<LookUp>,
    pub image: Image,
    /// The followed entry was cleared at the last edge.
    cleared: bool,
    /// The frame has ended for it.
    ended: bool,
}

/// A look-up under way.
struct LookUp {
    drawn: Drawn,
    patch: u32,
    offset: u32,
    /// The entry in the model, and in the hardware once it is read.
    expected: Option<u32>,
    entry: Option<[u64; 2]>,
    /// The page that the generator gave for it.
    given: Option<u64>,
    began: u64,
}

/// The nets that are looked at together, while a look-up is under way, and after those of its image memory.
const LOOKED_AT: [&str; 8] = [
    "u_patch_table.stage1",
    "u_patch_table.found",
    "u_patch_table.page",
    "u_patch_table.entry_resident",
    "u_patch_table.entry_page",
    "u_patch_table.u_page_id_generator.take",
    "u_patch_table.u_page_id_generator.page",
    "front",
];

/// Nets and their names.
struct Nets {
    looks: Looks,
    /// The place of the first one of [`LOOKED_AT`].
    place: usize,
    found: String,
    page: String,
    entry: String,
    given: String,
    asked: String,
    entries: Words,
    front: String,
    request: [String; 3],
    /// The request, and the patch that is asked for.
    port: Looks,
}

/// The values of [`LOOKED_AT`].
struct Seen {
    stage: u64,
    found: bool,
    page: u64,
    entry: [u64; 2],
    takes: bool,
    given: u64,
    front: u64,
}

impl Nets {
    fn new(unit: &str, looks: Looks, place: usize) -> Nets {
        let table = |name: &str| format!("{unit}.u_patch_table.{name}");
        let request = ["x", "y", "word"].map(|it| format!("{unit}.request_{it}"));
        let asked = table("look_up_patch");
        let mut port = Looks::default();
        port.add("", request.iter().chain([&asked]).map(|it| &**it));
        Nets {
            looks,
            place,
            found: table("found"),
            page: table("page"),
            entry: table("entry_page"),
            given: table("u_page_id_generator.page"),
            asked,
            entries: Words::of(table("entries")),
            front: format!("{unit}.front"),
            request,
            port,
        }
    }

    fn seen(&self) -> Seen {
        let [stage, found, page, resident, entry, takes, given, front] = self.looks.from(self.place);
        Seen { stage, found: found == 1, page, entry: [resident, entry], takes: takes == 1, given, front }
    }
}

impl Drawing {
    pub fn new(number: u32, machine: &Vc1, followed: Followed) -> Drawing {
        let unit = format!("u_lfb[{number}]");
        let mut looks = Looks::default();
        let image = Image::new(number, &unit, &machine.lfb, &mut looks);
        let place = looks.add(&format!("{unit}."), LOOKED_AT);
        let nets = Nets::new(&unit, looks, place);
        let patches = machine.lfb.patches;
        Drawing {
            number,
            followed,
            patches,
            page_bits: u32::BITS - (machine.lfb.pages - 1).leading_zeros(),
            table: vec![None; 2 * patches.count() as usize],
            taken: 0,
            front: 0,
            look_up: None,
            image,
            cleared: false,
            ended: false,
            nets,
        }
    }

    fn at(&self, unit: &str, block: &'static str, clock: u64) -> At {
        let unit = format!("{unit} of PE {}", self.number);
        At { unit, block, edge: pe(clock) }
    }

    /// Whether something is under way.
    pub fn is_busy(&self) -> bool {
        self.look_up.is_some() || self.image.is_busy() || self.cleared
    }

    /// The page of the followed patch in a buffer.
    pub fn page(&self, buffer: u32) -> Option<u32> {
        self.table[(2 * self.followed.patch + buffer) as usize]
    }

    /// The buffer that is drawn into.
    pub fn front(&self) -> u32 {
        self.front
    }

    /// The processor clears an entry.
    pub fn clears(&mut self, patch: u32) {
        self.table[(2 * patch + self.front) as usize] = None;
        self.cleared = patch == self.followed.patch && !self.ended;
    }

    /// The unit takes a pixel at the coming edge.
    pub fn takes(&mut self, sim: &mut Sim, clock: u64, drawn: Drawn, told: &mut Told) {
        let (pixel, is_followed, primitive) = drawn;
        let place = self.patches.place(pixel.x, pixel.y);
        let (patch, offset) = (place.patch as u32, place.offset as u32);
        if is_followed {
            let at = At { unit: format!("PE {}", self.number), block: "vc1", edge: pe(clock) };
            let golden = if primitive.is_some() { hex(pixel.word) } else { "nothing".to_owned() };
            let values = vec![compared("word", hex(pixel.word), golden)];
            told.tell(at.step("draws the pixel", values).of(primitive).on(&self.nets.request[2]));
        }
        self.nets.port.look(sim);
        let [x, y, came, asked] = self.nets.port.from(0);
        if (x, y, came) != (pixel.x.into(), pixel.y.into(), pixel.word) {
            told.check("request", self.number, false, || {
                let values = vec![
                    compared("pixel", format!("{x},{y}"), format!("{},{}", pixel.x, pixel.y)),
                    compared("word", hex(came), hex(pixel.word)),
                ];
                self.at("port", "vc1", clock).step("passes the pixel on", values).on(&self.nets.request[2])
            });
        }
        if is_followed || asked != u64::from(patch) {
            told.check("locate", self.number, is_followed, || {
                let values = vec![compared("patch", asked, patch)];
                let at = self.at("local frame buffer", "lfb-unit", clock);
                at.step("locates the pixel", values).of(primitive).on(&self.nets.asked)
            });
        }
        if let Some(lost) = self.look_up.take() {
            self.loses(clock, &lost, told);
        }
        let expected = self.table[(2 * patch + self.front) as usize];
        self.look_up = Some(LookUp { drawn, patch, offset, expected, entry: None, given: None, began: clock });
    }

    /// Looks at the units before an edge.
    pub fn look(&mut self, sim: &mut Sim, clock: u64, told: &mut Told) {
        if std::mem::take(&mut self.cleared) {
            self.looks_at_cleared(sim, clock, told);
        }
        if !self.image.is_busy() && self.look_up.is_none() {
            return;
        }
        self.nets.looks.look(sim);
        self.image.look(sim, clock, &self.nets.looks, told);
        let Some(mut look_up) = self.look_up.take() else { return };
        let seen = self.nets.seen();
        if seen.stage == EXAMINE {
            look_up.entry = Some(seen.entry);
            self.examines(clock, &look_up, told);
        }
        if seen.takes {
            self.gives(clock, seen.given, &look_up, told);
            look_up.given = Some(seen.given);
            self.taken += 1;
        }
        if seen.found {
            return self.finds(sim, clock, (look_up, &seen), told);
        }
        if seen.stage == IDLE && clock > look_up.began + 1 {
            return self.loses(clock, &look_up, told);
        }
        self.look_up = Some(look_up);
    }

    fn looks_at_cleared(&mut self, sim: &mut Sim, clock: u64, told: &mut Told) {
        let entry = self.nets.entries.word(sim, 2 * self.followed.patch + self.front);
        let is_resident = entry >> self.page_bits & 1 == 1;
        if is_resident {
            told.check("clear", self.number, false, || {
                let at = self.at("patch table", "patch-table", clock);
                let does = format!("clears the entry of patch {}", self.followed.patch);
                at.step(does, vec![compared("has a page", "yes", "no")]).on(&self.nets.entries.name)
            });
        }
    }

    /// The table has read the entry.
    fn examines(&self, clock: u64, look_up: &LookUp, told: &mut Told) {
        let LookUp { drawn: (_, is_followed, primitive), expected, entry, patch, .. } = *look_up;
        let [resident, page] = entry.unwrap_or_default();
        let is_right = match expected {
            Some(expected) => [resident, page] == [1, expected.into()],
            None => resident == 0,
        };
        if is_followed || !is_right {
            told.check("examine", self.number, is_followed, || {
                let entry =
                    |resident: bool, page: u64| if resident { format!("page {page}") } else { "no page".to_owned() };
                let golden = entry(expected.is_some(), expected.unwrap_or_default().into());
                let values = vec![compared("entry", entry(resident == 1, page), golden)];
                let at = self.at("patch table", "patch-table", clock);
                at.step(format!("looks up patch {patch}"), values).of(primitive).on(&self.nets.entry)
            });
        }
    }

    /// The generator gives a page.
    fn gives(&self, clock: u64, given: u64, look_up: &LookUp, told: &mut Told) {
        let (_, is_followed, primitive) = look_up.drawn;
        if is_followed || given != u64::from(self.taken) {
            told.check("page", self.number, is_followed, || {
                let values = vec![compared("page", given, self.taken)];
                let at = self.at("page ID generator", "page-id-generator", clock);
                at.step("names the next free page", values).of(primitive).on(&self.nets.given)
            });
        }
    }

    /// The look-up ends.
    fn finds(&mut self, sim: &mut Sim, clock: u64, (look_up, seen): (LookUp, &Seen), told: &mut Told) {
        let LookUp { drawn, patch, offset, expected, given, .. } = look_up;
        let ((_, is_followed, primitive), page) = (drawn, seen.page);
        // A patch that had no page takes the one that the generator gave.
        let golden = expected.map(u64::from).or(given);
        let entry = self.nets.entries.word(sim, 2 * patch + self.front);
        let kept = (entry >> self.page_bits & 1 == 1).then_some(entry & ((1 << self.page_bits) - 1));
        let took = (given.is_some(), expected.is_none());
        if is_followed || Some(page) != golden || kept != golden || took.0 != took.1 {
            told.check("found", self.number, is_followed, || {
                let shown = |page: Option<u64>| page.map_or("none".to_owned(), |page| page.to_string());
                let values = vec![
                    compared("page", page, shown(golden)),
                    compared("entry afterwards", shown(kept), shown(golden)),
                    compared("takes a new page", yes(took.0), yes(took.1)),
                ];
                let at = self.at("patch table", "patch-table", clock);
                at.step(format!("finds the page of patch {patch}"), values).of(primitive).on(&self.nets.page)
            });
        }
        self.table[(2 * patch + self.front) as usize] = Some(page as u32);
        self.image.takes(clock, (drawn, page, [offset, self.front]), &self.nets.looks, told);
        let front = seen.front;
        if front != u64::from(self.front) {
            told.check("front", self.number, false, || {
                let at = self.at("local frame buffer", "lfb-unit", clock);
                at.step("draws into a buffer", vec![compared("buffer", front, self.front)]).on(&self.nets.front)
            });
        }
    }

    /// A look-up ended without a page.
    fn loses(&self, clock: u64, look_up: &LookUp, told: &mut Told) {
        let LookUp { drawn: (_, is_followed, primitive), patch, .. } = *look_up;
        told.check("lost", self.number, is_followed, || {
            let at = self.at("patch table", "patch-table", clock);
            let values = vec![compared("page", "nothing", "a page")];
            at.step(format!("finds the page of patch {patch}"), values).of(primitive).on(&self.nets.found)
        });
    }

    /// Whether the followed patch has a page in the front buffer.
    pub fn has_page(&self) -> bool {
        self.page(self.front).is_some()
    }

    /// The buffers were exchanged at that edge, at the end of the frame or in an overflow.
    pub fn swaps(&mut self, sim: &mut Sim, clock: u64, ends: bool, told: &mut Told) {
        let is_told = self.has_page() && !self.ended;
        self.ended |= ends;
        self.front ^= 1;
        self.taken = 0;
        self.image.swaps(self.front);
        let front = net(sim, &self.nets.front);
        if is_told || front != u64::from(self.front) {
            told.check("front", self.number, is_told, || {
                let at = self.at("local frame buffer", "lfb-unit", clock);
                let values = vec![compared("front buffer", front, self.front)];
                at.step("exchanges its buffers", values).on(&self.nets.front)
            });
        }
    }
}
