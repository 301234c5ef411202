// Light of sky and ground that a medium scatters at a point, per unit of extinction. Needs shared/light_slices.glsl.
//
// Both reach the point through the media along the axes of the sky; what does not escape along them is scattered again: with
// p the mean transmittance, and b the mean of what arrives, the source is albedo b / (1 - albedo (1 - p)), which is the
// luminance of the sky where albedo and all luminances are equal to it.
vec3 skySource(vec3 p, vec3 albedo)
{
    if (lightCounts.y == 0)
        return 0.5 * albedo * (lightOfSky.rgb + lightOfGround.rgb);
    float escaping = 0.0;
    vec3 arriving = vec3(0.0);
    for (int i = lightCounts.x; i < lightCounts.x + lightCounts.y; ++i) {
        vec2 depth = parallelDepth(lights[i], p);
        float above = exp(-depth.x);
        float below = exp(-max(depth.y - depth.x, 0.0));
        escaping += above + below;
        arriving += above * lightOfSky.rgb + below * lightOfGround.rgb;
    }
    float weight = 0.5 / float(lightCounts.y);
    float again = lightOfSky.w > 0.5 ? 1.0 - weight * escaping : 0.0;
    return weight * arriving * albedo / max(1.0 - albedo * again, 1e-4);
}
