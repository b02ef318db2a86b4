"""How the nearest paints are found and judged."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from paintlink.config._keys import FilledText, Key, number, whole


@dataclass(frozen=True, slots=True, kw_only=True)
class SnapSettings:
    """ColorSnap: how the nearest paints are found and judged."""

    formula: Annotated[
        FilledText,
        Key(
            "Colour difference formula. Which paint is nearest depends on it, so keep "
            "one formula for all your work."
        ),
    ] = "cie76"
    library: Annotated[
        FilledText,
        Key(
            "Paint library that readings are compared with: virtual, munsell or one of "
            "your own (`paintlink library libraries` lists them). The service reads it "
            "when it starts."
        ),
    ] = "virtual"
    top: Annotated[int, whole(1, 1000), Key("Paints on the list of the nearest.")] = 20
    green: Annotated[
        float,
        number(0, 100),
        Key(
            "Up to this mean difference per angle a paint is shown in green: a good "
            "starting point for the formulation software, never a match by itself."
        ),
    ] = 1.5
    amber: Annotated[
        float,
        number(0, 100),
        Key("Up to this mean difference it is shown in amber, above it in red."),
    ] = 3.0
    repeatability: Annotated[
        float,
        number(0, 10),
        Key(
            "Mean difference between a reading of your instrument and its repetition. "
            "Says how sure the first rank is."
        ),
    ] = 0.1
    outside: Annotated[
        float,
        number(0, 200),
        Key(
            "Tell when a colour lies farther than this outside all colours of the "
            "library, in Lab units. The next keys say when to tell other problems."
        ),
    ] = 2.0
    sparse: Annotated[
        float,
        number(0, 200),
        Key("The ten nearest paints differ by more than this per angle."),
    ] = 12.0
    too_chromatic: Annotated[
        float, number(0, 200), Key("The nearest paint lacks more chroma than this.")
    ] = 3.0
    off_radial: Annotated[
        float,
        number(0, 200),
        Key("The hue travels farther off the radial line than the nearest paint's."),
    ] = 4.0
    face_and_flop: Annotated[
        float,
        number(0, 200),
        Key("Brighter face and darker flop, or the other way, by more than this."),
    ] = 4.0
    flop_index: Annotated[
        float,
        number(0, 100),
        Key("The Flop Index differs by more than this: the finish looks different."),
    ] = 3.0
