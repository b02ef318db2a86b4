"""Styling by sketch: set up a picture, read the painting back, fit a paint to it."""

from paintlink.sketch.fit import fit_painting
from paintlink.sketch.pose import Light, Pose
from paintlink.sketch.readback import Sketch, read_back
from paintlink.sketch.recipe import Recipe
from paintlink.sketch.report import report_picture
from paintlink.sketch.result import AngleFit, SketchFit
from paintlink.sketch.setup import SetUp, save, set_up
from paintlink.sketch.values import Painting, PixelGeometry

__all__ = [
    "AngleFit",
    "Light",
    "Painting",
    "PixelGeometry",
    "Pose",
    "Recipe",
    "SetUp",
    "Sketch",
    "SketchFit",
    "fit_painting",
    "read_back",
    "report_picture",
    "save",
    "set_up",
]
