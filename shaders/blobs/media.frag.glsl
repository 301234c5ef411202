#include "formulas/sphere_path.fx.h"
#include "formulas/kernel_optical_depth.fx.h"
#include "formulas/detail_noise.fx.h"
#include "shared/view_block.glsl"
#include "shared/blob_chord.glsl"
#include "blobs/blob_ray.glsl"

// Light of one blob along one ray, premultiplied: opacity from the travelled optical depth, color from emission, sun
// and sky. FX_LAYERS 1 writes the same light sorted by layer instead of into one target.

flat in vec4 blobSun;
flat in vec4 blobSky;
flat in vec4 blobEmission;
flat in mat3 blobDetailAxes;

#if FX_LAYERS
#include "shared/layer_outputs.glsl"
#else
layout(location = 0) out vec4 light;
#endif

// Optical depth of the blob's own medium from `toPoint` (relative to its center) towards the sun.
float ownShadow(vec3 toPoint)
{
    float tc = -dot(toPoint, sunDirection.xyz);
    float h = length(toPoint + tc * sunDirection.xyz);
    return fxKernelOpticalDepth(blobMedium.x, blobCenterRadius.w, h, tc, 0.0, 1e30);
}

void main()
{
    BlobRay ray = traceBlob();
    if (!(ray.opticalDepth > 0.0))
        discard;

    float opticalDepth = ray.opticalDepth;
    vec3 emitted = blobEmission.rgb;
    vec3 relative = ray.toPoint / blobCenterRadius.w;
#if FX_DETAIL
    float amount = blobMedium.z * forward.w;
    if (amount > 0.0) {
        vec3 p = blobDetailAxes * relative + blobMedium.w * vec3(61.3, 37.7, 83.1);
        float n = fxDetailNoise(p.x, p.y, p.z);
        opticalDepth *= max(1.0 + amount * (2.2 * n - 0.25), 0.0);
        emitted *= exp2(blobEmission.w * amount * 0.3 * n);
    }
#endif
    float alpha = 1.0 - exp(-opticalDepth);
    vec3 scattered = blobSky.rgb * (0.75 + 0.25 * relative.y);
    if (blobSun.r + blobSun.g + blobSun.b > 0.0) {
        float shadow = ownShadow(ray.toPoint);
        scattered += blobSun.rgb * (0.7 * exp(-shadow) + 0.3 * exp(-0.25 * shadow)); // second term: light that has turned
    }

#if FX_LAYERS
    float layer = floor(blobSky.w * 0.5);
    float share = layer < 0.5 ? 1.0 : blobSky.w - 2.0 * layer;
    vec3 ofLayer = vec3(layer < 0.5, layer > 0.5 && layer < 1.5, layer > 1.5);
    vec3 part = share * vec3(1.0, 0.0, 0.0) + (1.0 - share) * ofLayer;
    vec3 scatteredPart = alpha * scattered;
    fireLight = vec4(alpha * emitted + ofLayer.x * scatteredPart, alpha);
    smokeLight = vec4(ofLayer.y * scatteredPart, alpha);
    dustLight = vec4(ofLayer.z * scatteredPart, alpha);
    coverage = vec4(alpha * part, alpha);
    depthMoment = vec4(alpha * ray.distance, 0.0, 0.0, alpha);
    opticalDepthSum = vec4(opticalDepth, 0.0, 0.0, 0.0);
#else
    light = vec4(alpha * (emitted + scattered), alpha);
#endif
}
