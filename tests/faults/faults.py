#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every operation on a file of a small run fails, one a run: each run ends with exit code 1 and one line that names file and
remedy; what is on the disk stays readable, and --resume goes on from it to the same bytes. So do sweeps. Expected: the files
of the same run without a fault. A run that is larger than its memory ends with one line that says so."""
import collections
import json
import pathlib
import random
import resource
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

sys.path.append(str(pathlib.Path(__file__).parent))
from injected import Program, contents, ending

sys.path.append(str(pathlib.Path(__file__).parents[1]))
from checks import entries, errors, finish, parse

arguments = parse(__doc__, "program", "library", "prm", files=(1., "part of the faults of files that are tried"),
                  seed=(1, ""))

# Tables of all kinds, of which a line is written at every step, fields, energy, statistics and three checkpoints.
LINE = [arguments.prm / "en50318_2002_250.prm", *entries(
    Catenary__Number_of_spans=3, Catenary__Contact_wire__Element_size=2, Catenary__Messenger_wire__Element_size=2,
    Catenary__Uplift_positions=90, Statistics__Window="", Time__Step=2e-3, Time__End=0.1,
    Output__Folder="results", Output__Observers="energy", Output__Interval=0, Output__Link_interval=0,
    Output__Field_interval=0.03, Output__Checkpoint_interval=0.03)]
SWEEP = [arguments.prm / "oscillator_with_stop.prm", "--sweep", *entries(
    Time__End=0.02, Output__Folder="results", Sweep__Folder="sweep", Sweep__Parameters="m",
    Sweep__Parameter_m__Entries="Network/Mass mass/Mass", Sweep__Parameter_m__Values="1, 2, 3")]
figures = collections.Counter()


def expect(what, is_true, found=""):
    if not is_true:
        errors.append(f"{what}: {str(found)[:800]}")
        if len(errors) == 1000:
            sys.exit("\n".join(errors))
    return is_true


def damages(found, reference, before):
    """Files that no one could go on with: each file is as it was before, or as that of a run without a fault; a table may
    end early, with a complete line."""
    for name, data in found.items():
        if data in (before.get(name), reference.get(name)) or "/worker_" in name:
            continue
        stem = name.rpartition("/")[2]
        if stem.endswith(".csv"):
            if not data or (data.endswith(b"\n") and reference[name].startswith(data)):
                continue
        elif stem == "statistics.json":
            try:
                json.loads(data)
                continue
            except ValueError:
                pass
        elif stem.endswith(".pvd"):
            try:
                shown = {entry.get("file") for entry in xml.etree.ElementTree.fromstring(data).iter("DataSet")}
                if all(f"{name.rpartition('/')[0]}/{frame}" in found for frame in shown):
                    continue
            except xml.etree.ElementTree.ParseError:
                pass
        elif stem in ("checkpoint", "checkpoint.old") and data.startswith(b"Taut checkpoint"):
            continue  # the run that resumes reads it
        yield name


class Scenario:
    """A command, what is in the folder before it, and how to go on after a fault."""

    def __init__(self, scratch, name, command, resume, reference, before=None, keeps=()):
        self.name, self.before, self.reference, self.keeps = name, before, reference, keeps
        self.program = Program(arguments.library, scratch, arguments.program, *command)
        self.resume = Program(arguments.library, scratch, arguments.program, *resume)

    def check(self, fault, n):
        what = f"{self.name}, {fault} {n}"
        result = self.program.run(fault, n, self.before)
        if result.failed == 0:
            expect(f"{what}: nothing failed", result.code == 0, ending(result.code))
            return
        figures["injected"] += 1
        found = contents(self.program.folder)
        before = contents(self.before) if self.before else {}
        figures["clean"] += self.is_clean(what, fault, n, result)
        damaged = list(damages(found, self.reference, before)) + [name for name in self.keeps if name not in found]
        figures["damaged"] += len(damaged)
        expect(f"{what}: damaged", not damaged, damaged)
        figures["resumed"] += 1
        again = self.resume.run_in(self.program.folder)
        found = contents(self.program.folder)
        different = [name for name in {**found, **self.reference} if found.get(name) != self.reference.get(name)]
        if not expect(f"{what}: goes on to the same bytes", again.code == 0 and not different, f"{again.err} {different}"):
            figures["other bytes"] += 1

    def is_clean(self, what, fault, n, result):
        lines = result.err.splitlines()
        line = lines[0] if lines else ""
        if not expect(f"{what}: one line and exit code 1", result.code == 1 and len(lines) == 1 and line.startswith("taut: "),
                      f"{ending(result.code)} {result.err}"):
            return False
        failed = [path for _, path in result.operations[n - 1:]] if fault in ("full", "short") else [result.operations[n - 1][1]]
        # Of a folder whose new names do not get to the disk, the file that has the name.
        names = [f"{path.rpartition('/')[2]}" + ("" if (self.program.folder / path).is_dir() else "'") for path in failed]
        return expect(f"{what}: file, reason and remedy", any(name in line for name in names) and "cannot " in line and
                      ("check that" in line or "name another" in line), f"{line} {failed[0]}")

    def check_files(self, rng):
        operations = self.program.run("files", 0, self.before).operations
        n_checked = 0
        for n in range(1, len(operations) + 1):
            for fault in ("EIO", "ENOSPC", "short", "full"):
                if rng.random() < arguments.files:
                    self.check(fault, n)
                    n_checked += 1
        print(f"{self.name}: {len(operations)} operations on files, {n_checked} faults", flush=True)

    def end(self):
        self.program.end()
        self.resume.end()


def reference_of(scratch, command):
    program = Program(arguments.library, scratch, arguments.program, *command)
    result = program.run()
    if result.code != 0:
        sys.exit(f"the run without a fault: {ending(result.code)}\n{result.err}")
    operations = result.operations
    kept = scratch / "complete"
    program.folder.rename(kept)
    # The same run until its disk is full, most of the way.
    program.run("full", 3 * len(operations) // 4)
    partial = scratch / "partial"
    program.folder.rename(partial)
    program.end()
    return contents(kept), kept, partial


with tempfile.TemporaryDirectory() as name:
    rng = random.Random(arguments.seed)
    print(f"seed {arguments.seed}")
    for kind, command in (("run", LINE), ("sweep", SWEEP)):
        scratch = pathlib.Path(name) / kind
        scratch.mkdir()
        reference, complete, partial = reference_of(scratch, command)
        resume = [*command, "--resume"]
        keeps = [name for name in contents(partial) if not name.endswith((".tmp", "checkpoint")) and "/worker_" not in name]
        scenarios = [Scenario(scratch, f"new {kind}", command, resume, reference),
                     Scenario(scratch, f"resumed {kind}", resume, resume, reference, partial, keeps),
                     Scenario(scratch, f"{kind} with --overwrite", [*command, "--overwrite"], resume, reference, complete)]
        for scenario in scenarios:
            scenario.check_files(rng)
        for scenario in scenarios:
            scenario.end()

# A mesh of 3.6e6 elements, in twice of what the program needs to start.
limit = 2**31
result = subprocess.run([str(word) for word in (arguments.program, *LINE, *entries("Catenary/Contact wire/Element size=5e-5"))],
                        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)), capture_output=True, text=True)
expect("a run that is larger than its memory", result.returncode == 1 and "more memory than there is" in result.stderr and
       result.stderr.count("\n") == 1, f"{ending(result.returncode)} {result.stderr}")
print(f"figure | faults of files | {figures['injected']} injected, {figures['clean']} clean errors")
print(f"figure | files | {figures['damaged']} damaged; {figures['resumed']} runs resumed, {figures['other bytes']} to other bytes")
expect("there are faults", figures["injected"])
finish()
