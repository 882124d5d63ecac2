"""Options that all commands share, and the settings of a call.

Later sources override earlier ones: defaults, a resumed run's settings, the file, ``--set``, flags.
"""

from __future__ import annotations

import difflib
import inspect
import itertools
import json
import math
import tomllib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, TypeVar, cast

import click
import msgspec
from click.core import ParameterSource

from bayesmap.cli.console import VERBOSE, Console
from bayesmap.cli.keys import SECTIONS, Key, Settings, Value, WrongValue, checked, keys_of
from bayesmap.errors import BadInput

Layer = Mapping[str, Mapping[str, Value]]  # values of settings from one source, by section and key


def read_file(path: str | Path) -> Layer:
    """Read the settings of a TOML file.

    Tables have the names of commands. Keys outside tables apply to all commands that have them. Raises `BadInput` for
    an unreadable file, invalid TOML, an unknown table or key, or a value that is not allowed.
    """
    try:
        tables = tomllib.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        raise BadInput(f"{path}: cannot be read: {getattr(error, 'strerror', None) or error}") from None
    except tomllib.TOMLDecodeError as error:
        raise BadInput(f"{path}: not valid TOML: {error}") from None
    layer: dict[str, dict[str, Value]] = {}
    try:
        # Store the keys outside tables first: a command's own table overrides them.
        for name, value in tables.items():
            if not isinstance(value, dict):
                _store(layer, _sections_with(name, SECTIONS), name, value)
        for name, value in tables.items():
            if isinstance(value, dict):
                for key, entry in value.items():
                    _store(layer, [_known_name(name, SECTIONS, "table")], key, entry)
    except (WrongValue, BadInput) as problem:
        raise BadInput(f"{path}: {problem}") from None
    return layer


def read_pairs(pairs: Iterable[str], section: str | None) -> Layer:
    """Read the settings of ``--set key=value`` for the command's section, or all if None, or of ``section.key=value``.
    Raises `click.BadParameter` for an unknown key or unreadable value, and `BadInput` for a number that is not allowed.
    """
    layer: dict[str, dict[str, Value]] = {}
    for pair in pairs:
        name, equals, text = pair.partition("=")
        table, dot, key = name.strip().rpartition(".")
        try:
            if not equals:
                raise WrongValue(f"{pair!r} has no '='; write key=value")
            if dot:
                sections = [_known_name(table, SECTIONS, "table")]
            else:
                sections = _sections_with(key, SECTIONS if section is None else [section])
            _store(layer, sections, key, _parsed(text.strip()))
        except WrongValue as problem:
            raise click.BadParameter(str(problem), param_hint="'--set'") from None
    return layer


def layered(section: str, *layers: Layer) -> Settings:
    """Return all settings of a command. Each layer overrides the defaults and the layers before it."""
    values: dict[str, Value] = {}
    for layer in layers:
        values.update(layer.get(section, {}))
    return msgspec.convert(values, SECTIONS[section])


def as_toml(settings: Mapping[str, Settings]) -> str:
    """Return the settings as TOML, which `read_file` reads back; keys without a value appear as comments."""
    lines = []
    for section, values in settings.items():
        lines.append(f"[{section}]")
        rows = []
        for key in keys_of(section):
            value = getattr(values, key.name)
            row = f"# {key.name} =" if value is None else f"{key.name} = {_toml(value)}"
            rows.append((row, _remark(key)))
        width = max((len(row) for row, _ in rows), default=0)
        lines += [f"{row:<{width}}  # {remark}" for row, remark in rows]
        lines.append("")
    return "\n".join(lines)


def _sections_with(key: str, candidates: Iterable[str]) -> list[str]:
    """Return the sections that have a key; refuse a key that none has."""
    keys = {section: SECTIONS[section].__struct_fields__ for section in candidates}
    sections = [section for section, names in keys.items() if key in names]
    if not sections:
        _known_name(key, dict.fromkeys(itertools.chain(*keys.values())), "key")
    return sections


def _known_name(name: str, known: Iterable[str], what: str) -> str:
    """Return a name if it is among the known ones, or refuse it and suggest the nearest."""
    names = list(known)
    if name in names:
        return name
    flat = name.replace("-", "_")
    close = [flat] if flat in names else difflib.get_close_matches(flat, names, n=1, cutoff=0.5)
    hint = f"did you mean {close[0]!r}?" if close else f"known: {', '.join(names)}"
    raise WrongValue(f"unknown {what} {name!r}; {hint}")


def _store(layer: dict[str, dict[str, Value]], sections: list[str], name: str, value: Any) -> None:
    """Check a value, and store it in a layer for each of the sections."""
    for section in sections:
        keys = {key.name: key for key in keys_of(section)}
        layer.setdefault(section, {})[name] = checked(keys[_known_name(name, keys, f"key of [{section}]")], value)


def _parsed(text: str) -> Any:
    """Return the value that TOML reads from a text; a bare word stays a text."""
    try:
        return tomllib.loads(f"v = {text}")["v"]
    except tomllib.TOMLDecodeError:
        return text


