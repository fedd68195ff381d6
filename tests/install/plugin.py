#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A body and an observer of a plugin, named in a parameter file: the answers of the program that uses the library
(plate.csv, written by plate), the same on 1, 2 and 4 ranks, with fields, energy, --check and errors like those of a wire."""
import csv
import pathlib
import shutil
import subprocess
import sys
import xml.etree.ElementTree as xml

sys.path.append(str(pathlib.Path(__file__).parents[1]))
from checks import entries, errors, finish, largest_difference, on_ranks, parse

arguments = parse(__doc__, "program", "mpiexec", "prm", "build")


def run(*options, ranks=1):
    command = on_ranks(arguments.mpiexec, ranks, [arguments.program, arguments.prm, *options])
    return subprocess.run(command, cwd=arguments.build, capture_output=True, text=True, timeout=900)


def columns(path):
    with open(path) as file:
        lines = list(csv.reader(file))
    return {title: [float(line[c]) for line in lines[1:]] for c, title in enumerate(lines[0])}


def expect(holds, message):
    if not holds:
        errors.append(message)


def fails(message, *options):
    done = run("--overwrite", *options)
    expect(done.returncode == 1 and all(part in done.stderr for part in message),
           f"{options}: {done.returncode}, {done.stderr}")


folders = {}
for ranks in (1, 2, 4):
    folders[ranks] = arguments.build / f"plugin_{ranks}"
    shutil.rmtree(folders[ranks], ignore_errors=True)
    done = run("--set", f"Output/Folder=plugin_{ranks}", ranks=ranks)
    if done.returncode != 0:
        sys.exit(f"{ranks} ranks: {done.stderr}")
    expect(ranks > 1 or "'plate' 40 DoFs" in done.stdout, f"the plate is missing in the log: {done.stdout}")

# The table has the corner from the equilibrium on, which here is the undeformed state.
corner, other = columns(folders[1] / "probes.csv")["corner [m]"], columns(arguments.build / "plate.csv")["corner [m]"]
size = max(map(abs, other))
expect(len(corner) == len(other) + 1 and
       max(abs(a - b) for a, b in zip(corner[1:], other)) < 1e-9 * size, "the corner moves otherwise than in plate.cc")

energy = columns(folders[1] / "energy.csv")
expect(max(map(abs, energy["error [J]"])) < 1e-10 * max(energy["strain [J]"]), "the balance of energy does not close")
largest = columns(folders[1] / "largest.csv")
expect(abs(largest["time [s]"][0] - 0.1) < 1e-9, "the entry 'From' of the observer is not read")
expect(largest["largest [m]"][-1] >= abs(corner[-1]), "the largest displacement is less than one of them")

for ranks in (2, 4):
    for name in ("probes.csv", "links.csv", "energy.csv", "largest.csv"):
        difference = largest_difference(folders[1] / name, folders[ranks] / name)
        expect(difference < 1e-9, f"{name}: {ranks} ranks differ by {difference}")
    frames = sorted(path.name for path in (folders[ranks] / "fields").glob("*.vtu"))
    expect(frames == sorted(path.name for path in (folders[1] / "fields").glob("*.vtu")), f"{ranks} ranks: fields {frames}")

frames = [node.get("file") for node in xml.parse(folders[1] / "fields/body_plate.pvd").iter("DataSet")]
expect(frames == [f"body_plate_{i:05d}.vtu" for i in range(5)], f"frames of the plate: {frames}")
root = xml.parse(folders[1] / "fields" / frames[-1]).getroot()
arrays = {node.get("Name") for node in root.iter("DataArray")}
expect("displacement" in arrays, f"arrays of the plate: {arrays}")

check = run("--check", "--set", "Output/Folder=nowhere")
for part in ("elastic plate", "plate @ 2, 1", "The scene is consistent"):
    expect(part in check.stdout, f"--check does not say '{part}': {check.stdout} {check.stderr}")
expect(not (arguments.build / "nowhere").exists(), "--check writes")

# From a checkpoint in the middle on, all files become what they were, also those of the plugin.
checkpoints = ("--set", "Output/Folder=resumed", "--set", "Output/Checkpoint interval=0.15")
for ranks in (1, 2):
    shutil.rmtree(arguments.build / "resumed", ignore_errors=True)
    run(*checkpoints, ranks=ranks)
    before = {path.name: path.read_bytes() for path in (arguments.build / "resumed").rglob("*") if path.is_file()}
    done = run(*checkpoints, "--resume", ranks=ranks)
    after = {path.name: path.read_bytes() for path in (arguments.build / "resumed").rglob("*") if path.is_file()}
    different = [name for name in before.keys() | after.keys() if before.get(name) != after.get(name)]
    expect(done.returncode == 0 and "Resumed after t = " in done.stdout and not different and "largest.csv" in after,
           f"resumed on {ranks} ranks: {different} {done.stdout} {done.stderr}")

# Results of observers and bodies are results: not overwritten, and replaced as a whole.
done = run("--set", "Output/Folder=plugin_1")
expect(done.returncode == 1 and "holds the results of a run" in done.stderr, f"overwrites: {done.stderr}")
done = run("--overwrite", "--set", "Output/Folder=plugin_1", "--set", "Output/Observers=", "--set", "Output/Field interval=0")
left = sorted(path.name for path in folders[1].rglob("*") if path.is_file())
expect(not any(name in left for name in ("energy.csv", "largest.csv", "body_plate.pvd", "body_plate_00000.vtu")),
       f"files of the run before are left: {left}")

fails(["Network/Link contact/From", "is not on it"],
      "--set", "Network/Link contact/From=plate @ 2.5, 1")
fails(["Network/Link contact/From", "say where on the body"], "--set", "Network/Link contact/From=plate")
fails(["Body plate/Type", "did you mean 'elastic plate'"], "--set", "Body plate/Type=elastic plat")
fails(["there is no such type", "needs its library in 'Additional shared libraries'"], "--set",
      "Additional shared libraries=")
fails(["there is no entry 'Presure'", "did you mean 'Pressure'"], "--set", "Body plate/Presure=1")
fails(["'largest displacemen'", "did you mean 'largest displacement'"], "--set", "Output/Observers=largest displacemen")

finish()
