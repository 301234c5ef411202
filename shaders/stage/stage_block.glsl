// Block of the stage's programs; layout asserted in rendering/stage/stage_renderer.cpp.
layout(std140, binding = 0) uniform StageBlock
{
    mat4 clipFromWorld;   // world relative to the view's origin
    mat4 shadowFromMesh;  // sun's clip space of the mesh's own coordinates
    vec4 rayDirection;    // as in view_block; w size of a shadow texel [m]
    vec4 rayDirectionX;   // w width
    vec4 rayDirectionY;   // w height
    vec4 sunDirection;    // w texel size of the shadow map [1]
    vec4 sunLight;        // rgb [exposed]; w number of lights
    vec4 skyLight;        // rgb [exposed]; w albedo of the ground
    vec4 meshOffset;      // xyz mesh origin relative to the view's origin; w background: 0 color, 1 picture, 2 panorama
    vec4 background;      // rgb overhead [exposed]; w exposure of the picture
    vec4 horizon;         // rgb at eye height [exposed]
    vec4 lightPosition[8];  // xyz relative to the view's origin; w radius [m]
    vec4 lightIntensity[8]; // rgb [cd, exposed]
};
