"""Pictures of paint from its aspecular curve."""

from paintlink.preview.caption import LEAST_WIDTH, with_caption
from paintlink.preview.difference import difference_map
from paintlink.preview.exr import to_exr
from paintlink.preview.illustration import Illustration
from paintlink.preview.names import light_names, object_names
from paintlink.preview.picture import Picture, facts
from paintlink.preview.png import to_png
from paintlink.preview.render import render
from paintlink.preview.thumbnail_files import Written, write_thumbnails
from paintlink.preview.thumbnails import Sheet
from paintlink.preview.turntable import Turntable, to_webp, turn

__all__ = [
    "LEAST_WIDTH",
    "Illustration",
    "Picture",
    "Sheet",
    "Turntable",
    "Written",
    "difference_map",
    "facts",
    "light_names",
    "object_names",
    "render",
    "to_exr",
    "to_png",
    "to_webp",
    "turn",
    "with_caption",
    "write_thumbnails",
]
