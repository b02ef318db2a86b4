from __future__ import annotations

import pytest

from paintlink.errors import SpecError
from paintlink.spec.document import decoded, parsed
from tests.spec.corpus import Case
from tests.spec.hostile import TYPE_DECLARATIONS


@pytest.mark.parametrize("case", TYPE_DECLARATIONS, ids=str)
def test_parser_alone_refuses_type_declarations(case: Case) -> None:
    text = decoded(case.data())

    with pytest.raises(SpecError, match=r"DOCTYPE|not well-formed XML"):
        parsed(text)


def test_parser_alone_refuses_harmless_declaration() -> None:
    with pytest.raises(SpecError, match=r"\(DOCTYPE\) is never accepted: remove it"):
        parsed("<!DOCTYPE x><x/>")


def test_words_about_declarations_are_no_declaration() -> None:
    root = parsed("<x>&lt;!DOCTYPE x></x>")

    assert root.text == "<!DOCTYPE x>"
