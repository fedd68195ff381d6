#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every scene of prm/ gives on several ranks the output, the files and the numbers of one process; so do mistakes."""
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

import numpy as np

sys.path.append(str(pathlib.Path(__file__).parents[1]))
sys.path.append(str(pathlib.Path(__file__).parents[2] / "source/plot"))
sys.dont_write_bytecode = True
from checks import entries, errors, largest_difference, on_ranks, parse
from taut_plot_solids import read_arrays

arguments = parse(__doc__, "program", "mpiexec", "prm", ranks=(2, "of the scenes; words and errors are those of two ranks"))

# Times and work of the computer, what may be rounding alone, where mpirun has its say.
VOLATILE = re.compile(r"real time|Results in|residual|Certificate|^Contacts: energy|^Conjugate gradients|^\s*\d+ %|with output|without output|us a step|"
                      r"^  [a-zA-Z ]+ \d+\.\d\d +\d+\.\d %$")
SHORT = {  # what makes a long scene short
    "bar_on_two_cables": ["Time/End=1.5"],
    "block_impact": ["Time/End=0.25"],
    "bouncing_bar": ["Time/End=1.3"],
    "line_of_cables": ["Time/End=0.2", "Statistics/Window="],
    "line_of_cables_with_weights": ["Time/End=0.2", "Statistics/Window="],
    "line_with_droppers": ["Time/End=0.3"],
    "real_line": ["Time/End=0.02"],
    "swinging_load_on_guys": ["Time/End=0.7"],
}


CONTRADICTION = """
set Generator = network
set Gravity   = 0, 0
subsection Network
  set Wires    = upper, lower
  set Supports = of upper, of lower
  set Links    = first, second, stop
""" + "".join(f"""  subsection Wire {name}
    set From              = 0, {height}
    set To                = 20, {height}
    set Components        = beam
    set Mass per length   = 1
    set Bending stiffness = 2e4
    set Element size      = 0.5
  end
  subsection Support of {name}
    set Wire      = {name}
    set Positions = 0, 20
  end
""" for name, height in (("upper", 1), ("lower", 0))) + """  subsection Link first
    set Type      = joint
    set From      = upper @ 5
    set To        = lower @ 5
    set Direction = 0, -1
  end
  subsection Link second
    set Type      = joint
    set From      = upper @ 5
    set To        = lower @ 5
    set Direction = 0, -1
    set Gap       = 0.01
  end
  subsection Link stop
    set Type      = stop
    set From      = ground
    set To        = lower @ 2:3:17
    set Direction = 0, 1
    set Gap       = 0.001
  end
end
subsection Time
  set End = 0
end
"""  # two joints between the same places

ROPES = """set Generator = network
set Gravity = 0, -9.81
set Start = given
subsection Network
  set Masses = other, bob
  set Links = first, second, plane, tie
  subsection Mass other
    set Position = 5, 0
    set Motions = x, y
    set Mass = 1
  end
  subsection Mass bob
    set Position = 0, -1
    set Motions = x, y
    set Mass = 1
    set Initial velocity = 1, 0, 0
  end
  subsection Link first
    set Type = dropper
    set Turns = true
    set From = ground @ -0.3, 0
    set To = bob
    set Length = 1.0450307
  end
  subsection Link second
    set Type = dropper
    set Turns = true
    set From = ground @ 0.3, 0
    set To = bob
    set Length = 1.05
  end
  subsection Link plane
    set Type = stop
    set From = ground
    set To = bob
    set Direction = 0.6, 0.8
    set Gap = 0.05
  end
  subsection Link tie
    set Type = stop
    set From = ground
    set To = other
    set Direction = 0, 1
    set Gap = 0.05
  end
end
subsection Time
  set Step = 1e-3
  set End = 1
  set Check steps = yes
end
"""
CRADLE = """
set Generator = network
set Gravity   = 0, 0
set Start     = given
subsection Network
  set Masses = a, b, c, d, e
  set Links  = ab, bc, cd, de
""" + "".join(f"""  subsection Mass {name}
    set Position         = {place}, 0
    set Motions          = x, y
    set Mass             = 1
    set Initial velocity = {int(place == 0)}, 0, 0
  end
""" for place, name in enumerate("abcde")) + "".join(f"""  subsection Link {left}{right}
    set Type      = stop
    set From      = {left}
    set To        = {right}
    set Direction = 1, 0
    set Gap       = {gap}
  end
""" for left, right, gap in (("a", "b", 0.01), ("b", "c", 1e-7), ("c", "d", 1e-7), ("d", "e", 1e-7))) + """end
subsection Time
  set Step = 1e-4
  set End  = 0.1
  set Check steps = yes
  subsection Moreau-Jean
    set Restitution = 1
  end
end
"""  # masses that are struck together


