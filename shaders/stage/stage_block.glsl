#include "shared/media_shadow.glsl"

struct StageLight
{
    vec4 position;  // xyz relative to the view's origin; w radius [m]
    vec4 intensity; // rgb [cd, exposed]
    vec4 cone;      // share of a spot: smooth step of dot(direction of the light, xyz) + w
    vec4 traits;    // x share that lights what faces aside; y index of the shadow that media cast, -1: none
};

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
    vec4 horizon;         // rgb at eye height [exposed]; w 1: the mesh is soil
    vec4 farHills;        // rgb of distant hills [exposed]; w 1: the horizon has hills
    vec4 nearTrees;       // rgb of trees in front of them [exposed]; w width of a pixel as a tangent
    vec4 water;           // x first vertex of water
    StageLight stageLights[16];
    FxMediaShadow mediaShadows[5]; // the first is that of the sun
};
