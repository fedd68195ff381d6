#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cost of a step of the same cable as a wire in the plane, a linearised cable and a nonlinear one in space, side by side.

A span of 60 m at 16 kN is plucked by a force of 100 N in its middle. The cables hang in a plane, or in a wind of 5 N/m across it,
which couples the plane with what is across. The runs follow each other, again and again, so that a busy machine slows down all
of them; the medians count.
"""
import argparse
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--program", default="build/taut")
parser.add_argument("--elements", type=int, default=2400)
parser.add_argument("--steps", type=int, default=100)
parser.add_argument("--step", type=float, default=2e-3, help="[s]")
parser.add_argument("--runs", type=int, default=5)
arguments = parser.parse_args()

TIME = f"subsection Time\n  set End = {arguments.steps * arguments.step}\n  set Step = {arguments.step}\nend\n"
OUTPUT = "subsection Output\n  set Field interval = 0\n  set Interval = 1e9\n  set Link interval = 1e9\nend\n"
LOAD = ("    set Type = point\n    set On = {}\n    set Direction = 0, -1\n    set Magnitude = 100*sin(pi*t)\n")

WIRE = f"""set Generator = network
subsection Network
  set Wires = cable
  set Supports = ends
  set Loads = pluck
  subsection Wire cable
    set From = 0, 0
    set To = 60, 0
    set Components = beam
    set Mass per length = 1.07
    set Tension = 16000
    set Bending stiffness = 10
    set Element size = {60 / arguments.elements}
  end
  subsection Support ends
    set Wire = cable
    set Positions = 0, 60
  end
  subsection Load pluck
{LOAD.format("cable @ 30")}  end
end
"""
CABLE = """set Generator = network
set Bodies = cable
subsection Body cable
  set Type = cable
  set From = 0, 0, 0
  set To = 60, 0, 0
  set Horizontal tension = 16000
  set Axial stiffness = 13e6
  set Bending stiffness = 10
  set Mass per length = 1.07
  set Elements = {elements}
  set Force per length = 0, 0, {wind}
  set Geometry = {geometry}
end
subsection Network
  set Loads = pluck
  subsection Load pluck
{load}  end
end
"""


def step_time(name, scene, folder):
    """Microseconds of a step without output, and what the log says of Newton's method."""
    file = pathlib.Path(folder) / f"{name}.prm"
    file.write_text(scene + TIME + OUTPUT)
    done = subprocess.run([arguments.program, str(file), "--overwrite", "--set", f"Output/Folder={folder}/{name}"],
                          capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stdout + done.stderr)
    solves = re.search(r"([\d.]+) solves a step", done.stdout)
    return float(re.search(r"without output ([\d.e+-]+) us a step", done.stdout)[1]), solves[1] if solves else "1"


scenes = {"wire in the plane": WIRE}
for geometry in ("linearised", "nonlinear"):
    for place, wind in (("space", 0), ("wind", 5)):
        scenes[f"{geometry} cable in {place}"] = CABLE.format(
            elements=arguments.elements, geometry=geometry, wind=wind, load=LOAD.format("cable @ 30, 0"))
times, solves = {name: [] for name in scenes}, {}
with tempfile.TemporaryDirectory() as folder:
    for _ in range(arguments.runs):
        for name, scene in scenes.items():
            time, solves[name] = step_time(name.replace(" ", "_"), scene, folder)
            times[name].append(time)
first = statistics.median(times["wire in the plane"])
print(f"{arguments.elements} elements, steps of {arguments.step} s")
for name, values in times.items():
    median = statistics.median(values)
    print(f"{name:28} {median:10.1f} us a step {median / first:8.2f} x, {solves[name]} solves a step")
