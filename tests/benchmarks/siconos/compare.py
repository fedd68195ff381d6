#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A unit bar falls on a rigid wall, in Siconos and in Taut on the same machine: every row of the table of
Siconos, Taut at the same elements and step, and error at equal cost and cost at equal error.

Needs the package python3-siconos and the Python that has it, /usr/bin/python3 on Debian:

    /usr/bin/python3 tests/benchmarks/siconos/compare.py --program build/tests/benchmarks/siconos_bar
"""

import argparse
import json
import pathlib
import subprocess
import sys
import time

try:
    import numpy as np
    import siconos.kernel as sk
except ImportError as missing:
    sys.exit(f"compare.py: {missing} in {sys.executable}; install python3-siconos and run this file with /usr/bin/python3")

# elements, step, theta
ROWS = [(50, "1e-2", 0.5), (50, "1e-2", 1.0), (50, "1e-3", 0.5), (50, "1e-4", 0.5),
        (200, "1e-2", 0.5), (200, "1e-3", 0.5), (200, "1e-3", 1.0), (200, "1e-4", 0.5)]
MEASURES = ("release", "force", "largest", "energy", "motion")
EXACT = {"release": 2.1, "force": 0, "largest": 1, "energy": 1, "motion": 0}


def siconos(n, step, theta):
    """Moreau and Jean's scheme, restitution 0, lumped mass, linear elements, as LCP with the default solver."""
    tau, end, h = float(step), 3.0, 1 / n
    mass = np.full(n + 1, h)
    mass[[0, -1]] = h / 2
    stiffness = np.zeros((n + 1, n + 1))
    for e in range(n):
        stiffness[e:e + 2, e:e + 2] += np.array([[1, -1], [-1, 1]]) / h
    bar = sk.LagrangianLinearTIDS(np.zeros(n + 1), -np.ones(n + 1), np.diag(mass), stiffness, np.zeros((n + 1, n + 1)))
    row = np.zeros((1, n + 1))
    row[0, 0] = 1
    contact = sk.Interaction(sk.NewtonImpactNSL(0.0), sk.LagrangianLinearTIR(row, [0.1]))
    model = sk.NonSmoothDynamicalSystem(0, end)
    model.insertDynamicalSystem(bar)
    model.link(contact, bar)
    simulation = sk.TimeStepping(model, sk.TimeDiscretisation(0, tau), sk.MoreauJeanOSI(theta), sk.LCP())
    times, forces, gaps = [], [], []
    begin = time.process_time()
    while simulation.hasNextEvent():
        simulation.computeOneStep()
        times.append(simulation.nextTime())
        forces.append(contact.lambda_(1)[0] / tau)
        gaps.append(bar.q()[0] + 0.1)
        simulation.nextStep()
    seconds = time.process_time() - begin
    v, q = bar.velocity(), bar.q()
    t, force, gap = map(np.array, (times, forces, gaps))
    plateau = force[(t > 0.2) & (t < 2.0)]
    exact = np.where(t < 0.1, 0.1 - t, np.where(t < 2.1, 0, t - 2.1))
    return {"seconds": seconds, "release": t[force > 0].max(), "deviation": plateau.std(),
            "force": np.sqrt(np.mean((plateau - 1) ** 2)), "largest": force.max(),
            "energy": (v @ (mass * v) + q @ stiffness @ q) / 1.0, "gap": gap.min(),
            "motion": np.sqrt(np.mean((gap - exact) ** 2))}


def taut(program, n, step, options, repeats):
    scene = pathlib.Path(__file__).with_name("bar.prm")
    done = subprocess.run([program, scene, str(repeats), f"Network.Wire bar.Element size={1 / n!r}", f"Time.Step={step}",
                           *options], text=True, capture_output=True, check=False)
    return json.loads(done.stdout) if done.returncode == 0 else {"message": done.stderr.strip()}


def errors(figures, step):
    """Distances to the exact values. A release is known to a step only, a sum of rounding is no error."""
    result = {name: abs(figures[name] - EXACT[name]) for name in MEASURES}
    result["release"] = max(result["release"] - float(step), 0)
    return {name: value if value > 1e-9 else 0 for name, value in result.items()}


def number(value):
    return f"{value:.3g}"


def line(label, n, step, f):
    if "message" in f:
        return f"| {label} | {n} | {step} | {f['message']} |"
    cells = [f"{f['seconds']:.2g}", f"{f['release']:.4f}", f"{f['deviation']:.4f}", f"{f['force']:.4f}",
             number(f["largest"]),
             f"{f['energy']:.4f}", f"{f['gap']:.0e}", f"{f['motion']:.1e}"]
    return f"| {label} | {n} | {step} | " + " | ".join(cells) + " |"


def setting(s):
    return f"{s['scheme']}, {s['n']}, {s['step']}"




