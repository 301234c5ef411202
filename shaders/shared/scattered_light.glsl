// Light that a medium scatters to the eye at a point, per unit of extinction. Needs shared/light_slices.glsl and
// formulas/multiple_scattering.fx.h.

vec3 scatteredAgain(vec3 albedo, float g, float cosine, vec2 depth)
{
    vec3 source = vec3(fxMultipleScattering(albedo.r, g, cosine, depth.x, depth.y));
    if (albedo.g != albedo.r || albedo.b != albedo.r) {
        source.g = fxMultipleScattering(albedo.g, g, cosine, depth.x, depth.y);
        source.b = fxMultipleScattering(albedo.b, g, cosine, depth.x, depth.y);
    }
    return source;
}

vec3 scatteredOf(SliceLight light, vec3 arriving, vec3 towards, vec2 depth, vec3 toEye, vec3 albedo, float g)
{
    float cosine = -dot(towards, toEye); // 1: light goes straight on to the eye
    vec3 source = albedo * (fxHenyeyGreenstein(cosine, g) * exp(-depth.x));
    if (lightOfSky.w > 0.5)
        source += scatteredAgain(albedo, g, cosine, depth);
    return arriving * source;
}

// p [m] relative to the eye; toEye unit; g mean cosine of the phase function
vec3 scatteredLight(vec3 p, vec3 toEye, vec3 albedo, float g)
{
    vec3 sum = vec3(0.0);
    if (lights[0].color.r + lights[0].color.g + lights[0].color.b > 0.0)
        sum += scatteredOf(lights[0], lights[0].color.rgb, lights[0].place.xyz, parallelDepth(lights[0], p), toEye, albedo,
                           g);
    for (int i = 1; i < lightCounts.x; ++i) {
        SliceLight light = lights[i];
        vec3 towards;
        vec3 arriving = pointLight(light, p, towards);
        sum += scatteredOf(light, arriving, towards, pointDepth(light, p), toEye, albedo, g);
    }
    return sum;
}
