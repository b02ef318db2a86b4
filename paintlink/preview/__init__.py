"""Pictures of paint from its aspecular curve."""

from paintlink.preview.caption import LEAST_WIDTH, with_caption
from paintlink.preview.names import light_names, object_names
from paintlink.preview.picture import Picture
from paintlink.preview.png import to_png
from paintlink.preview.render import render

__all__ = [
    "LEAST_WIDTH",
    "Picture",
    "light_names",
    "object_names",
    "render",
    "to_png",
    "with_caption",
]
