#include "formulas/kernel_moment.fx.h"
#include "formulas/kernel_quantile.fx.h"
#include "formulas/detail_noise.fx.h"
#include "formulas/henyey_greenstein.fx.h"
#include "formulas/slab_light.fx.h"
#include "shared/view_block.glsl"
#include "shared/card_nodes.glsl"
#include "shared/light_slices.glsl"
#include "slabs/slab_balls.glsl"
#include "slabs/slab_window.glsl"

// All media along one ray, summed up in FX_SLABS slabs and put together front to back, premultiplied. FX_LAYERS as in
// media.frag.glsl. kGroup slabs are filled at a time: fewer take fewer registers, but each group reads all balls again.
#if FX_LAYERS && !FX_DETAIL
const int kGroup = FX_SLABS == 6 ? 3 : 4;
#else
const int kGroup = FX_SLABS;
#endif
#include "slabs/slab_fill.glsl"

#if FX_LAYERS
const float kLeastThrough = -1.0; // the optical depth is that of the whole ray
#include "shared/layer_outputs.glsl"
#else
const float kLeastThrough = 1e-4; // [1] transmittance behind which nothing is seen
layout(location = 0) out vec4 light;
#endif

#if FX_LAYERS
// What the slopes of all layers are multiplied by, so that the source of their sum is nowhere negative; one channel.
float slopeScale(float depth, float light, float moment, float slope)
{
    float perDepth = 1.0 / max(depth, 1e-12);
    float free = 12.0 * (slope - light * perDepth * moment) * perDepth;
    return free != 0.0 ? fxSlabSlope(depth, light, moment, slope) / free : 1.0;
}
#endif

void main()
{
    SlabRay ray = slabRay();
    vec2 range = rangeOf(ray);
    if (!(range.y > range.x))
        discard;
    vec2 window = narrowed(ray, range.x, range, false);
    window = narrowed(ray, range.x, window, true);
    float width = (window.y - window.x) / float(FX_SLABS);

    float through = 1.0; // [1] transmittance
    float behind = 0.0;  // [1] optical depth behind the window: it hides, and its light is not seen
    vec3 seen[kLayers];
    for (int l = 0; l < kLayers; ++l)
        seen[l] = vec3(0.0);
#if FX_LAYERS
    vec3 covered = vec3(0.0);
    float distances = 0.0, depths = 0.0;
#endif
    for (int first = 0; first < FX_SLABS && through > kLeastThrough; first += kGroup) {
        float edges[kGroup + 1];
        for (int k = 0; k <= kGroup; ++k) {
            int edge = first + k;
            edges[k] = edge == 0 ? range.x : edge == FX_SLABS ? window.y : window.x + float(edge) * width;
        }
        SlabSums sums[kGroup];
        fill(ray, edges, range.y, sums, behind);
        for (int k = 0; k < kGroup; ++k) {
            float depth = sums[k].depth;
            float opacity = fxSlabOpacity(depth);
#if FX_LAYERS
            vec3 lights = sums[k].light[0] + sums[k].light[1] + sums[k].light[2];
            vec3 slopes = sums[k].slope[0] + sums[k].slope[1] + sums[k].slope[2];
            vec3 scale = vec3(slopeScale(depth, lights.r, sums[k].moment, slopes.r),
                              slopeScale(depth, lights.g, sums[k].moment, slopes.g),
                              slopeScale(depth, lights.b, sums[k].moment, slopes.b));
            float perDepth = 1.0 / max(depth, 1e-12);
            for (int l = 0; l < kLayers; ++l) {
                vec3 slope = scale * 12.0 * (sums[k].slope[l] - sums[k].light[l] * (perDepth * sums[k].moment)) * perDepth;
                seen[l] += through * vec3(fxSlabLight(depth, sums[k].light[l].r, slope.r),
                                          fxSlabLight(depth, sums[k].light[l].g, slope.g),
                                          fxSlabLight(depth, sums[k].light[l].b, slope.b));
            }
            covered += through * opacity * perDepth * sums[k].share;
            distances += through * (opacity * 0.5 * (edges[k] + edges[k + 1]) +
                                    (edges[k + 1] - edges[k]) * fxSlabSlopeWeight(depth));
            depths += depth;
#else
            vec3 source = sums[k].light[0];
            vec3 moment = sums[k].slope[0];
            vec3 slope = vec3(fxSlabSlope(depth, source.r, sums[k].moment, moment.r),
                              fxSlabSlope(depth, source.g, sums[k].moment, moment.g),
                              fxSlabSlope(depth, source.b, sums[k].moment, moment.b));
            seen[0] += through * vec3(fxSlabLight(depth, source.r, slope.r), fxSlabLight(depth, source.g, slope.g),
                                      fxSlabLight(depth, source.b, slope.b));
#endif
            through *= 1.0 - opacity;
        }
    }
    through *= exp(-behind);
#if FX_LAYERS
    depths += behind;
    float alpha = 1.0 - through;
    fireLight = vec4(max(seen[0], vec3(0.0)), alpha);
    smokeLight = vec4(max(seen[1], vec3(0.0)), alpha);
    dustLight = vec4(max(seen[2], vec3(0.0)), alpha);
    coverage = vec4(covered, alpha);
    depthMoment = vec4(distances, 0.0, 0.0, alpha);
    opticalDepthSum = vec4(depths, 0.0, 0.0, 0.0);
#else
    light = vec4(seen[0], 1.0 - through);
#endif
}
