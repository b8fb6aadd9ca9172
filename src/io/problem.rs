//! Problems of files, with their places.

use crate::monitor::Cancelled;
use std::fmt;

/// The place of a problem in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A line, 1-based.
    Line(usize),
    /// A vertex, 0-based.
    Vertex(usize),
    /// A face, 0-based.
    Face(usize),
    /// The file as a whole or its header.
    Header,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(n) => write!(f, "line {n}"),
            Self::Vertex(n) => write!(f, "vertex {n}"),
            Self::Face(n) => write!(f, "face {n}"),
            Self::Header => f.write_str("header"),
        }
    }
}

/// The problem that a reader reports, with its place.
pub type Problem = (Place, String);

/// Why a reader ends without a mesh.
#[derive(Debug)]
pub enum Unread {
    /// Something in the file is wrong.
    Problem(Problem),
    /// The user asked to stop.
    Stopped(Cancelled),
}

impl From<Problem> for Unread {
    fn from(problem: Problem) -> Self {
        Self::Problem(problem)
    }
}

impl From<Cancelled> for Unread {
    fn from(stop: Cancelled) -> Self {
        Self::Stopped(stop)
    }
}

impl From<Unread> for Problem {
    /// For readers that nobody stops.
    fn from(unread: Unread) -> Self {
        match unread {
            Unread::Problem(problem) => problem,
            Unread::Stopped(stop) => (Place::Header, stop.to_string()),
        }
    }
}
