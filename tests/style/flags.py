#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The flags that count in compile_commands.json are Taut's, not those deal.II was built with; every source file is
compiled."""
import argparse
import json
import pathlib
import re
import shlex
import sys

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--root", type=pathlib.Path, required=True)
parser.add_argument("--build", type=pathlib.Path, required=True)
parser.add_argument("--type", required=True, help="Debug or Release")
parser.add_argument("--native", type=int, required=True)
parser.add_argument("--werror", type=int, required=True)
parser.add_argument("--sanitize", default="", help="sanitizers, separated by commas")
parser.add_argument("--own", default="", help="CMAKE_CXX_FLAGS: what the user asked for")
arguments = parser.parse_args()


def sources(file):
    """The file, or those of a batch."""
    if file.parent.name != "Unity":
        return [file]
    return [pathlib.Path(included) for included in re.findall(r'^#include "(.*)"$', file.read_text(), re.MULTILINE)]


own = shlex.split(arguments.own)
errors, compiled = [], set()
for entry in json.loads((arguments.build / "compile_commands.json").read_text()):
    file = pathlib.Path(entry["file"])
    own_files = [f for f in sources(file) if arguments.root in f.parents and arguments.build not in f.parents]
    if not own_files:
        continue
    compiled.update(own_files)
    flags = shlex.split(entry["command"])

    def require(condition, what):
        if not condition:
            errors.append(f"{file}: {what}")

    # The time of a test goes into the library, that of a benchmark into its own loops, too.
    target = flags[flags.index("-o") + 1]
    is_test = target.startswith("tests/") and not target.startswith("tests/benchmarks/")
    allowed = {"Release": ["-O3"] + ["-O1"] * is_test, "Debug": ["-O0"]}[arguments.type]
    levels = [f for f in flags if f.startswith("-O")]
    require(levels and levels[-1] in allowed, f"the last of {levels} is none of {allowed}")
    debug = [f for f in flags if f.startswith("-g") and f != "-g0" and f not in own]
    require(bool(debug) == (arguments.type == "Debug"), f"debug flags {debug} in a {arguments.type} build")
    machines = [f for f in flags if f.startswith("-march=") and f not in own]
    require(machines == ["-march=native"] * arguments.native, f"machine flags {machines}")
    require(("-Werror" in flags) == bool(arguments.werror), "-Werror is not as TAUT_WERROR says")
    sanitizers = [f for f in flags if f.startswith("-fsanitize=") and f not in own]
    require(sanitizers == [f"-fsanitize={arguments.sanitize}"] * bool(arguments.sanitize), f"sanitizers {sanitizers}")
    for flag in ("-Wall", "-Wextra", "-std=c++17"):
        require(flag in flags, f"{flag} is missing")

for folder in ("source", "tests"):
    for file in (arguments.root / folder).rglob("*.cc"):
        install = arguments.root / "tests" / "install"  # a project of its own
        peer = arguments.root / "tests" / "benchmarks" / "moordyn" / "peer.cc"  # of MoorDyn; compare.py compiles it
        if file not in compiled and install not in file.parents and file != peer:
            errors.append(f"{file}: is not compiled; name it in a CMakeLists.txt")

print(len(compiled), "files")
if not compiled:
    errors.append("no file of Taut in compile_commands.json")
sys.exit("\n".join(errors) or None)
