#if FX_DISPLAY
#include "formulas/tone_curve.fx.h"
#include "formulas/display_codes.fx.h"
#endif
#if FX_DISPLAY || FX_OFFSET
#include "frame/display_block.glsl"
#endif

// Media over what lies behind them.
layout(binding = 0) uniform sampler2D media; // premultiplied
#if FX_BLEND == 0
layout(binding = 1) uniform sampler2D behind;
#endif
layout(location = 0) out vec4 color;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
#if FX_OFFSET
    p -= place.xy;
#endif
    vec4 m = texelFetch(media, p, 0);
#if FX_DISPLAY
    // Of the effects alone: codes show already what the picture behind them went through. As in tone mapping, light
    // above white counts as white; glare gets it in the channel where it is.
    vec3 light = min(m.rgb, display.x);
    m.rgb += fxFilmCrosstalk(max(max(light.r, light.g), light.b), display.x) * ((light.r + light.g + light.b) / 3.0 - light);
#endif
#if FX_BLEND
    if (m == vec4(0.0))
        discard; // blending could change the bits of what no medium touches
    color = m;   // fixed-function blending puts it over the target
#else
    vec4 b = texelFetch(behind, p, 0);
#if FX_DISPLAY
    if (m == vec4(0.0)) {
        color = b; // bit for bit
        return;
    }
    float share = 1.0 - m.a;
    for (int i = 0; i < 3; ++i)
        color[i] = fxDisplayComposite(fxToneCurve(b[i], display.x), m[i], share, display.w, display.x);
    color.a = m.a + share * b.a;
#else
    color = vec4(m.rgb + (1.0 - m.a) * b.rgb, m.a + (1.0 - m.a) * b.a);
#endif
#endif
}
