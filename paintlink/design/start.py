"""Starting colours: a known paint, a specification, or a blank."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from paintlink.design.bare import bare
from paintlink.design.limits import possible, with_possible_chroma
from paintlink.design.state import State
from paintlink.design.weights import FACE_DEG, FLOP_DEG, MIDDLE_DEG
from paintlink.errors import DesignError
from paintlink.library import find, paint_spec
from paintlink.model import ColorSpec, Lab, PaintTable, Sample

ANGLES_DEG = {
    3: (FACE_DEG, MIDDLE_DEG, FLOP_DEG),
    5: (FACE_DEG, 25.0, MIDDLE_DEG, 75.0, FLOP_DEG),
}
"""Aspecular angles of a design by their number."""

GREY = Lab(50.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Start:
    """A starting colour and where it came from, in words.

    The specification holds 3 or 5 samples and nothing that was measured beside them.

    Raises
    ------
    DesignError
        When it has other aspecular angles, or a colour that no surface can have.
    """

    spec: ColorSpec
    source: str

    def __post_init__(self) -> None:
        if self.spec.angles_deg not in ANGLES_DEG.values():
            raise DesignError(_other_angles(self.spec))
        if not possible(self.spec.lab()):
            msg = f"no surface can have the colour {self.spec.name}: XYZ is below 0"
            raise DesignError(msg)

    @property
    def state(self) -> State:
        """What the first step starts from."""
        return State(self.spec.angles_deg, self.spec.lab(), self.spec.observer)


def from_spec(spec: ColorSpec, source: str, *, count: int | None = None) -> Start:
    """Start from a specification, with all its angles or 3 or 5 of them.

    Readings of dark, saturated paints may have XYZ below 0, by noise. Such a sample
    keeps its hue and loses chroma until it can be, and the source says so.

    Raises
    ------
    DesignError
        When it does not have these angles.
    """
    wanted = ANGLES_DEG[count] if count else spec.angles_deg
    samples = tuple(one for one in spec.samples if one.aspecular_deg in wanted)
    if count and len(samples) != count:
        raise DesignError(_other_angles(spec))
    made = [_possible(one) for one in samples]
    changed = [f"{one.aspecular_deg:g}" for one in samples if one not in made]
    if changed:
        source += f"; chroma reduced at {', '.join(changed)} degrees: XYZ was below 0"
    return Start(replace(bare(spec), samples=tuple(made)), source)


def _possible(sample: Sample) -> Sample:
    lab, _ = with_possible_chroma(np.array(sample.lab))
    return Sample(sample.aspecular_deg, Lab(*lab.tolist()))


def from_library(table: PaintTable, code: str, *, count: int = 3) -> Start:
    """Start from a known paint.

    Raises
    ------
    LibraryError
        When there is no such code; names the codes that come near.
    """
    spec = paint_spec(table, find(table, code), angles_deg=ANGLES_DEG[count])
    source = f"{spec.code}, {table.library}, generation {table.generation}"
    return from_spec(spec, source)


def blank(*, count: int = 3) -> Start:
    """Start from a middle grey without travel."""
    samples = tuple(Sample(angle, GREY) for angle in ANGLES_DEG[count])
    return Start(ColorSpec(name="blank", samples=samples), "blank")


def designed(start: Start, state: State, name: str) -> ColorSpec:
    """The colour as an ordinary specification, without a paint's code."""
    rows = zip(state.angles_deg, state.lab.tolist(), strict=True)
    samples = tuple(Sample(angle, Lab(*lab)) for angle, lab in rows)
    return replace(start.spec, name=name, code="", samples=samples)


def _other_angles(spec: ColorSpec) -> str:
    have = "/".join(f"{angle:g}" for angle in spec.angles_deg)
    count = max(
        (n for n, angles in ANGLES_DEG.items() if {*angles} <= {*spec.angles_deg}),
        default=0,
    )
    remedy = (
        f"ask for {count} angles to leave the others out"
        if count
        else "start from a colour measured there"
    )
    return (
        "a design has the aspecular angles 15/45/110 or 15/25/45/75/110, "
        f"but {spec.name} has {have}: {remedy}"
    )
