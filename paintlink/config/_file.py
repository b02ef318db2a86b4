"""The configuration file as bytes and as a table, with faults a person can mend."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

from paintlink.config._tables import Table
from paintlink.errors import ConfigError


def read_table(path: Path) -> Table:
    """Content of a TOML file.

    Raises
    ------
    ConfigError
        When it cannot be read, or is not UTF-8 or not TOML.
    """
    text = _decoded(_read(path), path)
    try:
        return tomllib.loads(text)
    except RecursionError as error:
        msg = f"{path}: lists or tables nested too deeply; correct the file"
        raise ConfigError(msg) from error
    except ValueError as error:
        raise ConfigError(f"{path}: {_syntax(str(error), text)}") from error


def _read(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except FileNotFoundError as error:
        msg = f"{path}: there is no such file; correct the path or create the file"
        raise ConfigError(msg) from error
    except OSError as error:
        msg = f"{path}: cannot be read ({error.strerror}); correct its permissions"
        raise ConfigError(msg) from error


def _decoded(data: bytes, path: Path) -> str:
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = error.object.count(b"\n", 0, error.start) + 1
        byte = error.object[error.start]
        msg = (
            f"{path}: line {line}: byte {byte:02X} is not UTF-8; save the file as UTF-8"
        )
        raise ConfigError(msg) from error


def _syntax(said: str, text: str) -> str:
    """The parser's complaint with its place in front and the line it is about."""
    found = re.fullmatch(r"(.*) \(at line (\d+), column (\d+)\)", said, re.DOTALL)
    if found is None:
        return f"{said}; correct the file"
    what, line, column = found[1], int(found[2]), found[3]
    content = text.split("\n")[line - 1].strip()
    return f"line {line}, column {column}: {what}: {content}"
