"""Worlds to map: the tutorial's, drawings, pictures, occupancy grids, simulated buildings (``bm.worlds``)."""

from bayesmap.io.image import from_image
from bayesmap.io.ros.maps import from_map_image, from_occupancy
from bayesmap.sim.building import Building, Room, building
from bayesmap.sim.drawing import from_text, to_text
from bayesmap.sim.patrol import patrol
from bayesmap.sim.tutorial import TUTORIAL_GRID, tutorial

__all__ = [
    "TUTORIAL_GRID",
    "Building",
    "Room",
    "building",
    "from_image",
    "from_map_image",
    "from_occupancy",
    "from_text",
    "patrol",
    "to_text",
    "tutorial",
]
