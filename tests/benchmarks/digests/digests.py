#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Digests of all scenes: a change that touches no arithmetic leaves each of them as it is.

    digests.py --program build/tests/benchmarks/digests --record FILE     writes them
    digests.py --program build/tests/benchmarks/digests --compare FILE    says which differ

Each scene of prm/ runs in one process with each representation of F, and on two ranks; the matrix of
extreme scenes counts by its verdicts. Hashes depend on compiler, libraries and instruction set:
compare what one machine has recorded. TAUT_INSTRUCTION_SET is set to baseline."""
import argparse
import concurrent.futures
import os
import pathlib
import subprocess
import sys

FORMS = ["assembled dense", "assembled sparse", "matrix-free"]
ENTRY = "Solver/Interface operator"


def run(command):
    environment = dict(os.environ, TAUT_INSTRUCTION_SET="baseline", OPENBLAS_NUM_THREADS="1",
                       OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                       OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_btl="^tcp",
                       PRTE_MCA_rmaps_default_mapping_policy=":oversubscribe", OMPI_MCA_mpi_yield_when_idle="1")
    try:
        result = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=1500)
    except subprocess.TimeoutExpired:
        return ["- timeout"]
    lines = result.stdout.split("\n")
    if result.returncode != 0:
        lines.append(f"- ended with {result.returncode}: {result.stderr.strip()[-200:]}")
    return [line for line in lines if line]


def jobs(program, scenes):
    for scene in scenes:
        for form in FORMS:
            yield f"1 {form}", [program, "--set", f"{ENTRY}={form}", str(scene)]
        yield "2 automatic", ["mpirun", "-np", "2", program, str(scene)]
    yield "1 verdicts", [program, "--extremes"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", required=True)
    parser.add_argument("--prm", default="prm")
    parser.add_argument("--only", default="", help="scenes whose names have this text")
    parser.add_argument("--jobs", type=int, default=2)
    action = parser.add_mutually_exclusive_group(required=True)
    action.add_argument("--record", metavar="FILE")
    action.add_argument("--compare", metavar="FILE")
    arguments = parser.parse_args()
    scenes = [s for s in sorted(pathlib.Path(arguments.prm).glob("*.prm")) if arguments.only in s.stem]
    work = [(how, command) for how, command in jobs(arguments.program, scenes)
            if not arguments.only or how != "1 verdicts"]
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        results = list(pool.map(lambda job: run(job[1]), work))
    found = {}
    for (how, _), lines in zip(work, results):
        for line in lines:
            name, rest = line.split(" ", 1)
            found[f"{how} | {name}"] = rest
    if arguments.record:
        pathlib.Path(arguments.record).write_text(
            "".join(f"{key} | {value}\n" for key, value in found.items()))
        return 0
    stored = {}
    for line in pathlib.Path(arguments.compare).read_text().splitlines():
        how, name, value = line.split(" | ", 2)
        stored[f"{how} | {name}"] = value
    changed = [key for key in found if stored.get(key) != found[key]]
    for key in changed:
        print(f"{key}: {stored.get(key, 'not recorded')} -> {found[key]}")
    print(f"{len(found) - len(changed)} of {len(found)} digests are the same")
    return 1 if changed else 0


if __name__ == "__main__":
    sys.exit(main())
