#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What taut-plot draws, number by number: pictures of hand-made results, whose lines, bars and titles are known, and of short
runs, whose fields say the same. A picture that draws nothing has none of these numbers."""
import pathlib
import shutil
import subprocess
import sys
from types import SimpleNamespace

try:
    import matplotlib
    import numpy as np
    from PIL import Image
except ImportError as missing:
    print(f"skipped: {missing}; install python3-matplotlib")
    sys.exit(77)

sys.path.append(str(pathlib.Path(__file__).parents[1]))
from checks import entries, errors, expect, finish, load_plot, parse

arguments = parse(__doc__, "program", "root", "results")
SCRIPT = arguments.root / "source" / "plot" / "taut-plot"
plot = load_plot(SCRIPT)
from taut_plot_compare import PICTURES as COMPARED, labels_of
from taut_plot_files import read_collection
from taut_plot_film import magnification
from taut_plot_solids import outline
from taut_plot_strips import power_spectrum, read_strips
from taut_plot_style import LOSS, fit_texts, set_style

set_style()
LINE = matplotlib.lines.Line2D
PARAMETERS = """set Generator = catenary
subsection Time
  set End = 2
end
subsection Statistics
  set Filter frequency = 0
end
subsection Catenary
  set Number of spans = 2
  set Span length = 50
