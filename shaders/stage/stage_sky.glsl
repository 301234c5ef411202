#include "formulas/lump_noise.fx.h"
#include "formulas/soil_texture.fx.h"
#include "formulas/wooded_horizon.fx.h"

// Distant hills and trees in front of them, both down to the ground. p: width of a pixel as a tangent
vec3 withHills(vec3 sky, vec3 d, float p)
{
    float level = max(length(d.xz), 1e-6);
    vec2 along = d.xz / level;
    float elevation = d.y / level;
    vec3 behind = mix(sky, farHills.rgb, fxShareBelow(fxFarHills(along.x, along.y, p), elevation, p));
    return mix(behind, nearTrees.rgb, fxShareBelow(fxNearTrees(along.x, along.y, p), elevation, p));
}

// Sky without a picture in the direction d, exposed.
vec3 skyAt(vec3 d, float p)
{
    vec3 sky = mix(background.rgb, horizon.rgb, pow(1.0 - max(d.y, 0.0), 4.0));
    return farHills.w > 0.5 ? withHills(sky, d, p) : sky;
}
