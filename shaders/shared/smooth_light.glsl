// Scattered light that changes little within a ball of medium, by the closed form: of sky and ground, of lights at points, and of the
// sun what is scattered more than once. Per unit of extinction. Needs shared/scattered_light.glsl, shared/sky_light.glsl and
// formulas/multiple_scattering.fx.h.
// toEye unit; g mean cosine of the phase function; towardsSun as of sunDepth(p)
vec3 smoothLight(vec3 p, vec3 toEye, vec3 albedo, float g, vec2 towardsSun)
{
    vec3 sum = skySource(p, toEye, albedo, g) + scatteredOfPoints(p, toEye, albedo, g);
    return lightOfSky.w > 0.5 ? sum + sunScatteredAgain(p, toEye, albedo, g, towardsSun) : sum;
}
