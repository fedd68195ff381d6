#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What taut-plot draws of short runs is what their fields say: wires, sketches, cables, solids, films."""
from drawing import (TIME, close, contact_table, draw, expect, finish_after, folder, named, plot, program, run)
import matplotlib
import numpy as np
from PIL import Image
from taut_plot_files import read_collection
from taut_plot_film import magnification, read_frames, read_link_frames, text_of
from taut_plot_solids import outline
from taut_plot_strips import deviation_in, power_spectrum, read_strips
from taut_plot_style import LOSS


def check_line():
    """Each contact is drawn on its own wire, its loss in the one colour of all pictures, and the envelope is that of the fields."""
    path = run("real_line", "Time/End=0.06", "Output/Field interval=0.02", "Output/Link interval=0.02")
    figure = draw("displacement_map", path)
    for panel, wire in zip(figure.axes, ("contact 1", "contact 2")):
        ways = {line.get_label(): line for line in panel.get_lines() if line.get_label().endswith(wire)}
        expect(f"contacts on {wire}", set(ways) == {f"leading on {wire}", f"trailing on {wire}"}, list(ways))
        for strip, x in (("leading", 569), ("trailing", 496)):
            close(f"{strip} on {wire}", ways[f"{strip} on {wire}"].get_xdata()[[0, -1]], [x, x + 160 / 3.6 * 0.06], 1e-6)
        others = [line for line in panel.get_lines() if "on contact" in line.get_label() and not line.get_label().endswith(wire)]
        expect(f"no contacts of another wire on {wire}", not others, others)
    figure = draw("envelope", path)
    frames = [plot.read_vtu(file) for _, file in read_collection(str(path / "fields/wires.pvd"))]
    number = next(w for w, name in frames[0][3].items() if name == "contact 1")
    motion = np.array([u[wires[number], 1] for _, u, wires, _ in frames])
    highest, = named(figure.axes[1], "highest")
    close("envelope", highest.get_ydata(), 1e3 * (motion - motion[0]).max(axis=0)[::2], 1e-4)
    close("profile", figure.axes[0].get_lines()[0].get_ydata(), 1e3 * motion[0][::2], 1e-4)

    # Pictures and statistics.json have one definition of filter, window, bands and masts.
    results = plot.Results(str(path))
    strips = {strip.name: strip for strip in read_strips(results)}
    for name, of in results.statistics["sliding_contacts"].items():
        strip = strips[name]
        close(f"filter of {name}", [strip.frequency], [20])
        said = [of["filtered"][key]["value"] for key in ("mean", "standard_deviation", "maximum", "minimum")]
        close(f"figures of {name}", [pick(strip.evaluated) for pick in (np.mean, np.std, np.max, np.min)], said, 1e-4)
        spectrum = power_spectrum(strip.force, strip.step)
        bands = [(0, 2), (0, 5), (5, 20), (0, 20)]
        close(f"bands of {name}", [deviation_in(*spectrum, low, high) for low, high in bands],
              [of[f"standard_deviation_{low}_to_{high}_Hz"]["value"] for low, high in bands], 1e-4)
    all_spans = results.statistics["spans"].values()
    for wire in {span["wire"] for span in all_spans}:
        spans = [span for span in all_spans if span["wire"] == wire]
        begin = 496 if wire.endswith("2") else 0
        close(f"masts of {wire}", results.masts(wire), [begin, *(begin + span["to"]["value"] for span in spans)])

    force = np.where(TIME < 1, 100.0, 0.0)
    panel = draw("contact_force", folder("loss", sliding=contact_table(pan=force))).axes[0]
    colour = next(patch.get_facecolor() for patch in panel.patches if patch.get_label() == "loss of contact")
    expect("one colour of the loss", matplotlib.colors.to_hex(colour) == LOSS.lower(), colour)


def check_shapes():
    path = run("guyed_mast", "Time/End=0")
    figure = draw("sketch", path)
    guys = sorted(tuple(np.ravel(line)) for lines in figure.axes[0].collections if lines.get_label() == "links and guys"
                  for line in lines.get_segments())
    close("guys of the sketch", guys, [[-6, 0, 0, 8], [6, 0, 0, 8]], 0.01)
    expect("height of the sketch", figure.get_figheight() < 1.5 * figure.get_figwidth(), figure.get_figheight())

    path = run("beam_over_supports", "Time/End=0")
    panel, = draw("sketch", path).axes
    stops = next(line.get_xydata() for line in panel.get_lines() if line.get_label() == "stops and joints")
    close("stops of the sketch", stops[:, 0], np.arange(21), 1e-6)
    low, high = panel.get_ylim()
    expect("a flat scene is drawn flat", 0.019 < high - low < 0.03 and np.abs(stops[:, 1]).max() < 1e-5, (low, high))
    panel, = draw("sketch", run("line_of_cables", "Time/End=0")).axes
    links = [line for lines in panel.collections if lines.get_label() == "links and guys" for line in lines.get_segments()]
    expect("links of the sketch, without the sliding contact", len(links) == 27 and min(line[:, 1].min() for line in links) > -0.1,
           len(links))
    texts = [text.get_text() for text in panel.get_legend().get_texts()]
    expect("names of bodies", texts[0] == "contact wire" and "messenger 2" in texts, texts)

    path = run("hanging_cable")
    results = plot.Results(str(path))
    expect("a static scene is complete", results.is_static and not results.is_partial)
    done = program(path, "--format", "png")
    expect("pictures of a static scene", done.returncode == 0 and "not complete" not in done.stdout, done.stdout + done.stderr)
    panel = draw("cable_shape", path).axes[0]
    lines = max(panel.collections, key=lambda lines: lines.get_array() is not None)
    (_, _, arrays), = plot.last_fields(results, "body")
    close("tension of the cable", lines.get_array(), arrays["tension"][arrays["connectivity"].reshape(-1, 2)].mean(axis=1))
    close("its shape", np.array(lines.get_segments()).reshape(-1, 2), (arrays["positions"].astype(float) + arrays["displacement"])[arrays["connectivity"]][:, :2])
    film = program(path, "--film", "gif", "--plots", "sketch", "--format", "png")
    expect("no film of one field", "no film: fields of wires or bodies at two times" in film.stdout, film.stdout + film.stderr)


