// Turns what the media pass accumulated into the layers that are handed out.
layout(binding = 0) uniform sampler2D fireSum;
layout(binding = 1) uniform sampler2D smokeSum;
layout(binding = 2) uniform sampler2D dustSum;
layout(binding = 3) uniform sampler2D coverageSum;
layout(binding = 4) uniform sampler2D depthSum;

layout(location = 0) out vec4 fire;
layout(location = 1) out vec4 smoke;
layout(location = 2) out vec4 dust;
layout(location = 3) out vec4 media;
layout(location = 4) out vec4 depth; // r [m]

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 c = texelFetch(coverageSum, p, 0);
    fire = vec4(texelFetch(fireSum, p, 0).rgb, c.r);
    smoke = vec4(texelFetch(smokeSum, p, 0).rgb, c.g);
    dust = vec4(texelFetch(dustSum, p, 0).rgb, c.b);
    media = vec4(fire.rgb + smoke.rgb + dust.rgb, c.a);
    depth = vec4(c.a > 0.0 ? texelFetch(depthSum, p, 0).r / c.a : uintBitsToFloat(0x7F800000u), 0.0, 0.0, 1.0);
}
