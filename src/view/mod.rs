//! `tilewright view`: a page in the browser that shows a frame coming into being, or a block clock by clock.

mod areas;
mod block;
mod frame;
mod moment;
pub mod nets;
mod open;
mod picture;
mod query;
mod recorded;
mod shelf;
mod way;

use crate::block::entries;
use crate::machine::Machine;
use crate::names::{self, are_alike, not_listed};
use crate::number::number;
use crate::scene::size;
use crate::shell::output::Folder;
use crate::shell::place::shown;
use crate::shell::{Exit, Failure, interrupt, progress, terminal};
use block::BlockSite;
use clap::Args;
use frame::FrameSite;
use std::ffi::OsString;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tilewright_hdl::catalog::Entry;
use tilewright_scenes::{Scene, Size, builtin};
use tilewright_view::{Server, Site, export};

/// Shows a scene on the machines, or a block, on a page in the browser
#[derive(Args)]
#[command(after_help = "\
Examples:
  tilewright view teapot
  tilewright view star --size 320x240 --machine pixelflow
  tilewright view merging-unit
  tilewright view fifo --set depth=8 --port 8080
  tilewright view star --size 160x120 --machine quadtree --export page
  tilewright view merging-unit --export block

The command prints the address of the page, and serves it until Ctrl-C. The exit code is then 0. The page needs no network: its server listens
on 127.0.0.1 alone. It answers only addresses with the token that it printed, and no page from elsewhere.

A scene: the frame comes into being by machine time. Each machine draws when the page asks for it, as `render` draws without options, and is compared
with the golden image. The page shows which unit wrote which pixel, and what each unit does. The camera turns when the picture is dragged. A click on a
pixel asks why it has its colour, as `why` tells it, and a step of the answer opens its block at that clock.

A block: its diagram, its wave, and the value of each net at a clock, with its source line. A click on a unit in the diagram opens that unit.

--export writes the page as files, which a browser opens without a server, such as page/index.html. That page does not tell why a pixel has its colour.

Exit code 2 also means that the port of --port is in use.")]
pub struct View {
    /// A scene, as for `render`, or a block, as for `wave`
    #[arg(value_name = "SCENE|BLOCK")]
    what: OsString,
    /// The machine that draws first; with --export the machines that the page has, and may be repeated [default: vc1]
    #[arg(long = "machine", value_name = "MACHINE", value_parser = names::of::<Machine>("machine"))]
    machines: Vec<Machine>,
    /// Size of the frame in pixels [default: what the scene asks for]
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<Size>,
    /// Value of a block's parameter; may be repeated
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = crate::block::setting)]
    settings: Vec<(String, u64)>,
    /// Port of the server [default: a free one]
    #[arg(long, value_name = "PORT", value_parser = number(1..=u16::MAX))]
    port: Option<u16>,
    /// Open the page in the browser
    #[arg(long)]
    open: bool,
    /// Write the page to this folder instead, which is made if it is missing
    #[arg(long, value_name = "DIR", conflicts_with_all = ["port", "open"])]
    export: Option<PathBuf>,
}

impl View {
    /// Serves the page until Ctrl-C, or writes it.
    pub fn run(self) -> Result<Exit, Failure> {
        self.export.as_deref().map_or(Ok(()), Folder::check)?;
        match self.block()? {
            Some(entry) => {
                let site = BlockSite::new(entry, &self.settings)?;
                match &self.export {
                    Some(folder) => write(folder, &site, &site.names()),
                    None => self.serve(Arc::new(site)),
                }
            }
            None => self.run_scene(),
        }
    }

