# SPDX-License-Identifier: LGPL-2.1-or-later
"""Wires in space and the links between them at the start: seen from above and from the side."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.collections import LineCollection

from taut_plot_files import read_collection, read_links, read_vtu

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7")  # of Okabe and Ito
WIDTH = 6.3  # inches


def plan_and_elevation(results, _):
    """Nothing for wires in one vertical plane."""
    frames = read_collection(results.path("wires.pvd")) if results.has("wires.pvd") else []
    if not frames:
        return None, None
    points, displacement, wires, names = read_vtu(frames[0][1])
    now = points + displacement
    if np.ptp(now[:, 2]) <= 1e-6 * np.ptp(now, axis=0).max():
        return None, None
    links = read_links(read_collection(results.path("links.pvd"))[0][1]) if results.has("links.pvd") else []
    figure, panels = plt.subplots(2, 1, figsize=(WIDTH, 4.6), sharex=True)
    for panel, axis, label in zip(panels, (2, 1), ("z [m], from above", "y [m], from the side")):
        for (number, line), colour in zip(wires.items(), COLOURS * len(wires)):
            panel.plot(now[line, 0], now[line, axis], color=colour, label=f"wire '{names[number]}'")
        panel.add_collection(LineCollection([link[:, [0, axis]] for link in links], colors="#000000", linewidths=0.5,
                                            label="links"))
        panel.set_ylabel(label)
        panel.margins(x=0)
    panels[0].invert_yaxis()  # z comes towards who looks at the line from the side
    panels[1].set_xlabel("x [m]")
    panels[0].legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=4, borderaxespad=0.2)
    return figure, None
