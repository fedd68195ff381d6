#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Prints what a step of the reference line costs by part, as a Markdown table: its time, its instructions and the
data that it takes from beyond the first-level cache, beside the times that these two allow. Instructions and
cache misses are callgrind's, with AVX2. They are the difference of two runs. Times are the log's.

    tests/benchmarks/step_parts.py --program build/taut [--scheme "backward Euler"]
"""
import argparse
import ctypes
import pathlib
import re
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENE = ROOT / "prm" / "en50318_2002_250.prm"
# A part of the log, and the function that has it.
PARTS = {
    "places and moving rows": ("places of constraints|moving rows of F", "Motion::begin_step"),
    "loads and history": ("loads and history", "Step::set_loads"),
    "free gaps": ("free gaps", "ContactStep::set_problem"),
    "contact problem": ("contact problem", "ContactStep::find_multipliers"),
    "solve of bodies": ("solve of bodies", "StepEquations::find_increments"),
    "state and balance": ("state and balance", r"Step::accept\(taut::State&, taut::Certificate&\)"),
    "certificate": ("certificate", "Step::certify"),
    "contact measures": ("contact measures", "ContactMeasures::record"),
}
ENDS = (0.1, 0.2)
INSTRUCTIONS_A_CYCLE, LINE = 4, 64


def call(command, folder, scheme, end=None):
    settings = ["Output/Interval=1e9", "Output/Link interval=1e9", "Output/Field interval=0",
                "Time/Check steps=no", f"Time/Scheme={scheme}", f"Output/Folder={folder}/results"]
    if end:
        settings += ["Statistics/Window=", f"Time/End={end}"]
    return subprocess.run([*command, str(SCENE), "--overwrite"] + [word for s in settings for word in ("--set", s)],
                          check=True, capture_output=True, text=True, cwd=folder).stdout


def counts(program, folder, scheme, end):
    """Instructions and first-level misses of each part so far, and the number of steps."""
    out = f"{folder}/callgrind"
    log = call(["valgrind", "--tool=callgrind", "--cache-sim=yes", f"--callgrind-out-file={out}",
                "--toggle-collect=taut::ObservedRun::advance*", str(program)], folder, scheme, end)
    table = subprocess.run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", "--show=Ir,D1mr,D1mw", out],
                           check=True, capture_output=True, text=True).stdout
    found = {}
    for part, (_, function) in PARTS.items():
        line = next(line for line in table.splitlines() if re.search(r":taut::" + function, line))
        numbers = [int(n.replace(",", "")) for n in re.findall(r"([\d,]+) \( *[\d.]+%\)", line)]
        found[part] = (numbers[0], sum(numbers[1:]))
    return found, int(re.search(r"^(\d+) steps in", log, re.M).group(1))


def times(program, folder, scheme, rounds):
    """Least time of each part in rounds of runs [us]."""
    least = {}
    for _ in range(rounds):
        log = call([str(program)], folder, scheme)
        for part, (names, _) in PARTS.items():
            spent = sum(float(t) for t in re.findall(rf"^  (?:{names}) +([\d.]+) ", log, re.M))
            least[part] = min(least.get(part, spent), spent)
    return least


def bandwidth():
    """Of a copy in the second-level cache, read and written [bytes a second]."""
    size, best = 131072, float("inf")
    source, target = ctypes.create_string_buffer(size), ctypes.create_string_buffer(size)
    for _ in range(2000):
        start = time.perf_counter()
        for _ in range(10):
            ctypes.memmove(target, source, size)
        best = min(best, (time.perf_counter() - start) / 10)
    return 2 * size / best


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True, type=pathlib.Path)
    parser.add_argument("--scheme", default="backward Euler")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--gigahertz", type=float, default=3., help="clock of the core")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        program = arguments.program.resolve()
        (first, n_first), (last, n_last) = (counts(program, folder, arguments.scheme, end) for end in ENDS)
        spent, rate = times(program, folder, arguments.scheme, arguments.rounds), bandwidth()
    print(f"Second-level cache: {1e-9 * rate:.0f} GB/s\n")
    print("| part | µs | instructions | kB | µs by instructions | µs by data |\n|---|---|---|---|---|---|")
    total = [0.] * 5
    for part in PARTS:
        instructions, misses = ((b - a) / (n_last - n_first) for a, b in zip(first[part], last[part]))
        data = LINE * misses
        figures = (spent[part], instructions, 1e-3 * data,
                   1e-3 * instructions / INSTRUCTIONS_A_CYCLE / arguments.gigahertz, 1e6 * data / rate)
        total = [a + b for a, b in zip(total, figures)]
        print(f"| {part} | " + " | ".join(f"{x:.{0 if x > 100 else 1}f}" for x in figures) + " |")
    print("| all | " + " | ".join(f"{x:.{0 if x > 100 else 1}f}" for x in total) + " |")


if __name__ == "__main__":
    main()
