"""Reading saved runs back."""

from __future__ import annotations

import os

from bayesmap.field_result import FieldRun
from bayesmap.posterior.field import FieldPosterior
from bayesmap.result import Run


def load(path: str | os.PathLike[str]) -> Run:
    """Read a saved run: a `Run` over walls, or a `FieldRun` over reflectivities and surfaces.

    Raises:
        BadInput: no such file, or one that is damaged or not a run of bayesmap's.
    """
    from bayesmap.io.saved import load_posterior

    posterior = load_posterior(path)
    return FieldRun(posterior) if isinstance(posterior, FieldPosterior) else Run(posterior)
