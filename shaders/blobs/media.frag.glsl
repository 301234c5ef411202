#include "formulas/sphere_path.fx.h"
#include "formulas/kernel_optical_depth.fx.h"
#include "formulas/kernel_quantile.fx.h"
#include "formulas/detail_noise.fx.h"
#include "formulas/henyey_greenstein.fx.h"
#include "shared/view_block.glsl"
#include "shared/light_slices.glsl"
#include "shared/blob_chord.glsl"
#include "blobs/blob_ray.glsl"

// Light of one blob along one ray, premultiplied: opacity from the travelled optical depth, color from what it emits and
// from the lights, which are looked up at several points of the ray. FX_LAYERS 1 writes the same light sorted by layer
// instead of into one target.

flat in vec4 blobScatter;
flat in vec4 blobLight;
flat in vec4 blobSlope;
flat in vec4 blobShade;
flat in vec4 blobLit;
flat in vec4 blobEmission;
flat in mat3 blobDetailAxes;

#if FX_LAYERS
#include "shared/layer_outputs.glsl"
#else
layout(location = 0) out vec4 light;
#endif

const float kEvenShade = 0.25; // change of the optical depth towards the sun across a radius that is taken as even

// Point of the ray where it has passed a share of its optical depth [m, relative to the blob's center], for an even density on
// the part of the chord on which that spreads as far as the blob's own density does.
vec3 pointOfBlob(BlobRay ray, float passed)
{
#if FX_FORM == 2
    const float kSpread = 0.6546537; // sqrt(3 / 7)
#else
    const float kSpread = 1.0;
#endif
    return ray.across + mix(ray.front, ray.back, 0.5 + kSpread * (passed - 0.5)) * ray.direction;
}

// Mean share of the sun's light that reaches the ray through media, weighted by how much of each point is seen: Gauss quadrature
// in the opacity that has been passed, so that all points count whatever the optical depth. Where the depth towards the sun
// hardly changes across the blob it is not looked up.
float sunTransmittance(float seenDepth, BlobRay ray, vec3 seen)
{
    bool isDark = lights[0].color.r + lights[0].color.g + lights[0].color.b <= 0.0;
    int points = isDark || length(blobShade.xyz) < kEvenShade ? 0 : lightCounts.z;
    float even = exp(-max(blobShade.w + dot(blobShade.xyz, seen) / blobCenterRadius.w, 0.0));
    float opacity = 1.0 - exp(-seenDepth);
    float sum = points == 0 ? even : 0.0;
    for (int i = 0; i < points; ++i) { // software renderers skip a loop without turns, but no branch
        float node = 0.5, weight = 1.0;
        if (points == 2) {
            node = i == 0 ? 0.2113249 : 0.7886751;
            weight = 0.5;
        } else if (points == 3) {
            node = i == 0 ? 0.1127017 : i == 1 ? 0.5 : 0.8872983;
            weight = i == 1 ? 0.4444444 : 0.2777778;
        } else if (points == 4) {
            node = i == 0 ? 0.0694318 : i == 1 ? 0.3300095 : i == 2 ? 0.6699905 : 0.9305682;
            weight = i == 0 || i == 3 ? 0.1739274 : 0.3260726;
        }
        float passed = opacity < 1e-3 ? node : -log(1.0 - node * opacity) / seenDepth; // [1] of the optical depth
        sum += weight * exp(-sunDepth(blobLit.xyz + pointOfBlob(ray, passed)).x);
    }
    return sum * hostShadow(blobLit.xyz + seen);
}

