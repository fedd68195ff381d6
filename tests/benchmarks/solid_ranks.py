#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The equilibrium of a solid in parts on one and on two ranks: wall time, and what the second rank gains.

A square or cube of Q1 elements, fixed on one side, hangs by its weight, as in solid_decomposition_table. Runs on one and two
ranks take turns; the medians count. What a run without equilibrium takes (program, mesh, partition) is taken off; one part on
one rank is a factor of the whole.
"""
import argparse
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("dimension", type=int, choices=(2, 3))
parser.add_argument("elements", type=int, help="in each direction")
parser.add_argument("parts", type=int)
parser.add_argument("--program", default="build/taut")
parser.add_argument("--mpiexec", default="mpirun")
parser.add_argument("--runs", type=int, default=3)
arguments = parser.parse_args()


def corner(number):
    return ", ".join([str(number)] * arguments.dimension)


SCENE = f"""set Generator = network
set Bodies = box
set Gravity = {", ".join(["0.3", "1", "0.5"][:arguments.dimension])}
subsection Body box
  set Type = solid
  set Dimension = {arguments.dimension}
  set Young's modulus = 1
  set Poisson's ratio = 0.3
  set Density = 1
  set Fixed boundaries = 0
  subsection Mesh
    set Generator = subdivided_hyper_rectangle
    set Arguments = {corner(arguments.elements)} : {corner(0)} : {corner(arguments.elements)}
  end
end
subsection Solver
  set Interface operator = matrix-free
  set Preconditioner = Dirichlet
  set Coarse space = rigid body modes
end
subsection Output
  set Field interval = 0
end
subsection Time
  set End = 0
end
"""


def seconds(file, start, ranks, parts, folder):
    command = [arguments.program, str(file), "--overwrite", "--set", f"Start={start}",
               "--set", f"Partition/Number of substructures={parts}", "--set", f"Output/Folder={folder}/{ranks}"]
    if ranks > 1:
        command = [arguments.mpiexec, "-np", str(ranks), "--bind-to", "core", *command]
    begin = time.monotonic()
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stdout + done.stderr)
    return time.monotonic() - begin


with tempfile.TemporaryDirectory() as name:
    scene = pathlib.Path(name) / "box.prm"
    scene.write_text(SCENE)
    settings = [(1, 1), (1, arguments.parts), (2, arguments.parts)]
    times = {setting: [] for setting in settings}
    for _ in range(arguments.runs):
        for ranks, parts in settings:
            times[ranks, parts].append(seconds(scene, "equilibrium", ranks, parts, name) -
                                       seconds(scene, "undeformed", ranks, parts, name))
    whole, one, two = (statistics.median(times[setting]) for setting in settings)
    nodes = (arguments.elements + 1)**arguments.dimension
    print(f"| {arguments.dimension}-D | {arguments.dimension * nodes} | {arguments.parts} | {whole:.3g} | {one:.3g} | "
          f"{two:.3g} | {one / two:.2f} |")
