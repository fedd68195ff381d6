# SPDX-License-Identifier: LGPL-2.1-or-later
"""The picture of a study for taut-plot: error against cost."""

import numpy as np
from matplotlib.lines import Line2D
from taut_plot_files import read_study
from taut_plot_style import BLACK, BLUE, COLOURS, GREEN, GREY, ORANGE, PINK, RED, SKY, legend_below, panels

# A scheme has its colour in every study; other names take those that are left, in the order of the alphabet.
SCHEMES = {"generalised-alpha": BLUE, "BDF2": ORANGE, "HHT": GREEN, "Newmark": RED, "backward Euler": PINK, "Moreau-Jean": SKY,
           "gaps, then velocities": BLACK}


def is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True


def work_precision(folder, _=None):
    """Error against cost: a colour for each scheme, model or other name. Small dots are single errors; lines join the
    settings that are Pareto-optimal within their colour, by the largest error of a setting and of all finer ones."""
    parameters, settings, end = read_study(folder)
    settings = [s for s in settings if s["error [1]"] > 0]
    if not settings:
        return None, "no setting ran"
    named = [parameter["name"] for parameter in parameters if not all(is_number(value) for value in parameter["values"])
             and len(parameter["values"]) > 1]
    figure, grid = panels(1, 3.7)
    panel = grid[0, 0]
    groups = {}
    for setting in settings:
        groups.setdefault(tuple(setting[name] for name in named), []).append(setting)
    first = sorted({names[0] if names else "settings" for names in groups}, key=lambda name: (name not in SCHEMES, name))
    free = [colour for colour in COLOURS if colour not in {SCHEMES.get(name) for name in first}]
    colours = {name: SCHEMES[name] if name in SCHEMES else free.pop(0) if free else GREY for name in first}
    rest = sorted({", ".join(f"{a}: {b}" for a, b in zip(named[1:], names[1:])) for names in groups})
    handles = [Line2D([], [], color=colours[name], label=name) for name in first]
    if len(rest) > 1:
        handles += [Line2D([], [], color=GREY, linewidth=0, marker="osD^vP*X"[i % 8], markersize=4, label=name)
                    for i, name in enumerate(rest)]
    for names, group in groups.items():
        colour = colours[names[0] if names else "settings"]
        marker = "osD^vP*X"[rest.index(", ".join(f"{a}: {b}" for a, b in zip(named[1:], names[1:]))) % 8]
        group.sort(key=lambda s: s["seconds"])
        x, y, bound = (np.array([s[key] for s in group])
                       for key in ("seconds", "error [1]", "error of finer ones too [1]"))
        panel.plot(x, y, marker, color=colour, markersize=2.4, alpha=0.35, markeredgewidth=0)
        best = bound <= np.minimum.accumulate(bound)
        panel.plot(x[best], bound[best], marker + "-", color=colour, markersize=4)
    front = sorted((s for s in settings if s["front"]), key=lambda s: s["seconds"])
    handles += panel.plot([s["seconds"] for s in front], [s["error of finer ones too [1]"] for s in front], color=BLACK,
                          linewidth=0.9, linestyle="--", zorder=3, label="Pareto-optimal")
    uncertain = max(s["error of the reference [1]"] for s in settings)
    panel.set_xscale("log")
    panel.set_yscale("log")
    # Single errors that are small by chance, or exact, do not set the scale.
    low, high = min(s["error of finer ones too [1]"] for s in settings) / 10, panel.get_ylim()[1]
    if uncertain > 0:
        low = min(low, uncertain / 2)
        handles.append(panel.axhspan(low / 10, uncertain, color=GREY, alpha=0.2, linewidth=0,
                                     label="error of the reference"))
    panel.set_ylim(low, high)
    panel.set_xlabel("processor time of the steps without output [s]")
    panel.set_ylabel("relative error [1]")
    top = panel.secondary_xaxis("top", functions=(lambda s: end / np.maximum(s, 1e-300),
                                                  lambda f: end / np.maximum(f, 1e-300)))
    top.set_xlabel("times real time")
    legend_below(panel, 3.2, handles, most=3)
    return figure, None
