#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs that end by kill -9 at a random moment and are resumed, again and again until one gets to its end, have the files
of a run that nobody touched, byte for byte; on another number of ranks to 1e-9. A checkpoint that cannot be used is one
clear error, and what is in the folder stays."""
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.append(str(pathlib.Path(__file__).parents[1]))
from checks import entries, expect, finish, largest_difference, on_ranks, parse

arguments = parse(__doc__, "program", "mpiexec", "prm", serial=(0, "runs of one process that are killed"),
                  parallel=(0, "runs of two ranks that are killed"), bad=(False, "checkpoints that cannot be used"), seed=(1, ""))

LINE = "en50318_2002_250.prm"
CONTACT = "Catenary/Pantograph pantograph/Contact stiffness"
PATIENCE = 1800.  # [s]
# Between them they have all that is kept from step to step: schemes with and without mean forces, impulses, adaptive
# steps, extremes in tables, fields, energies, all forms of the interface operator, moving contacts and supports.
SCENES = [
    [LINE, *entries(Time__End=1.5, Statistics__Window="", Output__Observers="energy", Output__Checkpoint_interval=0.2)],
    [LINE, *entries(Time__End=0.6, Time__Step=2e-4, Statistics__Window="", Output__Checkpoint_interval=0.1,
                    Output__Interval=0.01, Output__Tables="binary", Time__Step_control="adaptive"), "--set", f"{CONTACT}=rigid"],
    [LINE, *entries(Time__End=0.4, Statistics__Window="", Output__Checkpoint_interval=0.05,
                    Solver__Interface_operator="matrix-free", Partition__Number_of_substructures=8)],
    ["bouncing_bar.prm", *entries(Time__End=5, Output__Checkpoint_interval=0.5, Output__Observers="energy")],
    ["beam_over_supports.prm", *entries(Output__Checkpoint_interval=0.1, Output__Observers="energy")],
    ["en50318_2002_250_two.prm", *entries(Time__End=0.8, Statistics__Window="", Time__Scheme="BDF2",
                                          Output__Checkpoint_interval=0.15, Solver__Interface_operator="assembled sparse")],
    ["oscillator_with_stop.prm", *entries(Output__Checkpoint_interval=0.1, Time__Scheme="Moreau-Jean")],
    ["pendulum_cable.prm", *entries(Output__Checkpoint_interval=0.2, Output__Observers="cost", Output__Interval=0.05)],
    ["bar_on_two_cables.prm", *entries(Output__Checkpoint_interval=0.2)],
    ["cable_on_floor.prm", *entries(Output__Checkpoint_interval=0.2, Output__Observers="energy")],
    ["line_with_droppers.prm", *entries(Time__End=0.6, Output__Checkpoint_interval=0.1)],
    ["line_with_droppers.prm", *entries(Time__End=0.6, Output__Checkpoint_interval=0.1, Body_messenger__Geometry="linearised",
                                        Body_contact_wire__Geometry="linearised")],
    [pathlib.Path(__file__).parent / "two_contacts.prm", *entries(Output__Checkpoint_interval=0.05)],
    ["line_of_cables_with_weights.prm", *entries(Time__End=0.1, Statistics__Window="", Output__Checkpoint_interval=0.02)],
    [pathlib.Path(__file__).parent / "caught_string.prm", *entries(Output__Checkpoint_interval=0.02)],
]


def command(options, ranks):
    own = [arguments.program, arguments.prm / options[0], *options[1:], *entries("Output/Folder=results")]
    return on_ranks(arguments.mpiexec, ranks, own)


def run(folder, options, ranks=1):
    folder.mkdir(exist_ok=True)
    return subprocess.run(command(options, ranks), cwd=folder, capture_output=True, text=True, timeout=PATIENCE)


def descendants(pid):
    """All processes below this one, and itself."""
    found = [pid]
    for task in pathlib.Path(f"/proc/{pid}/task").glob("*/children"):
        try:
            for child in task.read_text().split():
                found += descendants(int(child))
        except OSError:
            pass
    return found


def kill_all(process):
    for pid in descendants(process.pid):
        try:
            os.kill(pid, signal.SIGKILL)
        except OSError:
            pass
    process.wait()


def start(folder, options, ranks):
    folder.mkdir(exist_ok=True)
    return subprocess.Popen(command(options, ranks), cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def kill_at(folder, options, ranks, seconds):
    """Starts a run and kills it after so many seconds. True if it was still alive."""
    process = start(folder, options, ranks)
    try:
        code = process.wait(seconds)
        expect(f"{options}: the run that was to be killed", code == 0, code)
        return False
    except subprocess.TimeoutExpired:
        kill_all(process)
        return True


def kill_after_checkpoint(folder, options, ranks):
    """Kills a run once it has a checkpoint, however long that takes."""
    process = start(folder, options, ranks)
    while not (folder / "results" / "checkpoint").exists() and process.poll() is None:
        time.sleep(0.01)
    kill_all(process)


def without_wall_times(table):
    """The columns of a table whose unit is not us."""
    rows = [line.split(",") for line in table.read_text().splitlines()]
    kept = [i for i, title in enumerate(rows[0]) if "[us]" not in title]
    return "\n".join(",".join(row[i] for i in kept) for row in rows).encode()


def contents(folder):
    """Files by name. Wall times are not the same from run to run, nor are checkpoints that have them."""
    files = {str(file.relative_to(folder / "results")): file for file in sorted((folder / "results").rglob("*"))
             if file.is_file()}
    return {name: without_wall_times(file) if name == "cost.csv" else b"" if "cost.csv" in files and "checkpoint" in name
            else file.read_bytes() for name, file in files.items()}


def expect_same(what, folder, reference):
    found, wanted = contents(folder), contents(reference)
    expect(f"{what}: same files", found.keys() == wanted.keys(), set(found) ^ set(wanted))
    different = [name for name in wanted if found.get(name) != wanted[name]]
    expect(f"{what}: same bytes", not different, different)


def check_killed(folder, n, ranks, scenes, rng):
    """n runs, scene after scene; each is killed up to three times."""
    n_kills = n_resumed = 0
    for i in range(n):
        scene = scenes[i % len(scenes)]
        reference = folder / f"reference_{i % len(scenes)}"
        if not reference.exists():
            begin = time.monotonic()
            result = run(reference, scene, ranks)
            expect(f"{scene}: the reference runs", result.returncode == 0, result.stderr)
            (reference / "seconds").write_text(str(time.monotonic() - begin))
        seconds = float((reference / "seconds").read_text())
        own = folder / f"killed_{i}"
        options = list(scene)
        for _ in range(3):
            if not kill_at(own, options, ranks, rng.uniform(0.2 * seconds, 1.1 * seconds)):
                break
            n_kills += 1
            options = [*scene, "--resume"]
        if (own / "results").exists():  # else killed before it began
            (own / "results" / "fields").mkdir(exist_ok=True)
            for name in ("checkpoint.some_machine.1.tmp", "fields/wires_00001.vtu.some.machine.1.tmp"):
                (own / "results" / name).write_bytes(b"what a killed run was about to rename")
        result = run(own, [*scene, "--resume"], ranks)
        what = f"{scene[0]} on {ranks} ranks, run {i}"
        expect(f"{what}: resumes", result.returncode == 0, result.stderr)
        n_resumed += "Resumed after t = " in result.stdout
        expect_same(what, own, reference)
        shutil.rmtree(own)
    print(f"figure | {n} runs on {ranks} ranks, {n_kills} kills | {n_resumed} of the last starts from a checkpoint")
    if n >= 6:  # of a few runs all may have been killed before the first one
        expect("checkpoints are used", n_resumed >= n / 3, n_resumed)


def check_other_ranks(folder, scene, bound):
    """Killed on two ranks, resumed on one, and the other way round: tables over the largest number of each unit. With a
    matrix-free F several ranks have other rows than one, and conjugate gradients end elsewhere."""
    pieces = [*scene, "--set", "Partition/Number of substructures=4"]
    reference = folder / "reference_other"
    shutil.rmtree(reference, ignore_errors=True)
    complete = run(reference, pieces)
    for first, second in ((2, 1), (1, 2)):
        own = folder / f"other_{first}"
        shutil.rmtree(own, ignore_errors=True)
        kill_after_checkpoint(own, pieces, first)
        result = run(own, [*pieces, "--resume"], second)
        what = f"{first} ranks, resumed on {second}"
        expect(f"{what}: resumes", result.returncode == 0 and "Resumed after" in result.stdout, result.stderr + result.stdout)
        expect(f"{what}: says so", f"written by {first} ranks" in result.stdout, result.stdout)
        for table in ("sliding.csv", "links.csv", "probes.csv"):
            if (reference / "results" / table).exists():
                worst = largest_difference(own / "results" / table, reference / "results" / table)
                expect(f"{what}: {table}", worst <= bound, worst)
        expected, found = (json.loads((of / "results" / "statistics.json").read_text()) for of in (reference, own))
        for quantity in "relative_contact_energy", "peak_over_mean":
            value, other = (of["certificate"][quantity] for of in (expected, found))
            expect(f"{what}: {quantity}", abs(other["value"] - value["value"]) <= 1e-6 * value["value"] + 1e-8 and
                   (value["value"] < 1e-3 or other.get("largest_at") == value.get("largest_at")), (value, other))
        steps = [re.findall("^Steps: .*", of.stdout, re.MULTILINE) for of in (complete, result)]
        expect(f"{what}: error of steps", steps[0] == steps[1], steps)


def check_shared_mesh(folder):
    """Ranks share the mesh of a solid: resumed on as many ranks to the bit, and refused on another number."""
    scene = ["bracket_and_cables.prm", *entries(Time__End=1, Output__Checkpoint_interval=0.1, Partition__Number_of_substructures=4)]
    reference, own = folder / "shared_reference", folder / "shared"
    result = run(reference, scene, 2)
    expect("shared mesh: the reference runs", result.returncode == 0, result.stderr)
    kill_after_checkpoint(own, scene, 2)
    result = run(own, [*scene, "--resume"])
    expect("shared mesh: one rank", result.returncode == 1 and "resume the run on 2 ranks" in result.stderr, result.stderr)
    result = run(own, [*scene, "--resume"], 2)
    expect("shared mesh: resumes", result.returncode == 0 and "Resumed after" in result.stdout, result.stderr + result.stdout)
    expect_same("shared mesh", own, reference)


def check_bad(folder):
    """Each change of the folder with its error; the folder is as before."""
    scene = [LINE, *entries(Time__End=0.5, Statistics__Window="", Output__Checkpoint_interval=0.1, Output__Field_interval=0)]
    complete = folder / "complete"
    result = run(complete, scene)
    expect("the run", result.returncode == 0, result.stderr)

    def changed(name):
        own = folder / name
        shutil.copytree(complete, own)
        return own, own / "results"

    def flip(path):
        data = bytearray(path.read_bytes())
        data[len(data) // 2] ^= 1
        path.write_bytes(bytes(data))

    def cut(path):
        path.write_bytes(path.read_bytes()[:-100])

    def in_its_place(path):
        path.unlink()
        path.mkdir()

    def lengthen(path):
        """The length of a block as nobody writes it."""
        line, _, rest = path.read_bytes().partition(b"\n")
        block, _, data = rest.partition(b"\n")
        name, _, checksum = block.split(b" ")
        path.write_bytes(b"\n".join((line, b" ".join((name, b"18446744073709551600", checksum)), data)))

    for name, damage, message in (("lengthened", lengthen, "damaged"), ("flipped", flip, "damaged: its checksum is wrong"), ("cut", cut, "damaged"),
                                  ("empty", lambda p: p.write_bytes(b""), "is no checkpoint of Taut"),
                                  ("foreign", lambda p: p.write_text("something else\n"), "is no checkpoint of Taut"),
                                  ("older", lambda p: p.write_text("Taut checkpoint, version 0\nx"), "another version")):
        own, results = changed(name)
        damage(results / "checkpoint")
        result = run(own, [*scene, "--resume"])
        expect(f"{name}: the one before is used", result.returncode == 0 and "the one before it is used" in result.stdout and
               message in result.stdout and "Resumed after t = 0.4 s" in result.stdout, result.stdout + result.stderr)
        for file in ("checkpoint", "checkpoint.old"):
            damage(results / file)
        before = contents(own)
        result = run(own, [*scene, "--resume"])
        expect(f"{name}, both: one error", result.returncode == 1 and len(result.stderr.splitlines()) == 1 and
               result.stderr.count(message) == 2 and "--overwrite" in result.stderr, result.stderr)
        expect(f"{name}, both: nothing is lost", contents(own) == before)

    own, results = changed("folder")
    in_its_place(results / "checkpoint")
    result = run(own, [*scene, "--resume"])
    expect("a folder in its place: the one before is used", "the one before it is used" in result.stdout and
           "cannot be read" in result.stdout, result.stdout + result.stderr)

    own, results = changed("entry")
    before = contents(own)
    result = run(own, [*scene, "--set", "Time/Step=5e-4", "--resume"])
    expect("another step: one error", result.returncode == 1 and "'1e-3'" in result.stderr and "Time/Step" in result.stderr
           and "--overwrite" in result.stderr, result.stderr)
    expect("another step: nothing is lost", contents(own) == before)

    own, results = changed("table")
    (results / "sliding.csv").write_text("")
    result = run(own, [*scene, "--resume"])
    expect("a shorter table: one error", result.returncode == 1 and "sliding.csv' is shorter" in result.stderr, result.stderr)

    own, results = changed("gone")
    for file in ("checkpoint", "checkpoint.old"):
        (results / file).unlink()
    result = run(own, [*scene, "--set", "Time/Step=5e-4", "--resume"])
    expect("other results: one error", result.returncode == 1 and "nothing to resume there" in result.stderr, result.stderr)
    result = run(own, [*scene, "--resume"])
    expect("no checkpoint: from the start", result.returncode == 0 and "begins from the start" in result.stdout,
           result.stdout + result.stderr)
    expect_same("no checkpoint", own, complete)

    result = run(complete, scene)
    expect("a plain start tells of --resume", result.returncode == 1 and "--resume" in result.stderr, result.stderr)
    for other in ("--overwrite", "--check", "--study", "--accuracy=0.1"):
        result = run(complete, [*scene, "--resume", other])
        expect(f"--resume {other}", result.returncode == 1 and "exclude each other" in result.stderr, result.stderr)

    # A signal ends a run in order; it resumes like one that was killed.
    own, reference = folder / "signal", folder / "long"
    longer = [*scene, *entries(Time__End=1.5, Time__Step=2e-4)]
    run(reference, longer)
    own.mkdir()
    process = subprocess.Popen(command(longer, 1), cwd=own, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    while not (own / "results" / "checkpoint").exists() and process.poll() is None:
        time.sleep(0.01)
    process.send_signal(signal.SIGTERM)
    said = process.communicate(timeout=PATIENCE)[1]
    expect("SIGTERM", process.returncode == 143 and re.search("go on with --resume", said), said)
    result = run(own, [*longer, "--resume"])
    expect("SIGTERM: resumes", result.returncode == 0 and "Resumed after" in result.stdout, result.stderr)
    expect_same("SIGTERM", own, reference)


with tempfile.TemporaryDirectory() as name:
    rng = random.Random(arguments.seed)
    print(f"seed {arguments.seed}")
    folder = pathlib.Path(name)
    if arguments.serial:
        check_killed(folder, arguments.serial, 1, SCENES, rng)
    if arguments.parallel:
        ranks = folder / "ranks"
        ranks.mkdir()
        rows_on_ranks = [*SCENES[-1], *entries(Solver__Interface_operator="matrix-free")]
        two = [[*scene, "--set", "Partition/Number of substructures=4"] for scene in (rows_on_ranks, SCENES[1], SCENES[0])]
        check_killed(ranks, arguments.parallel, 2, two, rng)
        rebounds = [*rows_on_ranks, *entries("Time/Moreau-Jean/Restitution=0.6", Time__Scheme="Moreau-Jean")]
        for scene, bound in (SCENES[0], 1e-9), (SCENES[2], 1e-8), (rows_on_ranks, 1e-8), (rebounds, 1e-8):
            check_other_ranks(ranks, scene, bound)
        check_shared_mesh(ranks)
    if arguments.bad:
        check_bad(folder)

finish()
