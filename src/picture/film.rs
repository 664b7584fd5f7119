//! Pictures one after the other as one file that plays them: a GIF, or a page for a browser.

use crate::files::marked_gif;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use gif::{DisposalMethod, Encoder, Frame, Repeat};
use image::{ImageFormat, Rgba, RgbaImage};
use std::fmt::{Display, Write};
use std::time::Duration;

/// Speed of the choice of colours for GIF, 1 (best) to 30: the pictures have few colours.
const GIF_SPEED: i32 = 10;
/// The first line of a page of ours.
pub const PAGE_MARK: &str = "<!doctype html><!-- plushwright-film/1 -->";

/// PNGs one after the other as a GIF that begins anew for ever.
///
/// # Errors
/// No picture, one that is no PNG, of another size than the first, or larger than the format takes.
pub fn gif(pngs: &[Vec<u8>], step: Duration) -> Result<Vec<u8>, String> {
    let failed = |error: &dyn Display| format!("cannot encode the picture: {error}");
    let read =
        |png: &Vec<u8>| image::load_from_memory_with_format(png, ImageFormat::Png).map(|picture| picture.to_rgba8());
    let first = read(pngs.first().ok_or("there is no picture")?).map_err(|e| failed(&e))?;
    let side = |length: u32| u16::try_from(length).map_err(|e| failed(&e));
    let (width, height) = (side(first.width())?, side(first.height())?);
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height, &[]).map_err(|e| failed(&e))?;
    encoder.set_repeat(Repeat::Infinite).map_err(|e| failed(&e))?;
    // In hundredths, rounded from the beginning, so that nothing adds up.
    let ends = |shown: usize| (shown as f64 * step.as_secs_f64() * 100.0).round();
    let mut before: Option<RgbaImage> = None;
    for (shown, png) in pngs.iter().enumerate() {
        let delay = (ends(shown + 1) - ends(shown)) as u16;
        let now = read(png).map_err(|e| failed(&e))?;
        if now.dimensions() != first.dimensions() {
            return Err(failed(&"its size differs from that of the first"));
        }
        let mut changed = now.clone();
        // What stays as it was need not be said again: it is seen through what is clear.
        if let Some(before) = before {
            let pairs = changed.pixels_mut().zip(before.pixels());
            pairs.filter(|(new, old)| **new == **old).for_each(|(new, _)| *new = Rgba([0; 4]));
        }
        let mut frame = Frame::from_rgba_speed(width, height, &mut changed, GIF_SPEED);
        (frame.delay, frame.dispose) = (delay, DisposalMethod::Keep);
        encoder.write_frame(&frame).map_err(|e| failed(&e))?;
        before = Some(now);
    }
    drop(encoder);
    Ok(marked_gif(&bytes))
}

/// PNGs as a page of their own that plays them in a loop. It needs no other file and no network; a click or Space stops it, and where the
/// system asks for little motion it begins stopped.
pub fn page(pngs: &[Vec<u8>], step: Duration, title: &str) -> String {
    let mut page =
        format!("{PAGE_MARK}\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{}</title>", escaped(title));
    page.push_str(
        "<meta name=\"viewport\" content=\"width=device-width\"><style>\
         body{margin:0;min-height:100vh;display:grid;place-items:center;background:#faf6f1;font:14px sans-serif;color:#3a2e24}\
         img{max-width:100vw;max-height:92vh;cursor:pointer}</style></head><body><figure>\n",
    );
    for (number, png) in pngs.iter().enumerate() {
        let hidden = if number == 0 { "" } else { " hidden" };
        let alt = if number == 0 { escaped(title) } else { String::new() };
        // Writing into a string cannot fail.
        let _ = writeln!(page, "<img alt=\"{alt}\"{hidden} src=\"data:image/png;base64,{}\">", STANDARD.encode(png));
    }
    let _ = write!(
        page,
        "</figure><script>\nconst all=[...document.images],step={};let at=0,plays=!matchMedia('(prefers-reduced-motion: reduce)').matches;\n\
         const turn=()=>plays=!plays;addEventListener('click',turn);addEventListener('keydown',e=>{{if(e.key===' '){{e.preventDefault();turn()}}}});\n\
         if(all.length>1&&step>0)setInterval(()=>{{if(!plays)return;all[at].hidden=true;at=(at+1)%all.length;all[at].hidden=false}},step);\n\
         </script></body></html>\n",
        step.as_millis()
    );
    page
}

