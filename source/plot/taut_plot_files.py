# SPDX-License-Identifier: LGPL-2.1-or-later
"""What taut writes, read for pictures: tables, statistics, entries, fields, studies."""

import csv
import json
import os
import re
import struct
import xml.etree.ElementTree as xml

import numpy as np


class UserError(Exception):
    """What a user can mend, said in one line."""


def wide(header, lines):
    """Header and values with columns for each item, of a table with a line for each item and time."""
    names = list(dict.fromkeys(line[1] for line in lines))
    lines = lines[:len(lines) - len(lines) % max(1, len(names))]
    heads = [head.replace("[N or N m]", "[N]").replace("[m or rad]", "[m]") for head in header[2:]]
    values = np.array([[float(cell) for cell in line[2:]] for line in lines]).reshape(-1, len(names) * len(heads))
    times = np.array([float(line[0]) for line in lines[::max(1, len(names))]]).reshape(-1, 1)
    return ["time [s]", *(f"{name} {head}" for name in names for head in heads)], np.hstack([times, values])


class Table:
    """A table of taut, .csv or .bin: its columns by header, in order. A last line that a killed run left unfinished is
    dropped."""

    def __init__(self, path):
        try:
            with open(path, "rb") as file:
                names, _, data = file.read().partition(b"\n")
            text = "" if path.endswith(".bin") else data[:data.rfind(b"\n") + 1].decode()
            header = (list(csv.reader([names.decode()])) or [[]])[0]
        except (OSError, UnicodeDecodeError) as error:
            raise UserError(f"cannot read '{path}': {error}") from error
        try:
            if path.endswith(".bin"):
                values = np.frombuffer(data[:len(data) - len(data) % (8 * len(header))])
            elif header[1:2] == ["name"]:
                header, values = wide(header, list(csv.reader(text.splitlines())))
            else:
                values = np.array([[float(cell) for cell in line] for line in csv.reader(text.splitlines())])
            values = values.reshape(-1, len(header))
        except (ValueError, TypeError) as error:
            raise UserError(f"'{path}' is damaged: {error}") from error
        self.columns = dict(zip(header, values.T))
        self.time = values[:, 0]

    def __len__(self):
        return len(self.time)

    def series(self, *endings):
        """(name, column, column...) of the items that have a column with each of the endings."""
        for header, column in self.columns.items():
            if header.endswith(endings[0]):
                name = header[:-len(endings[0])]
                yield (name, column, *(self.columns[name + other] for other in endings[1:]))


def plain(key):
    """A key of statistics.json without its unit: 'filter frequency [Hz]' and 'filter_frequency' are the same."""
    return re.sub(r"\s*\[.*", "", key).strip().lower().replace(" ", "_")


def statistic(tree, *keys):
    """The value behind these keys of statistics.json, whether it stands alone or beside its unit; None if there is none."""
    for key in keys:
        if isinstance(tree, list):
            tree = {str(item.get("name")): item for item in tree}
        tree = {plain(k): v for k, v in tree.items()}.get(plain(key)) if isinstance(tree, dict) else None
    return tree["value"] if isinstance(tree, dict) and "value" in tree else tree


def read_entries(path):
    """{path of the entry: value} of a parameter file as taut writes it."""
    entries, sections = {}, []
    with open(path, encoding="utf-8") as file:
        for line in file:
            word, _, rest = line.partition("#")[0].strip().partition(" ")
            if word == "subsection":
                sections.append(rest.strip())
            elif word == "end" and sections:
                sections.pop()
            elif word == "set":
                name, _, value = rest.partition("=")
                entries["/".join([*sections, name.strip()])] = value.strip()
    return entries


def read_units(path):
    """{path of the entry: unit} of a parameter file as taut writes it: what stands in brackets at the end of the help."""
    units, sections, helped = {}, [], ""
    with open(path, encoding="utf-8") as file:
        for line in map(str.strip, file):
            word, _, rest = line.partition(" ")
            if line.startswith("#"):
                helped += line
                continue
            found = re.search(r"\[([^]]*)\]\s*$", helped)
            if word == "set" and found:
                units["/".join([*sections, rest.partition("=")[0].strip()])] = found[1]
            elif word == "subsection":
                sections.append(rest.strip())
            elif word == "end" and sections:
                sections.pop()
            helped = ""
    return units


