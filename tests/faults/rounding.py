#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The reference lines of EN 50318 with all operations rounded to nearest, upwards, downwards and to zero: the digits of each
quantity that do not change, as the tables of doc/results/rounding.md. Expected: eight or more of each, every step certified."""
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).parent))
from injected import Program, ending

sys.path.append(str(pathlib.Path(__file__).parents[1]))
from checks import errors, finish, parse

arguments = parse(__doc__, "program", "library", "prm")

SCENES = {"250 km/h": "en50318_2002_250.prm", "300 km/h": "en50318_2002_300.prm"}
MODES = {"up": "upwards", "down": "downwards", "to_zero": "to zero"}
LEAST_DIGITS = 8


def numbers(folder):
    """What EN 50318 judges, and the largest forces of the droppers; residuals apart."""
    found = json.loads((folder / "results" / "statistics.json").read_text())
    result = {}
    for contact in found["sliding_contacts"].values():
        for name, entry in contact["filtered"].items():
            result[name.replace("_", " "), entry["unit"]] = entry["value"]
        result["contact loss", contact["contact_loss"]["unit"]] = contact["contact_loss"]["value"]
    for name, entry in found["probes"].items():
        result[f"uplift, {name}", entry["largest"]["unit"]] = entry["largest"]["value"]
    for name, entry in found["links"].items():
        result[f"largest force, {name}", "N"] = entry["largest_force"]["value"]
    return result, {name: found["certificate"][name]["value"] for name in ("complementarity", "balance")}


def digits(value, other):
    """Significant digits that two numbers share; 17 are all that a number has."""
    if not (math.isfinite(value) and math.isfinite(other)):
        return 0.
    if value == other:
        return 17.
    return max(0., -math.log10(abs(other - value) / max(abs(value), abs(other))))


def shown(value):
    return "all" if value >= 17. else f"{value:.1f}"


for title, scene in SCENES.items():
    with tempfile.TemporaryDirectory() as name:
        # All entries as text, also those that the file leaves out: deal.II turns the numbers of the program into text of
        # six digits, of which the last one depends on the rounding.
        scratch = pathlib.Path(name)
        subprocess.run([arguments.program, arguments.prm / scene, "--set", "Time/End=0.01", "--set", "Statistics/Window=",
                        "--set", f"Output/Folder={scratch}/first"], check=True, stdout=subprocess.DEVNULL)
        entries = (scratch / "first" / "used.prm").read_text()
        own = {key: re.search(rf"set {key} += *(.*)", (arguments.prm / scene).read_text())[1] for key in ("Window", "End")}
        for key, value in own.items():
            entries = re.sub(rf"(set {key} +=).*", rf"\1 {value}", entries, count=1)
        (scratch / "line.prm").write_text(entries)
        program = Program(arguments.library, scratch, arguments.program, scratch / "line.prm", "--set", "Output/Folder=results")
        found = {}
        for mode in ("to_nearest", *MODES):
            result = program.run(mode)
            if result.code != 0:
                sys.exit(f"{title}, {mode}: {ending(result.code)}\n{result.err}")
            found[mode] = numbers(program.folder)
        program.end()
    nearest, own = found["to_nearest"]
    print(f"\n## {title}\n\n| quantity | to nearest | {' | '.join(MODES.values())} |\n|{'---|' * (2 + len(MODES))}")
    same = {key: {mode: digits(value, found[mode][0][key]) for mode in MODES} for key, value in nearest.items()}
    for (quantity, unit), value in nearest.items():
        row = same[quantity, unit]
        if quantity.startswith("largest force"):
            continue
        print(f"| {quantity} | {value:.12g} {unit} | {' | '.join(shown(d) for d in row.values())} |")
    forces = [row for (quantity, _), row in same.items() if quantity.startswith("largest force")]
    print(f"| largest forces of the {len(forces)} droppers, the fewest digits | | "
          f"{' | '.join(shown(min(row[mode] for row in forces)) for mode in MODES)} |")
    for residual in own:
        print(f"| largest residual, {residual} | {own[residual]:.1e} | "
              f"{' | '.join(f'{found[mode][1][residual]:.1e}' for mode in MODES)} |")
    fewest = min(d for row in same.values() for d in row.values())
    if all(d >= 17. for row in same.values() for d in row.values()):
        errors.append(f"{title}: no rounding changed anything")
    if fewest < LEAST_DIGITS:
        errors.append(f"{title}: {fewest:.1f} digits do not change")

finish()
