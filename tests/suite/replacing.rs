//! What no command replaces: what it reads, the work of others, anything that would be lost, without `--force` at least.

use super::files::{NETWORK, PROBLEM, names, place, program, refused, run, succeed};
use std::fs;
use std::process::{Child, Stdio};

#[test]
fn what_is_read_is_never_replaced() {
    let folder = place();
    let f = folder.path();
    fs::hard_link(f.join("bar.svg"), f.join("also.svg")).unwrap();
    let before = names(f);
    for (args, input) in [
        (&["new", "bar.svg", "-o", "bar.svg"][..], "bar.svg"),
        (&["new", "bar.svg", "-o", "bar.svg", "--force"], "bar.svg"),
        (&["new", "bar.svg", "-o", "./also.svg", "--force"], "bar.svg"),
        (&["render", "bar.plush", "-o", "bar.plush"], "bar.plush"),
        (&["mesh", "bar.plush", "-o", "bar.plush"], "bar.plush"),
        (&["drawing", "bar.plush", "-o", "bar.plush"], "bar.plush"),
        (&["export", "bar.plush", "-o", "bar.plush"], "bar.plush"),
        (&["reshape", "bar.plush", "bar.svg", "-o", "bar.svg", "--force"], "bar.svg"),
        (&["solve", "problem.json", "-o", "problem.json"], "problem.json"),
        (&["discover", "network.json", "-o", "network.json"], "network.json"),
    ] {
        let old = fs::read(f.join(input)).unwrap();
        let output = run(f, args);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        refused(&output, args.iter().find(|arg| arg.contains('.') && **arg != args[1]).unwrap_or(&input));
        assert_eq!(fs::read(f.join(input)).unwrap(), old, "{args:?}");
    }
    assert_eq!(names(f), before);
}

#[test]
fn the_work_of_others_is_not_replaced_without_force() {
    let folder = place();
    let f = folder.path();
    fs::write(f.join("notes.txt"), "mine").unwrap();
    fs::write(f.join("newer.plush"), "(version: 999)").unwrap();
    let old = fs::read(f.join("bar.plush")).unwrap();
    let new =
        |out: &str, force: &[&str]| run(f, &[&["new", "bar.svg", "--fibers", "60", "-o", out][..], force].concat());
    for out in ["bar.plush", "notes.txt", "newer.plush"] {
        assert!(refused(&new(out, &[]), out).contains("--force"));
    }
    let pose = ["pose", "bar.plush", "--name", "p", "--pin", "5,5", "-o", "notes.txt"];
    assert!(refused(&run(f, &pose), "notes.txt").contains("--force"));
    // A picture does not replace a design at all.
    refused(&run(f, &["render", "bar.plush", "-o", "newer.plush"]), "newer.plush");
    assert_eq!(fs::read(f.join("bar.plush")).unwrap(), old);
    assert_eq!(fs::read(f.join("notes.txt")).unwrap(), b"mine");
    assert!(new("notes.txt", &["--force"]).status.success());
    assert!(new("bar.plush", &["--force"]).status.success());
    // What follows from its outline alone can be had again, so it may go.
    assert!(new("bar.plush", &[]).status.success());
}

#[test]
fn another_plushie_is_not_replaced_without_force() {
    let folder = place();
    let f = folder.path();
    let pose = ["--name", "p", "--pin", "5,5"];
    succeed(f, &["new", "bar.svg", "--fibers", "60", "-o", "other.plush"]);
    succeed(f, &[&["pose", "other.plush", "-o", "other.plush"][..], &pose].concat());
    let old = fs::read(f.join("other.plush")).unwrap();
    let commands: [&[&str]; 5] = [
        &[&["pose", "bar.plush"][..], &pose].concat(),
        &["key", "bar.plush", "--pose", "bend", "--time", "9"],
        &["rig", "bar.plush"],
        &["remesh", "bar.plush", "--fibers", "80"],
        &["reshape", "bar.plush", "bar.svg"],
    ];
    for args in commands {
        let args = [args, &["-o", "other.plush"][..]].concat();
        assert!(refused(&run(f, &args), "other.plush").contains("--force"), "{args:?}");
        assert_eq!(fs::read(f.join("other.plush")).unwrap(), old, "{args:?}");
    }
    let key = |time: &str, rest: &[&str]| {
        run(f, &[&["key", "bar.plush", "--pose", "bend", "--time", time, "-o", "other.plush"][..], rest].concat())
    };
    assert!(key("9", &["--force"]).status.success());
    // What the same command wrote before is replaced without a word, and other work on the same plushie is not.
    assert!(key("9", &[]).status.success());
    let old = fs::read(f.join("other.plush")).unwrap();
    assert!(refused(&key("8", &[]), "other.plush").contains("--force"));
    assert_eq!(fs::read(f.join("other.plush")).unwrap(), old);
    // So is a copy of what is read, and a bare outline.
    fs::copy(f.join("bar.plush"), f.join("other.plush")).unwrap();
    assert!(key("8", &[]).status.success());
    succeed(f, &["new", "bar.svg", "--fibers", "60", "-o", "other.plush", "--force"]);
    assert!(key("9", &[]).status.success());
}

