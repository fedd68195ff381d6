#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every C++ file is as clang-format 14 leaves it. Other versions format otherwise: there the test is skipped."""
import argparse
import pathlib
import re
import subprocess
import sys

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--root", type=pathlib.Path, required=True)
parser.add_argument("--clang-format", required=True)
parser.add_argument("--fix", action="store_true", help="format the files instead")
arguments = parser.parse_args()

VERSION = 14  # of Debian 12
SKIPPED = 77  # exit code, as CMakeLists.txt says
found = subprocess.run([arguments.clang_format, "--version"], capture_output=True, text=True, check=True).stdout.strip()
if not re.search(rf"version {VERSION}\.", found):
    print(f"skipped: the format is that of clang-format {VERSION}, and this is '{found}'")
    sys.exit(1 if arguments.fix else SKIPPED)

files = [f for folder in ("include", "source", "tests") for f in (arguments.root / folder).rglob("*.[ch]*")
         if f.suffix in (".h", ".cc")]
if not files:
    sys.exit("no C++ files found")
print(len(files), "files")
options = ["-i"] if arguments.fix else ["--dry-run", "-Werror"]
sys.exit(subprocess.call([arguments.clang_format] + options + files))
