#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The largest heap of a rank at constant work: a block on a floor with a cube of 8^3 elements for each rank, and a part for each
500 DoFs. Prints for each number of ranks DoFs, iterations, and the largest heap of a rank [MB], with the mesh shared out in both
ways. `heap_peak.cc` counts what malloc hands out."""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).parents[1]))
from block_on_floor import block_on_floor

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("ranks", type=int, nargs="*", default=[4, 8, 16, 32])
parser.add_argument("--program", default="build/taut")
parser.add_argument("--hook", default="build/tests/benchmarks/libheap_peak.so")
parser.add_argument("--mpiexec", default="mpirun")
parser.add_argument("--refinements", type=int, default=3)
arguments = parser.parse_args()
if not pathlib.Path(arguments.hook).exists():
    sys.exit(f"there is no '{arguments.hook}': build the target heap_peak")

print("| ranks | DoFs | parts | iterations, METIS | heap [MB] | iterations, p4est | heap [MB] |\n|---|---|---|---|---|---|---|")
for ranks in arguments.ranks:
    cubes = [1, 1, 1]
    while cubes[0] * cubes[1] * cubes[2] < ranks:
        cubes[cubes.index(min(cubes))] *= 2
    elements = 2 ** arguments.refinements
    n_dofs = 3
    for n in cubes:
        n_dofs *= n * elements + 1
    parts = max(ranks, n_dofs // 500)
    line = [str(ranks), str(n_dofs), str(parts)]
    for distribution in "METIS", "p4est":
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder) / "block.prm"
            scene.write_text(block_on_floor(cubes, cubes, arguments.refinements, distribution))
            entries = [f"Partition/Number of substructures={parts}", "Solver/Interface operator=matrix-free",
                       f"Output/Folder={folder}/results"]
            run = subprocess.run([arguments.mpiexec, "--oversubscribe", "-np", str(ranks), "-x", f"LD_PRELOAD={arguments.hook}",
                                  arguments.program, scene, *[word for entry in entries for word in ("--set", entry)]],
                                 capture_output=True, text=True)
            if run.returncode != 0:
                sys.exit(run.stdout + run.stderr)
            heaps = [int(found) for found in re.findall(r"heap: (\d+)", run.stderr)]
            line += [re.search(r"(\d+) iterations of conjugate", run.stdout)[1], f"{max(heaps) / 1e6:.1f}"]
    print("| " + " | ".join(line) + " |", flush=True)
