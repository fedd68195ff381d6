#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every test that a page names exists: in columns 'test' of tables, and behind the word 'test'. A name is a case of GoogleTest or
the beginning of one, a test of ctest, a program, or a file."""
import argparse
import fnmatch
import pathlib
import re
import sys

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--root", type=pathlib.Path, required=True)
root = parser.parse_args().root.resolve()

NAME = re.compile(r"`([^`]+)`")
INLINE = re.compile(r"\btests? (`[^`]+`(?:(?:,| and|, and) `[^`]+`)*)")

cases = set()
for file in (root / "tests").rglob("*.cc"):
    for suite, case in re.findall(r"\b(?:TYPED_)?TEST(?:_[FP])?\(\s*(\w+),\s*(\w+)\s*\)", file.read_text(encoding="utf-8")):
        cases |= {f"{suite}.{case}", case}
lists = (root / "CMakeLists.txt", *(root / "tests").rglob("CMakeLists.txt"))
words = {word for file in lists for word in re.findall(r"[\w$]+", file.read_text(encoding="utf-8"))}
words |= {file.stem for file in (root / "prm").glob("*.prm")}


def exists(name):
    if (root / name).is_file() or any(fnmatch.fnmatchcase(case, name + "*") for case in cases):
        return True
    name = name.partition(" ")[0].removesuffix("/*")  # without arguments; all tests of a label
    word = name.rpartition("/")[2]
    return word in words or re.sub(r"_\d+$", "", word) in words


def named(page):
    """(number of the line, name) of each test that the page names."""
    column = None
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)] if line.startswith("|") else []
        if not cells:
            column = None
        elif column is None:
            column = next((i for i, cell in enumerate(cells) if cell in ("test", "tests")), -1)
        texts = [cells[column]] if cells and 0 <= column < len(cells) else INLINE.findall(line)
        for text in texts:
            yield from ((number, name) for name in NAME.findall(text))


errors, n_names = [], 0
for page in (root / "README.md", *sorted((root / "doc").rglob("*.md"))):
    before = None
    for number, name in named(page):
        n_names += 1
        # `Suite.first*`, `*second*`: the second is of the same suite.
        before = name.partition(".")[0] if "." in name else before
        if not exists(name) and not (name.startswith("*") and before and exists(f"{before}.{name}")):
            errors.append(f"{page}:{number}: '{name}': there is no such test")
print(n_names, "names of tests")
if not n_names:
    errors.append("no names of tests found")
sys.exit("\n".join(errors) or None)
