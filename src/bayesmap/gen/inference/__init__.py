"""Inference on traces: importance sampling, particle filters, moves, Markov chains, marginals."""

from bayesmap.gen.inference import mcmc, requests, smc
from bayesmap.gen.inference.marginal import Marginal, marginal
from bayesmap.gen.inference.smc import Algorithm, SampleDistribution, Target

__all__ = ["Algorithm", "Marginal", "SampleDistribution", "Target", "marginal", "mcmc", "requests", "smc"]
