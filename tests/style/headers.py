#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every public header compiles alone, without the private ones, and doc/library.md has a row for each."""
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--root", type=pathlib.Path, required=True)
parser.add_argument("--build", type=pathlib.Path, required=True)
arguments = parser.parse_args()

for entry in json.loads((arguments.build / "compile_commands.json").read_text()):
    if "CMakeFiles/taut.dir/" in entry["command"]:
        break
else:
    sys.exit("no file of the library in compile_commands.json")
command = shlex.split(entry["command"])
for option in ("-o", "-c"):
    at = command.index(option)
    del command[at:at + 2]
private = f"-I{(arguments.root / 'source').resolve()}"
if private not in command:
    sys.exit(f"the library is compiled without {private}: private headers are no longer kept away from public ones")
command.remove(private)
command += ["-O0", "-Werror", "-fsyntax-only", "-x", "c++", "-"]


def check(header):
    result = subprocess.run(command, input=f"#include <{header}>\n", cwd=entry["directory"], text=True,
                            stderr=subprocess.PIPE)
    return "" if result.returncode == 0 else f"{header} does not compile alone:\n{result.stderr}"


include = arguments.root / "include"
headers = sorted(h.relative_to(include) for h in include.rglob("*.h"))
print(len(headers), "headers")
if not headers:
    sys.exit("no headers found")
listed = re.findall(r"^\| ([a-z_/0-9]+\.h) \|", (arguments.root / "doc/library.md").read_text(), re.M)
differing = sorted({str(h) for h in headers} ^ {f"taut/{name}" for name in listed})
if differing:
    sys.exit("only in include/, or only in the table of doc/library.md: " + ", ".join(differing))
with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
    sys.exit("".join(pool.map(check, headers)) or None)
