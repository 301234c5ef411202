#include "shared/view_block.glsl"

// Stored depth of the opaque picture to distance along each pixel's ray [m]; +inf where nothing was drawn.
layout(binding = 0) uniform sampler2D sceneDepth;
layout(location = 0) out float distanceAlongRay;

void main()
{
    vec3 origin;
    vec3 direction;
    float lengthPerDepth;
    viewRay(gl_FragCoord.xy, origin, direction, lengthPerDepth);
    float stored = texelFetch(sceneDepth, ivec2(gl_FragCoord.xy), 0).r;
    float n = stored * depthRange.x + depthRange.y;
    float denominator = n * depthScale.z - depthScale.w;
    float axis = (depthScale.x - n * depthScale.y) / denominator;
    bool nothing = stored == depthRange.z || abs(denominator) < 1e-30;
    distanceAlongRay = nothing ? uintBitsToFloat(0x7F800000u) : -axis * lengthPerDepth;
}
