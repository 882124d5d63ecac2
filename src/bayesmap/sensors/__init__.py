"""Sensor models: the law of a reading given where its beam stops."""
