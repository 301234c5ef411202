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

// The sun's light that is scattered to the eye. p [m] relative to the eye; toEye unit; g mean cosine of the phase function
vec3 sunScatteredOnce(vec3 p, vec3 toEye, vec3 albedo, float g)
{
    float cosine = -dot(lights[0].place.xyz, toEye); // 1: light goes straight on to the eye
    return lights[0].color.rgb * albedo * (fxHenyeyGreenstein(cosine, g) * exp(-sunDepth(p).x) * hostShadow(p));
}

// depth: sunDepth(p)
vec3 sunScatteredAgain(vec3 p, vec3 toEye, vec3 albedo, float g, vec2 depth)
{
    float cosine = -dot(lights[0].place.xyz, toEye);
    return lights[0].color.rgb * hostShadow(p) * scatteredAgain(albedo, g, cosine, depth);
}

// Where the light of glowing media is known better than as that of a point: lights that stand for media in the box from `low` on
// of this size [m] count by `share`.
struct GlowBox
{
    vec3 low;
    vec3 size;
    float share;
};
const GlowBox kNoGlowBox = GlowBox(vec3(0.0), vec3(-1.0), 1.0);

float shareOf(SliceLight light, GlowBox box)
{
    vec3 place = light.place.xyz - box.low;
    bool isIn = light.color.w > 1.5 && all(greaterThan(place, vec3(0.0))) && all(lessThan(place, box.size));
    return isIn ? box.share : 1.0;
}

vec3 scatteredOfPoints(vec3 p, vec3 toEye, vec3 albedo, float g, GlowBox box)
{
    vec3 sum = vec3(0.0);
    for (int i = 1; i < lightCounts.x; ++i) {
        SliceLight light = lights[i];
        vec3 towards;
        vec3 arriving = pointLight(light, p, towards);
        float cosine = -dot(towards, toEye);
        vec2 depth = pointDepth(i, p);
        vec3 source = albedo * (fxHenyeyGreenstein(cosine, g) * exp(-depth.x));
        if (lightOfSky.w > 0.5)
            source += scatteredAgain(albedo, g, cosine, depth);
        sum += arriving * source * shareOf(light, box);
    }
    return sum;
}

vec3 scatteredOfPoints(vec3 p, vec3 toEye, vec3 albedo, float g)
{
    return scatteredOfPoints(p, toEye, albedo, g, kNoGlowBox);
}

vec3 scatteredLight(vec3 p, vec3 toEye, vec3 albedo, float g, GlowBox box)
{
    vec3 sum = sunScatteredOnce(p, toEye, albedo, g) + scatteredOfPoints(p, toEye, albedo, g, box);
    return lightOfSky.w > 0.5 ? sum + sunScatteredAgain(p, toEye, albedo, g, sunDepth(p)) : sum;
}

vec3 scatteredLight(vec3 p, vec3 toEye, vec3 albedo, float g)
{
    return scatteredLight(p, toEye, albedo, g, kNoGlowBox);
}
