# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of motion: probes, uplift at masts, the displacement of a wire over position and time, envelopes and sag."""

import re

import numpy as np
from taut_plot_files import UserError, numbers, read_collection, read_vtu, statistic
from taut_plot_strips import place_of, read_strips, wire_of
from taut_plot_style import (BLACK, BLUE, COLOURS, GREEN, GREY, LOSS, ORANGE, RED, ROUNDING, Page, left_out, legend_above,
                             legend_below, mark_places, moving, panels, scale_of, speed_of)

MOST_CURVES = 12  # with names; half as many in a column
LEAST_UPLIFT = 1e-3  # of a probe that is drawn, over the largest one


def probes(results, _):
    table = results.table("probes.csv")
    if not table:
        return None, "no probes in this run"
    if len(table) < 2:
        return None, "probes.csv has one line only"
    kinds = [(*moving(list(table.series(ending))), what, unit) for ending, what, unit in
             ((" [m]", "displacement", "m"), (" [rad]", "rotation", "rad"), (" [m/s]", "velocity", "m/s"),
              (" [m/s^2]", "acceleration", "m/s²"), (" [rad/s]", "angular velocity", "rad/s"),
              (" [rad/s^2]", "angular acceleration", "rad/s²"))]
    said = [left_out(still, f"{what}s" if still > 1 else what) for _, still, what, _ in kinds if still]
    kinds = [kind for kind in kinds if kind[0]]
    if not kinds:
        return None, "the probes move by rounding only"
    figure, grid = panels(len(kinds), 2.1, sharex=True)
    styles = [(c, s) for s in ("-", "--", ":") for c in COLOURS]
    for panel, (series, _, what, unit) in zip(grid[:, 0], kinds):
        factor, unit = scale_of([values for _, values in series], unit)
        order = sorted(range(len(series)), key=lambda i: -np.ptp(series[i][1]))
        most = MOST_CURVES // 2 if Page.is_column else MOST_CURVES
        named = sorted(order[:most])
        panel.axhline(0, color=GREY, linewidth=0.5)
        for i in order[most:]:
            panel.plot(table.time, factor * series[i][1], color=GREY, linewidth=0.6, zorder=1)
        if len(order) > most:
            said.append(f"grey: {len(order) - most} that move least")
        for i, (colour, style) in zip(named, styles):
            panel.plot(table.time, factor * series[i][1], color=colour, linestyle=style, label=series[i][0])
        panel.set_ylabel(f"{what} [{unit}]")
        panel.margins(x=0)
        legend_above(panel)
    grid[-1, 0].set_xlabel("\n".join(["time [s]", *filter(None, said)]))
    return figure, None


def uplift(results, options):
    """The largest displacement at each mast, or of each probe, with the limits that are expected."""
    table = results.table("probes.csv")
    if not table:
        return None, "no probes in this run"
    if not results.sliding() and not options.plots:
        return None, "no sliding contact lifts a wire"
    items = []
    for name, values in table.series(" [m]"):
        largest = statistic(results.statistics, "probes", name, "largest")
        limits = expected(results, name)
        place = re.search(r" at (\S+) m$", name)
        items.append((name, 1e3 * (max(0.0, values.max()) if largest is None else largest), limits,
                      float(place[1]) if place and numbers(place[1]) else None))
    largest = max((value for _, value, *_ in items), default=0.0)
    n = len(items)
    items = [item for item in items if item[1] > LEAST_UPLIFT * largest]
    if len(table) < 2 or not items:
        return None, "no probe moves upwards"
    by_place = len(items) > 1 and all(place is not None for *_, place in items)
    figure, grid = panels(1, 2.4)
    panel = grid[0, 0]
    at = np.arange(len(items))
    names = [f"{place:g}" for *_, place in items] if by_place else [name for name, *_ in items]
    groups = list(dict.fromkeys(re.sub(r" at \S+ m$", "", name) for name, *_ in items)) if by_place else [""]
    for group, colour in zip(groups, COLOURS):
        mine = [i for i, (name, *_) in enumerate(items) if not by_place or re.sub(r" at \S+ m$", "", name) == group]
        panel.bar(at[mine], [items[i][1] for i in mine], color=colour, width=0.6, label=group or "largest displacement")
    for i, (_, value, limits, _) in enumerate(items):
        panel.annotate(f"{value:#.3g}".rstrip("."), (i, value), xytext=(0, 1.5), textcoords="offset points", ha="center", va="bottom",
                       fontsize="x-small", zorder=4, bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6})
        for limit in limits:
            panel.plot([i - 0.42, i + 0.42], [limit, limit], color=RED, linewidth=1.2,
                       label="limits" if (i, limit) == (0, limits[0]) else None)
    crowded = len(names) > 8 or max(len(name) for name in names) * len(names) > 60
    panel.set_xticks(at, names, rotation=60 if crowded else 0, ha="right" if crowded else "center")
    said = f"{n - len(items)} with less than 0.1 % of the largest left out" if n > len(items) else ""
    panel.set_xlabel("; ".join(filter(None, ["mast at x [m]" if by_place else "", said])))
    panel.set_ylabel("largest uplift [mm]" if by_place else "largest displacement [mm]")
    legend_above(panel)
    return figure, None