def run(ranks, options):
    command = on_ranks(arguments.mpiexec, ranks, [arguments.program, *options])
    return subprocess.run(command, capture_output=True, text=True, timeout=900)


def words(text):
    """Lines that must not differ, with numbers apart, so that they may differ by rounding."""
    lines = [line for line in text.splitlines() if line.strip() and not VOLATILE.search(line)]
    return [re.split(r"(?<![\w.])(-?\d+(?:\.\d*)?(?:e[-+]?\d+)?)(?![\w.])", line) for line in lines]


def same_word(a, b):
    try:
        x, y = float(a), float(b)
    except ValueError:
        return a == b
    return math.isclose(x, y, rel_tol=1e-5, abs_tol=1e-9) or abs(x - y) <= 0.011 * (x != int(x))


def same_text(a, b):
    first, second = words(a), words(b)
    return len(first) == len(second) and all(
        len(p) == len(q) and all(map(same_word, p, q)) for p, q in zip(first, second))


def file_names(folder):
    """Those of the pieces of a body, and the file that joins them, as those of the whole."""
    return sorted({re.sub(r"\.piece\d+", "", path.name).replace(".pvtu", ".vtu") for path in folder.rglob("*")})


def last_arrays(collection):
    file = list(xml.parse(collection).iter("DataSet"))[-1].get("file")
    return read_arrays(str(collection.parent / file))


def last_displacements(collection):
    """Of the points of all cells of a body, in the order of their places."""
    arrays = last_arrays(collection)
    order = np.lexsort(np.round(arrays["positions"].astype(float), 5).T)
    return len(arrays["types"]), arrays["displacement"][order]


def check_pieces(name, one, other):
    """The pieces of a body that ranks write are the picture that one process writes."""
    for collection in sorted((one / "fields").glob("body_*.pvd")):
        (n, expected), (n_found, found) = map(last_displacements, (collection, other / "fields" / collection.name))
        size = np.abs(expected).max()
        if n_found != n or found.shape != expected.shape or not np.abs(found - expected).max() <= 1e-6 * size:
            errors.append(f"{name}: {collection.name} shows {n_found} cells, {n} on one process, or other displacements")


def check_lines(name, one, other):
    """Wires and links, whose points the root gathers from all ranks, are those of one process in their order."""
    for stem in ("wires.pvd", "links.pvd"):
        if not (one / "fields" / stem).exists():
            continue
        expected, found = (last_arrays(folder / "fields" / stem) for folder in (one, other))
        for array in ("positions", "displacement", "force", "gap"):
            values, others = (of.get(array, np.zeros(1)) for of in (expected, found))
            rounding = 1e-12 if array == "gap" else 0.  # [m, rad] of what is closed
            if others.shape != values.shape or not np.abs(others - values).max() <= 1e-6 * np.abs(values).max() + rounding:
                errors.append(f"{name}: {stem} has other {array}")


