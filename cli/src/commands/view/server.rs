//! The page on this machine alone: [`Server`].
//!
//! Promises: it listens on 127.0.0.1 only; whatever comes, a request is answered with the page or refused, and one that does not end is given up
//! after some seconds. There is one page, so what is asked for is not looked at beyond its first line.

use crate::codes::Code;
use crate::failure::Failure;
use std::io::{ErrorKind, Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// How long a browser may take to ask, or to take a piece of the answer.
const PATIENCE: Duration = Duration::from_secs(10);

/// How often it is looked whether to stop.
const TICK: Duration = Duration::from_millis(50);

/// The longest first line and headers that are read.
const LONGEST: usize = 16 * 1024;

/// An address that the page is served at.
pub(super) struct Server(TcpListener);

impl Server {
    /// At a port, or at any that is free for 0.
    pub(super) fn open(port: u16) -> Result<Self, Box<Failure>> {
        let refused = |error: std::io::Error| {
            Failure::new(Code::NotWritable, format!("port {port} of 127.0.0.1 cannot be used: {error}"))
                .help("leave out --port, or write the page: --html page.html")
        };
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(refused)?;
        listener.set_nonblocking(true).map_err(refused)?;
        Ok(Self(listener))
    }

    pub(super) fn url(&self) -> String {
        self.0.local_addr().map_or_else(|_| "http://127.0.0.1".to_owned(), |at| format!("http://{at}/"))
    }

    /// Until the flag is set.
    pub(super) fn serve(&self, page: &str, stop: &AtomicBool) {
        std::thread::scope(|scope| {
            while !stop.load(Ordering::Acquire) {
                match self.0.accept() {
                    Ok((stream, _)) => {
                        scope.spawn(move || {
                            // A browser that leaves is no fault.
                            let _ = answer(stream, page);
                        });
                    }
                    Err(_) => std::thread::sleep(TICK),
                }
            }
        });
    }
}

fn answer(mut stream: TcpStream, page: &str) -> std::io::Result<()> {
    stream.set_nonblocking(false)?;
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    let request = head(&mut stream)?;
    let mut words = request.split(|&byte| byte == b' ');
    let (method, target) = (words.next().unwrap_or_default(), words.next().unwrap_or_default());
    let (status, body, kind) = match (method, target) {
        (b"GET" | b"HEAD", b"/") => ("200 OK", page, "text/html; charset=utf-8"),
        (b"GET" | b"HEAD", _) => ("404 Not Found", "there is one page here: /\n", "text/plain"),
        _ => ("405 Method Not Allowed", "GET /\n", "text/plain"),
    };
    write!(
        stream,
        "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {}\r\nCache-Control: no-store\r\n\
         Connection: close\r\n\r\n",
        body.len()
    )?;
    if method != b"HEAD" {
        stream.write_all(body.as_bytes())?;
    }
    stream.flush()
}

/// What comes before the first empty line.
fn head(stream: &mut TcpStream) -> std::io::Result<Vec<u8>> {
    let (mut read, mut piece) = (Vec::new(), [0; 1024]);
    loop {
        let count = stream.read(&mut piece)?;
        read.extend(&piece[..count]);
        if read.windows(4).any(|four| four == b"\r\n\r\n") {
            return Ok(read);
        }
        if count == 0 || read.len() > LONGEST {
            return Err(ErrorKind::InvalidData.into());
        }
    }
}
