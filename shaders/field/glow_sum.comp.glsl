#include "formulas/field_glow.fx.h"
#include "field/field_glow.glsl"

// Computes the mean over all directions of the radiance in each cell. FX_AGAIN 1: the rays carry the emitted light and the light of
// the first sum, scattered once. The result is then the logarithm of the light of all orders: formula field-glow (5).
layout(local_size_x = 8, local_size_y = 4, local_size_z = 2) in;
layout(binding = 0) uniform sampler3D rays; // see glow_rays.comp.glsl
#if FX_AGAIN
layout(binding = 4) uniform sampler3D glowLight;   // the first sum
layout(binding = 3) uniform sampler3D glowScatter; // rgb [1/m] extinction times albedo
layout(binding = 1) uniform sampler3D cells;       // a extinction [1/m]
const float kDarkest = 1e-6; // [exposed] as black
#endif
layout(rgba16f, binding = 0) uniform writeonly image3D light; // rgb mean radiance [exposed]; FX_AGAIN 1: its logarithm

void main()
{
    ivec3 id = ivec3(gl_GlobalInvocationID);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 27; ++i) {
        ivec3 d = glowDirection(i);
        int square = d.x * d.x + d.y * d.y + d.z * d.z;
        float weight = square == 1 ? 1.0 / 21.0 : square == 2 ? 4.0 / 105.0 : square == 3 ? 9.0 / 280.0 : 0.0;
        if (square > 0)
            sum += weight * texelFetch(rays, glowRayCorner(i) + id, 0).rgb;
    }
#if FX_AGAIN
    vec3 first = texelFetch(glowLight, id, 0).rgb;
    vec4 medium = texelFetch(cells, id, 0);
    vec3 albedo = texelFetch(glowScatter, id, 0).rgb / max(medium.a, 1e-20);
    sum = vec3(fxGlowOrders(first.r, sum.r, albedo.r), fxGlowOrders(first.g, sum.g, albedo.g), fxGlowOrders(first.b, sum.b, albedo.b));
    sum = log(clamp(sum, vec3(kDarkest), vec3(6e4)));
#endif
    imageStore(light, id, vec4(min(sum, vec3(6e4)), 0.0));
}
