// What a fragment of a particle adds to the targets of the media pass. Needs shared/view_block.glsl and
// shared/particle_block.glsl. FX_LAYERS as in media.frag.glsl; FX_SOLID 1 replaces instead, with depth and distance;
// FX_CARDS 1 gathers fragments instead. FX_MARKS, where it is defined, tells outputs whose fragment it is and how it moves:
// beside gathered fragments, or in place of the light of solid ones.
layout(binding = 0) uniform sampler2D sceneDistance; // [m] along the ray to the opaque surface, +inf for none

#ifdef FX_MARKS
in vec3 fragmentVelocity; // [m/s] relative to the world
#endif

#if FX_CARDS
#include "shared/card_lists.glsl"
#elif defined(FX_MARKS)
layout(location = 0) out vec4 solidVelocity;
layout(location = 1) out uvec2 solidInstance;
#elif FX_LAYERS
#include "shared/layer_outputs.glsl"
#if FX_SOLID
layout(location = 6) out vec4 solidDistance;
#endif
#else
layout(location = 0) out vec4 mediaLight;
#if FX_SOLID
layout(location = 1) out vec4 solidDistance;
#endif
#endif

// [m] along this fragment's ray.
float distanceOf(vec3 place)
{
    return rayOrigin.w > 0.5 ? dot(place, forward.xyz) : length(place);
}

// Share of the particle that the opaque scene and the near plane leave at `place`.
float leftOver(vec3 place)
{
    float behind = texelFetch(sceneDistance, ivec2(gl_FragCoord.xy), 0).r - distanceOf(place);
    float before = dot(place, forward.xyz) - rayOriginX.w;
    float room = min(behind, before);
    if (appearance.z > 0.0)
        return clamp(room / appearance.z, 0.0, 1.0);
    return room > 0.0 ? 1.0 : 0.0;
}

// Share of the particle that lies between the depths that are drawn; what is solid is cut.
float shareDrawn(vec3 place)
{
    float distanceAlong = distanceOf(place);
    float reach = appearance.z;
#if FX_SOLID
    reach = 0.0;
#endif
    float lengthPerDepth = rayOrigin.w > 0.5 ? 1.0 : distanceAlong / dot(place, forward.xyz);
    float share = shareInRange(distanceAlong, reach, lengthPerDepth);
#if FX_CARDS
    share = rayDirection.w > 0.5 ? share : 1.0; // rays take shares of what is gathered
#endif
    return share;
}

// alpha: of the particle alone, without the scene
void writeParticle(vec3 light, float alpha, vec3 place)
{
    float left = leftOver(place);
    float share = shareDrawn(place);
    bool addsOnly = appearance.w > 0.5 && appearance.w < 1.5; // it hides nothing
#if FX_SOLID
    alpha = left > 0.0 && alpha >= 0.5 && (share > 0.0 || rayDirection.w < 0.5) ? 1.0 : 0.0;
#else
    alpha *= left;
    if (share < 1.0) // of its optical depth, so that ranges put over each other have the opacity of all of it
        alpha = addsOnly ? alpha * share : 1.0 - pow(max(1.0 - alpha, 0.0), share);
#endif
    if (!(alpha > 0.0) || any(isnan(light)) || any(isinf(light)))
        discard;
#if FX_SOLID
    float d = distanceOf(place);
#ifndef FX_MARKS
    solidDistance = vec4(d, 0.0, 0.0, 1.0);
#endif
    gl_FragDepth = 1.0 / (1.0 + max(d, 0.0)); // nearer is more, as precise far away as a float is
#endif
#if FX_SOLID
    alpha = share > 0.0 ? alpha : 0.0; // rays end there in all ranges of depth, and it is seen in one
#endif
    float cover = addsOnly ? 0.0 : alpha;
    vec3 seen = alpha * light;
#if FX_CARDS
    addCard(light, alpha, cover, distanceOf(place), 2.0 * appearance.z, shine.z);
#elif defined(FX_MARKS)
    solidVelocity = vec4(fragmentVelocity, 1.0);
    solidInstance = markInstance.xy;
#elif FX_LAYERS
    float layer = shine.z;
    vec3 ofLayer = vec3(layer < 0.5, layer > 0.5 && layer < 1.5, layer > 1.5);
    fireLight = vec4(ofLayer.x * seen, cover);
    smokeLight = vec4(ofLayer.y * seen, cover);
    dustLight = vec4(ofLayer.z * seen, cover);
    coverage = vec4(cover * ofLayer, cover);
    depthMoment = vec4(cover * distanceOf(place), 0.0, 0.0, cover);
    opticalDepthSum = vec4(-log(max(1.0 - cover, 1e-9)), 0.0, 0.0, 0.0);
#else
    mediaLight = vec4(seen, cover);
#endif
}
