#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The picture of doc/decomposition.md, from its table of an iteration on many ranks and from that of whole runs on two ranks: what a
rank has and sends at constant work a rank, and what a second rank gains."""
import argparse
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).parents[2] / "source/plot"))
from matplotlib import pyplot as plt
from taut_plot_style import BLUE, GREY, ORANGE, panels, set_style

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--doc", type=pathlib.Path, default=pathlib.Path(__file__).parents[2] / "doc")
parser.add_argument("--output", type=pathlib.Path, help="doc/figures/ranks.png if not given")
arguments = parser.parse_args()


def rows(page, head):
    """The cells of the table whose head begins so."""
    lines = (arguments.doc / page).read_text(encoding="utf-8").splitlines()
    first = next(i for i, line in enumerate(lines) if line.startswith(head)) + 2
    for line in lines[first:]:
        if not line.startswith("|"):
            return
        yield [cell.strip() for cell in line.strip("|").split("|")]


counts = [[float(cell) for cell in row] for row in rows("decomposition.md", "| ranks | parts | multipliers |")]
runs = list(rows("results/decomposition.md", "| problem | unknowns | one rank [s] |"))
steps = list(rows("results/decomposition.md", "| unknowns | us per step, one rank |"))

set_style()
figure, grid = panels(1, 2.4, 2)
left, right = grid[0]
ranks = [row[0] for row in counts]
left.loglog(ranks, [row[2] for row in counts], "s--", color=GREY, label="multipliers of all ranks")
left.loglog(ranks, [row[3] for row in counts], "o-", color=BLUE, label="multipliers of a rank, at most")
left.loglog(ranks, [row[5] for row in counts], "o-", color=ORANGE, label="messages of a rank in an iteration")
left.set_xticks(ranks, [f"{n:g}" for n in ranks])
left.minorticks_off()
left.set_ylim(2, 3e5)
left.set_xlabel("ranks, with 8 or 4 parts each")
left.legend()
names = [f"{name.partition(',')[0]}, {unknowns}" for name, unknowns, *_ in runs] + [f"steps of a line, {row[0]}" for row in steps]
parts = [float(row[3]) / float(row[2]) for row in runs] + [float(row[2].replace(" ", "")) / float(row[1].replace(" ", "")) for row in steps]
places = range(len(names))
right.barh(places, parts, color=BLUE, height=0.6)
right.axvline(0.5, color=GREY, linewidth=0.8)
right.axvline(1, color=GREY, linewidth=0.8)
right.set_yticks(places, names)
right.invert_yaxis()
right.set_xlabel("time on two ranks over that on one")
figure.savefig(arguments.output or arguments.doc / "figures/ranks.png", dpi=150)
plt.close(figure)
