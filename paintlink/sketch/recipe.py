"""The recipe of a sketch: everything the pictures were computed from."""

from __future__ import annotations

from dataclasses import dataclass

from paintlink.errors import InputError
from paintlink.model import ColorSpec
from paintlink.sketch.pose import Pose

BITS = (8, 16)
MOST_EXPOSURE = 1.0


@dataclass(frozen=True, slots=True)
class Recipe:
    """What brings back the start picture and the geometry, to the bit.

    Parameters
    ----------
    start
        The paint the artist starts from; only name, observer and samples are kept.
    start_id
        Identity of the specification it came from.
    exposure
        Linear value of a perfect diffuser facing the light, 0 to 1.
    bits
        Depth of the pictures, 8 or 16 a channel.
    start_sha256, geometry_sha256
        Of the samples of the two pictures, row by row, big-endian.
    """

    pose: Pose
    start: ColorSpec
    start_id: str
    exposure: float
    bits: int
    start_sha256: str = ""
    geometry_sha256: str = ""

    def __post_init__(self) -> None:
        if not 0.0 < self.exposure <= MOST_EXPOSURE:
            msg = f"the exposure lies between 0 and 1, not at {self.exposure:g}"
            raise InputError(msg)
        if self.bits not in BITS:
            msg = f"pictures have 8 or 16 bits a channel, not {self.bits}"
            raise InputError(msg)
