"""Which value wins: defaults, then a resumed run's own, then the file, then ``--set``, then flags."""

from __future__ import annotations

import difflib
import json
import math
import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import click

from bayesmap.cli.keys import SECTIONS, Key, Value
from bayesmap.cli.rules import checked
from bayesmap.cli.typed_numbers import NumberOr
from bayesmap.errors import BadInput

Settings = dict[str, dict[str, Value]]
"""Values by section and key, all of them."""


def defaults() -> Settings:
    """The settings of a user who says nothing."""
    return {section: {key.name: key.default for key in keys} for section, keys in SECTIONS.items()}


def read_file(path: str | Path) -> Settings:
    """The settings that a TOML file makes: tables named like the commands; keys outside them hold for all.

    Raises:
        BadInput: a file that cannot be read or is not TOML, an unknown table or key, a value it cannot have.
    """
    try:
        tables = tomllib.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        raise BadInput(f"{path}: cannot be read: {getattr(error, 'strerror', None) or error}") from None
    except tomllib.TOMLDecodeError as error:
        raise BadInput(f"{path}: not valid TOML: {error}") from None
    found: Settings = {}
    try:
        for name, value in tables.items():
            if not isinstance(value, dict):
                _put(found, _homes(name, SECTIONS), name, value)
        for name, value in tables.items():
            if isinstance(value, dict):
                for key, entry in value.items():
                    _put(found, [_known(name, SECTIONS, "table")], key, entry)
    except (_Wrong, BadInput) as problem:
        raise BadInput(f"{path}: {problem}") from None
    return found


def read_pairs(pairs: Iterable[str], section: str | None) -> Settings:
    """The settings of ``--set key=value``: of the command's own section, or ``section.key=value``.

    Args:
        pairs: as they were typed.
        section: the command's; None for ``config``, where a bare key holds for every section that has it.

    Raises:
        click.BadParameter: no equals sign, an unknown key, a value that cannot be read.
        BadInput: a number that the setting cannot have.
    """
    found: Settings = {}
    for pair in pairs:
        name, equals, text = pair.partition("=")
        table, dot, key = name.strip().rpartition(".")
        try:
            if not equals:
                raise _Wrong(f"{pair!r} has no '='; write key=value")
            if dot:
                homes = [_known(table, SECTIONS, "table")]
            else:
                homes = _homes(key, SECTIONS if section is None else [section])
            _put(found, homes, key, _typed(text.strip()))
        except _Wrong as problem:
            raise click.BadParameter(str(problem), param_hint="'--set'") from None
    return found


def layered(*layers: Mapping[str, Mapping[str, Value]]) -> Settings:
    """All settings: later layers win."""
    result = defaults()
    for layer in layers:
        for section, values in layer.items():
            result[section].update(values)
    return result


def as_toml(settings: Mapping[str, Mapping[str, Value]]) -> str:
    """A file that `read_file` reads back as these settings; keys without a value appear as comments."""
    lines = []
    for section, values in settings.items():
        lines.append(f"[{section}]")
        rows = []
        for key in SECTIONS[section]:
            if key.name not in values:
                continue
            value = values[key.name]
            row = f"# {key.name} =" if value is None else f"{key.name} = {_toml(value)}"
            rows.append((row, _remark(key)))
        width = max((len(row) for row, _ in rows), default=0)
        lines += [f"{row:<{width}}  # {remark}" for row, remark in rows]
        lines.append("")
    return "\n".join(lines)


class _Wrong(Exception):
    """A key or value that cannot be used; the text says why."""


def _homes(key: str, sections: Iterable[str]) -> list[str]:
    """The sections that have a key."""
    names = list(sections)
    homes = [section for section in names if any(key == k.name for k in SECTIONS[section])]
    if not homes:
        _known(key, {k.name: k for section in names for k in SECTIONS[section]}, "key")
    return homes


def _known(name: str, known: Iterable[str], what: str) -> str:
    names = list(known)
    if name in names:
        return name
    flat = name.replace("-", "_")
    near = [flat] if flat in names else difflib.get_close_matches(flat, names, n=1, cutoff=0.5)
    raise _Wrong(
        f"unknown {what} {name!r}; " + (f"did you mean {near[0]!r}?" if near else f"known: {', '.join(names)}")
    )


def _put(found: Settings, homes: list[str], name: str, value: Any) -> None:
    for section in homes:
        keys = {key.name: key for key in SECTIONS[section]}
        found.setdefault(section, {})[name] = _checked(keys[_known(name, keys, f"key of [{section}]")], value)


def _checked(key: Key, value: Any) -> Value:
    """The value as the key's type, as the flag of that name reads it."""
    numeric = isinstance(value, int | float) and not isinstance(value, bool)
    if key.kind is bool:
        wanted, fits = "true or false", isinstance(value, bool)
    elif key.kind is float:
        wanted, fits = "a number", numeric
    elif key.kind is int:
        wanted, fits = "a whole number", numeric and float(value).is_integer()
    elif isinstance(key.kind, NumberOr):
        wanted, fits = f"a number, or {key.kind.word!r}", numeric or isinstance(value, str)
    else:
        wanted, fits = "a text", isinstance(value, str)
    if not fits:
        raise _Wrong(f"{key.name} must be {wanted}, got {value!r}")
    try:
        result: Value = key.type.convert(value, None, None)
    except click.BadParameter as error:
        raise _Wrong(f"{key.name}: {error.message.rstrip('.')}") from None
    return checked(key, result)


def _typed(text: str) -> Any:
    """A value as TOML would read it; a bare word is a text."""
    try:
        return tomllib.loads(f"v = {text}")["v"]
    except tomllib.TOMLDecodeError:
        return text


def _toml(value: bool | int | float | str) -> str:
    if isinstance(value, str):
        # A JSON string is a TOML string, unless it escapes a character in two halves, or holds a bare DEL.
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    return json.dumps(value)


def _remark(key: Key) -> str:
    choices = f" One of {', '.join(key.kind.choices)}." if isinstance(key.kind, click.Choice) else ""
    unset = f" Default: {key.unset}." if key.unset else ""
    return key.help.replace("see above", "see infer --help") + choices + unset
