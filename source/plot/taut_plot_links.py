# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of fixed links: their forces over time, all of them in one map, the ranges of droppers, links at the start."""

import matplotlib
import numpy as np
from taut_plot_files import UserError
from taut_plot_style import (BLUE, GREY, MOST_PANELS, ORANGE, RED, ROUNDING, legend_below, mark_places, panels, scale_of,
                             spans)

OPEN = "open (slack dropper, free stop)"


class Link:
    """A fixed link over time: force and gap where they were recorded, and between which values they were since then."""

    def __init__(self, table, name, what, gap_unit, unit):
        columns = table.columns
        self.name, self.unit = name, unit
        self.force = columns[f"{name} {what} [{unit}]"]
        gap = columns[f"{name} gap [{gap_unit}]"]
        self.least, self.largest = (columns.get(f"{name} {what} {end} [{unit}]", self.force) for end in ("least", "largest"))
        self.has_band = f"{name} {what} least [{unit}]" in columns
        # Nothing is carried and the ends are apart, at some time of the interval: a dropper is slack, a stop is free.
        self.is_open = (self.least == 0) & (columns.get(f"{name} gap largest [{gap_unit}]", gap) > 0)

    @property
    def change(self):
        """How far its force goes from that of the start."""
        return max(np.abs(self.least - self.force[0]).max(), np.abs(self.largest - self.force[0]).max())


class Magnitude:
    """The force of a joint, of which links.csv has components; between the times there only these are known."""

    has_band = False

    def __init__(self, name, components):
        self.name, self.unit = f"{name}, magnitude", components[0].unit
        self.force = self.least = self.largest = np.sqrt(sum(link.force**2 for link in components))
        self.is_open = np.zeros(len(self.force), bool)

    change = Link.change


def with_magnitudes(links):
    """One link in the place of the components of a joint, which are in its name 'NAME x', 'NAME y' and 'NAME z'."""
    parts = {}
    for link in links:
        name, blank, axis = link.name.rpartition(" ")
        key = (name, link.unit) if blank and axis in ("x", "y", "z") else (link.name, link.unit, link)
        parts.setdefault(key, []).append(link)
    return [of[0] if len(of) == 1 else Magnitude(key[0], of) for key, of in parts.items()]


def fixed_links(results):
    """Time, and the links of links.csv in order of the scene."""
    table = results.table("links.csv")
    if not table:
        return [], []
    kinds = ((" force [N]", "force", "m", "N"), (" moment [N m]", "moment", "rad", "N m"))
    found = [(list(table.columns).index(name + ending), Link(table, name, *kind))
             for ending, *kind in kinds for name, _ in table.series(ending)]
    return table.time, with_magnitudes([link for _, link in sorted(found, key=lambda pair: pair[0])])


def that_change(links):
    """Those whose force changes by more than rounding, or that open."""
    size = {unit: max(np.abs(link.largest).max() for link in links if link.unit == unit)
            for unit in {link.unit for link in links}}
    return [link for link in links if link.change > max(1e-12, ROUNDING * size[link.unit]) or
            0 < link.is_open.sum() < len(link.force)]


def chosen_links(links):
    """At most MOST_PANELS of the links that change, and what is said of the choice."""
    shown = that_change(links)
    still = len(links) - len(shown)
    said = f"; {still} do{'es' if still == 1 else ''} not change" if still else ""
    if len(shown) <= MOST_PANELS:
        return shown, f"{len(shown)} of {len(links)} links{said}" if still else None
    opened = sum(link.is_open.any() for link in shown)
    order = sorted(range(len(shown)), key=lambda i: (shown[i].is_open.sum(), shown[i].change))
    what = "have the forces that change most" if opened == 0 else "were open longest" if opened >= MOST_PANELS else \
        "were open, or have the forces that change most"
    return [shown[i] for i in sorted(order[-MOST_PANELS:])], f"the {MOST_PANELS} of {len(links)} links that {what}{said}"


