#include "formulas/tone_curve.fx.h"

// Exposed radiance to sRGB code values. FX_DITHER 1 hides the steps of an 8-bit target.
layout(binding = 0) uniform sampler2D picture;
layout(std140, binding = 0) uniform ToneMapBlock
{
    vec4 toneMap; // x: radiance shown as 1
};
layout(location = 0) out vec4 color;

float usable(float radiance)
{
    return radiance > 0.0 ? min(radiance, toneMap.x) : 0.0; // NaN becomes black
}

float encode(float radiance)
{
    return fxSrgbEncode(fxToneCurve(radiance, toneMap.x));
}

// Fixed pattern in [-1/2, 1/2) without low frequencies: the lattice of Roberts' R2 sequence.
float ditherPattern(uvec2 pixel)
{
    uint lattice = pixel.x * 0xC13FA9A9u + pixel.y * 0x91E10DA5u;
    return float(lattice >> 8) / 16777216.0 - 0.5;
}

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 radiance = texelFetch(picture, at, 0);
    vec3 light = vec3(usable(radiance.r), usable(radiance.g), usable(radiance.b));
    float mean = (light.r + light.g + light.b) / 3.0;
    light += fxFilmCrosstalk(max(max(light.r, light.g), light.b), toneMap.x) * (mean - light);
    color = vec4(encode(light.r), encode(light.g), encode(light.b), radiance.a);
#if FX_DITHER
    color.rgb += ditherPattern(uvec2(at)) * (0.99 / 255.0); // below half a step: exact code values stay
#endif
}
