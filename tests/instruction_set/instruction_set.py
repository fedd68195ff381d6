#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The log names the instruction set of the loops; two runs with one set give the same files byte by byte; the baseline
set, which TAUT_INSTRUCTION_SET chooses, gives the same results up to rounding; a set that there is not is an error."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).parents[1]))
from checks import errors, finish, largest_difference, parse

arguments = parse(__doc__, "program", "scene")

# The scene amplifies rounding, 1e-16, by its contacts; what a wrong loop gives differs by far more.
ROUNDING = 1e-7


def run(folder, name=None, code=0):
    environment = {**os.environ, "TAUT_INSTRUCTION_SET": name} if name is not None else dict(os.environ)
    if name is None:
        environment.pop("TAUT_INSTRUCTION_SET", None)
    done = subprocess.run([arguments.program, arguments.scene, "--set", "Time/End=0.5", "--set", "Statistics/Window=",
                           "--set", f"Output/Folder={folder}"], capture_output=True, text=True, env=environment)
    if done.returncode != code:
        sys.exit(f"TAUT_INSTRUCTION_SET = {name}: exit code {done.returncode}, expected {code}\n{done.stderr}")
    found = re.search(r"instruction set of the loops: (.*)", done.stdout)
    return found.group(1) if found else "", done.stderr


with tempfile.TemporaryDirectory() as name:
    scratch = pathlib.Path(name)
    best, _ = run(scratch / "first")
    run(scratch / "second")
    baseline, _ = run(scratch / "baseline", "baseline")
    run(scratch / "baseline again", "baseline")
    if not best or not baseline.startswith("baseline (TAUT_INSTRUCTION_SET)"):
        errors.append(f"the log names '{best}' and '{baseline}'")
    tables = sorted(p.name for p in (scratch / "first").glob("*.csv"))
    if not tables:
        errors.append("no tables")
    worst = 0.
    for table in tables:
        if (scratch / "first" / table).read_bytes() != (scratch / "second" / table).read_bytes():
            errors.append(f"{table}: two runs with {best} differ")
        if (scratch / "baseline" / table).read_bytes() != (scratch / "baseline again" / table).read_bytes():
            errors.append(f"{table}: two runs with {baseline} differ")
        if table != "certificate.csv":  # its numbers are rounding
            worst = max(worst, largest_difference(scratch / "first" / table, scratch / "baseline" / table))
    print(f"figure | {best} and baseline, tables | {worst:.1e} 1")
    if not worst < ROUNDING:
        errors.append(f"{best} and baseline differ by {worst:.1e}")
    # Where there are several sets, that they differ at all shows that the variable chooses.
    if best != "baseline" and worst == 0.:
        errors.append(f"{best} and baseline give the same bits: is one of them never used?")
    _, message = run(scratch / "none", "neon", 1)
    if "TAUT_INSTRUCTION_SET" not in message or "baseline or avx2" not in message or (scratch / "none").exists():
        errors.append(f"an unknown set: {message}")

finish()
