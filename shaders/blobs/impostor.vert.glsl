#include "shared/view_block.glsl"

// One square an effect. Layout of ImpostorInstance in rendering/passes/impostor_pass.h.
struct Impostor
{
    vec4 center; // xyz [m] relative to the eye; w half the side of the square [m]
    vec4 right;  // xyz axis of the picture; w tile of the newer picture
    vec4 up;     // xyz; w tile of the older one
    vec4 appearance;   // x share of the newer; y share of the effect that is drawn; z radius [m];
                 // w side of the square over that of the older picture
};
layout(std430, binding = 0) readonly buffer Impostors { Impostor impostors[]; };

flat out vec4 impostorCenter;
flat out vec4 impostorAppearance;
flat out vec4 impostorTiles; // lower left of the newer and of the older [texel]
out vec2 impostorPlace;      // [0, 1] on the picture

void main()
{
    Impostor impostor = impostors[gl_VertexID / 6 + int(pass.y)]; // a draw may begin in the middle of the order
    impostorCenter = impostor.center;
    impostorAppearance = impostor.appearance;
    vec2 tile = vec2(impostor.right.w, impostor.up.w);
    impostorTiles = 32.0 * vec4(mod(tile.x, 64.0), floor(tile.x / 64.0), mod(tile.y, 64.0), floor(tile.y / 64.0));
    int vertex = gl_VertexID % 6;
    vec2 corner = vec2(vertex == 1 || vertex == 2 || vertex == 4 ? 1.0 : -1.0,
                       vertex == 2 || vertex == 4 || vertex == 5 ? 1.0 : -1.0);
    impostorPlace = 0.5 + 0.5 * corner;
    vec3 place = impostor.center.xyz + impostor.center.w * (corner.x * impostor.right.xyz + corner.y * impostor.up.xyz);
    vec3 c = vec3(dot(place, right.xyz), dot(place, up.xyz), dot(place, forward.xyz));
    gl_Position = vec4(c.xy * vec2(right.w, up.w) + clipOffset.xy * c.z, 0.0, c.z);
}
