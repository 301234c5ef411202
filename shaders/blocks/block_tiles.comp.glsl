#include "formulas/kernel_quantile.fx.h"

// Tiles of blocks: for each texel the optical depth of all balls along the parallel ray through it, up to eight planes across
// the block. The four textures of the atlas lie one above the other: depth up to planes 1 to 4; up to planes 5 to 8; depth times
// albedo; depth times emitted light over the brightest. A workgroup is 8 x 8 texels of a tile, and first finds the
// balls that any of them meets. Layouts are those of rendering/blocks/block_tile_pass.h.
layout(local_size_x = 8, local_size_y = 8) in;

struct Job
{
    ivec4 place; // xy [texel] corner; z first ball; w balls
    vec4 right;  // xyz axis of the tile in the space of the block; w [m] half the side
    vec4 up;     // xyz likewise; w [texel] side
    vec4 light;  // x [m2/cd] one over the brightest light
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

void main()
{
    Job job = jobs[counts.x + int(gl_WorkGroupID.z)];
    vec3 along = cross(job.up.xyz, job.right.xyz);
    float half_ = job.right.w;
    float texel = 2.0 * half_ / (job.up.w - 1.0); // [m]
    vec2 p = vec2(gl_GlobalInvocationID.xy) * texel - half_;
    vec2 middle = (vec2(gl_WorkGroupID.xy) * 8.0 + 3.5) * texel - half_;
    float reach = 3.5 * texel;
    vec4 before = vec4(0.0), behind = vec4(0.0); // depth up to planes
    vec3 albedo = vec3(0.0), light = vec3(0.0);
    const vec4 kPlanes = vec4(-0.75, -0.5, -0.25, 0.0), kLater = vec4(0.25, 0.5, 0.75, 1.0);
    for (int batch = 0; batch < job.place.w; batch += 64) {
        uint lane = gl_LocalInvocationIndex;
        if (lane < 2u)
            met[lane] = 0u;
        barrier();
        int mine = batch + int(lane);
        if (mine < job.place.w) {
            vec4 place = balls[job.place.z + mine].place;
            vec2 away = abs(vec2(dot(place.xyz, job.right.xyz), dot(place.xyz, job.up.xyz)) - middle);
            if (all(lessThan(away, vec2(max(place.w, texel) + reach))))
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
                vec2 d = p - vec2(dot(ball.place.xyz, job.right.xyz), dot(ball.place.xyz, job.up.xyz));
                float q2 = max(1.0 - dot(d, d) / (radius * radius), 0.0);
                float q = sqrt(q2);
                float depth = 1.11408460164327 * ball.medium.w / (radius * radius) * q2 * q2 * q; // kernel-optical-depth (3)
                float center = dot(ball.place.xyz, along);
                float perHalf = 1.0 / max(radius * q, 1e-6 * radius);
                vec4 near = clamp((half_ * kPlanes - center) * perHalf, -1.0, 1.0);
                vec4 far = clamp((half_ * kLater - center) * perHalf, -1.0, 1.0);
                before += depth * vec4(fxKernelPassed(near.x), fxKernelPassed(near.y), fxKernelPassed(near.z), fxKernelPassed(near.w));
                behind += depth * vec4(fxKernelPassed(far.x), fxKernelPassed(far.y), fxKernelPassed(far.z), fxKernelPassed(far.w));
                albedo += depth * ball.medium.rgb;
                light += depth * ball.light.rgb;
            }
        }
        barrier();
    }
    ivec2 to = job.place.xy + ivec2(gl_GlobalInvocationID.xy);
    const float kMost = 60000.0; // of half floats
    imageStore(atlas, to, min(before, kMost));
    imageStore(atlas, to + ivec2(0, counts.y), min(behind, kMost));
    imageStore(atlas, to + ivec2(0, 2 * counts.y), vec4(min(albedo, vec3(kMost)), 0.0));
    imageStore(atlas, to + ivec2(0, 3 * counts.y), vec4(min(light * job.light.x, vec3(kMost)), 0.0));
}
