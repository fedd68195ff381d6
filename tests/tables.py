# SPDX-License-Identifier: LGPL-2.1-or-later
"""Compares tables of two results folders."""
import csv
import math


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
