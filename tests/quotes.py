# SPDX-License-Identifier: LGPL-2.1-or-later
"""What pages quote of the program: their blocks, and whether a quoted line is a printed one."""
import re

NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w])")
ROUNDING = 1e-9


def blocks(path):
    """(mark, lines) of the fenced blocks of a page, in order."""
    found, current = [], None
    for line in path.read_text(encoding="utf-8").splitlines():
        if current is None and line.startswith("```"):
            current = (line[3:].strip(), [])
        elif line.startswith("```"):
            found.append(current)
            current = None
        elif current is not None:
            current[1].append(line)
    return found


def same_number(quoted, printed):
    if re.fullmatch(r"[-+]?\d+", quoted):
        return quoted == printed
    a, b = float(quoted), float(printed)
    if 0 < abs(a) < ROUNDING or 0 < abs(b) < ROUNDING:
        return max(abs(a), abs(b)) < ROUNDING
    last = 0 if "e" in quoted else 10.0 ** -len(quoted.partition(".")[2])
    return abs(a - b) <= max(2.01 * last, 1e-3 * abs(a))


def same_line(quoted, printed):
    words = ([" ".join(part.split()) for part in NUMBER.split(line)] for line in (quoted, printed))
    if list(next(words)) != list(next(words)):
        return False
    return all(map(same_number, NUMBER.findall(quoted), NUMBER.findall(printed)))
