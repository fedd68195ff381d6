#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Breaks the code on purpose, one piece at a time, and sees whether a test fails.

The list says for each change the function whose code is changed (`Class::function`, as much of its qualified name as
tells it from others), a pattern, the replacement, the test program to build and the GoogleTest filter of the cases that
have to fail; with "ranks", the number of MPI processes that run the program. Where a function is defined is found out,
by definitions.py. A pattern is a regular expression that has to fit once in the code of the functions of that name, the
overloads together, from and to whole words and signs. White space and line breaks do not count in it, and comments
and the insides of strings are no code. The replacement may name groups of the pattern: \\1, \\g<0>.

With --check nothing is built: every change has to fit the sources, and every filter has to name cases that exist. With
--sample a few changes only are made, to the text, and what does not fit is a line of the output and no error: it shows
that the list is read and applied, in spite of any layout of the sources. Without either the sources are copied to a
folder, the programs are built and have to pass as they are; then one change after the other is made, built, tested and
undone. A folder of an earlier run is brought up to date. Ends with 0 if every change fits and was caught."""
import argparse
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import time

sys.dont_write_bytecode = True  # no files beside the sources
import definitions

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--root", type=pathlib.Path, required=True, help="folder of the project")
parser.add_argument("--list", type=pathlib.Path, default=pathlib.Path(__file__).with_name("mutations.json"))
parser.add_argument("--check", action="store_true", help="only see that the list fits the sources")
parser.add_argument("--sample", type=int, metavar="N", help="only make N changes of the list, to the text")
parser.add_argument("--seed", type=int, default=1, help="chooses those of the sample")
parser.add_argument("--folder", type=pathlib.Path, help="scratch folder for the copy and its build")
parser.add_argument("--only", default="", help="regular expression: changes of these functions or with these names")
parser.add_argument("--mpiexec", default="mpirun", help="what starts the ranks of MPI")
parser.add_argument("--jobs", default="2", help="compilers at a time")
parser.add_argument("--limit", type=float, default=300., help="time of one test; one that does not end has failed [s]")
arguments = parser.parse_args()

root = arguments.root.resolve()
changes = json.loads(arguments.list.read_text())


class Sources:
    """Texts of files, by their names, and the functions that they define, by the last part of the names."""

    def __init__(self, texts):
        self.texts = texts
        self.functions = {}
        for file, text in texts.items():
            try:
                found = definitions.definitions_of(file, text)
            except ValueError as problem:
                print(f"no functions are read: {problem}")
                continue
            for definition in found:
                self.functions.setdefault(definition.name.split("::")[-1], []).append(definition)

    def place(self, change):
        """File, begin and end of what a change replaces, and the match of its pattern."""
        name = change["function"]
        named = [f for f in self.functions.get(name.split("::")[-1], []) if ("::" + f.name).endswith("::" + name)]
        if not named:
            raise DoesNotFit(f"no function is called {name}")
        pattern = definitions.pattern_of(change["pattern"])
        found = [(f.file, *match) for f in named
                 for match in definitions.Piece(self.texts[f.file], f.begin, f.end).matches(pattern)]
        if len(found) != 1:
            raise DoesNotFit(f"the pattern fits {len(found)} times in {name} instead of once"
                             + "".join(f", {file}:{self.line(file, begin)}" for file, begin, _, _ in found))
        return found[0]

    def line(self, file, place):
        return self.texts[file].count("\n", 0, place) + 1

    def changed(self, change, place):
        """The text of the file with one change."""
        file, begin, end, match = place
        return self.texts[file][:begin] + match.expand(change["replacement"]) + self.texts[file][end:]


class DoesNotFit(Exception):
    """Why a change of the list cannot be made."""


sources = Sources({file.relative_to(root): file.read_text() for folder in ("source", "include")
                   for file in sorted((root / folder).rglob("*")) if file.suffix in (".cc", ".h")})


def cases_of(root):
    """Suite.case of every GoogleTest case, by the program that its source file belongs to."""
    result = {}
    for file in sorted((root / "tests").rglob("CMakeLists.txt")):
        for program, text in re.findall(r'taut_add_(?:mpi_)?tests\((\w+)\s+\w+\s+(?:"[^"]*"\s+)?([^)]*)\)',
                                        file.read_text()):
            for source in re.sub(r"SHARDS \d+", "", text).split():
                path = pathlib.Path(source.replace("${PROJECT_SOURCE_DIR}", str(root)))
                code = (file.parent / path).read_text()
                result.setdefault(program, []).extend(
                    f"{suite}.{case}" for suite, case in re.findall(r"\bTEST(?:_F)?\((\w+),\s*(\w+)\)", code))
                # Typed cases are called Suite/<number>.case.
                result[program] += [f"{suite}/0.{case}"
                                    for suite, case in re.findall(r"\bTYPED_TEST\((\w+),\s*(\w+)\)", code)]
    return result


def check_test(change, cases):
    """The program and the cases of a change have to exist."""
    if change["target"] not in cases:
        raise DoesNotFit(f"no test program is called {change['target']}")
    for part in change["filter"].split(":"):
        pattern = re.compile(re.escape(part).replace(r"\*", ".*").replace(r"\?", "."))
        if not any(pattern.fullmatch(case) for case in cases[change["target"]]):
            raise DoesNotFit(f"no case of {change['target']} matches {part}")


def check_fit(change, cases):
    """The place of a change that can be made."""
    place = sources.place(change)
    if sources.changed(change, place) == sources.texts[place[0]]:
        raise DoesNotFit("the replacement is what is there")
    check_test(change, cases)
    return place


def spread(text):
    """The same code in another layout: each word and sign on a line of its own."""
    return "\n".join(match.group() for match in definitions.TOKEN.finditer(definitions.code_of(text)))


def check_list():
    """Errors of the list that no sources can be the reason of."""
    errors = []
    for change in changes:
        missing = {"change", "function", "pattern", "replacement", "target", "filter"} - set(change)
        unknown = set(change) - {"change", "function", "pattern", "replacement", "target", "filter", "ranks"}
        errors += [f"{change.get('change')}: no {key}" for key in sorted(missing)]
        errors += [f"{change.get('change')}: no entry is called {key}" for key in sorted(unknown)]
    names = [change.get("change") for change in changes]
    return errors + [f"{name}: comes twice" for name in sorted(set(names)) if names.count(name) > 1]


def try_sample():
    """Makes some changes to the text: in its own layout, and in one that no one would choose."""
    cases = cases_of(root)
    laid_out = Sources({file: spread(text) for file, text in sources.texts.items()})
    sample = random.Random(arguments.seed).sample(changes, min(arguments.sample, len(changes)))
    errors, n_made = [], 0
    for change in sample:
        try:
            place = check_fit(change, cases)
        except DoesNotFit as problem:
            print(f"{change['change']}: does not fit, {problem}")
            continue
        n_made += 1
        file, begin, end, match = place
        print(f"{change['change']}: {file}:{sources.line(file, begin)}, "
              f"{' '.join(sources.texts[file][begin:end].split())} -> {match.expand(change['replacement'])}")
        try:
            same = spread(laid_out.changed(change, laid_out.place(change))) == spread(sources.changed(change, place))
        except DoesNotFit as problem:
            errors.append(f"{change['change']}: in another layout, {problem}")
        else:
            errors += [] if same else [f"{change['change']}: another outcome in another layout"]
    print(f"{n_made} of {len(sample)} changes made to the text")
    return errors if n_made else ["no change of the sample could be made"]


errors = check_list()
if errors:
    sys.exit("\n".join(errors))
if arguments.sample is not None:
    sys.exit("\n".join(try_sample()) or None)

cases = cases_of(root)
places = {}
for change in changes:
    try:
        places[change["change"]] = check_fit(change, cases)
    except DoesNotFit as problem:
        errors.append(f"{change['change']}: {problem}")
print(len(places), "of", len(changes), "changes fit, in", len({place[0] for place in places.values()}), "files")
if arguments.check:
    sys.exit("\n".join(errors) or None)
for error in errors:
    print(error)

if not arguments.folder:
    sys.exit("--folder is missing")
# The build lies in the copy as in a fresh clone: a compiler cache then knows most of it.
source = arguments.folder.resolve()
build = source / "build"
environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "DEAL_II_NUM_THREADS": "1",
               "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_btl": "^tcp",
               "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe", "OMPI_MCA_mpi_yield_when_idle": "1"}


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
# A change may leave a name unused, and compiles its own file only.
configured = run(["cmake", "-S", source, "-B", build, "-G", "Ninja", "-D", "TAUT_WERROR=OFF", "-D", "TAUT_UNITY=OFF"])
if configured.returncode:
    sys.exit(configured.stdout)
wanted = [c for c in changes if c["change"] in places and re.search(arguments.only, c["change"] + " " + c["function"])]
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
    place = places[change["change"]]
    file = source / place[0]
    begin = time.time()
    file.write_text(sources.changed(change, place))
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
    file.write_text(sources.texts[place[0]])
    print(f"{change['change']}: {outcome} ({time.time() - begin:.0f} s)", flush=True)
print(f"{len(wanted) - survivors} of {len(wanted)} changes caught")
sys.exit(1 if survivors or errors else 0)
