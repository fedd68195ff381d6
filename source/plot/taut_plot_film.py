# SPDX-License-Identifier: LGPL-2.1-or-later
"""A film of wires, cables, bodies and links from their fields, without ParaView: GIF by Pillow, MP4 by ffmpeg."""

import os

import numpy as np
from matplotlib import animation
from matplotlib.collections import LineCollection
from taut_plot_files import UserError, read_collection, read_links, read_vtu
from taut_plot_line import LEAST_SLOPE, body_lines, line_bodies, sliding_contacts
from taut_plot_solids import read_arrays
from taut_plot_strips import read_strips
from taut_plot_style import BLACK, COLOURS, GREY, LOSS, Page, panels, scale_of

# Of films: the writer of matplotlib, what it needs, and the package of Debian that has this.
WRITERS = {"gif": ("pillow", "Pillow", "python3-pil"), "mp4": ("ffmpeg", "the program ffmpeg", "ffmpeg")}
MOST_FRAMES = 240
FRAMES_PER_SECOND = 20
SEEN = 0.15  # of the height of the picture: motions that are smaller are magnified up to it


def writer_of(kind):
    """The writer of this kind of film; an error that says what is missing."""
    name, needed, package = WRITERS[kind]
    if not animation.writers.is_available(name):
        other = [k for k, (w, *_) in WRITERS.items() if animation.writers.is_available(w)]
        raise UserError(f"--film {kind}: {needed} is missing; install the package {package}" + (f" or take --film {other[0]}" if other else ""))
    return animation.writers[name](fps=FRAMES_PER_SECOND)


def read_frames(results):
    """Times and, of each wire and cable, its segments [n, 2, 3] at these times; names of wires."""
    times, lines = [], {}
    frames = read_collection(results.path("fields/wires.pvd")) if results.has("fields/wires.pvd") else []
    bodies = line_bodies(results)
    every = [time for time, _ in frames or next((c for c in bodies.values() if c), [])]
    kept = set(every[::max(1, -(-len(every) // MOST_FRAMES))])
    for time, path in frames:
        if time in kept:
            points, displacement, wires, names = read_vtu(path)
            now = points + displacement
            times.append(time)
            for w, line in wires.items():
                lines.setdefault(names[w], []).append(np.stack([now[line[:-1]], now[line[1:]]], axis=1))
    for name, collection in bodies.items():
        moved = [(time, body_lines(read_arrays(path))) for time, path in collection if time in kept]
        if moved and all(line is not None for _, line in moved):
            times = times or [time for time, _ in moved]
            if len(moved) == len(times):
                lines[name] = [line for _, line in moved]
    n = min(map(len, lines.values()), default=0)
    return times[:n], {name: np.array(line[:n]) for name, line in lines.items()}


def read_link_frames(results, times):
    """The links between wires and bodies at these times, [n, links, 2, 3]; none where not all times have the same ones."""
    paths = dict(read_collection(results.path("fields/links.pvd"))) if results.has("fields/links.pvd") else {}
    if not all(time in paths for time in times):
        return np.empty((len(times), 0, 2, 3))
    without = sliding_contacts(results)
    frames = [[link for link in read_links(paths[time], without) if len(link) == 2] for time in times]
    same = len({len(frame) for frame in frames}) == 1
    return np.array(frames) if same and frames[0] else np.empty((len(times), 0, 2, 3))


def text_of(time, times):
    """A time of a film in s, of short films in ms or µs."""
    factor, unit = (1.0, "s") if times[-1] >= 0.1 else scale_of([times], "s")
    return f"t = {factor * time:.3f} {unit}"


def magnification(lines):
    """1, 2, 5, 10 ...: by which motions are seen."""
    width, height = np.ptp(np.concatenate([line.reshape(-1, 3) for line in lines.values()]), axis=0)[:2]
    ahead, up = np.max([np.abs(line - line[:1]).reshape(-1, 3).max(axis=0) for line in lines.values()], axis=0)[:2]
    size = max(width, height)
    wanted = min(SEEN * size / max(ahead, 1e-12 * size), SEEN * max(height, 2e-3 * size) / max(up, 1e-12 * size))
    if max(ahead, up) <= 1e-9 * size:
        return 1
    powers = [k * 10**p for p in range(6) for k in (1, 2, 5)]
    return max([k for k in powers if k <= wanted] or [1])


def contacts_at(strips, time):
    """[(x, whether there is a force)] of the strips that move at a time."""
    return [(float(np.interp(time, s.time, s.x)), float(np.interp(time, s.time, s.force)) > 0) for s in strips if s.moves]


def write_film(results, kind, path):
    """Writes the film; None, or the reason why there is none."""
    writer = writer_of(kind)
    times, lines = read_frames(results)
    if len(times) < 2:
        return "fields of wires or bodies at two times or more are needed (Output/Field interval)"
    factor = magnification(lines)
    lines = {name: line[:1] + factor * (line - line[:1]) for name, line in lines.items()}
    links = read_link_frames(results, times)
    links = links[:1] + factor * (links - links[:1])
    figure, grid = panels(1, 0.5 * Page.width)
    panel = grid[0, 0]
    between = panel.add_collection(LineCollection(links[0][..., :2], colors=GREY, linewidths=0.5))
    drawn = {name: panel.add_collection(LineCollection(line[0][..., :2], colors=COLOURS[i % len(COLOURS)], linewidths=1.2))
             for i, (name, line) in enumerate(lines.items())}
    every = np.concatenate([line.reshape(-1, 3) for line in lines.values()])
    (left, low, _), (right, high, _) = every.min(axis=0), every.max(axis=0)
    height = max(high - low, 1e-3 * (right - left))
    margin = max(0.01 * (right - left), (0.5 * height - (right - left)) / 2)  # slender scenes have room for their ticks
    panel.set_xlim(left - margin, right + margin)
    panel.set_ylim(low - 0.12 * height, high + 0.06 * height)
    to_scale = height > LEAST_SLOPE * (right - left)
    if to_scale:
        panel.set_aspect("equal", adjustable="box")
    panel.set_xlabel("x [m]")
    panel.set_ylabel("y [m]" + ("" if to_scale else ", at another scale"))
    strips = read_strips(results) if results.table("sliding.csv") else []
    marks = panel.scatter([], [], marker="^", s=36, zorder=3)
    with writer.saving(figure, path, dpi=110):
        for i, time in enumerate(times):
            for name, line in lines.items():
                drawn[name].set_segments(line[i][..., :2])
            between.set_segments(links[i][..., :2])
            contacts = contacts_at(strips, time)
            marks.set_offsets([(x, low - 0.06 * height) for x, _ in contacts] if contacts else np.empty((0, 2)))
            marks.set_facecolor([BLACK if touches else LOSS for _, touches in contacts])
            panel.set_title(text_of(time, times) + (f"; motion {factor} times" if factor > 1 else ""), loc="left")
            writer.grab_frame()
    return None if os.path.getsize(path) else "the writer wrote nothing"
