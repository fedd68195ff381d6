#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A room includes only rooms above it, and the libraries it is meant to know."""
import argparse
import pathlib
import re
import sys

# From top to bottom; a room may always include itself.
ROOMS = {
    "base": [],
    "complementarity": ["base"],
    "scene": ["base"],
    "substructure": ["base"],
    "wire": ["base", "scene", "substructure"],
    "mechanism": ["base", "scene", "substructure"],
    "solid": ["base", "scene", "substructure"],
    "cable": ["base", "scene", "substructure"],
    "partition": ["base", "scene"],
    "interface": ["base", "complementarity", "substructure"],
    "time": ["base", "complementarity", "substructure", "interface"],
}
for room in ("model", "output", "simulation", "study", "plugins", "program"):
    ROOMS[room] = list(ROOMS)

STANDARD = r"[a-z_0-9]+"  # <vector>
# What is not std and not Taut, by folder: the longest match counts, no entry means anything but Trilinos.
LIBRARIES = {
    "include/taut/base": r"boost/.*|deal\.II/base/.*|mpi\.h",
    "include/taut/complementarity": None,
    "source/complementarity": None,
    "include/taut/scene": None,
    "source/scene": r"boost/.*|deal\.II/base/.*|math\.h|muParser\.h",
}
TRILINOS = r"(Epetra|Aztec|az_aztec|Belos|Teuchos|Ifpack|Amesos|Tpetra|ML|ml|Komplex|Isorropia)\w*\.(h|hpp)" \
           r"|deal\.II/lac/trilinos.*"
TRILINOS_ROOM = "interface"


def problem(folder, room, name):
    """Why a file of this room may not include <name>, or None."""
    taut = re.match(r"taut/([a-z_]+)/", name)
    if taut:
        if taut[1] != room and taut[1] not in ROOMS[room]:
            return f"'{room}' may include {', '.join(ROOMS[room]) or 'no room'}"
        return None
    if re.fullmatch(STANDARD, name):
        return None
    if room != TRILINOS_ROOM and re.fullmatch(TRILINOS, name):
        return f"only '{TRILINOS_ROOM}' knows Trilinos"
    if folder in LIBRARIES and not re.fullmatch(LIBRARIES[folder] or "", name):
        return f"{folder} may include {LIBRARIES[folder] or 'the standard library and Taut only'}"
    return None


parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--root", type=pathlib.Path, required=True)
root = parser.parse_args().root

n_includes, errors = 0, []
for parent in ("include/taut", "source"):
    for file in sorted(f for f in (root / parent).rglob("*") if f.suffix in (".h", ".cc")):
        parts = file.relative_to(root / parent).parts
        if len(parts) == 1:
            errors.append(f"{file}: is in no room")
            continue
        room = parts[0]
        if room not in ROOMS:
            errors.append(f"{file}: '{room}' is no room; known are {', '.join(ROOMS)}")
            continue
        for number, line in enumerate(file.read_text().splitlines(), 1):
            include = re.match(r'\s*#\s*include\s*([<"])(.*)[>"]', line)
            if not include:
                continue
            n_includes += 1
            if include[1] == '"' and parent != "source":
                errors.append(f'{file}:{number}: "{include[2]}": a public header includes no private one')
            name = f"taut/{include[2]}" if include[1] == '"' else include[2]  # "room/x.h" lies in source/
            why = problem(f"{parent}/{room}", room, name)
            if why:
                errors.append(f"{file}:{number}: {include[2]}: {why}")

print(n_includes, "includes")
if n_includes == 0:
    errors.append("no includes found")
sys.exit("\n".join(errors) or None)
