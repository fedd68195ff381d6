#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hanging and swinging cables in MoorDyn, without water, and in Taut on the same machine: every table of
doc/results/moordyn.md. Needs the sources of MoorDyn 2 and its shared library:

    tests/benchmarks/moordyn/compare.py --program build/tests/benchmarks/moordyn_cable --sources MoorDyn/source
        --library MoorDyn/build/source

The runs of all settings follow each other, again and again, so that a busy machine slows down all of them; medians of
their processor times count.
"""
import argparse
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import lines
import scenes

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--program", default="build/tests/benchmarks/moordyn_cable", help="of Taut")
parser.add_argument("--sources", required=True, help="folder with MoorDyn2.h")
parser.add_argument("--library", required=True, help="folder with libmoordyn.so")
parser.add_argument("--compiler", default="c++")
parser.add_argument("--runs", type=int, default=3)
parser.add_argument("--only", default="", help="hanging, or the name of a swinging scene")
arguments = parser.parse_args()
os.environ["OPENBLAS_NUM_THREADS"] = "1"

# Explicit steps times the largest frequency of a segment, 2 sqrt(EA/m)/h, the largest that stay stable, and the most
# segments that are run again and again.
EXPLICIT = {"rk4": (2.7, 80), "rk2": (0.4, 20)}
SPAN = 60.
STEEL = {"mass": 1.07, "stiffness": 13e6, "damping": 130., "length": 70.}
ROPE = dict(STEEL, stiffness=1e5, damping=10.)
WAY, PERIOD = (-8., 0., 6.), 8.
SHORT = {"mass": 0.5, "stiffness": 1e6, "damping": 10., "length": 10.}
WEIGHT = 10.


class Swing:
    """A scene for both, the (elements, step) that Taut takes; `finest` are those of its reference."""

    def __init__(self, cable, end, interval, place, settings, finest):
        self.cable, self.end, self.interval, self.place = cable, end, interval, place
        self.settings, self.finest = settings, finest

    def is_pendulum(self):
        return self.cable is SHORT

    def text(self):
        if self.is_pendulum():
            return scenes.pendulum(self.cable, WEIGHT, self.end)
        return scenes.support(self.cable, SPAN, WAY, PERIOD, self.end)


def product(elements, steps):
    return [(n, step) for n in elements for step in steps]


COARSE = product((4, 8, 16, 32), ("0.1", "0.05", "0.02", "0.01", "0.005"))
FINE = product((4, 8, 16, 32), ("0.02", "0.01", "0.005", "0.0025", "0.00125")) + product((64,), ("0.00125", "0.000625"))
SWINGS = {
    "steel": Swing(STEEL, 8., .4, 35., COARSE, (64, "0.00125")),
    "rope": Swing(ROPE, 8., .4, 35., COARSE, (64, "0.00125")),
    "pendulum": Swing(SHORT, 3., .2, 10., FINE, (64, "0.0005")),
}
SEGMENTS = (10, 20, 40, 80, 160)  # of MoorDyn; the last ones make its reference


def run(command):
    done = subprocess.run([str(word) for word in command], text=True, capture_output=True, check=False)
    if done.returncode != 0:
        return {"message": (done.stderr.strip() or done.stdout.strip()).splitlines()[-1:]}
    return json.loads(done.stdout.strip().splitlines()[-1])


def taut(folder, text, place, interval, *options):
    file = pathlib.Path(folder) / "scene.prm"
    file.write_text(text)
    return run([arguments.program, file, place, interval, *options])


def build_peer(folder):
    peer = pathlib.Path(folder) / "peer"
    subprocess.run([arguments.compiler, "-O3", "-std=c++17", f"-I{arguments.sources}",
                    pathlib.Path(__file__).with_name("peer.cc"), "-o", peer, f"-L{arguments.library}", "-lmoordyn",
                    f"-Wl,-rpath,{pathlib.Path(arguments.library).resolve()}"], check=True)
    return peer


def peer_hanging(folder, peer, cable, n, solve):
    """Sag and end force in MoorDyn: of its own equilibrium, or of that of lumped_shape() as it sees it."""
    file = pathlib.Path(folder) / "line.txt"
    ends = {"last": "Coupled", "x": SPAN, "y": 0, "mass": 0}
    state = None if solve else lines.lumped_shape(cable, SPAN, n)[0]
    lines.write_input(file, cable, ends, n, {"tScheme": "rk4"}, state)
    found = run([peer, file, 1e-9, 1, 1, n // 2, int(solve), 0, 0, 0, SPAN, 0, 0])
    return -found["positions"][1][2], math.hypot(*found["forces"][3:]), found["end tension"], found["start seconds"]


def peer_swing(folder, peer, scene, n, scheme, factor):
    cable = scene.cable
    largest = factor / (2 * math.sqrt(cable["stiffness"] / cable["mass"]) * n / cable["length"])
    # Axial damping, part of the critical one of a segment, shortens the steps that are stable.
    largest /= 1 + cable["damping"] * n / cable["length"] / math.sqrt(cable["stiffness"] * cable["mass"])
    every = math.ceil(scene.interval / largest)
    step = scene.interval / every
    file = pathlib.Path(folder) / "line.txt"
    options = {"tScheme": scheme, "dtM": repr(step * (1 + 1e-9))}
    command = [peer, file, repr(step), every * round(scene.end / scene.interval), every]
    if scene.is_pendulum():
        length = cable["length"]
        straight = [(length * i / n, 0.) for i in range(n + 1)]
        lines.write_input(file, cable, {"last": "Free", "x": length, "y": 0, "mass": WEIGHT}, n, options, straight)
        command += [n, 0]
    else:
        shape = lines.lumped_shape(cable, SPAN, n)[0]
        lines.write_input(file, cable, {"last": "Coupled", "x": SPAN, "y": 0, "mass": 0}, n, options, shape)
        command += [n // 2, 0, 0, 0, 0, SPAN, 0, 0, "--", WAY[0], WAY[2], WAY[1], PERIOD]
    found = run(command)
    if "positions" in found:
        found["positions"] = [(x, z, y) for x, y, z in found["positions"]]
        found["step"] = step
    return found


def distance(some, others):
    """Root mean square over the run, without the start [m]."""
    squares = [sum((a - b) ** 2 for a, b in zip(p, q)) for p, q in zip(some[1:], others[1:])]
    return math.sqrt(sum(squares) / len(squares)) if len(some) == len(others) else math.inf


def hanging(folder, peer):
    for length in (78., 59.93):
        cable = dict(STEEL, length=length)
        sag, force = lines.catenary(cable, SPAN)
        print(f"\nUnstressed length {length} m: sag {sag:.6f} m, end force {force:.4f} N\n")
        print("| elements | Taut, bars | Taut, ANCF | seconds | MoorDyn, equilibrium given | MoorDyn, its own | seconds |"
              "\n|---|---|---|---|---|---|---|")
        for n in (10, 20, 40, 80, 160):
            cells, seconds = [], []
            for element in ("bar", "ANCF"):
                found = [taut(folder, scenes.hanging(cable, SPAN), length / 2, 1, f"Body cable.Element={element}",
                              f"Body cable.Elements={n}") for _ in range(arguments.runs)]
                seconds.append(statistics.median(each["start seconds"] for each in found))
                errors = abs(-found[0]["positions"][0][1] - sag), abs(math.hypot(*found[0]["multipliers"]) / force - 1)
                cells.append("{:.1e} m, {:.1e}".format(*errors))
            cells.append(f"{statistics.median(seconds):.3f}")
            for solve in (False, True) if n <= 40 else (False,):
                own_sag, own_force, tension, spent = peer_hanging(folder, peer, cable, n, solve)
                cells.append(f"{abs(own_sag - sag):.1e} m, {abs(own_force / force - 1):.1e} "
                             f"({abs(tension / force - 1):.1e})")
            cells += [f"{spent:.3f}"] if n <= 40 else ["-", "-"]
            print(f"| {n} | " + " | ".join(cells) + " |", flush=True)


def reference(folder, peer, name, scene):
    """Taut's own, MoorDyn's own, extrapolated, and what is known of them."""
    elements, step = scene.finest
    fine = {element: taut(folder, scene.text(), scene.place, scene.interval, f"Body cable.Element={element}",
                          f"Body cable.Elements={elements}", f"Time.Step={step}")["positions"]
            for element in ("bar", "ANCF")}
    peers = [peer_swing(folder, peer, scene, n, "rk4", EXPLICIT["rk4"][0]) for n in SEGMENTS[-3:]]
    own = [each["positions"] for each in peers]
    ends = [[[b + (b - a) / 3 for a, b in zip(p, q)] for p, q in zip(own[i], own[i + 1])] for i in (0, 1)]
    print(f"\n### {name}\n\nReferences [m, root mean square]: Taut, {elements} bars against ANCF, steps of {step} s: "
          f"{distance(fine['bar'], fine['ANCF']):.1e}; MoorDyn, {SEGMENTS[-2]} against {SEGMENTS[-1]} "
          f"segments: {distance(own[1], own[2]):.1e}, both extrapolated: {distance(*ends):.1e}; extrapolated MoorDyn "
          f"against Taut: {distance(ends[1], fine['bar']):.1e}. Least tension {peers[-1]['least tension']:.3g} N.\n")
    return fine["bar"], ends[1], peers[-1]


def swing(folder, peer, name, scene):
    of_taut, of_peer, finest = reference(folder, peer, name, scene)
    settings = [("Taut", "bar", n, step) for n, step in scene.settings]
    settings += [("MoorDyn", scheme, n, factor) for scheme, (factor, most) in EXPLICIT.items() for n in SEGMENTS
                 if n <= most]
    rows = {setting: [] for setting in settings}
    rows["MoorDyn", "rk4", SEGMENTS[-1], 0] = [dict(finest, error=distance(finest["positions"], of_peer))]
    for _ in range(arguments.runs):
        for setting in settings:
            program, kind, n, step = setting
            if program == "Taut":
                found = taut(folder, scene.text(), scene.place, scene.interval, f"Body cable.Element={kind}",
                             f"Body cable.Elements={n}", f"Time.Step={step}")
            else:
                found = peer_swing(folder, peer, scene, n, kind, step)
            if "positions" in found:
                found["error"] = distance(found["positions"], of_taut if program == "Taut" else of_peer)
                rows[setting].append(found)
    results = {setting: {"seconds": statistics.median(each["seconds"] for each in found), "error": found[0]["error"],
                         "step": found[0].get("step", setting[3])}
               for setting, found in rows.items() if found and found[0]["error"] < math.inf}
    for setting in settings:
        if setting not in results:
            print("failed:", *setting)
    print_swing(results)


def best(results, program):
    """Settings that no other of the program beats in both error and time."""
    own = {setting: value for setting, value in results.items() if setting[0] == program}
    return [(setting, value) for setting, value in sorted(own.items(), key=lambda item: item[1]["seconds"])
            if not any(other["seconds"] < value["seconds"] and other["error"] < 1.01 * value["error"]
                       for other in own.values())]


def print_swing(results):
    fronts = {program: best(results, program) for program in ("MoorDyn", "Taut")}
    print("| program | elements | step [s] | seconds | error [m] |\n|---|---|---|---|---|")
    for program, front in fronts.items():
        for setting, value in front:
            print(f"| {program}, {setting[1]} | {setting[2]} | {float(value['step']):.2g} | {value['seconds']:.3f} | "
                  f"{value['error']:.1e} |")
    print("\n| MoorDyn: segments, seconds, error [m] | Taut in no more time: error, MoorDyn's over it | Taut with no more "
          "error: seconds, MoorDyn's over them |\n|---|---|---|")
    for setting, value in fronts["MoorDyn"]:
        cells = [f"{setting[2]}, {value['seconds']:.3f}, {value['error']:.1e}"]
        as_fast = [other for _, other in fronts["Taut"] if other["seconds"] <= value["seconds"]]
        least = min((other["error"] for other in as_fast), default=None)
        cells.append("none is as fast" if least is None else f"{least:.1e}, {value['error'] / least:.2g}")
        as_good = [other for _, other in fronts["Taut"] if other["error"] <= value["error"]]
        least = min((other["seconds"] for other in as_good), default=None)
        cells.append("none is as good" if least is None else f"{least:.3f}, {value['seconds'] / least:.2g}")
        print("| " + " | ".join(cells) + " |")


with tempfile.TemporaryDirectory() as scratch:
    program_of_peer = build_peer(scratch)
    if arguments.only in ("", "hanging"):
        hanging(scratch, program_of_peer)
    for title, swinging in SWINGS.items():
        if arguments.only in ("", title):
            swing(scratch, program_of_peer, title, swinging)
