#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A run that a signal or an error ends early has the results of a run with that end, marked as partial; a second signal
ends it at once. Expected numbers come from that shorter run; exit codes are 128 plus the signal, and 1."""
import csv
import json
import math
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

sys.path.append(str(pathlib.Path(__file__).parents[1]))
from checks import entries, errors, expect, on_ranks, parse

arguments = parse(__doc__, "program", "mpiexec", "prm")

LINE = [str(arguments.prm / "en50318_2002_250.prm"), "--set", "Statistics/Window="]
STEP = entries("Time/Step=2e-5", "Time/End=0.5")  # 25000 steps: none is done before the signal comes
# Seconds before the first step.
LARGE = [*LINE, *entries("Catenary/Number of spans=100", "Catenary/Contact wire/Element size=0.1")]
FAILING = """set Generator = network
set Start     = given
subsection Network
  set Masses  = block
  set Springs = spring
  set Loads   = push
  subsection Mass block
    set Motions = y
    set Mass    = 2
  end
  subsection Spring spring
    set To        = block
    set Stiffness = 200
  end
  subsection Load push
    set On        = block
    set Magnitude = 1 / (t < 0.505)
  end
end
subsection Time
  set Step = 0.01
  set End  = 2
end
"""
# A mass on a soft prop is thrown at its anchor: 1 m - 2 m sin(10 t).
MEETING = """set Generator = network
set Gravity   = 0, 0
set Start     = given
subsection Network
  set Masses = ball
  set Links  = prop
  subsection Mass ball
    set Position         = 1, 0
    set Motions          = x, y, z
    set Mass             = 1
    set Initial velocity = -20, 0, 0
  end
  subsection Link prop
    set Type      = stop
    set From      = ground @ 0, 0
    set To        = ball
    set Turns     = true
    set Length    = 1
    set Stiffness = 100
  end
end
subsection Time
  set Step = 1e-3
  set End  = 1
