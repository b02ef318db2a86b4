"""Configuration files as they lie on a disk."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from paintlink.config import Settings, load_settings
from paintlink.errors import ConfigError

Write = Callable[[str], Path]
Load = Callable[..., Settings]
Refuse = Callable[..., list[str]]


@pytest.fixture
def write(tmp_path: Path) -> Write:
    """Writes the text into a configuration file, whose path comes back."""

    def write(text: str) -> Path:
        path = tmp_path / "paintlink.toml"
        path.write_text(text, encoding="utf-8")
        return path

    return write


@pytest.fixture
def load(write: Write) -> Load:
    """Settings of a file with the text, variables of the environment as keywords."""

    def load(text: str, **environ: str) -> Settings:
        return load_settings(write(text), environ=environ)

    return load


@pytest.fixture
def refuse(write: Write) -> Refuse:
    """Lines that tell what is wrong with the text; the file is called FILE."""

    def refuse(text: str, **environ: str) -> list[str]:
        path = write(text)
        with pytest.raises(ConfigError, match=r".: .") as caught:
            load_settings(path, environ=environ)
        return str(caught.value).replace(str(path), "FILE").splitlines()

    return refuse
