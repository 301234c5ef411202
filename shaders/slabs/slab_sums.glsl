// What lies in one slab across a ray, and slabs put together front to back. Needs formulas/slab_light.fx.h. FX_LAYERS as in
// media.frag.glsl.
#if FX_LAYERS
#include "shared/layer_outputs.glsl"
const int kLayers = 3; // fire, smoke, dust
const float kLastDepth = 1e30; // the optical depth is that of the whole ray
#else
layout(location = 0) out vec4 light;
const int kLayers = 1;
const float kLastDepth = 9.2103; // [1] optical depth behind which nothing is seen: a transmittance of 1e-4
#endif

const float kThinSlab = 0.02; // [1] optical depth below which light is a polynomial: nothing is divided by it

struct SlabSums
{
    float depth;         // [1]
    float moment;        // [1] of the depth, from -1/2 to 1/2 of it
    vec3 light[kLayers]; // emitted, of each layer
    vec3 slope[kLayers]; // first moment of that
#if FX_LAYERS
    vec3 share;          // [1] depth of fire, smoke and dust
#endif
};

// What is seen of the slabs so far.
struct SlabPicture
{
    float passed;  // [1] optical depth of the whole ray
    float through; // [1] transmittance of what is drawn
    vec3 light[kLayers];
#if FX_LAYERS
    vec3 covered;    // [1] opacity of fire, smoke and dust
    float distances; // [m] weighted by opacity
    float depths;    // [1]
#endif
};

SlabSums emptySlab()
{
    SlabSums sums;
    sums.depth = sums.moment = 0.0;
    for (int l = 0; l < kLayers; ++l)
        sums.light[l] = sums.slope[l] = vec3(0.0);
#if FX_LAYERS
    sums.share = vec3(0.0);
#endif
    return sums;
}

SlabPicture emptyPicture()
{
    SlabPicture picture;
    picture.passed = 0.0;
    picture.through = 1.0;
    for (int l = 0; l < kLayers; ++l)
        picture.light[l] = vec3(0.0);
#if FX_LAYERS
    picture.covered = vec3(0.0);
    picture.distances = picture.depths = 0.0;
#endif
    return picture;
}

vec3 thinLight(float depth, vec3 light, float moment, vec3 slope)
{
    return vec3(fxSlabThinLight(depth, light.r, moment, slope.r), fxSlabThinLight(depth, light.g, moment, slope.g),
                fxSlabThinLight(depth, light.b, moment, slope.b));
}

#if FX_LAYERS
// What the slopes of all layers are multiplied by, so that the source of their sum is nowhere negative; one channel.
float slopeScale(float depth, float light, float moment, float slope)
{
    float perDepth = 1.0 / max(depth, 1e-12);
    float free = 12.0 * (slope - light * perDepth * moment) * perDepth;
    return free != 0.0 ? fxSlabSlope(depth, light, moment, slope) / free : 1.0;
}
#else
vec3 slopesOf(float depth, vec3 light, float moment, vec3 slope)
{
    return vec3(fxSlabSlope(depth, light.r, moment, slope.r), fxSlabSlope(depth, light.g, moment, slope.g),
                fxSlabSlope(depth, light.b, moment, slope.b));
}
#endif

// Share of what is passed between two faces that lies before a place.
float shareBetween(float near, float place, float far)
{
    return clamp((place - near) / max(far - near, 1e-20), 0.0, 1.0);
}

// Light of a part of a slab, which is a slab of a linear source too. slope: change of the source from face to face
vec3 thickPart(vec2 part, float depth, vec3 emitted, vec3 slope)
{
    float share = part.y - part.x;
    float ofPart = share * depth;
    vec3 light = share * (emitted + (0.5 * (part.x + part.y) - 0.5) * depth * slope);
    return vec3(fxSlabLight(ofPart, light.r, share * slope.r), fxSlabLight(ofPart, light.g, share * slope.g),
                fxSlabLight(ofPart, light.b, share * slope.b));
}

