"""What a fit gives back: a colour, what it rests on, and what is left over."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from paintlink.color import Curve, drawing_curve
from paintlink.errors import InputError
from paintlink.model import ColorSpec, FloatArray, Lab, Sample
from paintlink.sketch.evidence import Evidence
from paintlink.sketch.floor import Floor
from paintlink.sketch.paper_fit import PaperFit
from paintlink.sketch.selection import Reason, ReasonMap, counts


@dataclass(frozen=True, slots=True)
class AngleFit:
    """Lab at one aspecular angle, how sure it is, and what it rests on.

    Parameters
    ----------
    uncertainty
        One standard deviation of each channel; for an angle that is not measured,
        how far the value was carried beyond the painted ones.
    outside
        Share of the pixels with a channel at 0, where sRGB ends; their true colour
        may be more chromatic.
    """

    lab: Lab
    uncertainty: Lab
    evidence: Evidence
    outside: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class SketchFit:
    """A paint read out of a painting.

    Parameters
    ----------
    angles
        One for each wanted angle, ascending.
    travel
        The clamped quadratic through the sketch, for drawing beside the values.
    paper_rgb, paper_lab
        The paper's own fit, strays included, in both its colour spaces.
    step
        Every step-th row and column was looked at; the two maps have that size.
    reasons
        Index into `REASONS` of each pixel, shape (rows, columns).
    residual
        CIEDE2000 between painting and fit, NaN off the object, same shape.
    """

    name: str
    angles: tuple[AngleFit, ...]
    travel: Curve
    paper_rgb: PaperFit
    paper_lab: PaperFit
    floor: Floor
    step: int
    reasons: ReasonMap
    residual: FloatArray

    @property
    def counts(self) -> Mapping[Reason, int]:
        """How many pixels met each fate."""
        return counts(self.reasons)

    @property
    def curve(self) -> Curve:
        """Lab against the aspecular angle, through the fitted values."""
        angles = [item.evidence.aspecular_deg for item in self.angles]
        return drawing_curve(angles, [item.lab for item in self.angles])

    @property
    def notes(self) -> tuple[str, ...]:
        """What the person who painted should know before using the colour."""
        return (self.floor.sentence, *_doubts(self.angles))

    def spec(self) -> ColorSpec:
        """The colour specification of the sketch.

        Raises
        ------
        InputError
            When Lab at one of the angles is unknown.
        """
        refused = [i.evidence for i in self.angles if i.evidence.word == "refused"]
        if refused:
            reasons = "; ".join(item.reason for item in refused)
            msg = (
                f"{self.name}: the sketch does not give a colour at "
                f"{len(refused)} angles: {reasons}. Paint those parts of the object, "
                "or set up a scene with less exposure if they are too bright"
            )
            raise InputError(msg)
        samples = [Sample(i.evidence.aspecular_deg, i.lab) for i in self.angles]
        return ColorSpec(name=self.name, samples=tuple(samples))


def _doubts(angles: tuple[AngleFit, ...]) -> list[str]:
    doubts = []
    for item in angles:
        angle, reason = item.evidence.aspecular_deg, item.evidence.reason
        if reason:
            doubts.append(f"{angle:g} degrees is {item.evidence.word}: {reason}")
        if item.outside > 0.0:
            doubts.append(
                f"{angle:g} degrees: {100.0 * item.outside:.0f} % of the pixels lie on "
                "the border of sRGB, the colour meant may be more chromatic"
            )
    return doubts
