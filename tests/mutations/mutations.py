#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Breaks the code on purpose, one line at a time, and sees whether a test fails.

The list says for each change its file, the old and the new fragment of one line, the test program to build and the
GoogleTest filter of the cases that have to fail; with "ranks", the number of MPI processes that run the program. With
--check nothing is built: every change has to fit the sources exactly once, and every filter has to name cases that
exist. Without it the sources are copied to a folder, the programs are built and have to pass as they are; then one
change after the other is made, built, tested and undone. A folder of an earlier run is brought up to date. Ends with 0
if every change was caught."""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--root", type=pathlib.Path, required=True, help="folder of the project")
parser.add_argument("--list", type=pathlib.Path, default=pathlib.Path(__file__).with_name("mutations.json"))
parser.add_argument("--check", action="store_true", help="only see that the list fits the sources")
parser.add_argument("--folder", type=pathlib.Path, help="scratch folder for the copy and its build")
parser.add_argument("--only", default="", help="regular expression: changes of these files or with these names")
parser.add_argument("--mpiexec", default="mpirun", help="what starts the ranks of MPI")
parser.add_argument("--jobs", default="2", help="compilers at a time")
parser.add_argument("--limit", type=float, default=300., help="time of one test; one that does not end has failed [s]")
arguments = parser.parse_args()

root = arguments.root.resolve()
changes = json.loads(arguments.list.read_text())


def cases_of(root):
    """Suite.case of every GoogleTest case, by the program that its source file belongs to."""
    result = {}
    for file in sorted((root / "tests").rglob("CMakeLists.txt")):
        for program, text in re.findall(r'taut_add_(?:mpi_)?tests\((\w+)\s+\w+\s+(?:"[^"]*"\s+)?([^)]*)\)',
                                        file.read_text()):
            for source in text.split():
                path = pathlib.Path(source.replace("${PROJECT_SOURCE_DIR}", str(root)))
                code = (file.parent / path).read_text()
                result.setdefault(program, []).extend(
                    f"{suite}.{case}" for suite, case in re.findall(r"\bTEST(?:_F)?\((\w+),\s*(\w+)\)", code))
                # Typed cases are called Suite/<number>.case.
                result[program] += [f"{suite}/0.{case}"
                                    for suite, case in re.findall(r"\bTYPED_TEST\((\w+),\s*(\w+)\)", code)]
    return result


def problem_of(change, cases):
    """Why a change of the list cannot be made; empty if it can."""
    file = root / change["file"]
    if not file.is_file():
        return "there is no such file"
    if "\n" in change["old"] + change["new"] or change["old"] == change["new"]:
        return "the change is not one line made different"
    count = file.read_text().count(change["old"])
    if count != 1:
        return f"the old text occurs {count} times instead of once"
    if change["target"] not in cases:
        return f"no test program is called {change['target']}"
    for part in change["filter"].split(":"):
        pattern = re.compile(re.escape(part).replace(r"\*", ".*").replace(r"\?", "."))
        if not any(pattern.fullmatch(case) for case in cases[change["target"]]):
            return f"no case of {change['target']} matches {part}"
    return ""


cases = cases_of(root)
errors = [f"{change['change']} ({change['file']}): {problem}" for change in changes
          if (problem := problem_of(change, cases))]
names = [change["change"] for change in changes]
errors += [f"{name}: comes twice" for name in sorted(set(names)) if names.count(name) > 1]
print(len(changes), "changes of", len({change["file"] for change in changes}), "files")
if errors or arguments.check:
    sys.exit("\n".join(errors) or None)

if not arguments.folder:
    sys.exit("--folder is missing")
# The build lies in the copy as in a fresh clone: a compiler cache then knows most of it.
source = arguments.folder.resolve()
build = source / "build"
environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "DEAL_II_NUM_THREADS": "1",
               "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_btl": "^tcp",
               "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe"}


def bring_up_to_date():
    """Files with the same content keep their times, so that little is built again."""
    names = ("CMakeLists.txt", "README.md", "source", "include", "prm", "tests", "doc")
    files = {f.relative_to(root) for name in names for f in [root / name, *(root / name).rglob("*")] if f.is_file()}
    for old in [f for name in names for f in (source / name).rglob("*") if f.is_file()]:
        if old.relative_to(source) not in files:
            old.unlink()
    for name in files:
        original, copy = root / name, source / name
        if not copy.is_file() or copy.read_bytes() != original.read_bytes():
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(original, copy)


def run(command, **options):
    return subprocess.run(command, env=environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options)


def compile(target):
    return run(["cmake", "--build", build, "--target", target, "--parallel", arguments.jobs])


def test(change, limit):
    """The first case that fails, and how many; None if all pass."""
    program = next(p for p in build.rglob(change["target"]) if p.is_file())
    command = [program, "--gtest_color=no", "--gtest_filter=" + change["filter"]]
    if "ranks" in change:
        command = [arguments.mpiexec, "-np", str(change["ranks"]), *command]
    # Ends by SIGTERM, which mpiexec passes on to its ranks.
    with subprocess.Popen(command, env=environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          cwd=build) as process:
        try:
            output, _ = process.communicate(timeout=limit)
        except subprocess.TimeoutExpired:
            process.terminate()
            process.communicate()
            return "does not end", 1
    # A failed case has its line twice: when it ends, with its time, and in the list at the end.
    failed = [case for case in re.findall(r"^\[  FAILED  \] ([\w/]+\.\w+).*\(\d+ ms\)$", output, re.MULTILINE)]
    if process.returncode == 0:
        return None
    return (failed[0], len(failed)) if failed else (f"{change['filter']} (ends with {process.returncode})", 1)


bring_up_to_date()
configured = run(["cmake", "-S", source, "-B", build, "-G", "Ninja"])
if configured.returncode:
    sys.exit(configured.stdout)
wanted = [c for c in changes if re.search(arguments.only, c["change"] + " " + c["file"])]
for target in sorted({change["target"] for change in wanted}):
    built = compile(target)
    if built.returncode:
        sys.exit(built.stdout)
for target in sorted({change["target"] for change in wanted}):
    changes_of_target = [change for change in wanted if change["target"] == target]
    filters = sorted({change["filter"] for change in changes_of_target})
    if failure := test({**changes_of_target[0], "filter": ":".join(filters)}, 10. * arguments.limit):
        sys.exit(f"{failure[0]} of {target} fails without any change")

survivors = 0
for change in wanted:
    file = source / change["file"]
    original = file.read_text()
    begin = time.time()
    file.write_text(original.replace(change["old"], change["new"]))
    built = compile(change["target"])
    if built.returncode:
        survivors += 1
        outcome = "ERROR: does not compile\n" + built.stdout[-2000:]
    elif failure := test(change, arguments.limit):
        others = f" and {failure[1] - 1} more" if failure[1] > 1 else ""
        outcome = f"caught by `{failure[0]}`{others}"
    else:
        survivors += 1
        outcome = f"SURVIVED {change['target']} {change['filter']}"
    file.write_text(original)
    print(f"{change['change']}: {outcome} ({time.time() - begin:.0f} s)", flush=True)
print(f"{len(wanted) - survivors} of {len(wanted)} changes caught")
sys.exit(1 if survivors else 0)
