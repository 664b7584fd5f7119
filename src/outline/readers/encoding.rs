//! The text of a file, whatever its encoding.

use encoding_rs::{Encoding, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};
use std::borrow::Cow;

/// The text of an XML file: its byte order mark tells the encoding, or else its declaration. Without either it is UTF-8, or Windows-1252
/// (which holds Latin-1) where the bytes are none.
///
/// # Errors
/// Why the bytes are no text.
pub(super) fn xml(bytes: &[u8]) -> Result<Cow<'_, str>, String> {
    // A byte order mark wins over what is declared, as with browsers.
    let encoding = match Encoding::for_bom(bytes) {
        Some((encoding, _)) => encoding,
        None if bytes.starts_with(b"<\0") => UTF_16LE,
        None if bytes.starts_with(b"\0<") => UTF_16BE,
        None => match declared(bytes) {
            Some(name) => of_name(name)?,
            None => UTF_8,
        },
    };
    let (text, encoding, faulty) = encoding.decode(bytes);
    match faulty {
        false => Ok(text),
        true if encoding == UTF_8 && declared(bytes).is_none() => Ok(WINDOWS_1252.decode(bytes).0),
        true => Err(format!("it is no {} text; save it as UTF-8", encoding.name())),
    }
}

/// The text of a file with a code page of its own, such as `ANSI_1252`; UTF-8 where the bytes are that.
pub(super) fn of_code_page<'a>(bytes: &'a [u8], code_page: Option<&str>) -> Cow<'a, str> {
    if let Ok(text) = std::str::from_utf8(bytes) {
        return text.trim_start_matches('\u{feff}').into();
    }
    let number = code_page.map(|name| name.trim().to_ascii_lowercase().replace("ansi_", "windows-"));
    let encoding = number.and_then(|name| Encoding::for_label(name.as_bytes())).unwrap_or(WINDOWS_1252);
    encoding.decode(bytes).0
}

/// The encoding that an XML declaration names.
fn declared(bytes: &[u8]) -> Option<&str> {
    /// A declaration is no longer.
    const LONGEST: usize = 200;
    let head = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start().strip_prefix(b"<?xml")?;
    let head = &head[..head.len().min(LONGEST)];
    let end = head.windows(2).position(|pair| pair == b"?>")?;
    let text = std::str::from_utf8(&head[..end]).ok()?;
    let value = text.split_once("encoding")?.1.trim_start().strip_prefix('=')?.trim_start();
    let quote = value.chars().next().filter(|c| ['"', '\''].contains(c))?;
    value[1..].split(quote).next()
}

fn of_name(name: &str) -> Result<&'static Encoding, String> {
    match Encoding::for_label(name.as_bytes()) {
        // Declared in bytes that are none of two: the declaration is wrong, as with browsers.
        Some(encoding) if encoding == UTF_16LE || encoding == UTF_16BE => Ok(UTF_8),
        Some(encoding) => Ok(encoding),
        None => {
            let name: String = name.chars().filter(|c| !c.is_control()).take(24).collect();
            Err(format!("its encoding \"{name}\" is not known; save it as UTF-8"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_read_in_the_encoding_that_they_state() {
        let told = |encoding: &str| format!("<?xml version='1.0' encoding='{encoding}'?><g id='B\u{e4}r'/>");
        assert_eq!(xml(told("utf-8").as_bytes()), Ok(told("utf-8").into()));
        let latin1: Vec<u8> = told("ISO-8859-1").chars().map(|c| c as u8).collect();
        assert_eq!(xml(&latin1), Ok(told("ISO-8859-1").into()));
        for big in [false, true] {
            let bytes = |c: u16| if big { c.to_be_bytes() } else { c.to_le_bytes() };
            let plain: Vec<u8> = told("UTF-16").encode_utf16().flat_map(bytes).collect();
            assert_eq!(xml(&plain), Ok(told("UTF-16").into()), "{big}");
            let marked = [bytes(0xfeff).as_slice(), &plain].concat();
            assert_eq!(xml(&marked), Ok(told("UTF-16").into()), "{big}");
        }
        // Nothing stated and no UTF-8: as Windows programs write.
        assert_eq!(xml(b"<g id='B\xe4r'/>"), Ok("<g id='B\u{e4}r'/>".into()));
        assert!(xml(told("ebcdic-xy").as_bytes()).unwrap_err().contains("UTF-8"));
        assert_eq!(of_code_page(b"B\xe4r", Some("ANSI_1252")), "B\u{e4}r");
        assert_eq!(of_code_page(b"\xcc", Some("ansi_1251")), "\u{41c}");
    }
}
