// Instance, motion and depths of what a pixel shows. FX_MEDIA 1: a square of a tile that has balls or cards; 0: the whole picture,
// as far as it has neither.
#include "formulas/kernel_moment.fx.h"
#include "formulas/kernel_quantile.fx.h"
#include "formulas/slab_light.fx.h"
#include "outputs/output_block.glsl"
#include "shared/view_block.glsl"
#include "shared/card_nodes.glsl"
#include "shared/unrolled.glsl"
#include "shared/output_marks.glsl"
#include "slabs/slab_balls.glsl"
#include "slabs/slab_ray.glsl"
layout(std430, binding = 6) readonly buffer BlobMarks { BlobMark blobMarks[]; };
layout(std430, binding = 7) readonly buffer CardMarks { CardMark cardMarks[]; };
layout(binding = 1) uniform sampler2D solidVelocity;  // xyz [m/s] of the solid thing that is seen, w 1; 0: there is none
layout(binding = 2) uniform usampler2D solidInstance; // its id

layout(location = 0) out uvec2 instanceId; // 0: none
layout(location = 1) out vec2 motion;      // [pixel] since the frame before, right and up
layout(location = 2) out float firstDepth; // [m] along the ray, +inf for none
layout(location = 3) out float meanDepth;  // likewise
layout(location = 4) out float opticalDepth;

const float kSeenDepth = 0.01; // [1] optical depth that is the first to be seen, and share of a pixel below which it has no id
const int kParts = 16;         // of what matters of a ray
const int kNames = 8;          // instances that a pixel tells apart

struct Seen
{
    float whole;   // [1] sum of contributions
    float covered; // [1] of those that hide
    float moment;  // [m] their distances, weighted
    vec2 motion;   // [pixel] weighted
    uvec2 names[kNames];
    float shares[kNames];
};

Seen nothingSeen()
{
    Seen seen;
    seen.whole = seen.covered = seen.moment = 0.0;
    seen.motion = vec2(0.0);
    for (int k = 0; k < kNames; ++k) {
        seen.names[k] = uvec2(0u);
        seen.shares[k] = 0.0;
    }
    return seen;
}

// Window position that a place relative to the eye of now had in the frame before.
vec2 windowBefore(vec3 place)
{
    vec3 p = place - pastEye.xyz;
    vec3 c = vec3(dot(p, pastRight.xyz), dot(p, pastUp.xyz), dot(p, pastForward.xyz));
    vec2 slope = pastClip.z > 0.5 ? c.xy : c.xy / max(c.z, 1e-6);
    vec2 clip = slope * vec2(pastRight.w, pastUp.w) + pastClip.xy;
    return (0.5 + 0.5 * vec2(clip.x, pastForward.w * clip.y)) * vec2(rayDirectionX.w, rayDirectionY.w);
}

vec2 motionOf(SlabRay ray, float distance, vec3 velocity)
{
    return gl_FragCoord.xy - windowBefore(ray.origin + distance * ray.direction - pastClip.w * velocity);
}

// Adds to the share of an instance. Where a pixel has more of them than names, the least share is handed on: what has more than
// 1 / kNames of the pixel is never lost.
void addName(inout Seen seen, uvec2 name, float share)
{
    int found = -1, least = 0;
    float leastShare = seen.shares[0];
#define FX_FIND_NAME(k)                                     \
    found = seen.names[k] == name && found < 0 ? k : found; \
    least = seen.shares[k] < leastShare ? k : least;        \
    leastShare = min(leastShare, seen.shares[k]);
    FX_EACH_8(FX_FIND_NAME)
    int at = found >= 0 ? found : least;
#define FX_ADD_SHARE(k)                                \
    seen.names[k] = k == at ? name : seen.names[k];    \
    seen.shares[k] += k == at ? share : 0.0;
    FX_EACH_8(FX_ADD_SHARE)
}

void addSeen(inout Seen seen, SlabRay ray, float share, float distance, vec3 velocity, uvec2 name)
{
    seen.whole += share;
    seen.motion += share * motionOf(ray, distance, velocity);
    addName(seen, name, share);
}

#if FX_MEDIA
#include "slabs/slab_window.glsl"

const int kRounds = 4; // of kBins each, that find where the depth passes kSeenDepth

