# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hand-made results folders and short runs, and the pictures that taut-plot draws of them."""
import pathlib
import shutil
import subprocess
import sys
from types import SimpleNamespace

try:
    import matplotlib
    import numpy as np
    from PIL import Image  # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing}; install python3-matplotlib")
    sys.exit(77)

sys.path.append(str(pathlib.Path(__file__).parents[1]))
from checks import entries, expect, finish, load_plot, parse

arguments = parse(__doc__, "program", "root", "results")
SCRIPT = arguments.root / "source" / "plot" / "taut-plot"
plot = load_plot(SCRIPT)
from taut_plot_style import fit_texts, set_style

set_style()
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


def program(*words, **options):
    return subprocess.run([sys.executable, SCRIPT, *map(str, words)], capture_output=True, text=True, **options)


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


def finish_after(*checks):
    """Runs the checks, and says what failed."""
    for check in checks:
        check()
        matplotlib.pyplot.close("all")
    finish()
