"""Worlds to map: the tutorial's, drawings, pictures, occupancy grids, simulated buildings (``bm.worlds``)."""

from bayesmap.io.ros.maps import from_image, from_map_image, from_occupancy
from bayesmap.sim.building import Building, Room, building
from bayesmap.sim.drawing import TUTORIAL_GRID, from_text, to_text, tutorial
from bayesmap.sim.robot import patrol

__all__ = [
    "TUTORIAL_GRID", "Building", "Room", "building", "from_image", "from_map_image", "from_occupancy", "from_text",
    "patrol", "to_text", "tutorial",
]  # fmt: skip
