//! Files that are not read, by name, and what to do about them.

use crate::outline::OutlineError;

/// Formats with the bytes that tell them and where those stand.
const FORMATS: &[(&str, usize, &[u8], &str)] = &[
    ("a HEIC or HEIF picture", 4, b"ftyphei", PHOTO),
    ("a HEIC or HEIF picture", 4, b"ftyphev", PHOTO),
    ("a HEIC or HEIF picture", 4, b"ftypmif1", PHOTO),
    ("an AVIF picture", 4, b"ftypavi", PICTURE),
    ("a JPEG 2000 or JPEG XL picture", 4, b"jP  ", PICTURE),
    ("a JPEG 2000 or JPEG XL picture", 4, b"JXL ", PICTURE),
    ("a JPEG 2000 or JPEG XL picture", 0, b"\xff\x0a", PICTURE),
    ("a Photoshop picture", 0, b"8BPS", PICTURE),
    ("a GIMP picture", 0, b"gimp xcf", "export it as PNG from GIMP"),
    ("a Clip Studio picture", 0, b"CSFCHUNK", PICTURE),
    ("an EPS or PostScript file", 0, b"%!", POSTSCRIPT),
    ("an EPS or PostScript file", 0, b"\xc5\xd0\xd3\xc6", POSTSCRIPT),
    ("a Windows metafile", 0, b"\xd7\xcd\xc6\x9a", "open it in Inkscape or LibreOffice Draw and save it as SVG"),
    ("a Windows metafile", 40, b" EMF", "open it in Inkscape or LibreOffice Draw and save it as SVG"),
    ("a DWG drawing", 0, b"AC10", "save it as DXF"),
    ("a Silhouette Studio file", 0, b"silhouette", "export it as SVG (Business Edition) or DXF"),
    ("a CorelDRAW file", 8, b"CDR", "export it as SVG, plain paths, unit mm"),
    ("an Affinity document", 0, b"\x00\xffKA", "export it as SVG"),
    ("a Figma document", 0, b"fig-kiwi", "select the figure in Figma and export it as SVG"),
    ("a plotter file (HPGL)", 0, b"IN;", PLOTTER),
    ("a plotter file (HPGL)", 0, b"\x1b%-", PLOTTER),
    ("a STEP solid", 0, b"ISO-10303-21", SOLID),
    ("an IGES solid", 72, b"S      1", SOLID),
    ("a glTF model", 0, b"glTF", MODEL),
    ("an FBX model", 0, b"Kaydara FBX", MODEL),
    ("a PLY mesh", 0, b"ply\n", MODEL),
    ("a PLY mesh", 0, b"ply\r", MODEL),
    ("an OFF mesh", 0, b"OFF", MODEL),
    ("a Blender file", 0, b"BLENDER", "export the flat mesh as OBJ or STL from Blender"),
    ("a SketchUp model", 0, b"\xff\xfe\xff\x0eS\0k\0e\0t\0c\0h", "export it as DXF or STL"),
];

const PHOTO: &str =
    "save it as JPEG (on an iPhone: Settings, Camera, Formats, Most Compatible; or share it as JPEG) or as PNG";
const PICTURE: &str = "save it as PNG";
const POSTSCRIPT: &str = "open it in Inkscape or Illustrator and save it as SVG, or make a PDF of it";
const PLOTTER: &str = "export the drawing as SVG or DXF from the program that it was made with";
const SOLID: &str = "export its flat face or sketch as DXF";
const MODEL: &str = "export its flat face as OBJ, STL or 3MF";
/// Packed folders, by what one of their first files is called.
const PACKED: &[(&str, &[u8], &str)] = &[
    ("a Krita document", b"application/x-krita", PICTURE),
    ("an OpenRaster picture", b"image/openraster", PICTURE),
    ("an OpenDocument drawing", b"application/vnd.oasis", "export it as SVG"),
    ("a FreeCAD document", b"Document.xml", "select the sketch or face and export it as SVG or DXF"),
    ("a Procreate document", b"QuickLook/Thumbnail.png", PROCREATE),
    ("a Procreate document", b"Document.archive", PROCREATE),
    ("a CorelDRAW file", b"content/riffData.cdr", "export it as SVG, plain paths, unit mm"),
    ("a Figma document", b"canvas.fig", "select the figure in Figma and export it as SVG"),
    ("a Sketch document", b"document.json", "select the figure in Sketch and export it as SVG"),
    ("a Fusion design", b"Manifest.dat", "save the sketch as DXF (in Fusion: right-click it, Save as DXF)"),
    ("an office document", b"[Content_Types].xml", "save its drawing as SVG or PDF"),
];
const PROCREATE: &str = "share it as PNG from Procreate";
/// What is written in XML and is no drawing, by the name of its root.
const ROOTS: &[(&str, &str, &str)] = &[
    ("COLLADA", "a COLLADA model", MODEL),
    ("amf", "an AMF model", MODEL),
    ("X3D", "an X3D model", MODEL),
    ("pattern", "a pattern of Seamly2D or Valentina", "export its layout as SVG or DXF"),
    ("mxfile", "a diagrams.net document", "export it as SVG"),
    ("html", "a web page", "save the picture that it shows, and not the page"),
];
/// Bytes in which the names of packed files are looked for.
const HEAD: usize = 4096;

