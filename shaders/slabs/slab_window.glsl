// What a ray meets, and which part of it matters. Needs shared/view_block.glsl, shared/card_nodes.glsl, shared/unrolled.glsl,
// slabs/slab_balls.glsl, slabs/slab_ray.glsl and formulas/kernel_quantile.fx.h.
#ifndef FX_BLOCKS
#define FX_BLOCKS 0
#endif
layout(binding = 8) uniform sampler2D balls;
layout(binding = 9) uniform usampler2D lists;
flat in ivec2 tileList;    // first entry and entries
flat in float tileWeight; // [1] balls of the tile over the weights of all entries: an entry of the weight 1 stands for as many

const float kMinDepth = 0.002; // [1] before the window, and behind it
const float kMinShare = 0.05;  // [1] likewise at most, of the depth of the whole ray
#if FX_FIELD_DETAIL
const float kMaxDepth = 36.0;   // [1] up to its end: there are gaps in what is eroded
#else
const float kMaxDepth = 9.0;    // [1] up to its end: glow behind it may be a thousand times as bright as what hides it
#endif
const float kEvenly = 0.4;       // [1] share of the slabs that are spread evenly; the others are where media are seen
const float kSeenDecay = 0.5;    // [1] a medium counts as seen by exp(-kSeenDecay depth before it): what hides is to be exact too
const int kBins = 8;             // of each of the two passes that find it

#if FX_BLOCKS
#include "blocks/block_chord.glsl"
vec4 blockScatter = vec4(0.0); // rgb albedo of the blocks on the ray, mean by optical depth; w [1] this depth
float blockPhase = 0.0;        // mean cosine of their phase functions
#endif

// The first of the cards of the texel. pass.y: 1 when there are cards
uint firstCard()
{
    uint first = 0u;
    if (pass.y > 0.5)
        first = cardHeads[cardHeadAt(ivec2(gl_FragCoord.xy), ivec2(rayDirectionX.w, rayDirectionY.w))];
    return first;
}

// The chord of a ball.
struct Chord
{
    vec3 across;   // [m] from the center to the nearest point of the ray
    float tc;      // [m] ray parameter of that point
    float w;       // [m] half the chord, > 0
    float perHalf; // [1/m] 1 / w
    float depth;   // [1] optical depth of the whole chord, 0 beside the ball
#if FX_BLOCKS
    bool isBlock; // the depth is that of a tile
    BlockChord block;
#endif
};

// A ball of the tile, see listEntry.
uint entryOfTile(int i) { return texelFetch(lists, listTexel(tileList.x + i), 0).r; }

Chord chordOf(SlabRay ray, uint entry)
{
    uint ball = ballOfEntry(entry);
    vec4 place = texelFetch(balls, ballTexel(ball, kPlace), 0), medium = texelFetch(balls, ballTexel(ball, kMedium), 0);
    Chord chord;
    vec3 toCenter = place.xyz - ray.origin;
    chord.tc = dot(toCenter, ray.direction);
    chord.across = chord.tc * ray.direction - toCenter;
    float h = length(chord.across);
    float q2 = max((place.w - h) * (place.w + h), 0.0) / (place.w * place.w);
    float q = sqrt(q2);
    chord.w = place.w * max(q, 1e-6);
    chord.perHalf = 1.0 / chord.w;
    chord.depth = tileWeight * weightOfEntry(entry) * medium.x * q2 * q2 * q;
#if FX_BLOCKS
    chord.isBlock = medium.w < 0.0;
    chord.block = emptyBlockChord();
    chord.depth = chord.isBlock ? 0.0 : chord.depth;
    for (int i = 0; i < (chord.isBlock && q2 > 0.0 ? 1 : 0); ++i) { // software renderers skip a loop without turns
        chord.block = blockChord(ball, toCenter, ray.direction, medium.y);
        chord.perHalf = 0.25 * chord.block.perPlane;
        chord.w = 1.0 / chord.perHalf;
        chord.tc = chord.block.start + chord.w;
        chord.across = chord.tc * ray.direction - toCenter;
        chord.depth = tileWeight * weightOfEntry(entry) * medium.x * chord.block.depth;
    }
#endif
    return chord;
}

Chord chordOfTile(SlabRay ray, int i) { return chordOf(ray, entryOfTile(i)); }

// Where on a chord a ray parameter lies, in units of half the chord.
float placeOn(Chord chord, float t)
{
    return clamp((t - chord.tc) * chord.perHalf, -1.0, 1.0);
}

