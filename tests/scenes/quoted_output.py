#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""README.md, doc/tutorial.md and doc/guyed_mast.md quote what the program prints: every line of a block marked `text` there is a line of the run
that the page describes, and the parameter file that the tutorial builds up is the one of prm/; accuracy.md says what another filter
makes of the force. Integers are the same,
decimals to two units of the last digit quoted or a thousandth, residuals at rounding level on both sides."""
import cmath
import csv
import math
import pathlib
import re
import shutil
import subprocess
import sys

sys.path.append(str(pathlib.Path(__file__).parents[1]))
from checks import errors, finish, parse
from quotes import blocks, same_line

arguments = parse(__doc__, "root", "program", "results")
arguments.root = arguments.root.resolve()
def run(*command):
    """What the program says, in the folder of the results."""
    done = subprocess.run([arguments.program, *map(str, command)], cwd=arguments.results, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return done.stdout.splitlines()


n_lines = 0


def compare(page, quoted, printed):
    global n_lines
    for line in quoted:
        if line.strip() == "...":
            continue
        n_lines += 1
        if not any(same_line(line, other) for other in printed):
            near = [other for other in printed if other.split()[:2] == line.split()[:2]][:1]
            errors.append(f"{page} quotes\n  {line}\nwhich the program does not print" + (f"; it prints\n  {near[0]}" if near else ""))


def wrapped(lines):
    """A message that the page breaks into several lines."""
    return [" ".join(line.strip() for line in lines)]


shutil.rmtree(arguments.results, ignore_errors=True)
arguments.results.mkdir(parents=True)
line_run = run(arguments.root / "prm" / "en50318_2002_250.prm")


def brick_wall(forces, step, frequency):
    """Without what is above a frequency, by the discrete Fourier transform."""
    n, mean = len(forces), math.fsum(forces) / len(forces)
    result = [mean] * n
    for k in range(1, int(frequency * n * step) + 1):
        turns = [cmath.exp(-2j * math.pi * k * i / n) for i in range(n)]
        part = sum((force - mean) * turn for force, turn in zip(forces, turns)) / n
        result = [value + 2 * (part * turn.conjugate()).real for value, turn in zip(result, turns)]
    return result


# What another filter makes of the force of the main scene.
with open(arguments.results / "results" / "en50318_2002_250" / "sliding.csv", encoding="utf-8") as table:
    rows = list(csv.DictReader(table))
record = [(float(row["time [s]"]), float(row["pantograph force [N]"])) for row in rows
          if 240 <= float(row["pantograph position [m]"]) <= 360]
filtered = brick_wall([force for _, force in record], record[1][0] - record[0][0], 20.)
centre = math.fsum(filtered) / len(filtered)
figures = (math.sqrt(math.fsum((force - centre) ** 2 for force in filtered) / len(filtered)), max(filtered), min(filtered))
said = "gives σ = {:.1f} N, max {:.1f} N and min {:.1f} N.".format(*figures)
if said not in " ".join((arguments.root / "doc" / "accuracy.md").read_text(encoding="utf-8").split()):
    errors.append(f"accuracy.md does not say what a brick-wall filter at 20 Hz gives: it {said}")

# README has a scene of its own before the main one.
of_block = line_run
for mark, lines in blocks(arguments.root / "README.md"):
    if mark == "prm":
        path = arguments.results / "rope.prm"
        path.write_text("\n".join(lines))
        of_block = run(path, "--set", "Time/End=1")
    elif mark == "text":
        compare("README.md", lines, of_block)
        of_block = line_run

for mark, lines in blocks(arguments.root / "doc" / "tutorial.md"):
    if mark == "text":
        compare("tutorial.md", lines, line_run)

# guyed_mast.md writes mast.prm, block by block.
mast, mast_run = "", None
for mark, lines in blocks(arguments.root / "doc" / "guyed_mast.md"):
    if mark == "prm":
        if "subsection Network" not in lines and lines[0].startswith("  ") and mast.endswith("end\n"):
            mast = mast[:-len("end\n")]  # goes on inside of Network
        mast += "\n".join(lines) + "\n"
        if lines[0].startswith("  "):
            mast += "end\n"
        (arguments.results / "mast.prm").write_text(mast, encoding="utf-8")
    elif mark != "text":
        continue
    elif lines[0].startswith("taut: "):
        compare("guyed_mast.md", wrapped(lines), wrapped(run("mast.prm", "--check")[-1:]))
    else:
        if mast_run is None:
            mast_run = run("mast.prm") + (arguments.results / "results/mast/start.csv").read_text().splitlines()
        compare("guyed_mast.md", lines, mast_run)


def statements(text):
    """Lines of a parameter file in whatever order, without comments, its folder and what is the default."""
    lines = (" ".join(line.split()) for line in text.splitlines() if line.strip() and not line.startswith("#"))
    return sorted(line for line in lines if not line.startswith(("set Folder", "set Scheme = automatic")))


if mast_run is None or statements(mast) != statements((arguments.root / "prm" / "guyed_mast.prm").read_text(encoding="utf-8")):
    errors.append("guyed_mast.md does not build up prm/guyed_mast.prm")
print(n_lines, "lines compared")
if n_lines < 20:
    errors.append("hardly a line is quoted")
finish()
