//! A software rasteriser for blocks that draw: triangles and lines with a width, tile by tile.
