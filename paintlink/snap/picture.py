"""The 3D graph as a picture, for the command line and for reports."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from paintlink.errors import ConfigError
from paintlink.snap.graph import Graph, Path

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PictureFormat = Literal["png", "svg"]

DPI = 100
SIZE_IN = (13.0, 6.5)
INK, PALE = "#262628", "#8a8a90"
VIEW_DEG = (22.0, -58.0)
MARGIN = 12.0
"""Lab units round the target and its paints that the close view shows."""


def picture(drawn: Graph, *, format: PictureFormat = "png") -> bytes:
    """The whole library on the left, the target with its nearest paints on the right.

    Dots are paints at the middle angle in their own colours, thin lines their ways
    from face to flop.

    Raises
    ------
    ConfigError
        When matplotlib is not installed.
    """
    try:
        from matplotlib.figure import Figure
    except ImportError as error:
        msg = "the graph needs matplotlib: pip install 'paintlink[plots]'"
        raise ConfigError(msg) from error
    figure = Figure(figsize=SIZE_IN, dpi=DPI)
    figure.subplots_adjust(left=0.0, right=0.96, bottom=0.04, top=0.97, wspace=0.06)
    _whole(figure, drawn)
    _close(figure, drawn)
    figure.suptitle(_title(drawn), color=INK, fontsize=11)
    stream = io.BytesIO()
    metadata: dict[str, Any] = {"Date": None} if format == "svg" else {}
    figure.savefig(stream, format=format, metadata=metadata)
    return stream.getvalue()


def _title(drawn: Graph) -> str:
    angles = "/".join(f"{angle:g}" for angle in drawn.angles_deg)
    return (
        f"{drawn.target.label} (dots), nearest {drawn.nearest.label} (diamonds), in "
        f"{drawn.library_name}; Lab from face to flop, {angles} degrees"
    )


def _whole(figure: Figure, drawn: Graph) -> None:
    axes = _axes(figure, 1)
    L, a, b = drawn.library[:, drawn.middle].T
    colors = drawn.library_colors / 255.0
    axes.scatter(a, b, L, c=colors, s=3, alpha=0.5, linewidths=0, depthshade=False)
    _travel(axes, drawn.library, colors, alpha=0.06)
    _marked(axes, drawn)
    low = drawn.library.min(axis=(0, 1))
    high = drawn.library.max(axis=(0, 1))
    both = np.concatenate([drawn.target.lab, [low, high]])
    _limits(axes, both.min(axis=0), both.max(axis=0))


def _close(figure: Figure, drawn: Graph) -> None:
    """The library's paints that lie in the box round the target and its matches."""
    axes = _axes(figure, 2)
    shown = np.concatenate([
        path.lab for path in (drawn.target, drawn.nearest, *drawn.others[:9])
    ])
    low, high = shown.min(axis=0) - MARGIN, shown.max(axis=0) + MARGIN
    inside = ((drawn.library >= low) & (drawn.library <= high)).all(axis=(1, 2))
    colors = drawn.library_colors[inside] / 255.0
    L, a, b = drawn.library[inside, drawn.middle].T
    axes.scatter(a, b, L, c=colors, s=8, linewidths=0, depthshade=False)
    _travel(axes, drawn.library[inside], colors, alpha=0.3)
    for path in drawn.others[:9]:
        _way(axes, path, size=14, width=0.8, marker="o")
    _marked(axes, drawn)
    _limits(axes, low, high)


def _axes(figure: Figure, place: int) -> Any:
    axes: Any = figure.add_subplot(1, 2, place, projection="3d")
    axes.view_init(*VIEW_DEG)
    axes.set_xlabel("a*")
    axes.set_ylabel("b*")
    axes.set_zlabel("L*")
    axes.tick_params(labelsize=7, colors=PALE)
    return axes


def _limits(axes: Any, low: Any, high: Any) -> None:
    axes.set(xlim=(low[1], high[1]), ylim=(low[2], high[2]), zlim=(low[0], high[0]))
    axes.set_box_aspect(np.maximum(high - low, 1.0)[[1, 2, 0]])


def _travel(axes: Any, lab: Any, colors: Any, *, alpha: float) -> None:
    from mpl_toolkits.mplot3d.art3d import Line3DCollection

    ways = lab[..., [1, 2, 0]]
    axes.add_collection3d(Line3DCollection(ways, colors=colors, lw=0.6, alpha=alpha))


def _marked(axes: Any, drawn: Graph) -> None:
    _way(axes, drawn.nearest, size=60, width=1.6, marker="D")
    _way(axes, drawn.target, size=80, width=2.4, marker="o")


def _way(axes: Any, path: Path, *, size: float, width: float, marker: str) -> None:
    L, a, b = path.lab.T
    axes.plot(a, b, L, color=INK, linewidth=width, zorder=10)
    axes.scatter(
        a,
        b,
        L,
        c=list(path.colors),
        s=size,
        marker=marker,
        edgecolors=INK,
        linewidths=width / 2.0,
        depthshade=False,
        zorder=11,
    )
