"""Flat options of an inference as `bm.infer` takes them, for tests that vary one option at a time."""

import bayesmap as bm

METHODS = {kind.name: kind for kind in (bm.Gibbs, bm.Block, bm.Propagate, bm.Importance, bm.Exact)}
OF_SCHEDULE, OF_WHERE = ("chains", "warmup", "draws", "thin", "precision"), ("threads", "device", "executor")
OF_CHECKPOINTS = {"resume": "resume", "on_checkpoint": "save", "checkpoint_every_s": "every_s"}
OF_METHOD = ("order", "start", "start_poses", "rounds", "particles")


def grouped(**flat):
    """Return arguments of `bm.infer`: chains in a schedule, ...; options that the method does not have are left out."""
    out = {name: value for name, value in flat.items() if name not in (*OF_SCHEDULE, *OF_WHERE, *OF_CHECKPOINTS)}
    if any(name in flat for name in OF_SCHEDULE):
        out["schedule"] = bm.Schedule(**{name: flat[name] for name in OF_SCHEDULE if name in flat})
    if any(name in flat for name in OF_WHERE):
        out["where"] = bm.Where(**{name: flat[name] for name in OF_WHERE if name in flat})
    if any(name in flat for name in OF_CHECKPOINTS):
        out["checkpoints"] = bm.Checkpoints(**{new: flat[old] for old, new in OF_CHECKPOINTS.items() if old in flat})
    options = {name: out.pop(name) for name in OF_METHOD if name in out}
    if options:
        kind = METHODS[out.get("method") or "gibbs"]
        out["method"] = kind(**{name: value for name, value in options.items() if name in kind.__dataclass_fields__})
    return out


def infer(scans, grid, **flat):
    return bm.infer(scans, grid, **grouped(**flat))
