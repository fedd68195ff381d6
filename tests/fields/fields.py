#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields, read back by VTK, say the same as the tables of the run; taut-plot makes pictures, and its figures are those
of statistics.json. Tables hold doubles and fields floats: half a unit in the last place of a float is 6e-8."""
import csv
import html.parser
import json
import pathlib
import re
import shutil
import subprocess
import sys
import time
import xml.etree.ElementTree as xml

try:
    import matplotlib  # noqa: F401
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import vtkDataObject
    from vtkmodules.vtkFiltersGeneral import vtkWarpVector
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError as missing:
    print(f"skipped: {missing}; install python3-matplotlib and python3-vtk9")
    sys.exit(77)

sys.path.append(str(pathlib.Path(__file__).parents[1]))
from checks import entries, errors, finish, load_plot, parse

arguments = parse(__doc__, "program", "root", "results")

FLOAT = 6e-8


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


class Grid:
    """Points, their data, and cells with theirs, as VTK reads them."""

    def __init__(self, path):
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(path))
        reader.Update()
        grid = reader.GetOutput()
        self.points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
        data = grid.GetPointData()
        arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
        self.fields = {array.GetName(): vtk_to_numpy(array).astype(float) for array in arrays}
        self.cells = []
        for i in range(grid.GetNumberOfCells()):
            ids = grid.GetCell(i).GetPointIds()  # VTK's own, until the next cell is asked for
            self.cells.append([ids.GetId(k) for k in range(ids.GetNumberOfIds())])
        names = grid.GetCellData().GetAbstractArray("name")
        self.names = [names.GetValue(i) for i in range(grid.GetNumberOfCells())]

    def wire(self, name):
        """Indices of the points of a wire."""
        return np.unique(np.concatenate([cell for cell, mine in zip(self.cells, self.names) if mine == name]))

    def ends(self, which):
        """Indices of the first (0) or last (-1) point of each cell."""
        return np.array([cell[which] for cell in self.cells])


def collection(path):
    return [(float(n.get("timestep")), path.parent / n.get("file")) for n in xml.parse(path).iter("DataSet")]


def run(name, *settings, scene=None):
    """Runs a scene to a fresh folder, with a line in each table at each time of a field."""
    folder = arguments.results / name
    shutil.rmtree(folder, ignore_errors=True)
    command = [arguments.program, arguments.root / "prm" / f"{scene or name}.prm",
               *entries(f"Output/Folder={folder}", *([] if "Link interval" in str(settings) else ["Output/Link interval=0"]), *settings)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return folder


def check_links(folder):
    """Force, gap and state at the ends of every link: the fixed ones in the order of links.csv, then the moving."""
    tables = [table(folder / name) for name in ("links.csv", "sliding.csv") if (folder / name).exists()]
    columns = [(t, h, h.replace(" force [N]", " gap [m]")) for t in tables for h in t if h.endswith(" force [N]")]
    times = []
    for time, path in collection(folder / "fields/links.pvd"):
        times.append(time)
        grid = Grid(path)
        force = np.array([at(t, f, time) for t, f, _ in columns])
        gap = np.array([at(t, g, time) for t, _, g in columns])
        if grid.names != [h.replace(" force [N]", "") for _, h, _ in columns]:
            errors.append(f"{path}: the names of the links are not those of the tables")
            continue
        for end in (0, -1):
            ends = grid.ends(end)
            compare(f"{path}: force", grid.fields["force"][ends], force, np.abs(force).max())
            compare(f"{path}: gap", grid.fields["gap"][ends], gap, np.abs(gap).max())
            compare(f"{path}: open", grid.fields["open"][ends], force == 0, 0)
    return np.array(times)


def check_probes(folder, probes):
    """Motion of points of wires since the start: {name: (wire, x, y, direction)}."""
    series, start = table(folder / "probes.csv"), {}
    for time, path in collection(folder / "fields/wires.pvd"):
        grid = Grid(path)
        for name, (wire, x, y, direction) in probes.items():
            mine = grid.wire(wire)
            there = mine[np.abs(grid.points[mine] - [x, y, 0]).max(axis=1) < 1e-4]
            if len(there) == 0:
                errors.append(f"{path}: no point at {name}")
                continue
            u = grid.fields["displacement"][there[0]] @ direction
            first = start.setdefault(name, u)
            column = f"{name} [m]"
            motion = at(series, column, time) - series[column][0]
            compare(f"{path}: {name}", u - first, motion, 2 * max(abs(u), abs(first)))


def check_droppers(folder):
    """The ends of a dropper move like the points of the wires at the same x, and its gap changes as they do."""
    first = None
    for (_, wire_path), (_, link_path) in zip(collection(folder / "fields/wires.pvd"), collection(folder / "fields/links.pvd")):
        wires, links = Grid(wire_path), Grid(link_path)
        count = len(links.names) - 1  # the last one is the sliding contact
        stretch, size = np.zeros(count), 0
        for wire, end, sign in (("messenger", 0, -1), ("contact", -1, 1)):
            mine, ends = wires.wire(wire), links.ends(end)[:count]
            node = mine[np.abs(wires.points[mine, 0][:, None] - links.points[ends, 0]).argmin(axis=0)]
            compare(f"{link_path}: places on '{wire}'", links.points[ends], wires.points[node], 600)
            u = wires.fields["displacement"][node, 1]
            size += np.abs(u).max()
            stretch += sign * u
            compare(f"{link_path}: displacement", links.fields["displacement"][ends, 1], u, np.abs(u).max())
        value = links.fields["gap"][links.ends(0)[:count]] - stretch
        first = value if first is None else first
        compare(f"{link_path}: gap against the motion of the wires", value, first, 2 * size)


def check_contact(folder, speed, start):
    """Both ends of the pantograph's link stand where the contact is, on the contact wire."""
    for time, path in collection(folder / "fields/links.pvd"):
        grid = Grid(path)
        for end in grid.cells[-1]:
            compare(f"{path}: contact", grid.points[end], [start + speed * time, 0, 0], 600)


