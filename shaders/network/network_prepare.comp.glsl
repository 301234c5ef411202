#include "formulas/henyey_greenstein.fx.h"
#include "formulas/multiple_scattering.fx.h"
#include "formulas/network_cell.fx.h"
#include "shared/light_slices.glsl"
#include "shared/scattered_light.glsl"
#include "field/field_glow.glsl"
#include "network/network_grid.glsl"

// The medium of each cell without its forward peak, what it sends before the network carries any light, formula network-sweep (1) with
// J = 0, and its source with the light of the frame before. Sun and points reach the cell through the light slices.
layout(local_size_x = 8, local_size_y = 4, local_size_z = 2) in;
layout(binding = 0) uniform sampler3D cells;   // rgb emitted light [exposed/m]; a extinction [1/m]
layout(binding = 1) uniform sampler3D scatter; // rgb [1/m] extinction times albedo; a mean cosine
layout(binding = 2) uniform sampler3D moments; // of the frame before
layout(rgba32f, binding = 0) uniform writeonly image3D medium;
layout(rgba32f, binding = 1) uniform writeonly image3D unswept;
layout(rgba32f, binding = 2) uniform writeonly image3D sources;
layout(std140, binding = 0) uniform NetworkBlock { ivec4 network; }; // x cells along a side

const int kSamples = 2; // of light, along a side of a cell

// Adds light that reaches a place, and that its medium has not scattered yet but straight on.
void addLight(vec3 arriving, vec3 towards, float depth, vec3 straight, inout vec4 light[3])
{
    vec4 y = networkHarmonics(-towards);
    vec3 irradiance = arriving * exp(-depth * straight);
    for (int c = 0; c < 3; ++c)
        light[c] += irradiance[c] * y;
}

// The light that the cell had, moments of a color.
vec4 momentsBefore(FieldGlow grid, vec3 p, int c)
{
    int side = network.x;
    vec3 texel = clamp((p - grid.before.xyz) / grid.before.w, vec3(0.5), vec3(float(side) - 0.5));
    texel += float(side) * vec3(c, 0.0, grid.number.x);
    return textureLod(moments, texel / vec3(textureSize(moments, 0)), 0.0);
}

void main()
{
    int side = network.x;
    ivec3 id = ivec3(gl_GlobalInvocationID);
    int number = id.z / side;
    FieldGlow grid = glows[number];
    vec3 cell = vec3(id.xy, id.z - side * number);
    vec4 own = texelFetch(cells, id, 0);
    vec4 scattering = texelFetch(scatter, id, 0);
    float g = clamp(scattering.a, -0.3, 0.98);
    float f = fxNetworkPeak(g);
    vec3 albedo = own.a > 0.0 ? clamp(scattering.rgb / own.a, vec3(0.0), vec3(1.0)) : vec3(0.0);
    vec3 straight = 1.0 - albedo * f;
    vec3 share = albedo * (1.0 - f) / max(straight, vec3(1e-20));
    float g1 = (g - f) / (1.0 - f);
    GlowBox box = GlowBox(grid.corner.xyz, grid.corner.w * float(side), 0.0); // its media send their own light
    vec4 light[3] = vec4[3](vec4(0.0), vec4(0.0), vec4(0.0));
    int samples = scattering.r + scattering.g + scattering.b > 0.0 ? kSamples * kSamples * kSamples : 0;
    for (int i = 0; i < samples; ++i) {
        vec3 part = (vec3(i % kSamples, i / kSamples % kSamples, i / (kSamples * kSamples)) + 0.5) / float(kSamples);
        vec3 p = grid.corner.xyz + grid.corner.w * (cell + part);
        addLight(lights[0].color.rgb * hostShadow(p), lights[0].place.xyz, sunDepth(p).x, straight, light);
        for (int l = 1; l < lightCounts.x; ++l) {
            vec3 towards;
            vec3 arriving = pointLight(lights[l], p, towards) * shareOf(lights[l], box);
            addLight(arriving, towards, pointDepth(l, p).x, straight, light);
        }
    }
    vec3 middle = grid.corner.xyz + grid.corner.w * (cell + 0.5);
    vec4 bands = vec4(1.0, g1, g1, g1);
    int block = side;
    imageStore(medium, id, vec4(own.a * straight, 0.0));
    imageStore(medium, id + ivec3(block, 0, 0), vec4(share, g1));
    for (int c = 0; c < 3; ++c) {
        vec4 first = share[c] * bands * light[c] / float(max(samples, 1));
        first.x += own.a > 0.0 ? 3.5449077018110318 * max(own[c], 0.0) / (own.a * straight[c]) : 0.0;
        vec4 all = first;
        if (grid.before.w > 0.0)
            all += share[c] * bands * momentsBefore(grid, middle, c);
        imageStore(unswept, id + ivec3(c * block, 0, 0), first);
        imageStore(sources, id + ivec3(c * block, 0, 0), all);
    }
}
