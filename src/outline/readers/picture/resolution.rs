//! The physical size of a picture's pixels, where its file states one.

/// Millimetres in an inch and in a centimetre.
const INCH: f64 = 25.4;
const CENTIMETRE: f64 = 10.0;
/// Sizes outside this range are nonsense, mm: 10 000 to 1 dpi.
const SANE: std::ops::RangeInclusive<f64> = 0.00254..=25.4;
/// Dots to the inch that cameras write into EXIF when they know none.
const NO_DPI: f64 = 72.0;
/// Tags of TIFF and EXIF.
const X_RESOLUTION: u16 = 0x011a;
const RESOLUTION_UNIT: u16 = 0x0128;

/// Millimetres in a pixel: from a PNG's `pHYs` chunk, a JPEG's JFIF header, a BMP's header, a TIFF's tags, or EXIF.
pub(super) fn mm_per_px(bytes: &[u8]) -> Option<f64> {
    let own = png(bytes).or_else(|| jfif(bytes)).or_else(|| bmp(bytes)).or_else(|| tiff(bytes));
    let sane = |mm: &f64| SANE.contains(mm);
    own.filter(sane).or_else(|| {
        let stated = exif(bytes).and_then(tiff).filter(sane);
        stated.filter(|mm| (mm - INCH / NO_DPI).abs() > 1e-6)
    })
}

/// Chunks are length, name, data, checksum; `pHYs` has pixels per unit in x and y, and 1 for the metre.
fn png(bytes: &[u8]) -> Option<f64> {
    let data = png_chunk(bytes, b"pHYs")?;
    let per_metre = u32::from_be_bytes(data.get(..4)?.try_into().ok()?);
    (data.get(8) == Some(&1)).then(|| 1000.0 / f64::from(per_metre))
}

fn png_chunk<'a>(bytes: &'a [u8], wanted: &[u8; 4]) -> Option<&'a [u8]> {
    let mut rest = bytes.strip_prefix(b"\x89PNG\r\n\x1a\n")?;
    loop {
        let length = u32::from_be_bytes(rest.get(..4)?.try_into().ok()?) as usize;
        let name = rest.get(4..8)?;
        let data = rest.get(8..8_usize.checked_add(length)?)?;
        if name == wanted {
            return Some(data);
        }
        rest = rest.get(length.checked_add(12)?..)?;
    }
}

/// The first segment of a JFIF file: unit (1 inch, 2 cm) and pixels per unit.
fn jfif(bytes: &[u8]) -> Option<f64> {
    let rest = jpeg_segment(bytes, 0xe0, b"JFIF\0")?;
    let density = f64::from(u16::from_be_bytes(rest.get(3..5)?.try_into().ok()?));
    match rest.get(2)? {
        1 => Some(INCH / density),
        2 => Some(CENTIMETRE / density),
        _ => None,
    }
}

/// A segment of a JPEG by its marker and how it begins; what follows that.
fn jpeg_segment<'a>(bytes: &'a [u8], marker: u8, begins: &[u8]) -> Option<&'a [u8]> {
    let mut rest = bytes.strip_prefix(b"\xff\xd8")?;
    loop {
        let &[0xff, found, high, low] = rest.get(..4)? else { return None };
        // The picture itself begins.
        if found == 0xda {
            return None;
        }
        let length = usize::from(u16::from_be_bytes([high, low]));
        let data = rest.get(4..2 + length.max(2))?;
        if let Some(data) = data.strip_prefix(begins).filter(|_| found == marker) {
            return Some(data);
        }
        rest = rest.get(2 + length.max(2)..)?;
    }
}

/// Pixels per metre stand in the header.
fn bmp(bytes: &[u8]) -> Option<f64> {
    let header = bytes.strip_prefix(b"BM")?;
    let per_metre = u32::from_le_bytes(header.get(36..40)?.try_into().ok()?);
    (per_metre > 0).then(|| 1000.0 / f64::from(per_metre))
}

