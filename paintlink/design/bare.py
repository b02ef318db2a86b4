"""What a design keeps of a paint."""

from __future__ import annotations

from paintlink.model import ColorSpec


def bare(spec: ColorSpec) -> ColorSpec:
    """The specification without what was measured beside its colour and gloss."""
    return ColorSpec(
        name=spec.name,
        code=spec.code,
        samples=spec.samples,
        finish=spec.finish,
        observer=spec.observer,
        gloss=spec.gloss,
    )
