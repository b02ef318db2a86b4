"""Curves of a design: L, a, b against the aspecular angle, and the a-b plane."""

from __future__ import annotations

import io
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from paintlink.color import fit, lab_to_hex
from paintlink.errors import ConfigError
from paintlink.model import ColorSpec, FloatArray, Sample

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PlotFormat = Literal["png", "svg"]

FINEST_DEG = 0.5
LEAST_SPAN = 10.0
"""Lab units an axis shows at least, so that noise never looks like travel."""

DPI = 100
INK = "#262628"
START, DESIGNED, NEAREST = "#9aa0a6", "#0b62a8", "#c05621"
LEGEND = "marks: samples; lines: clamped quadratic"


@dataclass(frozen=True, slots=True)
class _Line:
    label: str
    spec: ColorSpec
    color: str
    style: str
    marker: str
    width: float = 1.6

    def curve(self) -> tuple[FloatArray, FloatArray]:
        """Angles and Lab of the clamped quadratic."""
        angles = self.spec.angles_deg
        degrees = np.arange(angles[0], angles[-1] + FINEST_DEG, FINEST_DEG)
        return degrees, fit(angles, self.spec.lab(), "clamped")(degrees)


def plot(
    start: ColorSpec,
    design: ColorSpec,
    nearest: ColorSpec,
    *,
    format: PlotFormat = "png",
) -> bytes:
    """The curves of a design beside those of its start and of the nearest paint.

    Marks are samples, lines the clamped quadratic: through three samples, fitted to
    five. In the a-b plane the marks have the colour of their sample, and those of the
    design say its angle.

    Raises
    ------
    ConfigError
        When matplotlib is not installed.
    """
    figure = _figure()
    paint = f"nearest: {nearest.code} {nearest.name}"
    lines = (
        # Wide, so that it shows below a design that did not change a channel.
        _Line(f"start: {start.name}", start, START, "--", "o", 3.2),
        _Line(f"design: {design.name}", design, DESIGNED, "-", "s"),
        _Line(paint, nearest, NEAREST, ":", "^"),
    )
    *channels, plane = figure.subplots(2, 2).ravel()
    for channel, axes in enumerate(channels):
        _draw_channel(axes, channel, lines)
    _draw_plane(plane, lines)
    _draw_legend(figure, lines)
    data = io.BytesIO()
    figure.savefig(data, format=format, dpi=DPI)
    return data.getvalue()


def _figure() -> Figure:
    try:
        from matplotlib.figure import Figure
    except ImportError as error:
        msg = "curves need matplotlib: pip install 'paintlink[plots]'"
        raise ConfigError(msg) from error
    return Figure(figsize=(9.0, 8.2), layout="constrained")


def _draw_channel(axes: Axes, channel: int, lines: tuple[_Line, ...]) -> None:
    for line in lines:
        degrees, lab = line.curve()
        values = line.spec.lab()[:, channel]
        axes.plot(degrees, lab[:, channel], line.style, color=line.color, lw=line.width)
        axes.plot(line.spec.angles_deg, values, line.marker, color=line.color)
    axes.set(
        title=f"{'Lab'[channel]}*",
        xlabel="aspecular angle / °",
        xticks=lines[0].spec.angles_deg,
    )
    axes.grid(alpha=0.3)
    low, high = axes.get_ylim()
    more = max(LEAST_SPAN - (high - low), 0.0) / 2.0
    axes.set_ylim(low - more, high + more)


def _draw_plane(axes: Axes, lines: tuple[_Line, ...]) -> None:
    axes.axhline(0.0, color=INK, linewidth=0.6)
    axes.axvline(0.0, color=INK, linewidth=0.6)
    for line in lines:
        _, lab = line.curve()
        axes.plot(lab[:, 1], lab[:, 2], line.style, color=line.color, lw=line.width)
        for sample in line.spec.samples:
            place, fill = (sample.lab.a, sample.lab.b), lab_to_hex(sample.lab)
            axes.plot(*place, line.marker, color=fill, mec=line.color, markersize=9)
    for sample in lines[1].spec.samples:
        _name_angle(axes, sample)
    axes.set(title="travel in the a-b plane", xlabel="a*", ylabel="b*")
    axes.margins(0.12)
    axes.set_aspect("equal", adjustable="datalim")
    axes.grid(alpha=0.3)


def _name_angle(axes: Axes, sample: Sample) -> None:
    axes.annotate(
        f"{sample.aspecular_deg:g}°",
        (sample.lab.a, sample.lab.b),
        textcoords="offset points",
        xytext=(8, -3),
        color=DESIGNED,
        fontsize=8,
    )


def _draw_legend(figure: Figure, lines: tuple[_Line, ...]) -> None:
    from matplotlib.lines import Line2D

    keys = [
        Line2D([], [], ls=line.style, marker=line.marker, color=line.color)
        for line in lines
    ]
    legend = figure.legend(
        keys,
        [line.label for line in lines],
        loc="outside lower center",
        title=LEGEND,
        frameon=False,
    )
    for text in legend.get_texts():
        # A name is no formula, whatever dollar signs it holds.
        text.set_parse_math(False)
