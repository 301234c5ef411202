#include "shared/view_block.glsl"
#include "field/field_blocks.glsl"
#if FX_DETAIL
#include "field/field_detail.glsl"
#endif
#include "field/field_sample.glsl"

// Light of the sum of all fields along one ray, from the eye on. Between two samples extinction is linear in the distance and
// the source, light over extinction, linear in optical depth: light = T (S0 near + S1 far), with d the optical depth between
// them, a = exp(-d), far = (1 - a (1 + d)) / d and near = 1 - a - far, so that equal sources give S (1 - a) exactly. Only the
// part of the ray between pass.y and pass.z [m] is drawn. FX_LAYERS 1 writes the light sorted by layer.
layout(binding = 0) uniform sampler2D sceneDistance; // [m] along the ray to the opaque surface, +inf for none
flat in uvec2 tileRange;

#if FX_LAYERS
#include "shared/layer_outputs.glsl"
#else
layout(location = 0) out vec4 light;
#endif

const int kMostSteps = 4096;
const float kOpaque = 1e-4; // transmittance behind which nothing is looked up

const float kThin = 0.02; // optical depth

// Share of a source at the far end of a step of optical depth d, a = exp(-d).
float farWeight(float d, float a)
{
    float thin = d * (0.5 - d * (0.333333333 - d * 0.125));
    return d < 0.05 ? thin : (1.0 - a * (1.0 + d)) / max(d, 0.05);
}

void main()
{
    vec3 origin, direction;
    float lengthPerDepth;
    viewRay(gl_FragCoord.xy, origin, direction, lengthPerDepth);
    float t = max(rayOriginX.w * lengthPerDepth, pass.y);
    float pixel = 1.0 / (lengthPerDepth * sunDirection.w);
    float end = min(texelFetch(sceneDistance, ivec2(gl_FragCoord.xy), 0).r, pass.z);
    FieldSample before = sampleFields(origin, direction, t, tileRange, pixel);
    float transmittance = 1.0;
#if FX_LAYERS
    vec3 fire = vec3(0.0), smoke = vec3(0.0), dust = vec3(0.0), covered = vec3(0.0);
    float moment = 0.0, depthSum = 0.0;
    const float opaque = -1.0; // all of the optical depth counts
#else
    vec3 sum = vec3(0.0);
    const float opaque = kOpaque;
#endif
    for (int i = 0; i < kMostSteps && t < end && before.room < kNever && transmittance > opaque; ++i) {
        float next = min(t + before.room, end);
        FieldSample now = sampleFields(origin, direction, next, tileRange, pixel);
        float d = before.isEmpty ? 0.0 : 0.5 * (before.medium.a + now.medium.a) * (next - t);
        float a = exp(-d);
        float far = farWeight(d, a);
        float near = 1.0 - a - far;
        // thin: both ends count alike, whatever their signs
        float thin = before.isEmpty ? 0.0 : 0.5 * (next - t) * (1.0 - d * (0.5 - d * 0.166666667));
        // thick: where one end has no medium, its source is that of the other
        const float kShare = 1e-4;
        float extinctionBefore = max(before.medium.a, 0.0), extinctionNow = max(now.medium.a, 0.0);
        float perBefore = near / max(extinctionBefore + kShare * extinctionNow, 1e-30);
        float perNow = far / max(extinctionNow + kShare * extinctionBefore, 1e-30);
        bool isThin = d < kThin;
        float weightBefore = transmittance * (isThin ? thin : before.medium.a > 0.0 ? perBefore + kShare * perNow : 0.0);
        float weightNow = transmittance * (isThin ? thin : now.medium.a > 0.0 ? perNow + kShare * perBefore : 0.0);
#if FX_LAYERS
        vec3 emitted = weightBefore * before.medium.rgb + weightNow * now.medium.rgb;
        vec3 scattered = weightBefore * before.scattered + weightNow * now.scattered;
        vec4 shares = weightBefore * before.shares + weightNow * now.shares; // [1] of the opacity
        float seen = weightBefore * before.medium.a + weightNow * now.medium.a;
        float perSeen = seen > 1e-30 ? 1.0 / seen : 0.0;
        fire += emitted + scattered * (shares.z * perSeen);
        dust += scattered * (shares.w * perSeen);
        smoke += scattered * ((seen - shares.z - shares.w) * perSeen);
        covered += vec3(shares.x, seen - shares.x - shares.y, shares.y);
        moment += transmittance * (near * t + far * next);
        depthSum += d;
#else
        sum += weightBefore * before.medium.rgb + weightNow * now.medium.rgb;
#endif
        transmittance *= a;
        t = next;
        before = now;
    }
    float alpha = max(1.0 - transmittance, 0.0); // rims may be below 0, see voxel-kernel
#if FX_LAYERS
    fireLight = vec4(max(fire, vec3(0.0)), alpha);
    smokeLight = vec4(max(smoke, vec3(0.0)), alpha);
    dustLight = vec4(max(dust, vec3(0.0)), alpha);
    coverage = vec4(max(covered, vec3(0.0)), alpha);
    depthMoment = vec4(max(moment, 0.0), 0.0, 0.0, alpha);
    opticalDepthSum = vec4(max(depthSum, 0.0), 0.0, 0.0, 0.0);
#else
    light = vec4(max(sum, vec3(0.0)), alpha);
#endif
}
