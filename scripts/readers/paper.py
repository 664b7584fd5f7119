"""PDF: qpdf and poppler; tiles are laid over each other and over the large page."""

import re
import subprocess
import tempfile
from pathlib import Path

import numpy
from PIL import Image

# One pixel is 0.064 mm.
DPI = 400
# Lines of 0.3 mm and words; not the grey frames.
DARK = 100
WHITE_MM, BEYOND_MM = 10.0, 6.0


def checks(out):
    for path in sorted(out.glob("*.pdf")):
        done = subprocess.run(["qpdf", "--check", path], capture_output=True, text=True)
        yield f"{path.name}: qpdf", None if done.returncode == 0 else done.stderr.strip() or done.stdout.strip()
        text = subprocess.run(["pdftotext", path, "-"], capture_output=True, text=True)
        yield f"{path.name}: poppler finds words", None if text.stdout.strip() else text.stderr.strip() or "none"
    for paper, size in (("a4", (210.0, 297.0)), ("letter", (215.9, 279.4))):
        path = out / f"pattern-{paper}.pdf"
        if path.exists():
            yield f"{path.name}: pages of {paper}", sizes(path, size)
            yield f"{path.name}: a square of 100 mm each way", square(path)
            yield from tiles(path, out / "pattern-print.pdf", size)


def sizes(path, size):
    info = subprocess.run(["pdfinfo", "-f", "1", "-l", "999", path], capture_output=True, text=True).stdout
    for w, h in re.findall(r"Page +\d+ size: +([0-9.]+) x ([0-9.]+)", info):
        found = sorted((float(w) * 25.4 / 72, float(h) * 25.4 / 72))
        if any(abs(a - b) > 0.05 for a, b in zip(found, sorted(size))):
            return f"{found}"
    return None


def pages(path, dpi=DPI):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["pdftoppm", "-r", str(dpi), "-gray", path, f"{folder}/p"], check=True)
        return [numpy.array(Image.open(f)) < DARK for f in sorted(Path(folder).glob("p*.pgm"))]


def square(path):
    """The longest level and upright runs of ink on the first page, in its lower part."""
    dark = pages(path, 600)[0]
    lower = dark[dark.shape[0] // 2 :, :]
    across = max(longest(row) for row in lower)
    down = max(longest(column) for column in lower.T)
    mm = [n * 25.4 / 600 for n in (across, down)]
    # The line's own width is 0.3 mm, half of it on either side.
    return None if all(abs(v - 100.3) < 0.15 for v in mm) else f"{mm}"


def longest(row):
    best = run = 0
    for ink in row:
        run = run + 1 if ink else 0
        best = max(best, run)
    return best


def tiles(path, large, size):
    """Every page's ink agrees with its neighbour's in what both show, to a pixel."""
    found = pages(path)
    faults = joints = 0
    layout = frames(path)
    for (i, a), (j, b) in ((p, q) for n, p in enumerate(layout) for q in layout[n + 1 :]):
        if a[0] != b[0]:
            continue
        dx, dy = (b[1] - a[1]), (b[2] - a[2])
        if abs(dx) + abs(dy) != 1:
            continue
        joints += 1
        w, h = size if found[i].shape[0] > found[i].shape[1] else size[::-1]
        first, second = (i, j) if dx + dy > 0 else (j, i)
        # The last common band of the first page is the first one of the second.
        near, far = WHITE_MM, (w if dx else h) - WHITE_MM - 2 * BEYOND_MM
        one, other = (band(found[n], start, w, h, bool(dx)) for n, start in ((first, far), (second, near)))
        faults += differs(one, other) > 0.02 * max(one.sum(), 200)
    yield f"{path.name}: {joints} joints agree within 0.1 mm", None if not faults else f"{faults} do not"


def band(page, start_mm, w_mm, h_mm, upright):
    """What two neighbours show, from a place along the row or column, without the white rim."""
    scale = DPI / 25.4
    along = slice(round(start_mm * scale), round((start_mm + 2 * BEYOND_MM) * scale))
    across = slice(round(WHITE_MM * scale), round(((h_mm if upright else w_mm) - WHITE_MM) * scale))
    return page[across, along] if upright else page[along, across]


def differs(one, other):
    """Pixels of one that have none of the other within one pixel."""
    h, w = min(one.shape[0], other.shape[0]), min(one.shape[1], other.shape[1])
    one, other = one[:h, :w], other[:h, :w]
    grown = numpy.zeros_like(other)
    for dy in (-1, 0, 1):
        for dx in (-1, 0, 1):
            grown |= numpy.roll(numpy.roll(other, dy, 0), dx, 1)
    inner = (one & ~grown)[2:-2, 2:-2]
    return inner.sum()


def frames(path):
    """For each page after the map: its number, and (piece, column, row) as its words say."""
    text = subprocess.run(["pdftotext", "-layout", path, "-"], capture_output=True, text=True).stdout
    found = []
    for i, page in enumerate(text.split("\f")):
        words = re.search(r": (FRONT|BACK[^:]*): page (\d+) of \d+, column (\d+), row (\d+)", page)
        if words:
            found.append((i, (words.group(1), int(words.group(3)), int(words.group(4)))))
    return found
