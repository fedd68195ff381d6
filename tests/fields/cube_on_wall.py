# SPDX-License-Identifier: LGPL-2.1-or-later
"""A cube of 16^3 elements in 32 parts, held at one face and pressed onto a tilted wall. Source: test
feti/fixedWall/steadystate/iterativeSolver/linearElasticity3D of ESPRESO, a total FETI code (github.com/It4innovations/espreso),
whose largest and mean displacement of all nodes are its expected results, for a residual of 1e-5 at which constraints differ
a little; its test allows 150 steps of MPRGP, without a preconditioner. Prints the iterations of Taut."""
import pathlib
import re
import subprocess
import sys

try:
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as missing:
    print(f"skipped: {missing}; install python3-vtk9")
    sys.exit(77)

sys.path.append(str(pathlib.Path(__file__).parents[1]))
from checks import entries, expect, finish, parse

arguments = parse(__doc__, "program", "results")
SCENE = """set Generator = network
set Bodies    = cube
set Contacts  = wall
set Gravity   = 0, 0
subsection Body cube
  set Type             = solid
  set Dimension        = 3
  set Young's modulus  = 2.1e7
  set Poisson's ratio  = 0.3
  set Density          = 7850
  set Fixed boundaries = 4
  set Pressure         = 3: 1e6
  subsection Mesh
    set Generator = subdivided_hyper_rectangle
    set Arguments = 16, 16, 16 : 0, 0, 0 : 1, 1, 1
  end
end
subsection Contact wall
  set Slave           = cube: 2
  set Obstacle        = plane
  set Point           = 0, -0.06, 0.05
  set Direction       = 0, 1, -0.05
  set Search distance = 0.3
end
subsection Solver
  set Interface operator = matrix-free
end
subsection Partition
  set Number of substructures = 32
end
subsection Time
  set End = 0
end
"""
LARGEST, MEAN = 7.992584e-02, 3.195737e-02


def displacements(folder):
    """Magnitude of the displacement of each node, once."""
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(folder / "fields" / "body_cube_00000.vtu"))
    reader.Update()
    grid = reader.GetOutput()
    nodes = np.round(vtk_to_numpy(grid.GetPoints().GetData()) * 16).astype(int)
    first = np.unique(nodes, axis=0, return_index=True)[1]
    return np.linalg.norm(vtk_to_numpy(grid.GetPointData().GetArray("displacement"))[first], axis=1)


arguments.results.mkdir(parents=True, exist_ok=True)
scene = arguments.results / "cube_on_wall.prm"
scene.write_text(SCENE)
closed = set()
for way in "semismooth Newton", "MPRGP":
    for preconditioner in "Dirichlet", "diagonal":
        folder = arguments.results / f"{way} {preconditioner}"
        run = subprocess.run([arguments.program, scene, "--overwrite", *entries(
            f"Output/Folder={folder}", f"Solver/Complementarity={way}", f"Solver/Preconditioner={preconditioner}")],
            capture_output=True, text=True)
        what = f"{way}, {preconditioner}"
        if not expect(what, run.returncode == 0, run.stdout + run.stderr):
            continue
        said = re.search(r"(\d+) active-set iterations, (\d+) iterations of conjugate gradients in (\d+) systems, (\d+) products", run.stdout)
        print(f"figure | {what}: sets, iterations, systems, products | {' '.join(said.groups())}")
        closed.add(re.search(r"(\d+) of 289 nodes are closed", run.stdout)[1])
        u = displacements(folder)
        print(f"figure | {what}: largest and mean displacement over those of ESPRESO | {u.max() / LARGEST:.5f} {u.mean() / MEAN:.5f}")
        expect(f"{what}: 17^3 nodes", u.size == 17 ** 3, u.size)
        expect(f"{what}: largest displacement", abs(u.max() / LARGEST - 1.) < 5e-3, u.max())
        expect(f"{what}: mean displacement", abs(u.mean() / MEAN - 1.) < 3e-4, u.mean())
expect("the same nodes are closed", len(closed) == 1, closed)
finish()
