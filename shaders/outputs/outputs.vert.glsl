#include "outputs/output_block.glsl"
#include "slabs/slabs.vert.glsl"
