# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of contact forces: over position, their spectrum and histogram, their statistics span by span."""

import numpy as np
from taut_plot_strips import bands, deviation_in, power_spectrum, sections, strips_over_x
from taut_plot_style import (BLUE, GREEN, GREY, LOSS, ORANGE, PINK, RED, SKY, legend_below, mark_places, panels,
                             spans, speed_of)

SHARES = (GREEN, PINK, SKY, ORANGE)


def contact_force(results, options):
    strips, reason = strips_over_x(results)
    if not strips:
        return None, reason
    moves = all(strip.moves for strip in strips)
    figure, grid = panels(len(strips), 2.2, sharex=True, sharey=True)
    drawn = [contact_panel(panel, strip, moves, options.window) for panel, strip in zip(grid[:, 0], strips)]
    low, high = (pick(limits[i] for _, limits in drawn) for i, pick in enumerate((min, max)))
    grid[0, 0].set_ylim(min(0, 1.05 * low), 1.05 * high or 1)
    grid[-1, 0].set_xlabel("position of the contact [m]" if moves else "time [s]")
    handles = {handle.get_label(): handle for some, _ in drawn for handle in some}
    if moves:
        grid[0, 0].set_xlim(min(s.x.min() for s in strips), max(s.x.max() for s in strips))
        for panel in grid[:, 0]:
            handles.update((handle.get_label(), handle) for handle in mark_places(panel, results))
    legend_below(grid[-1, 0], 1.9, handles.values(), most=4)
    return figure, None


def contact_panel(panel, strip, moves, window):
    """One strip: handles for the legend, and smallest and largest value drawn [N]."""
    at, unit = (strip.x, "m") if moves else (strip.time, "s")
    rows, force, evaluated = strip.rows[moves], strip.rows[2], strip.evaluated
    lines = panel.plot(rows, force, color=GREY, linewidth=0.5, label="contact force")
    for (wire, share), colour in zip(strip.shares.items(), SHARES):
        lines += panel.plot(at, strip.low_passed(share), color=colour, linewidth=0.8, label=f"share of '{wire}'")
    if strip.frequency:
        what = "their sum, " if strip.shares else ""
        lines += panel.plot(at, evaluated, color=BLUE, label=f"{what}{strip.filter_text}")
    for begin, end in spans(rows, force == 0):
        lines.append(panel.axvspan(begin, end, color=LOSS, alpha=0.4, linewidth=0.8, label="loss of contact"))
    panel.set_ylabel("contact force [N]")
    panel.margins(x=0)
    title = strip.name + speed_of(strip.time, strip.position)
    inside = strip.inside(window)
    if not inside.any():
        limits = window or strip.window
        panel.set_title(f"{title}: does not reach {limits[0]:g} to {limits[1]:g} m", loc="left", pad=7)
        return lines, (force.min(), force.max())
    mean, deviation = evaluated[inside].mean(), evaluated[inside].std()
    ends = [at[inside].min(), at[inside].max()]
    lines.append(panel.fill_between(ends, mean - 3 * deviation, mean + 3 * deviation, color=ORANGE, alpha=0.22,
                                    linewidth=0, zorder=0, label=r"mean $\pm$ 3 $\sigma$"))
    lines += panel.plot(ends, [mean, mean], color=RED, linewidth=1.0, label="mean", zorder=3)
    title += rf": mean {mean:.1f} N, $\sigma$ {deviation:.1f} N"
    if not inside.all():
        title += f", {ends[0]:.0f} to {ends[1]:.0f} {unit}"
    if (strip.force[inside] == 0).any():
        title += f", loss {100 * (strip.force[inside] == 0).mean():.1f} %"
    panel.set_title(title, loc="left", pad=7)
    return lines, (min(force.min(), mean - 3 * deviation), max(force.max(), mean + 3 * deviation))


