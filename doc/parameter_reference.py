#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes doc/parameters.md from what the program says about its own entries; with --check only compares."""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--program", type=pathlib.Path, required=True)
parser.add_argument("--output", type=pathlib.Path, required=True)
parser.add_argument("--check", action="store_true")
arguments = parser.parse_args()

# One item of each kind, so that each kind's section is declared.
NETWORK = """
set Generator = network
subsection Network
  set Wires        = ITEM
  set Supports     = ITEM
  set Point masses = ITEM
  set Masses       = mass
  set Springs      = ITEM
  set Links        = ITEM
  set Loads        = ITEM
  set Probes       = mass
  subsection Wire ITEM
    set Components      = string
    set Mass per length = 1
    set Tension         = 1
  end
  subsection Support ITEM
    set Wire      = ITEM
    set Positions = 0, 1
  end
  subsection Point mass ITEM
    set Wire      = ITEM
    set Positions = 0.5
  end
  subsection Mass mass
    set Mass = 1
  end
  subsection Spring ITEM
    set To        = mass
    set Stiffness = 1
  end
  subsection Link ITEM
    set To        = ITEM @ 0.5
    set Direction = 0, 1
  end
  subsection Load ITEM
    set On = mass
  end
  subsection Probe mass
    set Point = mass
  end
end
subsection Time
  set End = 0
end
subsection Output
  set Folder = run
  set Probes = ITEM
  subsection Probe ITEM
    set Point = mass
  end
end
subsection Study
  set Parameters = ITEM
  set Quantities = ITEM
  subsection Parameter ITEM
    set Entries = Time/Step
    set Values  = 1
  end
  subsection Quantity ITEM
    set Of = ITEM
  end
end
"""

BODIES = """
set Generator = network
set Start     = undeformed
set Bodies    = solid, cable, rigid body
set Contacts  = ITEM
subsection Body solid
  set Type            = solid
  set Young's modulus = 1
  set Density         = 1
end
subsection Body cable
  set Type              = cable
  set Unstressed length = 1
  set Axial stiffness   = 1e6
  set Mass per length   = 1
end
subsection Body rigid body
  set Type               = rigid body
  set Mass               = 1
  set Moments of inertia = 1, 1, 1
end
subsection Contact ITEM
  set Slave     = solid: 0
  set Obstacle  = plane
  set Direction = 1, 0
end
subsection Sweep
  set Parameters = ITEM
  subsection Parameter ITEM
    set Entries = Time/Step
    set Values  = 1
  end
end
subsection Time
  set End = 0
end
subsection Output
  set Folder = run_of_bodies
end
"""

LINE = """
set Generator = catenary
subsection Catenary
  set Tension lengths = ITEM
  set Point masses    = ITEM
  subsection Tension length ITEM
    set Number of spans = 2
  end
  subsection Point mass ITEM
    set Positions = 5
    set Mass      = 1
  end
  subsection Pantograph pantograph
    set Masses       = 1
    set Stiffnesses  = 1
    set Dampings     = 1
    set Static force = 1
  end
  subsection Contact wire
    set Mass per length = 1
    set Tension         = 1e4
  end
  subsection Messenger wire
    set Mass per length = 1
    set Tension         = 1e4
  end
end
subsection Time
  set End = 0
end
subsection Output
  set Folder = run_of_line
end
"""

REQUIRED = "required"
OWN = ("ITEM", "mass", "solid", "cable", "rigid body")  # names of items
GROUPS = {"Time": "Time and integration", "Partition": "Cutting into substructures", "Solver": "Solvers",
          "Output": "Output", "Statistics": "Statistics", "Study": "Error against cost",
          "Sweep": "Many runs", "Elasticity": "Elasticity of a line", "Catenary": "Generator `catenary`", "Network": "Generator `network`",
          "Body": "Solids, cables and rigid bodies", "Contact": "Contact of surfaces"}


