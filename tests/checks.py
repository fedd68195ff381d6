# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the tests in Python share: their command line, what they expect, and comparisons of tables."""
import argparse
import csv
import importlib.util
import math
import pathlib
import sys
from importlib.machinery import SourceFileLoader

errors = []


def parse(description, *required, **optional):
    """The arguments: paths that are required, and name=(default, help) of those that are not."""
    parser = argparse.ArgumentParser(description=description)
    for name in required:
        parser.add_argument(f"--{name}", type=pathlib.Path, required=True)
    for name, (default, text) in optional.items():
        kind = {"action": "store_true"} if default is False else {"type": type(default), "default": default}
        parser.add_argument(f"--{name}", help=text, **kind)
    return parser.parse_args()


def expect(what, is_true, found=""):
    """An error with what was found is kept if something is not true."""
    if not is_true:
        errors.append(f"{what}: {str(found)[:1500]}")
    return is_true


def finish():
    """Ends the test, with all errors."""
    sys.exit("\n".join(errors) or None)


def entries(*given, **values):
    """--set for each entry, "Section/Entry=value" or Section__Entry=value, with _ for blanks."""
    given = [*given, *(f"{path.replace('__', '/').replace('_', ' ')}={value}" for path, value in values.items())]
    return [word for entry in given for word in ("--set", entry)]


def on_ranks(mpiexec, ranks, command):
    return [str(word) for word in (command if ranks == 1 else [mpiexec, "-np", ranks, *command])]


def largest_difference(one, many):
    """Of the numbers of a table, each over the largest one of its column's unit."""
    with open(one) as f, open(many) as g:
        a, b = list(csv.reader(f)), list(csv.reader(g))
    if a[0] != b[0] or len(a) != len(b):
        return math.inf
    worst = 0.
    units = {}
    for c, title in enumerate(a[0]):
        unit = title[title.rfind("["):]
        for row in a[1:]:
            try:
                units[unit] = max(units.get(unit, 0.), abs(float(row[c])))
            except ValueError:
                pass
    for p, q in zip(a[1:], b[1:]):
        for c, title in enumerate(a[0]):
            size = units.get(title[title.rfind("["):], 0.)
            if p[c] == q[c] or size == 0.:
                continue
            try:
                error = abs(float(p[c]) - float(q[c]))
                if error > 1e-15 or math.isnan(error):  # what stands still does so up to rounding
                    worst = math.inf if math.isnan(error) else max(worst, error / size)
            except ValueError:
                return math.inf
    return worst


def load_plot(script):
    """taut-plot as a module."""
    loader = SourceFileLoader("taut_plot", str(script))
    plot = importlib.util.module_from_spec(importlib.util.spec_from_loader("taut_plot", loader))
    sys.dont_write_bytecode = True
    loader.exec_module(plot)
    return plot