def _toml(value: bool | int | float | str) -> str:
    if isinstance(value, str):
        # A JSON string is a TOML string, except for surrogate pairs and a bare DEL.
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    return json.dumps(value)


def _remark(key: Key) -> str:
    """Return the comment beside a key in TOML: its help, choices and default."""
    choices = f" One of {', '.join(key.choices)}." if key.choices and key.kind is str else ""
    unset = f" Default: {key.help.unset}." if key.help.unset else ""
    return key.help.text.replace("see above", "see infer --help") + choices + unset


S = TypeVar("S", bound=Settings)

COMMON = (
    click.Option(["-c", "--config"], metavar="FILE", help="TOML file with settings, as printed by bayesmap config."),
    click.Option(["--set", "pairs"], metavar="KEY=VALUE", multiple=True, help="One setting; overrides the file."),
    click.Option(["--json", "as_json"], is_flag=True, help="One JSON document on standard output."),
    click.Option(["-q", "--quiet"], is_flag=True, help="Only errors and warnings."),
    click.Option(["-v", "--verbose"], is_flag=True, help="Details, and the traceback of a failure."),
    click.Option(["--no-progress"], is_flag=True, help="No progress bar."),
)


FORCE = click.option("--force", is_flag=True, help="Replace existing files.")  # the option of commands that write files


@dataclass(frozen=True)
class Call(Generic[S]):
    """One call of a command with settings of the class S."""

    console: Console  # prints the output of the command
    section: str  # the command's table of settings; "" if it has none
    layers: tuple[Layer, ...]  # settings of the user: from the file, from ``--set``, from flags

    def settings(self, under: Layer | None = None) -> S:
        """Return the command's settings; ``under`` overrides the defaults, and the user's settings override it."""
        return cast(S, layered(self.section, under or {}, *self.layers))

    def all_settings(self) -> dict[str, Settings]:
        """Return the settings of all commands."""
        return {section: layered(section, *self.layers) for section in SECTIONS}


def command(section: str | None) -> Callable[[Callable[..., None]], click.Command]:
    """Return a decorator that makes a function of a `Call` a command; ``section`` is its table of settings."""

    def decorate(run: Callable[..., None]) -> click.Command:
        keys = keys_of(section) if section is not None else ()

        @click.pass_context
        def callback(context: click.Context, /, **arguments: Any) -> None:
            # Refuse empty values, such as "$FOLDER" in a script that has not set it.
            for parameter in context.command.params:
                value = arguments.get(parameter.name or "")
                if value == "" or (isinstance(value, tuple) and "" in value):
                    raise click.BadParameter("it is empty; give a value", context, parameter)
            # Collect the flags that the user typed.
            flags: dict[str, Value] = {}
            for key in keys:
                value = arguments.pop(key.name)
                if context.get_parameter_source(key.name) is ParameterSource.COMMANDLINE:
                    flags[key.name] = checked(key, value)
            # Take out the common options, and make the console.
            config, pairs = arguments.pop("config"), arguments.pop("pairs")
            quiet, verbose = arguments.pop("quiet"), arguments.pop("verbose")
            context.meta[VERBOSE] = verbose
            as_json, bar = arguments.pop("as_json"), not arguments.pop("no_progress")
            console = Console(quiet=quiet, verbose=verbose, as_json=as_json, bar=bar)
            # Stack the sources of settings, and run the command.
            file_layer = read_file(config) if config is not None else {}
            flag_layer = {section: flags} if section is not None else {}
            layers = file_layer, read_pairs(pairs, section), flag_layer
            run(Call[Any](console, section or "", layers), **arguments)

        # The function's own options come first in the help, then the settings, then the common options.
        # In the help, a raw backslash-b of the docstring becomes the character that stops click from reflowing.
        help_text = inspect.cleandoc(run.__doc__ or "").replace("\\b\n", "\b\n")
        decorated = click.command(help=help_text)(callback)
        decorated.params = list(getattr(run, "__click_params__", []))[::-1]
        decorated.params += [_option(key) for key in keys] + list(COMMON)
        return decorated

    return decorate


def _option(key: Key) -> click.Option:
    if key.kind is bool:
        return click.Option([key.flag, key.name], is_flag=True, help=key.help.text)
    default = key.help.unset if key.default is None else f"{key.default}"
    text = key.help.text + (f" [default: {default}]" if default else "")
    return click.Option([key.flag, key.name], type=_click_type(key), metavar=key.help.metavar, help=text)


def _click_type(key: Key) -> click.ParamType[Any]:
    if key.choices:
        return click.Choice(key.choices) if key.kind is str else click.types.FuncParamType(_number_or(key.choices[0]))
    return click.types.convert_type(key.kind)


def _number_or(word: str) -> Callable[[str], float | str]:
    def convert(value: str) -> float | str:
        try:
            return value if value == word else float(value)
        except ValueError:
            raise click.BadParameter(f"{value!r} is neither a number nor {word!r}") from None

    return convert
