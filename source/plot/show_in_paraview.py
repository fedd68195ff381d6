#!/usr/bin/env pvpython
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shows the motion of a results folder of taut in ParaView: wires warped by their displacement, links as points
coloured by force.

  paraview --script=<path>/show_in_paraview.py               in a results folder, opens ParaView
  pvpython show_in_paraview.py RESULTS                       opens a window and plays the run
  pvpython show_in_paraview.py RESULTS --picture FILE.png    draws the last time, or the one given by --time

Displacements are drawn --factor times larger than they are, then all heights are drawn --height times larger, which
suits a line that is much longer than high."""

import argparse
import os
import sys

from paraview import simple as pv

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("results", nargs="?", default=".", metavar="RESULTS", help="folder with wires.pvd and links.pvd")
parser.add_argument("--factor", type=float, default=1., help="exaggeration of displacements (1)")
parser.add_argument("--height", type=float, help="exaggeration of heights (as much as a wide picture takes)")
parser.add_argument("--point-size", type=float, default=8., help="of a link, in pixels (8)")
parser.add_argument("--time", type=float, help="time to show [s]")
parser.add_argument("--picture", metavar="FILE.png", help="draw one time into a file, without a window")
arguments, _ = parser.parse_known_args(getattr(sys, "argv", [""])[1:])  # ParaView's own shell may hand over its own


def warped(name):
    """The fields of a collection, warped; None if the run has none."""
    path = os.path.abspath(os.path.join(arguments.results, name))
    if not os.path.exists(path):
        return None
    reader = pv.PVDReader(FileName=path)
    return pv.WarpByVector(Input=reader, Vectors=["POINTS", "displacement"], ScaleFactor=arguments.factor)


def higher(source, factor):
    scaled = pv.Transform(Input=source)
    scaled.TransformAllInputVectors = 0
    scaled.Transform.Scale = [1, factor, 1]
    pv.Hide3DWidgets(proxy=scaled.Transform)
    return scaled


wires, links = warped("wires.pvd"), warped("links.pvd")
if not wires and not links:
    sys.exit(f"show_in_paraview.py: no wires.pvd or links.pvd in '{arguments.results}'; "
             "run with Output/Field interval > 0")

view = pv.GetActiveViewOrCreate("RenderView")
view.ViewSize = [1600, 600]
view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
view.OrientationAxesVisibility = 0
scene = pv.GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
if arguments.time is None:
    scene.GoToLast()
else:
    scene.AnimationTime = arguments.time

(wires or links).UpdatePipeline(scene.AnimationTime)
bounds = (wires or links).GetDataInformation().GetBounds()
width, height = bounds[1] - bounds[0], bounds[3] - bounds[2]
factor = arguments.height or (max(1., 0.2 * width / height) if height > 0. else 1.)
wires, links = (source and higher(source, factor) for source in (wires, links))

if wires:
    shown = pv.Show(wires, view)
    pv.ColorBy(shown, ("POINTS", ""))
    shown.AmbientColor = shown.DiffuseColor = [0.2, 0.2, 0.2]
    shown.LineWidth = 1.5
if links:
    shown = pv.Show(links, view)
    shown.SetRepresentationType("Points")
    shown.PointSize = arguments.point_size
    shown.RenderPointsAsSpheres = 1
    pv.ColorBy(shown, ("POINTS", "force"))
    shown.RescaleTransferFunctionToDataRangeOverTime()
    colours = pv.GetColorTransferFunction("force")
    colours.ApplyPreset("Viridis (matplotlib)", True)
    bar = pv.GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle = "force [N]", ""
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    bar.TitleFontSize = bar.LabelFontSize = 12
    bar.WindowLocation = "Upper Right Corner"
    shown.SetScalarBarVisibility(view, True)

# x to the right, y up, seen from the front.
view.CameraParallelProjection = 1
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, 0, 1], [0, 0, 0], [0, 1, 0]
pv.ResetCamera(view)
view.CameraParallelScale = max(0.55 * factor * height, 0.55 * width * 600 / 1600)

if arguments.picture:
    pv.SaveScreenshot(arguments.picture, view, ImageResolution=[1600, 600])
else:
    pv.Render(view)
    if os.path.basename(sys.executable).startswith("pvpython"):
        scene.Play()
        pv.Interact(view)