/// Text that is no markup.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::is_marked_gif;
    use image::AnimationDecoder;
    use image::codecs::gif::GifDecoder;
    use std::io::Cursor;

    fn png(level: u8) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        let picture = image::RgbImage::from_pixel(16, 8, image::Rgb([level, 0, 0]));
        picture.write_to(&mut bytes, ImageFormat::Png).unwrap();
        bytes.into_inner()
    }

    #[test]
    fn pictures_become_a_moving_one() {
        let gif = gif(&[png(0), png(200)], Duration::from_millis(80)).unwrap();
        assert!(is_marked_gif(&gif));
        let frames = GifDecoder::new(Cursor::new(gif)).unwrap().into_frames().collect_frames().unwrap();
        let seen: Vec<(u8, u32)> =
            frames.iter().map(|f| (f.buffer().get_pixel(3, 3)[0], f.delay().numer_denom_ms().0)).collect();
        assert_eq!(seen, [(0, 80), (200, 80)]);
    }

    #[test]
    fn a_film_lasts_as_long_as_what_it_shows() {
        let pngs: Vec<Vec<u8>> = (0..60).map(|k| png(4 * k)).collect();
        for rate in [7.0, 24.0, 30.0, 60.0] {
            let gif = gif(&pngs, Duration::from_secs_f64(1.0 / rate)).unwrap();
            let frames = GifDecoder::new(Cursor::new(gif)).unwrap().into_frames().collect_frames().unwrap();
            let ms: u32 = frames.iter().map(|f| f.delay().numer_denom_ms().0).sum();
            assert!((f64::from(ms) - 60e3 / rate).abs() <= 5.0, "{rate}: {ms} ms");
        }
    }

    #[test]
    fn what_does_not_move_stays_in_every_picture() {
        // A square that wanders over a ground with a frame.
        let picture = |at: u32| {
            image::RgbImage::from_fn(24, 16, |x, y| match (x, y) {
                (x, y) if (at..at + 5).contains(&x) && (4..9).contains(&y) => image::Rgb([200, 30, 20]),
                (0 | 23, _) | (_, 0 | 15) => image::Rgb([0, 0, 0]),
                _ => image::Rgb([250, 246, 241]),
            })
        };
        let pictures = [picture(2), picture(6), picture(6), picture(15)];
        let png = |picture: &image::RgbImage| {
            let mut bytes = Cursor::new(Vec::new());
            picture.write_to(&mut bytes, ImageFormat::Png).unwrap();
            bytes.into_inner()
        };
        let gif = gif(&pictures.each_ref().map(png), Duration::from_millis(40)).unwrap();
        let frames = GifDecoder::new(Cursor::new(gif)).unwrap().into_frames().collect_frames().unwrap();
        assert_eq!(frames.len(), pictures.len());
        for (frame, picture) in frames.iter().zip(&pictures) {
            assert!(frame.buffer().pixels().zip(picture.pixels()).all(|(seen, meant)| seen.0[..3] == meant.0));
        }
    }

    #[test]
    fn pictures_that_make_no_film_are_refused() {
        let step = Duration::from_millis(80);
        assert!(gif(&[], step).unwrap_err().contains("no picture"));
        assert!(gif(&[b"no PNG".to_vec()], step).unwrap_err().contains("cannot encode"));
        let mut other = Cursor::new(Vec::new());
        image::RgbImage::new(4, 4).write_to(&mut other, ImageFormat::Png).unwrap();
        assert!(gif(&[png(0), other.into_inner()], step).unwrap_err().contains("size differs"));
    }

    #[test]
    fn a_page_holds_its_pictures_and_no_markup_of_others() {
        let page = page(&[png(0), png(200)], Duration::from_millis(80), "<b>pig & co");
        assert_eq!(page.matches("<img").count(), 2);
        assert!(page.starts_with(PAGE_MARK) && page.contains("&lt;b&gt;pig &amp; co") && page.contains("step=80;"));
        assert!(page.contains(&STANDARD.encode(png(200))));
    }
}
