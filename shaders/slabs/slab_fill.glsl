// Adds balls and cards to the sums of neighboring slabs of a ray, FX_GROUP (1, 3, 4, 6 or 16) at a time. Needs shared/unrolled.glsl,
// shared/light_slices.glsl, formulas/kernel_moment.fx.h, formulas/henyey_greenstein.fx.h, slabs/slab_sums.glsl and slabs/slab_window.glsl.
// FX_NETWORK 1: some balls are in illumination networks; needs formulas/network_cell.fx.h. FX_BALL_DETAIL 1: some balls have procedural detail.
// FX_FIELD_DETAIL 1: some belong to fields with detail; needs
// slabs/slab_detail.glsl.
const int kGroup = FX_GROUP;
#if FX_GROUP == 16
#define FX_EACH_OF_GROUP FX_EACH_16
#elif FX_GROUP == 6
#define FX_EACH_OF_GROUP FX_EACH_6
#elif FX_GROUP == 4
#define FX_EACH_OF_GROUP FX_EACH_4
#elif FX_GROUP == 3
#define FX_EACH_OF_GROUP FX_EACH_3
#else
#define FX_EACH_OF_GROUP(statement) statement(0)
#endif

// What a ball sends along a ray, where it is thin.
struct BallLight
{
    vec3 emitted;  // by itself
    vec3 smoothly; // scattered, in the middle of the chord
    float slope;   // [1/m] change of that along the ray, relative to `base`
    float base;    // [1]
    vec3 sun;      // scattered where nothing shadows the sun
#if FX_NETWORK
    vec3 straight; // [1] share of the optical depth that attenuates the sun: formula network-cell (5)
#endif
#if FX_BLOCKS
    bool isAlongRay; // what changes little is known along the ray, times `tint`
    vec3 tint;
#endif
};

BallLight lightOf(SlabRay ray, Chord chord, uint ball)
{
    vec4 scatter = texelFetch(balls, ballTexel(ball, kScatter), 0);
    vec3 slope = texelFetch(balls, ballTexel(ball, kSlope), 0).xyz;
    BallLight light;
    light.emitted = texelFetch(balls, ballTexel(ball, kEmitted), 0).rgb;
#if FX_NETWORK
    vec4 smoothly = texelFetch(balls, ballTexel(ball, kLight), 0);
    light.smoothly = smoothly.rgb;
    light.straight = 1.0 - smoothly.w * scatter.rgb * fxNetworkPeak(clamp(scatter.w, -0.3, 0.98));
#else
    light.smoothly = texelFetch(balls, ballTexel(ball, kLight), 0).rgb;
#endif
#if FX_BLOCKS
    bool isColored = chord.block.color.w > 0.5;
    light.smoothly *= isColored ? chord.block.color.rgb / max(scatter.rgb, vec3(1e-6)) : vec3(1.0);
    scatter.rgb = isColored ? chord.block.color.rgb : scatter.rgb;
    light.emitted = isColored ? chord.block.light : light.emitted;
    light.isAlongRay = chord.isBlock;
    light.tint = scatter.rgb / max(blockScatter.rgb, vec3(1e-6));
#endif
    light.base = 1.0 + dot(slope, chord.across);
    light.slope = dot(slope, ray.direction);
    float phase = fxHenyeyGreenstein(dot(lights[0].place.xyz, ray.direction), scatter.w);
    light.sun = lights[0].color.rgb * scatter.rgb * phase;
    return light;
}

void addTo(inout SlabSums sums, int layer, float depth, float moment, vec3 light)
{
    sums.light[layer] += depth * light;
    sums.slope[layer] += moment * light;
}

#if FX_LAYERS
// Opacity of each layer; emitted light is always fire's.
vec3 sharesOf(float layer)
{
    float number = floor(layer * 0.5);
    float fire = number < 0.5 ? 1.0 : layer - 2.0 * number;
    vec3 ofLayer = vec3(number < 0.5, number > 0.5 && number < 1.5, number > 1.5);
    return fire * vec3(1.0, 0.0, 0.0) + (1.0 - fire) * ofLayer;
}
#endif

void addBall(inout SlabSums sums, BallLight ball, float layers, float depth, float moment, vec3 scattered)
{
    sums.depth += depth;
    sums.moment += moment;
#if FX_LAYERS
    int layer = int(layers * 0.5);
    addTo(sums, 0, depth, moment, ball.emitted + (layer == 0 ? scattered : vec3(0.0)));
    addTo(sums, 1, depth, moment, layer == 1 ? scattered : vec3(0.0));
    addTo(sums, 2, depth, moment, layer == 2 ? scattered : vec3(0.0));
    sums.share += depth * sharesOf(layers);
#else
    addTo(sums, 0, depth, moment, ball.emitted + scattered);
#endif
}

