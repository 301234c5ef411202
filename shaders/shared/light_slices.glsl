// The optical depth of all media between the lights of a view and a point.
#include "shared/light_block.glsl"
#include "formulas/slice_depth.fx.h"
layout(binding = 7) uniform sampler2D lightSlices;   // r optical depth up to a plane; g between it and the next plane
layout(binding = 6) uniform sampler2D hostShadowMap; // depth of the host's surfaces as the sun sees them

const int kSliceTileColumns = 8;
const int kFadingEntries = 21; // how far behind a light its planes lie as they were before they changed their sizes
const int kFinerPlanes = 19; // entries of the list with finer planes of the sun near the eye, and with the finest

vec2 octahedralPlace(vec3 d)
{
    vec2 p = d.xy / (abs(d.x) + abs(d.y) + abs(d.z));
    if (d.z < 0.0)
        p = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    return p;
}

vec2 slicePlane(vec4 tiles, int plane, vec2 texel)
{
    vec2 tile = tiles.xy + tiles.z * vec2(plane % kSliceTileColumns, plane / kSliceTileColumns);
    return textureLod(lightSlices, (tile + texel) / vec2(textureSize(lightSlices, 0)), 0.0).rg;
}

vec3 parallelPlace(SliceLight light, vec3 p)
{
    return vec3(dot(light.right.xyz, p) + light.right.w, dot(light.up.xyz, p) + light.up.w,
                dot(light.along.xyz, p) + light.along.w);
}

// x: optical depth up to a place in planes, y: of all media on its line. place: texel, texel, plane
vec2 depthAtPlace(vec4 tiles, vec3 place)
{
    vec2 texel = clamp(place.xy, vec2(0.5), vec2(tiles.z - 0.5));
    int last = int(tiles.w) - 1;
    float plane = clamp(place.z, 0.0, float(last));
    int lower = min(int(plane), last - 1);
    vec2 slab = slicePlane(tiles, lower, texel);
    float before = lower > 0 ? slicePlane(tiles, max(lower - 1, 0), texel).g : slab.g;
    float behind = slicePlane(tiles, lower + 1, texel).g;
    return vec2(slab.r + fxSliceDepth(before, slab.g, behind, plane - float(lower)), slicePlane(tiles, last, texel).r);
}

// Optical depth between parallel light number i and p [m, relative to the eye], and of all media on its line through p.
vec2 parallelDepth(int i, vec3 p)
{
    if (lights[i].tiles.w < 0.5)
        return vec2(0.0);
    vec2 depth = depthAtPlace(lights[i].tiles, parallelPlace(lights[i], p));
    int before = i + kFadingEntries;
    int fades = lights[before].color.r > 0.0 ? 1 : 0; // software renderers skip a loop without turns, but no branch
    for (int k = 0; k < fades; ++k)
        depth = mix(depth, depthAtPlace(lights[before].tiles, parallelPlace(lights[before], p)), lights[before].color.r);
    return depth;
}

// [1] of what finer planes say of a place at a distance from the eye [m]: nothing from the rim of their ball on.
float finerShare(SliceLight planes, float distance)
{
    const float kRim = 0.25; // of the radius
    return planes.tiles.w > 0.5 ? clamp((planes.place.w - distance) / (kRim * planes.place.w), 0.0, 1.0) : 0.0;
}

// The same of the sun, with the finest planes that know the place, which give way to coarser ones towards the rim of theirs.
// Constant indices: software renderers read those at once.
vec2 sunDepth(vec3 p)
{
    if (lights[0].tiles.w < 0.5)
        return vec2(0.0);
    float away = length(p);
    float finer = finerShare(lights[kFinerPlanes], away), finest = finerShare(lights[kFinerPlanes + 1], away);
    bool isInFiner = finer > 0.0, isInFinest = finest > 0.0;
    vec3 place = isInFinest  ? parallelPlace(lights[kFinerPlanes + 1], p)
                 : isInFiner ? parallelPlace(lights[kFinerPlanes], p)
                             : parallelPlace(lights[0], p);
    vec4 tiles = isInFinest ? lights[kFinerPlanes + 1].tiles : isInFiner ? lights[kFinerPlanes].tiles : lights[0].tiles;
    vec2 depth = depthAtPlace(tiles, place);
    int before = kFadingEntries + (isInFinest ? kFinerPlanes + 1 : isInFiner ? kFinerPlanes : 0);
    int fades = lights[before].color.r > 0.0 ? 1 : 0;
    for (int k = 0; k < fades; ++k)
        depth = mix(depth, depthAtPlace(lights[before].tiles, parallelPlace(lights[before], p)), lights[before].color.r);
    float share = isInFinest ? finest : isInFiner ? finer : 1.0;
    int coarser = share < 1.0 ? 1 : 0;
    for (int k = 0; k < coarser; ++k)
        depth = mix(parallelDepth(isInFinest ? kFinerPlanes : 0, p), depth, share);
    return depth;
}

