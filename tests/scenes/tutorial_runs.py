#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pages that run as they stand: blocks `prm NAME` and `csv NAME` are files, the lines of a block `sh` run, and each line of a
block `text` after it is a line of what they print or write."""
import pathlib
import shlex
import shutil
import subprocess
import sys

sys.path.append(str(pathlib.Path(__file__).parents[1]))
from checks import errors, expect, finish, parse
from quotes import blocks, same_line

arguments = parse(__doc__, "page", "program", "folder")
shutil.rmtree(arguments.folder, ignore_errors=True)
arguments.folder.mkdir(parents=True)
printed, n_runs, n_lines = [], 0, 0
for mark, lines in blocks(arguments.page):
    kind, _, name = mark.partition(" ")
    if name:
        (arguments.folder / name).write_text("\n".join(lines) + "\n", encoding="utf-8")
    elif kind == "sh":
        printed = []
        for line in lines:
            program, *rest = shlex.split(line)
            expect("commands are 'build/taut ...'", program == "build/taut", line)
            done = subprocess.run([str(arguments.program.resolve()), *rest], cwd=arguments.folder, text=True, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT)
            expect(line, done.returncode == 0, done.stdout[-1500:])
            printed += done.stdout.splitlines()
            n_runs += 1
    elif kind == "text":
        for line in lines:
            n_lines += 1
            expect(f"{arguments.page.name} quotes\n  {line}\nwhich is not printed", any(same_line(line, other) for other in printed))
print(n_runs, "commands,", n_lines, "lines compared")
expect("a page runs and quotes", n_runs > 0 and n_lines > 0)
finish()
