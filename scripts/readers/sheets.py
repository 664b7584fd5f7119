"""Patterns: SVG by lxml and shapely, DXF by ezdxf."""

import re
import shutil
import subprocess

import ezdxf
from lxml import etree
from shapely.geometry import LineString, Point, Polygon, box
from shapely.ops import unary_union

SVG = "{http://www.w3.org/2000/svg}"


def checks(out, manifest, settings):
    patterns = sorted(out.glob("pattern*.svg"))
    for path in sorted(out.glob("*.svg")):
        done = subprocess.run(["rsvg-convert", path], capture_output=True)
        yield f"{path.name}: librsvg", done.stderr.decode().strip() or (None if done.stdout.startswith(b"\x89PNG") else "no picture")
    pieces = {}
    for path in patterns:
        pieces.update(read(path))
        yield f"{path.name}: mm, reference of 100.000 mm", reference(path)
        if shutil.which("inkscape"):
            yield f"{path.name}: Inkscape's sizes", inkscape(path)
    remarks = " ".join(manifest["remarks"])
    for name, piece in pieces.items():
        for check, fault in skin(piece, settings["allowance"], remarks):
            yield f"{name}: {check}", fault
    for path in sorted(out.glob("pattern*.dxf")):
        yield from drawing(path, pieces)


def read(path):
    """Layers of every piece: lines, polygons, circles, words."""
    root = etree.parse(str(path)).getroot()
    pieces = {}
    for group in root.findall(f"{SVG}g"):
        name = group.get("id")
        if name not in ("front", "back"):
            continue
        layers = {}
        for layer in group.findall(f"{SVG}g"):
            kind = layer.get("id")[len(name) + 1 :]
            layers[kind] = [shape(e) for e in layer]
        pieces[name] = layers
    return pieces


def shape(element):
    get = lambda key: float(element.get(key))
    if element.tag == f"{SVG}circle":
        return Point(get("cx"), get("cy")), get("r")
    if element.tag == f"{SVG}text":
        size, words = get("font-size"), element.text or ""
        width = 0.55 * size * len(words)
        x = get("x") - (0.5 * width if element.get("text-anchor") == "middle" else 0)
        return words, box(x, get("y") - 0.72 * size, x + width, get("y") + 0.2 * size)
    d = element.get("d")
    numbers = [float(v) for v in re.findall(r"-?[0-9.]+", d)]
    points = list(zip(numbers[::2], numbers[1::2]))
    return Polygon(points) if d.endswith("Z") else LineString(points)


def reference(path):
    root = etree.parse(str(path)).getroot()
    size = [float(root.get(k)[:-2]) for k in ("width", "height")]
    view = [float(v) for v in root.get("viewBox").split()]
    if not root.get("width").endswith("mm") or view != [0, 0, *size]:
        return f"{root.get('width')} is not {view}"
    line = [shape(e) for g in root if g.get("id") == "reference" for e in g if e.tag == f"{SVG}path"][0]
    return None if abs(line.length - 100) < 5e-4 else f"{line.length} mm"


def inkscape(path):
    """Cut lines are as large in Inkscape (which answers in pixels of 1/96 inch, lines' widths included) as they are written."""
    done = subprocess.run(["inkscape", "--query-all", path], capture_output=True, text=True)
    sizes = {words[0]: words[3:] for words in (line.split(",") for line in done.stdout.splitlines()) if len(words) == 5}
    for name, layers in read(path).items():
        rim = layers["cut"][0].bounds
        found = [float(v) * 25.4 / 96 for v in sizes.get(f"{name}-cut", ["nan", "nan"])]
        wanted = [rim[2] - rim[0], rim[3] - rim[1]]
        if not all(abs(a - b) < 0.02 for a, b in zip(found, wanted)):
            return f"{name}: {found} mm, not {wanted}"
    return None


