#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A cube on a rigid floor, pressed at one edge so that it lifts elsewhere: Taut in parts, as it chooses them, beside deal.II with
algebraic multigrid (by_amg.cc), on one core. Prints a line of a table for each number of elements along an edge: processor time
and memory of the whole programs, sets of closed nodes and iterations in all. Both end at the same closed nodes.
"""
import argparse
import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).parents[1]))
from block_on_floor import block_on_floor

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("elements", type=int, nargs="+")
parser.add_argument("--program", default="build/taut")
parser.add_argument("--by-amg", default="build/tests/benchmarks/cube_by_amg")
parser.add_argument("--residual", default="1e-12", help="of the iterations with multigrid, over the loads")
parser.add_argument("--only-taut", action="store_true")
arguments = parser.parse_args()


def run(command):
    """Output, processor time [s] and memory [GB]."""
    reads, writes = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reads)
        done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        result = [done.returncode, done.stdout + done.stderr, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1e6]
        with os.fdopen(writes, "w") as pipe:
            json.dump(result, pipe)
        os._exit(0)
    os.close(writes)
    with os.fdopen(reads) as pipe:
        code, text, seconds, memory = json.load(pipe)
    os.waitpid(child, 0)
    if code != 0:
        sys.exit(text)
    return text, seconds, memory


def number(pattern, text):
    found = re.search(pattern, text)
    return int(found.group(1)) if found else 0


print("| DoFs | candidates | closed | parts | sets | iterations | Taut [s] | [GB] | sets | iterations | multigrid [s] | [GB] |")
print("|---|---|---|---|---|---|---|---|---|---|---|---|")
for n in arguments.elements:
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "cube.prm"
        scene.write_text(block_on_floor([n] * 3, [1] * 3))
        ours, seconds, memory = run([arguments.program, str(scene), "--set", f"Output/Folder={folder}/results"])
        closed, candidates = map(int, re.search(r"(\d+) of (\d+) nodes are closed", ours).groups())
    line = [3 * (n + 1) ** 3, candidates, closed, number(r"(\d+) parts", ours) or 1, number(r"(\d+) active-set", ours),
            number(r"(\d+) iterations? of conjugate", ours) or "-", f"{seconds:.1f}", f"{memory:.2f}"]
    if not arguments.only_taut:
        theirs, seconds, memory = run([arguments.by_amg, str(n), arguments.residual])
        if number(r"closed (\d+)", theirs) != closed:
            print(f"closed nodes differ: {closed} and {theirs}")
        line += [number(r"sets (\d+)", theirs), number(r"iterations (\d+)", theirs), f"{seconds:.1f}", f"{memory:.2f}"]
    print("| " + " | ".join(map(str, line)) + " |", flush=True)
