"""Virtual paint: toners, the panels sprayed with them, and the noise of measuring.

Invented toners and published optics; no data of any paint maker. See
docs/paint-model.md.
"""

from paintlink_simulators.paint.booth import PANEL_ANGLES_DEG, SprayBooth
from paintlink_simulators.paint.bundled import book, formula_of
from paintlink_simulators.paint.model import reflect
from paintlink_simulators.paint.noise import (
    EXACT,
    LABORATORY,
    TYPICAL,
    WORKSHOP,
    Repeatability,
    noisy,
)
from paintlink_simulators.paint.panel import Panel, panel_from_lab
from paintlink_simulators.paint.texture import TEXTURE, texture
from paintlink_simulators.paint.toners import (
    TONERS,
    Formula,
    Toner,
    amounts,
    formula,
)
from paintlink_simulators.paint.variation import (
    BODY_SHOP_SITE,
    CAREFUL_SITE,
    EXACT_SITE,
    Application,
    Variation,
)
from paintlink_simulators.paint.wavelengths import WAVELENGTHS_NM

__all__ = [
    "BODY_SHOP_SITE",
    "CAREFUL_SITE",
    "EXACT",
    "EXACT_SITE",
    "LABORATORY",
    "PANEL_ANGLES_DEG",
    "TEXTURE",
    "TONERS",
    "TYPICAL",
    "WAVELENGTHS_NM",
    "WORKSHOP",
    "Application",
    "Formula",
    "Panel",
    "Repeatability",
    "SprayBooth",
    "Toner",
    "Variation",
    "amounts",
    "book",
    "formula",
    "formula_of",
    "noisy",
    "panel_from_lab",
    "reflect",
    "texture",
]
