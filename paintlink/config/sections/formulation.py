"""The way back from the formulation software."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from paintlink.config._keys import Key, Rule, number, whole


def _is_list(value: object) -> bool:
    return isinstance(value, list | tuple)


@dataclass(frozen=True, slots=True, kw_only=True)
class FormulationSettings:
    """The way back from the formulation software: its answers and sprayed panels."""

    enabled: Annotated[
        bool, Key("Whether the folder answers/ of the site is watched.")
    ] = True
    route: Annotated[
        str,
        Key(
            "The [[route]] whose program answers; corrections are asked from it.",
            "colornet",
            "the first route with the format colornet",
        ),
    ] = ""
    toners: Annotated[
        tuple[str, ...],
        Rule("a list of toner codes in quotes", _is_list),
        Key(
            "Toners this shop can mix; an answer with another one is refused. With an "
            "empty list every toner is taken."
        ),
    ] = ()
    accept_dE00: Annotated[  # noqa: N815
        float,
        number(0, 100),
        Key(
            "A panel at most this far from the target (CIEDE2000, mean over the "
            "angles) closes its job."
        ),
    ] = 1.0
    panels: Annotated[
        int,
        whole(1, 20),
        Key("Panels after which a person decides instead of another correction."),
    ] = 3
