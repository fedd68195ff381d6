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
from taut_plot_style import BLUE, panels

HEIGHT = 2.4  # of a panel, inches
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


def read_arrays(path):
    """The arrays of a VTU file by name; points are 'positions'."""
    try:
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
    except (OSError, xml.ParseError, KeyError, TypeError, ValueError, struct.error, zlib.error) as error:
        raise UserError(f"cannot read '{path}': {error}") from error


def last_fields(results, kind):
    """[(name, time, arrays)] of the last field of each contact or body."""
    found = []
    for path in sorted(glob.glob(os.path.join(results.folder, f"{kind}_*.pvd"))):
        collection = read_collection(path)
        if collection:
            time, file = collection[-1]
            found.append((os.path.basename(path)[len(kind) + 1:-4], time, read_arrays(file)))
    return found


def contact_pressure(results, _):
    """The pressure along each contact, over the axis that it is longest along."""
    contacts = [c for c in last_fields(results, "contact") if "pressure" in c[2]]
    if not contacts:
        return None, None
    figure, grid = panels(len(contacts), HEIGHT)
    for panel, (name, time, arrays) in zip(grid[:, 0], contacts):
        x = arrays["positions"].astype(float)
        along = int(np.argmax(np.ptp(x, axis=0)))
        order = np.argsort(x[:, along])
        scale, unit = (1e-6, "MPa") if arrays["pressure"].max() >= 1e5 else (1.0, "Pa")
        # Many points of a surface have the same x: no line joins them.
        style = ".-" if len(np.unique(x[:, along])) > 0.9 * len(x) else "."
        panel.plot(x[order, along], scale * arrays["pressure"][order], style, markersize=3, color=BLUE)
        panel.set_xlabel(f"{'xyz'[along]} [m]")
        panel.set_ylabel(f"pressure [{unit}]")
        panel.set_title(f"{name}, t = {time:g} s", loc="left")
        panel.set_ylim(bottom=0)
    return figure, None


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
    figure, grid = panels(len(bodies), 2 * HEIGHT)
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