def force_spectrum(results, options):
    """Power spectral density in the window, with the limits of the bands and the deviation in each."""
    strips, reason = strips_over_x(results)
    if not strips:
        return None, reason
    figure, grid = panels(len(strips), 2.2, sharex=True, sharey=True)
    drawn = False
    for panel, strip in zip(grid[:, 0], strips):
        inside = strip.inside(options.window)
        if inside.sum() < 16:
            panel.set_title(f"{strip.name}: too few samples in the window", loc="left")
            continue
        frequencies, power = power_spectrum(strip.force[inside], strip.step)
        limits = bands(strip.frequency, options.bands)
        shown = (frequencies > 0) & (frequencies <= 2 * limits[-1])
        if not (power[shown] > 0).any():
            panel.set_title(f"{strip.name}: the force does not change", loc="left")
            continue
        drawn = True
        panel.semilogy(frequencies[shown], power[shown], color=BLUE, linewidth=0.8)
        top = power[shown].max()
        panel.set_ylim(max(1e-7 * top, 0.3 * power[shown].min()), 3 * top)
        parts = []
        for (low, high), colour in zip(zip(limits[:-1], limits[1:]), (SKY, ORANGE, GREEN, PINK)):
            panel.axvspan(low, high, color=colour, alpha=0.18, linewidth=0)
            panel.axvline(high, color=GREY, linewidth=0.8, linestyle="--")
            parts.append(rf"{low:g} to {high:g} Hz $\sigma$ {deviation_in(frequencies, power, low, high):.1f} N")
        panel.set_title(f"{strip.name}: {', '.join(parts)}", loc="left")
        panel.set_ylabel("power spectral density [N²/Hz]")
        panel.set_xlim(0, 2 * limits[-1])
    grid[-1, 0].set_xlabel("frequency [Hz]")
    return (figure, None) if drawn else (None, "no contact force that changes in the window")


def force_histogram(results, options):
    """How often each force occurs in the window, with the mean and three standard deviations beside it."""
    strips, reason = strips_over_x(results)
    if not strips:
        return None, reason
    figure, grid = panels(len(strips), 1.9, sharex=True)
    handles = []
    for panel, strip in zip(grid[:, 0], strips):
        values = strip.evaluated[strip.inside(options.window)]
        if len(values) < 16 or np.ptp(values) == 0:
            panel.set_title(f"{strip.name}: no contact force that changes in the window", loc="left")
            continue
        mean, deviation = values.mean(), values.std()
        panel.hist(values, bins=min(60, max(12, int(len(values) ** 0.5))), weights=np.full(len(values), 100 / len(values)),
                   color=BLUE, alpha=0.8)
        handles = [panel.axvline(mean, color=RED, label="mean"),
                   *(panel.axvline(mean + side * 3 * deviation, color=ORANGE, linestyle="--", label=r"mean $\pm$ 3 $\sigma$")
                     for side in (1, -1))][:2]
        panel.set_title(rf"{strip.name}: mean {mean:.1f} N, $\sigma$ {deviation:.1f} N, smallest {values.min():.1f} N, "
                        f"largest {values.max():.1f} N", loc="left")
        panel.set_ylabel("samples [%]")
    if not handles:
        return None, "no contact force that changes in the window"
    grid[-1, 0].set_xlabel(f"contact force, {strips[0].filter_text} [N]")
    legend_below(grid[-1, 0], 1.6, handles)
    return figure, None


def force_by_span(results, _):
    """Mean, maximum and standard deviation in each span that a strip passes in whole."""
    strips, reason = strips_over_x(results)
    if not strips:
        return None, reason
    what, places = results.supports()
    parts = [(strip, sections(places, strip)) for strip in strips if strip.moves]
    parts = [(strip, ends) for strip, ends in parts if ends]
    if not parts:
        return None, f"no contact passes a span between two {what} in whole"
    figure, grid = panels(len(parts), 2.1, sharex=True, sharey=True)
    for panel, (strip, ends) in zip(grid[:, 0], parts):
        left, width = np.array([a for a, _ in ends]), np.array([b - a for a, b in ends])
        for name, of, colour, shift in (("mean", np.mean, BLUE, 0.1), ("maximum", np.max, SKY, 0.37),
                                        (r"$\sigma$", np.std, ORANGE, 0.64)):
            values = [of(strip.evaluated[(strip.x >= a) & (strip.x <= b)]) for a, b in ends]
            panel.bar(left + shift * width, values, 0.26 * width, align="edge", color=colour, label=name)
        panel.set_title(strip.name, loc="left")
        panel.set_ylabel("contact force [N]")
        for x in sorted({x for pair in ends for x in pair}):
            panel.axvline(x, color=GREY, linewidth=0.5, linestyle=(0, (1, 2)), zorder=0)
    grid[-1, 0].set_xlabel(f"position [m]; lines: {what}; force {parts[0][0].filter_text}")
    handles, labels = grid[0, 0].get_legend_handles_labels()
    legend_below(grid[-1, 0], 1.8, handles, labels)
    return figure, None

