#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields, read back by VTK, say the same as the tables of the run; taut-plot makes pictures, and its figures are those
of statistics.json. Tables hold doubles and fields floats: half a unit in the last place of a float is 6e-8."""
import argparse
import csv
import importlib.util
import json
import pathlib
import shutil
import subprocess
import sys
import xml.etree.ElementTree as xml
from importlib.machinery import SourceFileLoader

try:
    import matplotlib  # noqa: F401
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError as missing:
    print(f"skipped: {missing}; install python3-matplotlib and python3-vtk9")
    sys.exit(77)

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--program", type=pathlib.Path, required=True)
parser.add_argument("--root", type=pathlib.Path, required=True)
parser.add_argument("--results", type=pathlib.Path, required=True)
arguments = parser.parse_args()

FLOAT = 6e-8
errors = []


def compare(what, value, expected, size):
    """Equal up to the rounding of floats of this size."""
    difference = np.abs(np.asarray(value) - np.asarray(expected)).max()
    if not difference <= 2 * FLOAT * size + 1e-12:
        errors.append(f"{what}: differs by {difference:.3g}, allowed {2 * FLOAT * size + 1e-12:.3g}")


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        head, *lines = csv.reader(file)
    return dict(zip(head, np.array(lines, dtype=float).T))


def at(series, column, time):
    row = np.argmin(np.abs(series["time [s]"] - time))
    if abs(series["time [s]"][row] - time) > 1e-9:
        errors.append(f"no line at t = {time} in the table with '{column}'")
    return series[column][row]


def read(path):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    data = grid.GetPointData()
    arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
    fields = {array.GetName(): vtk_to_numpy(array).astype(float) for array in arrays}
    return vtk_to_numpy(grid.GetPoints().GetData()).astype(float), fields


def collection(path):
    return [(float(n.get("timestep")), path.parent / n.get("file")) for n in xml.parse(path).iter("DataSet")]


def run(name, *settings):
    """Runs a scene to a fresh folder, with a line in each table at each time of a field."""
    folder = arguments.results / name
    shutil.rmtree(folder, ignore_errors=True)
    command = [arguments.program, arguments.root / "prm" / f"{name}.prm"]
    for setting in (f"Output/Folder={folder}", "Output/Link interval=0", *settings):
        command += ["--set", setting]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return folder


def check_links(folder):
    """Force, gap and state of every link: the fixed ones in the order of links.csv, then the moving ones."""
    tables = [table(folder / name) for name in ("links.csv", "sliding.csv") if (folder / name).exists()]
    columns = [(t, h, h.replace(" force [N]", " gap [m]")) for t in tables for h in t if h.endswith(" force [N]")]
    times = []
    for time, path in collection(folder / "links.pvd"):
        times.append(time)
        _, fields = read(path)
        force = np.array([at(t, f, time) for t, f, _ in columns])
        gap = np.array([at(t, g, time) for t, _, g in columns])
        compare(f"{path}: number of links", len(fields["force"]), len(force), 0)
        compare(f"{path}: force", fields["force"], force, np.abs(force).max())
        compare(f"{path}: gap", fields["gap"], gap, np.abs(gap).max())
        compare(f"{path}: open", fields["open"], force == 0, 0)
    return np.array(times)


def check_probes(folder, probes):
    """Motion of points of wires since the start: {name: (wire, x, z, direction)}."""
    series, start = table(folder / "probes.csv"), {}
    for time, path in collection(folder / "wires.pvd"):
        points, fields = read(path)
        for name, (wire, x, z, direction) in probes.items():
            there = np.flatnonzero((fields["wire"] == wire) & (np.abs(points - [x, 0, z]).max(axis=1) < 1e-4))
            if len(there) == 0:
                errors.append(f"{path}: no point at {name}")
                continue
            u = fields["displacement"][there[0]] @ direction
            first = start.setdefault(name, u)
            column = f"{name} [m]"
            motion = at(series, column, time) - series[column][0]
            compare(f"{path}: {name}", u - first, motion, 2 * max(abs(u), abs(first)))


def check_droppers(folder):
    """The gap of a dropper changes as its ends move: points of both wires at the same x."""
    wires, links = collection(folder / "wires.pvd"), collection(folder / "links.pvd")
    first = None
    for (_, wire_file), (_, link_file) in zip(wires, links):
        points, fields = read(wire_file)
        places, link_fields = read(link_file)
        count = len(places) - 1  # the last one is the sliding contact
        stretch, size = np.zeros(count), 0
        for wire, sign in ((0, -1), (1, 1)):
            mine = np.flatnonzero(fields["wire"] == wire)
            node = mine[np.abs(points[mine, 0][:, None] - places[:count, 0]).argmin(axis=0)]
            u = fields["displacement"][node, 2]
            size += np.abs(u).max()
            stretch += sign * u
            if wire == 1:
                compare(f"{link_file}: displacement", link_fields["displacement"][:count, 2], u, np.abs(u).max())
        value = link_fields["gap"][:count] - stretch
        first = value if first is None else first
        compare(f"{link_file}: gap against the motion of the wires", value, first, 2 * size)


def check_pictures(folder, names, script):
    """Every picture there, as PNG and as PDF."""
    command = [sys.executable, script, folder, "--output", folder / "pictures"]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    for name in names:
        for ending, magic in (("png", b"\x89PNG"), ("pdf", b"%PDF")):
            path = folder / "pictures" / f"{name}.{ending}"
            content = path.read_bytes() if path.exists() else b""
            if not content.startswith(magic) or len(content) < 5000:
                errors.append(f"{path} is missing or empty")


def check_filter(folder, script):
    """The filtered figures of statistics.json from sliding.csv."""
    loader = SourceFileLoader("taut_plot", str(script))
    plot = importlib.util.module_from_spec(importlib.util.spec_from_loader("taut_plot", loader))
    sys.dont_write_bytecode = True
    loader.exec_module(plot)
    figures = json.loads((folder / "statistics.json").read_text())["sliding contacts"]["pantograph"]
    series = table(folder / "sliding.csv")
    time, x, force = (series[c] for c in ("time [s]", "pantograph position [m]", "pantograph force [N]"))
    filtered = plot.low_pass(force, (time[-1] - time[0]) / (len(time) - 1), figures["filter frequency [Hz]"])
    inside = filtered[(x >= figures["window [m]"][0] - 1e-6) & (x <= figures["window [m]"][1] + 1e-6)]
    for name, value in (("mean [N]", inside.mean()), ("standard deviation [N]", inside.std()),
                        ("minimum [N]", inside.min()), ("maximum [N]", inside.max())):
        if abs(value - figures["filtered"][name]) > 1e-9 * abs(value):
            errors.append(f"filtered {name}: {value} is not {figures['filtered'][name]}")


plot_script = arguments.root / "source" / "plot" / "taut-plot"

results = run("en50318_2002_250", "Time/End=0.2", "Output/Field interval=0.05", "Statistics/Window=61,72")
compare("times of the fields", check_links(results), [0, 0.05, 0.1, 0.15, 0.2], 1)
check_probes(results, {f"contact wire at {x} m": (1, x, 0, (0, 0, 1)) for x in (240, 300, 360)})
check_droppers(results)
check_filter(results, plot_script)
check_pictures(results, ["contact_force", "probes", "link_forces", "link_map", "waterfall"], plot_script)

results = run("inclined_cable", "Time/End=2", "Output/Field interval=0.1")
check_links(results)
check_probes(results, {"tip": (0, 3, 0, (0, 0, 1))})
check_pictures(results, ["probes", "link_forces", "waterfall"], plot_script)
forces = []
for (_, wire_path), (_, link_path) in zip(collection(results / "wires.pvd"), collection(results / "links.pvd")):
    tip = read(wire_path)[1]["displacement"][-1]
    link = read(link_path)[1]
    compare(f"{link_path}: slack of the cable", link["gap"][0], -(tip @ (0.6, 0, -0.8)), np.abs(tip).max())
    forces.append(link["force"][0])
if not (max(forces) > 45 and min(forces) == 0):
    errors.append("the cable neither pulls nor goes slack")

results = run("oscillator_with_stop", "Time/End=0.3", "Output/Field interval=0.01")
check_links(results)
check_pictures(results, ["probes", "link_forces"], plot_script)

# The start of the mast is a hand calculation: force, stretch, slack.
results = run("guyed_mast", "Time/End=0")
with open(results / "start.csv", newline="", encoding="utf-8") as start_file:
    start = [[float(line[key]) for key in ("force [N, N m]", "gap [m, rad]")] for line in csv.DictReader(start_file)]
pull = 50 * 10**2 / (2 * 0.6 * 8)
compare("guyed mast", start, [[pull, -pull / 1e5], [0, pull * (1 / 1e5 + 2 * 0.8**2 * 8 / 1e7)]], 0.01)
check_pictures(results, ["static_links"], plot_script)

sys.exit("\n".join(errors) or None)