def skin(piece, allowance, remarks):
    rim = piece["cut"][0]
    outs = piece.get("cut-outs", [])
    felt = Polygon(rim.exterior.coords, [o.exterior.coords for o in outs])
    stitches = [s if isinstance(s, LineString) else LineString(s.exterior.coords) for s in piece["stitch"]]
    open_seam = stitches[0]
    closed = LineString([*open_seam.coords, open_seam.coords[0]])
    seam = unary_union([closed, *stitches[1:]])
    edge = unary_union([LineString(rim.exterior.coords), *[LineString(o.exterior.coords) for o in outs]])
    yield "one rim, valid", None if felt.is_valid and len(piece["cut"]) == 1 else "not valid"
    # Across the turning gap nothing is stitched, and the seam that will be closed there bends with the body.
    gap = LineString([open_seam.coords[-1], open_seam.coords[0]]).buffer(1.5 * allowance)
    off = max(abs(seam.distance(p) - allowance) for p in map(Point, rim.exterior.coords) if not gap.contains(p))
    # Slits that were filled are straight across, nearer to one side than an allowance or farther.
    yield "allowance within 0.05 mm or remarked", None if off < 0.05 or "narrow notch" in remarks else f"{off:.3f} mm"
    far = [p for p in sampled(seam, 0.5) if edge.distance(p) > 1.05 * allowance and not gap.contains(p)]
    yield "far cuts are remarked", None if not far or "narrow notch" in remarks else f"{len(far)} places"
    snips = unary_union(piece.get("snips", []) or [LineString([(0, 0), (1e-9, 0)])])
    lost = [p for p in far if snips.distance(p) > 6 * allowance]
    yield "a snip near every far place", None if not lost else f"{len(lost)} places, one at {lost[0]}"
    slits = [o for o in outs if o.buffer(-1.0).is_empty]
    thin = felt.difference(felt.buffer(-1.0).buffer(1.05)).area
    yield "no cut-out under 2 mm, no sliver", None if not slits and thin < 0.5 else f"{len(slits)} slits, {thin:.2f} mm^2 of slivers"
    nearest = min((min(seam.distance(c), edge.distance(c)) - r for c, r in piece.get("holes", [])), default=9)
    yield "holes 3 mm from cut and stitch", None if nearest >= 3 - 1e-3 else f"{nearest:.2f} mm"
    lines = [*stitches, edge, *piece.get("notches", []), *piece.get("snips", []), *piece.get("grain", [])]
    lines += [g for g in piece["note"] if not isinstance(g, tuple)]
    lines += [c.buffer(r).exterior for c, r in piece.get("holes", [])]
    words = [g for g in piece["note"] if isinstance(g, tuple)]
    crossed = [t for t, b in words if any(b.intersects(line) for line in lines)]
    pairs = [(s, t) for i, (s, a) in enumerate(words) for t, b in words[i + 1 :] if a.intersects(b)]
    yield "labels cross nothing", None if not crossed and not pairs else f"{crossed} {pairs}"


def sampled(line, step):
    parts = getattr(line, "geoms", [line])
    for part in parts:
        for i in range(int(part.length / step) + 1):
            yield part.interpolate(i * step)


def drawing(path, pieces):
    document = ezdxf.readfile(path)
    audit = document.audit()
    yield f"{path.name}: ezdxf's audit", None if not audit.errors and not audit.fixes else f"{audit.errors} {audit.fixes}"
    yield f"{path.name}: mm", None if document.header.get("$INSUNITS") == 4 else "other units"
    layers = {e.dxf.layer for block in document.blocks if not block.name.startswith("*") for e in block}
    wanted = {"1", "13", "14", "15"}
    yield f"{path.name}: layers", None if wanted <= layers else f"{sorted(layers)}"
    for name in ("front", "back"):
        block = document.blocks.get(name.upper())
        if block is None:
            continue
        rim = [e for e in block if e.dxf.layer == "1"]
        area = Polygon([(v.dxf.location.x, v.dxf.location.y) for v in rim[0].vertices]).area
        same = abs(area / pieces[name]["cut"][0].area - 1)
        closed = rim[0].is_closed and len(rim) == 1
        yield f"{path.name}: {name} closed, area as in SVG", None if closed and same < 1e-6 else f"{same:.2e}"
        stitched = [e for e in block if e.dxf.layer == "14"]
        length = LineString([(v.dxf.location.x, v.dxf.location.y) for v in stitched[0].vertices]).length
        off = abs(length - pieces[name]["stitch"][0].length)
        yield f"{path.name}: {name} stitches as long as in SVG", None if off < 0.01 else f"{off} mm"
    lines = [e for e in document.modelspace() if e.dxftype() == "POLYLINE" and e.dxf.layer == "0"]
    spans = [abs(e.vertices[1].dxf.location.x - e.vertices[0].dxf.location.x) for e in lines]
    yield f"{path.name}: 100.000 mm", None if any(abs(s - 100) < 5e-4 for s in spans) else f"{spans}"
