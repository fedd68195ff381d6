#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cost of a step and memory of the railway line from 1e4 to 1e6 DoFs, and what a second rank gains.

Grows the line of prm/en50318_2002_250.prm by refinement and by spans, fits the exponents of step time and peak memory over
the number of DoFs; then runs one and two ranks in turn with the same parts, beside the ratio of memory bandwidths of two
processes and one, the ceiling of what a second rank can gain.
"""
import argparse
import math
import os
import re
import statistics
import subprocess
import sys
import tempfile

LENGTHS = "0.9856, 0.8041, 0.6473, 0.5533, 0.5220, 0.5533, 0.6473, 0.8041, 0.9856"

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--program", default="build/taut")
parser.add_argument("--prm", default="prm/en50318_2002_250.prm")
parser.add_argument("--mpiexec", default="mpirun")
parser.add_argument("--largest", type=float, default=1e6, help="number of DoFs to grow to")
parser.add_argument("--repeats", type=int, default=5, help="pairs of runs on one and two ranks")
parser.add_argument("--parts", type=int, default=2, help="number of substructures of these runs")
parser.add_argument("--steps", type=int, default=50)
parser.add_argument("--runs", type=int, default=3, help="runs of each size, of which the fastest counts")
parser.add_argument("--only", choices=["refinement", "spans", "ranks"])
arguments = parser.parse_args()


def run(n_spans, element_size, folder, ranks=1, parts=1):
    """Number of DoFs, microseconds a step, peak memory in MB (of one rank: of mpirun itself if there are more)."""
    settings = {
        "Output/Folder": folder, "Output/Field interval": 0, "Output/Interval": 1e9, "Output/Link interval": 1e9,
        "Start": "undeformed", "Catenary/Droppers/Lengths": LENGTHS, "Catenary/Number of spans": n_spans,
        "Catenary/Contact wire/Element size": element_size, "Catenary/Messenger wire/Element size": element_size,
        "Catenary/Uplift positions": 60, "Statistics/Window": "", "Partition/Number of substructures": parts,
        "Time/Scheme": "generalised-alpha", "Time/End": arguments.steps * 1e-3,
    }
    command = [arguments.program, arguments.prm, "--overwrite"]
    for entry, value in settings.items():
        command += ["--set", f"{entry}={value}"]
    if ranks > 1:
        command = [arguments.mpiexec, "-np", str(ranks), "--bind-to", "core", *command]
    with tempfile.TemporaryFile("w+") as text:
        process = subprocess.Popen(command, stdout=text, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(process.pid, 0)
        text.seek(0)
        said = text.read()
    if status != 0:
        sys.exit(said)
    dofs = re.search(r"(\d+) DoFs in all", said)
    n_dofs = int(dofs[1]) if dofs else sum(map(int, re.findall(r"' (\d+) DoFs", said)))
    return n_dofs, float(re.search(r"without output ([\d.e+-]+) us a step", said)[1]), usage.ru_maxrss / 1024


def slope(x, y):
    x, y = list(map(math.log, x)), list(map(math.log, y))
    mx, my = statistics.mean(x), statistics.mean(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)


def grow(title, sizes, folder):
    print(f"\nGrowing by {title}\n\n| DoFs | us a step | ns a DoF | peak memory [MB] |\n|---|---|---|---|")
    rows = []
    for n_spans, element_size in sizes:
        rows.append(min((run(n_spans, element_size, folder) for _ in range(arguments.runs)), key=lambda row: row[1]))
        n, time, memory = rows[-1]
        print(f"| {n} | {time:.4g} | {1e3 * time / n:.3g} | {memory:.0f} |", flush=True)
    n = [row[0] for row in rows]
    program = run(2, 3., folder)[2]
    print(f"\nexponents: time {slope(n, [row[1] for row in rows]):.3f}, memory "
          f"{slope(n, [row[2] - program for row in rows]):.3f} (without the {program:.0f} MB that a line of 2 spans takes)")


def bandwidth_ratio():
    """Bandwidth of two processes over that of one, copying arrays that no cache holds."""
    code = ("import time\na = bytearray(300_000_000); b = bytearray(300_000_000); best = 1e9\n"
            "for _ in range(8):\n    t = time.perf_counter(); b[:] = a; best = min(best, time.perf_counter() - t)\n"
            "print(best)")
    start = lambda: subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    one = float(start().communicate()[0])
    pair = [start(), start()]
    two = max(float(p.communicate()[0]) for p in pair)
    return 2 * one / two


def ranks(folder):
    print(f"\nOne and two ranks, {arguments.parts} parts, {arguments.repeats} pairs, median ratio\n\n"
          "| DoFs | us a step, 1 rank | 2 ranks | ratio | bandwidth of 2 processes over 1 |\n|---|---|---|---|---|")
    for n_dofs in (1e5, 1e6):
        if n_dofs > arguments.largest:
            continue
        element_size = 4 * 600 / n_dofs
        pairs = [[run(10, element_size, folder, n, arguments.parts) for n in (1, 2)] for _ in range(arguments.repeats)]
        ratio = statistics.median(one[1] / two[1] for one, two in pairs)
        one, two = (statistics.median(pair[i][1] for pair in pairs) for i in (0, 1))
        print(f"| {pairs[0][0][0]} | {one:.4g} | {two:.4g} | {ratio:.2f} | {bandwidth_ratio():.2f} |", flush=True)


wanted = [n for n in (1e4, 3e4, 1e5, 3e5, 1e6) if n <= arguments.largest]
with tempfile.TemporaryDirectory() as scratch:
    if arguments.only in (None, "refinement"):
        grow("refinement", [(10, 4 * 600 / n) for n in wanted], scratch)
    if arguments.only in (None, "spans"):
        grow("spans", [(round(n / 480), 0.5) for n in wanted], scratch)
    if arguments.only in (None, "ranks"):
        ranks(scratch)
