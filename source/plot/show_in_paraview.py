#!/usr/bin/env pvpython
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shows the motion of a results folder of taut in ParaView: wires, bodies and links warped by their displacement, links as
points coloured by force.

  paraview --script=<path>/show_in_paraview.py               in a results folder, opens ParaView
  pvpython show_in_paraview.py RESULTS                       opens a window and plays the run
  pvpython show_in_paraview.py RESULTS --picture FILE.png    draws the last time, or the one given by --time

Displacements are drawn --factor times larger than they are, then all heights are drawn --height times larger, which
suits a line that is much longer than high."""

import argparse
import glob
import os
import sys

from paraview import simple as pv

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("results", nargs="?", default=".", metavar="RESULTS", help="folder of a run")
parser.add_argument("--factor", type=float, default=1., help="exaggeration of displacements (1)")
parser.add_argument("--height", type=float, help="exaggeration of heights (as much as a wide picture takes)")
parser.add_argument("--point-size", type=float, default=8., help="of a link, in pixels (8)")
parser.add_argument("--time", type=float, help="time to show [s]")
parser.add_argument("--picture", metavar="FILE.png", help="draw one time into a file, without a window")
arguments, _ = parser.parse_known_args(getattr(sys, "argv", [""])[1:])  # ParaView's own shell may hand over its own


def warped(path):
    """The fields of a collection, warped."""
    reader = pv.PVDReader(FileName=os.path.abspath(path))
    return pv.WarpByVector(Input=reader, Vectors=["POINTS", "displacement"], ScaleFactor=arguments.factor)


def higher(source, factor):
    scaled = pv.Transform(Input=source)
    scaled.TransformAllInputVectors = 0
    scaled.Transform.Scale = [1, factor, 1]
    pv.Hide3DWidgets(proxy=scaled.Transform)
    return scaled


sources = {os.path.basename(path)[:-4]: warped(path)
           for path in sorted(glob.glob(os.path.join(arguments.results, "fields", "*.pvd")))
           if not os.path.basename(path).startswith("contact_")}
if not sources:
    sys.exit(f"show_in_paraview.py: no fields in '{arguments.results}'; run with Output/Field interval > 0")

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

bounds = []
for source in sources.values():
    source.UpdatePipeline(scene.AnimationTime)
    bounds.append(source.GetDataInformation().GetBounds())
width, height = (max(b[i + 1] for b in bounds) - min(b[i] for b in bounds) for i in (0, 2))
factor = arguments.height or (max(1., 0.2 * width / height) if height > 0. else 1.)
sources = {name: higher(source, factor) for name, source in sources.items()}
links = sources.pop("links", None)

for source in sources.values():
    shown = pv.Show(source, view)
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
