#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sweeps: each line has the quantities of a run of its own, though the cases share what they have in common; the table is the same, byte for byte, for 1, 2 and 4 workers,
and when the sweep is killed and resumed; a case that fails is a line; mistakes are one line of error each."""
import csv
import json
import os
import pathlib
import random
import signal
import statistics
import subprocess
import sys
import tempfile
import time

sys.path.append(str(pathlib.Path(__file__).parents[1]))
from checks import entries, errors, expect, finish, on_ranks, parse

arguments = parse(__doc__, "program", "mpiexec", "prm", "plot")
# taut-plot needs matplotlib; there may be another Python before Debian's own.
PYTHON = next((python for python in (sys.executable, "/usr/bin/python3")
               if subprocess.run([python, "-c", "import matplotlib"], capture_output=True).returncode == 0), sys.executable)
SCENE = (arguments.prm / "oscillator_with_stop.prm").read_text()
MASS, STIFFNESS, STEP = "Network/Mass mass/Mass", "Network/Spring spring/Stiffness", "Time/Step"
MASS_HEAD, STIFFNESS_HEAD = "mass [kg]", "k [N/m, N m/rad]"  # parameters named mass and k, with the units of the entries


def scene(folder, name, parameters, **entries):
    """The scene with a section Sweep; parameters: name -> entries of its section."""
    lines = ["subsection Sweep", f"  set Parameters = {', '.join(parameters)}"]
    lines += [f"  set {key} = {value}" for key, value in entries.items()]
    for parameter, own in parameters.items():
        lines += [f"  subsection Parameter {parameter}", *(f"    set {key} = {value}" for key, value in own.items()), "  end"]
    (folder / name).write_text(SCENE + "\n" + "\n".join(lines) + "\nend\n")
    return name


def taut(folder, *options, ranks=1):
    command = on_ranks(arguments.mpiexec, ranks, [arguments.program, *options])
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=1800)


def sweep(folder, name, to, *options, ranks=1):
    result = taut(folder, name, "--sweep", "--set", f"Sweep/Folder={to}", *options, ranks=ranks)
    expect(f"{name} {options} on {ranks}: runs", result.returncode == 0, result.stderr)
    table = folder / to / "sweep.csv"
    return table.read_bytes() if table.exists() else b""


def rows(data):
    return list(csv.DictReader(data.decode().splitlines()))


def check_values(folder):
    mass = {"Entries": MASS, "Values": "1, 2:1:4"}
    stiffness = {"Entries": STIFFNESS, "Values": "100; 150; 200; 250"}
    name = scene(folder, "product.prm", {"mass": mass, "k": stiffness})
    found = [(float(row[MASS_HEAD]), float(row[STIFFNESS_HEAD])) for row in rows(sweep(folder, name, "product"))]
    expect("product", found == [(m, k) for k in (100, 150, 200, 250) for m in (1, 2, 3, 4)], found)
    name = scene(folder, "zipped.prm", {"mass": mass, "k": stiffness}, Combination="zipped")
    table = rows(sweep(folder, name, "zipped"))
    found = [(float(row[MASS_HEAD]), float(row[STIFFNESS_HEAD])) for row in table]
    expect("zipped", found == [(1, 100), (2, 150), (3, 200), (4, 250)], found)

    # A run of its own has the same numbers.
    row = table[2]
    taut(folder, name, "--set", f"{MASS}={row[MASS_HEAD]}", "--set", f"{STIFFNESS}={row[STIFFNESS_HEAD]}", "--set", "Output/Folder=alone")
    alone = json.loads((folder / "alone" / "statistics.json").read_text())
    text = json.dumps(alone)
    numbers = [(title, value) for title, value in row.items() if ": largest force" in title or ": largest impulse" in title]
    expect("quantities are there", len(numbers) >= 2, row)
    for title, value in numbers:
        expect(f"{title} of a run of its own", value in text, text)


def check_random(folder):
    name = scene(folder, "random.prm",
                 {"mass": {"Entries": MASS, "Distribution": "uniform", "Range": "1, 3"},
                  "k": {"Entries": STIFFNESS, "Distribution": "normal", "Range": "200, 10"},
                  "step": {"Entries": STEP, "Values": "1e-3, 2e-3"}}, Samples=100)
    first = sweep(folder, name, "random", ranks=2)
    table = rows(first)
    if len(table) != 200:
        return expect("samples", False, (len(table), errors))
    mass, k = [float(row[MASS_HEAD]) for row in table], [float(row[STIFFNESS_HEAD]) for row in table]
    expect("samples", len(table) == 200 and len(set(mass)) == 200, len(table))
    # Four standard errors.
    expect("uniform", 1 <= min(mass) and max(mass) <= 3 and abs(statistics.mean(mass) - 2) < 4 * 0.577 / 200**0.5,
           statistics.mean(mass))
    expect("normal", abs(statistics.mean(k) - 200) < 4 * 10 / 200**0.5 and abs(statistics.stdev(k) - 10) < 4 * 10 / 400**0.5,
           (statistics.mean(k), statistics.stdev(k)))
    expect("the seed is printed", "seed 7" in taut(folder, name, "--sweep", "--set", "Sweep/Folder=seed", "--set", "Sweep/Seed=7",
                                                  "--set", "Sweep/Samples=2").stdout)
    other = rows((folder / "seed" / "sweep.csv").read_bytes())
    expect("another seed, other numbers", other[0][MASS_HEAD] != table[0][MASS_HEAD])
    for ranks in (1, 4):
        expect(f"{ranks} workers", sweep(folder, name, f"random_{ranks}", ranks=ranks) == first)
    environment = dict(os.environ, PATH=f"{pathlib.Path(arguments.mpiexec).parent}:{os.environ['PATH']}")
    result = subprocess.run([arguments.program, name, "--sweep", "-j", "2", "--set", "Sweep/Folder=jobs"], cwd=folder,
                            capture_output=True, text=True, timeout=1800, env=environment)
    expect("--jobs", "on 2 workers" in result.stdout and (folder / "jobs" / "sweep.csv").read_bytes() == first,
           result.stdout + result.stderr)
    check_killed(folder, name, first)


def check_killed(folder, name, reference):
    rng = random.Random(1)
    n_kills = 0
    for run in range(3):
        to, options = f"killed_{run}", []
        for _ in range(4):
            process = subprocess.Popen([arguments.program, name, "--sweep", "--set", f"Sweep/Folder={to}", *options], cwd=folder,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            # By what it has done, not by the clock: a fast machine ends within any time, a slow one does nothing in it.
            table, grown = folder / to / "sweep.csv", 0
            size = table.stat().st_size if table.exists() else 0
            until = rng.randint(1, 3)
            while grown < until and process.poll() is None:
                now = table.stat().st_size if table.exists() else 0
                grown, size = grown + (now > size), max(now, size)
                time.sleep(0.001)
            time.sleep(rng.uniform(0, 0.02))
            n_kills += process.poll() is None
            process.kill()
            process.wait()
            options = ["--resume"]
        found = sweep(folder, name, to, "--resume")
        expect(f"killed and resumed, run {run}", found == reference)
    expect("sweeps are killed before their end", n_kills > 6, n_kills)

    process = subprocess.Popen([arguments.program, name, "--sweep", "--set", "Sweep/Folder=signal", "--set", "Time/End=50"], cwd=folder, stderr=subprocess.PIPE, text=True,
                               stdout=subprocess.DEVNULL)
    while not (folder / "signal" / "sweep.csv").exists() and process.poll() is None:
        time.sleep(0.01)
    time.sleep(0.3)
    process.send_signal(signal.SIGINT)
    said = process.communicate(timeout=1800)[1]
    expect("SIGINT", process.returncode == 130 and "sweep ended by SIGINT with" in said and "--sweep --resume" in said, said)


def numbers_in(node):
    """All numbers of a JSON document."""
    if isinstance(node, (dict, list)):
        return {number for child in (node.values() if isinstance(node, dict) else node) for number in numbers_in(child)}
    return {float(node)} if isinstance(node, (int, float)) and not isinstance(node, bool) else set()


def check_sharing(folder):
    """The sweep over pantographs, in short: on any number of workers the same bytes, and in each line the numbers of a run of
    its own, to the last bit, though line, wires and parameters are made once."""
    short = entries("Time/End=0.4", "Statistics/Window=65, 80", "Sweep/Samples=7", "Catenary/Uplift positions=80",
                                "Output/Folder=short")
    name = str((arguments.prm / "en50318_2002_sweep.prm").resolve())
    first = sweep(folder, name, "on_1", *short)
    for ranks in (2, 4):
        expect(f"pantographs on {ranks} workers", sweep(folder, name, f"on_{ranks}", *short, ranks=ranks) == first)
    table = rows(first)
    heads = {head.partition(" [")[0]: head for head in table[0] if ": " not in head}
    expect("pantographs", len(table) == 7 and len({row[heads["masses"]] for row in table}) == 7, first[:500])
    names = {"masses": "Masses", "stiffnesses": "Stiffnesses", "dampings": "Dampings", "speed": "Speed"}
    for row in (table[0], table[4], table[6]):
        values = entries(*(f"Catenary/Pantograph pantograph/{entry}={row[heads[column]]}" for column, entry in names.items()))
        result = taut(folder, name, *short, *values, "--overwrite")
        expect("a pantograph alone", result.returncode == 0, result.stderr)
        alone = numbers_in(json.loads((folder / "short" / "statistics.json").read_text()))
        titles = [title for title in row if ": " in title]
        expect("quantities of a pantograph", len(titles) > 400, len(titles))
        # Times are rounded there.
        missing = [title for title in titles if not title.endswith("time [s]") and row[title] != "nan" and float(row[title]) not in alone]
        expect("numbers of a run alone", not missing, missing[:5])
        expect("certified", max(float(row["complementarity [1]"]), float(row["balance [1]"])) < 1e-10 and not row["message"], row)


def check_pictures(folder):
    """Curves over one entry, a map over two, percentiles of a sample."""
    mass = {"Entries": MASS, "Values": "1:0.5:3"}
    stiffness = {"Entries": STIFFNESS, "Values": "400:200:1000"}
    sample = {"Entries": STIFFNESS, "Distribution": "uniform", "Range": "400, 1000"}
    for name, parameters, options in (("curves", {"k": stiffness}, {}), ("map", {"mass": mass, "k": stiffness}, {}),
                                      ("sample", {"k": sample}, {"Samples": 20})):
        sweep(folder, scene(folder, f"{name}.prm", parameters, **options), name)
        result = subprocess.run([PYTHON, arguments.plot, name, "--format", "png"], cwd=folder, capture_output=True, text=True)
        picture = folder / name / "figures" / "sweep.png"
        expect(f"picture of the {name}", result.returncode == 0 and picture.exists() and picture.stat().st_size > 10000,
               result.stdout + result.stderr)
    result = subprocess.run([PYTHON, arguments.plot, "map", "--quantity", "nothing"], cwd=folder, capture_output=True, text=True)
    expect("no such quantity", result.returncode == 1 and result.stderr.startswith("taut-plot: --quantity nothing"), result.stderr)


def check_files(folder):
    """Files that only cases name: all workers put one copy of each into the folder, and a sweep that is resumed on several
    workers says which of them has changed."""
    def write(name, force, n_rows=3):
        rows = "".join(f"{0.3 * i / (n_rows - 1)},{force}\n" for i in range(n_rows))
        (folder / name).write_text("t,F\n" + rows + f"0.3001,0\n9,0\n")

    load = ("subsection Network\n  set Loads = push\n  subsection Load push\n    set On = mass\n    set Direction = 0, 1\n"
            "    set Magnitude = 0\n  end\nend\n")
    magnitude = "Network/Load push/Magnitude"
    write("long.csv", 3, 20000)
    name = scene(folder, "one_file.prm", {"F": {"Entries": magnitude, "Values": "table(long.csv, F); 0"},
                                          "mass": {"Entries": MASS, "Values": "1:1:8"}})
    (folder / name).write_text((folder / name).read_text() + load)
    for attempt in range(2):
        table = rows(sweep(folder, name, f"one_file_{attempt}", "--set", "Time/End=0.1", ranks=4))
        expect("cases of one file", len(table) == 16 and not any(row["message"] for row in table), table[:1])
        kept = sorted(path.name for path in (folder / f"one_file_{attempt}").iterdir())
        expect("one copy of the file", kept == ["long.csv", "sweep.csv", "sweep.prm"], kept)

    for case in range(6):
        write(f"push_{case}.csv", 10 * case)
    files = {"F": {"Entries": magnitude, "Values": "; ".join(f"table(push_{case}.csv, F)" for case in range(6))}}
    name = scene(folder, "files.prm", files)
    (folder / name).write_text((folder / name).read_text() + load)
    whole = sweep(folder, name, "files", ranks=2)
    table = folder / "files" / "sweep.csv"
    table.write_bytes(b"".join(whole.splitlines(keepends=True)[:3]))
    write("push_3.csv", 1000)  # of the second worker
    result = taut(folder, name, "--sweep", "--resume", "--set", "Sweep/Folder=files", ranks=2)
    expect("a changed file of a case", result.returncode == 1 and "push_3.csv" in result.stderr and "is not what it was" in result.stderr,
           f"{result.returncode} {result.stderr}")
    write("push_3.csv", 30)
    expect("the file put back", sweep(folder, name, "files", "--resume", ranks=2) == whole)


def check_mistakes(folder):
    mass = {"Entries": MASS, "Values": "1, -2, 3"}
    name = scene(folder, "failing.prm", {"mass": mass})
    table = rows(sweep(folder, name, "failing"))
    expect("a case that fails is a line", len(table) == 3 and "Network/Mass mass/Mass" in table[1]["message"] and
           not table[0]["message"] and not table[2]["message"], [row["message"] for row in table])
    result = taut(folder, name, "--sweep", "--set", "Sweep/Folder=failing")
    expect("an earlier sweep stays", result.returncode == 1 and "--resume" in result.stderr, result.stderr)
    result = taut(folder, name, "--sweep", "--resume", "--set", "Sweep/Folder=failing", "--set", "Time/Step=2e-4")
    expect("other entries", result.returncode == 1 and "other entries" in result.stderr, result.stderr)
    one = {"Entries": MASS, "Values": "1"}
    for what, parameters, entries, options, message in (
            ("no parameter", {}, {}, (), "Sweep/Parameters"),
            ("unknown entry", {"m": {"Entries": "Network/Mass mass/Mas", "Values": "1"}}, {}, (), "did you mean"),
            ("no value", {"m": {"Entries": MASS}}, {}, (), "give one or more values"),
            ("backward range", {"m": {"Entries": MASS, "Values": "3:1:1"}}, {}, (), "first:step:last"),
            ("no samples", {"m": {"Entries": MASS, "Distribution": "uniform", "Range": "1, 2"}}, {}, (), "Sweep/Samples"),
            ("no range", {"m": {"Entries": MASS, "Distribution": "normal"}}, {"Samples": 3}, (), "standard deviation"),
            ("unequal lists", {"m": one, "k": {"Entries": STIFFNESS, "Values": "1, 2"}}, {"Combination": "zipped"}, (),
             "equally long"),
            ("half a range", {"m": {"Entries": MASS, "Distribution": "uniform", "Range": "1, 2, 3"}}, {"Samples": 3}, (),
             "least and the largest"),
            ("varied twice", {"m": one, "k": one}, {}, (), "varied twice"),
            ("the folder", {"m": {"Entries": "Sweep/Folder", "Values": "1"}}, {}, (), "not part of the scene"),
            ("--study", {"m": one}, {}, ("--study",), "exclude each other"),
            ("--check", {"m": one}, {}, ("--check",), "exclude each other"),
            ("--accuracy", {"m": one}, {}, ("--accuracy=0.1",), "exclude each other"),
            ("both", {"m": one}, {}, ("--resume", "--overwrite"), "exclude each other")):
        name = scene(folder, "mistake.prm", parameters, **entries)
        result = taut(folder, name, "--sweep", *options)
        expect(what, result.returncode == 1 and message in result.stderr and len(result.stderr.splitlines()) == 1,
               f"{result.returncode} {result.stderr}")
    result = taut(folder, scene(folder, "mistake.prm", {"m": one}), "-j", "2")
    expect("--jobs without --sweep", result.returncode == 1 and "--sweep" in result.stderr, result.stderr)


with tempfile.TemporaryDirectory() as name:
    for check in (check_values, check_random, check_sharing, check_pictures, check_files, check_mistakes):
        folder = pathlib.Path(name) / check.__name__
        folder.mkdir()
        check(folder)

finish()
