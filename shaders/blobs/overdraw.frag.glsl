#include "formulas/sphere_path.fx.h"
#include "formulas/kernel_optical_depth.fx.h"
#include "shared/view_block.glsl"
#include "shared/blob_chord.glsl"
#include "blobs/blob_ray.glsl"

// Counts the fragments that add something to each pixel.
layout(location = 0) out vec4 count;

void main()
{
    count = vec4(traceBlob().opticalDepth > 0.0 ? 1.0 : 0.0);
}
