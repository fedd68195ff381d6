#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every C++ file is as clang-format leaves it."""
import argparse
import pathlib
import subprocess
import sys

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--root", type=pathlib.Path, required=True)
parser.add_argument("--clang-format", required=True)
parser.add_argument("--fix", action="store_true", help="format the files instead")
arguments = parser.parse_args()

files = [f for folder in ("include", "source", "tests") for f in (arguments.root / folder).rglob("*.[ch]*")
         if f.suffix in (".h", ".cc")]
if not files:
    sys.exit("no C++ files found")
print(len(files), "files")
options = ["-i"] if arguments.fix else ["--dry-run", "-Werror"]
sys.exit(subprocess.call([arguments.clang_format] + options + files))
