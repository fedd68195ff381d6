# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of a sweep for taut-plot: quantities over one entry as curves, over two as maps, of random samples as
distributions with their percentiles."""

import csv
import os
import re
import textwrap

import numpy as np
from taut_plot_files import UserError, read_entries, read_units
from taut_plot_style import BLUE, MOST_PANELS, ORANGE, Page, scale_of
from taut_plot_style import panels as rows_of_panels

MOST_TICKS = 8  # with the values of all zipped entries
LEAST_CHANGE = 1e-3  # of a quantity that is drawn unasked, over its largest value
PERCENTILES = (5, 50, 95)
MOST_BARS = 24  # cases
MOST_LETTERS = 44  # of a value beside a bar
# Coefficients of Largest mean force that Statistics/Supply stands for, as parameters.md has them; without a limit up to v1 for DC.
SUPPLIES = {"AC": (0.00047, 90, 200, 0.00097, 70), "DC 3 kV": (None, None, 200, 0.00097, 110), "DC 1.5 kV": (None, None, 200, 0.00097, 140)}
KM_PER_H = 3.6  # of 1 m/s
# What is drawn if nobody asks for more, in this order: of sliding contacts, of probes, of links.
FIRST = ("mean", "standard deviation", "maximum", "contact loss", "largest", "largest force")


def numbers_of(text):
    return tuple(float(word) for word in text.split(",")) if text.strip() else ()


def mean_force_limit(coefficients, speed):
    """Over speeds [m/s], 'a, b' for a v^2 + b with v in km/h, 'a, b, v1, c, d' for c v^2 + d above v1; not a number: none [N]."""
    v = KM_PER_H * speed
    a, b = coefficients[:2]
    low = np.full(v.shape, np.nan) if a is None else a * v**2 + b
    return low if len(coefficients) == 2 else np.where(v > coefficients[2], coefficients[3] * v**2 + coefficients[4], low)


class Sweep:
    """sweep.csv: whole lines only; cases that failed are left out of the numbers."""

    def __init__(self, folder):
        try:
            with open(os.path.join(folder, "sweep.csv"), newline="", encoding="utf-8") as file:
                text = file.read()
            entries = read_entries(os.path.join(folder, "sweep.prm"))
            units = read_units(os.path.join(folder, "sweep.prm"))
        except OSError as error:
            raise UserError(f"'{folder}' holds no whole sweep: {error}") from error
        rows = list(csv.reader(text[:text.rfind("\n") + 1].splitlines()))
        if len(rows) < 2 or any(len(row) != len(rows[0]) for row in rows):
            raise UserError(f"the sweep in '{folder}' has no cases, or is damaged")
        self.columns = rows[0]
        self.failed = sum(1 for row in rows[1:] if row[-1])
        self.rows = [row for row in rows[1:] if not row[-1]]
        if not self.rows:
            raise UserError(f"all cases of the sweep in '{folder}' failed; sweep.csv says why")
        self.quantities = [name for name in self.columns if re.search(r": .* \[.*\]$", name)]
        varied = self.columns[1:self.columns.index(self.quantities[0])] if self.quantities else []
        self.heads = {re.sub(r" \[[^]]*\]$", "", head): head for head in varied}
        self.parameters = list(self.heads)
        self.is_random = int(entries.get("Sweep/Samples", "0")) > 0
        self.is_zipped = entries.get("Sweep/Combination") == "zipped" and not self.is_random
        self.mean_force_limits = [(label, coefficients) for label, coefficients in (
            ("largest mean, as given", numbers_of(entries.get("Statistics/Largest mean force", ""))),
            ("least mean, as given", numbers_of(entries.get("Statistics/Least mean force", "")))) if coefficients]
        supply = entries.get("Statistics/Supply", "none")
        if supply in SUPPLIES and not entries.get("Statistics/Largest mean force", ""):
            self.mean_force_limits.append((f"largest mean, {supply}, after EN 50367", SUPPLIES[supply]))
        self.moving = {key[:-len("/Speed")].rpartition("/")[2].partition(" ")[2] for key in entries if key.endswith("/Speed")}
        self.entries_of = {name: entries.get(f"Sweep/Parameter {name}/Entries", "") for name in self.parameters}
        self.units = {name: units.get(entries.get(f"Sweep/Parameter {name}/Entries", "").partition(",")[0].strip(), "")
                      for name in self.parameters}

    def label(self, parameter):
        """Its name with its unit; of units that depend, as [N/m, N m/rad], the first one."""
        unit = self.units[parameter].partition(",")[0]
        return f"{parameter} [{unit}]" if unit else parameter

    def text(self, name):
        return [row[self.columns.index(self.heads.get(name, name))] for row in self.rows]

    def scaled(self, quantity):
        """Its numbers in the unit that they are written best in, and its name with this unit."""
        name, _, unit = quantity[:-1].rpartition(" [")
        values = self.values(quantity)
        factor, unit = scale_of([values], unit) if unit in ("m", "N", "N m", "rad") else (1.0, unit)
        return factor * values, f"{name} [{unit}]"

    def values(self, name):
        """Numbers of a column; None if there are others."""
        try:
            return np.array([float(value) for value in self.text(name)])
        except ValueError:
            return None

    def chosen(self, wanted):
        """The quantities to draw: those that contain the text, or the first of the usual ones that vary."""
        if wanted:
            found = [name for name in self.quantities if wanted in name]
            if not found:
                raise UserError(f"--quantity {wanted}: the sweep has none; it has, for instance, {self.quantities[0]}")
            return found[:MOST_PANELS]
        usual = [name for kind in FIRST for name in self.quantities if re.search(f": {kind} \\[", name)]
        usual = [name for name in usual if np.ptp(self.values(name)) > LEAST_CHANGE * np.abs(self.values(name)).max()]
        of_links = [name for name in usual if ": largest force [" in name]
        return ([name for name in usual if name not in of_links] or of_links or self.quantities)[:MOST_PANELS]


def panels(n, height=2.1):
    columns = 1 if n == 1 or Page.is_column else 2
    figure, grid = rows_of_panels((n + columns - 1) // columns, height, columns)
    for panel in grid.flat[n:]:
        panel.set_visible(False)
    return figure, list(grid.flat[:n])


def curves(sweep, quantities, parameter):
    """Over one entry; a curve for each combination of the others, of zipped ones a single one."""
    x = sweep.values(parameter)
    others = [name for name in sweep.parameters if name != parameter and len(set(sweep.text(name))) > 1]
    zipped = others if sweep.is_zipped else []
    others = [] if sweep.is_zipped else others
    keys = list(zip(*(sweep.text(name) for name in others))) if others else [()] * len(x)
    figure, grid = panels(len(quantities), 2.4 if zipped else 2.1)
    for panel, quantity in zip(grid, quantities):
        y, label = sweep.scaled(quantity)
        for key in dict.fromkeys(keys):
            mine = np.array([i for i, k in enumerate(keys) if k == key])
            mine = mine[np.argsort(x[mine], kind="stable")]
            panel.plot(x[mine], y[mine], "o-", markersize=3, color=None if others else BLUE,
                       label=", ".join(f"{name} {value}" for name, value in zip(map(sweep.label, others), key)))
        panel.set_xlabel(sweep.label(parameter))
        if zipped:
            zipped_axis(panel, sweep, parameter, zipped)
        panel.set_ylabel(label.replace(": ", ":\n"))
        if quantity.endswith(": mean [N]") and quantity[:-len(": mean [N]")] in sweep.moving and sweep.entries_of[parameter].partition(",")[0].strip().endswith("/Speed"):
            draw_limits(panel, sweep, x)
    if others and len(set(keys)) <= 8:
        grid[0].legend()
    return figure


def draw_limits(panel, sweep, speeds):
    """Limits of the mean force over the speed."""
    at = np.linspace(speeds.min(), speeds.max(), 200)
    for label, coefficients in sweep.mean_force_limits:
        panel.plot(at, mean_force_limit(coefficients, at), "--", color=ORANGE, linewidth=0.8, label=label)
    if sweep.mean_force_limits:
        panel.legend(fontsize=7)


def zipped_axis(panel, sweep, parameter, others):
    """Says below the values of an entry which ones of the others go with them."""
    x, names = sweep.text(parameter), [sweep.label(name) for name in (parameter, *others)]
    lines = [tuple(sweep.text(name)[i] for name in (parameter, *others)) for i in range(len(x))]
    if len(set(lines)) <= MOST_TICKS and len(set(x)) == len(set(lines)):
        panel.set_xticks([float(line[0]) for line in lines], ["\n".join(line) for line in lines])
        panel.set_xlabel(" / ".join(names))
    else:
        ends = [f"{name} {sweep.text(other)[0]} to {sweep.text(other)[-1]}" for name, other in zip(names[1:], others)]
        panel.set_xlabel(f"{names[0]}; with it {', '.join(ends)}")


def maps(sweep, quantities, first, second):
    """Over two entries: a field for each pair of values."""
    x, y = sweep.values(first), sweep.values(second)
    xs, ys = np.unique(x), np.unique(y)
    figure, grid = panels(len(quantities), 2.4)
    for panel, quantity in zip(grid, quantities):
        field = np.full((len(ys), len(xs)), np.nan)
        values, label = sweep.scaled(quantity)
        field[np.searchsorted(ys, y), np.searchsorted(xs, x)] = values
        image = panel.pcolormesh(xs, ys, field, shading="nearest", cmap="viridis")
        figure.colorbar(image, ax=panel, label=label.replace(": ", ":\n"))
        panel.set_xlabel(sweep.label(first))
        panel.set_ylabel(sweep.label(second))
    return figure


def distributions(sweep, quantities):
    """The part of the cases below each value."""
    figure, grid = panels(len(quantities))
    for panel, quantity in zip(grid, quantities):
        values, label = sweep.scaled(quantity)
        values = np.sort(values)
        panel.step(values, 100 * np.arange(1, len(values) + 1) / len(values), where="post", color=BLUE)
        for percentile in PERCENTILES:
            at = np.percentile(values, percentile)
            panel.plot([at, at], [0, percentile], color=ORANGE, linewidth=0.8)
            panel.annotate(f"{percentile} %: {at:.4g}", (at, percentile), xytext=(-4 if percentile > 50 else 4, -2),
                           ha="right" if percentile > 50 else "left", textcoords="offset points", fontsize=7)
        panel.set_ylim(0, 103)
        panel.set_xlabel(label)
        panel.set_ylabel("cases below [%]")
    return figure


def bars(sweep, quantities):
    """A bar for each case, where no entry has numbers that differ: formulas, names, files."""
    texts = [name for name in sweep.parameters if len(set(sweep.text(name))) > 1]
    cases = list(zip(*(sweep.text(name) for name in texts))) if texts else [(row[0],) for row in sweep.rows]
    names = ["\n".join(textwrap.shorten(text, MOST_LETTERS, placeholder=" ...") for text in case) for case in cases]
    longest = max(len(line) for name in names for line in name.split("\n"))
    figure, grid = rows_of_panels(len(quantities), 0.4 + 0.18 * len(cases) * max(1, len(texts)))
    for panel, quantity in zip(grid[:, 0], quantities):
        values, label = sweep.scaled(quantity)
        panel.barh(np.arange(len(cases)), values, color=BLUE, height=0.6)
        panel.set_yticks(np.arange(len(cases)), names, fontsize=7 if longest > 20 else None)
        panel.set_ylim(len(cases) - 0.5, -0.5)
        panel.set_xlabel(label)
        panel.set_ylabel(", ".join(map(sweep.label, texts)) if texts else "case")
    return figure


def sweep_picture(folder, options):
    """The figure of a sweep and what is to be said of it."""
    sweep = Sweep(folder)
    quantities = sweep.chosen(options.quantity)
    varied = [name for name in sweep.parameters if sweep.values(name) is not None and len(set(sweep.text(name))) > 1]
    pairs = {tuple(pair) for pair in zip(*(sweep.text(name) for name in varied))}
    if not varied and not sweep.is_random and len(sweep.rows) <= MOST_BARS:
        figure = bars(sweep, quantities)
    elif sweep.is_random or not varied:
        figure = distributions(sweep, quantities)
    elif len(varied) == 2 and len(sweep.parameters) == 2 and not sweep.is_zipped and \
            min(len(set(sweep.text(name))) for name in varied) > 2 and len(pairs) > 8:
        figure = maps(sweep, quantities, *varied)
    else:
        figure = curves(sweep, quantities, max(varied, key=lambda name: len(set(sweep.text(name)))))
    if sweep.failed:
        print(f"{sweep.failed} cases failed and are left out; sweep.csv says why")
    return figure, None