    /// The block that is meant, unless it is a scene. A scene's name is never that of a block.
    fn block(&self) -> Result<Option<&'static Entry>, Failure> {
        let name = self.what.to_string_lossy();
        let found = entries().find(|entry| are_alike(&name, entry.name));
        let given = [
            ("--machine", "a scene", found.is_some() && !self.machines.is_empty()),
            ("--size", "a scene", found.is_some() && self.size.is_some()),
            ("--set", "a block", found.is_none() && !self.settings.is_empty()),
        ];
        if let Some((option, of, _)) = given.into_iter().find(|(.., is_wrong)| *is_wrong) {
            let is = if found.is_some() { "a block" } else { "a scene" };
            let sentence = format!("{option} is an option for {of}, and {name} is {is}: leave it out");
            return Err(Failure::new(Exit::BadInput, sentence));
        }
        let path = Path::new(&self.what);
        let is_name = path.extension().is_none() && path.components().count() == 1 && !path.exists();
        if found.is_none() && is_name && !builtin::NAMES.contains(&&*name) {
            let known: Vec<&str> = builtin::NAMES.into_iter().chain(entries().map(|entry| entry.name)).collect();
            let lead = format!("there is no scene and no block `{name}`");
            return Err(Failure::new(Exit::BadInput, not_listed(&lead, &name, &known, "tilewright list")));
        }
        Ok(found)
    }

    fn run_scene(&self) -> Result<Exit, Failure> {
        progress::phase("reading");
        let scene = Scene::load_sized(&self.what, self.size)?;
        let Some(folder) = &self.export else {
            if let [_, second, ..] = self.machines[..] {
                let sentence = format!(
                    "--machine {} is a second machine, and the page has all of them: name the one that draws first",
                    second.name()
                );
                return Err(Failure::new(Exit::BadInput, sentence));
            }
            let site = FrameSite::live(scene, self.machines.first().copied().unwrap_or(Machine::Vc1));
            return self.serve(Arc::new(site));
        };
        let machines = if self.machines.is_empty() { &[Machine::Vc1] } else { &self.machines[..] };
        let site = FrameSite::of(scene, machines)?;
        let frames = machines.iter().map(|machine| format!("frame/{}", machine.name()));
        let with_areas = machines.iter().filter(|machine| areas::name(**machine).is_some());
        let names: Vec<String> = frames.chain(with_areas.map(|machine| format!("areas/{}", machine.name()))).collect();
        write(folder, &site, &names)
    }

    fn serve(&self, site: Arc<dyn Site>) -> Result<Exit, Failure> {
        // From here on a signal ends the server, also before it answers.
        interrupt::flag();
        let server = Server::bind(self.port).map_err(|error| self.unbound(&error))?;
        let address = server.address();
        terminal::print(&format!("{address}\n"))?;
        terminal::talk("Ctrl-C ends the server");
        if self.open {
            open::open(&address);
        }
        server.serve(&site, interrupt::asked);
        Ok(Exit::Done)
    }

    fn unbound(&self, error: &std::io::Error) -> Failure {
        let port = self.port.map_or_else(|| "a port".to_owned(), |port| format!("port {port}"));
        let sentence = match error.kind() {
            ErrorKind::AddrInUse => format!("{port} is in use: leave out --port, or give another one"),
            _ => format!("{port} of 127.0.0.1 cannot be opened ({error}): leave out --port, or give another one"),
        };
        Failure::new(Exit::BadInput, sentence)
    }
}

/// Writes a page with these data to a folder.
fn write(folder: &Path, site: &dyn Exported, names: &[String]) -> Result<Exit, Failure> {
    let data: Vec<(String, Vec<u8>)> =
        names.iter().map(|name| Ok((name.clone(), site.whole(name)?))).collect::<Result<_, Failure>>()?;
    let files = export::files(site.page(), &site.about(), data);
    let mut inner: Vec<&str> = files.iter().filter_map(|file| Some(file.name.rsplit_once('/')?.0)).collect();
    inner.sort_unstable();
    inner.dedup();
    let written = Folder::make_with(folder, &inner)?;
    written.fill(files.iter().map(|file| (file.name.as_str(), file.bytes.as_slice())))?;
    terminal::talk(&format!("open {} in a browser", shown(&folder.join("index.html"))));
    Ok(Exit::Done)
}

/// A site whose data can be waited for.
trait Exported: Site {
    /// The data of that name, as JSON.
    ///
    /// # Errors
    /// They cannot be made; Ctrl-C.
    fn whole(&self, name: &str) -> Result<Vec<u8>, Failure>;
}
