#include "formulas/slab_light.fx.h"
#include "shared/view_block.glsl"
#include "slabs/slab_ray.glsl"
#include "slabs/slab_sums.glsl"
#include "field/field_blocks.glsl"
#if FX_DETAIL
#include "field/field_detail.glsl"
#endif
#include "field/field_sample.glsl"

// All media along one ray, from the eye on: each step is a slab of the sum of all fields. FX_LOOSE 1 adds what is in no field,
// balls and cards, to the same slabs, kGroup at a time; it is drawn as slabs.frag.glsl, and pass.z is the largest number of
// slabs that what is loose is divided into. A ray ends where nothing more is seen.
#if FX_LOOSE
#include "formulas/kernel_moment.fx.h"
#include "formulas/kernel_quantile.fx.h"
#include "formulas/detail_noise.fx.h"
#include "formulas/henyey_greenstein.fx.h"
#include "shared/card_nodes.glsl"
#include "shared/light_slices.glsl"
#include "slabs/slab_balls.glsl"
#include "slabs/slab_window.glsl"
const int kGroup = 4;
#include "slabs/slab_fill.glsl"
layout(std430, binding = 3) readonly buffer FieldTiles { FieldTile fieldTiles[]; };
#else
flat in uvec2 tileRange;
#endif

const int kMaxSteps = 4096;
const float kMaxStretch = 3.0;   // of steps behind what hides
const float kSlabsPerDepth = 8.0; // slabs across what is loose: where it is thin, what hides what hardly matters

#if FX_LOOSE
// Where on a ray the loose is, and the slabs across it.
struct LooseSlabs
{
    vec2 range;  // [m] from the first thing to the end of the last
    vec2 window; // [m] what of it matters
    float width; // [m] of a slab
};

LooseSlabs looseSlabs(SlabRay ray)
{
    LooseSlabs loose;
    loose.range = rangeOf(ray);
    loose.window = loose.range;
    float depth = 0.0;
    int turns = loose.range.y > loose.range.x ? 1 : 0; // a loop without turns is skipped by software renderers too
    for (int turn = 0; turn < turns; ++turn)
        loose.window = windowOf(ray, loose.range, depth);
    float slabs = clamp(ceil(kSlabsPerDepth * depth), 1.0, pass.z);
    loose.width = turns > 0 ? max((loose.window.y - loose.window.x) / slabs, 1e-6 * loose.range.y) : 1.0;
    return loose;
}

// The next face of a slab behind t, kNever behind the last.
float nextFace(LooseSlabs loose, float t)
{
    const float kRounding = 1e-3; // [slab] so that a face is not its own successor
    float number = max(floor((t - loose.window.x) / loose.width + kRounding) + 1.0, 1.0);
    float face = t < loose.range.x ? loose.range.x : min(loose.window.x + number * loose.width, loose.range.y);
    face = t > loose.window.y - kRounding * loose.width ? loose.range.y : face;
    return t < loose.range.y ? face : kNever;
}

uvec2 fieldsOfTexel()
{
    vec2 clip = gl_FragCoord.xy / vec2(rayDirectionX.w, rayDirectionY.w) * 2.0 - 1.0;
    clip.y *= rayOriginY.w;
    ivec2 place = clamp(ivec2((0.5 + 0.5 * clip) * vec2(kFieldTiles)), ivec2(0), kFieldTiles - 1);
    FieldTile tile = fieldTiles[place.y * kFieldTiles.x + place.x];
    return uvec2(tile.first, tile.count);
}
#endif

void main()
{
    SlabRay ray = slabRay();
    bool isParallel = rayOrigin.w > 0.5;
    vec2 pixel = isParallel ? vec2(0.0, 1.0 / sunDirection.w) : vec2(1.0 / (ray.lengthPerDepth * sunDirection.w), 0.0);
#if FX_LOOSE
    ray.cards = firstCard();
    uvec2 tileRange = fieldsOfTexel();
    LooseSlabs loose = looseSlabs(ray);
    float last = loose.range.y;
#else
    const int kGroup = 1;
    const float last = -1.0;
#endif
    SlabPicture picture = emptyPicture();
    float t = ray.t0;
    FieldSample before = sampleFields(ray.origin, ray.direction, t, tileRange, pixel);
    for (int i = 0; i < kMaxSteps && t < ray.t1 && (before.room < kNever || t < last) && picture.through > kMinTransmittance;
         i += kGroup) {
        float edges[kGroup + 1];
        SlabSums sums[kGroup];
        edges[0] = t;
        float stretch = min(inversesqrt(sqrt(max(picture.through, 1e-8))), kMaxStretch); // less is seen of what follows
        for (int k = 0; k < kGroup; ++k) {
            float next = t + before.room * (before.isEmpty ? 1.0 : stretch);
#if FX_LOOSE
            next = min(next, nextFace(loose, t));
#endif
            next = min(next, ray.t1);
            next = next < kNever ? next : t;
            FieldSample now = sampleFields(ray.origin, ray.direction, next, tileRange, pixel);
            sums[k] = slabBetween(before, now, next - t);
            edges[k + 1] = t = next;
            before = now;
        }
#if FX_LOOSE
        float behind;
        int meets = edges[kGroup] > loose.range.x && edges[0] < loose.range.y ? 1 : 0;
        for (int turn = 0; turn < meets; ++turn)
            addLoose(ray, edges, loose.range.y, sums, behind);
#endif
        for (int k = 0; k < kGroup; ++k)
            putBehind(picture, sums[k], edges[k], edges[k + 1]);
    }
    writePicture(picture);
}
