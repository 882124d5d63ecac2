"""Belief propagation the slow way: every message is a sum over all configurations of its beam."""

import numpy as np
from oracle.enumeration import all_maps


def plain_rounds(table, p_wall, rounds, damping):
    """Wall probabilities of all cells after each flooding round, (rounds, N), and the messages (rounds, K).

    A message from beam b to its cell i is the ratio of the beam's expected likelihood with a wall in i to that without,
    the beam's other cells being independent with their cavity probabilities (beliefs without b's own message).
    """
    beam_cells = [table.cells[table.offsets[b] : table.offsets[b + 1]] for b in range(table.n_beams)]
    logit = np.log(p_wall) - np.log1p(-p_wall)
    message = np.zeros(table.n_incidences)  # log ratios
    beliefs, messages = [], []
    for _ in range(rounds):
        belief = logit + np.bincount(table.cells, message, minlength=len(p_wall))
        new = np.zeros_like(message)
        for b, cells in enumerate(beam_cells):
            entries = np.arange(table.offsets[b], table.offsets[b + 1])
            n = len(cells)
            if n == 0:
                continue
            worth = np.append(table.loglik[entries], table.no_hit[b]).astype(np.float64)
            like = np.exp(worth - worth.max())
            maps = all_maps(n)
            first = np.where(maps.any(axis=1), maps.argmax(axis=1), n)
            cavity = 1 / (1 + np.exp(-(belief[cells] - message[entries])))
            for i in range(n):
                others = np.delete(np.arange(n), i)
                p = np.where(maps[:, others], cavity[others], 1 - cavity[others]).prod(axis=1) * like[first]
                new[entries[i]] = np.log(p[maps[:, i]].sum()) - np.log(p[~maps[:, i]].sum())
        message = damping * message + (1 - damping) * new
        messages.append(message)
        total = logit + np.bincount(table.cells, message, minlength=len(p_wall))
        beliefs.append(1 / (1 + np.exp(-total)))
    return np.array(beliefs), np.array(messages)