def numbers(text):
    """Numbers and ranges first:step:last with commas between them; none if there are names in it."""
    values = []
    try:
        for part in filter(None, text.split(",")):
            ends = [float(number) for number in part.split(":")]
            values += np.arange(ends[0], ends[2] + 1e-9 * abs(ends[1]), ends[1]).tolist() if len(ends) == 3 else ends
    except (ValueError, ZeroDivisionError):
        return []
    return values


class Results:
    """A results folder; of a run that ended early what there is."""

    def __init__(self, folder):
        self.folder = folder
        if not os.path.isdir(folder):
            raise UserError(f"there is no folder '{folder}'")
        if not self.has("used.prm"):
            raise UserError(f"'{folder}' holds no results of taut: there is no used.prm in it")
        self.entries = read_entries(self.path("used.prm"))
        # A run at rest writes no certificate of steps.
        self.is_static = not (self.has("certificate.csv") or self.has("certificate.bin")) and \
            (self.has("start.csv") or numbers(self.entries.get("Time/End", "")) == [0.0])
        self.statistics = {}
        if self.has("statistics.json"):
            try:
                with open(self.path("statistics.json"), encoding="utf-8") as file:
                    self.statistics = json.load(file)
            except ValueError as error:
                raise UserError(f"'{self.path('statistics.json')}' is damaged: {error}") from error
        self.is_partial = not self.is_static and (not self.statistics or bool(statistic(self.statistics, "partial")))

    def path(self, name):
        return os.path.join(self.folder, name)

    def name_of(self, stem):
        """The body or contact whose files have this name: what is no letter, digit or hyphen is an underscore in it."""
        listed = ",".join(self.entries.get(entry, "") for entry in ("Bodies", "Contacts")).split(",")
        return next((name.strip() for name in listed if re.sub(r"[^A-Za-z0-9\x80-\U0010ffff-]", "_", name.strip()) == stem), stem)

    def has(self, name):
        return os.path.exists(self.path(name))

    def table(self, name):
        """The table, .csv or .bin, or None where there is no such file or no line in it yet."""
        found = [file for file in (name, name.replace(".csv", ".bin")) if self.has(file)]
        table = Table(self.path(found[0])) if found else None
        return table if table else None

    def end(self):
        """Time of the last step [s], or None."""
        until = statistic(self.statistics, "until")
        if until is None:
            tables = [self.table(name) for name in ("certificate.csv", "probes.csv", "sliding.csv")]
            until = max((table.time[-1] for table in tables if table), default=None)
        return until

    def start(self):
        """The links at the start: lines of start.csv."""
        if not self.has("start.csv"):
            return []
        with open(self.path("start.csv"), newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def sliding(self):
        """Names of the sliding contacts."""
        table = self.table("sliding.csv")
        return [name for name, _ in table.series(" force [N]")] if table else []

    def points(self):
        """{link: [x, y, z]} [m] at the start, sliding contacts too."""
        try:
            return {line["link"]: [float(line[f"{axis} [m]"]) for axis in "xyz"] for line in self.start()}
        except (KeyError, TypeError, ValueError) as error:
            raise UserError(f"'{self.path('start.csv')}' is damaged: {error!r}") from error

    def places(self):
        """{link: x [m]} at the start."""
        return {name: point[0] for name, point in self.points().items()}

    def links(self, wire=None):
        """What the links hang at, and x [m] of each, of all wires or of the tension length of one; without sliding contacts
        and stops."""
        is_line = self.entries.get("Generator") == "catenary"
        part = self.tension_lengths(wire)
        part = f" {part[0]} " if is_line and len(part) == 1 and part[0] else ""
        kinds = tuple(kind + part for kind in ("dropper", "twin dropper", "stitch clamp"))
        moving = set(self.sliding())
        places = sorted({x for name, x in self.places().items() if name not in moving and "bump stop" not in name and
                         (not is_line or name.startswith(kinds))})
        return "droppers" if is_line else "links", places

    def is_dropper(self, name):
        """Whether a link is a dropper; a link of a network may stand for several, with a number behind its name."""
        if self.entries.get("Generator") == "catenary":
            return name.startswith("dropper")
        return any(self.entries.get(f"Network/Link {one}/Type") == "dropper" for one in (name, name.rpartition(" ")[0]))

    def tension_lengths(self, wire=None):
        """Names of the tension lengths of a line, or of that with the wire; '' is the name of the only one."""
        names = [name.strip() for name in self.entries.get("Catenary/Tension lengths", "").split(",")]
        return [name for name in names if not (name and wire) or
                re.match(rf"(twin )?(contact|messenger|stitch) {re.escape(name)}( |$)", wire)]

    def masts(self, wire=None):
        """x [m] of the masts and ends of a line, or of the tension length with the wire."""
        places = set()
        for name in self.tension_lengths(wire):
            section = f"Catenary/Tension length {name}/" if name else "Catenary/"
            table = self.entries.get(f"{section}Line")
            begin, n, length = (numbers(self.entries.get(section + entry, default)) for entry, default in
                                (("Begin", "0"), ("Number of spans", "10"), ("Span length", "60")))
            spans = self.spans_of(table) if table else numbers(self.entries.get(f"{section}Span lengths", "")) or int(n[0]) * length
            places |= set(np.cumsum([begin[0], *spans]).tolist() if spans else [])
        return sorted(places)

    def spans_of(self, table):
        """Lengths [m] in a table of a line, of which the results have a copy; none if it is not there."""
        inside = not os.path.isabs(table) and ".." not in table.split("/")
        path = self.path(table if inside else os.path.basename(table))
        try:
            with open(path, encoding="utf-8-sig") as file:
                lines = [line.strip() for line in file if line.strip() and not line.strip().startswith("#")]
            semicolons = ";" in lines[0]
            heads, *rows = csv.reader(lines, delimiter=";" if semicolons else ",", skipinitialspace=True)
            cells = [row[[head.strip() for head in heads].index("span")].strip() for row in rows]
            return [float(cell.replace(",", ".") if semicolons else cell) for cell in cells if cell]
        except (OSError, IndexError, ValueError):
            return []

    def supports(self, wire=None):
        """What holds the wires, and x [m] of each: masts of a line, otherwise supports of the wire, or of all wires,
        that are horizontal."""
        entries = self.entries
        if entries.get("Generator") == "catenary":
            return "masts", self.masts(wire)
        places = set()
        for name in entries.get("Network/Supports", "").split(","):
            section = f"Network/Support {name.strip()}"
            on = entries.get(f"{section}/Wire", "")
            ends = [numbers(entries.get(f"Network/Wire {on}/{end}", "")) for end in ("From", "To")]
            if wire in (None, on) and all(len(end) >= 2 for end in ends) and ends[0][1:] == ends[1][1:]:
                way = 1 if ends[1][0] > ends[0][0] else -1
                places |= {ends[0][0] + way * at for at in numbers(entries.get(f"{section}/Positions", ""))}
        return "supports", sorted(places)


def read_lines(path):
    """Root, arrays and the lines, lists of points, of a VTU file of taut."""
    types = {"Float32": "<f4", "Int32": "<i4", "UInt8": "u1"}
    mark = b'<AppendedData encoding="raw">\n_'
    with open(path, "rb") as file:
        head, _, data = file.read().partition(mark)
    root = xml.fromstring(head + b"</VTKFile>")
    arrays = {}
    for node in root.iter("DataArray"):
        at, kind = int(node.get("offset")), node.get("type")
        size, = struct.unpack("<Q", data[at:at + 8])
        values = np.frombuffer(data[at + 8:at + 8 + size], types[kind])
        n = int(node.get("NumberOfComponents"))
        arrays[node.get("Name")] = values.reshape(-1, n) if n > 1 else values
    return root, arrays, np.split(arrays["connectivity"], arrays["offsets"][:-1])


DAMAGED = (OSError, xml.ParseError, AttributeError, KeyError, TypeError, ValueError, struct.error)


def read_vtu(path):
    """Points [n, 3], displacement [n, 3] and the lines of wires.vtu, {wire: its points in order}, with their names."""
    try:
        root, arrays, lines = read_lines(path)
        wires = {}
        for number, line in zip(arrays["wire"], lines):
            # A piece begins with the last point of the one before it.
            points = wires.setdefault(int(number), [])
            points.extend(line[1:] if points else line)
        names = dict(zip(arrays["wire"].tolist(), texts(root.find(".//CellData/Array"))))
        return arrays["positions"].astype(float), arrays["displacement"].astype(float), wires, names
    except DAMAGED as error:
        raise UserError(f"cannot read '{path}': {error}") from error


def read_links(path, without=()):
    """The ends of each link of links.vtu where they are, [n, 3] a link, but those of these names."""
    try:
        root, arrays, lines = read_lines(path)
        now = arrays["positions"].astype(float) + arrays["displacement"].astype(float)
        return [now[line] for line, name in zip(lines, texts(root.find(".//CellData/Array")))
                if len(line) > 1 and name not in without]
    except DAMAGED as error:
        raise UserError(f"cannot read '{path}': {error}") from error


def texts(node):
    """The texts of an array of strings: the numbers of their bytes, each text ended by a zero."""
    return bytes(int(code) for code in node.text.split()).decode().split("\0")[:-1]


def read_collection(path):
    """[(time, file)] of a PVD file."""
    try:
        nodes = xml.parse(path).getroot().iter("DataSet")
        return [(float(n.get("timestep")), os.path.join(os.path.dirname(path), n.get("file"))) for n in nodes]
    except (OSError, xml.ParseError, TypeError, ValueError) as error:
        raise UserError(f"cannot read '{path}': {error}") from error


def low_pass(record, step, frequency):
    """Third-order Butterworth forwards and backwards, -3 dB in total at the frequency; ends continued by point
    reflection, as taut does it."""
    if len(record) < 2:
        return record
    cutoff = frequency / (2 ** 0.5 - 1) ** (1 / 6)
    w = np.tan(min(np.pi * cutoff * step, 0.499 * np.pi))
    first, second = 1 / (1 + w), 1 / (1 + w + w * w)
    sections = [((w * first, w * first, 0.0), ((w - 1) * first, 0.0)),
                ((w * w * second, 2 * w * w * second, w * w * second),
                 (2 * (w * w - 1) * second, (1 - w + w * w) * second))]
    n = len(record)
    pad = min(n - 1, int(np.ceil(3 / (frequency * step))))
    head, tail = 2 * record[0] - record[pad:0:-1], 2 * record[-1] - record[::-1][1:pad + 1]
    x = np.concatenate([head, record, tail]).tolist()
    for _ in range(2):
        for (b0, b1, b2), (a1, a2) in sections:
            x1 = x2 = y1 = y2 = x[0]
            for i, x0 in enumerate(x):
                y0 = b0 * x0 + b1 * x1 + b2 * x2 - a1 * y1 - a2 * y2
                x[i] = y0
                x2, x1, y2, y1 = x1, x0, y1, y0
        x.reverse()
    return np.array(x[pad:pad + n])


def read_study(folder):
    """The parameter lists and settings of a study: dictionaries of work_precision.csv, with those that failed left out."""
    try:
        with open(os.path.join(folder, "study.json"), encoding="utf-8") as file:
            study = json.load(file)
        with open(os.path.join(folder, "work_precision.csv"), newline="", encoding="utf-8") as file:
            lines = [line for line in csv.DictReader(file) if not line["message"]]
        numbers = ("error [1]", "error of finer ones too [1]", "error of the reference [1]", "seconds", "x real time", "front")
        settings = [{**line, **{name: float(line[name]) for name in numbers}} for line in lines]
        return study["parameters"], settings, study["end [s]"]
    except OSError as error:
        raise UserError(f"'{folder}' holds no whole study: {error}") from error
    except (KeyError, TypeError, ValueError) as error:
        raise UserError(f"the study in '{folder}' is damaged: {error!r}") from error
