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

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("ranks", type=int, nargs="*", default=[4, 8, 16, 32])
parser.add_argument("--program", default="build/taut")
parser.add_argument("--hook", default="build/tests/benchmarks/libheap_peak.so")
parser.add_argument("--mpiexec", default="mpirun")
parser.add_argument("--refinements", type=int, default=3)
arguments = parser.parse_args()

SCENE = """set Generator = network
set Bodies    = block
set Contacts  = floor
set Gravity   = 0, 0
subsection Body block
  set Type                = solid
  set Dimension           = 3
  set Young's modulus     = 1e9
  set Poisson's ratio     = 0.3
  set Density             = 7850
  set Symmetry boundaries = 0, 2
  set Pressure            = 5: 1e6*exp(-(x^2+y^2)/0.02)
  subsection Mesh
    set Generator    = subdivided_hyper_rectangle
    set Arguments    = {n} : 0, 0, 0 : {n}
    set Refinements  = {refinements}
    set Distribution = {distribution}
  end
end
subsection Contact floor
  set Slave           = block: 4
  set Obstacle        = plane
  set Point           = 0, 0, 0
  set Direction       = 0, 0, 1
  set Search distance = 0.1
end
subsection Solver
  set Interface operator = matrix-free
end
subsection Partition
  set Number of substructures = {parts}
end
subsection Output
  set Field interval = 0
  set Folder = {folder}
end
subsection Time
  set End = 0
end
"""

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
            scene.write_text(SCENE.format(n=", ".join(map(str, cubes)), parts=parts, distribution=distribution,
                                          refinements=arguments.refinements, folder=f"{folder}/results"))
            run = subprocess.run([arguments.mpiexec, "--oversubscribe", "-np", str(ranks), "-x", f"LD_PRELOAD={arguments.hook}",
                                  arguments.program, scene], capture_output=True, text=True)
            if run.returncode != 0:
                sys.exit(run.stdout + run.stderr)
            heaps = [int(found) for found in re.findall(r"heap: (\d+)", run.stderr)]
            line += [re.search(r"(\d+) iterations of conjugate", run.stdout)[1], f"{max(heaps) / 1e6:.1f}"]
    print("| " + " | ".join(line) + " |", flush=True)