// What of a card lies between two faces. light: rgb light of it, w layer; depth [1]; interval [m]
void addCard(inout SlabSums sums, vec4 light, float depth, vec2 interval, float near, float far)
{
    float from = clamp(near, interval.x, interval.y), to = clamp(far, interval.x, interval.y);
    float share = (to - from) / (interval.y - interval.x);
    float place = clamp(0.5 * (from + to - near - far) / max(far - near, 1e-20), -0.5, 0.5);
    sums.depth += share * depth;
    sums.moment += share * depth * place;
#if FX_LAYERS
    vec3 ofLayer = vec3(light.w < 0.5, light.w > 0.5 && light.w < 1.5, light.w > 1.5);
    for (int i = 0; i < kLayers; ++i)
        addTo(sums, i, share, share * place, ofLayer[i] * light.rgb);
    sums.share += share * depth * ofLayer;
#else
    addTo(sums, 0, share, share * place, light.rgb);
#endif
}

#if FX_NETWORK
#define FX_SUN vec2 // x optical depth, y share that the host's surfaces let through
FX_SUN sunAt(SlabRay ray, float t)
{
    vec2 sun = vec2(0.0, 1.0);
    bool isDark = tileList.y == 0 || lights[0].color.r + lights[0].color.g + lights[0].color.b <= 0.0;
    for (int i = 0; i < (isDark ? 0 : 1); ++i)
        sun = vec2(sunDepth(ray.origin + t * ray.direction).x, hostShadow(ray.origin + t * ray.direction));
    return sun;
}

// Share of the sun that balls scatter between two points of the ray.
vec3 sunBetween(BallLight light, FX_SUN near, FX_SUN far)
{
    return 0.5 * (near.y * exp(-near.x * light.straight) + far.y * exp(-far.x * light.straight));
}
#else
#define FX_SUN float
// Share of the sun that reaches a point of the ray.
FX_SUN sunAt(SlabRay ray, float t)
{
    float sum = 1.0;
    bool isDark = tileList.y == 0 || lights[0].color.r + lights[0].color.g + lights[0].color.b <= 0.0;
    for (int i = 0; i < (isDark ? 0 : 1); ++i) // software renderers skip a loop without turns
        sum = exp(-sunDepth(ray.origin + t * ray.direction).x) * hostShadow(ray.origin + t * ray.direction);
    return sum;
}

float sunBetween(BallLight light, FX_SUN near, FX_SUN far) { return 0.5 * (near + far); }
#endif

#if FX_BALL_DETAIL
// Turned by the seed so that no two balls share a lattice; as in blobs/media.vert.glsl.
mat3 detailAxes(float seed, float periods)
{
    float a = 6.2831853 * fract(seed * 7.31);
    float b = 6.2831853 * fract(seed * 23.17);
    mat3 aroundY = mat3(cos(a), 0.0, -sin(a), 0.0, 1.0, 0.0, sin(a), 0.0, cos(a));
    mat3 aroundX = mat3(1.0, 0.0, 0.0, 0.0, cos(b), sin(b), 0.0, -sin(b), cos(b));
    return periods * (aroundX * aroundY);
}

// One sample of the detail stands for the whole path, as where balls are drawn. medium: texel of the ball
void addDetail(SlabRay ray, uint ball, vec4 medium, inout Chord chord, inout BallLight light)
{
    vec2 detail = texelFetch(balls, ballTexel(ball, kDetail), 0).xy;
    float power = texelFetch(balls, ballTexel(ball, kEmitted), 0).w;
    float front = max(chord.tc - chord.w, ray.open.x); // the same for all ranges of depth
    float back = max(min(chord.tc + chord.w, ray.open.y), front);
    float share = passedAt(chord, back) - passedAt(chord, front);
    float seen = mix(front, back, 0.5 / (1.0 + 0.5 * chord.depth * share));
    vec3 relative = (chord.across + (seen - chord.tc) * ray.direction) / medium.y;
    vec3 p = detailAxes(detail.x, detail.y) * relative + detail.x * vec3(61.3, 37.7, 83.1);
    float n = medium.w > 0.0 ? fxDetailNoise(p.x, p.y, p.z) : 0.0;
    chord.depth *= medium.w > 0.0 ? max(1.0 + medium.w * (2.2 * n - 0.25), 0.0) : 1.0;
    light.emitted *= exp2(power * medium.w * 0.3 * n);
}
#endif

