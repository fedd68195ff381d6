#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Instructions a step of bare scenes: what a scene pays for that does not use it.

Each scene runs under callgrind to two end times; the difference over the steps between them is printed, tables and fields
left out. With --features also the EN 50318 line with one feature on at a time. Each --program is a column; scenes use only
entries that the first versions of Taut had."""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parents[2]
parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--program", type=pathlib.Path, action="append", required=True, help="taut, built for release")
parser.add_argument("--features", action="store_true", help="features instead of bare scenes")
parser.add_argument("--only", default="", help="regular expression: scenes or features with these names")
arguments = parser.parse_args()

HEAD = "set Generator = network\nset Gravity = 0, 0\nset Start = given\nsubsection Network\n"
WIRE = """  subsection Wire wire
    set To                          = 100, 0
    set Components                  = string
    set Mass per length             = 1
    set Tension                     = 10000
    set Element size                = 0.5
    set Initial transverse velocity = 0.1
  end
  subsection Support ends
    set Wire      = wire
    set Positions = 0, 100
  end
"""
MASS = """  subsection Mass mass
    set Position             = %s, -1
    set Motions              = y
    set Mass                 = 2
    set Initial displacement = 0, %s, 0
  end
"""
TAIL = "end\nsubsection Time\n  set Scheme = generalised-alpha\n  set Step = 1e-3\nend\n"

SCENES = {
    "one mass on a spring": HEAD + "  set Masses = mass\n  set Springs = spring\n" + MASS % ("0", "0.1") +
    "  subsection Spring spring\n    set From = ground\n    set To = mass\n    set Stiffness = 800\n  end\n" + TAIL,
    "one wire, no link": HEAD + "  set Wires = wire\n  set Supports = ends\n" + WIRE + TAIL,
    "one wire, one bilateral link": HEAD + "  set Wires = wire\n  set Supports = ends\n  set Masses = mass\n"
    "  set Links = joint\n" + WIRE + MASS % ("50", "0") +
    "  subsection Link joint\n    set Type = joint\n    set From = mass\n    set To = wire @ 50\n"
    "    set Direction = 0, 1\n    set Stiffness = rigid\n  end\n" + TAIL,
    "55 m line, no contact that moves": (root / "prm/line_55m.prm").read_text().replace(
        "subsection Time\n", "subsection Time\n  set Scheme = generalised-alpha\n  set Step = 1e-3\n"),
}
LINE = (root / "prm/en50318_2002_250.prm").read_text()
BAR = (root / "prm/bar_on_wall.prm").read_text()
FEATURES = {
    "EN 50318 line": (LINE, []),
    "the same, energy balance": (LINE, ["Output/Observers=energy"]),
    "the same, adaptive steps": (LINE, ["Time/Step control=adaptive", "Time/Adaptive step/Tolerance=3e-6",
                                        "Time/Adaptive step/Halvings=1"]),
    "bar on a wall": (BAR, []),
    "the same, mass redistribution": (BAR, ["Time/Mass redistribution=mass"]),
}


def instructions(program, text, settings, end):
    """Of the loop over the steps, and the number of steps."""
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "scene.prm"
        scene.write_text(text)
        settings = ["Output/Interval=1e9", "Output/Link interval=1e9", "Output/Field interval=0",
                    "Statistics/Window=", "Time/Check steps=no", f"Output/Folder={folder}/results", f"Time/End={end}"] + settings
        out = pathlib.Path(folder) / "callgrind"
        run = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}",
                              "--toggle-collect=taut::ObservedRun::advance*", str(program), str(scene)] +
                             [word for s in settings for word in ("--set", s)],
                             cwd=folder, capture_output=True, text=True)
        if run.returncode != 0:
            sys.exit(f"{program} {settings} ends with {run.returncode}:\n{run.stdout[-2000:]}\n{run.stderr[-2000:]}")
        steps = re.search(r"^(\d+) steps in", run.stdout, re.MULTILINE)
        return int(re.search(r"^(?:summary|totals): (\d+)", out.read_text(), re.MULTILINE).group(1)), int(steps.group(1))


def of_a_step(program, text, settings):
    ends = (0.6, 1.0) if text is BAR else (0.1, 0.5)  # the bar is in contact from 0.5 s on
    (first, n_first), (last, n_last) = (instructions(program, text, settings, end) for end in ends)
    return (last - first) / (n_last - n_first), n_last - n_first


cases = FEATURES if arguments.features else {name: (text, []) for name, text in SCENES.items()}
print("| scene | " + " | ".join(str(p) for p in arguments.program) + " |")
for name, (text, settings) in cases.items():
    if re.search(arguments.only, name):
        figures = [of_a_step(program.resolve(), text, settings) for program in arguments.program]
        print(f"| {name} | " + " | ".join(f"{figure:.0f}" for figure, _ in figures) + " | of " +
              ", ".join(str(n) for _, n in figures) + " steps", flush=True)
