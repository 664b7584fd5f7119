"""Poses the same problems to plushwright and to other people's solvers, and prints the table of ratios."""

import argparse
import json
import os
import platform
import re
import subprocess
import sys
import tempfile
import time
from datetime import date
from importlib import metadata
from pathlib import Path

import numpy as np

from inverse import Inverse, NoEquilibrium, descend
from problems import SHAPES, at_work, generate


# Runs of each process in the statics part, of which the quickest counts.
TURNS = 3


def arguments():
    parser = argparse.ArgumentParser(prog="scripts/peers", description=__doc__)
    parser.add_argument("part", choices=["all", "inverse", "statics"], nargs="?", default="all", help="which problems [all]")
    parser.add_argument("--seed", type=int, default=1, help="seed of the problems [1]")
    parser.add_argument("--count", type=int, default=40, help="how many inverse problems [40]")
    parser.add_argument("--only", type=int, nargs="+", metavar="N", help="these numbers of the seed alone")
    parser.add_argument("--files", type=Path, nargs="+", default=[], metavar="FILE", help="these problem files instead of seeded ones")
    parser.add_argument("--keep", type=Path, metavar="DIR", help="write the problem files and the results as JSON lines there")
    parser.add_argument("--earlier", type=Path, metavar="FILE", help="results.jsonl of an earlier run, whose L-BFGS-B is not run again")
    parser.add_argument("--limit", type=float, default=60.0, metavar="S", help="longest run of L-BFGS-B from one start [60]")
    parser.add_argument("--program", type=Path, default=Path("target/release/plushwright"), help="the built program")
    parser.add_argument("--method", default="default", help="--method of `plushwright solve`")
    parser.add_argument("--fibres", type=int, nargs="+", default=[1000, 5000, 10000], help="sizes of the statics problems")
    return parser.parse_args()


def timed(command):
    """Runs a command to its end: its standard error, the CPU time of the whole process, s, which does not depend on who else is there, and
    what part that is of the time by the clock."""
    began = time.perf_counter()
    with tempfile.TemporaryFile() as said:
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=said)
        _, _, used = os.wait4(process.pid, 0)
        seconds = used.ru_utime + used.ru_stime
        said.seek(0)
        return said.read().decode(), seconds, min(1.0, seconds / (time.perf_counter() - began))


def ours(program, problem, folder, *options):
    """The answer of `plushwright solve`, its CPU time, s, and the CPU time of solving alone where the answer or `--times` says how long that took."""
    question, answer = folder / "question.json", folder / "answer.json"
    question.write_text(json.dumps(problem))
    answer.unlink(missing_ok=True)
    said, seconds, busy = timed([program, "solve", question, "-o", answer, *options])
    if not answer.exists():
        sys.exit(f"{problem['name']}: plushwright gave no answer: {said.strip()}")
    answer = json.loads(answer.read_text())
    solving = re.findall(r"solving ([0-9.]+) ms", said) or [answer.get("soft_ik", {}).get("milliseconds", np.nan)]
    return answer, seconds, 1e-3 * busy * float(solving[0])


def judged(problem, ik):
    """O and the projected gradient at our activations, from independent statics that start at our positions."""
    inverse = Inverse(problem)
    beta = np.array(ik["beta"])
    inverse.x = np.array(ik["x"]).ravel()
    try:
        value, gradient = inverse.value(beta)
    except NoEquilibrium:
        return None
    absolute, scaled = inverse.projected_gradient(beta, gradient)
    outside = max((inverse.lower - beta).max(), (beta - inverse.upper).max())
    return {"objective": value, "projected_gradient": absolute, "scaled": scaled / inverse.at_rest(), "outside_bounds": max(outside, 0.0)}


def theirs(library, problem, folder):
    """The answer of another library in a process of its own, and the CPU time of that process, s."""
    question, answer = folder / "question.json", folder / "answer.json"
    question.write_text(json.dumps(problem))
    answer.unlink(missing_ok=True)
    said, seconds, _ = timed([sys.executable, Path(__file__).parent / "others.py", library, question, answer])
    if not answer.exists():
        sys.exit(f"{problem['name']}: {library} gave no answer: {said.strip()}")
    return json.loads(answer.read_text()), seconds


def statics_part(options, folder):
    print("\nStatics: felupe and scikit-fem against `plushwright solve`, one thread each, best of three runs of each process.")
    print("CPU times. solver: theirs Newton's method alone, ours all but start, reading and writing; steps: parts of the contraction.")
    print("apart: largest distance between their positions and ours, m.\n")
    print(f"{'shape':>6} {'fibres':>6} {'library':>8} {'s theirs':>8} {'s ours':>7} {'whole':>7} {'solver s':>8} {'ours ms':>7} {'solver':>7} {'steps':>5} {'Newton':>6} {'ours':>5} {'apart':>8}")
    for number, fibres in enumerate(options.fibres):
        problem = at_work(options.seed, number, fibres)
        if options.keep:
            (options.keep / f"statics-{fibres}.json").write_text(json.dumps(problem))
        answer, whole, alone = min((ours(options.program, problem, folder, "--times") for _ in range(TURNS)), key=lambda r: r[1])
        for library in ("felupe", "skfem"):
            other, seconds = min((theirs(library, problem, folder) for _ in range(TURNS)), key=lambda r: r[1])
            apart = np.abs(np.array(other["x"]) - np.array(answer["x"]).ravel()).max()
            print(
                f"{SHAPES[number % len(SHAPES)]:>6} {len(problem['elements']):>6} {library:>8} {seconds:8.2f} {whole:7.3f} {seconds / whole:7.1f} "
                f"{1e-3 * other['milliseconds']:8.3f} {1e3 * alone:7.1f} {1e-3 * other['milliseconds'] / alone:7.1f} {other['steps']:>5} {other['iterations']:>6} {answer['iterations']:>5} {apart:8.1e}",
                flush=True,
            )


