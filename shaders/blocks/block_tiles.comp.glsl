#include "formulas/kernel_quantile.fx.h"

// Tiles of blocks: for each texel the optical depth of all balls along the ray from the eye through it, up to eight planes across
// the block. Texels lie in the plane through its center. The four textures of the atlas lie one above the other: depth up to planes
// 1 to 4; up to planes 5 to 8; depth times the albedo that the eye sees; depth times the emitted light that the eye sees over the
// brightest. What the eye sees is weighted by what is before it in the block. A workgroup is 8 x 8 texels of a tile, and first finds
// the balls that any of them meets. Layouts are those of rendering/blocks/block_tile_pass.h.
layout(local_size_x = 8, local_size_y = 8) in;

struct Job
{
    ivec4 place; // xy [texel] corner; z first ball; w balls
    vec4 right;  // xyz axis of the tile in the space of the block; w [m] half the side
    vec4 up;     // xyz likewise; w [texel] side
    vec4 light;  // x [m2/cd] one over the brightest light; y 1: balls differ in color; z [1] factor of the depth, for what is before
    vec4 eye;    // x [1/m] one over its distance, 0: rays are parallel; y [m] radius of the block
};
struct Ball
{
    vec4 place;  // xyz [m] center; w radius [m]
    vec4 medium; // rgb albedo; w cross section [m2]
    vec4 light;  // rgb emitted light [cd/m2]
};
layout(std430, binding = 0) readonly buffer Jobs { Job jobs[]; };
layout(std430, binding = 1) readonly buffer Balls { Ball balls[]; };
layout(rgba16f, binding = 0) uniform writeonly image2D atlas;
layout(std140, binding = 0) uniform TileBlock { ivec4 counts; }; // x first job; y rows of texels of each texture

shared uint met[2]; // one bit a ball of the batch of 64

// Depth of a texel of which linear interpolation has the least mean square error: f - texel^2 / 12 times its Laplacian, where f is
// kernel-optical-depth (3). Interpolation of f itself makes what is convex denser.
// q2: 1 - (distance / radius)^2; texel2: square of a texel over the radius
float depthForInterpolation(float q2, float texel2)
{
    float q = sqrt(q2);
    return q2 * q2 * q - min(texel2, 0.5) / 12.0 * q * (15.0 - 25.0 * q2);
}

// What of the light between two depths reaches the eye.
float seenOf(float before, float behind)
{
    float depth = behind - before;
    return depth > 1e-3 ? (exp(-before) - exp(-behind)) / depth : exp(-before);
}

