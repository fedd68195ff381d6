#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""One rank of 2 or 4 throws in a collective call of MPI drawn at random: all ranks end, with exit code 1 and the message of that rank, said once."""
import collections
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).parents[1]))
from checks import entries, expect, finish, parse

arguments = parse(__doc__, "program", "library", "prm", "mpiexec",
                  count=(2, "faults of each kind, on 2 and on 4 ranks"), seed=(1, ""))
figures = collections.Counter()
PATIENCE, GRACE = 180., 10.  # of a run, and of an mpirun that is to end [s]: twelve of them are below the limit of the test
Result = collections.namedtuple("Result", "returncode stderr")


def run(folder, ranks, fault):
    command = [arguments.mpiexec, "-np", str(ranks), "env", f"LD_PRELOAD={arguments.library}", arguments.program,
               arguments.prm / "en50318_2002_250.prm", "--overwrite", *entries("Catenary/Number of spans=3", "Catenary/Contact wire/Element size=2", "Catenary/Messenger wire/Element size=2",
                  "Catenary/Uplift positions=90", "Statistics/Window=", "Time/Step=2e-3", "Time/End=0.1",
                  "Partition/Number of substructures=4", "Output/Folder=results", "Output/Checkpoint interval=0.03")]
    # Into files: ranks that outlive their mpirun would keep a pipe open for ever.
    with open(folder / "out", "w") as out, open(folder / "err", "w") as err:
        process = subprocess.Popen([str(word) for word in command], cwd=folder, stdout=out, stderr=err,
                                   env={**os.environ, "TAUT_FAULT": fault, "TAUT_FAULT_COUNT": str(folder / "count")})
        try:
            code = process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            process.terminate()  # mpirun ends its ranks
            try:
                process.wait(GRACE)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
            return None
    return Result(code, (folder / "err").read_text(errors="replace"))


def calls_of(folder, ranks, kind, rank):
    """Number of calls of a rank in a run without a fault."""
    path = folder / "count"
    path.unlink(missing_ok=True)
    result = run(folder, ranks, f"{kind} 0 {rank}")
    if result is None or result.returncode != 0:
        sys.exit(f"the run without a fault: {result}")
    return int(path.read_text())


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    rng = random.Random(arguments.seed)
    print(f"seed {arguments.seed}")
    for ranks in (2, 4):
        n_calls = calls_of(folder, ranks, "collectives", ranks - 1)
        for fault, message in (("throw", "internal error: injected into a collective call"),
                               ("throw_user", "taut: injected into a collective call")):
            for _ in range(arguments.count):
                rank, n = rng.randrange(ranks), rng.randint(1, n_calls)
                what = f"{fault} {n} of {n_calls} on rank {rank} of {ranks}"
                result = run(folder, ranks, f"{fault} {n} {rank}")
                figures[fault, "injected"] += 1
                if not expect(f"{what}: ends", result is not None):
                    continue
                # The rank that ends the others has mpirun send them a signal, of which they say that they got it. What
                # mpirun itself says may begin the line.
                said = re.findall(r"taut: (?!ending;)[^\n]*", result.stderr)
                figures[fault, "clean"] += expect(f"{what}: one message, exit code 1",
                                                  result.returncode == 1 and len(said) == 1 and message in said[0],
                                                  f"{result.returncode} {said} {result.stderr}")

for fault in ("throw", "throw_user"):
    print(f"figure | one rank of 2 or 4, {fault} | {figures[fault, 'injected']} injected, {figures[fault, 'clean']} clean errors")
finish()