vec3 scatteredAlong(BlobRay ray, float opticalDepth)
{
    bool isSmall = blobLit.w < 0.0; // a blob of a picture, lit in its center alone
    vec3 toEye = isSmall ? -normalize(blobLit.xyz) : -ray.direction;
    float phase = fxHenyeyGreenstein(-dot(lights[0].place.xyz, toEye), blobScatter.w);
    float seenDepth = opticalDepth * blobSlope.w;              // with what else lies in the blob
    vec3 seen = pointOfBlob(ray, 1.0 / (2.0 + seenDepth)); // where the light comes from in the mean
    if (isSmall)
        seen = vec3(0.0);
    vec3 smoothPart = blobLight.rgb * max(1.0 + dot(blobSlope.xyz, seen) / blobCenterRadius.w, 0.0);
    return smoothPart + lights[0].color.rgb * blobScatter.rgb * (phase * sunTransmittance(seenDepth, ray, seen));
}

#if FX_LAYERS
// [m] mean distance of what is seen of the blob: Gauss quadrature in the opacity that has been passed.
float seenDistance(BlobRay ray, float opticalDepth)
{
    const vec4 nodes = vec4(0.0694318, 0.3300095, 0.6699905, 0.9305682);
    const vec4 weights = vec4(0.1739274, 0.3260726, 0.3260726, 0.1739274);
    float opacity = 1.0 - exp(-opticalDepth);
    float perHalf = 1.0 / max(ray.halfChord, 1e-20);
    float before = fxKernelPassed(clamp(ray.front * perHalf, -1.0, 1.0));
    float behind = fxKernelPassed(clamp(ray.back * perHalf, -1.0, 1.0));
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        float passed = opacity < 1e-3 ? nodes[i] : -log(1.0 - nodes[i] * opacity) / opticalDepth;
#if FX_FORM == 2
        sum += weights[i] * ray.halfChord * fxKernelQuantile(mix(before, behind, passed));
#else
        sum += weights[i] * mix(ray.front, ray.back, passed);
#endif
    }
    return ray.distance - dot(ray.toPoint, ray.direction) + (FX_FORM == 0 ? 0.0 : sum);
}
#endif

void main()
{
    BlobRay ray = traceBlob();
    if (!(ray.opticalDepth > 0.0))
        discard;

    float opticalDepth = ray.opticalDepth;
    vec3 emitted = blobEmission.rgb;
#if FX_DETAIL
    float amount = blobMedium.z * forward.w;
    if (amount > 0.0) {
        vec3 relative = ray.toDetail / blobCenterRadius.w;
        vec3 p = blobDetailAxes * relative + blobMedium.w * vec3(61.3, 37.7, 83.1);
        float n = fxDetailNoise(p.x, p.y, p.z);
        opticalDepth *= max(1.0 + amount * (2.2 * n - 0.25), 0.0);
        emitted *= exp2(blobEmission.w * amount * 0.3 * n);
    }
#endif
    float alpha = 1.0 - exp(-opticalDepth);
    vec3 scattered = vec3(0.0);
    if (blobScatter.r + blobScatter.g + blobScatter.b > 0.0 && alpha > 0.0)
        scattered = scatteredAlong(ray, max(opticalDepth, 1e-6));

#if FX_LAYERS
    float layer = floor(blobLight.w * 0.5);
    float share = layer < 0.5 ? 1.0 : blobLight.w - 2.0 * layer;
    vec3 ofLayer = vec3(layer < 0.5, layer > 0.5 && layer < 1.5, layer > 1.5);
    vec3 part = share * vec3(1.0, 0.0, 0.0) + (1.0 - share) * ofLayer;
    vec3 scatteredPart = alpha * scattered;
    fireLight = vec4(alpha * emitted + ofLayer.x * scatteredPart, alpha);
    smokeLight = vec4(ofLayer.y * scatteredPart, alpha);
    dustLight = vec4(ofLayer.z * scatteredPart, alpha);
    coverage = vec4(alpha * part, alpha);
    depthMoment = vec4(alpha * seenDistance(ray, opticalDepth), 0.0, 0.0, alpha);
    opticalDepthSum = vec4(opticalDepth, 0.0, 0.0, 0.0);
#else
    light = vec4(alpha * (emitted + scattered), alpha);
#endif
}