// The same of a thin slab with the light `whole`: the light of its parts is exactly the whole, whatever its first moment is.
vec3 thinPart(vec2 part, float depth, vec3 whole, vec3 moment)
{
    float before = part.x * depth;
    vec3 turned = 6.0 * (part.y * (1.0 - part.y) - part.x * (1.0 - part.x)) * clamp(moment, -abs(whole) / 6.0, abs(whole) / 6.0);
    return ((part.y - part.x) * whole - turned) * (1.0 + before * (1.0 + 0.5 * before));
}

// @param near, far [m] faces of the slab
// @param part shares of its optical depth between which it is drawn, 0 to 1
void putBehind(inout SlabPicture picture, SlabSums sums, float near, float far, vec2 part)
{
    float depth = sums.depth;
    float share = part.y - part.x;
    float opacity = fxSlabOpacity(share * depth);
#if FX_LAYERS
    vec3 lights = max(sums.light[0] + sums.light[1] + sums.light[2], vec3(0.0));
    vec3 slopes = sums.slope[0] + sums.slope[1] + sums.slope[2];
    vec3 scale = vec3(slopeScale(depth, lights.r, sums.moment, slopes.r), slopeScale(depth, lights.g, sums.moment, slopes.g),
                      slopeScale(depth, lights.b, sums.moment, slopes.b));
    bool isThin = depth < kThinSlab;
    float perDepth = 1.0 / max(depth, 1e-12);
    for (int l = 0; l < kLayers; ++l) {
        vec3 own = sums.light[l];
        vec3 thin = thinLight(depth, own, sums.moment, sums.slope[l]);
        vec3 slope = scale * 12.0 * (sums.slope[l] - own * (perDepth * sums.moment)) * perDepth;
        picture.light[l] += picture.through * (isThin ? thinPart(part, depth, thin, sums.slope[l]) : thickPart(part, depth, own, slope));
    }
    float ofPart = share * depth;
    float opacityPerDepth = isThin ? share * (1.0 - ofPart * (0.5 - ofPart * 0.166666667)) : opacity * perDepth;
    picture.covered += picture.through * opacityPerDepth * sums.share;
    float middle = 0.5 * (near + far) + (far - near) * clamp(sums.moment * perDepth, -0.5, 0.5);
    middle += (0.5 * (part.x + part.y) - 0.5) * (far - near);
    picture.distances += picture.through * (opacity * middle + share * (far - near) * fxSlabSlopeWeight(ofPart));
    picture.depths += ofPart;
#else
    vec3 own = sums.light[0], slope = sums.slope[0];
    vec3 emitted = max(own, vec3(0.0));
    vec3 thin = thinPart(part, depth, thinLight(depth, own, sums.moment, slope), slope);
    vec3 thick = thickPart(part, depth, emitted, slopesOf(depth, emitted, sums.moment, slope));
    picture.light[0] += picture.through * (depth < kThinSlab ? thin : thick);
#endif
    picture.passed += depth;
    picture.through *= 1.0 - opacity;
}

// What hides by its optical depth and is not seen.
void hide(inout SlabPicture picture, float depth)
{
    picture.through *= exp(-depth);
#if FX_LAYERS
    picture.depths += depth;
#endif
}

// To the targets of the media pass.
void writePicture(SlabPicture picture)
{
    float alpha = max(1.0 - picture.through, 0.0); // rims of fields may be below 0, see voxel-kernel
#if FX_LAYERS
    // a layer below 0 takes from the others, so that their sum is that of all media
    vec3 lights[kLayers] = vec3[kLayers](max(picture.light[0], vec3(0.0)), max(picture.light[1], vec3(0.0)), max(picture.light[2], vec3(0.0)));
    vec3 all = max(picture.light[0] + picture.light[1] + picture.light[2], vec3(0.0));
    vec3 scale = all / max(lights[0] + lights[1] + lights[2], vec3(1e-30));
    fireLight = vec4(scale * lights[0], alpha);
    smokeLight = vec4(scale * lights[1], alpha);
    dustLight = vec4(scale * lights[2], alpha);
    coverage = vec4(max(picture.covered, vec3(0.0)), alpha);
    depthMoment = vec4(max(picture.distances, 0.0), 0.0, 0.0, alpha);
    opticalDepthSum = vec4(max(picture.depths, 0.0), 0.0, 0.0, 0.0);
#else
    light = vec4(max(picture.light[0], vec3(0.0)), alpha);
#endif
}