end
"""


def close(what, found, wanted, tolerance=1e-9):
    found, wanted = np.asarray(found, float), np.asarray(wanted, float)
    expect(what, found.shape == wanted.shape and np.allclose(found, wanted, rtol=tolerance, atol=tolerance), f"{found} not {wanted}")


def write_table(path, columns):
    np.savetxt(path, np.transpose(list(columns.values())), delimiter=",", header=",".join(columns), comments="", fmt="%.17g")


def folder(name, parameters=PARAMETERS, start=(), **tables):
    """A results folder with these tables; `start`: (link, x, force)."""
    path = arguments.results / name
    shutil.rmtree(path, ignore_errors=True)
    path.mkdir(parents=True)
    (path / "used.prm").write_text(parameters)
    (path / "start.csv").write_text("link,x [m],y [m],z [m],force [N or N m],gap [m or rad],length [m],stretched length [m]\n" +
                                    "".join(f"{link},{x},0,0,{force},0,0,0\n" for link, x, force in start))
    for table, columns in tables.items():
        write_table(path / f"{table}.csv", columns)
    return path


def options(**given):
    return SimpleNamespace(**{**dict(window=None, bands=None, wire=None, plots=None, quantity=None), **given})


def draw(name, path, **given):
    """The figure of one picture, its texts made to fit; an error if there is none."""
    known = {**plot.PICTURES, **plot.STATIC}
    figure, reason = known[name](plot.Results(str(path)), options(**given))
    if expect(f"{name} of {path.name} is drawn", figure is not None, reason):
        fit_texts(figure)
    return figure


def not_drawn(name, path, text):
    figure, reason = plot.PICTURES[name](plot.Results(str(path)), options())
    expect(f"{name} of {path.name} is left out", figure is None and text in (reason or ""), reason)


def run(name, *settings):
    path = arguments.results / name
    shutil.rmtree(path, ignore_errors=True)
    subprocess.run([arguments.program, arguments.root / "prm" / f"{name}.prm", *entries(f"Output/Folder={path}", *settings)],
                   check=True, stdout=subprocess.DEVNULL)
    return path


def program(*words):
    return subprocess.run([sys.executable, SCRIPT, *map(str, words)], capture_output=True, text=True)


def named(panel, label):
    return [line for line in panel.get_lines() if line.get_label() == label]


TIME = np.linspace(0, 2, 2001)
# Five whole periods of 2.5 Hz and twenty-four of 12 Hz; 50 m/s from x = 0 to 100 m.
FORCE = 100 + 10 * np.sin(2 * np.pi * 2.5 * TIME) + 6 * np.sin(2 * np.pi * 12 * TIME)


def contact_table(**forces):
    table = {"time [s]": TIME}
    for name, force in forces.items():
        name = name.replace("_", " ")
        table.update({f"{name} position [m]": 50 * TIME, f"{name} force [N]": force, f"{name} gap [m]": -force / 1e5})
    return table


def check_contacts():
    path = folder("contact", sliding=contact_table(pan=FORCE), certificate={"time [s]": TIME}, start=[("pan", 0, 100)])
    expect("a spectrum has the variance", abs(power_spectrum(FORCE, 1e-3)[1].sum() * 1 / (2.001) - (50 + 18)) < 0.3)
    figure = draw("force_spectrum", path)
    panel, = figure.axes
    expect("deviation of the bands", "0 to 5 Hz $\\sigma$ 7.1 N, 5 to 20 Hz $\\sigma$ 4.2 N" in panel.get_title("left"),
           panel.get_title("left"))
    frequencies, power = panel.get_lines()[0].get_data()
    expect("the peak of the spectrum", abs(frequencies[np.argmax(power)] - 2.5) < 0.3, frequencies[np.argmax(power)])
    panel, = draw("force_spectrum", path, bands=[0, 8, 13]).axes
    expect("bands that are asked for", "8 to 13 Hz $\\sigma$ 4.2 N" in panel.get_title("left"), panel.get_title("left"))

    panel, = draw("force_histogram", path).axes
    close("parts of the histogram", sum(bar.get_height() for bar in panel.patches), 100)
    close("mean and three deviations", sorted(line.get_xdata()[0] for line in panel.get_lines()),
          FORCE.mean() + np.array([-3, 0, 3]) * FORCE.std())

    panel, = draw("force_by_span", path).axes
    parts = [FORCE[TIME <= 1], FORCE[TIME >= 1]]
    close("bars of the spans", [bar.get_height() for bar in panel.patches], [of(p) for of in (np.mean, np.max, np.std) for p in parts])
    not_drawn("force_by_span", folder("still", PARAMETERS.replace("50", "500"), sliding=contact_table(pan=FORCE)), "no contact passes")


def check_strips():
    """The force of a strip on two wires is the sum, lost where neither wire carries."""
    first, second = np.where(TIME < 1, 80.0, 0.0), np.where((TIME > 0.5) & (TIME < 1.5), 40.0, 0.0)
    path = folder("strips", sliding=contact_table(pan_on_one=first, pan_on_two=second, other=FORCE),
                  start=[("pan on one", 0, 80), ("pan on two", 0, 0), ("other", 0, 0)])
    strips = read_strips(plot.Results(str(path)))
    expect("strips", [strip.name for strip in strips] == ["pan", "other"] and list(strips[0].shares) == ["one", "two"])
    close("sum of the strip", strips[0].force, first + second)
    panel = draw("contact_force", path).axes[0]
    close("share of a wire", named(panel, "share of 'two'")[0].get_ydata(), second)
    lost, = (patch for patch in panel.patches if patch.get_label() == "loss of contact")
    close("loss of the strip", lost.get_xy()[[0, 2], 0], [74.975, 100])
    expect("loss in the title", "loss 25.0 %" in panel.get_title("left"), panel.get_title("left"))

    path = folder("long names", sliding=contact_table(**{"a_contact_strip_of_a_pantograph_with_a_very_long_name_of_its_own" * 2: FORCE}))
    figure = draw("contact_force", path)
    figure.draw_without_rendering()
    title = figure.axes[0]._left_title
    expect("a long title is whole", "\n" in title.get_text() and title.get_window_extent().x1 <= figure.bbox.x1, title.get_text())


def check_probes():
    path = folder("masts", probes={"time [s]": TIME, "wire at 50 m [m]": 0.04 * np.sin(TIME), "wire at 100 m [m]": 0.02 * TIME,
                                   "still [m]": 1e-15 * TIME})
    (path / "statistics.json").write_text('{"probes": {"wire at 50 m": {"largest": {"value": 40, "expected": [30, 45]}}}}')
    panel, = draw("uplift", path, plots=["uplift"]).axes
    close("uplift of each mast", [bar.get_height() for bar in panel.patches], [40, 40])
    close("its limits", sorted(line.get_ydata()[0] for line in panel.get_lines()), [30, 45])
    panel, = draw("probes", path).axes
    close("probes that move", [len(line.get_xdata()) for line in panel.get_lines()], [2, 2001, 2001])
    expect("what stands still is said", "1 displacement that does not change is left out" in panel.get_xlabel(), panel.get_xlabel())


def link_columns(name, least, largest, force):
    n = len(force)
    return {f"{name} force [N]": force, f"{name} force least [N]": least, f"{name} force largest [N]": largest,
            f"{name} gap [m]": np.where(np.array(force) == 0, 1.0, -1.0), f"{name} gap largest [m]": np.where(np.array(least) == 0, 1.0, -1.0),
            f"{name} gap least [m]": -np.ones(n)}


def check_links():
    columns = {"time [s]": np.arange(3.0)}
    for i in range(8):
        force = 100 + i * np.arange(3.0)
        columns.update(link_columns(f"joint {i}", force, force, force))
    path = folder("joints", links=columns)
    figure = draw("link_forces", path)
    expect("links that do not open", "have the forces that change most; 1 does not change" in figure._suptitle.get_text(),
           figure._suptitle.get_text())
    figure = draw("link_map", path)
    field = figure.axes[0].collections[0]
    close("force minus that of the start", field.get_array().reshape(8, 3), np.outer(np.arange(8), np.arange(3)))
    expect("joints do not set the scale", field.get_clim()[1] < 15, field.get_clim())
    still = folder("still links", links={"time [s]": np.arange(3.0), **link_columns("a", [5, 5, 5], [5, 5, 5 + 1e-12], [5, 5, 5])})
    not_drawn("link_forces", still, "change by rounding only")

    columns = {"time [s]": np.arange(3.0)}
    for i, (least, largest) in enumerate((([50, 40, 45], [50, 60, 70]), ([50, 0, 40], [50, 20, 90]), ([50, 50, 50], [50, 50, 50]))):
        columns.update(link_columns(f"dropper 1.{i}", least, largest, least))
    path = folder("droppers", links=columns, start=[(f"dropper 1.{i}", 5.0 * i, 50) for i in range(3)])
    panel, = draw("dropper_forces", path).axes
    ends = {tuple(np.ravel(line)) for lines in panel.collections for line in lines.get_segments()}
    expect("ranges of the droppers", ends == {(0, 40, 0, 70), (5, 0, 5, 90), (10, 50, 10, 50)}, ends)

    path = folder("stacked", PARAMETERS.replace("End = 2", "End = 0"), start=[("a x", 3, 10), ("a y", 3, -20), ("a z", 3, 30)])
    panel, = draw("static_links", path).axes
    close("links at one x", [bar.get_width() for bar in panel.patches], [10, -20, 30])


def check_sweep():
    path = arguments.results / "zipped"
    shutil.rmtree(path, ignore_errors=True)
    path.mkdir(parents=True)
    (path / "sweep.csv").write_text("case,mass,k,stop: largest force [N],message\n1,3,100,5,\n2,1,150,6,\n3,2,200,8,\n")
    (path / "sweep.prm").write_text(
        "subsection Sweep\n  set Combination = zipped\n  subsection Parameter mass\n    set Entries = A/Mass\n  end\n"
        "  subsection Parameter k\n    set Entries = A/Stiffness\n  end\nend\nsubsection A\n  # [kg]\n  set Mass = 1\n"
        "  # A number or 'rigid' [N/m, N m/rad]\n  set Stiffness = 2\nend\n")
    figure, _ = plot.sweep_picture(str(path), options())
    panel, = figure.axes
    expect("zipped parameters are one line", len(panel.get_lines()) == 1, len(panel.get_lines()))
    close("its values", panel.get_lines()[0].get_xydata(), [[1, 6], [2, 8], [3, 5]])
    expect("its units", panel.get_xlabel() == "mass [kg] / k [N/m]", panel.get_xlabel())


def check_study():
    path = arguments.results / "study"
    shutil.rmtree(path, ignore_errors=True)
    path.mkdir(parents=True)
    (path / "study.json").write_text('{"parameters": [{"name": "scheme", "values": ["HHT", "BDF2"]}], "end [s]": 2}')
    (path / "work_precision.csv").write_text(
        "scheme,error [1],error of finer ones too [1],error of the reference [1],seconds,x real time,front,message\n"
        "HHT,0.1,0.1,0.001,1,2,1,\nHHT,0.01,0.01,0.001,4,0.5,1,\nBDF2,0.2,0.2,0.001,2,1,0,\nBDF2,0,0,0,0,0,0,diverged\n")
    figure, _ = plot.work_precision(str(path))
    lines = [line.get_xydata().tolist() for line in figure.axes[0].get_lines()]
    expect("errors over cost", lines.count([[1, 0.1], [4, 0.01]]) == 3 and lines.count([[2, 0.2]]) == 2, lines)


def check_several():
    one = folder("one/result", sliding=contact_table(pan=FORCE), probes={"time [s]": TIME, "tip [m]": TIME})
    two = folder("two/result", sliding=contact_table(pan=2 * FORCE), probes={"time [s]": TIME, "tip [m]": 3 * TIME})
    labels = labels_of([str(one), str(two)])
    expect("names of the folders", labels == ["one/result", "two/result"], labels)
    runs = [plot.Results(str(path)) for path in (one, two)]
    for name, wanted in (("contact_force", [FORCE, 2 * FORCE]), ("probes", [1e3 * TIME / 1e3, 3 * TIME])):
        figure, _ = COMPARED[name](runs, labels, options())
        lines = [line.get_ydata() for line in figure.axes[0].get_lines() if len(line.get_ydata()) > 2]
        close(f"{name} of two runs", lines, wanted)
        texts = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
        expect(f"legend of {name}", texts == labels, texts)
    figure, _ = COMPARED["force_statistics"](runs, labels, options())
    close("statistics of two runs", [bar.get_height() for bar in figure.axes[0].patches],
          [factor * of(FORCE) for factor in (1, 2) for of in (np.mean, np.std, np.max, np.min)])
    figure, _ = COMPARED["force_spectrum"](runs, labels, options())
    first, second = (line.get_ydata() for line in figure.axes[0].get_lines() if len(line.get_ydata()) > 2)
    close("spectra of two runs", second / first, np.full(len(first), 4), 1e-6)
    done = program(one, two, "--format", "png")
    expect("several folders", done.returncode == 0 and (one / "comparison" / "contact_force.png").stat().st_size > 10000, done.stderr)


def check_sizes():
    path = folder("sizes", sliding=contact_table(pan=FORCE), certificate={"time [s]": TIME}, start=[("pan", 0, 100)])
    for width, inches in (("column", 88 / 25.4), ("page", 180 / 25.4)):
        program(path, "--width", width, "--plots", "contact_force", "--format", "png", "--output", path / width)
        with Image.open(path / width / "contact_force.png") as picture:
            close(f"width of the {width}", picture.width / picture.info["dpi"][0], inches, 0.005)
        expect("only what is asked for", [file.name for file in (path / width).iterdir()] == ["contact_force.png"])
    set_style("column")
    sizes = [matplotlib.rcParams[name] for name in ("font.size", "legend.fontsize", "xtick.labelsize")]
    set_style()
    expect("fonts of a column", min(sizes) >= 7, sizes)
    done = program(path, "--plots", "nothing")
    expect("no such picture", done.returncode == 1 and done.stderr.startswith("taut-plot: --plots nothing: there is no such"), done.stderr)


def check_pipe():
    """Pictures are drawn although nobody reads the list of them."""
    path = folder("pipe", sliding=contact_table(pan=FORCE), certificate={"time [s]": TIME}, start=[("pan", 0, 100)])
    process = subprocess.Popen([sys.executable, SCRIPT, str(path), "--format", "png"], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               text=True)
    process.stdout.close()
    said = process.stderr.read()
    expect("a closed pipe", process.wait() == 0 and not said, said)
    expect("pictures into a closed pipe", (path / "figures" / "force_histogram.png").exists())


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
    frames = [plot.read_vtu(file) for _, file in read_collection(str(path / "wires.pvd"))]
    number = next(w for w, name in frames[0][3].items() if name == "contact 1")
    motion = np.array([u[wires[number], 1] for _, u, wires, _ in frames])
    highest, = named(figure.axes[1], "highest")
    close("envelope", highest.get_ydata(), 1e3 * (motion - motion[0]).max(axis=0)[::2], 1e-4)
    close("profile", figure.axes[0].get_lines()[0].get_ydata(), 1e3 * motion[0][::2], 1e-4)

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
    close("its shape", np.array(lines.get_segments()).reshape(-1, 2), arrays["positions"][arrays["connectivity"]][:, :2])
    film = program(path, "--film", "gif", "--plots", "sketch", "--format", "png")
    expect("no film of one field", "no film: fields of wires or bodies at two times" in film.stdout, film.stdout + film.stderr)


def check_solids():
    """Two squares with points of their own have six edges outside; contacts are drawn while they carry."""
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
    edges = outline({"positions": np.concatenate([square, square + [1, 0, 0]]), "types": np.array([9, 9]),
                     "connectivity": np.arange(8), "offsets": np.array([4, 8])})
    close("edges of two squares", [len(edges), *edges.reshape(-1, 3).max(axis=0)], [6, 2, 1, 0])
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
    n_fields = len(read_collection(str(path / "wires.pvd")))
    with Image.open(path / "figures" / "film.gif") as film:
        frames = []
        for i in range(film.n_frames):
            film.seek(i)
            frames.append(np.asarray(film.convert("L"))[film.height // 6:])  # without the title
    expect("frames of the film", len(frames) == n_fields and all((a != b).any() for a, b in zip(frames, frames[1:])), len(frames))
    expect("motions that are seen are not magnified", magnification({"a": np.array([[[[0, 0, 0]], [[1, 1, 0]]], [[[0, 0, 0]], [[1, 2, 0]]]])}) == 1)
    small = np.array([[[[0, 0, 0], [1, 1, 0]]], [[[0, 0, 0], [1, 1.002, 0]]]])
    expect("small motions are magnified", magnification({"a": small}) == 50, magnification({"a": small}))
    if not matplotlib.animation.writers.is_available("ffmpeg"):
        done = program(path, "--film", "mp4")
        expect("no ffmpeg", done.returncode == 1 and done.stderr == "taut-plot: --film mp4: the program ffmpeg is missing; "
               "install it or take --film gif\n", done.stderr)


for check in (check_contacts, check_strips, check_probes, check_links, check_sweep, check_study, check_several, check_sizes, check_pipe, check_line,
              check_shapes, check_solids, check_film):
    check()
    matplotlib.pyplot.close("all")
finish()
