"""Generative functions on JAX: traces, choice maps, combinators, edits, inference on traces."""

from bayesmap.gen.choice_map import ChoiceMap, ChoiceMapBuilder
from bayesmap.gen.densities import *  # noqa: F403
from bayesmap.gen.diff import Diff
from bayesmap.gen.generative_function import EmptyRequest, IndexRequest, Regenerate, StaticRequest, Trace, Update
from bayesmap.gen.pytree import Pytree
from bayesmap.gen.selection import Selection, SelectionBuilder
from bayesmap.gen.static import gen
from bayesmap.gen.vmap import repeat, vmap
def pretty(): pass
