"""Worlds to map: the tutorial's, drawings, pictures, occupancy grids, simulated buildings (``bm.worlds``)."""

from bayesmap.world.building import Building, Room, building
from bayesmap.world.drawing import from_text, to_text
from bayesmap.world.image import from_image, from_map_image, from_occupancy
from bayesmap.world.patrol import patrol
from bayesmap.world.tutorial import TUTORIAL_GRID, tutorial

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
