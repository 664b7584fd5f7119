//! Binary DXF: the same pairs with a code of two bytes and a value whose kind the code tells.

use std::fmt::Write;

/// How such a file begins.
pub(super) const SENTINEL: &[u8] = b"AutoCAD Binary DXF\r\n\x1a\0";

/// The file as text.
///
/// # Errors
/// Where it ends early, or a value has no known form.
pub(super) fn text(bytes: &[u8]) -> Result<String, &'static str> {
    let mut rest = bytes.strip_prefix(SENTINEL).ok_or("it is no binary DXF")?;
    let mut text = String::with_capacity(2 * bytes.len());
    while !rest.is_empty() {
        let code = i32::from(u16::from_le_bytes(take::<2>(&mut rest)?));
        // The value goes on its own line whatever is in it.
        let _ = writeln!(text, "{code}");
        let _ = match code {
            10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => {
                writeln!(text, "{}", f64::from_le_bytes(take(&mut rest)?))
            }
            60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 | 1060..=1070 => {
                writeln!(text, "{}", i16::from_le_bytes(take(&mut rest)?))
            }
            90..=99 | 420..=429 | 440..=459 | 1071 => writeln!(text, "{}", i32::from_le_bytes(take(&mut rest)?)),
            160..=169 => writeln!(text, "{}", i64::from_le_bytes(take(&mut rest)?)),
            290..=299 => writeln!(text, "{}", take::<1>(&mut rest)?[0]),
            310..=319 | 1004 => {
                let length = usize::from(take::<1>(&mut rest)?[0]);
                rest = rest.get(length..).ok_or(EARLY)?;
                writeln!(text)
            }
            _ => {
                let end = rest.iter().position(|&byte| byte == 0).ok_or(EARLY)?;
                let value = String::from_utf8_lossy(&rest[..end]).replace(['\r', '\n'], " ");
                rest = &rest[end + 1..];
                writeln!(text, "{value}")
            }
        };
        if code == 0 && text.ends_with("\nEOF\n") {
            break;
        }
    }
    Ok(text)
}

const EARLY: &str = "the file ends early";

fn take<const N: usize>(rest: &mut &[u8]) -> Result<[u8; N], &'static str> {
    let (taken, after) = rest.split_first_chunk::<N>().ok_or(EARLY)?;
    *rest = after;
    Ok(*taken)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_of_every_kind_become_lines() {
        let mut bytes = SENTINEL.to_vec();
        let mut put = |code: u16, value: &[u8]| {
            bytes.extend(code.to_le_bytes());
            bytes.extend(value);
        };
        put(0, b"LINE\0");
        put(10, &1.5_f64.to_le_bytes());
        put(70, &(-3_i16).to_le_bytes());
        put(90, &7_i32.to_le_bytes());
        put(290, &[1]);
        put(310, &[2, 9, 9]);
        put(0, b"EOF\0");
        assert_eq!(text(&bytes).unwrap(), "0\nLINE\n10\n1.5\n70\n-3\n90\n7\n290\n1\n310\n\n0\nEOF\n");
        for end in SENTINEL.len() + 1..bytes.len() {
            let _ = text(&bytes[..end]);
        }
        assert_eq!(text(&bytes[..bytes.len() - 1]), Err(EARLY));
    }
}
