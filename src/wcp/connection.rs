//! The connection to a viewer.

use super::ViewerOptions;
use super::message::{Command, EVENTS, Event, Said, Told, VERSION};
use crate::shell::text::one_line;
use crate::shell::{Exit, Failure, interrupt, progress};
use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::{Ipv4Addr, SocketAddr, TcpListener, TcpStream};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender, TryRecvError};
use std::thread;
use std::time::{Duration, Instant};

/// The longest time to the connection and to the viewer's greeting.
const PATIENCE: Duration = Duration::from_secs(5);
/// The time between two looks for a viewer that is waited for.
const PAUSE: Duration = Duration::from_millis(50);
/// The longest message that is read.
const LONGEST: u64 = 1 << 20;

/// A viewer of waveforms whose cursor goes along with a time. When this is dropped, the connection ends.
#[derive(Debug)]
pub struct Viewer {
    stream: TcpStream,
    said: Receiver<Said>,
    /// The time at which its cursor is, as far as that is known.
    cursor: Option<u64>,
}

impl ViewerOptions {
    /// The viewer that is asked for, which has answered the greeting.
    ///
    /// # Errors
    /// There is none, or it does not speak the protocol.
    pub fn viewer(&self) -> Result<Option<Viewer>, Failure> {
        match (self.wcp, self.wcp_wait) {
            (Some(address), _) => Viewer::at(address).map(Some),
            (None, Some(port)) => Viewer::waited_for(port).map(Some),
            (None, None) => Ok(None),
        }
    }
}

impl Viewer {
    /// Connects to one that listens.
    ///
    /// # Errors
    /// None listens there, or it does not speak the protocol.
    pub fn at(address: SocketAddr) -> Result<Viewer, Failure> {
        progress::phase("connecting to the viewer");
        let stream = TcpStream::connect_timeout(&address, PATIENCE).map_err(|error| {
            let why = one_line(&error.to_string());
            let remedy = "start the viewer's WCP server, in Surfer by the command `wcp_server_start`";
            Failure::new(Exit::NoTool, format!("no viewer listens on {address} ({why}): {remedy}"))
        })?;
        Viewer::greet(stream, address)
    }

    /// Waits for one to connect to a port of this computer.
    ///
    /// # Errors
    /// The port cannot be listened on, or who connects does not speak the protocol; a signal.
    fn waited_for(port: u16) -> Result<Viewer, Failure> {
        let cannot = |error: io::Error| {
            let why = one_line(&error.to_string());
            Failure::new(
                Exit::BadInput,
                format!("port {port} cannot be listened on ({why}): give --wcp-wait another one"),
            )
        };
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(cannot)?;
        listener.set_nonblocking(true).map_err(cannot)?;
        progress::phase("waiting for the viewer");
        loop {
            match listener.accept() {
                Ok((stream, address)) => {
                    stream.set_nonblocking(false).map_err(cannot)?;
                    return Viewer::greet(stream, address);
                }
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => thread::sleep(PAUSE),
                Err(error) => return Err(cannot(error)),
            }
            if interrupt::asked() {
                return Err(Failure::new(interrupt::exit(), "interrupted while no viewer had come"));
            }
        }
    }

    fn greet(stream: TcpStream, address: SocketAddr) -> Result<Viewer, Failure> {
        let stranger = |why: String| {
            let sentence = format!(
                "who is on {address} does not answer as a viewer ({why}): give the address of a viewer with WCP"
            );
            Failure::new(Exit::NoTool, sentence)
        };
        let (sender, said) = mpsc::channel();
        let reader = stream.try_clone().map_err(|error| stranger(error.to_string()))?;
        thread::spawn(move || read(BufReader::new(reader), &sender));
        let mut viewer = Viewer { stream, said, cursor: None };
        let greeting = Told::Greeting { version: VERSION, commands: &EVENTS };
        viewer.send(&greeting).map_err(|error| stranger(error.to_string()))?;
        let late = Instant::now() + PATIENCE;
        loop {
            let left = late.saturating_duration_since(Instant::now());
            match viewer.said.recv_timeout(left) {
                Ok(Said::Greeting { version }) if version == VERSION => return Ok(viewer),
                Ok(Said::Greeting { version }) => {
                    return Err(stranger(format!("its protocol is of version {}", one_line(&version))));
                }
                Ok(Said::Error { error, message }) => return Err(stranger(one_line(&format!("{error}: {message}")))),
                Ok(Said::Event(_) | Said::Other) => {}
                Err(RecvTimeoutError::Timeout) => return Err(stranger("it sent no greeting".to_owned())),
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(stranger("it closed the connection, or sent something else".to_owned()));
                }
            }
        }
    }

    /// Puts its cursor at a time, unless it is there.
    ///
    /// # Errors
    /// It is gone.
    pub fn go_to(&mut self, time: u64) -> io::Result<()> {
        if self.cursor.replace(time) == Some(time) {
            return Ok(());
        }
        self.send(&Told::Command(Command::SetCursor { timestamp: time }))?;
        self.send(&Told::Command(Command::SetViewportTo { timestamp: time }))
    }

    /// Takes this time for that of its cursor, which its user put near.
    pub fn is_at(&mut self, time: u64) {
        self.cursor = Some(time);
    }

    /// What its user did since the last time.
    ///
    /// # Errors
    /// It is gone.
    pub fn event(&mut self) -> io::Result<Option<Event>> {
        loop {
            match self.said.try_recv() {
                Ok(Said::Event(event)) => return Ok(Some(event)),
                // Without a waveform it has no cursor.
                Ok(Said::Greeting { .. } | Said::Error { .. } | Said::Other) => {}
                Err(TryRecvError::Empty) => return Ok(None),
                Err(TryRecvError::Disconnected) => return Err(io::ErrorKind::ConnectionReset.into()),
            }
        }
    }

    fn send(&mut self, told: &Told) -> io::Result<()> {
        let mut message = serde_json::to_vec(told).map_err(io::Error::other)?;
        message.push(0);
        self.stream.write_all(&message)
    }
}

impl Drop for Viewer {
    fn drop(&mut self) {
        // The thread that reads ends with the connection. One that is gone cannot be closed.
        let _ = self.stream.shutdown(std::net::Shutdown::Both);
    }
}

/// Reads messages until the connection ends, or somebody sends what is none.
fn read(mut stream: impl BufRead, sender: &Sender<Said>) {
    loop {
        let mut message = Vec::new();
        let length = stream.by_ref().take(LONGEST).read_until(0, &mut message);
        if !length.is_ok_and(|length| length > 0) || message.pop() != Some(0) {
            return;
        }
        let Ok(said) = serde_json::from_slice(&message) else { return };
        if sender.send(said).is_err() {
            return;
        }
    }
}
