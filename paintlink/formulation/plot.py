"""The convergence of a formulation as a picture."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from paintlink.errors import PreviewError
from paintlink.formulation.convergence import Step


def plot_convergence(steps: Sequence[Step], title: str, path: Path) -> None:
    """Write predicted, measured and best differences over the iterations.

    Raises
    ------
    PreviewError
        When matplotlib is not installed, or the file cannot be written.
    """
    try:
        from matplotlib.figure import Figure
    except ImportError as error:
        msg = "plots need matplotlib: pip install 'paintlink[plots]'"
        raise PreviewError(msg) from error
    figure = Figure(figsize=(6.0, 4.0), layout="constrained")
    axes = figure.add_subplot()
    numbers = [step.iteration for step in steps]
    for label, style, values in (
        ("predicted", "o:", [step.predicted_mean for step in steps]),
        ("panel", "s-", [step.measured_mean for step in steps]),
        ("best panel so far", "k--", [step.best_mean for step in steps]),
    ):
        shown = [float("nan") if one is None else one for one in values]
        axes.plot(numbers, shown, style, label=label)
    axes.set(
        xlabel="iteration",
        ylabel="CIEDE2000, mean over angles",
        title=title,
        xticks=numbers,
    )
    axes.set_ylim(bottom=0.0)
    axes.legend()
    try:
        figure.savefig(path)
    except (OSError, ValueError) as error:
        msg = f"{path}: {error}; write a .png or .svg into a folder you may write to"
        raise PreviewError(msg) from error
