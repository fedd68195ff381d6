# SPDX-License-Identifier: LGPL-2.1-or-later
"""The scenes of compare.py for Taut."""

BODY = """
set Gravity = 0, -9.81
set Generator = network
set Bodies = cable
subsection Body cable
  set Type = cable
  set From = 0, 0, 0
  set Unstressed length = {length}
  set Axial stiffness = {stiffness}
  set Mass per length = {mass}
  set Axial damping = {damping}
  set Held ends = from
{more}end
subsection Output
  set Field interval = 0
end
"""


def _links(end, directions, to):
    return "".join(f"""  subsection Link {name}
    set From = cable @ {end}, 0
    set To = {to}
    set Direction = {direction}
  end
""" for name, direction in directions)


def hanging(cable, span):
    """Between level ends; the multipliers are the force of the last one."""
    return BODY.format(**cable, more=f"  set To = {span}, 0, 0\n") + f"""
subsection Network
  set Links = x, y
{_links(cable["length"], (("x", "1, 0, 0"), ("y", "0, 1, 0")), "ground")}end
subsection Time
  set End = 0
end
"""


def support(cable, span, way, period, end):
    """The last end moves by way * sin^4(pi t / period): it is held to the end of a wire whose supports move."""
    motions = "".join(f"""  subsection Support {name}
    set Wire = carrier
    set Positions = 0, 1
    set Motion = {motion}
    set Displacement = {distance} * sin(pi * t / {period})^4
  end
""" for name, motion, distance in zip("xyz", ("axial", "transverse", "lateral"), way))
    directions = (("x", "1, 0, 0"), ("y", "0, 1, 0"), ("z", "0, 0, 1"))
    return BODY.format(**cable, more=f"  set To = {span}, 0, 0\n") + f"""
subsection Network
  set Wires = carrier
  set Supports = x, y, z
  set Links = x, y, z
  subsection Wire carrier
    set From = {span}, 0, 0
    set To = {span + 1}, 0, 0
    set Components = bar, string, lateral
    set Axial stiffness = 1e6
    set Tension = 1000
    set Mass per length = 1
    set Element size = 1
    set Weight = false
  end
{motions}{_links(cable["length"], directions, "carrier @ 0")}end
subsection Time
  set End = {end}
end
"""


def pendulum(cable, mass, end):
    """A mass at the end of the cable, which starts level, straight, unstressed and at rest."""
    length = cable["length"]
    more = f"  set To = 0, {-1.0001 * length}, 0\n  set Start direction = 1, 0, 0\n"
    return BODY.format(**cable, more=more) + f"""
set Start = given
subsection Network
  set Masses = mass
  set Links = x, y
  subsection Mass mass
    set Position = 0, {-1.0001 * length}
    set Motions = x, y
    set Mass = {mass}
    set Initial displacement = {length}, {1.0001 * length}, 0
  end
{_links(length, (("x", "1, 0"), ("y", "0, 1")), "mass")}end
subsection Time
  set End = {end}
end
"""
