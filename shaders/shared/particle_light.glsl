// Light of the view that particles scatter to the eye: per steradian, for a color of 1 unless a color is given. Needs
// shared/particle_block.glsl and shared/particle_place.glsl.
#include "formulas/henyey_greenstein.fx.h"
#include "formulas/multiple_scattering.fx.h"
#include "formulas/kernel_quantile.fx.h"
#include "shared/light_slices.glsl"
#include "shared/scattered_light.glsl"
#include "shared/sky_light.glsl"

// The particle is a ball of medium that also casts its shadow. Of the ray through its center the eye sees half of the opacity
// before the point that is returned, and half behind it. `across` leads from the center to a corner of the square; the light
// half way is what the picture shows there.
vec3 seenPlace(vec3 center, vec3 across, float radius, float opacity)
{
    float a = clamp(opacity, 1e-3, 0.999);
    float passed = log(1.0 - 0.5 * a) / log(1.0 - a); // [1] of the optical depth through the center
    return center + 0.5 * across + fxKernelQuantile(passed) * radius * lookAt(center);
}

// Light that a medium of a color scatters, of which the part `share` of the light that falls on it.
vec3 scatteredByMedium(vec3 place, vec3 color, float share)
{
    vec3 scattering = color * share;
    vec3 albedo = min(scattering, vec3(1.0));
    vec3 toEye = -lookAt(place);
    vec3 source = scatteredLight(place, toEye, albedo, 0.0) + skySource(place, toEye, albedo, 0.0);
    return source * max(scattering, vec3(1.0));
}

// Metres from a point to where a ray leaves a ball (center and radius).
float wayOutOf(vec4 ball, vec3 place, vec3 direction)
{
    vec3 d = place - ball.xyz;
    float b = dot(d, direction);
    return max(sqrt(max(b * b - dot(d, d) + ball.w * ball.w, 0.0)) - b, 0.0);
}

// What hides is a ball of medium to light, but is not to shade itself. Its own optical depth is missing in all planes before
// the ball, so that a point by the distance of two planes before it has no share of it.
vec3 beforeBall(SliceLight light, vec4 ball, vec3 place, vec3 towards)
{
    bool isParallel = light.color.w < 0.5;
    float perMetre = isParallel ? length(light.along.xyz) : light.along.w;
    float way = wayOutOf(ball, place, towards) + (perMetre > 0.0 ? 1.0 / perMetre : 0.0);
    if (!isParallel)
        way = min(way, length(light.place.xyz - place));
    return place + way * towards;
}

// Light of sky and ground on a surface, or with the normal 0 on all sides of the ball. The open sky lights a surface by how
// far it is turned up; the axes of the sky say how much of it media leave, each by how far the surface is turned to it.
vec3 skyOnBody(vec4 ball, vec3 place, vec3 normal)
{
    bool isSurface = dot(normal, normal) > 0.5;
    vec2 open = vec2(0.0); // x of the sky, y of the ground
    vec2 weight = vec2(0.0);
    for (int i = lightCounts.x; i < lightCounts.x + lightCounts.y; ++i) {
        SliceLight axis = lights[i];
        float facing = isSurface ? dot(normal, axis.place.xyz) : 1.0;
        if (facing > 0.0) {
            open.x += facing * exp(-parallelDepth(i, beforeBall(axis, ball, place, axis.place.xyz)).x);
            weight.x += facing;
        }
        if (facing < 0.0 || !isSurface) {
            vec2 depth = parallelDepth(i, beforeBall(axis, ball, place, -axis.place.xyz));
            open.y += abs(facing) * exp(-max(depth.y - depth.x, 0.0));
            weight.y += abs(facing);
        }
    }
    open = mix(vec2(1.0), open / max(weight, 1e-6), greaterThan(weight, vec2(1e-6)));
    return mix(open.y * lightOfGround.rgb, open.x * lightOfSky.rgb, 0.5 + 0.5 * normal.y);
}

// A small thing that hides, like the mean of a matt ball: its surface receives a quarter of what passes it.
vec3 scatteredByBody(vec4 ball)
{
    const float kPerBall = 1.0 / (4.0 * 3.14159265);
    vec3 sum = skyOnBody(ball, ball.xyz, vec3(0.0));
    for (int i = 0; i < lightCounts.x; ++i) {
        vec3 towards;
        vec3 arriving = unshadowedLight(lights[i], ball.xyz, towards);
        sum += arriving * (kPerBall * exp(-sliceDepth(i, beforeBall(lights[i], ball, ball.xyz, towards)).x));
    }
    return sum;
}

// A matt surface at `place` of a body that lies within a ball.
vec3 scatteredBySurface(vec4 ball, vec3 place, vec3 normal)
{
    const float kPerSurface = 1.0 / 3.14159265;
    vec3 sum = skyOnBody(ball, place, normal);
    for (int i = 0; i < lightCounts.x; ++i) {
        vec3 towards;
        vec3 arriving = unshadowedLight(lights[i], place, towards);
        float facing = dot(normal, towards);
        if (facing > 0.0)
            sum += arriving *
                   (kPerSurface * facing * exp(-sliceDepth(i, beforeBall(lights[i], ball, place, towards)).x));
    }
    return sum;
}

// Light of a square or a ribbon at one of its corners, for its color.
vec3 scatteredByCard(vec3 center, vec3 across, float radius, vec4 color)
{
#if FX_SOLID // a test of appearance.w would execute both forms on hardware without jumps
    return shine.y * color.rgb * scatteredByBody(vec4(center, radius));
#else
    float opacity = appearance.w < 0.5 ? color.a : 0.0; // what adds takes no light
    return scatteredByMedium(seenPlace(center, across, radius, opacity), color.rgb, shine.y);
#endif
}