def check_figures(name, one, other):
    """Figures of links and contacts are those of one process, in one order, and so is the worst contact."""
    expected, found = (json.loads((folder / "statistics.json").read_text()) for folder in (one, other))
    # What droppers that catch give amplifies the rounding of other parts.
    bounds = (("relative_contact_energy", 1e-3, 1e-3), ("peak_over_mean", 1e-6, 1.01), ("contact_gap", 1e-6, 1.))
    for quantity, bound, certain in bounds if "certificate" in expected else ():
        value, one_more = (of["certificate"][quantity] for of in (expected, found))
        if not abs(one_more["value"] - value["value"]) <= bound * value["value"] + 1e-8 or (
                value["value"] > certain and one_more["largest_at"] != value["largest_at"]):
            errors.append(f"{name}: {quantity} is {one_more}, not {value}")
    for section in ("links", "contacts"):
        if section not in expected:
            continue
        if list(expected[section]) != list(found[section]):
            errors.append(f"{name}: statistics.json has other {section}")
            continue
        for quantity in {q for item in expected[section].values() for q in item}:
            values, others = (np.array([np.ravel(item[quantity]["value"]) for item in of[section].values()
                                        if quantity in item], dtype=float) for of in (expected, found))
            if not np.abs(others - values).max() <= 1e-6 * np.abs(values).max():
                errors.append(f"{name}: {quantity} of {section} in statistics.json differs")


def check_scene(scene, folder, end=None):
    """With an end in s also where links and contacts live with their bodies."""
    options = [scene, "--overwrite", *entries(*SHORT.get(scene.stem, []))]
    if end is not None:
        options += entries(f"Time/End={end}", "Statistics/Window=", "Solver/Interface operator=matrix-free")
    outputs = {}
    # Three ranks once with a moving contact, once with fewer bodies than ranks.
    several = (arguments.ranks, 3) if scene.stem in ("en50318_2002_250", "oscillator_with_stop") else (arguments.ranks,)
    for ranks in (1, *several):
        results = folder / f"{scene.stem}_{ranks}"
        cuts = [] if ranks == 1 else ["--set", "Partition/Number of substructures=4"]
        if not re.search(r"^\s*subsection (Wire|Contact wire) *|= solid$", scene.read_text(), re.MULTILINE):
            cuts = []
        done = run(ranks, [*options, "--set", f"Output/Folder={results}", *cuts])
        if done.returncode != 0:
            errors.append(f"{scene.stem} on {ranks} ranks: {done.stderr.strip()}")
            return
        outputs[ranks] = results
    one = outputs[1]
    names = file_names(one)
    worst = 0.
    for ranks in several:
        if file_names(outputs[ranks]) != names:
            errors.append(f"{scene.stem} on {ranks} ranks: other files")
        check_pieces(f"{scene.stem} on {ranks} ranks", one, outputs[ranks])
        check_lines(f"{scene.stem} on {ranks} ranks", one, outputs[ranks])
        if end is not None:
            check_figures(f"{scene.stem} on {ranks} ranks", one, outputs[ranks])
        for name in names:
            if name.endswith(".csv") and name != "certificate.csv":
                difference = largest_difference(one / name, outputs[ranks] / name)
                worst = max(worst, difference)
                if not difference < 1e-7:
                    errors.append(f"{scene.stem} on {ranks} ranks: {name} differs by {difference:.1e}")
    until = "" if end is None else f", matrix-free until {end} s"
    print(f"figure | {scene.stem}{until}, {' and '.join(map(str, several))} ranks, 4 parts, tables | {worst:.1e} 1")


def check_same_words(options, code):
    one, two = run(1, options), run(2, options)
    if one.returncode != code or two.returncode != code:
        errors.append(f"{options}: exit codes {one.returncode} and {two.returncode}, expected {code}")
    if not same_text(one.stdout, two.stdout):
        errors.append(f"{options}: other text\n{one.stdout}\n---\n{two.stdout}")
    # mpirun adds lines of its own about an exit code.
    said = [line for line in two.stderr.splitlines() if line.startswith("taut:")]
    if said != [line for line in one.stderr.splitlines() if line.startswith("taut:")]:
        errors.append(f"{options}: {one.stderr!r} and {two.stderr!r}")


