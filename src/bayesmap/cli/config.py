"""``bayesmap config``: the effective settings as TOML."""

from __future__ import annotations

import math

from bayesmap.cli.command import Call, takes
from bayesmap.cli.console import write_out
from bayesmap.cli.keys import Value
from bayesmap.cli.settings import as_toml


@takes(None)
def command(call: Call) -> None:
    r"""Print the effective settings as TOML, ready for -c.

    One table for each command. Keys outside the tables hold for every command that has them.

    \b
    bayesmap config > my.toml
    bayesmap infer -c my.toml --set resolution=0.05 office.log
    """
    settings = call.settings()
    if call.console.as_json:
        shown = {section: {k: _as_json(v) for k, v in values.items()} for section, values in settings.items()}
        call.console.result({"settings": shown}, [])
    else:
        write_out(as_toml(settings))


def _as_json(value: Value) -> Value:
    """JSON has no infinity: it becomes a text, which `--set` reads."""
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value
