# SPDX-License-Identifier: LGPL-2.1-or-later
"""A scene of benchmarks: a block on a rigid floor, pressed at one edge so that it lifts elsewhere."""

SCENE = """set Generator = network
set Bodies    = block
set Contacts  = floor
set Gravity   = 0, 0
subsection Body block
  set Type                = solid
  set Dimension           = 3
  set Young's modulus     = 1e9
  set Poisson's ratio     = 0.3
  set Density             = 7850
  set Symmetry boundaries = 0, 2
  set Pressure            = 5: 1e6*exp(-(x^2+y^2)/0.02)
  subsection Mesh
    set Generator    = subdivided_hyper_rectangle
    set Arguments    = {cells} : 0, 0, 0 : {lengths}
    set Refinements  = {refinements}
    set Distribution = {distribution}
  end
end
subsection Contact floor
  set Slave           = block: 4
  set Obstacle        = plane
  set Point           = 0, 0, 0
  set Direction       = 0, 0, 1
  set Search distance = 0.1
end
subsection Output
  set Field interval = 0
end
subsection Time
  set End = 0
end
"""


def block_on_floor(cells, lengths, refinements=0, distribution="automatic"):
    """Text of a parameter file, with numbers of cells and lengths [m] along x, y and z."""
    return SCENE.format(cells=", ".join(map(str, cells)), lengths=", ".join(map(str, lengths)), refinements=refinements,
                        distribution=distribution)
