// Light of sky and ground that a medium scatters at a point, per unit of extinction. Needs shared/light_slices.glsl and
// formulas/henyey_greenstein.fx.h.
//
// Both reach the point through the media along the axes of the sky, from both ends of each. Where media stand in the way, the
// light is theirs: it has been scattered before. With the transmittance T and the luminance L of an end, its share q of the
// phase function, and n ends, the source is
//     albedo sum q (T L + (1 - T) M),   M = albedo b / (1 - albedo (1 - p)),   b = sum T L / n,   p = sum T / n
// where M is the light that media send in all directions. Where albedo is 1 and all L are equal, so is the source.
// toEye unit; g mean cosine of the phase function
vec3 skySource(vec3 p, vec3 toEye, vec3 albedo, float g)
{
    if (lightCounts.y == 0)
        return 0.5 * albedo * (lightOfSky.rgb + lightOfGround.rgb);
    float escaping = 0.0, scattered = 0.0, phases = 0.0;
    vec3 arriving = vec3(0.0), direct = vec3(0.0);
    for (int i = lightCounts.x; i < lightCounts.x + lightCounts.y; ++i) {
        vec2 depth = parallelDepth(i, p);
        float above = exp(-depth.x);
        float below = exp(-max(depth.y - depth.x, 0.0));
        float cosine = -dot(lights[i].place.xyz, toEye); // of light from above
        float phaseAbove = fxHenyeyGreenstein(cosine, g);
        float phaseBelow = fxHenyeyGreenstein(-cosine, g);
        escaping += above + below;
        arriving += above * lightOfSky.rgb + below * lightOfGround.rgb;
        phases += phaseAbove + phaseBelow;
        scattered += phaseAbove * (1.0 - above) + phaseBelow * (1.0 - below);
        direct += phaseAbove * above * lightOfSky.rgb + phaseBelow * below * lightOfGround.rgb;
    }
    float ends = 2.0 * float(lightCounts.y);
    vec3 medium = albedo * arriving / max(ends - albedo * (ends - escaping), 1e-4);
    return albedo * (direct + (lightOfSky.w > 0.5 ? scattered : 0.0) * medium) / phases;
}
