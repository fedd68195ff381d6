# SPDX-License-Identifier: LGPL-2.1-or-later
"""Input of MoorDyn for compare.py: a line without water, and the state that it starts from. MoorDyn's z points up, so
that a place x, y, z of a scene of Taut is x, z, y there."""

import math
import pathlib
import struct

HEAD = """--- MoorDyn Input File ---
one line, no water
--- LINE TYPES ---
TypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx
(name) (m) (kg/m) (N) (N-s/-) (N-m^2) (-) (-) (-) (-)
cable 0.01 {mass} {stiffness} {damping} 0 0 0 0 0
--- POINTS ---
ID Attachment X Y Z M V CdA CA
(-) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)
1 {first} 0 0 0 0 0 0 0
2 {last} {x} 0 {z} {weight} 0 0 0
--- LINES ---
ID LineType AttachA AttachB UnstrLen NumSegs Outputs
(-) (-) (-) (-) (m) (-) (-)
1 cable 1 2 {length} {segments} -
--- OPTIONS ---
0 writeLog
9.81 g
0 rho
1000 WtrDpth
1 disableOutput
1 disableOutTime
{options}
--- need this line ---
"""


def catenary(cable, span):
    """Sag and end tension of an elastic catenary between level ends (Irvine, Cable Structures, 1981)."""
    w, EA, L = 9.81 * cable["mass"], cable["stiffness"], cable["length"]
    V = w * L / 2

    def missing(H):
        return H * L / EA + 2 * H / w * math.asinh(V / H) - span

    low, high = 1e-9 * V, EA
    for _ in range(200):
        middle = .5 * (low + high)
        low, high = (middle, high) if missing(middle) < 0 else (low, middle)
    T = math.hypot(low, V)
    return V * L / (4 * EA) + (T - low) / w, T


def lumped_shape(cable, span, n):
    """Nodes of n elastic segments with their mass at the nodes, at rest between level ends, and the force of an end: the
    segments follow from the horizontal force one by one, because the ends are alike."""
    w, EA, L = 9.81 * cable["mass"], cable["stiffness"], cable["length"]
    h = L / n

    def nodes(H):
        x = y = 0.
        places = [(x, y)]
        for i in range(n):
            V = w * h * (i + .5) - w * L / 2
            T = math.hypot(H, V)
            x += h * (1 + T / EA) * H / T
            y += h * (1 + T / EA) * V / T
            places.append((x, y))
        return places

    low, high = 1e-9 * w * L, EA
    for _ in range(200):
        middle = .5 * (low + high)
        low, high = (middle, high) if nodes(middle)[-1][0] < span else (low, middle)
    return nodes(low), math.hypot(low, w * L / 2)


def write_state(file, places, point):
    """A saved state of MoorDyn 2 at rest: the points as rows of place and velocity, of which `point` is the second, and
    the inner nodes of the line."""
    rows = [[(0, 0)], [point], places[1:-1]]
    words = struct.pack("<Q", len(rows))
    for block in rows:
        words += struct.pack("<QQ", len(block), 6)
        for x, y in block:
            words += struct.pack("<6d", x, 0, y, 0, 0, 0)
    pathlib.Path(file).write_bytes(b"MoorDyn" + struct.pack("<BBQ", 2, 255, len(words) // 8) + words)


def write_input(file, cable, ends, n, options, state=None):
    """ends: types of the points, place and mass of the last one."""
    lines = [f"{value} {name}" for name, value in options.items()]
    if state is not None:
        write_state(pathlib.Path(file).with_suffix(".ic"), state, (ends["x"], ends["y"]))
        lines.append(f"{pathlib.Path(file).stem}.ic fileIC")
    pathlib.Path(file).write_text(HEAD.format(**cable, first="Coupled" if ends["last"] == "Coupled" else "Fixed",
                                              last=ends["last"], x=ends["x"], z=ends["y"], weight=ends["mass"],
                                              segments=n, options="\n".join(lines)))
