//! The file that a design names as its texture: beside the design or below it, and nowhere else.
//!
//! A design may come from anybody. What it names is opened, so it must not lead to other places, through `..` and links neither, and to
//! nothing but a regular file.

use super::Design;
use crate::files;
use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};
use thiserror::Error;

/// Largest texture file that is copied, bytes: that of [`crate::outline::MAX_FILE_BYTES`].
const MOST_BYTES: u64 = crate::outline::MAX_FILE_BYTES as u64;
/// Names beside a file that are tried: what is there already and is another picture stays.
const MOST_NAMES: usize = 1000;

/// Why a texture is not read.
#[derive(Debug, Error)]
pub enum TextureError {
    #[error("a texture must be beside the design or in a folder below it")]
    Elsewhere,
    #[error("it is not a regular file")]
    NotAFile,
    #[error("{0}")]
    Missing(io::Error),
}

/// Where a design was read from.
#[derive(Clone, Copy, Debug)]
pub struct Origin<'a> {
    pub file: &'a Path,
    /// Whether what is beside it stays there; what does not is copied, even from a folder below that of the new file.
    pub stays: bool,
}

impl<'a> From<&'a Path> for Origin<'a> {
    fn from(file: &'a Path) -> Self {
        Self { file, stays: true }
    }
}

/// A design as it is to be written elsewhere, where that differs, and the copy of its texture that goes with it.
#[derive(Debug, Default)]
pub struct Carried {
    pub design: Option<Design>,
    pub texture: Option<(PathBuf, Vec<u8>)>,
}

/// The texture of a design that was read from `file`, if it names one.
///
/// # Errors
/// It is missing, no regular file, or somewhere else than beside the design or below.
pub fn find(design: &Design, file: &Path) -> Result<Option<PathBuf>, TextureError> {
    let Some(name) = design.texture.as_deref() else { return Ok(None) };
    let inside = |part: Component| matches!(part, Component::Normal(_) | Component::CurDir);
    if !Path::new(name).components().all(inside) {
        return Err(TextureError::Elsewhere);
    }
    let path = file.with_file_name(name);
    let folder = fs::canonicalize(files::parent(file)).map_err(TextureError::Missing)?;
    let real = fs::canonicalize(&path).map_err(TextureError::Missing)?;
    if !real.starts_with(&folder) {
        return Err(TextureError::Elsewhere);
    }
    match fs::metadata(&real) {
        Ok(found) if found.is_file() => Ok(Some(path)),
        Ok(_) => Err(TextureError::NotAFile),
        Err(error) => Err(TextureError::Missing(error)),
    }
}

/// A design read from `from` as it is to be written to `to`: its texture is named by where it is seen from there or, where it is not
/// beside or below that or does not stay there, copied to it as `NAME.texture.png`, with a number where that is another picture. One that cannot be read
/// stays a name.
///
/// # Errors
/// No name is free for the copy.
pub fn carried(design: &Design, from: Origin<'_>, to: &Path) -> io::Result<Carried> {
    let Origin { file: from, stays } = from;
    let Ok(Some(path)) = find(design, from) else { return Ok(Carried::default()) };
    let [old, new] = [from, to].map(|file| fs::canonicalize(files::parent(file)).ok());
    if old == new {
        return Ok(Carried::default());
    }
    let named = |name: &str| Some(Design { texture: Some(name.to_owned()), ..design.clone() });
    let seen = fs::canonicalize(&path).ok().zip(new).and_then(|(path, new)| slashed(path.strip_prefix(new).ok()?));
    if let Some(name) = seen.filter(|_| stays) {
        return Ok(Carried { design: named(&name), texture: None });
    }
    let Ok(bytes) = files::read(&path, MOST_BYTES) else { return Ok(Carried::default()) };
    let kind = path.extension().and_then(|extension| extension.to_str()).unwrap_or("png");
    for k in 1..=MOST_NAMES {
        let number = if k == 1 { String::new() } else { format!("-{k}") };
        let copy = to.with_extension(format!("texture{number}.{kind}"));
        let Some(name) = copy.file_name().and_then(|name| name.to_str()) else { break };
        match files::read(&copy, MOST_BYTES) {
            Ok(there) if there == bytes => return Ok(Carried { design: named(name), texture: None }),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                return Ok(Carried { design: named(name), texture: Some((copy, bytes)) });
            }
            _ => {}
        }
    }
    Err(io::Error::other("no name is free for the texture beside it"))
}

