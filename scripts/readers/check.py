"""Reads blueprints back with other people's programs and prints a line a check; exits with 1 where one fails."""

import argparse
import hashlib
import json
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import paper
import sheets
import solids

ROOT = Path(__file__).resolve().parents[2]


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--program", default=str(ROOT / "target/debug/plushwright"))
    options.add_argument("--keep", help="folder to write the blueprints to")
    options.add_argument("designs", nargs="*")
    options = options.parse_args()
    designs = options.designs or sorted(str(p) for p in (ROOT / "examples").glob("*.plush"))
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        for design in designs:
            out = Path(options.keep or folder) / Path(design).stem
            started = time.time()
            done = subprocess.run([options.program, "export", design, "-o", out, "--stretch"], capture_output=True, text=True)
            seconds = time.time() - started
            name = Path(design).stem
            if done.returncode:
                print(f"{name}: refused: {done.stderr.strip()}")
                continue
            print(f"{name}: {seconds:.1f} s, {len(list(out.iterdir()))} files")
            for check, fault in checks(out, design):
                failures += fault is not None
                print(f"  {'FAIL' if fault else 'ok  '} {check}{': ' + fault if fault else ''}")
    sys.exit(failures > 0)


def checks(out, design):
    """Pairs of a check's name and its fault, if any."""
    manifest = json.loads((out / "manifest.json").read_text())
    yield "manifest: sizes and hashes", hashes(out, manifest)
    settings = figures(design)
    yield from sheets.checks(out, manifest, settings)
    yield from paper.checks(out)
    yield from solids.checks(out)


def hashes(out, manifest):
    for file in manifest["files"]:
        data = (out / file["name"]).read_bytes()
        if len(data) != file["bytes"] or hashlib.sha256(data).hexdigest() != file["sha256"]:
            return file["name"]
    return None


def figures(design):
    """The seam allowance of a design file, mm."""
    found = re.search(r"seam_allowance_mm:\s*([0-9.]+)", Path(design).read_text())
    return {"allowance": float(found.group(1)) if found else 8.0}


if __name__ == "__main__":
    main()