def check_solids():
    """Two squares with points of their own have six edges outside; contacts are drawn while they carry."""
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
    edges = outline({"positions": np.concatenate([square, square + [1, 0, 0]]), "types": np.array([9, 9]),
                     "connectivity": np.arange(8), "offsets": np.array([4, 8])})
    close("edges of two squares", [len(edges), *edges.reshape(-1, 3).max(axis=0)], [6, 2, 1, 0])
    membrane = {"positions": square, "types": np.array([9]), "connectivity": np.arange(4), "offsets": np.array([4])}
    # A cell beside two of half its size: the edge between them is inside.
    half = 0.5 * square
    hanging = outline({"positions": np.concatenate([square, half + [1, 0, 0], half + [1, 0.5, 0]]), "types": np.array([9, 9, 9]),
                       "offsets": np.array([4, 8, 12]), "connectivity": np.arange(12)})
    close("length of an outline with a hanging node", np.linalg.norm(hanging[:, 1] - hanging[:, 0], axis=1).sum(), 5)
    expect("no outline of a membrane, which moves across its plane", outline({**membrane, "displacement": np.ones(4)}) is None)
    close("an outline moves", outline({**membrane, "displacement": square}).reshape(-1, 3).max(axis=0), [2, 2, 0])
    expect("no edge inside", not any((edge[:, 0] == 1).all() for edge in edges))

    path = run("block_impact", "Time/End=0.9", "Output/Field interval=0.3")
    panel, = draw("contact_pressure", path).axes
    x, pressure = panel.get_lines()[0].get_data()
    expect("pressure at the last field with some", panel.get_title("left") == "wall, t = 0.6 s" and pressure.min() > 100,
           panel.get_title("left"))
    figure = draw("stress", path)
    expect("a flat solid has a flat picture", figure.get_figheight() < 2, figure.get_figheight())
    panel, = draw("contact_pressure", run("cable_on_floor", "Time/End=0")).axes
    expect("a cable presses per length", panel.get_ylabel() == "force per length [N/m]", panel.get_ylabel())
    figure = draw("contact_pressure", run("hertz_sphere"))
    close("pressure over two axes", [len(figure.axes), figure.axes[0].collections[0].get_array().max()], [2, 101], 0.02)


def check_film():
    path = run("string_on_stop")
    done = program(path, "--film", "gif", "--plots", "probes", "--format", "png")
    expect("a film", done.returncode == 0, done.stderr)
    n_fields = len(read_collection(str(path / "fields/wires.pvd")))
    with Image.open(path / "figures" / "film.gif") as film:
        frames = []
        for i in range(film.n_frames):
            film.seek(i)
            frames.append(np.asarray(film.convert("L"))[film.height // 6:])  # without the title
    expect("frames of the film", len(frames) == n_fields and all((a != b).any() for a, b in zip(frames, frames[1:])), len(frames))
    expect("motions that are seen are not magnified", magnification({"a": np.array([[[[0, 0, 0]], [[1, 1, 0]]], [[[0, 0, 0]], [[1, 2, 0]]]])}) == 1)
    small = np.array([[[[0, 0, 0], [1, 1, 0]]], [[[0, 0, 0], [1, 1.002, 0]]]])
    expect("small motions are magnified", magnification({"a": small}) == 50, magnification({"a": small}))
    short, long = [0, 3e-6, 6e-5], [0, 0.25, 2]
    texts = [text_of(short[1], short), text_of(long[1], long)]
    expect("times of short films", texts == ["t = 3.000 µs", "t = 0.250 s"], texts)
    path = run("line_of_cables", "Time/End=0.02", "Output/Field interval=0.01")
    results = plot.Results(str(path))
    times, lines = read_frames(results)
    links = read_link_frames(results, times)
    close("droppers of the film", [links.shape], [(3, 27, 2, 3)])
    expect("bodies of the film", {"contact wire", "messenger 2"} <= set(lines), list(lines))
    if matplotlib.animation.writers.is_available("ffmpeg"):
        done = program(path, "--film", "mp4", "--plots", "sketch", "--format", "png")
        head = (path / "figures" / "film.mp4").read_bytes()[4:8] if done.returncode == 0 else b""
        expect("a film of ffmpeg", head == b"ftyp", done.stdout + done.stderr)
    done = program(path, "--film", "mp4", env={"PATH": ""})
    expect("no ffmpeg", done.returncode == 1 and done.stderr == "taut-plot: --film mp4: the program ffmpeg is missing; "
           "install the package ffmpeg or take --film gif\n", done.stderr)


finish_after(check_line, check_shapes, check_solids, check_film)