def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True, help="siconos_bar of the build")
    parser.add_argument("--repeats", type=int, default=3, help="runs of each setting, the fastest counts")
    parser.add_argument("--schemes", default="Moreau-Jean lumped,Moreau-Jean lumped theta-1,Moreau-Jean reduced,Moreau-Jean gaps reduced,BDF2,"
                        "BDF2 massless reduced,Newmark massless,Newmark massless reduced,backward Euler",
                        help="separated by commas; after a name 'massless', 'lumped', 'reduced', 'gaps', 'theta-1'")
    arguments = parser.parse_args()

    def options(scheme):
        words = scheme.split()
        extra = []
        while words[-1] in EXTRA:
            extra.append(EXTRA[words.pop()])
        return [f"Time.Scheme={' '.join(words)}", *extra]

    rows = []
    for n, step, theta in ROWS:
        runs = [siconos(n, step, theta)]
        while len(runs) < arguments.repeats and runs[0]["seconds"] < 5:
            runs.append(siconos(n, step, theta))
        rows.append({**runs[0], "seconds": min(run["seconds"] for run in runs), "n": n, "step": step, "theta": theta})
        print(line(f"Siconos, theta {theta}", n, step, rows[-1]), file=sys.stderr, flush=True)

    ladder = []
    for scheme in (s.strip() for s in arguments.schemes.split(",")):
        for n in (25, 50, 100, 200, 400):
            for step in ("2e-2", "1e-2", "5e-3", "2.5e-3", "1e-3", "5e-4", "2e-4", "1e-4"):
                figures = taut(arguments.program, n, step, options(scheme), arguments.repeats)
                ladder.append({**figures, "scheme": scheme, "n": n, "step": step})
    ran = [s for s in ladder if "message" not in s]

    print("### The same elements and step\n")
    print("| | elements | step | seconds | release | deviation of force | error of force | largest force | energy kept | least gap | "
          "error of motion |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    print("| exact | | | | 2.1 | 0 | 0 | 1 | 1 | 0 | 0 |")
    for key in sorted({(row["n"], row["step"]) for row in rows}, key=lambda k: (k[0], -float(k[1]))):
        for row in (r for r in rows if (r["n"], r["step"]) == key):
            print(line(f"Siconos, theta {row['theta']}", *key, row))
        for s in ladder:
            if (s["n"], s["step"]) == key:
                print(line(f"Taut, {s['scheme']}", *key, s))

    print("\n### Cost at equal error\n\nThe cheapest setting of Taut whose errors are all at most those of the row, and the "
          "cheapest for the error of motion and of force alone: seconds of Siconos over seconds of Taut.\n")
    alone = ("motion", "force")
    print("| Siconos: theta, elements, step | seconds | Taut, all errors | factor | " +
          " | ".join(f"Taut, {name} | factor" for name in alone) + " |")
    print("|---|---|---|---|" + "---|---|" * len(alone))
    for row in rows:
        wanted = errors(row, row["step"])
        cells = [f"{row['theta']}, {row['n']}, {row['step']}", f"{row['seconds']:.2g}"]
        for names in (MEASURES, *((name,) for name in alone)):
            good = [s for s in ran if all(errors(s, s["step"])[name] <= wanted[name] for name in names)]
            best = min(good, key=lambda s: s["seconds"], default=None)
            cells += [setting(best), number(row["seconds"] / best["seconds"])] if best else ["none", "**lost**"]
        print("| " + " | ".join(cells) + " |")

    print("\n### Error at equal cost\n\nThe setting of Taut with the least error of motion among those that take at most the time "
          "of the row: errors of Siconos over its errors; below 1 Taut loses.\n")
    print("| Siconos: theta, elements, step | seconds | Taut | its seconds | " + " | ".join(MEASURES) + " |")
    print("|---|---|---|---|" + "---|" * len(MEASURES))
    for row in rows:
        theirs = errors(row, row["step"])
        best = min((s for s in ran if s["seconds"] <= row["seconds"]), key=lambda s: s["motion"])
        ours = errors(best, best["step"])
        cells = [f"{row['theta']}, {row['n']}, {row['step']}", f"{row['seconds']:.2g}", setting(best),
                 f"{best['seconds']:.2g}"]
        for name in MEASURES:
            value = "both 0" if ours[name] == theirs[name] == 0 else "Taut 0" if ours[name] == 0 else \
                number(theirs[name] / ours[name])
            cells.append(f"**{value}**" if ours[name] > theirs[name] else value)
        print("| " + " | ".join(cells) + " |")


# Words after the name of a scheme.
EXTRA = {"massless": "Time.Mass redistribution=mass", "lumped": "Network.Wire bar.Mass matrix=lumped",
         "reduced": "Network.Wire bar.Mass matrix=reduced", "gaps": "Time.Moreau-Jean.Conditions=gaps", "theta-1": "Time.Moreau-Jean.Theta=1"}

if __name__ == "__main__":
    main()