// The same of a light at a point.
vec2 pointDepth(int i, vec3 p)
{
    if (lights[i].tiles.w < 0.5)
        return vec2(0.0);
    vec3 d = p - lights[i].place.xyz;
    float l = length(d);
    vec2 direction = octahedralPlace(l > 0.0 ? d / l : vec3(0.0, 0.0, 1.0));
    vec2 texel = 1.0 + (0.5 + 0.5 * direction) * (lights[i].tiles.z - 2.0);
    vec2 depth = depthAtPlace(lights[i].tiles, vec3(texel, l * lights[i].along.w - lights[i].along.x));
    int before = i + kFadingEntries;
    int fades = lights[before].color.r > 0.0 ? 1 : 0;
    for (int k = 0; k < fades; ++k)
        depth = mix(depth, depthAtPlace(lights[before].tiles, vec3(texel, l * lights[before].along.w - lights[before].along.x)),
                    lights[before].color.r);
    return depth;
}

// Of the light with a number below lightCounts.x: the sun is the first.
vec2 sliceDepth(int number, vec3 p)
{
    return number == 0 ? sunDepth(p) : pointDepth(number, p);
}

// Share of the sun that the host's surfaces let through to p: 3 x 3 places within the soft edge, each between four texels.
float hostShadow(vec3 p)
{
    int taps = hostShadowEdge.z == 0.0 ? 0 : 9; // a loop without turns is skipped by software renderers too, a branch is not
    vec3 place = vec3(dot(hostShadowRows[0].xyz, p) + hostShadowRows[0].w,
                      dot(hostShadowRows[1].xyz, p) + hostShadowRows[1].w,
                      dot(hostShadowRows[2].xyz, p) + hostShadowRows[2].w);
    vec2 size = vec2(textureSize(hostShadowMap, 0));
    float depth = hostShadowEdge.z * clamp(place.z, 0.0, 1.0); // behind the far plane nothing is known
    float lit = 0.0;
    for (int i = 0; i < taps; ++i) {
        vec2 uv = place.xy + hostShadowEdge.xy * vec2(i % 3 - 1, i / 3 - 1);
        vec4 stored = textureGather(hostShadowMap, uv);
        vec4 passes = vec4(greaterThanEqual(hostShadowEdge.z * stored, vec4(depth)));
        vec2 between = fract(uv * size - 0.5);
        float share = mix(mix(passes.w, passes.z, between.x), mix(passes.x, passes.y, between.x), between.y);
        bool isOutside = any(lessThan(uv, vec2(0.0))) || any(greaterThan(uv, vec2(1.0)));
        lit += isOutside ? 1.0 : share;
    }
    return taps == 0 ? 1.0 : lit / 9.0;
}

// Exposed illuminance of a light at a point before media, and the unit vector towards it.
vec3 pointLight(SliceLight light, vec3 p, out vec3 towards)
{
    vec3 d = light.place.xyz - p;
    float l2 = dot(d, d);
    towards = l2 > 0.0 ? d * inversesqrt(l2) : vec3(0.0, 1.0, 0.0);
    float share = clamp(light.cone.w - dot(towards, light.cone.xyz), 0.0, 1.0);
    share *= share * (3.0 - 2.0 * share);
    return light.color.rgb * (share / max(l2 + light.place.w * light.place.w, 1e-12));
}

// Of any light.
vec3 unshadowedLight(SliceLight light, vec3 p, out vec3 towards)
{
    if (light.color.w < 0.5) {
        towards = light.place.xyz;
        return light.color.rgb * hostShadow(p);
    }
    return pointLight(light, p, towards);
}