def check_cuts(folder, parts):
    """Lines of a cut wire: one after another, with all points of it, and each in its part."""
    grid = Grid(folder / "fields/wires_00000.vtu")
    lines = [cell for cell, name in zip(grid.cells, grid.names) if name == "contact"]
    if len(lines) < 2 or any(a[-1] != b[0] for a, b in zip(lines, lines[1:])):
        errors.append(f"{folder}: the contact wire is not cut into lines that hang together")
    if len(grid.wire("contact")) != 1201 or len(grid.wire("messenger")) != 1201:
        errors.append(f"{folder}: points of the cut wires are missing")
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(folder / "fields/wires_00000.vtu"))
    reader.Update()
    part = vtk_to_numpy(reader.GetOutput().GetCellData().GetArray("part"))
    if sorted(set(part)) != list(range(parts)):
        errors.append(f"{folder}: parts are {sorted(set(part))}")


def check_killed(name):
    """A run that is killed leaves collections that name complete files."""
    folder = arguments.results / f"{name}_killed"
    shutil.rmtree(folder, ignore_errors=True)
    command = [arguments.program, arguments.root / "prm" / f"{name}.prm", "--set", f"Output/Folder={folder}",
               "--set", "Output/Field interval=0.001"]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    while process.poll() is None and not (folder / "fields/links_00003.vtu").exists():
        time.sleep(0.001)
    process.kill()
    process.wait()
    frames = collection(folder / "fields/wires.pvd")
    for _, path in frames:
        Grid(path)
    if len(frames) < 3 or len(frames) > 6900:
        errors.append(f"{folder}: {len(frames)} frames of a killed run")


def check_order(folder):
    """statistics.json names links and probes in the order of the tables, which is that of the scene."""
    statistics = json.loads((folder / "statistics.json").read_text())
    for name, key, ending in (("links.csv", "links", " force [N]"), ("probes.csv", "probes", " [m]")):
        columns = [column[:-len(ending)] for column in table(folder / name) if column.endswith(ending)]
        if list(statistics[key]) != columns or len(columns) < 2:
            errors.append(f"{folder}: the {key} in statistics.json are not in the order of {name}")


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


