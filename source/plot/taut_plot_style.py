# SPDX-License-Identifier: LGPL-2.1-or-later
"""What all pictures share: colours, sizes and fonts, units of axes, titles and legends that fit."""

import textwrap

import numpy as np
from matplotlib import pyplot as plt

# Okabe and Ito's colours, told apart by everybody and in grey.
BLUE, ORANGE, GREEN, RED, PINK, SKY, BLACK = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9", "#000000"
GREY = "#9a9a9a"
COLOURS = (BLUE, ORANGE, GREEN, RED, PINK, SKY, BLACK)
LOSS = RED  # of contact, in every picture
WIDTHS = {"text": 160, "column": 88, "page": 180}  # mm; text: of an A4 page
MOST_PANELS = 6
ROUNDING = 1e-9  # of the largest value of its kind: less does not move
FONT = 9


class Page:
    """Width of the pictures [inches], and whether that is the column of a journal."""
    width = WIDTHS["text"] / 25.4
    is_column = False


def set_style(width="text"):
    Page.width, Page.is_column = WIDTHS[width] / 25.4, width == "column"
    small = 7 if Page.is_column else 8
    size = 8 if Page.is_column else FONT
    plt.rcParams.update({
        "font.size": size, "axes.labelsize": size, "axes.titlesize": size, "legend.fontsize": small,
        "figure.titlesize": size, "xtick.labelsize": small, "ytick.labelsize": small, "axes.linewidth": 0.6, "axes.formatter.useoffset": False,
        "lines.linewidth": 0.9 if Page.is_column else 1.1, "xtick.major.width": 0.6, "ytick.major.width": 0.6,
        "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False, "figure.constrained_layout.use": True,
        "pdf.fonttype": 42, "savefig.dpi": 300 if Page.is_column else 200})


def panels(rows, height, columns=1, **options):
    """A figure as wide as the page with rows of this height [inches], and its panels in rows and columns."""
    return plt.subplots(rows, columns, figsize=(Page.width, height * rows + 0.7), squeeze=False, **options)


def legend_columns(labels):
    """As many as fit beside each other."""
    longest = max((len(label) for label in labels), default=1)
    room = 72 * (Page.width - 0.7)
    return max(1, min(len(labels), int(room / ((0.56 * longest + 5) * plt.rcParams["legend.fontsize"]))))


def legend_below(panel, height, handles, labels=None, most=5):
    """A legend under the axis label of a panel about `height` inches high."""
    labels = list(labels or [handle.get_label() for handle in handles])
    columns = min(most, legend_columns(labels))
    make_room(panel.figure, len(labels), columns)
    panel.legend(list(handles), labels, loc="upper center", bbox_to_anchor=(0.5, -0.46 / height), borderaxespad=0,
                 ncols=columns)


def make_room(figure, n_labels, columns):
    """A figure grows by the rows of a legend that it has no room for."""
    rows = -(-n_labels // columns)
    figure.set_figheight(figure.get_figheight() + max(0, rows - 2) * 1.7 * plt.rcParams["legend.fontsize"] / 72)


def legend_above(panel, handles=None, most=4, **options):
    handles = handles or panel.get_legend_handles_labels()[0]
    labels = [handle.get_label() for handle in handles]
    if handles:
        columns = min(most, legend_columns(labels))
        make_room(panel.figure, len(labels), columns)
        panel.legend(handles=handles, loc="lower left", bbox_to_anchor=(0, 1), ncols=columns, borderaxespad=0.2,
                     handlelength=1.4, **options)


def wrapped(text, length, width):
    """The text in lines of the width that is there, of a text of this length [pixels]."""
    letters = max(8, int(len(text) * width / length) - 1)
    return "\n".join(textwrap.wrap(text, letters, break_long_words=False))


def fit_texts(figure):
    """Titles and labels of axes that are longer than the picture go on in a next line."""
    figure.draw_without_rendering()
    whole = figure.bbox
    for panel in figure.axes:
        for text in (panel._left_title, panel.title):
            box = text.get_window_extent()
            if text.get_text() and box.x1 > whole.x1:
                text.set_text(wrapped(text.get_text(), box.width, whole.x1 - max(box.x0, 0) - 4))
        place = panel.get_window_extent()
        for text, size, room in ((panel.xaxis.label, "width", max(place.width, 0.8 * whole.width)),
                                 (panel.yaxis.label, "height", max(place.height, 40))):
            length = getattr(text.get_window_extent(), size)
            if text.get_text() and length > room and "\n" not in text.get_text():
                text.set_text(wrapped(text.get_text(), length, room))
    if figure._suptitle and figure._suptitle.get_window_extent().x1 > whole.x1:
        box = figure._suptitle.get_window_extent()
        figure._suptitle.set_text(wrapped(figure._suptitle.get_text(), box.width, whole.x1 - box.x0 - 4))


def scale_of(values, unit):
    """The factor and the unit in which the largest of the values is written best."""
    largest = max((float(np.abs(v).max()) for v in values if np.size(v)), default=0.0)
    if unit.startswith("N") and largest >= 1:
        return (1e-3, "k" + unit) if largest >= 2e4 else (1.0, unit)
    if largest >= 1 or largest < 1e-12:  # below: rounding
        return 1.0, unit
    return (1e3, "m" + unit) if largest >= 1e-4 else (1e6, "µ" + unit)


def moving(series, largest=None):
    """Of [(name, values)] those that change by more than rounding, and how many do not; `largest`: of their kind."""
    size = max((np.abs(values).max() for _, values in series), default=0.0) if largest is None else largest
    kept = [item for item in series if np.ptp(item[1]) > max(ROUNDING * size, 1e-14)]
    return kept, len(series) - len(kept)


def left_out(n, what="series"):
    """What is said of panels and lines that would show rounding only."""
    return f"{n} {what} that {'does' if n == 1 else 'do'} not change {'is' if n == 1 else 'are'} left out" if n else None


def spans(time, flags):
    """[(from, to)] of the intervals in which the flags are set; a flag counts from half-way to its neighbours."""
    edges = np.concatenate([time[:1], (time[1:] + time[:-1]) / 2, time[-1:]])
    steps = np.flatnonzero(np.diff(np.concatenate([[0], np.asarray(flags).astype(int), [0]])))
    return [(edges[a], edges[b]) for a, b in steps.reshape(-1, 2)]


def speed_of(time, position):
    """', 250 km/h', or nothing where nothing moves."""
    if len(time) < 2 or np.ptp(position) == 0:
        return ""
    speed = 3.6 * np.abs(np.diff(position) / np.diff(time))
    low, high = np.percentile(speed, (1, 99))
    return f", {high:.4g} km/h" if high - low < 1e-3 * high else f", {low:.3g} to {high:.3g} km/h"


def mark_places(panel, results, wire=None):
    """Masts or supports as lines and droppers or links as ticks at the upper edge, over x [m]; handles for a legend."""
    handles = []
    left, right = panel.get_xlim()
    (what, places), (kind, ticks) = results.supports(wire), results.links(wire)
    places, ticks = ([x for x in xs if left <= x <= right] for xs in (places, ticks))
    for x in places if len(places) <= 40 else []:
        line = panel.axvline(x, color=GREY, linewidth=0.6, linestyle=(0, (1, 2)), zorder=0.5)
        handles[:] = [line]
    if handles:
        handles[0].set_label(what)
    if 0 < len(ticks) <= 400:
        handles += panel.plot(ticks, np.full(len(ticks), 1.0), "|", color=BLACK, markersize=4, markeredgewidth=0.5,
                              transform=panel.get_xaxis_transform(), clip_on=False, label=kind)
    return handles
