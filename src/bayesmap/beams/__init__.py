"""What beams cross: the cells of a grid along each of them."""
