"""The pictures."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from paintlink.config._keys import FilledText, Key, whole


@dataclass(frozen=True, slots=True, kw_only=True)
class PreviewSettings:
    """The pictures of a paint."""

    enabled: Annotated[bool, Key("Whether a picture is drawn for every job.")] = True
    object: Annotated[
        FilledText,
        Key('What is painted in the picture: a "panel", a "sphere" or another form.'),
    ] = "panel"
    light: Annotated[
        FilledText, Key('The light it stands in, such as "studio" or "sky".')
    ] = "studio"
    size: Annotated[
        int, whole(16, 4096), Key("Width and height of a picture in pixels.")
    ] = 512
    backend: Annotated[
        Literal["auto", "gl", "cpu"],
        Key(
            'What draws: "gl" the graphics hardware or driver, "cpu" plain '
            'arithmetic, "auto" the faster of the two that works here.'
        ),
    ] = "auto"
    caption: Annotated[
        bool,
        Key("Whether the picture says what it shows, and that it is no colour match."),
    ] = True
