"""Vehicle identification numbers and their check digit.

ISO 3779 for the characters; 49 CFR 565.15 for the check digit, which only vehicles
for North America have to carry.
"""

from __future__ import annotations

LENGTH = 17
LETTERS = dict(
    zip("ABCDEFGHJKLMNPRSTUVWXYZ", map(int, "12345678123457923456789"), strict=True)
)
WEIGHTS = (8, 7, 6, 5, 4, 3, 2, 10, 0, 9, 8, 7, 6, 5, 4, 3, 2)
CHECKED_PLACE = 8
NORTH_AMERICA = "12345"


def vin_problem(text: str) -> str | None:
    """What is wrong with a VIN; None when nothing is.

    The check digit is asked of North American numbers only: elsewhere its place holds
    what the maker likes.
    """
    if len(text) != LENGTH:
        return f"a VIN has {LENGTH} characters, {text!r} has {len(text)}"
    wrong = [one for one in text if one not in LETTERS and one not in "0123456789"]
    if wrong:
        return f"{wrong[0]!r} cannot stand in a VIN (capital letters without I, O, Q)"
    if text[0] in NORTH_AMERICA and text[CHECKED_PLACE] != check_digit(text):
        return (
            f"the check digit of {text} is {text[CHECKED_PLACE]}, it should be "
            f"{check_digit(text)}: read the number again"
        )
    return None


def check_digit(text: str) -> str:
    """The character that belongs in the ninth place of a VIN."""
    values = [LETTERS.get(one) or int(one) for one in text]
    rest = sum(a * b for a, b in zip(values, WEIGHTS, strict=True)) % 11
    return "X" if rest == 10 else str(rest)