// Where the depth passes kSeenDepth, which it does within the range.
float firstIn(SlabRay ray, vec2 range)
{
    float start = range.x;
    float place = range.x;
    for (int round = 0; round < kRounds; ++round) {
        float passed[kBins + 1];
        passedIn(ray, start, range, passed);
        float width = (range.y - range.x) / float(kBins);
        int bin = 0;
        for (int k = 1; k < kBins; ++k)
            bin += passed[k] < kSeenDepth ? 1 : 0;
        float before = 0.0, behind = 0.0;
        for (int k = 0; k < kBins; ++k) {
            before = k == bin ? passed[k] : before;
            behind = k == bin ? passed[k + 1] : behind;
        }
        float share = clamp((kSeenDepth - before) / max(behind - before, 1e-12), 0.0, 1.0);
        float left = range.x + float(bin) * width;
        place = left + share * width;
        range = vec2(left, left + width);
    }
    return place;
}

// Parts of the ray from the first thing to where nothing is seen any more.
struct Parts
{
    float edges[kParts + 1]; // [m]
    float weight[kParts];    // [1] what is seen of a unit of optical depth
};

// Optical depth of a card up to a place of the ray.
float ofCard(vec2 interval, float depth, float place)
{
    return depth * clamp((place - interval.x) / (interval.y - interval.x), 0.0, 1.0);
}

void findParts(SlabRay ray, vec2 range, vec2 window, out Parts parts, inout Seen seen)
{
    float depth[kParts], moment[kParts]; // [1], [m]
    float width = (window.y - window.x) / float(kParts);
    for (int k = 0; k <= kParts; ++k)
        parts.edges[k] = k == 0 ? range.x : window.x + float(k) * width;
    for (int k = 0; k < kParts; ++k)
        depth[k] = moment[k] = 0.0;
    for (int i = 0; i < tileList.y; ++i) {
        Chord chord = chordOfTile(ray, i);
        float u = placeOn(chord, parts.edges[0]);
        float passed = fxKernelPassed(u), moved = fxKernelMoment(u);
        float nextPassed, nextMoved, own;
#define FX_ADD_PART(k)                                                                            \
    u = placeOn(chord, parts.edges[k + 1]);                                                       \
    nextPassed = fxKernelPassed(u);                                                               \
    nextMoved = fxKernelMoment(u);                                                                \
    own = chord.depth * (nextPassed - passed);                                                    \
    depth[k] += own;                                                                              \
    moment[k] += (chord.tc - parts.edges[k]) * own + chord.w * chord.depth * (nextMoved - moved); \
    passed = nextPassed;                                                                          \
    moved = nextMoved;
        FX_EACH_16(FX_ADD_PART)
    }
    for (uint card = ray.cards; card != 0u; card = floatBitsToUint(cardNodes[card - 1u].body.w)) {
        vec4 body = cardNodes[card - 1u].body;
        vec2 interval = intervalOf(ray, body);
        for (int k = 0; k < kParts; ++k) {
            float own = ofCard(interval, body.y, parts.edges[k + 1]) - ofCard(interval, body.y, parts.edges[k]);
            float from = clamp(parts.edges[k], interval.x, interval.y);
            float to = clamp(parts.edges[k + 1], interval.x, interval.y);
            depth[k] += own;
            moment[k] += own * (0.5 * (from + to) - parts.edges[k]);
        }
    }
    float through = 1.0;
    for (int k = 0; k < kParts; ++k) {
        float opacity = fxSlabOpacity(max(depth[k], 0.0));
        parts.weight[k] = depth[k] > 0.0 ? through * opacity / depth[k] : through;
        // as if the medium were even around its mean place, which is not nearer to a face than half of what it would then take
        float length = parts.edges[k + 1] - parts.edges[k];
        float inside = depth[k] > 0.0 ? clamp(moment[k] / depth[k], 0.0, length) : 0.0;
        float spread = 2.0 * min(inside, length - inside);
        seen.moment += through * (opacity * (parts.edges[k] + inside) + spread * fxSlabSlopeWeight(max(depth[k], 0.0)));
        seen.covered += through * opacity;
        through *= 1.0 - opacity;
    }
}

