"""Shows the series of a run as kinemesh's own pictures do: replaced triangles amber, edges drawn.

    pvpython examples/paraview_series.py DIR [OUT.png]

or, in ParaView's Python shell, after setting sys.argv.

Without OUT.png the last mesh stays on the screen; with it, every mesh is written: OUT.0000.png, OUT.0001.png,
and so on.
Where there is no screen: xvfb-run pvpython ... (Debian's packages paraview, python3-paraview, xvfb)."""

import os
import sys

from paraview.simple import (ColorBy, GetActiveViewOrCreate, GetAnimationScene, GetColorTransferFunction,
                             Interact, PVDReader, Render, SaveAnimation, Show)

series = PVDReader(FileName=os.path.join(sys.argv[1], "mesh.pvd"))
view = GetActiveViewOrCreate("RenderView")
view.ViewSize = [1280, 800]
view.InteractionMode = "2D"
view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
view.OrientationAxesVisibility = 0

mesh = Show(series, view)
mesh.Representation = "Surface With Edges"
mesh.Ambient, mesh.Diffuse = 1, 0  # colours as they are, without light
mesh.EdgeColor = [0.49, 0.56, 0.64]
ColorBy(mesh, ("CELLS", "replaced"))  # others: label, region
colours = GetColorTransferFunction("replaced")
colours.RGBPoints = [0, 0.88, 0.91, 0.95, 1, 1.0, 0.81, 0.36]
colours.ColorSpace = "Step"

scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
view.ResetCamera()
x0, x1, y0, y1 = series.GetDataInformation().GetBounds()[:4]
view.CameraParallelScale = 0.52 * max(y1 - y0, (x1 - x0) * view.ViewSize[1] / view.ViewSize[0])
if len(sys.argv) > 2:
    SaveAnimation(sys.argv[2], view)
else:
    scene.GoToLast()
    Render(view)
    Interact(view)
