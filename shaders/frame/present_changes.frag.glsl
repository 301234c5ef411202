#include "formulas/tone_curve.fx.h"
#include "formulas/display_codes.fx.h"
#include "frame/display_block.glsl"

// The finished picture into the host's target. Pixels that no effect has changed keep their bits.
layout(binding = 0) uniform sampler2D picture;  // exposed radiance
layout(binding = 1) uniform sampler2D before;   // the same before any effect
layout(binding = 2) uniform sampler2D original; // what `before` was decoded from
layout(location = 0) out vec4 color;

bool isNan(float v)
{
    return (floatBitsToUint(v) & 0x7FFFFFFFu) > 0x7F800000u;
}

bool isEqual(float a, float b)
{
    return a == b || (isNan(a) && isNan(b));
}

float codeOf(float y, float encoding)
{
    return encoding == 1.0 ? fxSrgbEncode(y) : encoding == 2.0 ? fxGammaEncode(y) : y;
}

float shown(float radiance)
{
    float x = radiance > 0.0 ? min(radiance, display.x) : 0.0; // NaN becomes black
    return codeOf(fxToneCurve(x, display.x), display.y);
}

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy) - place.xy;
    vec4 now = texelFetch(picture, at, 0);
    vec4 was = texelFetch(before, at, 0);
    bool isSame = isEqual(now.r, was.r) && isEqual(now.g, was.g) && isEqual(now.b, was.b) && isEqual(now.a, was.a);
    if (isSame && place.z == 0)
        discard;
    if (isSame) {
        color = texelFetch(original, at, 0);
        if (display.z != display.y) // read as light from a format of the sRGB kind
            color.rgb = vec3(codeOf(color.r, display.y), codeOf(color.g, display.y), codeOf(color.b, display.y));
        return;
    }
    color = display.y == 0.0 ? now : vec4(shown(now.r), shown(now.g), shown(now.b), now.a);
}
