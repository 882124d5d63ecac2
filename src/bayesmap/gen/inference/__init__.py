"""Inference on traces: targets and algorithms, moves, importance sampling and particle filters, Markov chains."""

from bayesmap.gen.inference import mcmc, requests, smc
from bayesmap.gen.inference.marginal import Marginal, marginal
from bayesmap.gen.inference.target import Algorithm, SampleDistribution, Target

__all__ = ["Algorithm", "Marginal", "SampleDistribution", "Target", "marginal", "mcmc", "requests", "smc"]
