"""Profiles as TOML files: those of the site beside those that ship with paintlink."""

from __future__ import annotations

import tomllib
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any, cast

from paintlink.errors import ConfigError, InputError
from paintlink.instrument import did_you_mean
from paintlink.intake.conditions import Scale, split_conditions
from paintlink.intake.profile import (
    Meaning,
    Profile,
    heading_key,
    profile_fault,
    read_meaning,
)

FORMAT = 1
MAX_BYTES = 1 << 20

_DELIMITERS = {"comma": ",", "semicolon": ";", "tab": "\t", "pipe": "|"}
_DECIMALS = {"point": ".", "comma": ","}
_SCALES = {"fraction": "fraction", "percent": "percent"}
_TEXTS = ("name", "conditions", "maker", "model", "data_mode", "time_format")
_KEYS = ("format", "delimiter", "decimal", "scale", "columns", *_TEXTS)


def load_profile(path: Path) -> Profile:
    """The profile in a file.

    Raises
    ------
    ConfigError
        When it cannot be read or used, with the key.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        msg = f"{path}: cannot be read ({error.strerror}): name a profile that exists"
        raise ConfigError(msg) from error
    return _parsed(str(path), data)


def load_profiles(folder: Path | None) -> tuple[Profile, ...]:
    """The profiles of a folder, by file name, before those that ship with paintlink.

    Raises
    ------
    ConfigError
        When one of them cannot be used.
    """
    paths = sorted(folder.glob("*.toml")) if folder is not None else []
    return (*map(load_profile, paths), *built_in())


@cache
def built_in() -> tuple[Profile, ...]:
    """The profiles that ship with paintlink."""
    folder = resources.files("paintlink.intake") / "profiles"
    files = sorted(folder.iterdir(), key=lambda one: one.name)
    return tuple(
        _parsed(one.name, one.read_bytes())
        for one in files
        if one.name.endswith(".toml")
    )


def _parsed(source: str, data: bytes) -> Profile:
    try:
        if len(data) > MAX_BYTES:
            msg = f"larger than {MAX_BYTES} bytes: a profile is small"
            raise InputError(msg)
        return _profile(tomllib.loads(data.decode()))
    except (InputError, ValueError, RecursionError) as error:
        # TOMLDecodeError and UnicodeDecodeError are ValueErrors
        msg = f"{source}: {error}"
        raise ConfigError(msg) from error


def _profile(table: dict[str, Any]) -> Profile:
    for key in table:
        if key not in _KEYS:
            hint = did_you_mean(key, _KEYS) or ";"
            msg = f"unknown key {key!r}{hint} known: {', '.join(_KEYS)}"
            raise InputError(msg)
    if table.get("format") != FORMAT:
        msg = f"format must be {FORMAT}, found {table.get('format')!r}"
        raise InputError(msg)
    profile = Profile(
        columns=_columns(table.get("columns")),
        delimiter=_word(table, "delimiter", _DELIMITERS, "comma"),
        decimal=_word(table, "decimal", _DECIMALS, "point"),
        scale=cast("Scale", _word(table, "scale", _SCALES, "fraction")),
        **{key: _text(table, key) for key in _TEXTS if key in table or key == "name"},
    )
    split_conditions(profile.conditions)
    fault = profile_fault(profile)
    if fault:
        raise InputError(fault)
    return profile


def _text(table: dict[str, Any], key: str) -> str:
    value = table.get(key)
    if not isinstance(value, str) or not value.isprintable() or len(value) > 200:
        msg = f"{key} must be a short text, found {value!r}"
        raise InputError(msg)
    return value


def _word(table: dict[str, Any], key: str, words: dict[str, str], default: str) -> str:
    value = table.get(key, default)
    if not isinstance(value, str) or value not in words:
        msg = f"{key} must be one of {', '.join(words)}, found {value!r}"
        raise InputError(msg)
    return words[value]


def _columns(table: object) -> dict[str, Meaning]:
    if not isinstance(table, dict) or not table:
        msg = "a table [columns] is needed: each heading with its meaning"
        raise InputError(msg)
    columns = {}
    for heading, text in table.items():
        try:
            columns[heading_key(heading)] = read_meaning(str(text))
        except InputError as error:
            msg = f"column {heading!r}: {error}"
            raise InputError(msg) from error
    return columns
