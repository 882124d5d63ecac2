"""Undo and redo, against the plainest model there is: a list and a position."""

from hypothesis import given
from hypothesis import strategies as st

from bayesmap.app.edits import DEPTH, History

ACTIONS = st.lists(
    st.one_of(
        st.tuples(st.just("push"), st.integers(0, 5), st.sampled_from([None, "a", "b"])),
        st.tuples(st.just("undo")),
        st.tuples(st.just("redo")),
    ),
    max_size=60,
)


@given(ACTIONS)
def test_undo_and_redo_walk_along_the_states_that_were(actions):
    history, states, at, gesture = History(0), [0], 0, None
    for action in actions:
        if action[0] == "push":
            _, state, new = action
            history = history.push(state, new)
            if state == states[at]:
                continue
            if new is not None and new == gesture:
                states[at:] = [state]
            else:
                states[at + 1 :] = [state]
                at += 1
            gesture = new
        elif action[0] == "undo":
            history, at, gesture = history.undo(), max(0, at - 1), gesture if at == 0 else None
        else:
            last = len(states) - 1
            history, at, gesture = history.redo(), min(last, at + 1), gesture if at == last else None
        assert history.present == states[at]
        assert bool(history.past) == (at > 0)
        assert bool(history.future) == (at < len(states) - 1)


def test_a_gesture_is_one_step():
    history = History("empty")
    for state in ("s1", "s2", "s3"):
        history = history.push(state, ("stroke", 1))
    history = history.push("other", ("stroke", 2))
    assert history.undo().present == "s3"
    assert history.undo().undo().present == "empty"


def test_a_gesture_that_goes_on_after_undo_is_another_step():
    history = History(0).push(1, "g").push(2, "g").undo().push(3, "g")
    assert history.undo().present == 0


def test_old_states_are_forgotten():
    history = History(0)
    for state in range(1, DEPTH + 50):
        history = history.push(state)
    assert len(history.past) == DEPTH
    assert history.past[0] == 49
