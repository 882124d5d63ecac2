"""Drawn worlds and what the library samples from them, for page/test/sampler.test.ts."""

import base64
from dataclasses import replace

import numpy as np

import bayesmap as bm
from bayesmap.app.edits import tutorial_document
from bayesmap.app.protocol.document import Sensor, packed
from bayesmap.app.scene import simulated_scene
from bayesmap.posterior.summary import bulk_ess, rhat
from bayesmap.samplers.walls import WallBlocks, WallGibbs
from bayesmap.samplers.without_chains import sample_importance

DRAWS, PARTICLES = 12, 300


def small_document(**settings):
    """A world whose cells are not metres, with two sensors, of which one stands on a grid line and sees half a turn."""
    walls = np.random.default_rng(3).random((14, 9)) < 0.2
    walls[[3, 10], [4, 6]] = False
    grid = bm.Grid((14, 9), 0.25, (-1.0, 0.4))
    sensors = (Sensor(1, -0.125, 1.5, 0.3), Sensor(2, 1.6, 2.0, 2.0))
    changes = {"walls": packed(walls), "sensors": sensors, "angles": 25, "fov": 3.0, "noise": 0.1, "max_range": 1.8}
    return replace(tutorial_document(), grid=grid, **{**changes, **settings})


def chains_of(document):
    """Draws of the document's method and order, from an empty map, and their log-likelihoods."""
    scene = simulated_scene(document)
    method = {"gibbs": bm.Gibbs, "block": bm.Block}[document.method](order=document.order, start="zeros")
    run = bm.infer(
        scene.scans, document.grid, prior=bm.Independent(document.prior), sensor=scene.sensor, method=method,
        schedule=bm.Schedule(chains=2, warmup=0, draws=DRAWS), seed=document.seed,
    )  # fmt: skip
    draws = run.posterior.draws.arrays["walls"]
    assert draws.shape[1] == DRAWS
    sites = {"gibbs": WallGibbs, "block": WallBlocks}[document.method](order=document.order).sites(scene.problem)
    return {
        **scene_of(document, scene),
        "sites": sites.tolist(),
        "draws": [[base64.b64encode(one.tobytes()).decode() for one in chain] for chain in draws],
        "log_likelihood": run.posterior.log_likelihood.tolist(),
        "log_prior": run.posterior.log_prior.tolist(),
        "rhat": None if document.prior == 0 else rhat(run.log_joint),
        "ess": None if document.prior == 0 else bulk_ess(run.log_joint),
    }


def scene_of(document, scene):
    table = scene.problem.table
    return {
        "document": document.to_json(), "readings": scene.scans.ranges_m.ravel().tolist(),
        "exact": scene.exact_m.ravel().tolist(), "offsets": table.offsets.tolist(), "cells": table.cells.tolist(),
        "loglik": table.loglik.tolist(), "no_hit": table.no_hit.tolist(),
    }  # fmt: skip


def particles_of(document):
    scene = simulated_scene(document)
    particles = sample_importance(scene.problem, PARTICLES, document.seed)
    heaviest = int(particles.log_weights.argmax())
    return {
        **scene_of(document, scene),
        "log_weights": particles.log_weights.tolist(),
        "log_evidence": particles.log_evidence,
        "effective_sample_size": particles.effective_sample_size,
        "heaviest": base64.b64encode(packed(particles.maps(np.array([heaviest])))).decode(),
    }


def figure_cases():
    tutorial = replace(tutorial_document(), prior=0.3)
    return {
        "chains": [
            chains_of(replace(document, method=method, order=order, seed=i))
            for document in (tutorial, small_document(prior=0.1), small_document(prior=0.5, readings="exact"))
            for method in ("gibbs", "block")
            for i, order in enumerate(("raster", "radial", "random"))
        ] + [chains_of(small_document(prior=0.0, method=method)) for method in ("gibbs", "block")],
        "particles": [particles_of(small_document(prior=0.3, seed=2**31 - 1)), particles_of(tutorial)],
    }  # fmt: skip
