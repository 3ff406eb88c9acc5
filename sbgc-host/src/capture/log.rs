//! Lines of the debug log that the vendor's GUI writes, and our own recordings, which look the same.
//!
//! Traffic of the own port is `<local time> <direction>: [<id>,<length>] <payload in hex>`; there `out` is what the
//! host sends. Traffic of other ports, which the board forwards, is `<MCU time> port<index>.<direction>: …`; there `in`
//! means to the board.

use std::time::Duration;

use nom::branch::alt;
use nom::bytes::complete::{tag, take_till, take_until};
use nom::character::complete::{digit1, hex_digit0, space0, u8 as number};
use nom::combinator::{all_consuming, opt, value};
use nom::sequence::{delimited, preceded, separated_pair, terminated};
use nom::{IResult, Parser};
use sbgc_proto::Direction;
use sbgc_proto::frame::Version;

use super::time;

/// One message of a log.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct LogLine {
    /// The time, counted from whatever the log counts from.
    pub(crate) time: Option<Duration>,
    /// The version of the framing, which only our own recordings have.
    pub(crate) version: Option<Version>,
    pub(crate) direction: Option<Direction>,
    pub(crate) id: u8,
    /// The length that the line states; the payload may be cut short.
    pub(crate) length: usize,
    pub(crate) payload: Vec<u8>,
}

/// Reads one line; `None` if it is none of a log.
pub(crate) fn parse(line: &str) -> Option<LogLine> {
    // The time may hold colons itself, so the line is taken apart at the bracket.
    let (rest, head) = take_until::<_, _, nom::error::Error<&str>>("[").parse(line).ok()?;
    let (_, (id, length, digits)) = all_consuming(message).parse(rest.trim_end()).ok()?;
    let (pairs, odd) = digits.as_bytes().as_chunks::<2>();
    if !odd.is_empty() {
        return None;
    }
    let payload =
        pairs.iter().filter_map(|pair| u8::from_str_radix(str::from_utf8(pair).ok()?, 16).ok()).collect();
    let mut words = head.trim_end().strip_suffix(':')?.rsplit(char::is_whitespace);
    let (_, direction) = all_consuming(direction).parse(words.next()?).ok()?;
    let version = match head.split_whitespace().nth_back(1) {
        Some("v1") => Some(Version::V1),
        Some("v2") => Some(Version::V2),
        _ => None,
    };
    let time = head.split_whitespace().next().and_then(time::parse);
    Some(LogLine { time, version, direction, id, length: usize::from(length), payload })
}

fn message(input: &str) -> IResult<&str, (u8, u8, String)> {
    let header = delimited(tag("["), separated_pair(number, (tag(","), space0), number), tag("]"));
    let (rest, (id, length)) = terminated(header, space0).parse(input)?;
    // Digits may be grouped by spaces.
    let digits: String = rest.split_whitespace().collect();
    match hex_digit0::<_, nom::error::Error<&str>>(digits.as_str()) {
        Ok(("", _)) => Ok(("", (id, length, digits))),
        _ => Err(nom::Err::Error(nom::error::Error::new(rest, nom::error::ErrorKind::HexDigit))),
    }
}

fn direction(word: &str) -> IResult<&str, Option<Direction>> {
    let other_port = preceded(
        (tag("port"), digit1, tag(".")),
        alt((value(Some(Direction::Outgoing), tag("in")), value(Some(Direction::Incoming), tag("out")))),
    );
    let own_port = alt((
        value(
            Some(Direction::Outgoing),
            alt((tag("outgoing"), tag("out"), tag("OUT"), tag("sent"), tag("tx"), tag("->"))),
        ),
        value(
            Some(Direction::Incoming),
            alt((tag("incoming"), tag("in"), tag("IN"), tag("received"), tag("rx"), tag("<-"))),
        ),
    ));
    let (rest, known) = opt(alt((other_port, own_port))).parse(word)?;
    match known {
        Some(direction) => Ok((rest, direction)),
        None => take_till(|_| false).map(|_| None).parse(rest),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_kinds_of_lines_are_read() {
        let own = parse("12:34:56.789 out: [82,1] 01\r").unwrap();
        assert_eq!(
            own,
            LogLine {
                time: Some(Duration::from_millis(45_296_789)),
                version: None,
                direction: Some(Direction::Outgoing),
                id: 82,
                length: 1,
                payload: vec![1]
            }
        );
        let forwarded = parse("123456 port2.in: [86,0] ").unwrap();
        assert_eq!(
            forwarded,
            LogLine {
                time: Some(Duration::from_millis(123_456)),
                version: None,
                direction: Some(Direction::Outgoing),
                id: 86,
                length: 0,
                payload: vec![]
            }
        );
        let recorded = parse("2026-11-21T18:22:16.000001Z v1 in: [67,2] 5dff").unwrap();
        assert_eq!((recorded.version, recorded.direction), (Some(Version::V1), Some(Direction::Incoming)));
        assert_eq!(parse("123456 port2.out: [67,2] 5D FF").unwrap().direction, Some(Direction::Incoming));
        assert_eq!(parse("12:34 strange: [67,2] 5DFF").unwrap().direction, None);
    }

    #[test]
    fn what_is_no_log_line_is_none() {
        for line in
            ["", "hello", "[82,1] 01", "12:34 out: [300,1] 01", "12:34 out: [82,1] 0", "12:34 out: [82,1] xx"]
        {
            assert_eq!(parse(line), None, "{line:?}");
        }
    }
}