// Share of the depth of a chord up to a ray parameter.
float passedAt(Chord chord, float t)
{
    float passed = fxKernelPassed(placeOn(chord, t));
#if FX_BLOCKS
    passed = chord.isBlock ? blockPassed(chord.block, t).x : passed;
#endif
    return passed;
}

// Interval of a card along the ray, of a length > 0; none of it is behind what hides, nor outside of a range that is drawn alone.
vec2 intervalOf(SlabRay ray, vec4 body)
{
    vec2 drawn = rayDirection.w > 0.5 ? ray.drawn : vec2(-1e30, 1e30);
    float back = min(min(body.x + 0.5 * body.z, max(ray.t1, body.x)), drawn.y);
    float front = max(min(max(body.x - 0.5 * body.z, ray.t0), body.x), drawn.x);
    return vec2(front, max(back, front + 1e-6 * max(abs(front), 1e-6)));
}

// From the first thing on the ray to the end of the last.
vec2 rangeOf(SlabRay ray)
{
    vec2 range = vec2(1e30, -1e30);
    for (int i = 0; i < tileList.y; ++i) {
        Chord chord = chordOfTile(ray, i);
        float front = max(chord.tc - chord.w, ray.t0);
        float back = min(chord.tc + chord.w, ray.t1);
        bool isMet = chord.depth > 0.0 && front < back;
        range.x = isMet ? min(range.x, front) : range.x;
        range.y = isMet ? max(range.y, back) : range.y;
#if FX_BLOCKS
        vec4 scatter = texelFetch(balls, ballTexel(ballOfEntry(entryOfTile(i)), kScatter), 0);
        float depth = chord.isBlock && isMet ? chord.depth : 0.0;
        blockScatter += depth * vec4(scatter.rgb, 1.0);
        blockPhase += depth * scatter.w;
#endif
    }
#if FX_BLOCKS
    blockScatter.rgb /= max(blockScatter.w, 1e-20);
    blockPhase /= max(blockScatter.w, 1e-20);
#endif
    for (uint card = ray.cards; card != 0u; card = floatBitsToUint(cardNodes[card - 1u].body.w)) {
        vec2 interval = intervalOf(ray, cardNodes[card - 1u].body);
        range = vec2(min(range.x, interval.x), max(range.y, interval.y));
    }
    return range;
}

// Optical depth up to places on the ray. Cards that hide nothing count a little, so that their light can be divided too.
void passedUpTo(SlabRay ray, float places[6], out float passed[6])
{
    const float kOfLight = 1e-3; // [1] at most
    for (int k = 0; k < 6; ++k)
        passed[k] = 0.0;
    int turns = isCut(ray) ? tileList.y : 0;
    for (int i = 0; i < turns; ++i) {
        Chord chord = chordOfTile(ray, i);
#define FX_ADD_PASSED(k) passed[k] += chord.depth * passedAt(chord, places[k]);
        FX_EACH_6(FX_ADD_PASSED)
    }
    for (uint card = isCut(ray) ? ray.cards : 0u; card != 0u; card = floatBitsToUint(cardNodes[card - 1u].body.w)) {
        vec4 body = cardNodes[card - 1u].body;
        vec2 interval = intervalOf(ray, body);
        float weight = body.y > 0.0 ? body.y : kOfLight * min(dot(cardNodes[card - 1u].light.rgb, vec3(1.0)), 1.0);
#define FX_ADD_CARD_PASSED(k) passed[k] += weight * clamp((places[k] - interval.x) / (interval.y - interval.x), 0.0, 1.0);
        FX_EACH_6(FX_ADD_CARD_PASSED)
    }
}

// Optical depth from `start` to the ends of kBins bins of a range.
void passedIn(SlabRay ray, float start, vec2 range, out float passed[kBins + 1])
{
    float width = (range.y - range.x) / float(kBins);
    for (int k = 0; k <= kBins; ++k)
        passed[k] = 0.0;
    for (int i = 0; i < tileList.y; ++i) {
        Chord chord = chordOfTile(ray, i);
        float begin = passedAt(chord, start);
#define FX_ADD_BIN(k) passed[k] += chord.depth * (passedAt(chord, range.x + float(k) * width) - begin);
        FX_EACH_8(FX_ADD_BIN)
        FX_ADD_BIN(kBins)
    }
    for (uint card = ray.cards; card != 0u; card = floatBitsToUint(cardNodes[card - 1u].body.w)) {
        vec4 body = cardNodes[card - 1u].body;
        vec2 interval = intervalOf(ray, body);
        float perLength = 1.0 / (interval.y - interval.x);
#define FX_ADD_CARD_BIN(k) passed[k] += body.y * clamp((range.x + float(k) * width - interval.x) * perLength, 0.0, 1.0);
        FX_EACH_8(FX_ADD_CARD_BIN)
        FX_ADD_CARD_BIN(kBins)
    }
}

