"""Choice maps, selections, masks, pytrees."""

import copy
import pickle

import jax
import jax.numpy as jnp
import jax.random as jr
import numpy as np
import pytest

import bayesmap.gen as genjax
from bayesmap.gen import ChoiceMap, ChoiceMapNoValueAtAddress, Mask, Pytree, Selection, ShapeMismatch
from bayesmap.gen import ChoiceMapBuilder as C
from bayesmap.gen import SelectionBuilder as S


@genjax.gen
def model(loc):
    x = genjax.normal(loc, 1.0) @ "x"
    genjax.flip.repeat(n=3)(0.5) @ ("y", "z")
    return x


@pytest.mark.parametrize("join", [lambda a, b: a | b, lambda a, b: a + b, lambda a, b: a ^ b, lambda a, b: a.merge(b)])
def test_joining_prefers_the_left_value(join):
    both = join(C["x"].set(1.0) | C["y"].set(2.0), C["x"].set(3.0) | C["z", "w"].set(4.0))
    assert (both["x"], both["y"], both["z", "w"]) == (1.0, 2.0, 4.0)


def test_and_filters_the_right_map_by_the_left_ones_addresses_and_at_set_replaces():
    both = C["x"].set(1.0) & (C["x"].set(3.0) | C["y"].set(2.0))
    assert both["x"] == 3.0
    assert "y" not in both
    with pytest.raises(ValueError, match="bare value"):
        C["x"].set(1.0) | C["x", "y"].set(2.0)
    chm = C["x"].set(jnp.zeros(3)) | C["y"].set(1.0)
    np.testing.assert_array_equal(chm.at["x"].set(jnp.ones(3))["x"], jnp.ones(3))
    np.testing.assert_array_equal(chm.at["x", 1].set(5.0)["x"], [0.0, 5.0, 0.0])
    assert chm.at["y"].update(lambda y: y + 1)["y"] == 2.0
    with pytest.raises(ShapeMismatch, match=r"found \(2,\), expected \(3,\)"):
        chm.at["x"].set(jnp.ones(2))


def test_filter_mask_selection_extend_and_the_invalid_subset():
    chm = C["x"].set(1.0) | C["y", "z"].set(2.0)
    kept = chm.filter(S["y"])
    assert ("y", "z") in kept
    assert "x" not in kept
    assert "x" in chm.mask(True)
    assert "x" not in chm.mask(False)
    assert jax.jit(lambda flag: chm.mask(flag)["x"].unmask(default=7.0))(False) == 7.0
    assert chm.get_selection()["y", "z"]
    assert not chm.get_selection()["y"]
    assert chm.extend("a", "b")["a", "b", "x"] == 1.0
    assert ("y", "z") in chm
    for address in ("z", ("y", "x"), "y"):
        with pytest.raises(ChoiceMapNoValueAtAddress):
            chm[address]
    extras = (C["x"].set(1.0) | C["w"].set(2.0)).invalid_subset(model, (0.0,))
    assert "w" in extras
    assert "x" not in extras
    assert C["x"].set(1.0).invalid_subset(model, (0.0,)) is None


def test_ways_to_build_a_map_which_can_hold_indices():
    expected = C["x"].set(1.0) | C["y", "z"].set(2.0)
    for chm in (C.d({"x": 1.0, "y": {"z": 2.0}}), C.kw(x=1.0, y={"z": 2.0}), ChoiceMap.d({"x": 1.0, ("y", "z"): 2.0})):
        assert jax.tree.map(float, chm) == jax.tree.map(float, expected)
    assert C.n().static_is_empty()
    assert C["a"].v(3.0)["a"] == 3.0
    assert ChoiceMap.switch(1, [C["x"].set(1.0), C["x"].set(2.0)])["x"] == 2.0
    assert C["i"].switch(jnp.array(0), [C["x"].set(1.0), C["y"].set(2.0)])["i", "x"].unmask() == 1.0
    chm = C[0, "v"].set(1.0) | C[2, "v"].set(3.0)
    assert (chm[0, "v"], chm[2, "v"]) == (1.0, 3.0)
    assert (1, "v") not in chm
    several = C[jnp.array([1, 4])].set(jnp.array([10.0, 40.0]))
    assert (several[4].value, bool(several[4].flag)) == (40.0, True)
    assert not several[3].flag, "an array of indices does not decide what a map holds"
    assert jax.jit(lambda i: several[i].unmask(default=0.0))(3) == 0.0


