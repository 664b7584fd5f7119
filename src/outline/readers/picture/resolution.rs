//! The physical size of a picture's pixels.

/// Pixels without a stated size count as CSS px, 96 to the inch.
const MM_PER_PX: f64 = 25.4 / 96.0;
/// Sizes outside this range are nonsense, mm: 10 000 to 1 dpi.
const SANE: std::ops::RangeInclusive<f64> = 0.00254..=25.4;

/// Millimetres in a pixel: from a PNG's `pHYs` chunk or a JPEG's JFIF header, else 1/96 inch.
pub(super) fn mm_per_px(bytes: &[u8]) -> f64 {
    png(bytes).or_else(|| jpeg(bytes)).filter(|mm| SANE.contains(mm)).unwrap_or(MM_PER_PX)
}

/// Chunks are length, name, data, checksum; `pHYs` has pixels per unit in x and y, and 1 for the metre.
fn png(bytes: &[u8]) -> Option<f64> {
    let mut rest = bytes.strip_prefix(b"\x89PNG\r\n\x1a\n")?;
    loop {
        let length = u32::from_be_bytes(rest.get(..4)?.try_into().ok()?) as usize;
        let name = rest.get(4..8)?;
        if name == b"IDAT" {
            return None;
        }
        let data = rest.get(8..8_usize.checked_add(length)?)?;
        if name == b"pHYs" && data.get(8) == Some(&1) {
            let per_metre = u32::from_be_bytes(data.get(..4)?.try_into().ok()?);
            return Some(1000.0 / f64::from(per_metre));
        }
        rest = rest.get(length.checked_add(12)?..)?;
    }
}

/// The first segment of a JFIF file: unit (1 inch, 2 cm) and pixels per unit.
fn jpeg(bytes: &[u8]) -> Option<f64> {
    let header = bytes.strip_prefix(b"\xff\xd8\xff\xe0")?.get(2..)?;
    let rest = header.strip_prefix(b"JFIF\0")?;
    let density = f64::from(u16::from_be_bytes(rest.get(3..5)?.try_into().ok()?));
    match rest.get(2)? {
        1 => Some(25.4 / density),
        2 => Some(10.0 / density),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stated_sizes_count_and_others_are_a_96th_of_an_inch() {
        let mut png = b"\x89PNG\r\n\x1a\n\0\0\0\x09pHYs".to_vec();
        png.extend(11811_u32.to_be_bytes().repeat(2));
        png.extend(b"\x01....\0\0\0\0IDAT....");
        assert!((mm_per_px(&png) - 25.4 / 300.0).abs() < 1e-5);
        let jpeg = b"\xff\xd8\xff\xe0\0\x10JFIF\0\x01\x02\x01\0\x48\0\x48\0\0";
        assert!((mm_per_px(jpeg) - 25.4 / 72.0).abs() < 1e-12);
        assert_eq!(mm_per_px(b""), 25.4 / 96.0);
        assert_eq!(mm_per_px(&png[..15]), 25.4 / 96.0);
    }
}