// Part of a bin up to which a depth is passed, as if its medium were even, or as at the rim of a ball.
float shareOfBin(float depth, float ofBin, bool isRim)
{
    float share = clamp(depth / max(ofBin, 1e-6 * kMinDepth), 0.0, 1.0);
    return isRim ? pow(share, 0.333333333) : share;
}

// Narrows a range to the bins from that in which the depth passes kMinDepth to that in which it passes kMaxDepth, or behind which
// less than kMinDepth is left. Only the last time the ends lie within bins, so that they move evenly where bins jump, as
// they do when the ray begins to touch a ball far off.
// start: where the depth is counted from. whole: depth of the whole ray, found the first time. passed: as of passedIn
vec2 narrowed(SlabRay ray, float start, vec2 range, bool isLast, inout float whole, out float passed[kBins + 1])
{
    passedIn(ray, start, range, passed);
    whole = isLast ? whole : passed[kBins];
    float least = min(kMinDepth, kMinShare * whole);
    float width = (range.y - range.x) / float(kBins);
    vec2 narrow = range;
    for (int k = 0; k < kBins; ++k) {
        float share = isLast ? shareOfBin(least - passed[k], passed[k + 1] - passed[k], k == 0) : 0.0;
        narrow.x = passed[k] <= least ? range.x + (float(k) + share) * width : narrow.x;
    }
    for (int k = kBins - 1; k >= 0; --k) {
        float ofBin = passed[k + 1] - passed[k], left = whole - passed[k + 1];
        float most = isLast ? shareOfBin(kMaxDepth - passed[k], ofBin, k == 0) : 1.0;
        float rest = isLast ? 1.0 - shareOfBin(least - left, ofBin, k == kBins - 1) : 1.0;
        narrow.y = passed[k + 1] >= kMaxDepth ? range.x + (float(k) + most) * width : narrow.y;
        narrow.y = left <= least ? min(narrow.y, range.x + (float(k) + rest) * width) : narrow.y;
    }
    return narrow;
}

// The part of a range of things that matters, see kMinDepth and kMaxDepth, and how much of what is seen lies where in it.
struct SlabWindow
{
    vec2 ends;               // [m]
    float depth;             // [1] of all of the range
    float places[kBins + 1]; // [m] from end to end
    float seen[kBins + 1];   // [1] up to these places, 0 to 1
};

SlabWindow windowOf(SlabRay ray, vec2 range)
{
    SlabWindow window;
    window.depth = 0.0;
    float passed[kBins + 1];
    vec2 bins = narrowed(ray, range.x, range, false, window.depth, passed);
    window.ends = narrowed(ray, range.x, bins, true, window.depth, passed);
    float width = (bins.y - bins.x) / float(kBins);
    float perLength = kEvenly / max(window.ends.y - window.ends.x, 1e-20);
    float seen[kBins];
    float sum = 0.0;
    window.places[0] = window.ends.x;
    for (int k = 0; k < kBins; ++k) {
        window.places[k + 1] = clamp(bins.x + float(k + 1) * width, window.ends.x, window.ends.y);
        float share = (window.places[k + 1] - window.places[k]) / max(width, 1e-20);
        seen[k] = share * max(exp(-kSeenDecay * passed[k]) - exp(-kSeenDecay * passed[k + 1]), 0.0);
        sum += seen[k];
    }
    window.places[kBins] = window.ends.y;
    window.seen[0] = 0.0;
    for (int k = 0; k < kBins; ++k)
        window.seen[k + 1] = window.seen[k] + (1.0 - kEvenly) * seen[k] / max(sum, 1e-20) +
                             perLength * (window.places[k + 1] - window.places[k]);
    return window;
}

// The place up to which a share of what is seen lies.
float placeAt(SlabWindow window, float share)
{
    float place = window.ends.x;
    for (int k = 0; k < kBins; ++k)
        place += clamp((share - window.seen[k]) / max(window.seen[k + 1] - window.seen[k], 1e-6), 0.0, 1.0) *
                 (window.places[k + 1] - window.places[k]);
    return place;
}

// Number of the slab in which a place of the window lies. slabs: how many there are
float slabAt(SlabWindow window, float place, float slabs)
{
    float share = 0.0;
    for (int k = 0; k < kBins; ++k)
        share += clamp((place - window.places[k]) / max(window.places[k + 1] - window.places[k], 1e-20), 0.0, 1.0) *
                 (window.seen[k + 1] - window.seen[k]);
    return min(floor(share * slabs), slabs - 1.0);
}
