// Balls of medium as texels, which software renderers read several times faster than buffers. A ball has kBallTexels of them,
// one below the other; kBallColumns balls stand in a row. Written by slabs/slab_balls.comp.glsl.
const int kBallColumns = 2048;
const int kBallTexels = 11;
const int kPlace = 0;   // xyz [m] center relative to the eye; w radius [m], of what is no smaller than a texel
const int kMedium = 1;  // x optical depth of the chord through the middle; y radius [m]; z layer * 2 + share of fire; w detail [1]
const int kEmitted = 2; // rgb [exposed]; w power of temperature by which it follows the detail
const int kScatter = 3; // rgb albedo; w mean cosine of the phase function
const int kLight = 4;   // rgb light that changes little within the ball [exposed]; w 1: of an illumination network
const int kSlope = 5;   // xyz relative change of it [1/m]
const int kDetail = 6;  // x seed [0, 1); y noise periods across the radius
// Of a ball with a tile, see blocks/block_chord.glsl; kMedium.x is then the factor of the tile's depth, kMedium.w is -1:
const int kTile = 6;      // x [texel] side; yz [texel] corner; w exposed light per unit of the tile, -1: it has no colors
const int kTileRight = 7; // xyz axis; w 0
const int kTileUp = 8;    // xyz axis; w fraction: radius over the distance of the tile's eye; floor: [radius / 127] depth of the middle of the content + 127
// Only where fields have detail:
const int kCarried0 = 9; // xyz [cell] coordinates of the first generation; w first texel of the detail of the field + 1, or 0
const int kCarried1 = 10; // xyz of the second; w thinning of the ball by itself

ivec2 ballTexel(uint ball, int texel)
{
    return ivec2(int(ball) % kBallColumns, int(ball) / kBallColumns * kBallTexels + texel);
}

// Lists of balls are texels too, kListColumns in a row. An entry holds the number of a ball, below 2^24, and its weight in the list.
const uint kWholeEntry = 256u; // units of a weight of 1
uint listEntry(uint ball, uint weight) { return ball | (weight - 1u) << 24; } // weight 1 .. kWholeEntry
uint ballOfEntry(uint entry) { return entry & 0xFFFFFFu; }
float weightOfEntry(uint entry) { return float((entry >> 24) + 1u) / float(kWholeEntry); }
const int kListColumns = 4096;
ivec2 listTexel(int entry) { return ivec2(entry % kListColumns, entry / kListColumns); }
