"""Sample binary walls: the beam table, Gibbs and block sweeps, belief propagation, importance weights."""
