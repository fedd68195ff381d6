# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of the shape: wires in space and the links between them at the start, from above and from the side; the sketch of
a scene with its guys; cables coloured by their tension."""

import glob
import os

import numpy as np
from matplotlib.collections import LineCollection
from taut_plot_files import numbers, read_collection, read_links, read_vtu
from taut_plot_solids import outline, read_arrays
from taut_plot_style import BLACK, COLOURS, GREY, ORANGE, Page, legend_above, legend_below, panels

NAMED = 6  # curves with names in a legend
LEAST_SLOPE = 0.15  # height over width of what is drawn to scale
LEAST_HEIGHT = 1e-3  # of a sketch, over its width: what is flatter is drawn flat
LINE = 3  # number of VTK


def plan_and_elevation(results, _):
    """Nothing for wires in one vertical plane."""
    frames = read_collection(results.path("fields/wires.pvd")) if results.has("fields/wires.pvd") else []
    if not frames:
        return None, None
    points, displacement, wires, names = read_vtu(frames[0][1])
    now = points + displacement
    if np.ptp(now[:, 2]) <= 1e-6 * np.ptp(now, axis=0).max():
        return None, None
    links = read_links(read_collection(results.path("fields/links.pvd"))[0][1]) if results.has("fields/links.pvd") else []
    figure, grid = panels(2, 2.0, sharex=True)
    # Only the longest wires have names.
    by_length = sorted(wires, key=lambda w: -np.ptp(now[wires[w]], axis=0).max())
    named = [w for w in wires if w in by_length[:NAMED]]
    for panel, axis, label in zip(grid[:, 0], (2, 1), ("z [m], from above", "y [m], from the side")):
        for number, line in wires.items():
            colour = COLOURS[named.index(number) % len(COLOURS)] if number in named else GREY
            panel.plot(now[line, 0], now[line, axis], color=colour, linewidth=None if number in named else 0.7,
                       label=f"wire '{names[number]}'" if number in named else None)
        if links:
            panel.add_collection(LineCollection([link[:, [0, axis]] for link in links], colors=BLACK, linewidths=0.5,
                                                label="links"))
        panel.set_ylabel(label)
        panel.margins(x=0)
    grid[0, 0].invert_yaxis()  # z comes towards who looks at the line from the side
    grid[1, 0].set_xlabel("x [m]" + (f"; grey: {len(wires) - NAMED} more wires" if len(wires) > NAMED else ""))
    legend_above(grid[0, 0])
    return figure, None


def lines_of(arrays):
    """The points of the lines of a body where they are, [n, 2, 3] for segments of two points;
    None for a solid."""
    if not len(arrays.get("types", ())) or (arrays["types"] != LINE).any():
        return None
    now = arrays["positions"].astype(float) + arrays["displacement"].astype(float)
    return now[arrays["connectivity"].reshape(-1, 2)]


def body_lines(arrays):
    """Those of a cable or rigid body, or the outline of a solid in the plane, where they are; None for a solid in space."""
    lines = lines_of(arrays)
    return outline(arrays) if lines is None else lines


def line_bodies(results):
    """{name: [(time, file)]} of the fields of bodies; cables and rigid bodies among them consist of lines."""
    files = sorted(glob.glob(os.path.join(results.folder, "fields", "body_*.pvd")))
    return {results.name_of(os.path.basename(file)[5:-4]): read_collection(file) for file in files}


def guys(results, low, extent):
    """Links from the ground, which have no second end in the fields: [2, 3] each. Droppers reach along their direction down to
    the lowest point of the scene, or a tenth of its extent; others are where they act."""
    found = []
    for name, at in results.points().items():
        # A link at several places is several links with numbers.
        section = next((s for s in (f"Network/Link {name}", f"Network/Link {name.rpartition(' ')[0]}")
                        if f"{s}/Direction" in results.entries), "")
        direction = numbers(results.entries.get(f"{section}/Direction", ""))
        if "ground" not in (results.entries.get(f"{section}/{end}", "") for end in ("From", "To")) or not any(direction):
            continue
        if results.entries.get(f"{section}/Type") != "dropper":
            found.append(np.array([at, at]))
            continue
        way = np.array((direction + [0.0])[:3]) / np.linalg.norm(direction)
        if results.entries.get(f"{section}/To", "") == "ground":
            way = -way
        length = (at[1] - low) / way[1] if way[1] > 0.05 and at[1] > low else 0.1 * extent
        found.append(np.array([at - length * way, at]))
    return found


def sliding_contacts(results):
    """Their names, of a run at rest too."""
    return {*results.sliding(), *(entry.split("/")[1].removeprefix("Link ") for entry, value in results.entries.items()
                                  if value == "sliding contact")}


def sketch(results, _):
    """What the scene looks like at the start, from the side: wires, cables, solids, links and guys."""
    segments, names = scene_lines(results)
    if not segments:
        return None, "no wires, cables or solids in the plane with fields (Output/Field interval)"
    points = np.concatenate([line.reshape(-1, 3) for line in segments])
    links = read_links(read_collection(results.path("fields/links.pvd"))[0][1], sliding_contacts(results)) \
        if results.has("fields/links.pvd") else []
    links += guys(results, points[:, 1].min(), np.ptp(points, axis=0).max())
    every = np.concatenate([points, *(link.reshape(-1, 3) for link in links)]) if links else points
    width, height = np.ptp(every[:, 0]), np.ptp(every[:, 1])
    slope = height / max(width, 1e-12 * height)
    true = slope > LEAST_SLOPE
    inches = 3.4 if slope > 4 else min(1.25 * Page.width, max(1.4, Page.width * slope)) if true else 2.4
    figure, grid = panels(1, inches)
    panel = grid[0, 0]
    for i, (line, name) in enumerate(zip(segments, names)):
        colour = COLOURS[i % len(COLOURS)] if i < NAMED else GREY
        panel.add_collection(LineCollection(line[:, :, :2], colors=colour, linewidths=1.3, label=name if i < NAMED else None))
    long = [link[:, :2] for link in links if np.ptp(link, axis=0).max() >= 1e-9]
    still = [link[0, :2] for link in links if np.ptp(link, axis=0).max() < 1e-9]
    if long:
        panel.add_collection(LineCollection(long, colors=BLACK, linewidths=0.6, label="links and guys"))
    if still:
        panel.plot(*np.transpose(still), "o", color=ORANGE, markersize=3, label="stops and joints")
    panel.autoscale_view()
    if slope < LEAST_HEIGHT:
        middle = (every[:, 1].min() + every[:, 1].max()) / 2
        panel.set_ylim(middle - LEAST_HEIGHT * width / 2, middle + LEAST_HEIGHT * width / 2)
    panel.set_xlabel("x [m]" + (f"; grey: {len(segments) - NAMED} more" if len(segments) > NAMED else ""))
    panel.set_ylabel("y [m]" + ("" if true else ", at another scale"))
    if true:
        panel.set_aspect("equal", adjustable="datalim")
    legend_below(panel, inches, panel.get_legend_handles_labels()[0])
    return figure, None


def scene_lines(results):
    """The segments [n, 2, 3] of each wire, body of lines and outline of a solid in the plane at the first field, long ones
    first, and their names."""
    found = []
    frames = read_collection(results.path("fields/wires.pvd")) if results.has("fields/wires.pvd") else []
    if frames:
        points, displacement, wires, names = read_vtu(frames[0][1])
        now = points + displacement
        found += [(np.stack([now[line[:-1]], now[line[1:]]], axis=1), names[w]) for w, line in wires.items()]
    for name, collection in line_bodies(results).items():
        line = body_lines(read_arrays(collection[0][1])) if collection else None
        if line is not None:
            found.append((line, name))
    found.sort(key=lambda item: -np.ptp(item[0].reshape(-1, 3), axis=0).max())
    return [line for line, _ in found], [name for _, name in found]


def cable_shape(results, _):
    """Cables at the last field, coloured by tension, and in grey where they were at the first one."""
    shown = []
    for collection in line_bodies(results).values():
        arrays = read_arrays(collection[-1][1]) if collection else {}
        if "tension" in arrays and lines_of(arrays) is not None:
            tension = arrays["tension"][arrays["connectivity"].reshape(-1, 2)].mean(axis=1)
            shown.append((lines_of(arrays), tension, lines_of(read_arrays(collection[0][1])), collection[-1][0]))
    if not shown:
        return None, "no cables with fields in this run"
    every = np.concatenate([line.reshape(-1, 3) for now, _, begin, _ in shown for line in (now, begin)])
    in_space = np.ptp(every[:, 2]) > 1e-6 * np.ptp(every, axis=0).max()
    figure, grid = panels(2 if in_space else 1, 2.2 if in_space else 3.0, sharex=True)
    low, high = (pick(float(pick(tension)) for _, tension, *_ in shown) for pick in (min, max))
    factor, unit = (1e-3, "kN") if high >= 2e4 else (1.0, "N")
    for panel, axis in zip(grid[:, 0], (1, 2)):
        for now, tension, begin, _ in shown:
            panel.add_collection(LineCollection(begin[:, :, [0, axis]], colors=GREY, linewidths=0.6))
            lines = panel.add_collection(LineCollection(now[:, :, [0, axis]], array=factor * tension, cmap="viridis",
                                                        linewidths=2.0))
            lines.set_clim(factor * low, factor * high)
        panel.autoscale_view()
        panel.set_ylabel(f"{'xyz'[axis]} [m]")
    grid[-1, 0].set_xlabel("x [m]")
    time, begins = shown[0][3], any(np.abs(now - begin).max() > 1e-9 for now, _, begin, _ in shown)
    grid[0, 0].set_title(f"t = {time:g} s" + ("; grey: at the start" if begins else ""), loc="left")
    figure.colorbar(lines, ax=grid[:, 0].tolist(), label=f"tension [{unit}]", pad=0.02, aspect=30)
    return figure, None