// Share of the depth of a chord up to a ray parameter, and its first moment in units of half the chord.
vec2 passedWithMoment(Chord chord, float t)
{
    float u = placeOn(chord, t);
    vec2 passed = vec2(fxKernelPassed(u), fxKernelMoment(u));
#if FX_BLOCKS
    passed = chord.isBlock ? blockPassed(chord.block, t) : passed;
#endif
    return passed;
}

// What of a ball lies between two faces.
struct BallPart
{
    float depth;    // [1]
    float moment;   // [1] from -1/2 to 1/2 of it
    vec3 scattered; // light, where it is thin
};

// sun: its light that is scattered there; smoothly: what changes little, where light.isAlongRay; passed: depth and moment up to the near face, over those of the chord, on return up to the far one
#if FX_BLOCKS
BallPart partOf(Chord chord, BallLight light, float near, float far, vec3 sun, vec3 smoothly, inout vec2 passed)
#else
BallPart partOf(Chord chord, BallLight light, float near, float far, vec3 sun, inout vec2 passed)
#endif
{
    float middle = 0.5 * (near + far);
    float perWidth = 1.0 / max(far - near, 1e-20); // some have no thickness
    vec2 next = passedWithMoment(chord, far);
    BallPart part;
    part.depth = chord.depth * max(next.x - passed.x, 0.0); // rounding may make it less, and then quotients of sums have no bounds
    part.moment = ((chord.tc - middle) * part.depth + chord.w * chord.depth * (next.y - passed.y)) * perWidth;
    part.moment = clamp(part.moment, -0.5 * part.depth, 0.5 * part.depth); // rounding in narrow slabs
    float along = clamp(middle - chord.tc, -chord.w, chord.w);
    part.scattered = light.smoothly * max(light.base + light.slope * along, 0.0);
#if FX_BLOCKS
    part.scattered = light.isAlongRay ? light.tint * smoothly : part.scattered;
#endif
    part.scattered += sun;
    passed = next;
    return part;
}

#if FX_FIELD_DETAIL
#include "slabs/slab_detail.glsl"
#endif

#if FX_BLOCKS
// A block is large: the light that changes little within a ball, see lights/blob_light.comp.glsl, is looked up along the ray.
vec3 smoothAt(SlabRay ray, float t)
{
    vec3 sum = vec3(0.0), p = ray.origin + t * ray.direction, toEye = -ray.direction;
    int turns = blockScatter.w > 0.0 ? 1 : 0; // software renderers skip a loop without turns
#if FX_NETWORK
    int network = networkAt(p, turns * int(pass.w));
    for (int i = 0; i < (network < 0 ? 0 : 1); ++i)
        sum = lightInNetwork(network, int(pass.z), p, toEye, blockScatter.rgb, blockPhase);
    turns = network < 0 ? turns : 0;
#endif
    for (int i = 0; i < turns; ++i)
        sum = smoothLight(p, toEye, blockScatter.rgb, blockPhase, sunDepth(p));
    return sum;
}
#define FX_SMOOTH(k) , 0.5 * (smoothly[k] + smoothly[k + 1])
#define FX_SMOOTH_PARAMETER vec3 smoothly[kGroup + 1],
#define FX_SMOOTH_ARGUMENT smoothly,
#else
#define FX_SMOOTH(k)
#define FX_SMOOTH_PARAMETER
#define FX_SMOOTH_ARGUMENT
#endif

// Adds a ball. edges, sun: at the faces of the slabs; end: of the range
#if FX_FIELD_DETAIL
void addEach(SlabRay ray, uint entry, vec4 carried0, float edges[kGroup + 1], FX_SUN sun[kGroup + 1], FX_SMOOTH_PARAMETER float end,
             inout DetailedSlab detailed[kGroup], inout SlabSums sums[kGroup], inout float behind)
#else
void addEach(SlabRay ray, uint entry, float edges[kGroup + 1], FX_SUN sun[kGroup + 1], FX_SMOOTH_PARAMETER float end, inout SlabSums sums[kGroup],
             inout float behind)
