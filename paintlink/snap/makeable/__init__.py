"""The paper's open question: can a designed colour be made, answered while you wait."""

from paintlink.snap.makeable.predictor import (
    ANGLES_DEG,
    Forecast,
    chances,
    forecast,
)

__all__ = ["ANGLES_DEG", "Forecast", "chances", "forecast"]