def expected(results, name):
    """Limits of the largest value of a probe [mm], or none."""
    tree = results.statistics.get("probes")
    tree = tree.get(name, {}) if isinstance(tree, dict) else {}
    largest = tree.get("largest")
    return [1e3 * limit for limit in largest.get("expected", [])] if isinstance(largest, dict) else []


class Motion:
    """How one wire moves: times [n], places along it [m], `height` [m] at the first time over the straight line between its
    undeformed ends, displacement u [n, m] in the direction in which it moves most, what that is, and whether places are x."""

    def __init__(self, name, times, places, height, displacement, what, is_x):
        self.name, self.times, self.s, self.height = name, np.array(times), places, height
        self.u, self.what, self.is_x = displacement, what, is_x

    def moves(self):
        return np.ptp(self.u - self.u[0]) > ROUNDING * np.ptp(self.s)


def shown_wires(results, wires, names, points, wanted):
    """Numbers of the wires to draw: the wanted one, those that sliding contacts run on, or the lowest."""
    if wanted is not None:
        matching = [w for w in wires if wanted in (names[w], str(w))]
        if not matching:
            raise UserError(f"--wire {wanted}: there is no such wire; there are " +
                            ", ".join(f"{w} '{name}'" for w, name in names.items()))
        return matching[:1]
    touched = {wire_of(results, contact) for contact in results.sliding()}
    return [w for w in wires if names[w] in touched][:4] or [min(wires, key=lambda w: points[wires[w], 1].mean())]


def read_motions(results, wanted):
    """The motion of the wanted wire, by name or number; of those that contacts run on, or of the lowest one, if it is None."""
    times, fields, chosen = [], {}, []
    for time, path in read_collection(results.path("fields/wires.pvd")):
        points, displacement, wires, names = read_vtu(path)
        if not times:
            chosen = shown_wires(results, wires, names, points, wanted)
            lines = {w: wires[w] for w in chosen}
            begin = points
        times.append(time)
        for w in chosen:
            fields.setdefault(w, []).append(displacement[lines[w]])
    return [motion_of(names[w], times, begin[lines[w]], np.array(fields[w])) for w in chosen]


