//! Pictures one after the other as one file that plays them: a GIF, or a page for a browser.

use crate::files::marked_gif;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use image::codecs::gif::{GifEncoder, Repeat};
use image::{Delay, Frame, ImageFormat, Rgba, RgbaImage};
use std::fmt::Write;
use std::time::Duration;

/// Speed of the choice of colours for GIF, 1 (best) to 30: the pictures have few colours.
const GIF_SPEED: i32 = 10;
/// The first line of a page of ours.
pub const PAGE_MARK: &str = "<!doctype html><!-- plushwright-film/1 -->";

/// PNGs one after the other as a GIF that begins anew for ever.
///
/// # Errors
/// A picture that is no PNG, or that does not fit in memory.
pub fn gif(pngs: &[Vec<u8>], step: Duration) -> Result<Vec<u8>, String> {
    let failed = |error: image::ImageError| format!("cannot encode the picture: {error}");
    let mut bytes = Vec::new();
    let mut encoder = GifEncoder::new_with_speed(&mut bytes, GIF_SPEED);
    encoder.set_repeat(Repeat::Infinite).map_err(failed)?;
    let mut before: Option<RgbaImage> = None;
    for png in pngs {
        let now = image::load_from_memory_with_format(png, ImageFormat::Png).map_err(failed)?.to_rgba8();
        let mut changed = now.clone();
        // What stays as it was need not be said again.
        if let Some(before) = before.filter(|before| before.dimensions() == now.dimensions()) {
            let pairs = changed.pixels_mut().zip(before.pixels());
            pairs.filter(|(new, old)| **new == **old).for_each(|(new, _)| *new = Rgba([0; 4]));
        }
        let frame = Frame::from_parts(changed, 0, 0, Delay::from_saturating_duration(step));
        encoder.encode_frame(frame).map_err(failed)?;
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
    fn a_page_holds_its_pictures_and_no_markup_of_others() {
        let page = page(&[png(0), png(200)], Duration::from_millis(80), "<b>pig & co");
        assert_eq!(page.matches("<img").count(), 2);
        assert!(page.starts_with(PAGE_MARK) && page.contains("&lt;b&gt;pig &amp; co") && page.contains("step=80;"));
        assert!(page.contains(&STANDARD.encode(png(200))));
    }
}
