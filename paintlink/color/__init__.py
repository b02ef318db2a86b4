"""Pure colour numerics: spectra to Lab, differences, indices, curves, display."""

from paintlink.color.ciede2000 import ciede2000
from paintlink.color.curve import Curve, CurveModel
from paintlink.color.difference import (
    GRAPHIC_ARTS,
    TEXTILES,
    Cie94Constants,
    Components,
    cie76,
    cie94,
    cmc,
    components,
    din99,
    lab_to_din99,
)
from paintlink.color.din6175 import din6175
from paintlink.color.display import (
    into_gamut,
    lab_to_hex,
    lab_to_linear_srgb,
    lab_to_srgb,
    linear_to_srgb8,
    out_of_gamut,
)
from paintlink.color.fitting import default_model, drawing_curve, fit
from paintlink.color.formulas import FORMULAS, Formula
from paintlink.color.hierarchy import (
    FAMILIES,
    LEAVES,
    NO_LEAF,
    Leaf,
    leaf,
    leaf_indices,
)
from paintlink.color.indices import (
    TRAVEL_ANGLES_DEG,
    Travel,
    chroma_index,
    chroma_index_array,
    flop_index,
    flop_index_array,
    hue_shift_index,
    hue_shift_index_array,
    hue_travel,
    hue_travel_array,
    travel,
)
from paintlink.color.lab import lab_to_lch, lab_to_xyz, xyz_to_lab
from paintlink.color.normalise import normalise
from paintlink.color.spectra import FACTOR_RANGE, reflectance_to_lab, weights, white

__all__ = [
    "FACTOR_RANGE",
    "FAMILIES",
    "FORMULAS",
    "GRAPHIC_ARTS",
    "LEAVES",
    "NO_LEAF",
    "TEXTILES",
    "TRAVEL_ANGLES_DEG",
    "Cie94Constants",
    "Components",
    "Curve",
    "CurveModel",
    "Formula",
    "Leaf",
    "Travel",
    "chroma_index",
    "chroma_index_array",
    "cie76",
    "cie94",
    "ciede2000",
    "cmc",
    "components",
    "default_model",
    "din99",
    "din6175",
    "drawing_curve",
    "fit",
    "flop_index",
    "flop_index_array",
    "hue_shift_index",
    "hue_shift_index_array",
    "hue_travel",
    "hue_travel_array",
    "into_gamut",
    "lab_to_din99",
    "lab_to_hex",
    "lab_to_lch",
    "lab_to_linear_srgb",
    "lab_to_srgb",
    "lab_to_xyz",
    "leaf",
    "leaf_indices",
    "linear_to_srgb8",
    "normalise",
    "out_of_gamut",
    "reflectance_to_lab",
    "travel",
    "weights",
    "white",
    "xyz_to_lab",
]