def inverse_part(options, folder):
    questions = [(path.stem, json.loads(path.read_text())) for path in options.files]
    if not questions:
        questions = [(f"{number:03}", lambda n=number: generate(options.seed, n)) for number in options.only or range(options.count)]
    print("\nInverse problems: scipy's L-BFGS-B (better of zero and taut) against `plushwright solve`, one thread each.")
    print("O ratio: ours / theirs. Time ratios: theirs / ours, theirs the run with the better value (the quicker one if equal):")
    print("whole: CPU time of the whole run / of the whole process; solver: CPU time until it is within 0.1 % of its value / of `milliseconds`.")
    print("pg: largest free dO/dbeta times rest length, part of O at rest, by independent statics at our activations.\n")
    print(f"{'problem':>7} {'winches':>7} {'nodes':>6} {'O theirs':>10} {'O ours':>10} {'O ratio':>8} {'s theirs':>8} {'s ours':>7} {'whole':>7} {'solver':>7} {'pg':>8}  converged")
    rows, earlier = [], {}
    if options.earlier:
        earlier = {row["problem"]: row for row in map(json.loads, options.earlier.read_text().splitlines())}
    for name, question in questions:
        problem = question() if callable(question) else question
        if options.keep:
            (options.keep / f"{name}.json").write_text(json.dumps(problem))
        known = earlier.get(name, {})
        runs = known["runs"] if known.get("name") == problem["name"] else [descend(problem, start, options.limit) for start in ("zero", "taut")]
        best = min(r["objective"] for r in runs)
        peer = min((r for r in runs if r["objective"] <= 1.001 * best), key=lambda r: r["seconds"])
        row = {"problem": name, "name": problem["name"], "winches": len(problem["soft_ik"]["winch_ids"]), "nodes": len(problem["mesh"]["nodes"]), "theirs": best, "runs": runs}
        if options.program:
            asked = {k: v for k, v in problem.items() if k != "contractions"}
            answer, whole, alone = ours(options.program, asked, folder, "--method", options.method)
            ik = answer["soft_ik"]
            row |= {"ours": ik["objective"], "ratio": ik["objective"] / best, "converged": answer["converged"], "error": answer.get("error")}
            row |= {"solver_s": alone, "whole_s": whole, "factorizations": ik["factorizations"], "claimed_gradient": ik.get("projected_gradient")}
            row |= {"judged": judged(problem, ik), "whole_ratio": peer["seconds"] / whole, "solver_ratio": peer["seconds_to_0.1%"] / alone}
            scaled = row["judged"]["scaled"] if row["judged"] else np.nan
            print(
                f"{name[-7:]:>7} {row['winches']:>7} {row['nodes']:>6} {best:10.4e} {row['ours']:10.4e} {row['ratio']:8.4f} {peer['seconds']:8.2f} {whole:7.3f} "
                f"{row['whole_ratio']:7.1f} {row['solver_ratio']:7.1f} {scaled:8.1e}  {row['converged']}",
                flush=True,
            )
        rows.append(row)
        if options.keep:
            with open(options.keep / "results.jsonl", "a") as out:
                out.write(json.dumps(row) + "\n")
    summary(rows)


def summary(rows):
    column = lambda name: np.array([row[name] for row in rows])
    behind = column("ratio") > 1.001
    print(f"\nO: worst ratio {column('ratio').max():.4f}; above 1.001 in {behind.sum()} of {len(rows)}; below 0.999 in {(column('ratio') < 0.999).sum()}.")
    for name, what in (("whole_ratio", "whole process"), ("solver_ratio", "solver alone")):
        print(f"Time, {what}: theirs / ours median {np.median(column(name)):.1f}, worst {column(name).min():.2f}.")
    wrong = [row["problem"] for row in rows if row["converged"] and (not row["judged"] or row["judged"]["outside_bounds"] > 0)]
    print(f"Converged {column('converged').sum()} of {len(rows)}" + (f"; wrongly: {' '.join(wrong)}." if wrong else "."))


def versions():
    """Who is compared, where and when."""
    libraries = ", ".join(f"{name} {metadata.version(name)}" for name in ("numpy", "scipy", "felupe", "scikit-fem"))
    cpuinfo = Path("/proc/cpuinfo")
    named = re.search(r"model name\s*: (.*)", cpuinfo.read_text()) if cpuinfo.exists() else None
    print(f"{date.today()}, {named[1] if named else platform.processor() or platform.machine()}, Python {platform.python_version()}, {libraries}")


def main():
    options = arguments()
    versions()
    if options.keep:
        options.keep.mkdir(parents=True, exist_ok=True)
        (options.keep / "results.jsonl").unlink(missing_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        if options.part in ("all", "inverse"):
            inverse_part(options, Path(folder))
        if options.part in ("all", "statics"):
            statics_part(options, Path(folder))


if __name__ == "__main__":
    main()
