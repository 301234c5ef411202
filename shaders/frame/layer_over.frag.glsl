// Layer targets as fragments of the media pass: fixed-function blending puts them over what the targets hold.
layout(binding = 0) uniform sampler2D fireSum;
layout(binding = 1) uniform sampler2D smokeSum;
layout(binding = 2) uniform sampler2D dustSum;
layout(binding = 3) uniform sampler2D coverageSum; // a hides, in every target
layout(binding = 4) uniform sampler2D depthSum;
layout(binding = 5) uniform sampler2D opticalDepths;

layout(location = 0) out vec4 fireLight;
layout(location = 1) out vec4 smokeLight;
layout(location = 2) out vec4 dustLight;
layout(location = 3) out vec4 coverage;
layout(location = 4) out vec4 depthMoment;
layout(location = 5) out vec4 opticalDepthSum;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    coverage = texelFetch(coverageSum, p, 0);
    fireLight = vec4(texelFetch(fireSum, p, 0).rgb, coverage.a);
    smokeLight = vec4(texelFetch(smokeSum, p, 0).rgb, coverage.a);
    dustLight = vec4(texelFetch(dustSum, p, 0).rgb, coverage.a);
    depthMoment = vec4(texelFetch(depthSum, p, 0).r, 0.0, 0.0, coverage.a);
    opticalDepthSum = vec4(texelFetch(opticalDepths, p, 0).r, 0.0, 0.0, 0.0); // adds up
}
