//! Framing: how a command lies on the line, and where a reply ends.
//!
//! Commands and replies are text everywhere else. Those of binary protocols are the hexadecimal digits of their bytes, so that programs, errors and
//! tests read the same for all families.

/// How bytes on a line are divided into commands and replies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Framing {
    /// Text. Commands end with `end`, replies with a line feed or a carriage return; empty replies are none. A command of one character of `at_once`
    /// goes out as it is and is obeyed wherever it stands.
    Lines { end: &'static str, at_once: &'static [char] },
    /// `53 length node command data.. crc 45`, in all length + 2 bytes (Faulhaber V3, RS-232).
    Sdo,
    /// `FF FF id length data.. sum`, in all length + 4 bytes (Feetech's serial bus servos).
    Bus,
}

/// No reply is longer, bytes: what is has lost its end.
const LONGEST: usize = 4096;
/// First and last byte of a frame of the V3 family.
const SDO_ENDS: [u8; 2] = [0x53, 0x45];
/// Bytes of such a frame besides those that its length counts.
const SDO_MORE: usize = 2;
/// Bytes of a frame on the servos' bus before and with its length.
const BUS_HEAD: usize = 4;

impl Framing {
    /// The bytes of a command.
    pub fn encode(self, command: &str) -> Vec<u8> {
        match self {
            Self::Lines { at_once, .. } if is_at_once(command, at_once) => command.as_bytes().to_vec(),
            Self::Lines { end, .. } => [command, end].concat().into_bytes(),
            Self::Sdo | Self::Bus => bytes_of(command),
        }
    }

    /// Whether frames are bytes, not text.
    pub fn is_binary(self) -> bool {
        matches!(self, Self::Sdo | Self::Bus)
    }

    /// Takes the first whole reply out of what has come; none until it is whole. What cannot be the beginning of one comes out as garbage, as it is.
    pub fn take_reply(self, buffer: &mut Vec<u8>) -> Option<String> {
        match self {
            Self::Lines { .. } => take_line(buffer, b"\r\n"),
            Self::Sdo | Self::Bus => self.take_frame(buffer),
        }
    }

    /// As [`Framing::take_reply`], for the other end of the line: the first whole command.
    pub fn take_command(self, buffer: &mut Vec<u8>) -> Option<String> {
        match self {
            Self::Lines { at_once, .. } => {
                if let Some(at) = buffer.iter().position(|&byte| at_once.contains(&char::from(byte))) {
                    return Some(char::from(buffer.remove(at)).to_string());
                }
                take_line(buffer, b"\r\n")
            }
            Self::Sdo | Self::Bus => self.take_frame(buffer),
        }
    }

    fn take_frame(self, buffer: &mut Vec<u8>) -> Option<String> {
        let (&first, length) = (buffer.first()?, self.length(buffer));
        let begins = match self {
            Self::Sdo => first == SDO_ENDS[0],
            _ => first == 0xFF && buffer.get(1).is_none_or(|&byte| byte == 0xFF),
        };
        let length = match (begins, length) {
            (false, _) => buffer.len(),
            (true, Some(length)) if length <= buffer.len() => length,
            (true, _) => return None,
        };
        Some(hex(&buffer.drain(..length).collect::<Vec<_>>()))
    }

    /// Bytes of the frame that begins here, if its length has come.
    fn length(self, buffer: &[u8]) -> Option<usize> {
        match self {
            Self::Sdo => Some(usize::from(*buffer.get(1)?) + SDO_MORE),
            _ => Some(usize::from(*buffer.get(BUS_HEAD - 1)?) + BUS_HEAD),
        }
    }
}

fn is_at_once(command: &str, at_once: &[char]) -> bool {
    let mut letters = command.chars();
    letters.next().is_some_and(|letter| at_once.contains(&letter)) && letters.next().is_none()
}

/// Takes the first line that is not empty.
fn take_line(buffer: &mut Vec<u8>, ends: &[u8]) -> Option<String> {
    let begin = buffer.iter().position(|byte| !ends.contains(byte)).unwrap_or(buffer.len());
    buffer.drain(..begin);
    let length = match buffer.iter().position(|byte| ends.contains(byte)) {
        Some(length) => length,
        None if buffer.len() > LONGEST => buffer.len(),
        None => return None,
    };
    Some(String::from_utf8_lossy(&buffer.drain(..length).collect::<Vec<_>>()).into_owned())
}

/// Bytes as hexadecimal digits.
pub fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect()
}

/// The bytes of hexadecimal digits; none of what is not a pair of them.
pub fn bytes_of(hex: &str) -> Vec<u8> {
    hex.as_bytes()
        .chunks(2)
        .filter_map(|pair| u8::from_str_radix(std::str::from_utf8(pair).ok()?, 16).ok().filter(|_| pair.len() == 2))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const LINES: Framing = Framing::Lines { end: "\n", at_once: &['?', '!'] };

    #[test]
    fn replies_come_out_whole_whatever_pieces_they_come_in() {
        let whole = |framing: Framing, bytes: &[u8]| {
            let (mut buffer, mut found) = (Vec::new(), Vec::new());
            for &byte in bytes {
                buffer.push(byte);
                found.extend(framing.take_reply(&mut buffer));
            }
            found
        };
        assert_eq!(whole(LINES, b"OK\r\n\r\n-12\r\nerr"), ["OK", "-12"]);
        let frame = [0x53, 7, 1, 2, 0x7A, 0x60, 0, 9, 0x45];
        assert_eq!(whole(Framing::Sdo, &[frame, frame].concat()), [hex(&frame), hex(&frame)]);
        assert_eq!(whole(Framing::Bus, &[0xFF, 0xFF, 1, 2, 0, 0xFC]), ["FFFF010200FC"]);
        assert_eq!(whole(Framing::Bus, &[7, 0xFF])[0], "07");
        assert_eq!(bytes_of(&hex(&frame)), frame);
        assert_eq!(bytes_of("0G1"), [0u8; 0]);
        assert_eq!(
            Framing::Lines { end: "\r", at_once: &[] }.take_reply(&mut vec![b'x'; LONGEST + 1]).map(|l| l.len()),
            Some(LONGEST + 1)
        );
    }

    #[test]
    fn what_is_obeyed_at_once_needs_no_end() {
        assert_eq!(LINES.encode("?"), b"?");
        assert_eq!(LINES.encode("G1 X1"), b"G1 X1\n");
        let mut buffer = b"G1 X?1\nG4".to_vec();
        assert_eq!(LINES.take_command(&mut buffer).as_deref(), Some("?"));
        assert_eq!(LINES.take_command(&mut buffer).as_deref(), Some("G1 X1"));
        assert_eq!(LINES.take_command(&mut buffer), None);
    }
}
