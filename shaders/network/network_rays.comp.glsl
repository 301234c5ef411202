#include "formulas/network_cell.fx.h"
#include "shared/light_block.glsl"
#include "field/field_glow.glsl"
#include "network/network_grid.glsl"

// Light along the lines of cells: formula network-sweep (2). One invocation a line, from the face where it enters. Sky and ground shine
// in from outside.
layout(local_size_x = 64) in;
layout(binding = 0) uniform sampler3D medium;
layout(binding = 1) uniform sampler3D sources;
layout(rgba32f, binding = 0) uniform writeonly image3D rays; // rgb mean radiance in a cell [exposed], of each direction
layout(std140, binding = 0) uniform NetworkBlock { ivec4 network; };

vec3 enteringLight(ivec3 direction)
{
    return direction.y < 0 ? lightOfSky.rgb : direction.y > 0 ? lightOfGround.rgb : 0.5 * (lightOfSky.rgb + lightOfGround.rgb);
}

void main()
{
    int grid = int(gl_WorkGroupID.z) / kNetworkDirections, number = int(gl_WorkGroupID.z) % kNetworkDirections;
    ivec3 direction = networkStep(number);
    ivec3 cells = glows[grid].cells.xyz;
    ivec3 enter = ivec3(direction.x > 0 ? 0 : cells.x - 1, direction.y > 0 ? 0 : cells.y - 1, direction.z > 0 ? 0 : cells.z - 1);
    // One line for each cell of three faces: first those across x, then those across y and z.
    ivec2 faces = ivec2(cells.y * cells.z, cells.x * cells.z);
    int line = int(gl_GlobalInvocationID.x);
    int axis = line < faces.x ? 0 : line < faces.x + faces.y ? 1 : 2;
    line -= axis == 0 ? 0 : axis == 1 ? faces.x : faces.x + faces.y;
    int row = axis == 0 ? cells.y : cells.x;
    ivec2 across = ivec2(line % row, line / row);
    ivec3 cell = axis == 0 ? ivec3(enter.x, across) : axis == 1 ? ivec3(across.x, enter.y, across.y) : ivec3(across, enter.z);
    bool isLine = direction[axis] != 0 && cell.y < cells.y; // others have more lines
    for (int other = 0; other < axis; ++other) // it enters at the edge of two faces: the first has it
        isLine = isLine && !(direction[other] != 0 && cell[other] == enter[other]);
    float way = glows[grid].corner.w * length(vec3(direction));
    vec4 y = networkHarmonics(normalize(vec3(direction)));
    ivec3 above = ivec3(0, 0, glows[grid].cells.w);
    ivec3 corner = networkRayCorner(number, network.xy) + above;
    vec3 radiance = enteringLight(direction);
    int count = isLine ? cells[axis] : 0;
    for (int a = 0; a < 3; ++a)
        count = min(count, direction[a] > 0 ? cells[a] - cell[a] : direction[a] < 0 ? cell[a] + 1 : count);
    for (int i = 0; i < count; ++i) {
        ivec3 at = cell + above;
        vec3 tau = texelFetch(medium, at, 0).rgb * way;
        vec3 mean = radiance;
        if (tau.r > 0.0) {
            vec3 passing = exp(-tau);
            vec3 more = vec3(dot(texelFetch(sources, at, 0), y), dot(texelFetch(sources, at + ivec3(network.x, 0, 0), 0), y),
                             dot(texelFetch(sources, at + ivec3(2 * network.x, 0, 0), 0), y)) -
                        radiance;
            vec3 u = vec3(fxNetworkMean(tau.r, passing.r));
            vec3 a = vec3(fxNetworkTaken(tau.r, passing.r));
            int others = tau.g != tau.r || tau.b != tau.r ? 3 : 1; // software renderers skip loops without turns
            for (int c = 1; c < others; ++c) {
                u[c] = fxNetworkMean(tau[c], passing[c]);
                a[c] = fxNetworkTaken(tau[c], passing[c]);
            }
            mean = max(radiance + u * more, vec3(0.0));
            radiance = max(radiance + a * more, vec3(0.0));
        }
        imageStore(rays, corner + cell, vec4(mean, 0.0));
        cell += direction;
    }
}