void main()
{
    Job job = jobs[counts.x + int(gl_WorkGroupID.z)];
    vec3 along = cross(job.up.xyz, job.right.xyz);
    float half_ = job.right.w, perDistance = job.eye.x;
    float texel = 2.0 * half_ / (job.up.w - 1.0); // [m]
    vec2 p = vec2(gl_GlobalInvocationID.xy) * texel - half_;
    vec2 middle = (vec2(gl_WorkGroupID.xy) * 8.0 + 3.5) * texel - half_;
    float reach = 3.5 * texel;
    vec3 direction = normalize(vec3(p * perDistance, 1.0)); // of the ray, along right, up and along
    vec4 before = vec4(0.0), behind = vec4(0.0); // depth up to planes
    // Colored content needs twice the planes: those in the middle between two.
    vec4 beforeMiddle = vec4(0.0), behindMiddle = vec4(0.0); // depth up to the middle before each plane
    vec4 seen0 = vec4(1.0), seen1 = vec4(1.0), seen2 = vec4(1.0), seen3 = vec4(1.0); // of the first and second half before each plane
    vec3 albedo = vec3(0.0), light = vec3(0.0);
    float seen = 0.0;
    const vec4 kPlanes = vec4(-0.75, -0.5, -0.25, 0.0), kLater = vec4(0.25, 0.5, 0.75, 1.0);
    vec4 planes = job.eye.y / direction.z * kPlanes, later = job.eye.y / direction.z * kLater; // [m] along the ray
    float apart = 0.125 * job.eye.y / direction.z;
    int turns = job.light.y > 0.5 ? 2 : 1; // the second one needs what is before each ball
    for (int turn = 0; turn < turns; ++turn) {
        for (int batch = 0; batch < job.place.w; batch += 64) {
            uint lane = gl_LocalInvocationIndex;
            if (lane < 2u)
                met[lane] = 0u;
            barrier();
            int mine = batch + int(lane);
            if (mine < job.place.w) {
                vec4 place = balls[job.place.z + mine].place;
                vec2 side = vec2(dot(place.xyz, job.right.xyz), dot(place.xyz, job.up.xyz));
                float depth = dot(place.xyz, along), radius = max(place.w, texel);
                vec2 seenAt = side / max(1.0 + depth * perDistance, 0.1);
                float size = radius * sqrt(1.0 + dot(seenAt, seenAt) * perDistance * perDistance) /
                             max(1.0 + (depth - radius) * perDistance, 0.1);
                if (all(lessThan(abs(seenAt - middle), vec2(size + reach))))
                    atomicOr(met[lane >> 5], 1u << (lane & 31u));
            }
            barrier();
            for (int word = 0; word < 2; ++word) {
                uint bits = met[word];
                while (bits != 0u) {
                    int bit = findLSB(bits);
                    bits &= bits - 1u;
                    Ball ball = balls[job.place.z + batch + 32 * word + bit];
                    float radius = max(ball.place.w, texel); // a large texel must not lose small balls
                    vec3 away = vec3(dot(ball.place.xyz, job.right.xyz), dot(ball.place.xyz, job.up.xyz),
                                     dot(ball.place.xyz, along)) - vec3(p, 0.0);
                    float center = dot(away, direction);
                    float spacing = texel * max(1.0 + away.z * perDistance, 0.1) / radius;
                    away -= center * direction;
                    float q2 = max(1.0 - dot(away, away) / (radius * radius), 0.0);
                    float q = sqrt(q2);
                    float whole = 1.11408460164327 * ball.medium.w / (radius * radius);
                    float perHalf = 1.0 / max(radius * q, 1e-6 * radius);
                    vec4 near = clamp((planes - center) * perHalf, -1.0, 1.0);
                    vec4 far = clamp((later - center) * perHalf, -1.0, 1.0);
                    near = vec4(fxKernelPassed(near.x), fxKernelPassed(near.y), fxKernelPassed(near.z), fxKernelPassed(near.w));
                    far = vec4(fxKernelPassed(far.x), fxKernelPassed(far.y), fxKernelPassed(far.z), fxKernelPassed(far.w));
                    vec4 nearMiddle = vec4(0.0), farMiddle = vec4(0.0);
                    if (turns == 2) {
                        nearMiddle = clamp((planes - apart - center) * perHalf, -1.0, 1.0);
                        farMiddle = clamp((later - apart - center) * perHalf, -1.0, 1.0);
                        nearMiddle = vec4(fxKernelPassed(nearMiddle.x), fxKernelPassed(nearMiddle.y), fxKernelPassed(nearMiddle.z), fxKernelPassed(nearMiddle.w));
                        farMiddle = vec4(fxKernelPassed(farMiddle.x), fxKernelPassed(farMiddle.y), fxKernelPassed(farMiddle.z), fxKernelPassed(farMiddle.w));
                    }
                    if (turn == 0) {
                        float depth = whole * depthForInterpolation(q2, spacing * spacing);
                        before += depth * near;
                        behind += depth * far;
                        beforeMiddle += depth * nearMiddle;
                        behindMiddle += depth * farMiddle;
                    } else {
                        float depth = whole * q2 * q2 * q *
                                      (dot(nearMiddle - vec4(0.0, near.xyz), seen0) + dot(near - nearMiddle, seen1) +
                                       dot(farMiddle - vec4(near.w, far.xyz), seen2) + dot(far - farMiddle, seen3));
                        seen += depth;
                        albedo += depth * ball.medium.rgb;
                        light += depth * ball.light.rgb;
                    }
                }
            }
            barrier();
        }
        vec4 d = job.light.z * max(before, 0.0), e = job.light.z * max(behind, 0.0);
        vec4 dm = job.light.z * max(beforeMiddle, 0.0), em = job.light.z * max(behindMiddle, 0.0);
        seen0 = vec4(seenOf(0.0, dm.x), seenOf(d.x, dm.y), seenOf(d.y, dm.z), seenOf(d.z, dm.w));
        seen1 = vec4(seenOf(dm.x, d.x), seenOf(dm.y, d.y), seenOf(dm.z, d.z), seenOf(dm.w, d.w));
        seen2 = vec4(seenOf(d.w, em.x), seenOf(e.x, em.y), seenOf(e.y, em.z), seenOf(e.z, em.w));
        seen3 = vec4(seenOf(em.x, e.x), seenOf(em.y, e.y), seenOf(em.z, e.z), seenOf(em.w, e.w));
    }
    float perSeen = behind.w / max(seen, 1e-20);
    ivec2 to = job.place.xy + ivec2(gl_GlobalInvocationID.xy);
    const float kMost = 60000.0; // of half floats
    imageStore(atlas, to, min(before, kMost));
    imageStore(atlas, to + ivec2(0, counts.y), min(behind, kMost));
    imageStore(atlas, to + ivec2(0, 2 * counts.y), vec4(min(perSeen * albedo, vec3(kMost)), 0.0));
    imageStore(atlas, to + ivec2(0, 3 * counts.y), vec4(min(perSeen * light * job.light.x, vec3(kMost)), 0.0));
}
