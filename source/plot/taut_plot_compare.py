# SPDX-License-Identifier: LGPL-2.1-or-later
"""Several results in one picture: contact forces, their statistics, probes; the legend has the names of the folders."""

import os

import numpy as np
from taut_plot_strips import power_spectrum, read_strips
from taut_plot_style import (BLACK, COLOURS, GREY, MOST_PANELS, legend_below, moving, panels, scale_of)


def labels_of(folders):
    """The names of the folders, with as many of the folders above them as tell them apart."""
    parts = [os.path.normpath(os.path.abspath(folder)).split(os.sep) for folder in folders]
    for depth in range(1, max(map(len, parts)) + 1):
        names = ["/".join(part[-depth:]) for part in parts]
        if len(set(names)) == len(names):
            break
    return names


def strips_by_name(runs):
    """{strip: [(number of the run, strip)]} of those that at least one run has, in order."""
    found = {}
    for i, run in enumerate(runs):
        for strip in read_strips(run):
            if len(strip.time) > 2:
                found.setdefault(strip.name, []).append((i, strip))
    return found


def legend_of(panel, labels, height):
    lines = [panel.plot([], [], color=COLOURS[i % len(COLOURS)], linewidth=2)[0] for i in range(len(labels))]
    legend_below(panel, height, lines, labels, most=3)


def compared_force(runs, labels, options):
    strips = strips_by_name(runs)
    if not strips:
        return None, "no sliding contact in these runs"
    figure, grid = panels(len(strips), 2.2, sharex=True)
    moves = all(strip.moves for some in strips.values() for _, strip in some)
    for panel, (name, some) in zip(grid[:, 0], strips.items()):
        texts = []
        for i, strip in some:
            panel.plot(strip.x if moves else strip.time, strip.evaluated, color=COLOURS[i % len(COLOURS)], linewidth=0.9)
            inside = strip.evaluated[strip.inside(options.window)]
            if len(inside):
                texts.append(rf"{inside.mean():.1f} N, $\sigma$ {inside.std():.1f} N")
        panel.margins(x=0)
        panel.set_ylabel("contact force [N]")
        panel.set_title(f"{name}: mean " + "; ".join(texts), loc="left")
    grid[-1, 0].set_xlabel("position of the contact [m]" if moves else "time [s]")
    legend_of(grid[-1, 0], labels, 1.9)
    return figure, None


def compared_statistics(runs, labels, options):
    strips = strips_by_name(runs)
    if not strips:
        return None, "no sliding contact in these runs"
    kinds = (("mean", np.mean), (r"$\sigma$", np.std), ("maximum", np.max), ("minimum", np.min))
    figure, grid = panels(len(strips), 2.0)
    width = 0.8 / len(runs)
    for panel, (name, some) in zip(grid[:, 0], strips.items()):
        for i, strip in some:
            values = strip.evaluated[strip.inside(options.window)]
            if len(values):
                at = np.arange(len(kinds)) - 0.4 + (i + 0.5) * width
                bars = panel.bar(at, [of(values) for _, of in kinds], width * 0.95, color=COLOURS[i % len(COLOURS)])
                panel.bar_label(bars, fmt="%.0f", fontsize="x-small")
        panel.axhline(0, color=GREY, linewidth=0.5)
        panel.set_xticks(range(len(kinds)), [kind for kind, _ in kinds])
        panel.set_xlim(-0.5, len(kinds) - 0.5)
        panel.margins(y=0.12)
        panel.set_ylabel("contact force [N]")
        panel.set_title(name, loc="left", pad=9)
    legend_of(grid[-1, 0], labels, 1.9)
    return figure, None


def compared_spectrum(runs, labels, options):
    strips = strips_by_name(runs)
    if not strips:
        return None, "no sliding contact in these runs"
    figure, grid = panels(len(strips), 2.2)
    drawn = False
    for panel, (name, some) in zip(grid[:, 0], strips.items()):
        for i, strip in some:
            inside = strip.force[strip.inside(options.window)]
            if len(inside) < 16 or np.ptp(inside) == 0:
                continue
            drawn = True
            frequencies, power = power_spectrum(inside, strip.step)
            shown = (frequencies > 0) & (frequencies <= 2 * (strip.frequency or 20))
            panel.semilogy(frequencies[shown], power[shown], color=COLOURS[i % len(COLOURS)], linewidth=0.8)
        panel.margins(x=0)
        panel.set_ylabel("power spectral density [N²/Hz]")
        panel.set_title(name, loc="left")
    grid[-1, 0].set_xlabel("frequency [Hz]")
    legend_of(grid[-1, 0], labels, 1.9)
    return (figure, None) if drawn else (None, "no contact force that changes")


def compared_probes(runs, labels, _):
    found, still = {}, 0
    for i, run in enumerate(runs):
        table = run.table("probes.csv")
        series = [(name, values) for name, values in table.series(" [m]")] if table and len(table) > 1 else []
        kept, n = moving(series)
        still = max(still, n)
        for name, values in kept:
            found.setdefault(name, []).append((i, table.time, values))
    order = sorted(found, key=lambda name: (-len(found[name]), -max(np.ptp(values) for *_, values in found[name])))
    shown = [name for name in found if name in order[:MOST_PANELS]]
    if not shown:
        return None, "no probes that move in these runs"
    figure, grid = panels(len(shown), 1.2 if len(shown) > 1 else 2.2, sharex=True)
    factor, unit = scale_of([values for name in shown for *_, values in found[name]], "m")
    for panel, name in zip(grid[:, 0], shown):
        for i, time, values in found[name]:
            panel.plot(time, factor * values, color=COLOURS[i % len(COLOURS)], linewidth=0.9)
        panel.axhline(0, color=BLACK, linewidth=0.3)
        panel.margins(x=0)
        panel.set_title(name, loc="left", pad=2)
    figure.supylabel(f"displacement [{unit}]", fontsize="medium")
    rest = len(found) - len(shown)
    grid[-1, 0].set_xlabel("time [s]" + (f"; {rest} that move less are left out" if rest else ""))
    legend_of(grid[-1, 0], labels, 1.0 if len(shown) > 1 else 1.9)
    return figure, None


PICTURES = {"contact_force": compared_force, "force_statistics": compared_statistics, "force_spectrum": compared_spectrum,
            "probes": compared_probes}