/// A relative path as a design states it.
fn slashed(path: &Path) -> Option<String> {
    let parts: Option<Vec<&str>> = path.components().map(|part| part.as_os_str().to_str()).collect();
    Some(parts?.join("/"))
}

#[cfg(test)]
mod tests {
    use super::super::testing::sample;
    use super::*;

    fn textured(name: &str) -> Design {
        Design { texture: Some(name.into()), ..sample() }
    }

    #[test]
    fn a_texture_is_beside_the_design_or_below_and_nowhere_else() {
        let folder = tempfile::tempdir().unwrap();
        let at = |path: &str| folder.path().join(path);
        fs::create_dir_all(at("toys/skins")).unwrap();
        for name in ["secret.png", "toys/a.png", "toys/skins/b.png"] {
            fs::write(at(name), "x").unwrap();
        }
        let find = |name: &str| find(&textured(name), &at("toys/pig.plush"));
        for name in ["a.png", "./a.png", "skins/b.png"] {
            assert_eq!(find(name).unwrap(), Some(at("toys").join(name)), "{name}");
        }
        let secret = at("secret.png").to_str().unwrap().to_owned();
        for name in ["../secret.png", "skins/../../secret.png", "skins/../a.png", secret.as_str(), "/etc/passwd"] {
            assert!(matches!(find(name), Err(TextureError::Elsewhere)), "{name}");
        }
        assert!(matches!(find("skins"), Err(TextureError::NotAFile)));
        assert!(matches!(find("none.png"), Err(TextureError::Missing(_))));
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(at("secret.png"), at("toys/link.png")).unwrap();
            assert!(matches!(find("link.png"), Err(TextureError::Elsewhere)));
        }
    }

    #[test]
    fn it_goes_with_a_design_to_another_folder() {
        let folder = tempfile::tempdir().unwrap();
        let at = |path: &str| folder.path().join(path);
        fs::create_dir_all(at("a/b")).unwrap();
        fs::write(at("a/x.png"), "x").unwrap();
        let from = at("a/p.plush");
        let carry = |to: &str| carried(&textured("x.png"), from.as_path().into(), &at(to)).unwrap();
        let name = |carried: &Carried| carried.design.as_ref().and_then(|design| design.texture.clone());
        assert!(name(&carry("a/q.plush")).is_none());
        let up = carry("q.plush");
        assert_eq!((name(&up).as_deref(), up.texture.is_some()), (Some("a/x.png"), false));
        let passing = Origin { file: &from, stays: false };
        let up = carried(&textured("x.png"), passing, &at("q.plush")).unwrap();
        assert_eq!(
            (name(&up).as_deref(), up.texture),
            (Some("q.texture.png"), Some((at("q.texture.png"), b"x".to_vec())))
        );
        let down = carry("a/b/q.plush");
        assert_eq!(name(&down).as_deref(), Some("q.texture.png"));
        assert_eq!(down.texture, Some((at("a/b/q.texture.png"), b"x".to_vec())));
        fs::write(at("a/b/q.texture.png"), "another").unwrap();
        assert_eq!(name(&carry("a/b/q.plush")).as_deref(), Some("q.texture-2.png"));
        fs::write(at("a/b/q.texture.png"), "x").unwrap();
        let again = carry("a/b/q.plush");
        assert_eq!((name(&again).as_deref(), again.texture), (Some("q.texture.png"), None));
    }
}