#[test]
fn an_answer_or_a_picture_does_not_replace_what_is_none() {
    let folder = place();
    let f = folder.path();
    let photograph = || {
        let mut bytes = std::io::Cursor::new(Vec::new());
        image::RgbImage::new(2, 2).write_to(&mut bytes, image::ImageFormat::Png).unwrap();
        bytes.into_inner()
    };
    let jpeg = || b"\xff\xd8\xff\xe0 and so on".to_vec();
    for (name, bytes) in [
        ("photo.png", photograph()),
        ("photo.jpg", jpeg()),
        ("notes.txt", b"mine".to_vec()),
        ("other.json", PROBLEM.as_bytes().to_vec()),
        ("network2.json", NETWORK.as_bytes().to_vec()),
    ] {
        fs::write(f.join(name), bytes).unwrap();
    }
    let render: &[&str] = &["render", "bar.plush", "--size", "64x32", "-o"];
    let mesh: &[&str] = &["mesh", "bar.plush", "--size", "64x32", "-o"];
    let (solve, discover, drawing) =
        (["solve", "problem.json", "-o"], ["discover", "network.json", "-o"], ["drawing", "bar.plush", "-o"]);
    for (args, out) in [
        (render, "photo.png"),
        (render, "photo.jpg"),
        (render, "notes.txt"),
        (mesh, "photo.png"),
        (&solve, "other.json"),
        (&solve, "notes.txt"),
        (&discover, "network2.json"),
        (&discover, "photo.png"),
        (&drawing, "bar.svg"),
        (&drawing, "notes.txt"),
    ] {
        let (args, old) = ([args, &[out][..]].concat(), fs::read(f.join(out)).unwrap());
        assert!(refused(&run(f, &args), out).contains("--force"), "{args:?}");
        assert_eq!(fs::read(f.join(out)).unwrap(), old, "{args:?}");
    }
    succeed(f, &[render, &["photo.png", "--force"]].concat());
    succeed(f, &[&solve[..], &["notes.txt", "--force"]].concat());
    // From now on these are ours, by whatever name.
    for (args, out) in [(mesh, "photo.png"), (render, "photo.png"), (&solve, "notes.txt"), (&discover, "notes.txt")] {
        succeed(f, &[args, &[out]].concat());
    }
}

