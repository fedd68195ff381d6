#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Prints what 'taut --accuracy' promises and what it keeps, as a Markdown table: for each scene the setting it
finds, its expected and its true error, and the cost of the search over that of the setting. The true error is
against one run with steps and elements eight times as fine as the setting's.

    tests/benchmarks/accuracy_table.py --program build/taut [--accuracy 0.01] [SCENE.prm ...]
"""
import argparse
import csv
import json
import pathlib
import re
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
FINER = 8
SCENES = [ROOT / "prm" / f"{name}.prm" for name in (
    "en50318_2002_250", "en50318_2002_300", "bar_on_wall", "line_with_droppers", "snap_load", "oscillator_with_stop",
    "beam_over_supports", "string_on_stop", "guyed_mast", "wire_in_space")]
SCENES += sorted((ROOT / "tests" / "benchmarks" / "accuracy").glob("*.prm"))


def call(program, file, folder, *arguments):
    return subprocess.run([program, file, "--overwrite", "--set", f"Study/Folder={folder}", *arguments],
                          capture_output=True, text=True, cwd=folder)


def sets(entries):
    return [argument for entry, value in entries.items() for argument in ("--set", f"{entry}={value}")]


def finer(entry, value):
    """The value that makes a model eight times as fine."""
    number = float(value)
    if re.search(r"(Step|size)$", entry):
        return repr(number / FINER)
    if "efinement" in entry:
        return str(int(number) + 3)
    return str(int(number * FINER))


def quantities(study, file):
    """Entries that name the quantities of the search, if the scene does not."""
    names = [quantity["name"] for quantity in study["quantities"]]
    if study["scene"].get("Study/Quantities") or re.search(r"^\s*set Quantities", file.read_text(), re.M):
        return {}
    entries = {"Study/Quantities": ", ".join(names)}
    for quantity in study["quantities"]:
        of, kind = re.fullmatch(r"(.*) (mean|standard deviation|largest force|impulse|largest|smallest)",
                                quantity["name"]).groups()
        section = f"Study/Quantity {quantity['name']}/"
        entries.update({section + "Of": of, section + "Quantity": kind, section + "Scale": quantity["scale"]})
    return entries


def true_error(program, file, folder, study, setting):
    entries = {"Study/Parameters": ", ".join(setting), "Study/Repeats": 1, **quantities(study, file)}
    for parameter in study["parameters"]:
        name, value = parameter["name"], setting[parameter["name"]]
        section = f"Study/Parameter {name}/"
        entries.update({section + "Entries": ", ".join(parameter["entries"]), section + "Values": value,
                        section + "Refined": "false",
                        section + "Reference": finer(parameter["entries"][0], value)})
    alone = pathlib.Path(folder, file.name)
    alone.write_text(re.sub(r"^ *subsection Parameter .*?^ *end\n", "", file.read_text(), flags=re.M | re.S))
    run = call(program, alone, folder, "--study", *sets(entries))
    if run.returncode != 0:
        return f"no fine run: {run.stderr.strip()}"
    with open(f"{folder}/work_precision.csv", encoding="utf-8") as table:
        return f"{100 * float(next(csv.DictReader(table))['error [1]']):.2f} %"


def row(program, file, accuracy):
    with tempfile.TemporaryDirectory() as folder:
        run = call(program, file, folder, "--accuracy", str(accuracy))
        if run.returncode != 0:
            return f"| {file.stem} | none: {run.stderr.strip().split(': ', 2)[-1]} | | | | |"
        words = re.search(r"Setting for .*?: (.*)\n  expected error (\S+),", run.stdout)
        setting = dict(part.split(" = ") for part in words.group(1).split(", "))
        cost = re.search(r"took (\d+) runs and .* s, (\S+) times", run.stdout)
        study = json.loads(pathlib.Path(folder, "study.json").read_text(encoding="utf-8"))
        return (f"| {file.stem} | {words.group(1)} | {100 * float(words.group(2)):.2f} % | "
                f"{true_error(program, file, folder, study, setting)} | {cost.group(1)} | "
                f"{float(cost.group(2)):.0f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True, type=pathlib.Path)
    parser.add_argument("--accuracy", type=float, default=0.01)
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    arguments = parser.parse_args()
    print("| scene | setting | expected error | true error | runs | search over run |\n|---|---|---|---|---|---|")
    for file in arguments.scenes or SCENES:
        print(row(arguments.program.resolve(), file.resolve(), arguments.accuracy), flush=True)


if __name__ == "__main__":
    main()
