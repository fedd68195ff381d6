# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of solids: the pressure of their contacts, their stress."""

import base64
import glob
import os
import struct
import xml.etree.ElementTree as xml
import zlib

import numpy as np
from taut_plot_files import UserError, read_collection
from taut_plot_style import BLUE, Page, panels

HEIGHT = 2.4  # of a panel, inches
LEAST_HEIGHT = 1.0  # of a flat solid, inches
TYPES = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "UInt8": "u1"}
QUADRILATERAL, TRIANGLE = 9, 5  # numbers of VTK


def unpacked(text):
    """The bytes of an array that deal.II writes: the sizes of its blocks, then these, compressed."""
    text = "".join(text.split())
    n_blocks, = struct.unpack("<I", base64.b64decode(text[:8])[:4])
    header = -(-4 * (3 + n_blocks) // 3) * 4
    sizes = struct.unpack(f"<{3 + n_blocks}I", base64.b64decode(text[:header])[:4 * (3 + n_blocks)])[3:]
    blocks = base64.b64decode(text[header:])
    ends = np.cumsum((0,) + sizes)
    return b"".join(zlib.decompress(blocks[a:b]) for a, b in zip(ends[:-1], ends[1:]))


def joined(pieces):
    """The arrays of several pieces as those of one."""
    arrays = {name: np.concatenate([piece[name] for piece in pieces]) for name in pieces[0]}
    for name, size_of in (("connectivity", "positions"), ("offsets", "connectivity")):
        before = np.cumsum([0] + [len(piece[size_of]) for piece in pieces[:-1]])
        arrays[name] = np.concatenate([piece[name] + first for piece, first in zip(pieces, before)])
    return arrays


def read_arrays(path):
    """The arrays of a VTU or PVTU file by name; points are 'positions'."""
    try:
        if path.endswith(".pvtu"):
            pieces = [node.get("Source") for node in xml.parse(path).iter("Piece")]
            return joined([read_arrays(os.path.join(os.path.dirname(path), piece)) for piece in pieces])
        with open(path, "rb") as file:
            head, mark, data = file.read().partition(b'<AppendedData encoding="raw">\n_')
        root = xml.fromstring(head + b"</VTKFile>" if mark else head)
        arrays = {}
        for node in root.iter("DataArray"):
            if mark:
                at = int(node.get("offset"))
                size, = struct.unpack("<Q", data[at:at + 8])
                content = data[at + 8:at + 8 + size]
            else:
                content = unpacked(node.text)
            values = np.frombuffer(content, TYPES[node.get("type")])
            n = int(node.get("NumberOfComponents") or 1)
            arrays[node.get("Name") or "positions"] = values.reshape(-1, n) if n > 1 else values
        return arrays
    except (OSError, xml.ParseError, KeyError, IndexError, TypeError, ValueError, struct.error, zlib.error) as error:
        raise UserError(f"cannot read '{path}': {error}") from error


def last_fields(results, kind, wanted=None):
    """[(name, time, arrays)] of the last field of each contact or body, or of the last one with something of this array."""
    found = []
    for path in sorted(glob.glob(os.path.join(results.folder, "fields", f"{kind}_*.pvd"))):
        name = results.name_of(os.path.basename(path)[len(kind) + 1:-4])
        fields = ((name, time, read_arrays(file)) for time, file in reversed(read_collection(path)))
        field = next((f for f in fields if wanted is None or (wanted in f[2] and f[2][wanted].any())), None)
        if field:
            found.append(field)
    return found


def contact_pressure(results, _):
    """The pressure of each contact at the last field that has some: along the axis that it is longest along, or, of a surface
    in space, over two axes."""
    contacts = last_fields(results, "contact", "pressure")
    if not contacts:
        has_contacts = bool(results.entries.get("Contacts"))
        return None, "the contacts are open in all fields (Output/Field interval)" if has_contacts else None
    figure, grid = panels(len(contacts), HEIGHT)
    for panel, (name, time, arrays) in zip(grid[:, 0], contacts):
        x = arrays["positions"].astype(float)
        along, beside, _ = np.argsort(-np.ptp(x, axis=0), kind="stable")
        slave = results.entries.get(f"Contact {name}/Slave", "").partition(":")[0].strip()
        is_cable = results.entries.get(f"Body {slave}/Type") == "cable"
        what, unit = ("force per length", "N/m") if is_cable else ("pressure", "Pa")
        scale, unit = (1e-6, "MPa") if unit == "Pa" and arrays["pressure"].max() >= 1e5 else (1.0, unit)
        panel.set_xlabel(f"{'xyz'[along]} [m]")
        panel.set_title(f"{name}, t = {time:g} s", loc="left")
        # Many points of a surface have the same x.
        if len(np.unique(np.round(x[:, along], 9))) > 0.9 * len(x):
            order = np.argsort(x[:, along])
            panel.plot(x[order, along], scale * arrays["pressure"][order], ".-", markersize=3, color=BLUE)
            panel.set_ylabel(f"{what} [{unit}]")
            panel.set_ylim(bottom=0)
        else:
            points = panel.scatter(x[:, along], x[:, beside], 12, scale * arrays["pressure"], cmap="viridis")
            figure.colorbar(points, ax=panel, label=f"{what} [{unit}]")
            panel.set_ylabel(f"{'xyz'[beside]} [m]")
            panel.set_aspect("equal")
    return figure, None


def outline(arrays):
    """The edges of a solid in the plane that only one of its cells has, [n, 2, 3], where they are; None for other bodies."""
    x, kinds = arrays["positions"].astype(float), arrays["types"]
    displacement = arrays.get("displacement", np.zeros_like(x))
    if np.ptp(x[:, 2]) or displacement.shape != x.shape or not np.isin(kinds, (QUADRILATERAL, TRIANGLE)).all():
        return None
    begins = np.concatenate(([0], arrays["offsets"][:-1]))
    edges = np.concatenate([np.stack([arrays["connectivity"][begins[kinds == kind] + i],
                                      arrays["connectivity"][begins[kinds == kind] + (i + 1) % n]], axis=1)
                            for kind, n in ((QUADRILATERAL, 4), (TRIANGLE, 3)) for i in range(n)])
    # Each cell has points of its own: those at one place are one.
    scaled = x / max(np.ptp(x, axis=0).max(), 1e-300)
    known, place = np.unique(np.round(scaled, 7), axis=0, return_inverse=True)
    ends, first, count = np.unique(np.sort(place.reshape(-1)[edges], axis=1), axis=0, return_index=True, return_counts=True)
    single = {tuple(pair): index for pair, index in zip(ends[count == 1].tolist(), first[count == 1].tolist())}
    # At a hanging node one edge of a cell and its halves, of two others, are inside.
    nodes = np.unique(list(single)).astype(int)
    for a, b in list(single):
        off = np.abs(known[nodes] - 0.5 * (known[a] + known[b])).max(axis=1)
        middle = int(nodes[off.argmin()])
        halves = [tuple(sorted((end, middle))) for end in (a, b)]
        if off.min() < 1e-6 and all(half in single for half in halves):
            for edge in ((a, b), *halves):
                del single[edge]
    return (x + displacement)[edges[list(single.values())]] if single else np.empty((0, 2, 3))


def triangles(arrays):
    """Those of the cells in the plane; quadrilaterals make two."""
    kinds, nodes = arrays["types"], arrays["connectivity"]
    begins = np.concatenate(([0], arrays["offsets"][:-1]))
    quads = nodes[begins[kinds == QUADRILATERAL][:, None] + np.arange(4)]
    corners = nodes[begins[kinds == TRIANGLE][:, None] + np.arange(3)]
    return np.concatenate((quads[:, [0, 1, 2]], quads[:, [0, 2, 3]], corners))


def stress(results, _):
    """Von Mises' stress of each solid in the plane."""
    bodies = [(name, time, arrays, name_of) for name, time, arrays in last_fields(results, "body")
              for name_of in arrays if "mises" in name_of.lower() and not np.ptp(arrays["positions"][:, 2])]
    if not bodies:
        return None, None
    slopes = [np.ptp(arrays["positions"][:, 1]) / np.ptp(arrays["positions"][:, 0]) for _, _, arrays, _ in bodies]
    heights = [min(2 * HEIGHT, max(LEAST_HEIGHT, 0.75 * Page.width * slope)) for slope in slopes]
    figure, grid = panels(len(bodies), np.mean(heights), height_ratios=heights)
    for panel, (name, time, arrays, name_of) in zip(grid[:, 0], bodies):
        x, values = arrays["positions"], arrays[name_of]
        scale, unit = (1e-6, "MPa") if values.max() >= 1e5 else (1.0, "Pa")
        shown = panel.tripcolor(x[:, 0], x[:, 1], triangles(arrays), scale * values, shading="gouraud", cmap="viridis")
        figure.colorbar(shown, ax=panel, label=f"von Mises' stress [{unit}]")
        panel.set_aspect("equal")
        panel.set_xlabel("x [m]")
        panel.set_ylabel("y [m]")
        panel.set_title(f"{name}, t = {time:g} s", loc="left")
    return figure, None