def warped(path):
    """Places of the points of a field under ParaView's filter, and the lines between them."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    warp = vtkWarpVector()
    warp.SetInputConnection(reader.GetOutputPort())
    warp.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "displacement")
    warp.Update()
    grid = warp.GetOutput()
    places = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    pairs = []
    for i in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(i)
        edges = [cell.GetEdge(e) for e in range(cell.GetNumberOfEdges())] or [cell]
        for edge in edges:
            ids = [edge.GetPointId(k) for k in range(edge.GetNumberOfPoints())]
            pairs += zip(ids, ids[1:])
    return places, np.array(pairs, dtype=int).reshape(-1, 2)


def distance(at, lines):
    """Of a place from lines [n, 2, 3]."""
    along = lines[:, 1] - lines[:, 0]
    part = np.einsum("ij,ij->i", at - lines[:, 0], along) / np.maximum(np.einsum("ij,ij->i", along, along), 1e-300)
    return np.linalg.norm(lines[:, 0] + np.clip(part, 0, 1)[:, None] * along - at, axis=1).min()


def check_together(name, script, *settings):
    """One warp filter moves all fields to where they belong together: links end on the wires and bodies that they hold."""
    folder = run(name, *settings)
    results = load_plot(script).Results(str(folder))
    drawn = {results.name_of(path.stem[5:]): collection(path)[-1][1] for path in (folder / "fields").glob("body_*.pvd")}
    solids = [body for body in drawn if results.entries[f"Body {body}/Type"] == "solid"]
    lines = {body: (lambda places, pairs: places[pairs])(*warped(path)) for body, path in drawn.items()}
    if (folder / "fields/wires.pvd").exists():
        path = collection(folder / "fields/wires.pvd")[-1][1]
        places, _ = warped(path)
        grid = Grid(path)
        for cell, wire in zip(grid.cells, grid.names):
            lines[wire] = np.concatenate([lines.get(wire, np.empty((0, 2, 3))), np.stack([places[cell[:-1]], places[cell[1:]]], axis=1)])
    path = collection(folder / "fields/links.pvd")[-1][1]
    ends, _ = warped(path)
    extent = max(np.ptp(np.concatenate([line.reshape(-1, 3) for line in lines.values()]), axis=0))
    n_compared, moved = 0, np.abs(Grid(path).fields["displacement"]).max()
    grid = Grid(path)
    for cell, link in zip(grid.cells, grid.names):
        section = next(s for s in (f"Network/Link {link}", f"Network/Link {link.rpartition(' ')[0]}") if f"{s}/From" in results.entries)
        on = [results.entries[f"{section}/{end}"].partition("@")[0].strip() for end in ("From", "To")]
        for point, body in zip(cell, [body for body in on if body != "ground"] if len(cell) < 2 else on):
            if body in lines:
                n_compared += 1
                off = distance(ends[point], lines[body])
                # A place inside a solid, or a hole, is between its edges.
                between = np.linalg.norm(lines[body][:, 1] - lines[body][:, 0], axis=1).max() if body in solids else 0
                if not off <= max(2e-3 * extent, between):
                    errors.append(f"{name}: link '{link}' ends {off:.3g} m beside '{body}'")
    print(f"figure | {name}: ends of links on what they hold | {n_compared} {moved:.3g} m")
    if n_compared == 0:
        errors.append(f"{name}: no end of a link is compared")


def check_plot_reads(folder, script):
    """taut-plot reads the same of a cut wire as VTK does."""
    path = folder / "fields/wires_00000.vtu"
    points, displacement, wires, names = load_plot(script).read_vtu(path)
    grid = Grid(path)
    for number, name in names.items():
        mine = grid.wire(name)
        if list(wires[number]) != list(mine):
            errors.append(f"{path}: taut-plot reads {len(wires[number])} points of '{name}', VTK {len(mine)}")
    compare(f"{path}: points in taut-plot", points, grid.points, 0)
    compare(f"{path}: displacement in taut-plot", displacement, grid.fields["displacement"], 0)


def check_filter(folder, script):
    """The filtered statistics of statistics.json from sliding.csv."""
    plot = load_plot(script)
    statistics = json.loads((folder / "statistics.json").read_text())

    def said(*keys):
        return plot.statistic(statistics, "sliding contacts", "pantograph", *keys)

    series = table(folder / "sliding.csv")
    time, x, force = (series[c] for c in ("time [s]", "pantograph position [m]", "pantograph force [N]"))
    filtered = plot.low_pass(force, (time[-1] - time[0]) / (len(time) - 1), said("filter frequency"))
    inside = filtered[(x >= said("window")[0] - 1e-6) & (x <= said("window")[1] + 1e-6)]
    for name, value in (("mean", inside.mean()), ("standard deviation", inside.std()),
                        ("minimum", inside.min()), ("maximum", inside.max())):
        if abs(value - said("filtered", name)) > 1e-9 * abs(value):
            errors.append(f"filtered {name}: {value} is not {said('filtered', name)}")


class Report(html.parser.HTMLParser):
    """Cells of tables, texts, counts of elements and names of a report."""

    def __init__(self, text):
        super().__init__()
        self.cells, self.text, self.count, self.ids, self.is_cell = [], "", {}, [], False
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.count[tag] = self.count.get(tag, 0) + 1
        self.ids += [value for name, value in attrs if name == "id"]
        self.is_cell = tag == "td"

    def handle_endtag(self, tag):
        self.is_cell = False

    def handle_data(self, data):
        self.text += data
        if self.is_cell:
            self.cells.append(data)


def check_report(folder, script, cells, pictures):
    """One HTML file with these cells and at least so many pictures, and without references to anything else."""
    done = subprocess.run([sys.executable, script, folder, "--report"], capture_output=True, text=True)
    path = folder / "figures" / "report.html"
    if done.returncode != 0 or not path.exists():
        errors.append(f"report of {folder.name}: {done.returncode} {done.stderr}")
        return
    text = path.read_text(encoding="utf-8")
    report = Report(text)
    errors.extend(f"report of {folder.name}: no cell '{cell}'" for cell in cells if cell not in report.cells)
    errors.extend(f"report of {folder.name}: 'None' in '{cell}'" for cell in report.cells if "None" in cell)
    if report.count.get("svg", 0) < pictures or len(set(report.ids)) < len(report.ids):
        errors.append(f"report of {folder.name}: {report.count.get('svg', 0)} pictures, names of parts are used twice")
    if re.search(r"https?:|src=|<link|<script", text):
        errors.append(f"report of {folder.name}: refers to other files")


def check_partial(whole, script):
    """taut-plot draws what a killed run has written, whole lines only, and says until when."""
    folder = whole.parent / "partial"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(whole, folder, ignore=shutil.ignore_patterns("pictures"))
    (folder / "statistics.json").unlink()
    for name in ("sliding.csv", "links.csv"):
        path = folder / name
        text = path.read_text()
        path.write_text(text[:text.rstrip().rfind("\n") + 9])  # a line that was being written
    command = [sys.executable, script, folder, "--output", folder / "pictures", "--format", "png"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0 or "not complete: pictures until t = " not in done.stdout:
        errors.append(f"taut-plot of a killed run: {done.returncode}, {done.stdout}{done.stderr}")
    for name in ("contact_force", "probes", "link_forces", "displacement_map"):
        if not (folder / "pictures" / f"{name}.png").exists():
            errors.append(f"no {name} of a killed run")


def check_binary(name, script):
    """taut-plot reads binary tables as those in text, without a last line that a killed run left unfinished."""
    plot = load_plot(script)
    of_kind = []
    for kind in ("csv", "binary"):
        folder = run(name, "Time/End=0.2", "Statistics/Window=", f"Output/Tables={kind}")
        for path in folder.glob("*.bin"):
            with open(path, "ab") as file:
                file.write(b"12345")
        results = plot.Results(str(folder))
        of_kind.append({name: results.table(name) for name in ("sliding.csv", "links.csv", "probes.csv", "certificate.csv")})
    text, binary = of_kind
    for name, one in text.items():
        other = binary[name]
        if not one or not other or list(one.columns) != list(other.columns) or len(one) != len(other):
            errors.append(f"{name} is not the same table in binary")
            continue
        compare(f"{name} in binary", other.time, one.time, 0)
        for header in list(one.columns)[1:]:
            if not np.array_equal(other.columns[header], one.columns[header]):
                errors.append(f"{name} in binary: other numbers of {header}")


def check_intervals(folder, script):
    """A peak and an opening between two lines of links.csv are drawn where their columns are there; statistics.json is read
    with units in its keys and with units beside its values."""
    plot = load_plot(script)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "used.prm").write_text("set Generator = network # default: catenary\n")
    (folder / "certificate.csv").write_text("time [s]\n0\n")
    (folder / "links.csv").write_text(
        "time [s],buffer force [N],buffer force least [N],buffer force largest [N],buffer gap [m],buffer gap least [m],"
        "buffer gap largest [m],buffer changes [1],rope force [N],rope gap [m]\n"
        "0,0,0,0,1,1,1,0,5,-1\n1,0,0,258,0.5,-0.1,1,2,0,2\n2,7,6,8,-0.1,-0.1,-0.1,1,3,-1\n")
    _, links = plot.fixed_links(plot.Results(str(folder)))
    found = [(link.name, list(link.largest), list(link.least), link.has_band, list(link.is_open)) for link in links]
    if found != [("buffer", [0, 258, 8], [0, 0, 6], True, [True, True, False]),
                 ("rope", [5, 0, 3], [5, 0, 3], False, [False, True, False])]:
        errors.append(f"taut-plot reads {found}")
    for tree in ({"sliding contacts": {"a b": {"filter frequency [Hz]": 20}}},
                 {"sliding_contacts": {"a b": {"filter_frequency": {"value": 20, "unit": "Hz"}}}},
                 {"sliding_contacts": [{"name": "a b", "filter_frequency": {"value": 20, "unit": "Hz"}}]}):
        if plot.statistic(tree, "sliding contacts", "a b", "filter frequency") != 20:
            errors.append(f"taut-plot does not read {tree}")


plot_script = arguments.root / "source" / "plot" / "taut-plot"

results = run("en50318_2002_250", "Time/End=0.2", "Output/Field interval=0.05", "Statistics/Window=61,72",
              "Statistics/Supply=AC", "Catenary/Uplift positions=72, 240, 300, 360")  # only the first one moves so early
compare("times of the fields", check_links(results), [0, 0.05, 0.1, 0.15, 0.2], 1)
check_probes(results, {f"contact wire at {x} m": ("contact", x, 0, (0, 1, 0)) for x in (240, 300, 360)})
check_droppers(results)
check_contact(results, 250 / 3.6, 60)
check_order(results)
check_killed("en50318_2002_250")
check_filter(results, plot_script)
said = json.loads((results / "statistics.json").read_text())["sliding_contacts"]["pantograph"]["filtered"]
check_report(results, plot_script, ["pantograph", "dropper 1.1", f"{said['mean']['value']:.4g} N", "mean force F_m",
                                     f"{said['mean']['value']:.1f} N", "links that went slack"], 6)
check_partial(results, plot_script)
check_intervals(arguments.results / "intervals", plot_script)
check_pictures(results, ["contact_force", "probes", "link_forces", "link_map", "displacement_map"], plot_script)
check_binary("en50318_2002_250_two", plot_script)
# The long form of links.csv says the same, a line for each link.
long = run("inclined_cable", "Time/End=1", "Output/Tables=long", "Output/Link interval=0.05")
short = run("inclined_cable_wide", "Time/End=1", "Output/Link interval=0.05", scene="inclined_cable")
tables = [load_plot(plot_script).Results(str(folder)).table("links.csv") for folder in (long, short)]
for head, column in tables[1].columns.items():
    compare(f"long table: {head}", tables[0].columns.get(head, np.nan), column, 0)
if (long / "links.csv").read_text().splitlines()[0].count(",") != 8:
    errors.append("the long table has other columns")

results = run("en50318_2002_300", "Time/End=0", "Output/Field interval=1", "Partition/Number of substructures=3")
check_cuts(results, 3)
check_plot_reads(results, plot_script)

if (arguments.results / "en50318_2002_250" / "pictures" / "plan_and_elevation.png").exists():
    errors.append("a line in the plane is drawn in space")

# The contact wire is at its steady arms.
results = run("en50318_in_space", "Time/End=0.1", "Output/Field interval=0.05", "Statistics/Window=61,66")
check_links(results)
check_pictures(results, ["contact_force", "plan_and_elevation"], plot_script)
first = Grid(results / "fields/wires_00000.vtu")
contact = first.wire("contact")
places = first.points[contact] + first.fields["displacement"][contact]
compare("stagger", [places[np.argmin(np.abs(places[:, 0] - x)), 2] for x in (240, 300, 600)], [0.2, -0.2, 0.2], 1)

results = run("inclined_cable", "Time/End=2", "Output/Field interval=0.1")
check_links(results)
check_probes(results, {"tip": ("beam", 3, 0, (0, 1, 0))})
check_pictures(results, ["probes", "link_forces", "displacement_map"], plot_script)
forces = []
for (_, wire_path), (_, link_path) in zip(collection(results / "fields/wires.pvd"), collection(results / "fields/links.pvd")):
    tip = Grid(wire_path).fields["displacement"][-1]
    link = Grid(link_path).fields
    compare(f"{link_path}: slack of the cable", link["gap"][0], -(tip @ (0.6, -0.8, 0)), np.abs(tip).max())
    forces.append(link["force"][0])
if not (max(forces) > 45 and min(forces) == 0):
    errors.append("the cable neither pulls nor goes slack")

results = run("oscillator_with_stop", "Time/End=0.3", "Output/Field interval=0.01")
check_links(results)
check_pictures(results, ["probes", "link_forces"], plot_script)
if (results / "pictures" / "displacement_map.png").exists():
    errors.append("a displacement map of masses without a wire")

# The start of the mast is a hand calculation: force, stretch, slack.
results = run("guyed_mast", "Time/End=0")
with open(results / "start.csv", newline="", encoding="utf-8") as start_file:
    start = [[float(line[key]) for key in ("force [N or N m]", "gap [m or rad]")] for line in csv.DictReader(start_file)]
pull = 50 * 10**2 / (2 * 0.6 * 8)
links = json.loads((results / "statistics.json").read_text())["links"]
compare("guyed mast in statistics.json", [[links[name][key]["value"] for key in ("force", "gap")] for name in ("left guy", "right guy")],
        start, 0)
compare("guyed mast", start, [[pull, -pull / 1e5], [0, pull * (1 / 1e5 + 2 * 0.8**2 * 8 / 1e7)]], 0.01)
check_pictures(results, ["static_links"], plot_script)

for scene, end in (("bar_on_two_cables", 1), ("bracket_and_cables", 1), ("cable_in_wind", 0), ("line_of_cables", 0.2),
                   ("line_of_cables_with_weights", 0.1), ("line_with_droppers", 0.5), ("net_of_cables", 0), ("pendulum_cable", 1),
                   ("snap_load", 0.08), ("swinging_load_on_guys", 0.5)):
    check_together(scene, plot_script, "Output/Field interval=0.1", "Time/Check steps=no", f"Time/End={end}")

# The pictures of a solid, and the pressure that is drawn.
results = run("hertz_cylinder")
check_report(results, plot_script, ["plate"], 2)
check_pictures(results, ["contact_pressure", "stress"], plot_script)
plot = load_plot(plot_script)
(_, _, contact), = plot.last_fields(plot.Results(str(results)), "contact")
with open(results / "contact_plate.csv", newline="", encoding="utf-8") as table:
    said = float(list(csv.DictReader(table))[-1]["largest pressure [Pa]"])
compare("Hertz: largest pressure", [contact["pressure"].max()], [said], said)

# Blocks under 1 MPa: the stresses of a uniform state, by hand, at every node of both of them.
for state, across in (("strain", -3e5), ("stress", 0)):
    results = run("block_on_block", f"Body upper/Plane state={state}", f"Body lower/Plane state={state}")
    said = json.loads((results / "statistics.json").read_text())["contacts"]["joint"]
    compare("force of a contact at rest", said["force"]["value"], (0, 1e6, 0), 1e6)
    compare("contact at rest", [said[key]["value"] for key in ("area", "largest_pressure", "closed")], (1, 1e6, said["nodes"]["value"]), 1e6)
    principal = sorted((0, across, -1e6), reverse=True)
    expected = {"stress_in_plane": (0, 0, 0, 0, -1e6, 0, 0, 0, 0), "stress_zz": across,
                **{f"principal_stress_{i + 1}": value for i, value in enumerate(principal)},
                "von_mises_stress": np.sqrt(1e12 + across**2 + across * 1e6)}
    for body in ("lower", "upper"):
        (_, path), = collection(results / f"fields/body_{body}.pvd")
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(path))
        reader.Update()
        for name, value in expected.items():
            found = vtk_to_numpy(reader.GetOutput().GetPointData().GetArray(name))
            compare(f"plane {state}, {body} block: {name}", found, np.broadcast_to(value, found.shape), 1e6)

finish()
