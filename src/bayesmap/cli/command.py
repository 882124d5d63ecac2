"""What all commands have in common: the options of a section, and those of what is printed."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import click
from click.core import ParameterSource

from bayesmap.cli.console import Console
from bayesmap.cli.keys import SECTIONS, Key, Value
from bayesmap.cli.rules import checked
from bayesmap.cli.settings import Settings, layered, read_file, read_pairs
from bayesmap.cli.startup_interrupt import INTERRUPTED as INTERRUPTED

FAILURE, BAD_INPUT, PROBLEMS = 1, 3, 4
"""Exit codes, beside click's own 2 for usage."""

VERBOSE = "bayesmap.verbose"
"""Key of the click context under which a command says that it is verbose, for whoever prints its failure."""

COMMON = (
    click.Option(["-c", "--config"], metavar="FILE", help="TOML file with settings, as printed by bayesmap config."),
    click.Option(["--set", "pairs"], metavar="KEY=VALUE", multiple=True, help="One setting; wins over the file."),
    click.Option(["--json", "as_json"], is_flag=True, help="One JSON document on standard output."),
    click.Option(["-q", "--quiet"], is_flag=True, help="Only errors and warnings."),
    click.Option(["-v", "--verbose"], is_flag=True, help="Details, and the traceback of a failure."),
    click.Option(["--no-progress"], is_flag=True, help="No progress bar."),
)


@dataclass(frozen=True)
class Call:
    """One call of a command.

    Attributes:
        console: where its words go.
        section: its table of settings.
        layers: what the user set: in the file, by ``--set``, by flags.
    """

    console: Console
    section: str | None
    layers: tuple[Settings, Settings, Settings]

    def settings(self, under: Settings | None = None) -> Settings:
        """All settings; ``under`` lies between the defaults and what the user set."""
        return layered(under or {}, *self.layers)

    def values(self, under: Settings | None = None) -> dict[str, Any]:
        """The settings of the command's own section."""
        assert self.section is not None
        return dict(self.settings(under)[self.section])


def takes(section: str | None) -> Callable[[Callable[..., None]], click.Command]:
    """Make a function a command: it is given a `Call`, and its own arguments by name.

    Args:
        section: whose settings become flags; None for a command without.
    """

    def decorate(run: Callable[..., None]) -> click.Command:
        keys = SECTIONS[section] if section is not None else ()

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
            run(Call(console, section, (by_file, read_pairs(pairs, section), by_flags)), **arguments)

        made = click.command(help=_help(run.__doc__ or ""))(callback)
        made.params = list(getattr(run, "__click_params__", []))[::-1]
        made.params += [_option(key) for key in keys] + list(COMMON)
        return made

    return decorate


def _help(docstring: str) -> str:
    """The docstring, in which a raw backslash-b keeps click from filling a paragraph."""
    return inspect.cleandoc(docstring).replace("\\b\n", "\b\n")


def _option(key: Key) -> click.Option:
    shown = key.unset if key.default is None else f"{key.default}"
    if key.kind is bool:
        return click.Option([key.flag, key.name], is_flag=True, help=key.help)
    return click.Option([key.flag, key.name], type=key.type, metavar=key.metavar, help=f"{key.help} [default: {shown}]")
