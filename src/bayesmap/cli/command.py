"""What all commands have in common: the options of a section, and those of what is printed."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Generic, TypeVar, cast

import click
from click.core import ParameterSource

from bayesmap.cli.console import VERBOSE, Console
from bayesmap.cli.keys import SECTIONS, Key, Settings, Value, checked, keys_of
from bayesmap.cli.settings import Layer, layered, read_file, read_pairs

S = TypeVar("S", bound=Settings)

COMMON = (
    click.Option(["-c", "--config"], metavar="FILE", help="TOML file with settings, as printed by bayesmap config."),
    click.Option(["--set", "pairs"], metavar="KEY=VALUE", multiple=True, help="One setting; wins over the file."),
    click.Option(["--json", "as_json"], is_flag=True, help="One JSON document on standard output."),
    click.Option(["-q", "--quiet"], is_flag=True, help="Only errors and warnings."),
    click.Option(["-v", "--verbose"], is_flag=True, help="Details, and the traceback of a failure."),
    click.Option(["--no-progress"], is_flag=True, help="No progress bar."),
)


@dataclass(frozen=True)
class Call(Generic[S]):
    """One call of a command whose settings are of the class S.

    Attributes:
        console: what the command prints goes there.
        section: the command's table of settings; "" if it has none.
        layers: what the user set: in the file, by ``--set``, by flags.
    """

    console: Console
    section: str
    layers: tuple[Layer, ...]

    def settings(self, under: Layer | None = None) -> S:
        """Return the command's settings; ``under`` lies between the defaults and what the user set."""
        return cast(S, layered(self.section, under or {}, *self.layers))

    def all_settings(self) -> dict[str, Settings]:
        """Return the settings of all commands."""
        return {section: layered(section, *self.layers) for section in SECTIONS}


def takes(section: str | None) -> Callable[[Callable[..., None]], click.Command]:
    """Make a function a command. The function is given a `Call`, and its own arguments by name.

    Args:
        section: the table whose settings become flags; None for a command without settings.
    """

    def decorate(run: Callable[..., None]) -> click.Command:
        keys = keys_of(section) if section is not None else ()

        @click.pass_context
        def callback(context: click.Context, /, **arguments: Any) -> None:
            for parameter in context.command.params:
                value = arguments.get(parameter.name or "")
                if value == "" or (
                    isinstance(value, tuple) and "" in value
                ):  # such as "$FOLDER" of a script that has set none
                    raise click.BadParameter("it is empty; give a value", context, parameter)
            flags: dict[str, Value] = {}
            for key in keys:
                value = arguments.pop(key.name)
                if context.get_parameter_source(key.name) is ParameterSource.COMMANDLINE:
                    flags[key.name] = checked(key, value)
            config, pairs = arguments.pop("config"), arguments.pop("pairs")
            quiet, verbose = arguments.pop("quiet"), arguments.pop("verbose")
            context.meta[VERBOSE] = verbose
            console = Console(
                quiet=quiet, verbose=verbose, as_json=arguments.pop("as_json"), bar=not arguments.pop("no_progress")
            )
            by_file = read_file(config) if config is not None else {}
            by_flags = {section: flags} if section is not None else {}
            layers = by_file, read_pairs(pairs, section), by_flags
            run(Call[Any](console, section or "", layers), **arguments)

        made = click.command(help=_help(run.__doc__ or ""))(callback)
        made.params = list(getattr(run, "__click_params__", []))[::-1]
        made.params += [_option(key) for key in keys] + list(COMMON)
        return made

    return decorate


def _help(docstring: str) -> str:
    """Return the docstring, in which a raw backslash-b keeps click from filling a paragraph."""
    return inspect.cleandoc(docstring).replace("\\b\n", "\b\n")


def _option(key: Key) -> click.Option:
    if key.kind is bool:
        return click.Option([key.flag, key.name], is_flag=True, help=key.help.text)
    shown = key.help.unset if key.default is None else f"{key.default}"
    text = f"{key.help.text} [default: {shown}]"
    return click.Option([key.flag, key.name], type=_click_type(key), metavar=key.help.metavar, help=text)


def _click_type(key: Key) -> click.ParamType[Any]:
    """Return the click type that reads a flag's value."""
    if key.choices:
        return click.Choice(key.choices) if key.kind is str else NumberOr(key.choices[0])
    return click.types.convert_type(key.kind)


class NumberOr(click.ParamType["float | str"]):
    """A number, or a word.

    Attributes:
        word: may stand in place of the number.
    """

    name = "number"

    def __init__(self, word: str) -> None:
        self.word = word

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float | str:
        """Return the number or the word of a text; a number as it is."""
        if value == self.word:
            return self.word
        try:
            return float(value)
        except ValueError:
            self.fail(f"{value!r} is neither a number nor {self.word!r}", param, ctx)
