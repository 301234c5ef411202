#include "formulas/slab_light.fx.h"
#include "shared/view_block.glsl"
#include "slabs/slab_ray.glsl"
#include "slabs/slab_sums.glsl"
#include "field/field_blocks.glsl"
#if FX_DETAIL
#include "formulas/kernel_optical_depth.fx.h"
#include "field/field_detail.glsl"
#endif
#include "field/field_sample.glsl"

// All media along one ray, from the eye on: each step is a slab of the sum of all fields. FX_LOOSE 1 adds what is in no field,
// balls and cards, to the same slabs; it is drawn as slabs.frag.glsl, and pass.z is the largest number of
// slabs that what is loose is divided into. A ray ends where nothing more is seen.
#if FX_LOOSE
#include "formulas/kernel_moment.fx.h"
#include "formulas/kernel_quantile.fx.h"
#include "formulas/detail_noise.fx.h"
#include "formulas/henyey_greenstein.fx.h"
#include "shared/card_nodes.glsl"
#include "shared/unrolled.glsl"
#include "shared/light_slices.glsl"
#include "slabs/slab_balls.glsl"
#include "slabs/slab_window.glsl"
#define FX_GROUP 1
#include "slabs/slab_fill.glsl"
layout(std430, binding = 3) readonly buffer FieldTiles { FieldTile fieldTiles[]; };
#else
flat in uvec2 tileRange;
#endif

const int kMaxDepthSamples = 16384;
const float kMaxStretch = 3.0;   // of steps behind what hides
const float kMostDepth = 1.0;    // optical depth of a step: a deeper one is taken again, shorter
const float kShortest = 0.03;    // [1] of the step that is taken again
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
    bool isThere = loose.range.y > loose.range.x;
    if (isThere) {
        SlabWindow window = windowOf(ray, loose.range);
        loose.window = window.ends;
        depth = window.depth;
    }
    float slabs = clamp(ceil(kSlabsPerDepth * depth), 1.0, pass.z);
    loose.width = isThere ? max((loose.window.y - loose.window.x) / slabs, 1e-6 * loose.range.y) : 1.0;
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

#if FX_LOOSE
// Shares of the loose between two samples up to where a range of depth begins and ends: xy of them, z [1] whole optical depth.
vec3 looseShares(SlabRay ray, vec2 cuts, float from, float to)
{
    float places[6] = float[6](from, cuts.x, cuts.y, to, to, to);
    float passed[6];
    passedUpTo(ray, places, passed);
    return vec3(shareBetween(passed[0], passed[1], passed[3]), shareBetween(passed[0], passed[2], passed[3]), passed[3] - passed[0]);
}
#endif

// Shares of the optical depth between two samples between which it is drawn. Extinction is linear between them.
vec2 drawnShares(SlabRay ray, FieldSample near, FieldSample far, float from, float to)
{
    vec2 cuts = clamp(ray.drawn, vec2(from), vec2(to));
    vec2 shares = (cuts - from) / max(to - from, 1e-20);
    bool isInside = (cuts.x > from || cuts.y < to) && cuts.x < to && cuts.y > from;
    for (int once = 0; once < (isInside ? 1 : 0); ++once) { // software renderers skip a loop without turns
        float begin = near.isEmpty ? 0.0 : max(near.medium.a, 0.0), end = near.isEmpty ? 0.0 : max(far.medium.a, 0.0); // as slabBetween
        float ofField = 0.5 * (to - from) * (begin + end);
        vec2 passed = (to - from) * shares * (begin + 0.5 * (end - begin) * shares);
        float whole = ofField;
#if FX_LOOSE
        vec3 loose = looseShares(ray, cuts, from, to);
        passed += loose.xy * loose.z;
        whole += loose.z;
#endif
        shares = whole > 1e-12 ? clamp(passed / whole, 0.0, 1.0) : shares;
    }
    return vec2(cuts.x > from ? shares.x : 0.0, cuts.y < to ? shares.y : 1.0);
}

// Puts what lies between two samples of a ray behind the picture.
#if FX_LOOSE
void putBetween(inout SlabPicture picture, SlabRay ray, LooseSlabs loose, FieldSample near, FieldSample far, float from, float to)
#else
void putBetween(inout SlabPicture picture, SlabRay ray, FieldSample near, FieldSample far, float from, float to)
#endif
{
    SlabSums sums[1] = SlabSums[1](slabBetween(near, far, to - from));
#if FX_LOOSE
    float edges[2] = float[2](from, to);
    float behind;
    if (to > loose.range.x && from < loose.range.y)
        addLoose(ray, edges, vec2(from, to), loose.range.y, sums, behind);
#endif
    putBehind(picture, sums[0], from, to, drawnShares(ray, near, far, from, to));
}

// Neighboring rays look for medium, each at its own pace, and then all of them evaluate it together: what is done together costs as
// little as what is done once. Conditions are branches: software renderers run the body of a loop once more than it has turns.
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
    const float last = -1.0;
#endif
    SlabPicture picture = emptyPicture();
    FieldRay fields = fieldRay(ray.origin, ray.direction, tileRange, pixel);
    FieldSample before = emptySample(), now = emptySample();
    float t = ray.t0, next = ray.t0; // [m] of the two
    uint number = 0u;                // of the field that is looked at
    vec4 rests = fields.rests;       // at t
    bool isOver = false, isShort = false;
    int looks = 0;
    while (!isOver && looks < kMaxDepthSamples) {
        FieldFind find;
        find.isMedium = false;
        while (!find.isMedium && !isOver && looks < kMaxDepthSamples) {
            ++looks;
            float depth = 0.5 * (before.medium.a + now.medium.a) * (next - t);
            bool isAgain = number >= tileRange.y && depth > kMostDepth && now.most < next - t && !isShort;
            if (isAgain) {
                next = t + max(sqrt(kDepthPerStep / depth), kShortest) * (next - t);
                fields.rests = rests;
                now = emptySample();
                number = nextField(fields, 0u, next, now);
                isShort = true;
            } else if (number >= tileRange.y) { // all fields have been looked at
#if FX_LOOSE
                putBetween(picture, ray, loose, before, now, t, next);
#else
                putBetween(picture, ray, before, now, t, next);
#endif
                before = now;
                t = next;
                rests = fields.rests;
                isShort = false;
                isOver = !(t < min(ray.t1, ray.drawn.y) && (before.room < kNever || t < last) && picture.passed < kLastDepth);
                float stretch = min(exp(0.25 * picture.passed), kMaxStretch); // less is seen of what follows
                next = t + (before.isEmpty ? before.room : min(stretch * before.room, before.most));
#if FX_LOOSE
                next = min(next, nextFace(loose, t));
#endif
                next = min(next, ray.t1);
                next = next < kNever ? next : t;
                now = emptySample();
                number = nextField(fields, 0u, next, now);
            }
            if (number < tileRange.y && !isOver) {
                find = lookAt(fields, number, next, now);
                number = find.isMedium ? number : nextField(fields, number + 1u, next, now);
            }
        }
        if (find.isMedium) {
            addFind(fields, find, next, now);
            number = nextField(fields, number + 1u, next, now);
        }
    }
    writePicture(picture);
}