def motion_of(name, times, points, motion):
    """The Motion of a wire with these points [m, 3] and displacements [n, m, 3]."""
    way = points[-1] - points[0]
    way /= np.linalg.norm(way)
    is_x = abs(way[0]) > 0.999
    s = points[:, 0] if is_x else (points - points[0]) @ way
    height = motion[0][:, 1]
    since = ""
    if np.abs(motion[0]).max() > 2 * np.abs(motion - motion[0]).max():
        since, motion = ", since the start", motion - motion[0]  # small beside the static shape
    in_plane = np.hypot(way[0], way[1])
    normal = np.array([-way[1], way[0], 0]) / in_plane if in_plane > 1e-12 else np.array([0.0, 1.0, 0.0])
    motions = {"across the wire": motion @ normal, "along the wire": motion @ way,
               "sideways": motion @ np.cross(way, normal)}
    direction, u = max(motions.items(), key=lambda item: np.ptp(item[1]))
    order = np.argsort(s, kind="stable")
    thin = order[::-(-len(s) // 1200)]
    return Motion(name, times, s[thin], height[thin], u[:, thin], f"displacement {direction}{since}", is_x)


def displacement_map(results, options):
    if not results.has("fields/wires.pvd"):
        return None, "no wires, or no fields of them (Output/Field interval = 0)"
    motions = [m for m in read_motions(results, options.wire) if len(m.times) > 2]
    motions = [m for m in motions if np.ptp(m.u) > ROUNDING * np.ptp(m.s)]
    if not motions:
        return None, "the wire does not move, or there are too few fields"
    figure, grid = panels(len(motions), 3.7 if len(motions) == 1 else 2.6)
    factor, unit = scale_of([m.u for m in motions], "m")
    handles = {}
    for panel, motion in zip(grid[:, 0], motions):
        picture = motion_panel(panel, results, motion, factor, handles)
        figure.colorbar(picture, ax=panel, label=f"{motion.what} [{unit}]", pad=0.02, aspect=30)
    grid[-1, 0].set_xlabel("position on the wire [m]" if not motions[-1].is_x else "position [m]")
    if handles:
        legend_below(grid[-1, 0], 3.2 if len(motions) == 1 else 2.1, handles.values())
    return figure, None


def motion_panel(panel, results, motion, factor, handles):
    """The map of one wire with the contacts that run on it; adds to the handles of the legend."""
    s, time, u = motion.s, motion.times, motion.u
    most = factor * np.abs(u).max()
    two_sided = u.min() < -0.02 * np.abs(u).max() and u.max() > 0.02 * np.abs(u).max()
    limits = (-most, most) if two_sided else (min(0.0, factor * u.min()), max(0.0, factor * u.max()))
    picture = panel.pcolormesh(s, time, factor * u, shading="gouraud", cmap="RdBu_r" if two_sided else "viridis",
                               vmin=limits[0], vmax=limits[1], rasterized=True)
    panel.set_xlim(s.min(), s.max())
    panel.set_ylim(time[0], time[-1])
    title = f"wire '{motion.name}'"
    if motion.is_x:
        handles.update((mark.get_label(), mark) for mark in mark_places(panel, results, motion.name))
        title += draw_contacts(panel, results, motion.name, handles)
    panel.set_ylabel("time [s]")
    panel.set_title(title, loc="left", pad=7)
    panel.spines[["top", "right"]].set_visible(True)
    return picture


def draw_contacts(panel, results, wire, handles):
    """The ways of the contacts on a wire, and where one of these has no force although its strip touches no other wire."""
    table = results.table("sliding.csv")
    lost = {contact: strip.rows[2] == 0 for strip in (read_strips(results) if table else ()) for contact in strip.contacts}
    mine = [item for item in (table.series(" force [N]", " position [m]") if table else ())
            if wire_of(results, item[0]) in (wire, None)]
    title = ""
    for i, (contact, _, position) in enumerate(mine):
        x = place_of(results, contact, position)
        handles[contact], = panel.plot(x, table.time, color=BLACK, linewidth=0.7, linestyle=("-", "--", ":")[i % 3],
                                       label=contact)
        title += f", {contact}" + speed_of(table.time, position)
        if lost.get(contact, np.zeros(1)).any():
            off = np.where(lost[contact], x, np.nan)
            panel.plot(off, table.time, color="white", linewidth=5)
            loss, = panel.plot(off, table.time, color=LOSS, linewidth=3, label="loss of contact")
            handles["loss of contact"] = loss
    return title


def envelope(results, options):
    """Highest and lowest displacement of a wire over the run, and its profile at the start: the sag."""
    if not results.has("fields/wires.pvd"):
        return None, "no wires, or no fields of them (Output/Field interval = 0)"
    motions = [m for m in read_motions(results, options.wire) if m.is_x]
    motions = [m for m in motions if m.moves() or np.ptp(m.height) > ROUNDING * np.ptp(m.s)]
    if not motions:
        return None, "the wire neither sags nor moves, or does not run along x"
    moves = any(motion.moves() for motion in motions)
    sags = any(np.ptp(motion.height) > ROUNDING * np.ptp(motion.s) for motion in motions)
    rows = moves + sags
    figure, grid = panels(rows * len(motions), 1.7, sharex=len(motions) == 1)
    handles = {}
    for i, motion in enumerate(motions):
        if sags:
            profile_panel(grid[rows * i, 0], motion)
        if moves:
            handles.update(envelope_panel(grid[rows * i + sags, 0], motion, "" if sags else f"wire '{motion.name}': "))
        for panel in grid[rows * i:rows * (i + 1), 0]:
            panel.margins(x=0)
            handles.update((mark.get_label(), mark) for mark in mark_places(panel, results, motion.name))
    grid[-1, 0].set_xlabel("position [m]")
    if handles:
        legend_below(grid[-1, 0], 1.3, handles.values())
    return figure, None


def profile_panel(panel, motion):
    still = motion.height
    factor, unit = scale_of([still], "m")
    panel.plot(motion.s, factor * still, color=BLACK)
    panel.axhline(0, color=GREY, linewidth=0.5)
    panel.set_ylabel(f"height [{unit}]")
    low, high = (round(factor * value, 6) for value in (still.min(), still.max()))
    panel.set_title(f"wire '{motion.name}' at t = {motion.times[0]:g} s: {low:.4g} to {high:.4g} {unit}", loc="left", pad=7)


def envelope_panel(panel, motion, title):
    change = motion.u - motion.u[0]
    factor, unit = scale_of([change], "m")
    low, high = factor * change.min(axis=0), factor * change.max(axis=0)
    panel.axhline(0, color=GREY, linewidth=0.5)
    handles = [panel.fill_between(motion.s, low, high, color=BLUE, alpha=0.25, linewidth=0, label="envelope")]
    handles += panel.plot(motion.s, high, color=GREEN, linewidth=0.9, label="highest")
    handles += panel.plot(motion.s, low, color=ORANGE, linewidth=0.9, label="lowest")
    panel.set_ylabel(f"motion since the start [{unit}]")
    at_high, at_low = motion.s[high.argmax()], motion.s[low.argmin()]
    panel.set_title(f"{title}{high.max():.4g} {unit} at {at_high:.4g} m, {low.min():.4g} {unit} at {at_low:.4g} m", loc="left",
                    pad=7)
    return {handle.get_label(): handle for handle in handles}
