#include "formulas/henyey_greenstein.fx.h"
#include "formulas/multiple_scattering.fx.h"
#include "formulas/network_cell.fx.h"
#include "shared/light_slices.glsl"
#include "shared/scattered_light.glsl"
#include "shared/sky_light.glsl"
#include "field/field_blocks.glsl"
#include "field/field_glow.glsl"
#include "network/network_grid.glsl"

// Light that each sample of the bricks scatters to the eye. FX_LAYERS 0 adds it to what the medium emits, so that a ray
// looks up one texture; FX_LAYERS 1 and FX_DETAIL 1 keep it apart, in place of albedo and phase function.
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Fields { VoxelField fields[]; };
layout(std430, binding = 2) readonly buffer Bricks { FieldBrick bricks[]; };
layout(rgba32f, binding = 0) uniform image3D medium;
layout(rgba16f, binding = 1) uniform image3D scatter;
#if !FX_NETWORK
layout(binding = 3) uniform sampler3D glowLight; // rgb logarithm of the mean radiance of what media emit [exposed]
#endif
layout(std140, binding = 0) uniform FieldLightBlock
{
    vec4 viewAxis; // xyz in which the eye looks; w 1 orthographic
    ivec4 network; // x [texel] of a block of moments along x
};

#if FX_NETWORK
#include "network/network_gather.glsl"
#else
const float kGlowRim = 2.0; // [cell] from the faces of a grid inwards, where its light gives way to that of points

// Light that media send, in all directions alike, and the box in which it replaces points.
vec3 glowAt(int grid, vec3 p, out GlowBox box)
{
    FieldGlow glow = glows[grid];
    vec3 cell = (p - glow.corner.xyz) / glow.corner.w;
    vec3 fromFace = min(cell, float(kGlowCells) - cell);
    float inside = clamp(min(min(fromFace.x, fromFace.y), fromFace.z) / kGlowRim, 0.0, 1.0);
    box = GlowBox(glow.corner.xyz, vec3(glow.corner.w * float(kGlowCells)), 1.0 - inside);
    vec3 texel = clamp(cell, vec3(0.5), vec3(float(kGlowCells) - 0.5)) + vec3(0.0, 0.0, float(kGlowCells * grid));
    return inside * exp(textureLod(glowLight, texel / vec3(textureSize(glowLight, 0)), 0.0).rgb);
}
#endif

// Light that is scattered to the eye, per unit of extinction. own: albedo, mean cosine
vec3 lightOf(VoxelField field, vec3 p, vec3 toEye, vec4 own)
{
    GlowBox box = kNoGlowBox;
    int grid = int(field.limits.w) - 1;
    int turns = grid >= 0 ? 1 : 0;
    vec3 source = vec3(0.0);
#if FX_NETWORK
    if (turns > 0) {
        box = GlowBox(glows[grid].corner.xyz, glows[grid].corner.w * vec3(glows[grid].cells.xyz), 0.0);
        source = networkScattered(grid, network.x, p, toEye, own.rgb, own.a) +
                 networkScatteredOnce(p, toEye, own.rgb, own.a, box);
    }
    if (turns < 1)
        source = skySource(p, toEye, own.rgb, own.a) + scatteredLight(p, toEye, own.rgb, own.a, box);
    return source;
#else
    if (turns > 0)
        source = own.rgb * glowAt(grid, p, box);
    return source + skySource(p, toEye, own.rgb, own.a) + scatteredLight(p, toEye, own.rgb, own.a, box);
#endif
}

void main()
{
    FieldBrick brick = bricks[gl_WorkGroupID.x];
    VoxelField field = fields[brick.field];
    ivec3 corner = brickTexel(int(gl_WorkGroupID.x));
    for (int i = int(gl_LocalInvocationIndex); i < kBrickSamples * kBrickSamples * kBrickSamples; i += 64) {
        ivec3 s = sampleOfBrick(i);
        vec4 before = imageLoad(medium, corner + s);
        vec4 own = imageLoad(scatter, corner + s);
        int turns = before.a != 0.0 && own.r + own.g + own.b > 0.0 ? 1 : 0;
        vec3 source = vec3(0.0);
        if (turns > 0) {
            vec3 p = placeOfSample(field, brick, s);
            vec3 toEye = viewAxis.w > 0.5 ? -viewAxis.xyz : -p / max(length(p), 1e-20);
            source = lightOf(field, p, toEye, own);
        }
#if FX_LAYERS || FX_DETAIL
        imageStore(scatter, corner + s, vec4(source, 1.0) * (before.a / field.limits.y));
#else
        imageStore(medium, corner + s, vec4(before.rgb + source * before.a, before.a));
#endif
    }
}
