"""Sensor models: the probability distribution of a reading given where its beam stops."""
