import pytest

from paintlink.errors import InputError
from paintlink.instrument import parse_geometry
from paintlink.model import Geometry


@pytest.mark.parametrize(
    ("code", "illumination", "aspecular", "azimuth"),
    [
        ("45as15", 45, 15, 0),
        ("45as-15", 45, -15, 0),
        ("r45as-15", 45, -15, 0),
        ("45asMinus15", 45, -15, 0),
        ("15asMinus45", 15, -45, 0),
        ("45as110", 45, 110, 0),
        ("45as25az90", 45, 25, 90),
        ("45as25az-90", 45, 25, -90),
        ("45as60az125.3", 45, 60, 125.3),
        ("15as38.3az43", 15, 38.3, 43),
        ("r15as46.9azMinus104.5", 15, 46.9, -104.5),
        ("45_0", 45, 45, 0),
    ],
)
def test_published_codes_are_understood(code, illumination, aspecular, azimuth):
    assert parse_geometry(code) == Geometry(aspecular, illumination, azimuth, code)


@pytest.mark.parametrize(
    "code",
    ["", "45", "as15", "45as", "45as15x", "x45as15", "45as15az", "sphere", "45as1e3"],
)
def test_other_text_is_refused(code):
    with pytest.raises(InputError, match="not of the form 45as15"):
        parse_geometry(code)


@pytest.mark.parametrize("code", ["90as15", "45as-91", "45as181"])
def test_impossible_angles_are_refused(code):
    with pytest.raises(InputError, match=f"{code}.*below 90 degrees.*-90 and 180"):
        parse_geometry(code)


def test_foreign_digits_are_refused():
    with pytest.raises(InputError, match="not of the form"):
        parse_geometry("45as١٥")