def link_forces(results, _):
    time, links = fixed_links(results)
    if not links:
        return None, "no fixed links in this run"
    if len(time) < 2:
        return None, "links.csv has one line only"
    shown, said = chosen_links(links)
    if not shown:
        return None, f"the forces of all {len(links)} links change by rounding only"
    figure, grid = panels(len(shown), 0.95 if len(shown) > 1 else 1.6, sharex=True)
    units = {unit: scale_of([values for link in shown if link.unit == unit for values in (link.least, link.largest)], unit)
             for unit in dict.fromkeys(link.unit for link in shown)}
    labels = {unit: ("force" if unit == "N" else "moment") + f" [{name}]" for unit, (_, name) in units.items()}
    handles = {}
    for panel, link in zip(grid[:, 0], shown):
        factor = units[link.unit][0]
        for begin, end in spans(time, link.is_open):
            handles[OPEN] = panel.axvspan(begin, end, color=ORANGE, alpha=0.35, linewidth=0)
        if link.has_band:
            handles["between least and largest"] = panel.fill_between(
                time, factor * link.least, factor * link.largest, step="pre", color=BLUE, alpha=0.35, linewidth=0)
        panel.plot(time, factor * link.force, color=BLUE)
        low, high = factor * link.least.min(), factor * link.largest.max()
        if low <= 0 <= high or high - low > 0.3 * max(abs(low), abs(high)):
            panel.axhline(0, color=GREY, linewidth=0.5)
        panel.set_title(link.name, loc="left", pad=2)
        panel.margins(x=0)
        if len(units) > 1:
            panel.set_ylabel(labels[link.unit])
    if len(units) == 1:
        figure.supylabel(labels[shown[0].unit], fontsize=matplotlib.rcParams["axes.labelsize"])
    grid[-1, 0].set_xlabel("time [s]")
    if said:
        figure.suptitle(said, x=0.02, ha="left")
    if handles:
        legend_below(grid[-1, 0], 0.75 if len(shown) > 1 else 1.4, handles.values(), handles)
    return figure, None


def link_map(results, _):
    """All links over time: force minus that of the start, so that joints with large forces do not set the scale."""
    time, links = fixed_links(results)
    if len(links) <= MOST_PANELS:
        return None, None
    if len(time) < 2:
        return None, "links.csv has one line only"
    kinds = {link.unit for link in links}
    if not that_change(links):
        return None, f"the forces of all {len(links)} links change by rounding only"
    # The larger change of each interval, up or down.
    up, down = (np.array([getattr(link, end) - link.force[0] for link in links]) for end in ("largest", "least"))
    changes = np.where(np.abs(up) >= np.abs(down), up, down)
    opened = np.array([link.is_open & (link.largest == 0) for link in links])
    factor, unit = scale_of([changes], links[0].unit) if len(kinds) == 1 else (1.0, "N, N m")
    figure, grid = panels(1, 3.2)
    panel = grid[0, 0]
    colours = matplotlib.colormaps["RdBu_r"].copy()
    colours.set_bad("#000000")
    most = factor * np.percentile(np.abs(changes).max(axis=1), 98) or 1
    edges = np.concatenate([[time[0]], (time[1:] + time[:-1]) / 2, [time[-1]]])
    picture = panel.pcolormesh(edges, np.arange(len(links) + 1) + 0.5, np.ma.array(factor * changes, mask=opened),
                               cmap=colours, vmin=-most, vmax=most, rasterized=True)
    panel.set_xlabel("time [s]")
    ticks = np.unique(np.linspace(0, len(links) - 1, min(11, len(links))).astype(int))
    panel.set_yticks(ticks + 1, [links[i].name for i in ticks])
    panel.spines[["top", "right"]].set_visible(True)
    what = "force" if kinds == {"N"} else "moment" if kinds == {"N m"} else "force, moment"
    figure.colorbar(picture, label=f"{what} minus that of the start [{unit}]; black: open", pad=0.02, aspect=30,
                    extend="both" if factor * np.abs(changes).max() > 1.001 * most else "neither")
    return figure, None