// Share of what a ray sees and mean distance, of something of which `own[k]` is the optical depth in each part.
void shareOf(Parts parts, float own[kParts], inout float share, inout float moment)
{
    for (int k = 0; k < kParts; ++k) {
        share += parts.weight[k] * own[k];
        moment += parts.weight[k] * own[k] * 0.5 * (parts.edges[k] + parts.edges[k + 1]);
    }
}

float throughAt(Parts parts, float place)
{
    float weight = 1.0;
    for (int k = 0; k < kParts; ++k)
        weight = place >= parts.edges[k] ? parts.weight[k] : weight;
    return weight;
}

void addMedia(SlabRay ray, Parts parts, inout Seen seen)
{
    float own[kParts];
    for (int i = 0; i < tileList.y; ++i) {
        uint entry = entryOfTile(i), ball = ballOfEntry(entry);
        Chord chord = chordOf(ray, entry);
        float passed = fxKernelPassed(placeOn(chord, parts.edges[0]));
        float share = 0.0, moment = 0.0, next, part;
#define FX_ADD_SEEN(k)                                             \
    next = fxKernelPassed(placeOn(chord, parts.edges[k + 1]));     \
    part = parts.weight[k] * chord.depth * (next - passed);        \
    share += part;                                                 \
    moment += part * 0.5 * (parts.edges[k] + parts.edges[k + 1]);  \
    passed = next;
        FX_EACH_16(FX_ADD_SEEN)
        if (share > 0.0)
            addSeen(seen, ray, share, moment / share, blobMarks[ball].velocity.xyz, blobMarks[ball].instance.xy);
    }
    for (uint card = ray.cards; card != 0u; card = floatBitsToUint(cardNodes[card - 1u].body.w)) {
        vec4 body = cardNodes[card - 1u].body;
        CardMark mark = cardMarks[card - 1u];
        vec2 interval = intervalOf(ray, body);
        for (int k = 0; k < kParts; ++k)
            own[k] = ofCard(interval, body.y, parts.edges[k + 1]) - ofCard(interval, body.y, parts.edges[k]);
        float share = 0.0, moment = 0.0;
        shareOf(parts, own, share, moment);
        if (!(body.y > 0.0)) // it only adds
            share = mark.velocity.w * throughAt(parts, body.x);
        if (share > 0.0)
            addSeen(seen, ray, share, body.x, mark.velocity.xyz, mark.instance.xy);
    }
}
#endif

void main()
{
    SlabRay ray = slabRay();
    Seen seen = nothingSeen();
    float whole = 0.0; // [1] optical depth
    firstDepth = uintBitsToFloat(0x7F800000u);
#if FX_MEDIA
    ray.cards = firstCard();
    vec2 range = rangeOf(ray);
    if (range.y > range.x) {
        SlabWindow window = windowOf(ray, range);
        whole = window.depth;
        Parts parts;
        findParts(ray, range, vec2(window.ends.x, whole < kMaxDepth ? range.y : window.ends.y), parts, seen);
        addMedia(ray, parts, seen);
        if (whole >= kSeenDepth)
            firstDepth = firstIn(ray, range);
    }
#endif
    vec4 solid = vec4(0.0);
    if (pastEye.w > 0.5)
        solid = texelFetch(solidVelocity, ivec2(gl_FragCoord.xy), 0);
    if (solid.w > 0.5) {
        float share = exp(-whole);
        seen.covered += share;
        seen.moment += share * ray.t1;
        firstDepth = min(firstDepth, ray.t1);
        addSeen(seen, ray, share, ray.t1, solid.xyz, texelFetch(solidInstance, ivec2(gl_FragCoord.xy), 0).xy);
    }
    int most = 0;
    for (int k = 1; k < kNames; ++k)
        most = seen.shares[k] > seen.shares[most] ? k : most;
    bool isSeen = seen.whole >= fxSlabOpacity(kSeenDepth);
    instanceId = isSeen ? seen.names[most] : uvec2(0u);
    motion = isSeen ? seen.motion / seen.whole : vec2(0.0);
    meanDepth = seen.covered > 0.0 ? seen.moment / seen.covered : uintBitsToFloat(0x7F800000u);
    opticalDepth = whole;
}
