"""The paper's 3D graph: a target, its nearest paints and the library, in Lab space."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from paintlink.color import lab_to_srgb
from paintlink.model import ColorSpec, FloatArray, Match, PaintTable
from paintlink.snap.stock import lab_at

MIDDLE_DEG = 45.0
MOST_PAINTS = 8000
"""Of larger libraries every so-manieth paint is shown."""


@dataclass(frozen=True, slots=True, eq=False)
class Path:
    """One colour's way from face to flop.

    Parameters
    ----------
    lab
        Shape (angles, 3), face first.
    colors
        How it looks at each angle, such as ``#c0a080``.
    """

    label: str
    lab: FloatArray
    colors: tuple[str, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Graph:
    """Everything the graph shows.

    Parameters
    ----------
    nearest
        The first match; ``others`` are those after it.
    library
        Lab of the library's paints, shape (n, angles, 3).
    library_colors
        How they look at the middle angle, 8-bit sRGB, shape (n, 3).
    """

    angles_deg: tuple[float, ...]
    target: Path
    nearest: Path
    others: tuple[Path, ...]
    library_name: str
    library: FloatArray
    library_codes: tuple[str, ...]
    library_colors: NDArray[np.uint8]

    @property
    def middle(self) -> int:
        """Position of the angle nearest to 45 degrees."""
        return _middle(self.angles_deg)


def graph(spec: ColorSpec, matches: Sequence[Match], table: PaintTable) -> Graph:
    """The graph of a target and its matches in a library, at the compared angles."""
    best = matches[0]
    angles = best.angles_deg
    target = spec.lab(*angles)
    paths = [_path(f"{m.rank}. {m.code}", _paint(target, m)) for m in matches]
    step = -(-len(table) // MOST_PAINTS)
    lab = lab_at(table, angles)[::step]
    complete = np.isfinite(lab).all(axis=(1, 2))
    lab = lab[complete]
    codes = np.array(table.codes[::step], dtype=np.str_)[complete]
    return Graph(
        angles_deg=angles,
        target=_path(spec.name, target),
        nearest=replace(paths[0], label=best.code),
        others=tuple(paths[1:]),
        library_name=table.library,
        library=lab,
        library_codes=tuple(codes.tolist()),
        library_colors=lab_to_srgb(lab[:, _middle(angles)]),
    )


def plotly(drawn: Graph) -> dict[str, Any]:
    """The graph as a plotly figure document: ``data`` and ``layout``."""
    return {
        "data": [
            _cloud(drawn),
            _travels(drawn),
            *(_line(path, width=3, size=3) for path in drawn.others),
            _line(drawn.nearest, width=6, size=5, symbol="diamond"),
            _line(drawn.target, width=9, size=7, symbol="circle"),
        ],
        "layout": {
            "scene": {
                "xaxis": {"title": {"text": "a*"}},
                "yaxis": {"title": {"text": "b*"}},
                "zaxis": {"title": {"text": "L*"}},
                "aspectmode": "data",
            },
            "legend": {"itemsizing": "constant"},
            "margin": {"l": 0, "r": 0, "t": 0, "b": 0},
        },
    }


def _middle(angles_deg: tuple[float, ...]) -> int:
    apart = [abs(angle - MIDDLE_DEG) for angle in angles_deg]
    return apart.index(min(apart))


def _paint(target: FloatArray, match: Match) -> FloatArray:
    steps = np.array([(d.dL, d.da, d.db) for d in match.differences])
    paint: FloatArray = target - steps
    return paint


def _path(label: str, lab: FloatArray) -> Path:
    return Path(label, lab, tuple(_hex(color) for color in lab_to_srgb(lab)))


def _hex(color: NDArray[np.uint8]) -> str:
    return "#" + bytes(color).hex()


def _cloud(drawn: Graph) -> dict[str, Any]:
    """The library at the middle angle, one dot a paint, in its own colour."""
    return {
        **_points(drawn.library[:, drawn.middle]),
        "type": "scatter3d",
        "mode": "markers",
        "name": drawn.library_name,
        "text": list(drawn.library_codes),
        "hoverinfo": "text",
        "marker": {"size": 2, "color": [_hex(c) for c in drawn.library_colors]},
    }


def _travels(drawn: Graph) -> dict[str, Any]:
    """The library's ways from face to flop, in one broken line."""
    gap = np.full((len(drawn.library), 1, 3), np.nan)
    lab = np.concatenate([drawn.library, gap], axis=1).reshape(-1, 3)
    colors = [_hex(color) for color in drawn.library_colors]
    return {
        **_points(lab),
        "type": "scatter3d",
        "mode": "lines",
        "name": "travel from face to flop",
        "hoverinfo": "skip",
        "connectgaps": False,
        "opacity": 0.25,
        "line": {
            "width": 1,
            "color": [one for one in colors for _ in range(drawn.library.shape[1] + 1)],
        },
    }


def _line(
    path: Path, *, width: int, size: int, symbol: str = "circle"
) -> dict[str, Any]:
    return {
        **_points(path.lab),
        "type": "scatter3d",
        "mode": "lines+markers",
        "name": path.label,
        "line": {"width": width, "color": list(path.colors)},
        "marker": {
            "size": size,
            "symbol": symbol,
            "color": list(path.colors),
            "line": {"width": 1, "color": "#262628"},
        },
    }


def _points(lab: FloatArray) -> dict[str, list[float | None]]:
    """x, y, z with two decimals; a gap is null, which JSON has and NaN it has not."""
    columns = np.round(lab, 2).T.tolist()
    L, a, b = ([None if math.isnan(v) else v for v in column] for column in columns)
    return {"x": a, "y": b, "z": L}