def dropper_forces(results, _):
    """Between which forces each dropper was, over x; those that went slack in another colour."""
    _, links = fixed_links(results)
    places = results.places()
    droppers = [link for link in links if results.is_dropper(link.name) and link.name in places]
    if len({round(places[link.name], 6) for link in droppers}) < 3:
        return None, "no droppers at three places or more in this run"
    figure, grid = panels(1, 2.8)
    panel = grid[0, 0]
    factor, unit = scale_of([link.largest for link in droppers], "N")
    handles = {}
    for slack, colour, name in ((False, BLUE, "least to largest"), (True, ORANGE, "went slack")):
        mine = [link for link in droppers if link.is_open.any() == slack]
        if mine:
            x = [places[link.name] for link in mine]
            handles[name] = panel.vlines(x, [factor * link.least.min() for link in mine],
                                         [factor * link.largest.max() for link in mine], color=colour, linewidth=1.6)
            handles["at the start"], = panel.plot(x, [factor * link.force[0] for link in mine], "k_", markersize=4)
    panel.axhline(0, color=GREY, linewidth=0.5)
    panel.margins(x=0.02)
    handles.update((mark.get_label(), mark) for mark in mark_places(panel, results) if mark.get_label() == "masts")
    panel.set_xlabel("position [m]")
    panel.set_ylabel(f"dropper force [{unit}]")
    legend_below(panel, 2.4, handles.values(), handles)
    return figure, None


def read_start(results):
    """Names, x [m], force and unstressed length [m], NaN without one, of the links of start.csv."""
    lines = results.start()
    try:
        return [line["link"] for line in lines], *(np.array([float(line[key] or "nan") for line in lines])
                                                   for key in ("x [m]", "force [N or N m]", "length [m]"))
    except (KeyError, TypeError, ValueError) as error:
        raise UserError(f"'{results.path('start.csv')}' is damaged: {error!r}") from error


def static_links(results, _):
    if not results.start():
        return None, "no links in this scene"
    names, x, force, length = read_start(results)
    if len(np.unique(np.round(x, 6))) <= 0.6 * len(x) and len(x) <= 60:
        return links_by_name(names, force)
    known = length > 0
    figure, grid = panels(2 if known.any() else 1, 1.9 if known.any() else 2.2, sharex=True)
    panel = grid[0, 0]
    panel.vlines(x, 0, force, color=BLUE, linewidth=1)
    panel.plot(x, force, "o", color=BLUE, markersize=2.6)
    panel.axhline(0, color=GREY, linewidth=0.5)
    panel.set_ylabel("link force at the start [N]")
    panel.margins(x=0.02)
    what, places = results.supports()
    if places and what == "masts":
        panel.set_xlim(min(places[0], x.min()), max(places[-1], x.max()))
    marks = [one.axvline(place, color=GREY, linewidth=0.6, linestyle=(0, (1, 2)), zorder=0, label=what)
             for one in grid[:, 0] for place in places if len(places) <= 40]
    if known.any():
        grid[1, 0].plot(x[known], length[known], "o", color=RED, markersize=2.6)
        grid[1, 0].set_ylabel("unstressed length [m]")
    if marks:
        legend_below(grid[-1, 0], 1.7 if known.any() else 2.0, marks[:1])
    grid[-1, 0].set_xlabel("position [m]")
    return figure, None


def links_by_name(names, force):
    """A bar for each link, where many have the same x."""
    figure, grid = panels(1, 0.4 + 0.16 * len(names))
    panel = grid[0, 0]
    panel.barh(np.arange(len(names)), force, color=BLUE, height=0.6)
    panel.axvline(0, color=GREY, linewidth=0.5)
    panel.set_yticks(np.arange(len(names)), names)
    panel.set_ylim(len(names) - 0.4, -0.6)
    panel.set_xlabel("link force at the start [N, moments N m]")
    return figure, None
