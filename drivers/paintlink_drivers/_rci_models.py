"""What the models of the RCI dialect do in their own way: docs/wire/xrite_rci.md."""

import re
from collections.abc import Mapping
from dataclasses import dataclass

from paintlink import instrument, model

PLAIN = re.compile(r"\s*(?:\d+\.\d+[,\s]+){30}\d+\.\d+\s*")
MARKED = re.compile(r"\s*(?:X.*Y.*Z.*\s)?(?:\s*S\s*\d+\.\d+\s*){31}")
FLAT = (instrument.parse_geometry("45_0"),)
SPHERE = (model.Geometry(45.0, code="sphere"),)
WHITE = "Set the instrument on its white plaque."
BLACK = "Set the instrument on its black trap."


@dataclass(frozen=True, slots=True)
class Dialect:
    """How one model calibrates, hears its button and hands out a spectrum."""

    calibrate: Mapping[str, str]
    read: tuple[str, ...] = ()
    form: re.Pattern[str] = PLAIN
    geometry: tuple[model.Geometry, ...] = FLAT
    button: tuple[str, str] = ("01PB", "00PB")
    first_generation: bool = False


MODELS = {
    "DTP20": Dialect({"CR": WHITE}),
    "530": Dialect({"UC": WHITE}, ("01ST", "03TS")),
    "SP62": Dialect({"10XD": WHITE}, ("001GM",), geometry=SPHERE),
    "CA22": Dialect({"CA": WHITE, "CB": BLACK}, ("1SR",), MARKED, SPHERE),
    "DTP22": Dialect({"1CA": WHITE}, ("0SR",), MARKED, FLAT, ("3PB", "2PB"), True),
}
