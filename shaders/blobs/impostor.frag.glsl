#include "shared/view_block.glsl"

// The picture of an effect between two that were taken. What of it lies behind opaque geometry is cut off in
// proportion to the depth of its ball; the rest keeps its share of the optical depth.
layout(binding = 0) uniform sampler2D sceneDistance; // [m] along the ray to the opaque surface, +inf for none
layout(binding = 1) uniform sampler2D impostorAtlas; // premultiplied

flat in vec4 impostorCenter;
flat in vec4 impostorAppearance;
flat in vec4 impostorTiles;
in vec2 impostorPlace;
#if FX_CARDS
#include "shared/card_lists.glsl"
#else
layout(location = 0) out vec4 light;
#endif

// `size` of the square, in sides of the picture.
vec4 pictureAt(vec2 tile, float size)
{
    vec2 place = 0.5 + (impostorPlace - 0.5) * size;
    vec2 texel = tile + clamp(place * 32.0, vec2(0.5), vec2(31.5)); // never into the neighbor's tile
    return textureLod(impostorAtlas, texel / vec2(64.0 * 32.0, 32.0 * 32.0), 0.0);
}

void main()
{
    vec4 picture = mix(pictureAt(impostorTiles.zw, impostorAppearance.w), pictureAt(impostorTiles.xy, 1.0), impostorAppearance.x);
    float surface = texelFetch(sceneDistance, ivec2(gl_FragCoord.xy), 0).r;
    vec3 rayBegin, along;
    float lengthPerDepth;
    viewRay(gl_FragCoord.xy, rayBegin, along, lengthPerDepth);
    vec2 ends = vec2(clipOffset.z * lengthPerDepth, min(surface, clipOffset.w * lengthPerDepth));
#if FX_CARDS
    ends = rayDirection.w > 0.5 ? ends : vec2(-1e30, surface); // rays take shares of what is gathered
#endif
    vec2 passed = clamp(0.5 + 0.5 * (ends - length(impostorCenter.xyz)) / impostorAppearance.z, 0.0, 1.0);
    float share = impostorAppearance.y * max(passed.y - passed.x, 0.0); // of the optical depth
    float alpha = min(picture.a, 0.9999);
    float shown = 1.0 - pow(1.0 - alpha, share);
    vec4 seen = alpha > 1e-6 ? picture * (shown / alpha) : picture * share;
#if FX_CARDS
    if (!(seen.a > 0.0 || any(greaterThan(seen.rgb, vec3(0.0)))))
        discard;
    float hides = seen.a > 1e-6 ? seen.a : 0.0;
    addCard(seen.rgb / max(hides, seen.a > 1e-6 ? 1e-6 : 1.0), 1.0, hides, length(impostorCenter.xyz), 2.0 * impostorAppearance.z,
            1.0);
#else
    light = seen;
#endif
}
