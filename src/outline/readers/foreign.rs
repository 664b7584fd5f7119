//! Files that are not read, by name, and what to do about them.

use crate::outline::OutlineError;

/// Formats with the bytes that tell them and where those stand.
const FORMATS: [(&str, usize, &[u8], &str); 16] = [
    ("a HEIC or HEIF picture", 4, b"ftyphei", PHOTO),
    ("a HEIC or HEIF picture", 4, b"ftyphev", PHOTO),
    ("a HEIC or HEIF picture", 4, b"ftypmif1", PHOTO),
    ("an AVIF picture", 4, b"ftypavi", PICTURE),
    ("an EPS or PostScript file", 0, b"%!", POSTSCRIPT),
    ("an EPS or PostScript file", 0, b"\xc5\xd0\xd3\xc6", POSTSCRIPT),
    ("a DWG drawing", 0, b"AC10", "save it as DXF"),
    ("a Photoshop picture", 0, b"8BPS", PICTURE),
    ("a JPEG 2000 or JPEG XL picture", 4, b"jP  ", PICTURE),
    ("a JPEG 2000 or JPEG XL picture", 4, b"JXL ", PICTURE),
    ("a Silhouette Studio file", 0, b"silhouette", "export it as SVG (Business Edition) or DXF"),
    ("a CorelDRAW file", 8, b"CDR", "export it as SVG, plain paths, unit mm"),
    ("a Windows metafile", 0, b"\xd7\xcd\xc6\x9a", "open it in Inkscape or LibreOffice Draw and save it as SVG"),
    ("a Windows metafile", 40, b" EMF", "open it in Inkscape or LibreOffice Draw and save it as SVG"),
    ("a STEP solid", 0, b"ISO-10303-21", "export its flat face or sketch as DXF"),
    ("an Affinity document", 0, b"\x00\xffKA", "export it as SVG"),
];

const PHOTO: &str =
    "save it as JPEG (on an iPhone: Settings, Camera, Formats, Most Compatible; or share it as JPEG) or as PNG";
const PICTURE: &str = "save it as PNG";
const POSTSCRIPT: &str = "open it in Inkscape or Illustrator and save it as SVG, or make a PDF of it";
/// Packed folders, by what one of their first files is called.
const PACKED: [(&str, &[u8], &str); 7] = [
    ("a 3MF model", b"3D/3dmodel.model", "export it as STL or OBJ"),
    ("a Krita document", b"application/x-krita", PICTURE),
    ("an OpenRaster picture", b"image/openraster", PICTURE),
    ("an OpenDocument drawing", b"application/vnd.oasis", "export it as SVG"),
    ("a FreeCAD document", b"Document.xml", "select the sketch or face and export it as SVG or DXF"),
    ("a Procreate document", b"QuickLook/Thumbnail.png", "share it as PNG from Procreate"),
    ("a CorelDRAW file", b"content/riffData.cdr", "export it as SVG, plain paths, unit mm"),
];
/// Bytes in which the names of packed files are looked for.
const HEAD: usize = 4096;

/// Why a file of no known kind is not read.
pub(in crate::outline) fn unknown(bytes: &[u8]) -> OutlineError {
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
            (b"what else", "neither an SVG"),
        ] {
            assert!(unknown(bytes).to_string().contains(says), "{}", unknown(bytes));
        }
    }
}