def test_selections_match_everything_below_and_combine():
    x, y = Selection.at["x"], Selection.at["y"]
    wild, leaf = Selection.at[..., "y"], Selection.leaf().extend("x")
    inside = [(x, "x"), (x, ("x", "y", "z")), (x | y, "y"), (~x, "y"), (wild, ("a", "y")), (leaf, "x")]
    inside += [(Selection.all(), ("anything", "at", "all")), (Selection.all(), ())]
    outside = [(x, "y"), (x & y, "x"), (~x, ("x", "z")), (wild, ("a", "z")), (leaf, ("x", "y")), (Selection.none(), ())]
    assert all(sel[address] for sel, address in inside)
    assert not any(sel[address] for sel, address in outside)
    assert (x("x"), ~~x, S[()]) == (Selection.all(), x, Selection.leaf())


def test_unmask():
    value = jnp.arange(3.0)
    assert (Mask(1.0, True).unmask(), Mask(1.0, False).unmask()) == (1.0, 1.0)
    with genjax.do_checkify(), pytest.raises(Exception, match="flag is False"):
        Mask(1.0, False).unmask()
    assert Mask(1.0, False).unmask(default=5.0) == 5.0
    mixed = Mask(value, jnp.array([True, False, True]))
    np.testing.assert_array_equal(mixed.unmask(default=jnp.full(3, -1.0)), [0.0, -1.0, 2.0])
    np.testing.assert_array_equal((mixed | Mask(value + 10, jnp.array([True, True, True]))).value, [0.0, 11.0, 2.0])
    with pytest.raises(ValueError, match=r"shape \(3,\) must be a prefix"):
        Mask(jnp.zeros(2), jnp.ones(3, bool))


@Pytree.dataclass
class Params(Pytree):
    count: int = Pytree.static()
    scale: float = Pytree.field(default=1.0)


def test_pytree_dataclasses_are_frozen_with_static_fields_in_the_definition():
    params = Params(3, 2.0)
    assert jax.tree.leaves(params) == [2.0]
    assert jax.tree.structure(params) != jax.tree.structure(Params(4, 2.0))
    assert params.replace(scale=5.0) == Params(3, 5.0)
    with pytest.raises(AttributeError):
        params.count = 4
    with pytest.raises(TypeError, match="no field size"):
        params.replace(size=1)
    assert jax.jit(lambda p: jnp.zeros(p.count) + p.scale)(params).shape == (3,)


def test_traces_pickle_can_be_copied_and_print_as_trees():
    trace = model.simulate(jr.key(0), (1.0,))
    loaded = pickle.loads(pickle.dumps(trace))
    assert loaded.get_gen_fn() == model
    np.testing.assert_array_equal(loaded.get_choices()["y", "z"], trace.get_choices()["y", "z"])
    assert loaded.update(jr.key(0), C["x"].set(0.0))[0].get_choices()["x"] == 0.0
    local = genjax.gen(lambda: genjax.normal(0.0, 1.0) @ "x").simulate(jr.key(0), ())
    assert copy.deepcopy(local).get_choices()["x"] == local.get_choices()["x"]
    trace = model.simulate(jr.key(0), (1.0,))
    assert "'y':\n    'z': [" in repr(trace)
    assert (repr(C["x", "y"].set(1.0)), repr(C.n())) == ("'x':\n  'y': 1.0", "(empty)")


def test_traces_survive_jit_vmap_scan_and_cond():
    trace = model.simulate(jr.key(0), (1.0,))
    again = jax.jit(lambda t: t)(trace)
    assert again.get_score() == trace.get_score()
    batch = jax.vmap(lambda key: model.simulate(key, (1.0,)))(jr.split(jr.key(0), 4))
    assert (batch.get_score().shape, batch.get_choices()["y", "z"].shape) == ((4,), (4, 3))
    np.testing.assert_array_equal(batch.get_retval(), batch.get_choices()["x"])

    def body(t, key):
        new = t.edit(key, genjax.Regenerate(Selection.at["x"]))[0]
        return jax.lax.cond(new.get_score() > t.get_score(), lambda: new, lambda: t), t.get_score()

    _, scores = jax.lax.scan(body, again, jr.split(jr.key(0), 20))
    assert jnp.all(jnp.diff(scores) >= 0)
    assert scores[-1] > scores[0]