end
"""
# What the error says, and between which times it comes: that of a push that becomes infinite in mid-run and those of MEETING.
ERRORS = [(FAILING, "push", .5, .5),
          (MEETING, r"taut: .*t = 0\.052\d* s: the ends of link 'prop' meet.*\(0, 0, 0\) m", .052, .0524)]
PATIENCE = 1200.  # [s]; ranks that share a busy core wait for each other at every step


class Program:
    """A program that runs; its two outputs go to files."""

    def __init__(self, folder, options, ranks=1):
        self.out, self.err = folder / "out", folder / "err"
        command = on_ranks(arguments.mpiexec, ranks, [arguments.program, *options])
        with open(self.out, "w") as out, open(self.err, "w") as err:
            self.process = subprocess.Popen(command, stdout=out, stderr=err)

    def wait_for(self, condition):
        end = time.monotonic() + PATIENCE
        while not condition():
            if self.process.poll() is not None or time.monotonic() > end:
                self.process.kill()
                sys.exit(f"too early or late: {self.process.args}\n{self.out.read_text()[-2000:]}\n{self.err.read_text()}")
            time.sleep(0.01)

    def says(self, pattern):
        self.wait_for(lambda: re.search(pattern, self.out.read_text() + self.err.read_text(), re.MULTILINE))

    def catches_signals(self):
        """Waits until the program has its own handler of SIGINT."""
        status = pathlib.Path(f"/proc/{self.process.pid}/status")
        mask = 1 << (signal.SIGINT - 1)
        self.wait_for(lambda: int(re.search(r"SigCgt:\s*(\w+)", status.read_text())[1], 16) & mask)

    def end(self):
        """Exit code, after which outputs are complete."""
        try:
            return self.process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self.process.kill()
            return "no end"


def rank_pid(mpirun, rank):
    """Process id of a rank."""
    children = pathlib.Path(f"/proc/{mpirun}/task/{mpirun}/children").read_text().split()
    for child in children:
        environment = pathlib.Path(f"/proc/{child}/environ").read_bytes().split(b"\0")
        if f"OMPI_COMM_WORLD_RANK={rank}".encode() in environment:
            return int(child)
    sys.exit(f"no rank {rank} under mpirun")


def statistics(folder):
    path = folder / "statistics.json"
    if not path.exists():
        errors.append(f"no {path}")
        return {"partial": None, "until": math.nan}
    return json.loads(path.read_text())


def check_partial(what, program, results, has_log=True):
    """What must be there after an early end; returns until when."""
    found = statistics(results)
    until = found["until"]
    expect(f"{what}: marked as partial", found["partial"] is True, found["partial"])
    said = re.search(r"^Partial results: until t = (\S+) s of", program.out.read_text(), re.MULTILINE)
    # mpirun of Open MPI 5 that gets a signal itself passes it on, and no output after it.
    expect(f"{what}: the log says until when",
           math.isclose(float(said[1]), until, rel_tol=1e-5) if said else not has_log, said)
    lines = (results / "certificate.csv").read_text().splitlines()
    expect(f"{what}: the tables reach the end", math.isclose(float(lines[-1].split(",")[0]), until), lines[-1])
    return until


def check_same(what, results, options, folder, tolerance):
    """The tables are those of a run with this end."""
    until = statistics(results)["until"]
    shorter = folder / "shorter"
    subprocess.run([arguments.program, *options, "--set", f"Time/End={until}", "--set", f"Output/Folder={shorter}"],
                   check=True, stdout=subprocess.DEVNULL)
    full = statistics(shorter)
    expect(f"{what}: a run to its end is not partial", full["partial"] is False, full["partial"])
    expect(f"{what}: same end", math.isclose(full["until"], until), (full["until"], until))
    for table in ("sliding.csv", "links.csv", "supports.csv", "probes.csv"):
        with open(results / table) as f, open(shorter / table) as g:
            a, b = list(csv.reader(f)), list(csv.reader(g))
        expect(f"{what}: {table} has all lines", len(a) == len(b), (len(a), len(b)))
        worst = max(abs(float(x) - float(y)) / max(1., abs(float(y))) for p, q in zip(a[1:], b[1:])
                    for x, y in zip(p, q))
        expect(f"{what}: {table} is that of a run with this end", worst <= tolerance, worst)


def check_signal(folder, number):
    """One process."""
    options = [*LINE, *STEP, "--set", "Output/Observers=energy"]
    results = folder / "results"
    program = Program(folder, [*options, "--set", f"Output/Folder={results}"])
    program.says(r" [1-9]\d %  t = ")
    program.process.send_signal(number)
    code = program.end()
    expect(f"{number.name}: exit code", code == 128 + number, code)
    said = [line for line in program.err.read_text().splitlines() if line]
    expect(f"{number.name}: one line when it comes, one when it ends",
           len(said) == 2 and re.match(rf"taut: ended by {number.name} after the step at t = ", said[1]), said)
    until = check_partial(number.name, program, results)
    energies = (results / "energy.csv").read_text().splitlines()
    expect(f"{number.name}: energies reach the end", math.isclose(float(energies[-1].split(",")[0]), until), energies[-1])
    check_same(number.name, results, options, folder, 0.)


def check_ranks(folder, number, rank):
    """Two processes; the signal goes to one of them, or to mpirun (None), which has its own exit code."""
    options = [*LINE, "--set", "Time/Step=1e-4"]  # the run must not end while mpirun passes the signal on
    results = folder / "results"
    program = Program(folder, [*options, "--set", f"Output/Folder={results}"], 2)
    program.says(r"^  10 %  t = ")  # whole lines: mpirun passes no others on
    what = f"{number.name} to {'mpirun' if rank is None else f'rank {rank}'}"
    pid = program.process.pid
    os.kill(pid if rank is None else rank_pid(pid, rank), number)
    code = program.end()
    expect(f"{what}: exit code", code == 128 + number if rank is not None else code != 0, code)
    if rank is not None:
        said = [line for line in program.err.read_text().splitlines() if line.startswith("taut: ended by")]
        expect(f"{what}: one line says so", len(said) == 1 and number.name in said[0], said)
    check_partial(what, program, results, has_log=rank is not None)
    check_same(what, results, options, folder, 1e-7)


def check_second_signal(folder, first, second):
    results = folder / "results"
    program = Program(folder, [*LARGE, "--set", f"Output/Folder={results}"])
    program.catches_signals()
    program.process.send_signal(first)
    program.says("A second signal ends at once")
    begin = time.monotonic()
    program.process.send_signal(second)
    code = program.end()
    seconds = time.monotonic() - begin
    expect("second signal: exit code", code == 128 + second, code)
    expect("second signal: at once", seconds < 0.5, seconds)
    print(f"figure | end after a second signal | {seconds:.3f} s")


def check_before_start(folder, option):
    """Nothing is written by what has computed no step."""
    results = folder / "results"
    program = Program(folder, [*LARGE, *option, "--set", f"Output/Folder={results}"])
    program.catches_signals()
    program.process.send_signal(signal.SIGINT)
    code = program.end()
    what = f"SIGINT before the first step {option}"
    expect(f"{what}: exit code", code == 130, code)
    expect(f"{what}: says so", "before the first step; nothing was written" in program.err.read_text(),
           program.err.read_text())
    expect(f"{what}: nothing written", not results.exists())


def check_error(folder, ranks, text, words, begin, end):
    """An error in mid-run, after the step at begin and not later than end."""
    scene, results = folder / "failing.prm", folder / "results"
    scene.write_text(text)
    program = Program(folder, [str(scene), "--set", f"Output/Folder={results}"], ranks)
    code = program.end()
    what = f"error of {words} on {ranks} ranks"
    expect(f"{what}: exit code", code == 1, code)
    expect(f"{what}: it is said", re.search(words, program.err.read_text()), program.err.read_text())
    until = check_partial(what, program, results)
    expect(f"{what}: until the step before", begin - 1e-9 <= until <= end + 1e-9, until)


def check_study(folder):
    scene = [LINE[0], "--study", "--set", "Time/End=0.5", "--set", "Statistics/Window=",
             "--set", "Study/Reference levels=2", "--set", "Study/Accuracy=0", "--set", f"Study/Folder={folder}/study",
             "--set", "Study/Parameter step/Values=4e-3, 2e-3, 5e-4"]
    program = Program(folder, scene)
    program.says(r"^  scheme = BDF2")
    program.process.send_signal(signal.SIGINT)
    code = program.end()
    expect("study: exit code", code == 130, code)
    said = re.search(r"taut: study ended by SIGINT with (\d+) of (\d+) settings measured", program.err.read_text())
    expect("study: says so", said, program.err.read_text())
    found = json.loads((folder / "study" / "study.json").read_text())
    n = len(found["settings"])
    expect("study: marked as partial", found["partial"] is True, found["partial"])
    expect("study: keeps what was measured", said and n == int(said[1]) and 2 <= n < int(said[2]), n)
    expect("study: each setting has its error and cost",
           all("message" in s or s["error"] >= 0. and s["seconds"] > 0. for s in found["settings"]), found["settings"])
    rows = (folder / "study" / "work_precision.csv").read_text().splitlines()
    expect("study: table", len(rows) == n + 1, len(rows))
    expect("study: no left-over run", not (folder / "study" / "run").exists())


with tempfile.TemporaryDirectory() as name:
    cases = [(check_signal, signal.SIGINT), (check_signal, signal.SIGTERM),
             (check_ranks, signal.SIGINT, 1), (check_ranks, signal.SIGTERM, 0), (check_ranks, signal.SIGTERM, None),
             (check_ranks, signal.SIGINT, None),
             (check_second_signal, signal.SIGINT, signal.SIGINT), (check_second_signal, signal.SIGINT, signal.SIGTERM),
             (check_before_start, []), (check_before_start, ["--check"]),
             *((check_error, ranks, *error) for ranks in (1, 2) for error in ERRORS), (check_study,)]
    for i, (check, *options) in enumerate(cases):
        folder = pathlib.Path(name) / str(i)
        folder.mkdir()
        begin = time.monotonic()
        check(folder, *options)
        print(f"{check.__name__} {str(options)[:40]}: {time.monotonic() - begin:.1f} s", flush=True)

sys.exit("\n".join(error[:2000] for error in errors) or None)
