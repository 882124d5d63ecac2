"""Options that all commands share, and the settings of a call.

Settings come in layers. Later layers override earlier ones: defaults, a resumed run's settings, the TOML file (-c),
``--set key=value``, and flags. Read `command` (makes a function a click command), `Call` (what the function gets), and
then the layers: `read_file`, `read_pairs`, `merge_layers`.
"""

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
from bayesmap.cli.keys import SECTIONS, Key, Settings, Value, WrongValue, convert_value, keys_of
from bayesmap.errors import BadInput

Layer = Mapping[str, Mapping[str, Value]]  # values of settings from one source, by section and key

S = TypeVar("S", bound=Settings)

COMMON_OPTIONS = (
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

    def settings(self, resumed: Layer | None = None) -> S:
        """Return the command's settings; the user's settings override those of a run that is ``resumed``."""
        return cast(S, merge_layers(self.section, resumed or {}, *self.layers))


def command(section: str | None) -> Callable[[Callable[..., None]], click.Command]:
    """Return a decorator that makes a function of a `Call` a command; ``section`` is its table of settings."""

    def decorate(function: Callable[..., None]) -> click.Command:
        @click.pass_context
        def callback(context: click.Context, /, **arguments: Any) -> None:
            _refuse_empty_values(context, arguments)
            function(_take_call(context, section, arguments), **arguments)

        # The function's own options come first in the help, then the settings, then the common options.
        # In the help, a raw backslash-b of the docstring becomes the character that stops click from reflowing.
        decorated = click.command(help=inspect.cleandoc(function.__doc__ or "").replace("\\b\n", "\b\n"))(callback)
        decorated.params = list(getattr(function, "__click_params__", []))[::-1]
        keys = keys_of(section) if section is not None else ()
        decorated.params += [_option(key) for key in keys] + list(COMMON_OPTIONS)
        return decorated

    return decorate


def _refuse_empty_values(context: click.Context, arguments: Mapping[str, Any]) -> None:
    """Raise `click.BadParameter` for an empty value, such as "$FOLDER" in a script that has not set it."""
    for parameter in context.command.params:
        value = arguments.get(parameter.name or "")
        if value == "" or (isinstance(value, tuple) and "" in value):
            raise click.BadParameter("it is empty; give a value", context, parameter)


def _take_call(context: click.Context, section: str | None, arguments: dict[str, Any]) -> Call[Any]:
    """Remove settings and common options from the parsed arguments, and return the call that they describe."""
    # Collect the flags that the user typed; the values of all others are defaults.
    flags: dict[str, Value] = {}
    for key in keys_of(section) if section is not None else ():
        value = arguments.pop(key.name)
        if context.get_parameter_source(key.name) is ParameterSource.COMMANDLINE:
            flags[key.name] = convert_value(key, value)
    context.meta[VERBOSE] = arguments["verbose"]
    console = Console(
        quiet=arguments.pop("quiet"), verbose=arguments.pop("verbose"), as_json=arguments.pop("as_json"),
        bar=not arguments.pop("no_progress"),
    )  # fmt: skip
    config = arguments.pop("config")
    file_layer = read_file(config) if config is not None else {}
    flag_layer = {section: flags} if section is not None else {}
    return Call[Any](console, section or "", (file_layer, read_pairs(arguments.pop("pairs"), section), flag_layer))


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
    """Return a function that converts a text to a number, and accepts one word."""

    def convert(value: str) -> float | str:
        try:
            return value if value == word else float(value)
        except ValueError:
            raise click.BadParameter(f"{value!r} is neither a number nor {word!r}") from None

    return convert


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
                _store(layer, _sections_with_key(name, SECTIONS), name, value)
        for name, value in tables.items():
            if isinstance(value, dict):
                for key, entry in value.items():
                    _store(layer, [_need_known(name, SECTIONS, "table")], key, entry)
    except (WrongValue, BadInput) as problem:
        raise BadInput(f"{path}: {problem}") from None
    return layer


def read_pairs(pairs: Iterable[str], section: str | None) -> Layer:
    """Read the pairs of ``--set``: ``key=value``, for ``section`` or all sections if None, or ``section.key=value``.
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
                sections = [_need_known(table, SECTIONS, "table")]
            else:
                sections = _sections_with_key(key, SECTIONS if section is None else [section])
            _store(layer, sections, key, _parse_value(text.strip()))
        except WrongValue as problem:
            raise click.BadParameter(str(problem), param_hint="'--set'") from None
    return layer


def _sections_with_key(key: str, candidates: Iterable[str]) -> list[str]:
    """Return the sections that have a key; refuse a key that none has."""
    keys = {section: SECTIONS[section].__struct_fields__ for section in candidates}
    sections = [section for section, names in keys.items() if key in names]
    if not sections:
        _need_known(key, dict.fromkeys(itertools.chain(*keys.values())), "key")  # raises
    return sections


def _need_known(name: str, known: Iterable[str], noun: str) -> str:
    """Return a name if it is among the known ones, or refuse it as an unknown ``noun`` and suggest the nearest."""
    names = list(known)
    if name in names:
        return name
    underscored = name.replace("-", "_")
    close = [underscored] if underscored in names else difflib.get_close_matches(underscored, names, n=1, cutoff=0.5)
    hint = f"did you mean {close[0]!r}?" if close else f"known: {', '.join(names)}"
    raise WrongValue(f"unknown {noun} {name!r}; {hint}")


def _store(layer: dict[str, dict[str, Value]], sections: list[str], name: str, value: Any) -> None:
    """Check a value, and store it in a layer for each of the sections."""
    for section in sections:
        keys = {key.name: key for key in keys_of(section)}
        layer.setdefault(section, {})[name] = convert_value(keys[_need_known(name, keys, f"key of [{section}]")], value)


def _parse_value(text: str) -> Any:
    """Return the value that TOML reads from a text; a bare word stays a text."""
    try:
        return tomllib.loads(f"v = {text}")["v"]
    except tomllib.TOMLDecodeError:
        return text


def merge_layers(section: str, *layers: Layer) -> Settings:
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
            row = f"# {key.name} =" if value is None else f"{key.name} = {_format_value(value)}"
            rows.append((row, _describe_key(key)))
        width = max((len(row) for row, _ in rows), default=0)
        lines += [f"{row:<{width}}  # {remark}" for row, remark in rows]
        lines.append("")
    return "\n".join(lines)


def _format_value(value: bool | int | float | str) -> str:
    """Return a value as TOML."""
    if isinstance(value, str):
        # A JSON string is a TOML string, except for surrogate pairs and a bare DEL.
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    return str(value) if isinstance(value, float) and not math.isfinite(value) else json.dumps(value)


def _describe_key(key: Key) -> str:
    """Return the comment beside a key in TOML: its help, choices and default."""
    choices = f" One of {', '.join(key.choices)}." if key.choices and key.kind is str else ""
    unset = f" Default: {key.help.unset}." if key.help.unset else ""
    return key.help.text.replace("see above", "see infer --help") + choices + unset  # "above" is in that help only
