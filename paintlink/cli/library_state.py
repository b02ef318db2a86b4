"""Options that the library commands share, and the libraries they mean."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from paintlink.cli.state import config_option, settings_of

if TYPE_CHECKING:
    from paintlink.library import Filter
    from paintlink.library.shelf import Shelf
    from paintlink.model import Finish, PaintTable

Function = Callable[..., Any]
Range = tuple[float, float]


def on_shelf(function: Function) -> Function:
    """Give a command the ``shelf`` of the configured state folder."""

    @config_option
    @wraps(function)
    def wrapped(*arguments: Any, config: Path | None, **options: Any) -> Any:
        from paintlink.library.shelf import Shelf

        shelf = Shelf(settings_of(config).library_path)
        return function(*arguments, shelf=shelf, **options)

    return wrapped


@dataclass(frozen=True, slots=True)
class Where:
    """The library, or the old generation of one, that a command looks at."""

    library: str
    generation: str

    def table(self, shelf: Shelf) -> PaintTable:
        """Its paints."""
        if self.generation:
            return shelf.generation(self.generation)
        return shelf.table(self.library)

    @staticmethod
    def options(function: Function) -> Function:
        """Give a command ``where`` to look."""

        @click.option(
            "-l",
            "--library",
            default="virtual",
            show_default=True,
            help="Name of the library.",
        )
        @click.option(
            "--generation", default="", help="An old state, of whatever library."
        )
        @wraps(function)
        def wrapped(
            *arguments: Any, library: str, generation: str, **options: Any
        ) -> Any:
            return function(*arguments, where=Where(library, generation), **options)

        return wrapped


def filter_options(function: Function) -> Function:
    """Give a command the conditions that `filter_of` makes a filter of."""
    decorators = (
        click.argument("text", default=""),
        click.option(
            "--finish",
            "finishes",
            multiple=True,
            type=click.Choice(["solid", "metallic", "pearl"]),
            help="Only this finish; may be repeated.",
        ),
        click.option(
            "--drawer", "drawers", multiple=True, help="Such as red, or dark."
        ),
        click.option(
            "--flop", type=(float, float), help="Lowest and highest Flop Index."
        ),
        click.option(
            "--hue-shift", type=(float, float), help="Of the Hue Shift Index."
        ),
        click.option("--chroma", type=(float, float), help="Of the Chroma Index."),
        click.option(
            "--where",
            "conditions",
            multiple=True,
            metavar="COLUMN=VALUE",
            help="Such as brand=Alpha or year=2015..2020; may be repeated.",
        ),
    )
    for decorator in reversed(decorators):
        function = decorator(function)
    return function


def filter_of(
    *,
    text: str,
    finishes: tuple[Finish, ...],
    drawers: tuple[str, ...],
    flop: Range | None,
    hue_shift: Range | None,
    chroma: Range | None,
    conditions: tuple[str, ...],
) -> Filter:
    """The filter of the given conditions.

    Raises
    ------
    ConfigError
        When a drawer is unknown, or a condition on a column is not written as one.
    """
    from paintlink.color import FAMILIES, LEAVES
    from paintlink.errors import ConfigError
    from paintlink.library import Filter, parse_choices

    unknown = [name for name in drawers if name not in FAMILIES]
    if unknown:
        msg = f"no drawer {unknown[0]!r}: take {', '.join(FAMILIES)}"
        raise ConfigError(msg)
    return Filter(
        finishes=finishes,
        leaves=tuple(leaf for leaf in LEAVES if leaf.family in drawers),
        flop=flop,
        hue_shift=hue_shift,
        chroma=chroma,
        text=text,
        facets=parse_choices(conditions),
    )
