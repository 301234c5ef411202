#include "field/field_glow.glsl"
#include "network/network_grid.glsl"

// Moments of the light of all directions, formula network-sweep (3), and the sources that they make, (1).
layout(local_size_x = 8, local_size_y = 4, local_size_z = 2) in;
layout(binding = 0) uniform sampler3D rays; // see network_rays.comp.glsl
layout(binding = 1) uniform sampler3D medium;
layout(binding = 2) uniform sampler3D unswept;
layout(rgba32f, binding = 0) uniform writeonly image3D moments;
layout(rgba32f, binding = 1) uniform writeonly image3D sources;
layout(std140, binding = 0) uniform NetworkBlock { ivec4 network; };

void main()
{
    ivec3 id = ivec3(gl_GlobalInvocationID);
    ivec4 cells = glows[glowOfLayer(id.z, network.z)].cells;
    if (any(greaterThanEqual(id - ivec3(0, 0, cells.w), cells.xyz)))
        return;
    vec4 sums[3] = vec4[3](vec4(0.0), vec4(0.0), vec4(0.0));
    for (int i = 0; i < kNetworkDirections; ++i) {
        vec3 d = vec3(networkStep(i));
        float square = dot(d, d);
        float weight = 12.566370614359172 * (square < 1.5 ? 1.0 / 21.0 : square < 2.5 ? 4.0 / 105.0 : 9.0 / 280.0); // [LEB76]
        vec4 share = weight * networkHarmonics(d * inversesqrt(square));
        vec3 light = texelFetch(rays, networkRayCorner(i, network.xy) + id, 0).rgb;
        for (int c = 0; c < 3; ++c)
            sums[c] += share * light[c]; // (3)
    }
    vec4 scattering = texelFetch(medium, id + ivec3(network.x, 0, 0), 0);
    vec4 bands = vec4(1.0, scattering.aaa);
    for (int c = 0; c < 3; ++c) {
        ivec3 at = id + ivec3(c * network.x, 0, 0);
        imageStore(moments, at, sums[c]);
        imageStore(sources, at, texelFetch(unswept, at, 0) + scattering[c] * bands * sums[c]); // (1)
    }
}