#endif
{
    uint ball = ballOfEntry(entry);
    vec4 medium = texelFetch(balls, ballTexel(ball, kMedium), 0);
    Chord chord = chordOf(ray, entry);
#if FX_FIELD_DETAIL
    bool isMet = chord.depth > 0.0 && chord.tc - chord.w < edges[kGroup] && chord.tc + chord.w > edges[0];
    if (!isMet) { // most balls are in few slabs
        behind += chord.depth * (passedAt(chord, end) - passedAt(chord, edges[kGroup]));
        return;
    }
    vec4 carried1 = texelFetch(balls, ballTexel(ball, kCarried1), 0);
    float power = texelFetch(balls, ballTexel(ball, kEmitted), 0).w;
#endif
    BallLight light = lightOf(ray, chord, ball);
#if FX_BALL_DETAIL
    addDetail(ray, ball, medium, chord, light);
#endif
    vec2 passed = passedWithMoment(chord, edges[0]);
#if FX_FIELD_DETAIL
#define FX_ADD_BALL(k)                                                                                              \
    part = partOf(chord, light, edges[k], edges[k + 1], light.sun * sunBetween(light, sun[k], sun[k + 1]) FX_SMOOTH(k), passed); \
    if (carried0.w > 0.5)                                                                                           \
        addDetailedBall(detailed[k], light, medium.z, part.depth, part.moment, part.scattered, carried0.xyz,        \
                        carried1, power);                                                                           \
    else                                                                                                            \
        addBall(sums[k], light, medium.z, part.depth, part.moment, part.scattered);
#else
#define FX_ADD_BALL(k)                                                                                              \
    part = partOf(chord, light, edges[k], edges[k + 1], light.sun * sunBetween(light, sun[k], sun[k + 1]) FX_SMOOTH(k), passed); \
    addBall(sums[k], light, medium.z, part.depth, part.moment, part.scattered);
#endif
    BallPart part;
    FX_EACH_OF_GROUP(FX_ADD_BALL)
    behind += chord.depth * (passedAt(chord, end) - passed.x);
}

// @param edges kGroup + 1, of the slabs [m], which do not fall; lit: interval [m] in which sunlight is looked up;
// behind: optical depth from the last edge to `end`
void addLoose(SlabRay ray, float edges[kGroup + 1], vec2 lit, float end, inout SlabSums sums[kGroup], out float behind)
{
    behind = 0.0;
    FX_SUN sun[kGroup + 1];
    for (int k = 0; k <= kGroup; ++k)
        sun[k] = sunAt(ray, clamp(edges[k], lit.x, lit.y));
#if FX_BLOCKS
    vec3 smoothly[kGroup + 1];
    for (int k = 0; k <= kGroup; ++k)
        smoothly[k] = smoothAt(ray, clamp(edges[k], lit.x, lit.y));
#endif
#if FX_FIELD_DETAIL
    // Balls of one field come one after the other. Software renderers run the loops within a branch that is not taken once, so
    // that what is done at the end of a field is not within the loop over balls.
    DetailedSlab detailed[kGroup];
    for (int k = 0; k < kGroup; ++k)
        detailed[k] = emptyDetailedSlab();
    for (int i = 0; i < tileList.y;) {
        float texel = texelFetch(balls, ballTexel(ballOfEntry(entryOfTile(i)), kCarried0), 0).w;
        for (; i < tileList.y; ++i) {
            uint entry = entryOfTile(i);
            vec4 carried0 = texelFetch(balls, ballTexel(ballOfEntry(entry), kCarried0), 0);
            if (carried0.w != texel)
                break;
            addEach(ray, entry, carried0, edges, sun, FX_SMOOTH_ARGUMENT end, detailed, sums, behind);
        }
        if (texel > 0.5)
            addEroded(ray, edges, int(texel) - 1, detailed, sums);
    }
#else
    for (int i = 0; i < tileList.y; ++i)
        addEach(ray, entryOfTile(i), edges, sun, FX_SMOOTH_ARGUMENT end, sums, behind);
#endif
    for (uint card = ray.cards; card != 0u; card = floatBitsToUint(cardNodes[card - 1u].body.w)) {
        vec4 light = cardNodes[card - 1u].light;
        vec4 body = cardNodes[card - 1u].body;
        vec2 interval = intervalOf(ray, body);
        float perLength = 1.0 / (interval.y - interval.x);
#define FX_ADD_CARD(k) addCard(sums[k], light, body.y, interval, edges[k], edges[k + 1]);
        FX_EACH_OF_GROUP(FX_ADD_CARD)
        behind += body.y * clamp((interval.y - edges[kGroup]) * perLength, 0.0, 1.0);
    }
}