#[test]
fn a_folder_with_anything_foreign_in_it_stays() {
    let folder = place();
    let f = folder.path();
    for dir in ["photos", "figures"] {
        fs::create_dir(f.join(dir)).unwrap();
        fs::write(f.join(dir).join("figures.json"), "{}").unwrap();
        fs::write(f.join(dir).join("holiday.jpg"), "mine").unwrap();
    }
    // A folder of its own: what other commands write beside it is no outline.
    fs::create_dir(f.join("outlines")).unwrap();
    fs::copy(f.join("bar.svg"), f.join("outlines/bar.svg")).unwrap();
    let bench = |out: &'static str| ["bench", "import", "outlines", "--fibers", "0", "--out", out];
    let commands: [&[&str]; 4] = [
        &["export", "bar.plush", "-o", "photos"],
        &["demo", "--out", "photos"],
        &bench("photos"),
        &["bench", "extremes", "--short", "--only", "none", "--scenes", "photos"],
    ];
    for args in commands {
        refused(&run(f, args), "photos");
        assert_eq!(fs::read(f.join("photos/holiday.jpg")).unwrap(), b"mine", "{args:?}");
    }
    // Results of their own are replaced, until somebody puts something in, below them too.
    for (args, out) in [(&["export", "bar.plush", "-o", "mine"][..], "mine"), (&bench("figs"), "figs")] {
        succeed(f, args);
        succeed(f, args);
        fs::write(f.join(out).join("notes.txt"), "mine").unwrap();
        assert!(refused(&run(f, args), out).contains("notes.txt"));
        fs::remove_file(f.join(out).join("notes.txt")).unwrap();
        succeed(f, args);
        let (listed, _) = names(&f.join(out)).split_first().map(|(a, b)| (a.clone(), b.len())).unwrap();
        fs::write(f.join(out).join(&listed), "changed by hand").unwrap();
        assert!(refused(&run(f, args), out).contains(&listed));
    }
    refused(&run(f, &["export", "bar.plush", "-o", "figs"]), "figs");
    assert!(names(f).iter().all(|name| !name.starts_with('.')), "{:?}", names(f));
}

#[test]
fn a_drawing_and_a_picture_of_others_are_not_replaced_by_new() {
    let folder = place();
    let f = folder.path();
    fs::write(f.join("a.ron"), "(parts: [(primitive: Circle(center: (0, 0), radius: 40))])").unwrap();
    succeed(f, &["new", "a.ron", "--fibers", "60", "-o", "drawn.plush"]);
    let old = fs::read(f.join("drawn.plush")).unwrap();
    assert!(refused(&run(f, &["new", "bar.svg", "-o", "drawn.plush"]), "drawn.plush").contains("--force"));
    assert_eq!(fs::read(f.join("drawn.plush")).unwrap(), old);
    succeed(f, &["new", "a.ron", "--fibers", "60", "-o", "drawn.plush"]);
    let new = ["new", "bar.svg", "--fibers", "60", "--texture", "-o", "skin.plush"];
    succeed(f, &new);
    succeed(f, &new);
    image::RgbImage::new(2, 2).save(f.join("skin.texture.png")).unwrap();
    let old = fs::read(f.join("skin.texture.png")).unwrap();
    assert!(refused(&run(f, &new), "skin.texture.png").contains("--force"));
    assert_eq!(fs::read(f.join("skin.texture.png")).unwrap(), old);
}

#[test]
fn commands_that_make_one_design_at_once_lose_nothing_without_a_word() {
    let folder = place();
    let f = folder.path();
    let start = |time: usize| -> Child {
        let time = (10 + time).to_string();
        let args = ["key", "bar.plush", "--pose", "bend", "--time", &time, "-o", "same.plush"];
        program(f).args(args).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
    };
    let running: Vec<Child> = (0..4).map(start).collect();
    let codes = running.into_iter().map(|mut command| command.wait().unwrap().code());
    assert_eq!(codes.filter(|&code| code == Some(0)).count(), 1, "the others are refused");
}

#[test]
fn what_does_not_say_that_it_is_ours_is_not_replaced_whatever_its_name() {
    let folder = place();
    let f = folder.path();
    for (name, theirs, args) in [
        ("package.json", "{\"name\": \"my-app\"}", &["solve", "problem.json", "-o", "package.json"][..]),
        ("list.json", "[1, 2, 3]", &["solve", "problem.json", "-o", "list.json"]),
        ("game.ron", "Config(window: (800, 600))", &["drawing", "bar.plush", "-o", "game.ron"]),
        ("photo.png", "RIFF....WEBP", &["render", "bar.plush", "-o", "photo.png"]),
    ] {
        fs::write(f.join(name), theirs).unwrap();
        assert!(refused(&run(f, args), name).contains("--force"), "{name}");
        assert_eq!(fs::read_to_string(f.join(name)).unwrap(), theirs);
        succeed(f, &[args, &["--force"]].concat());
        // What was written is ours.
        succeed(f, args);
        fs::write(f.join(name), "").unwrap();
        succeed(f, args);
    }
    let curve = ["rig", "bar.plush", "-o", "x.plush", "--explore", "--csv", "t.csv", "--plot", "t.csv"];
    assert!(refused(&run(f, &curve), "t.csv").contains("both"));
}