/// The EXIF of a JPEG, PNG or WebP, which is built as a TIFF.
fn exif(bytes: &[u8]) -> Option<&[u8]> {
    jpeg_segment(bytes, 0xe1, b"Exif\0\0").or_else(|| png_chunk(bytes, b"eXIf")).or_else(|| {
        let mut rest = bytes.strip_prefix(b"RIFF")?.get(4..)?.strip_prefix(b"WEBP")?;
        loop {
            let length = u32::from_le_bytes(rest.get(4..8)?.try_into().ok()?) as usize;
            let data = rest.get(8..8_usize.checked_add(length)?)?;
            if rest.starts_with(b"EXIF") {
                return Some(data.strip_prefix(b"Exif\0\0").unwrap_or(data));
            }
            // Chunks are padded to even lengths.
            rest = rest.get(8 + length + length % 2..)?;
        }
    })
}

/// Resolution and its unit (2 inch, 3 cm) in the first directory of a TIFF.
fn tiff(bytes: &[u8]) -> Option<f64> {
    let big = match bytes.get(..4)? {
        b"MM\0*" => true,
        b"II*\0" => false,
        _ => return None,
    };
    let short = |at: usize| -> Option<u16> {
        let two = bytes.get(at..at.checked_add(2)?)?.try_into().ok()?;
        Some(if big { u16::from_be_bytes(two) } else { u16::from_le_bytes(two) })
    };
    let long = |at: usize| -> Option<u32> {
        let four = bytes.get(at..at.checked_add(4)?)?.try_into().ok()?;
        Some(if big { u32::from_be_bytes(four) } else { u32::from_le_bytes(four) })
    };
    let directory = long(4)? as usize;
    let entries = usize::from(short(directory)?);
    let (mut density, mut unit) = (None, INCH);
    for entry in (0..entries).map(|k| directory + 2 + 12 * k) {
        match short(entry)? {
            X_RESOLUTION => {
                let at = long(entry + 8)? as usize;
                density = Some(f64::from(long(at)?) / f64::from(long(at.checked_add(4)?)?));
            }
            RESOLUTION_UNIT => match short(entry + 8)? {
                2 => unit = INCH,
                3 => unit = CENTIMETRE,
                _ => return None,
            },
            _ => {}
        }
    }
    density.map(|density| unit / density)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A TIFF with a resolution alone.
    fn resolution(dots: u32, unit: u16) -> Vec<u8> {
        let entry = |tag: u16, kind: u16, value: [u8; 4]| {
            [&tag.to_le_bytes()[..], &kind.to_le_bytes(), &1_u32.to_le_bytes(), &value].concat()
        };
        let mut tiff = b"II*\0\x08\0\0\0\x02\0".to_vec();
        tiff.extend(entry(X_RESOLUTION, 5, 38_u32.to_le_bytes()));
        tiff.extend(entry(RESOLUTION_UNIT, 3, u32::from(unit).to_le_bytes()));
        tiff.extend([0; 4]);
        tiff.extend([dots.to_le_bytes(), 1_u32.to_le_bytes()].concat());
        tiff
    }

    #[test]
    fn resolutions_are_read_of_every_format_and_exif_counts_where_nothing_else_does() {
        assert_eq!(mm_per_px(&resolution(300, 2)), Some(INCH / 300.0));
        assert_eq!(mm_per_px(&resolution(40, 3)), Some(0.25));
        let jpeg = |units: u8, exif: &[u8]| {
            let mut bytes = b"\xff\xd8\xff\xe0\0\x10JFIF\0\x01\x01".to_vec();
            bytes.extend([units, 0, 200, 0, 200, 0, 0]);
            bytes.extend(b"\xff\xe1");
            bytes.extend((exif.len() as u16 + 8).to_be_bytes());
            bytes.extend(b"Exif\0\0");
            bytes.extend(exif);
            bytes
        };
        assert_eq!(mm_per_px(&jpeg(1, &resolution(300, 2))), Some(INCH / 200.0));
        assert_eq!(mm_per_px(&jpeg(0, &resolution(300, 2))), Some(INCH / 300.0));
        assert_eq!(mm_per_px(&jpeg(0, &resolution(72, 2))), None);
        let mut bmp = b"BM".to_vec();
        bmp.extend([0; 36]);
        bmp.extend(4000_u32.to_le_bytes());
        assert_eq!(mm_per_px(&bmp), Some(0.25));
        for length in 0..40 {
            let _ = mm_per_px(&jpeg(0, &resolution(300, 2))[..length]);
        }
    }
}
