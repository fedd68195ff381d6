#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Costs of the scenes of prm/ in one table: DoFs, constraints, time of a step without output, time of a DoF and step,
allocations of a step, and the part of a step that takes most.

Each scene runs --runs times in turn with the others, on one core, without fields, checkpoints and the comparison of steps;
times are medians. Scenes at rest have no steps."""
import argparse
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parents[2]
parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--program", type=pathlib.Path, required=True, help="taut, built for release")
parser.add_argument("--allocations", type=pathlib.Path, required=True, help="the program of tests/allocations")
parser.add_argument("--runs", type=int, default=3, help="runs of each scene")
parser.add_argument("--only", default="", help="regular expression: scenes with these names")
arguments = parser.parse_args()

NUMBER = r"([\d.]+(?:e[-+]?\d+)?)"
BARE = ("Output/Field interval=0", "Output/Checkpoint interval=0", "Time/Check steps=no", "Output/Observers=cost")


def said_by(*command):
    done = subprocess.run([*map(str, command)], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


def found(pattern, text, scene):
    match = re.search(pattern, text, re.MULTILINE)
    if not match:
        sys.exit(f"{scene}: no line '{pattern}' in\n{text}")
    return match[1]


def run(scene, folder):
    options = [word for entry in (f"Output/Folder={folder}/{scene.stem}", *BARE) for word in ("--set", entry)]
    return said_by(arguments.program, scene, "--overwrite", *options)


def digits(value):
    """Three digits, without an exponent."""
    return f"{value:.0f}" if value >= 100 else f"{value:.3g}"


def n_dofs(log, scene):
    """Of all bodies: their sum, or one number each."""
    line = found(r"^(  \d+ bod(?:y|ies):.*)$", log, scene)
    total = re.search(r"(\d+) DoFs in all", line)
    return int(total[1]) if total else sum(map(int, re.findall(r"' (\d+) DoFs", line)))


def largest_part(log, scene):
    """Name and share of the time without output."""
    lines = log[log.index("Where the time goes"):].splitlines()[1:]
    parts = [re.fullmatch(rf"  (\S.*?) +{NUMBER} +{NUMBER} %", line) for line in lines]
    times = {part[1]: float(part[2]) for part in parts if part and part[1] != "output"}
    if not times:
        sys.exit(f"{scene}: no parts of a step in\n{log}")
    name = max(times, key=times.get)
    return f"{name} {100 * times[name] / sum(times.values()):.0f} %"


def allocations(scene):
    said = said_by(arguments.allocations, scene.stem)
    return float(found(rf"^{scene.stem} +\d+ +\d+ +{NUMBER}", said, scene))


def row(scene, logs):
    n, log = n_dofs(logs[0], scene), logs[0]
    cells = [scene.stem, n, found(r"^  (\d+|no) multipliers?:", log, scene).replace("no", "0")]
    if " us a step" not in log:
        return [*cells, "at rest", "", "", "", ""]
    times = [float(found(rf"without output {NUMBER} us a step", text, scene)) for text in logs]
    middle = statistics.median(times)
    median = logs[min(range(len(logs)), key=lambda i: abs(times[i] - middle))]
    return [*cells, found(r"^(\d+) steps in ", log, scene), digits(middle), digits(1e3 * middle / n),
            digits(allocations(scene)), largest_part(median, scene)]


scenes = [scene for scene in sorted((root / "prm").glob("*.prm")) if re.search(arguments.only, scene.stem)]
if not scenes:
    sys.exit(f"no scene of prm/ matches '{arguments.only}'")
logs = {scene: [] for scene in scenes}
with tempfile.TemporaryDirectory() as scratch:
    for _ in range(arguments.runs):
        for scene in scenes:
            logs[scene].append(run(scene, scratch))
print("| scene | DoFs | constraints | steps | µs a step | ns a DoF and step | allocations a step | largest part |")
print("|---|---|---|---|---|---|---|---|")
for scene in scenes:
    print("|", " | ".join(map(str, row(scene, logs[scene]))), "|", flush=True)
