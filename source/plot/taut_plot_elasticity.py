# SPDX-License-Identifier: LGPL-2.1-or-later
"""The picture of 'taut --elasticity' for taut-plot: static uplift over force along each contact wire."""

import csv
import json
import os

import numpy as np
from taut_plot_files import UserError
from taut_plot_style import BLUE, ORANGE, RED, legend_below, panels

FILES = ("elasticity.csv", "elasticity.json")


def has_elasticity(folder):
    return all(os.path.exists(os.path.join(folder, file)) for file in FILES)


def read_elasticity(folder):
    """The force [N], whether droppers may slacken, and {wire: (x [m], elasticity [mm/N])}."""
    table, summary = (os.path.join(folder, file) for file in FILES)
    try:
        with open(table, newline="", encoding="utf-8") as file:
            lines = list(csv.DictReader(file))
        with open(summary, encoding="utf-8") as file:
            said = json.load(file)
        wires = {}
        for line in lines:
            wires.setdefault(line["wire"], []).append((float(line["x [m]"]), 1e3 * float(line["elasticity [m/N]"])))
        return said["force"]["value"], said["slackening"], {wire: np.transpose(points) for wire, points in wires.items()}
    except (OSError, KeyError, TypeError, ValueError) as error:
        raise UserError(f"the elasticity in '{folder}' is damaged: {error!r}") from error


def elasticity(folder):
    """Nothing for a folder without it."""
    if not has_elasticity(folder):
        return None, None
    force, slackening, wires = read_elasticity(folder)
    if not wires:
        return None, "elasticity.csv has no places"
    figure, grid = panels(len(wires), 2.2)
    for panel, (wire, (x, e)) in zip(grid[:, 0], wires.items()):
        high, low = e.argmax(), e.argmin()
        panel.plot(x, e, color=BLUE)
        handles = [*panel.plot(x[high], e[high], "o", color=RED, markersize=4, label=r"$e_\mathrm{max}$"),
                   *panel.plot(x[low], e[low], "o", color=ORANGE, markersize=4, label=r"$e_\mathrm{min}$")]
        uniform = 100 * (e[high] - e[low]) / (e[high] + e[low])
        panel.set_title(rf"wire '{wire}': $e_\mathrm{{max}}$ {e[high]:.3g} mm/N at {x[high]:g} m, "
                        rf"$e_\mathrm{{min}}$ {e[low]:.3g} mm/N at {x[low]:g} m, u {uniform:.3g} %", loc="left")
        panel.set_ylabel("elasticity [mm/N]")
        panel.margins(x=0)
        panel.set_ylim(bottom=0)
    may = "may slacken" if slackening else "stay closed"
    grid[-1, 0].set_xlabel(f"position [m]; force {force:g} N, droppers {may}")
    legend_below(grid[-1, 0], 1.9, handles)
    return figure, None