def run(folder, *options):
    done = subprocess.run([arguments.program, *options], cwd=folder, text=True, capture_output=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{arguments.program} {' '.join(options)}: {done.stderr or done.stdout}")


def entries(text):
    """[(path of the section, name, default, help)] of a listing."""
    path, comment, result = [], [], []
    for line in text.splitlines():
        line = line.strip()
        if line.startswith("#"):
            comment.append(line[1:].strip())
            continue
        if line.startswith("subsection "):
            path.append(line[len("subsection "):])
        elif line == "end":
            path.pop()
        elif line.startswith("set "):
            name, value = (part.strip() for part in line[4:].split("=", 1))
            value = value.split("# default:", 1)[-1].strip()
            # Alternatives of a plugin list stand one a line.
            text = re.sub(r"(?<![.,;:(]) \n('[\w -]+':)", r"; \1", " \n".join(comment)).replace(" \n", " ")
            result.append((tuple(path), name, value, text))
        comment = []
    return result


def required(folder, text):
    """{(path of the section, name)}: entries of this smallest file without which the program refuses it."""
    result, path, lines = set(), [], text.splitlines()
    for i, line in enumerate(lines):
        words = line.split()
        if words[:1] == ["subsection"]:
            path.append(" ".join(words[1:]))
        elif words == ["end"]:
            path.pop()
        # Lists of names decide which sections there are.
        elif words[:1] == ["set"] and path and path[0] not in ("Time", "Output") and not (len(path) == 1 and words[-1] in OWN):
            pathlib.Path(folder, "without.prm").write_text("\n".join(lines[:i] + lines[i + 1:]))
            done = subprocess.run([arguments.program, "without.prm", "--check"], cwd=folder, capture_output=True, check=False)
            if done.returncode != 0:
                result.add((tuple(path), line.strip()[4:].split("=")[0].strip()))
    return result


def tidy(path):
    """Names of items are the reader's own."""
    named = ("Wire", "Support", "Tension length", "Point mass", "Mass", "Spring", "Link", "Load", "Probe", "Pantograph", "Parameter", "Quantity",
             "Contact")
    path = tuple(re.sub(rf"^({'|'.join(named)}) (ITEM|mass|pantograph)$", r"\1 <name>", part) for part in path)
    return tuple(re.sub(r"^Body (.*)$", r"Body <name> (Type = \1)", part) for part in path)


def group_of(path):
    return re.sub(" <name>.*", "", path[0])


def table(rows):
    lines = ["| entry | default | meaning |", "|---|---|---|"]
    for name, value, text in rows:
        text = text.replace("|", "\\|").replace("<", "&lt;")
        value = f"`{value}`" if value not in ("", REQUIRED) else value
        lines.append(f"| {name} | {value} | {text} |")
    return lines


with tempfile.TemporaryDirectory() as folder:
    run(folder)
    line = entries(pathlib.Path(folder, "taut.prm").read_text())
    pathlib.Path(folder, "network.prm").write_text(NETWORK)
    run(folder, "network.prm")
    net = entries(pathlib.Path(folder, "run", "used.prm").read_text())
    pathlib.Path(folder, "line.prm").write_text(LINE)
    run(folder, "line.prm")
    parts = entries(pathlib.Path(folder, "run_of_line", "used.prm").read_text())
    pathlib.Path(folder, "bodies.prm").write_text(BODIES)
    run(folder, "bodies.prm")
    bodies = entries(pathlib.Path(folder, "run_of_bodies", "used.prm").read_text())
    needed = {entry for text in (NETWORK, LINE, BODIES) for entry in required(folder, text)}

sections = {}
for source in (line, parts, net, bodies):
    for path, name, value, text in source:
        text = re.sub(r"^(Listing of Parameters -+ )", "", text)
        if name == "Generator" and not path:
            value = "catenary"
        rows = sections.setdefault(tidy(path), [])
        if name not in [row[0] for row in rows]:
            rows.append((name, REQUIRED if (path, name) in needed else "" if value in OWN else value, text))

HEAD = """# Parameter reference

Every entry of a parameter file, as the program describes it. This page is generated: after a change of an entry run
`cmake --build build --target update_parameter_reference`.

An entry whose default is "required" has to be given where its section is used, or one that its meaning names in its place.
`taut` without a file writes these entries for a railway line, `used.prm` in a results folder those of its run. Names of
items, `<name>` below, are yours: list them in the entry that says so, then give each its section. Units stand in
brackets; a formula knows `pi`, `t` [s], on a wire `s` [m], and in sections `Body` and `Contact` `x`, `y`, `z` [m]. Types of
bodies from plugins have entries of their own.

A formula may take measured data: `table(FILE.csv, column)` is a column of a CSV file over its first column, alone or inside of a
formula, as in `0.001*table(profile.csv, height) + 0.01*sin(s)`. The first column is s in entries of s, t in entries of t, d in
elongations; where a formula has several variables, a word says which: `table(FILE.csv, column, t)`. Between its rows, which are
sorted, a table is straight; with the word `cubic` at the end, a monotone cubic. Rows have to cover what is used; `t < 1 ? 0 : table(...)`
asks a table only where it is chosen. Names of files are relative to the parameter file, and a run copies its tables into its
results folder, beside `used.prm`.

`include FILE` reads another parameter file in this place; its name is relative to the file that includes it. What an included file
sets may be set again after the include, by the file that includes it. Any other entry that is set twice is an error.

## Top of the file
"""
out = HEAD.splitlines() + [""]
out += table(sections[()])
group = None
order = [*GROUPS, *(group_of(path) for path in sections if path and group_of(path) not in GROUPS)]
for path in sorted((p for p in sections if p), key=lambda p: order.index(group_of(p))):
    if group_of(path) != group:
        group = group_of(path)
        out += ["", f"## {GROUPS.get(group, group)}"]
    out += ["", f"### {' / '.join(path)}".replace("<", "\\<").replace(">", "\\>"), ""] + table(sections[path])
text = "\n".join(out) + "\n"

if arguments.check:
    if not arguments.output.exists() or arguments.output.read_text() != text:
        sys.exit(f"{arguments.output} is stale: run the target update_parameter_reference")
else:
    arguments.output.write_text(text)
