#include "stage/stage_sky.glsl"

// Water with waves: it mirrors the sky, the sun and the lights.
struct WaterSurface
{
    vec3 normal;
    float roughness; // width of the slopes that a pixel averages [1]
};

// Waves at a place [m], as a sum of trains whose lengths fall by 0.71 and whose steepness is equal. p: width of what is
// averaged [m]; trains shorter than that count as roughness.
WaterSurface wavesAt(vec2 place, float p)
{
    vec2 slope = vec2(0.0);
    float unseen = 2e-5;
    vec2 along = vec2(0.8, 0.6);
    float k = 1.9; // [1/m]
    for (int i = 0; i < 14; ++i) {
        float steep = 0.020 * (i < 4 ? 0.7 : 1.0);
        float seen = exp(-0.12 * k * k * p * p);
        vec2 bent = place + 0.35 / k * vec2(sin(0.31 * k * place.y + float(i)), sin(0.27 * k * place.x - float(i)));
        slope += steep * seen * cos(k * dot(along, bent) + 2.1 * float(i * i)) * along;
        unseen += 0.5 * steep * steep * (1.0 - seen * seen);
        along = vec2(-0.7374 * along.x - 0.6755 * along.y, 0.6755 * along.x - 0.7374 * along.y); // the golden angle
        k *= 1.41;
    }
    return WaterSurface(normalize(vec3(-slope.x, 1.0, -slope.y)), sqrt(unseen));
}

// Reflectance of water (Schlick's approximation for an index of 1.333).
float waterReflectance(float cosine)
{
    float x = clamp(1.0 - cosine, 0.0, 1.0);
    return 0.02 + 0.98 * x * x * x * x * x;
}

// Light mirrored from a source in the direction l, whose radius is `angle` [rad], per illuminance.
float waterGlint(vec3 n, vec3 v, vec3 l, float roughness, float angle)
{
    float a2 = 2.0 * roughness * roughness + 0.25 * angle * angle;
    vec3 h = normalize(v + l);
    float c = max(dot(n, h), 0.0);
    float d = c * c * (a2 - 1.0) + 1.0;
    float facing = max(dot(n, v), 0.02);
    return dot(n, l) <= 0.0 ? 0.0 : waterReflectance(dot(h, v)) * a2 / (12.566371 * d * d * max(facing, dot(n, l)));
}
