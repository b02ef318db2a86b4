"""Values the way a TOML file writes them."""

from __future__ import annotations

import json
from collections.abc import Mapping


def toml(value: object) -> str:
    """One value on one line."""
    if isinstance(value, Mapping):
        pairs = ", ".join(f"{key} = {toml(one)}" for key, one in value.items())
        return f"{{ {pairs} }}" if pairs else "{}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(toml(one) for one in value)}]"
    return json.dumps(value, ensure_ascii=False, default=str)
