// What the media pass accumulated in its layer targets. FX_OVER 1: as fragments of the media pass, which fixed-function
// blending puts over what the targets hold. FX_OVER 0: turned into the layers that are handed out.
layout(binding = 0) uniform sampler2D fireSum;
layout(binding = 1) uniform sampler2D smokeSum;
layout(binding = 2) uniform sampler2D dustSum;
layout(binding = 3) uniform sampler2D coverageSum; // a hides, in every target
layout(binding = 4) uniform sampler2D depthSum;

#if FX_OVER
layout(binding = 5) uniform sampler2D opticalDepths;

#include "shared/layer_outputs.glsl"
#else
layout(location = 0) out vec4 fire;
layout(location = 1) out vec4 smoke;
layout(location = 2) out vec4 dust;
layout(location = 3) out vec4 media;
layout(location = 4) out vec4 depth; // r [m]
#endif

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec3 fireColor = texelFetch(fireSum, p, 0).rgb;
    vec3 smokeColor = texelFetch(smokeSum, p, 0).rgb;
    vec3 dustColor = texelFetch(dustSum, p, 0).rgb;
    vec4 c = texelFetch(coverageSum, p, 0);
    float moment = texelFetch(depthSum, p, 0).r;
#if FX_OVER
    fireLight = vec4(fireColor, c.a);
    smokeLight = vec4(smokeColor, c.a);
    dustLight = vec4(dustColor, c.a);
    coverage = c;
    depthMoment = vec4(moment, 0.0, 0.0, c.a);
    opticalDepthSum = vec4(texelFetch(opticalDepths, p, 0).r, 0.0, 0.0, 0.0); // adds up
#else
    fire = vec4(fireColor, c.r);
    smoke = vec4(smokeColor, c.g);
    dust = vec4(dustColor, c.b);
    media = vec4(fireColor + smokeColor + dustColor, c.a);
    depth = vec4(c.a > 0.0 ? moment / c.a : uintBitsToFloat(0x7F800000u), 0.0, 0.0, 1.0);
#endif
}