/// Why a file of no known kind is not read.
pub(in crate::outline) fn unknown(bytes: &[u8]) -> OutlineError {
    let plain = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if plain.trim_ascii_start().starts_with(b"{") {
        return OutlineError::Foreign { format: "a JSON document", advice: "export the drawing as SVG or PNG" };
    }
    let found = FORMATS.iter().find(|(_, at, magic, _)| bytes.get(*at..).is_some_and(|rest| rest.starts_with(magic)));
    if let Some(&(format, _, _, advice)) = found {
        return OutlineError::Foreign { format, advice };
    }
    if bytes.starts_with(b"PK\x03\x04") {
        let head = &bytes[..bytes.len().min(HEAD)];
        let holds = |name: &[u8]| head.windows(name.len()).any(|window| window == name);
        if let Some(&(format, _, advice)) = PACKED.iter().find(|(_, name, _)| holds(name)) {
            return OutlineError::Foreign { format, advice };
        }
        return OutlineError::Foreign {
            format: "a packed file",
            advice: "unpack it, and read the drawing or picture in it",
        };
    }
    OutlineError::UnknownFormat
}

/// Why XML whose root is called so is not read; `None` for a drawing.
pub(super) fn of_root(name: &str) -> Option<OutlineError> {
    let &(_, format, advice) = ROOTS.iter().find(|(root, ..)| root.eq_ignore_ascii_case(name))?;
    Some(OutlineError::Foreign { format, advice })
}

/// Whether a text is a web page, which need not be XML.
pub(super) fn is_page(text: &str) -> bool {
    let head = text.trim_start_matches('\u{feff}').trim_start();
    ["<!doctype html", "<html"]
        .iter()
        .any(|begins| head.get(..begins.len()).is_some_and(|h| h.eq_ignore_ascii_case(begins)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_files_are_named_with_what_to_do() {
        for (bytes, says) in [
            (&b"\0\0\0\x18ftypheic"[..], "Most Compatible"),
            (b"%!PS-Adobe-3.0 EPSF-3.0", "Inkscape"),
            (b"AC1032\0", "DXF"),
            (b"PK\x03\x04 mimetypeapplication/x-krita", "Krita"),
            (b"PK\x03\x04 other", "unpack"),
            (b"PK\x03\x04 Document.archive", "Procreate"),
            (b"glTF\x02", "OBJ, STL or 3MF"),
            (b"gimp xcf v011", "PNG"),
            (b" {\"type\": \"excalidraw\"}", "SVG"),
            (b"what else", "neither an SVG"),
        ] {
            assert!(unknown(bytes).to_string().contains(says), "{}", unknown(bytes));
        }
        let said =
            |text: &str| crate::outline::import(text.as_bytes(), &crate::outline::Import::default()).unwrap_err();
        for (text, says) in [
            ("<!DOCTYPE html><html><p>Log in<br></html>", "web page"),
            ("<?xml version='1.0'?><pattern/>", "layout"),
            ("<COLLADA xmlns='http://www.collada.org'/>", "OBJ, STL or 3MF"),
            ("<plist/>", "<plist>"),
        ] {
            assert!(said(text).to_string().contains(says), "{}", said(text));
        }
    }
}
