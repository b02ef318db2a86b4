"""Objects and lights are found by looking into their folders."""

from __future__ import annotations

from difflib import get_close_matches
from pkgutil import iter_modules
from types import ModuleType

from paintlink.errors import PreviewError
from paintlink.preview import lights, objects


def object_names() -> tuple[str, ...]:
    """Names of the objects a paint can be drawn on."""
    return _names(objects)


def light_names() -> tuple[str, ...]:
    """Names of the lights an object can stand in."""
    return _names(lights)


def find(name: str, folder: ModuleType, kind: str) -> str:
    """Import path of the file ``name`` in ``folder``; errors are those of `require`."""
    require(name, _names(folder), kind)
    return f"{folder.__name__}.{name}"


def require(name: str, known: tuple[str, ...], kind: str) -> None:
    """Return when ``name`` is known.

    Raises
    ------
    PreviewError
        When it is not; the text holds the nearest name.
    """
    if name not in known:
        near = get_close_matches(name, known, n=1, cutoff=0.4)
        hint = f"did you mean {near[0]!r}? " if near else ""
        msg = f"no preview {kind} {name!r}: {hint}There are {', '.join(known)}"
        raise PreviewError(msg)


def _names(folder: ModuleType) -> tuple[str, ...]:
    return tuple(sorted(module.name for module in iter_modules(folder.__path__)))
