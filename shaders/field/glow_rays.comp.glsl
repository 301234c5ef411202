#include "formulas/field_glow.fx.h"
#include "field/field_glow.glsl"

// Light of the cells of a grid along one line of cells: formula field-glow (1), and (2), or (4) where FX_AGAIN is 1. One invocation a line, from the face where
// it enters; a workgroup row has the lines of one direction that enter at the three faces that it comes from.
layout(local_size_x = 32, local_size_y = 8) in;
layout(binding = 0) uniform sampler3D cells;                   // rgb emitted light [exposed/m]; a extinction [1/m]
layout(rgba16f, binding = 0) uniform writeonly image3D rays; // rgb radiance in a cell [exposed], of each direction: mean, or in its middle

void main()
{
    int grid = int(gl_WorkGroupID.z) / 27, number = int(gl_WorkGroupID.z) % 27;
    ivec3 direction = glowDirection(number);
    int axis = int(gl_GlobalInvocationID.y) / kGlowCells;
    ivec2 across = ivec2(gl_GlobalInvocationID.x, int(gl_GlobalInvocationID.y) % kGlowCells);
    ivec3 enter = ivec3(direction.x > 0 ? 0 : kGlowCells - 1, direction.y > 0 ? 0 : kGlowCells - 1,
                        direction.z > 0 ? 0 : kGlowCells - 1);
    ivec3 cell = axis == 0 ? ivec3(enter.x, across) : axis == 1 ? ivec3(across.x, enter.y, across.y) : ivec3(across, enter.z);
    bool isLine = direction[axis] != 0;
    for (int other = 0; other < axis; ++other) // it enters at the edge of two faces: the first has it
        isLine = isLine && !(direction[other] != 0 && cell[other] == enter[other]);
    float way = glows[grid].corner.w * length(vec3(direction));
    ivec3 corner = glowRayCorner(number) + ivec3(0, 0, kGlowCells * grid);
    vec3 radiance = vec3(0.0);
    int count = isLine ? kGlowCells : 0;
    for (int a = 0; a < 3; ++a)
        count = min(count, direction[a] > 0 ? kGlowCells - cell[a] : direction[a] < 0 ? cell[a] + 1 : kGlowCells);
    for (int i = 0; i < count; ++i) {
        vec4 medium = texelFetch(cells, cell + ivec3(0, 0, kGlowCells * grid), 0);
        float tau = medium.a * way;
        float share = fxGlowShare(tau);
        vec3 emitted = medium.rgb * way;
#if FX_AGAIN
        vec3 within = radiance * exp(-0.5 * tau) + 0.5 * emitted * fxGlowShare(0.5 * tau); // (4)
#else
        vec3 within = radiance * share + emitted * fxGlowRest(tau); // (2)
#endif
        imageStore(rays, corner + cell, vec4(min(within, vec3(6e4)), 0.0));
        radiance = radiance * exp(-tau) + emitted * share; // (1)
        cell += direction;
    }
}
