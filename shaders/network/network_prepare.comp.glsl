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
layout(std140, binding = 0) uniform NetworkBlock { ivec4 network; };

const int kSamples = 2; // of light, along a side of a cell
const float kLeastWeight = 1e-3; // of a part of the cell, in units of the cell's mean extinction: light slices may lack its medium

// Light of one source in a cell before the medium has scattered it but straight on: the mean over the medium, formula network-cell (6).
struct Beam
{
    vec4 light[3]; // moments of each color, times the weights
    float weights;
};

// depths: optical depths between the light and the ends of a way through a part of the cell
void addWay(vec3 arriving, vec3 towards, vec2 depths, vec3 straight, float least, inout Beam beam)
{
    float way = max(depths.y - depths.x, 0.0);
    vec3 passing = exp(-way * straight);
    vec3 taken = vec3(fxNetworkMean(way * straight.r, passing.r), fxNetworkMean(way * straight.g, passing.g),
                      fxNetworkMean(way * straight.b, passing.b));
    float weight = way + least;
    vec3 irradiance = weight * arriving * exp(-depths.x * straight) * (1.0 - taken);
    vec4 y = networkHarmonics(-towards);
    for (int c = 0; c < 3; ++c)
        beam.light[c] += irradiance[c] * y;
    beam.weights += weight;
}

// The light that the cell had, moments of a color.
vec4 momentsBefore(FieldGlow grid, vec3 p, int c)
{
    vec3 size = vec3(textureSize(moments, 0)); // its blocks may be larger or smaller than those of this frame
    vec3 texel = clamp((p - grid.before.xyz) / grid.before.w, vec3(0.5), vec3(grid.cellsBefore.xyz) - 0.5);
    texel += vec3(float(c) * size.x / 3.0, 0.0, float(grid.cellsBefore.w));
    return textureLod(moments, texel / size, 0.0);
}

void main()
{
    ivec3 id = ivec3(gl_GlobalInvocationID);
    FieldGlow grid = glows[glowOfLayer(id.z, network.z)];
    ivec3 place = id - ivec3(0, 0, grid.cells.w);
    if (any(greaterThanEqual(place, grid.cells.xyz)))
        return;
    vec3 cell = vec3(place);
    vec4 own = texelFetch(cells, id, 0);
    vec4 scattering = texelFetch(scatter, id, 0);
    float g = clamp(scattering.a, -0.3, 0.98);
    float f = fxNetworkPeak(g);
    vec3 albedo = own.a > 0.0 ? clamp(scattering.rgb / own.a, vec3(0.0), vec3(1.0)) : vec3(0.0);
    vec3 straight = 1.0 - albedo * f;
    vec3 share = albedo * (1.0 - f) / max(straight, vec3(1e-20));
    float g1 = (g - f) / (1.0 - f);
    GlowBox box = GlowBox(grid.corner.xyz, grid.corner.w * vec3(grid.cells.xyz), 0.0); // its media send their own light
    vec4 light[3] = vec4[3](vec4(0.0), vec4(0.0), vec4(0.0));
    int count = scattering.r + scattering.g + scattering.b > 0.0 ? lightCounts.x : 0;
    float reach = 0.5 * grid.corner.w / float(kSamples); // [m] of a way
    float least = kLeastWeight * own.a * reach;
    for (int l = 0; l < count; ++l) {
        Beam beam = Beam(vec4[3](vec4(0.0), vec4(0.0), vec4(0.0)), 0.0);
        for (int i = 0; i < kSamples * kSamples * kSamples; ++i) {
            vec3 part = (vec3(i % kSamples, i / kSamples % kSamples, i / (kSamples * kSamples)) + 0.5) / float(kSamples);
            vec3 p = grid.corner.xyz + grid.corner.w * (cell + part);
            vec3 towards;
            vec3 arriving = unshadowedLight(lights[l], p, towards) * shareOf(lights[l], box);
            vec2 depths = vec2(sliceDepth(l, p + reach * towards).x, sliceDepth(l, p - reach * towards).x);
            addWay(arriving, towards, depths, straight, least, beam);
        }
        for (int c = 0; c < 3; ++c)
            light[c] += beam.light[c] / beam.weights;
    }
    vec3 middle = grid.corner.xyz + grid.corner.w * (cell + 0.5);
    vec4 bands = vec4(1.0, g1, g1, g1);
    int block = network.x;
    imageStore(medium, id, vec4(own.a * straight, 0.0));
    imageStore(medium, id + ivec3(block, 0, 0), vec4(share, g1));
    for (int c = 0; c < 3; ++c) {
        vec4 first = share[c] * bands * light[c];
        first.x += own.a > 0.0 ? 3.5449077018110318 * max(own[c], 0.0) / (own.a * straight[c]) : 0.0;
        vec4 all = first;
        if (grid.before.w > 0.0)
            all += share[c] * bands * momentsBefore(grid, middle, c);
        imageStore(unswept, id + ivec3(c * block, 0, 0), first);
        imageStore(sources, id + ivec3(c * block, 0, 0), all);
    }
}
