from __future__ import annotations

import tomllib

from hypothesis import given
from hypothesis import strategies as st

from paintlink.config._toml import toml

TEXTS = st.text(st.characters(codec="utf-8", exclude_characters="\x7f"))
PLAIN = st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False)
KEYS = st.from_regex("[a-z_]{1,8}", fullmatch=True)


@given(
    st.recursive(
        PLAIN | TEXTS, lambda inner: st.lists(inner) | st.dictionaries(KEYS, inner)
    )
)
def test_value_survives_being_written(value: object) -> None:
    assert tomllib.loads(f"key = {toml(value)}")["key"] == value
