"""ROS: recordings, the messages, frames and poses in them, and the conventions of its maps."""
