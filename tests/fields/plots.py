#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What taut-plot draws, number by number: pictures of hand-made results, whose lines, bars and titles are known. A picture that
draws nothing has none of these numbers."""
from drawing import (FORCE, SCRIPT, TIME, PARAMETERS, arguments, close, contact_table, draw, expect, finish_after, folder, named,
                     not_drawn, options, plot, program, set_style)
import json
import shutil
import subprocess
import sys

import matplotlib
import numpy as np
from PIL import Image
from taut_plot_assessment import rows as rows_of_assessment
from taut_plot_compare import PICTURES as COMPARED, labels_of
from taut_plot_elasticity import elasticity
from taut_plot_strips import deviation_in, power_spectrum, read_strips
from taut_plot_style import scale_of


def check_contacts():
    path = folder("contact", sliding=contact_table(pan=FORCE), certificate={"time [s]": TIME}, start=[("pan", 0, 100)])
    for n in (17, 1000, 2001):
        frequencies, power = power_spectrum(FORCE[:n], 1e-3)
        close("a spectrum has the variance", power.sum() * frequencies[1], FORCE[:n].var())
        close("parts of a spectrum, too", sum(deviation_in(frequencies, power, *band) ** 2 for band in ((0, 7), (7, 33.3), (33.3, 500))),
              FORCE[:n].var())
    figure = draw("force_spectrum", path)
    panel, = figure.axes
    expect("deviation of the bands", "0 to 5 Hz $\\sigma$ 7.1 N, 5 to 20 Hz $\\sigma$ 4.2 N" in panel.get_title("left"),
           panel.get_title("left"))
    frequencies, power = panel.get_lines()[0].get_data()
    expect("the peak of the spectrum", abs(frequencies[np.argmax(power)] - 2.5) <= frequencies[0] / 2, frequencies[np.argmax(power)])
    panel, = draw("force_spectrum", path, bands=[0, 8, 15]).axes
    expect("bands that are asked for", "8 to 15 Hz $\\sigma$ 4.2 N" in panel.get_title("left"), panel.get_title("left"))

    panel, = draw("force_histogram", path).axes
    close("parts of the histogram", sum(bar.get_height() for bar in panel.patches), 100)
    expect("a histogram says that it is of no filter", panel.get_xlabel() == "contact force, not filtered [N]", panel.get_xlabel())
    close("mean and three deviations", sorted(line.get_xdata()[0] for line in panel.get_lines()),
          FORCE.mean() + np.array([-3, 0, 3]) * FORCE.std())

    expect("extremes of the histogram", f"smallest {FORCE.min():.1f} N, largest {FORCE.max():.1f} N" in panel.get_title("left"),
           panel.get_title("left"))

    panel, = draw("force_by_span", path).axes
    parts = [FORCE[TIME <= 1], FORCE[TIME >= 1]]
    close("bars of the spans", [bar.get_height() for bar in panel.patches], [of(p) for of in (np.mean, np.max, np.std) for p in parts])
    not_drawn("force_by_span", folder("still", PARAMETERS.replace("50", "500"), sliding=contact_table(pan=FORCE)), "no contact passes")


# Steps of four lengths, the shortest where a run halves them, and a force whose third wave the filter takes away. Expected
# of the filter: its amplitude at each frequency; of all figures: those of this force in time, whatever the rows are.
UNEQUAL = np.concatenate([[0], np.cumsum(np.tile(np.repeat([2e-3, 1e-3, 5e-4, 2.5e-4], [20, 10, 40, 70]), 23))])
WAVES = ((10, 2.5), (6, 12), (2, 60))


def waves(time, cutoff=0.0):
    passed = [1 / (1 + (2 ** 0.5 - 1) * (f / cutoff) ** 6) if cutoff else 1.0 for _, f in WAVES]
    return 100 + sum(p * a * np.sin(2 * np.pi * f * time) for p, (a, f) in zip(passed, WAVES))


def moving_table(time, **forces):
    """At 50 m/s from x = 0 on."""
    table = {"time [s]": time}
    for name, force in forces.items():
        table.update({f"{name.replace('_', ' ')} position [m]": 50 * time, f"{name.replace('_', ' ')} force [N]": force})
    return table


UNEQUAL_LINE = PARAMETERS.replace("frequency = 0", "frequency = 20\n  set Window = 20, 80").replace(
    "set Number of spans = 2", "set Begin = 10\n  set Line = tables/line.csv")


def check_changed_steps():
    path = folder("halved", UNEQUAL_LINE, sliding=moving_table(UNEQUAL, pan_on_one=0.75 * waves(UNEQUAL), pan_on_two=0.25 * waves(UNEQUAL)),
                  start=[("pan on one", 0, 75), ("pan on two", 0, 25)])
    (path / "tables").mkdir()
    (path / "tables" / "line.csv").write_text("# a line\nheight; span ; droppers\n0; 25,5; 5\n0; 14,5; 5\n0; 40; 5\n0; 400; 5\n0;;\n")
    fine = np.arange(0.4, 1.6, 1e-5)
    middle = (0.3, UNEQUAL[-1] - 0.3)  # where the filter has forgotten the ends
    panel = draw("contact_force", path).axes[0]
    for label, factor in (("their sum, low-passed at 20 Hz", 1), ("share of 'one'", 0.75), ("share of 'two'", 0.25)):
        x, force = named(panel, label)[0].get_data()
        inside = (x > 50 * middle[0]) & (x < 50 * middle[1])
        close(f"{label} is over its own places", force[inside], factor * waves(x[inside] / 50, 20), 2e-3)
    close("rows of the table are drawn", named(panel, "contact force")[0].get_xydata(), np.transpose([50 * UNEQUAL, waves(UNEQUAL)]))
    window = waves(fine, 20)
    expect("statistics of the window", f"mean {window.mean():.1f} N, $\\sigma$ {window.std():.1f} N, 20 to 80 m" in panel.get_title("left"),
           panel.get_title("left"))

    panel, = draw("force_spectrum", path).axes
    expect("bands of the window", "0 to 5 Hz $\\sigma$ 7.1 N, 5 to 20 Hz $\\sigma$ 4.2 N" in panel.get_title("left"), panel.get_title("left"))
    panel, = draw("force_histogram", path).axes
    bars = panel.patches
    edges = [bar.get_x() for bar in bars] + [bars[-1].get_x() + bars[-1].get_width()]
    edges[0], edges[-1] = edges[0] - 1, edges[-1] + 1
    close("classes count by time", [bar.get_height() for bar in bars], 100 * np.histogram(window, edges)[0] / len(window), 0.3)
    expect("a histogram says its filter", panel.get_xlabel() == "contact force, low-passed at 20 Hz [N]", panel.get_xlabel())

    panel, = draw("force_by_span", path).axes
    close("places of the spans", [bar.get_x() for bar in panel.patches][:3], np.array([10, 35.5, 50]) + 0.1 * np.array([25.5, 14.5, 40]))
    parts = [waves(np.arange(a, b, 1e-3) / 50, 20) for a, b in ((10, 35.5), (35.5, 50), (50, 90))]
    close("bars of spans of a table", [bar.get_height() for bar in panel.patches], [of(p) for of in (np.mean, np.max, np.std) for p in parts],
          2e-3)
    expect("bars say their filter", "force low-passed at 20 Hz" in panel.get_xlabel(), panel.get_xlabel())

    runs = [plot.Results(str(path))]
    figure, _ = COMPARED["contact_force"](runs, ["a"], options())
    x, force = figure.axes[0].get_lines()[0].get_data()
    inside = (x > 50 * middle[0]) & (x < 50 * middle[1])
    close("forces that are compared", force[inside], waves(x[inside] / 50, 20), 2e-3)
    figure, _ = COMPARED["force_statistics"](runs, ["a"], options())
    close("statistics that are compared", [bar.get_height() for bar in figure.axes[0].patches],
          [of(window) for of in (np.mean, np.std, np.max, np.min)], 2e-3)
    figure, _ = COMPARED["force_spectrum"](runs, ["a"], options())
    frequencies, power = figure.axes[0].get_lines()[0].get_data()
    close("a spectrum that is compared", power[frequencies < 15].sum() * frequencies[0], 50 + 18, 0.02)

    # Between two rows without force there is none; half a row at both ends is rounding here.
    force = np.where((UNEQUAL > 0.5) & (UNEQUAL < 0.7), 0.0, 100.0)
    panel = draw("contact_force", folder("lost", UNEQUAL_LINE, sliding=moving_table(UNEQUAL, pan=force))).axes[0]
    lost = UNEQUAL[force == 0]
    share = float(panel.get_title("left").split("loss ")[1].split(" %")[0])
    close("share of the loss by time", share, 100 * (lost[-1] - lost[0]) / 1.2, 0.1)


def check_masts():
    """Of equal spans, of lists and of tables that begin anywhere; each wire has those of its tension length."""
    def results(name, catenary):
        return plot.Results(str(folder(name, "set Generator = catenary\nsubsection Catenary\n" + catenary + "end\n")))

    close("masts of equal spans", results("equal", "  set Begin = 7\n  set Number of spans = 2\n  set Span length = 30\n").masts(), [7, 37, 67])
    close("masts of a list", results("list", "  set Span lengths = 48, 55.5\n").masts("contact"), [0, 48, 103.5])
    both = results("tables", "  set Tension lengths = 1, west 1\n  subsection Tension length 1\n    set Line = ../a.csv\n  end\n"
                   "  subsection Tension length west 1\n    set Begin = -20.5\n    set Span lengths = 10, 12\n  end\n")
    (arguments.results / "tables" / "a.csv").write_text("span,droppers\n40,5 10\n52,\n,\n")
    for wire, places in (("contact 1", [0, 40, 92]), ("twin contact west 1", [-20.5, -10.5, 1.5]), ("stitch 1 2", [0, 40, 92]),
                         (None, [-20.5, -10.5, 0, 1.5, 40, 92])):
        close(f"masts of wire {wire}", both.supports(wire)[1], places)
    close("no masts without the table", results("lost table", "  set Line = none.csv\n").masts(), [])


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
    # A polygon, or a rectangle in later versions of matplotlib.
    places = lost.get_patch_transform().transform(lost.get_path().vertices)[:, 0]
    close("loss of the strip", [min(places), max(places)], [74.975, 100])
    expect("loss in the title", "loss 25.0 %" in panel.get_title("left"), panel.get_title("left"))

    path = folder("long names", sliding=contact_table(**{"a_contact_strip_of_a_pantograph_with_a_very_long_name_of_its_own" * 2: FORCE}))
    figure = draw("contact_force", path)
    figure.draw_without_rendering()
    title = figure.axes[0]._left_title
    expect("a long title is whole", "\n" in title.get_text() and title.get_window_extent().x1 <= figure.bbox.x1, title.get_text())


def check_probes():
    path = folder("masts", probes={"time [s]": TIME, "wire at 50 m [m]": 0.04 * np.sin(TIME), "wire at 100 m [m]": 0.02 * TIME,
                                   "still [m]": 1e-15 * TIME})
    (path / "statistics.json").write_text('{"probes": {"wire at 50 m": {"largest": {"value": 0.04, "expected": [0.03, 0.045]}}}}')
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
    columns = {"time [s]": np.arange(3.0)}
    for axis, force in (("x", [3, 5, 8]), ("y", [4, 12, 15]), ("z", [0, 0, 0])):
        columns.update(link_columns(f"pin {axis}", force, force, force))
    columns.update(link_columns("stop x", [0, 1, 2], [0, 1, 2], [0, 1, 2]))
    first, second = draw("link_forces", folder("joints with components", links=columns)).axes
    close("magnitude of a joint", first.get_lines()[0].get_ydata(), [5, 13, 17])
    expect("name of a joint", (first.get_title("left"), second.get_title("left")) == ("pin, magnitude", "stop x"), first.get_title("left"))
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
    (path / "sweep.csv").write_text('case,mass [kg],"k [N/m, N m/rad]",stop: largest force [N],message\n1,3,100,5,\n2,1,150,6,\n3,2,200,8,\n')
    panel, = plot.sweep_picture(str(path), options())[0].axes
    close("with units in the heads", panel.get_lines()[0].get_xydata(), [[1, 6], [2, 8], [3, 5]])
    expect("the same units", panel.get_xlabel() == "mass [kg] / k [N/m]", panel.get_xlabel())

    (path / "sweep.csv").write_text("case,pace,tip: largest [m],message\n1,sin(2*t),0.002,\n2,sin(3*t),0.004,\n")
    (path / "sweep.prm").write_text("subsection Sweep\n  subsection Parameter pace\n    set Entries = A/Magnitude\n  end\nend\n")
    panel, = plot.sweep_picture(str(path), options())[0].axes
    close("a bar for each formula, in mm", [bar.get_width() for bar in panel.patches], [2, 4])
    expect("names of the bars", [text.get_text() for text in panel.get_yticklabels()] == ["sin(2*t)", "sin(3*t)"] and
           panel.get_xlabel() == "tip: largest [mm]", panel.get_xlabel())

    # Mean force over the speed, in km/h 180, 252 and 360, with the curves of the standard and of the file, not for a sum of contacts.
    (path / "sweep.csv").write_text("case,v,pan: mean [N],both: mean [N],message\n1,50,100,200,\n2,70,120,240,\n3,100,150,300,\n")
    (path / "sweep.prm").write_text(
        "subsection Sweep\n  subsection Parameter v\n    set Entries = Catenary/Pantograph pan/Speed\n  end\nend\nsubsection Catenary\n"
        "  subsection Pantograph pan\n    # [m/s]\n    set Speed = 50\n  end\nend\nsubsection Statistics\n  set Supply = AC\n"
        "  set Least mean force = 0.0004, 60\nend\n")
    first, second = plot.sweep_picture(str(path), options())[0].axes
    given, least, most = (line.get_xydata() for line in first.get_lines())
    close("mean forces", given, [[50, 100], [70, 120], [100, 150]])
    close("largest mean force at the ends", [most[0], most[-1]], [[50, 0.00047 * 180**2 + 90], [100, 0.00097 * 360**2 + 70]])
    close("least mean force at the ends", [least[0], least[-1]], [[50, 0.0004 * 180**2 + 60], [100, 0.0004 * 360**2 + 60]])
    expect("limits say what they are", [text.get_text() for text in first.get_legend().get_texts()] ==
           ["least mean, as given", "largest mean, AC, after EN 50367"], first.get_legend())
    expect("a sum has none", len(second.get_lines()) == 1, len(second.get_lines()))


def check_elasticity():
    path = arguments.results / "elasticity"
    shutil.rmtree(path, ignore_errors=True)
    path.mkdir(parents=True)
    (path / "elasticity.csv").write_text("wire,x [m],elasticity [m/N]\none,10,4e-4\none,11,6e-4\none,12,5e-4\ntwo,10,1e-4\ntwo,12,1e-4\n")
    (path / "elasticity.json").write_text('{"force": {"value": 50, "unit": "N"}, "slackening": false, "wires": {}}')
    first, second = elasticity(str(path))[0].axes
    close("elasticity over x", first.get_lines()[0].get_xydata(), [[10, 0.4], [11, 0.6], [12, 0.5]])
    expect("non-uniformity", first.get_title("left").endswith("at 10 m, u 20 %") and "u 0 %" in second.get_title("left"),
           first.get_title("left"))
    expect("force of the elasticity", "50 N, droppers stay closed" in second.get_xlabel(), second.get_xlabel())
    done = program(path, "--format", "png")
    expect("a folder of elasticity", done.returncode == 0 and (path / "figures" / "elasticity.png").exists(), done.stderr)


def check_assessment():
    """Rows by hand of a line with one pantograph too strong, one dropper slack and an elasticity beside."""
    def of(value, unit="N", **more):
        return {"value": value, "unit": unit, **more}

    path = arguments.results / "assessment"
    shutil.rmtree(path, ignore_errors=True)
    path.mkdir(parents=True)
    wire = {"largest_elasticity": of(5e-4, "m/N"), "smallest_elasticity": of(3e-4, "m/N"), "nonuniformity": of(0.25, "1")}
    (path / "elasticity.json").write_text(json.dumps({"wires": {"contact": wire}}))
    contact = {"filtered": {"mean": of(140.04), "mean_at_this_speed": of(140.04, expected=[None, 130.6], inside=False),
                            "standard_deviation": of(30, expected=[26, 31], inside=True)},
               "contact_loss": of(0.012, "1", expected=[0, 0.05], inside=True), "largest_mean_force": {"source": "a standard"}}
    tree = {"sliding_contacts": {"p": contact}, "line_constants": {"p": {"speed": of(250 / 3.6, "m/s")}},
            "probes": {"mast 1": {"largest": of(0.0512, "m")}, "force": {"largest": of(5)}},
            "links": {"a": {"largest_force": of(80), "smallest_force": of(1), "slackenings": of(0, "1")},
                      "b": {"largest_force": of(90), "smallest_force": of(0), "slackenings": of(3, "1")}}}
    found = rows_of_assessment(tree, str(path))
    wanted = [("speed", "p", ("250.0 km/h", ""), "", ""), ("mean force F_m", "p", ("140.0 N", ""), "", ""),
              ("F_m at this speed", "p", ("140.0 N", "outside"), "at most 130.6 N", "a standard"),
              ("standard deviation σ", "p", ("30.0 N", "inside"), "26.0 to 31.0 N", ""),
              ("contact loss", "p", ("1.20 %", "inside"), "0.00 to 5.00 %", ""), ("uplift", "mast 1", ("51.2 mm", ""), "", ""),
              ("largest force of a dropper or link", "b", ("90.0 N", ""), "", ""), ("smallest", "b", ("0.0 N", ""), "", ""),
              ("links that went slack", "", ("1 of 2", ""), "", ""), ("largest elasticity", "contact", ("0.500 mm/N", ""), "", ""),
              ("smallest elasticity", "contact", ("0.300 mm/N", ""), "", "")]
    expect("assessment of a line", found[:-1] == wanted and found[-1][2] == ("25.0 %", ""), found)
    expect("no assessment without a line", rows_of_assessment({"probes": tree["probes"]}, "nowhere") == [])


def check_units():
    found = [scale_of([np.array([value])], unit) for value, unit in
             ((3e4, "N"), (50, "N"), (2e-4, "N"), (1e-5, "N m"), (2e-3, "m"), (3, "m"))]
    expect("units", found == [(1e-3, "kN"), (1.0, "N"), (1e3, "mN"), (1e6, "µN m"), (1e3, "mm"), (1.0, "m")], found)


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
    other = folder("other", sliding=contact_table(pan_2=FORCE))
    first, second = COMPARED["force_statistics"]([runs[0], plot.Results(str(other))], ["a", "b"], options())[0].axes
    expect("all strips have one axis of the statistics", first.get_xlim() == second.get_xlim() == (-0.5, 3.5), second.get_xlim())
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


finish_after(check_contacts, check_changed_steps, check_masts, check_strips, check_probes, check_links, check_sweep, check_elasticity,
             check_assessment, check_units, check_study, check_several, check_sizes, check_pipe)
