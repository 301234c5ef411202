#include "formulas/tone_curve.fx.h"
#include "formulas/display_codes.fx.h"
#include "frame/display_block.glsl"

// Codes of a display to the exposed radiance that is shown as these codes.
layout(binding = 0) uniform sampler2D picture;
layout(location = 0) out vec4 color;

float lightOf(float code)
{
    float v = code > 0.0 ? min(code, 1.0) : 0.0; // NaN becomes black
    float y = display.z == 1.0 ? fxSrgbDecode(v) : display.z == 2.0 ? fxGammaDecode(v) : v;
    return fxToneCurveInverse(y, display.x);
}

void main()
{
    vec4 code = texelFetch(picture, ivec2(gl_FragCoord.xy), 0);
    color = vec4(lightOf(code.r), lightOf(code.g), lightOf(code.b), code.a > 0.0 ? code.a : 0.0);
}
