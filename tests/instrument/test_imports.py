import ast
from pathlib import Path

import pytest

import paintlink.instrument

SOURCES = sorted(Path(paintlink.instrument.__file__).parent.glob("*.py"))
SYSTEM = {"asyncio", "os", "pathlib", "select", "serial", "socket", "sys", "threading"}


@pytest.mark.parametrize("source", SOURCES, ids=lambda path: path.stem)
def test_instrument_package_never_touches_the_system(source):
    imported = {
        name.split(".")[0]
        for node in ast.walk(ast.parse(source.read_text()))
        for name in (
            [alias.name for alias in node.names]
            if isinstance(node, ast.Import)
            else [node.module or ""]
            if isinstance(node, ast.ImportFrom)
            else []
        )
    }

    assert not imported & {*SYSTEM, "time", "usb"}