with tempfile.TemporaryDirectory() as name:
    scratch = pathlib.Path(name)
    for scene in sorted(arguments.prm.glob("*.prm")):
        text = scene.read_text()
        if "Generator = catenary" in text and scene.stem != "en50318_2002_250":
            continue  # the same kind of scene again, and long
        if scene.stem == "en50318_2002_250":
            SHORT[scene.stem] = ["Time/End=0.3", "Statistics/Window="]
        check_scene(scene, scratch)
    # Where links and contacts live with their bodies.
    SHORT.clear()
    for stem, end in (("en50318_2002_250", 0), ("hertz_cylinder", 0), ("block_on_block", 0), ("en50318_2002_250", .05),
                      ("string_on_stop", .2), ("block_impact", .05), ("bar_on_two_cables", .3)):
        check_scene(arguments.prm / f"{stem}.prm", scratch, end)
    check_scene(pathlib.Path(__file__).parents[1] / "restart" / "caught_string.prm", scratch, .15)  # by steps that give energy
    line = str(arguments.prm / "en50318_2002_250.prm")
    stop = str(arguments.prm / "oscillator_with_stop.prm")
    out = ["--set", f"Output/Folder={scratch}/words", "--overwrite"]
    check_same_words([stop, *out], 0)
    check_same_words([stop, "--check"], 0)
    check_same_words([str(scratch / "missing.prm")], 1)
    check_same_words([stop, "--set", "Time/Stepp=1"], 1)
    check_same_words([stop, "--unknown"], 1)
    check_same_words([line, *out, "--set", "Time/End=9", "--set", "Time/Step=0.1"], 1)  # leaves its wire
    check_same_words([stop, "--set", "Output/Folder=/proc/none"], 1)  # only the root fails
    # On ranks without a row, and with rows of their own.
    contradiction = scratch / "contradiction.prm"
    contradiction.write_text(CONTRADICTION)
    for parts in 1, 4:
        check_same_words([str(contradiction), *out, *entries(f"Partition/Number of substructures={parts}",
                                                             "Solver/Interface operator=matrix-free")], 1)
    cradle = scratch / "cradle.prm"
    cradle.write_text(CRADLE)
    matrix_free = entries("Solver/Interface operator=matrix-free")
    check_same_words([str(cradle), *out, *matrix_free], 0)
    # A stop and two ropes share the impulse at one mass, on the rank of the mass and on the root.
    ropes = scratch / "ropes.prm"
    ropes.write_text(ROPES)
    check_same_words([str(ropes), *out, *matrix_free], 0)
    # Links that keep their directions beside a contact of surfaces.
    bodies = "messenger 1", "messenger 2", "messenger 3", "contact wire"
    floor = {"Contacts": "floor", "Contact floor/Slave": "messenger 1", "Contact floor/Obstacle": "plane",
             "Contact floor/Point": "0, -3", "Contact floor/Direction": "0, 1", "Time/End": "0.01", "Statistics/Window": ""}
    check_same_words([str(arguments.prm / "line_of_cables_with_weights.prm"), *out, *matrix_free,
                      *entries(*(f"{entry}={value}" for entry, value in floor.items()),
                               *(f"Body {body}/Geometry=linearised" for body in bodies))], 0)
    # Two start in each other.
    check_same_words([str(cradle), *out, *matrix_free, *entries("Network/Link bc/Gap=-0.01", "Network/Link de/Gap=-0.02")], 1)
    # Nothing holds the parts of a wire along it; each has ends on other ranks.
    check_same_words([str(contradiction), *out, *entries("Network/Link second/Gap=0", "Network/Wire lower/Components=bar, beam",
                                                         "Network/Wire lower/Axial stiffness=1e6",
                                                         "Partition/Number of substructures=4")], 0)
    # A folder is where the root wants to write, at the first step: all ranks end with its error.
    blocked = scratch / "blocked"
    (blocked / "rigid_bodies.csv" / "kept").mkdir(parents=True)
    check_same_words([str(arguments.prm / "bar_on_two_cables.prm"), "--overwrite",
                      *entries(f"Output/Folder={blocked}", "Output/Observers=rigid bodies", "Time/End=0.02")], 1)
    # Rounding loses what holds a wire of so many elements: only its owner fails.
    check_same_words([line, *out, "--set", "Catenary/Contact wire/Element size=5e-3"], 1)

sys.exit("\n".join(error[:2000] for error in errors) or None)
