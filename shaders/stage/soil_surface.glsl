#include "formulas/lump_noise.fx.h"
#include "formulas/soil_texture.fx.h"

// Relief and color of soil, averaged over a pixel; the same as in rendering/reference/render/soil_surface.cpp.
struct SoilSurface
{
    vec3 share; // of the albedo, mean 1
    vec2 slope; // of the height along x and z [1]
};

// Octaves at a place [m] as slopes, relative albedo and hue. p: width of what is averaged [m]
vec4 soilOctaves(vec2 place, float p)
{
    vec4 sum = vec4(0.0);
    vec2 turn = vec2(1.0, 0.0);
    for (int k = 0; k < 7; ++k) {
        float l = fxSoilSize(float(k));
        float band = fxOctaveBand(l, p);
        if (band <= 0.0)
            break;
        vec2 q = vec2(turn.x * place.x - turn.y * place.y, turn.y * place.x + turn.x * place.y) / l + 17.3 * float(k);
        vec2 g = vec2(fxSoilSlopeX(q.x, q.y), fxSoilSlopeZ(q.x, q.y));
        float n = band * fxSoilNoise(q.x, q.y);
        sum.xy += band * fxSoilSteepness(l) * vec2(turn.x * g.x + turn.y * g.y, turn.x * g.y - turn.y * g.x);
        sum.z += fxSoilContrast(l) * n;
        sum.w += (k & 1) == 1 ? n : 0.0;
        turn = vec2(0.8 * turn.x - 0.6 * turn.y, 0.6 * turn.x + 0.8 * turn.y);
    }
    return sum;
}

// along: long axis of the pixel's image on the ground [m]; width: length of the other [m]
SoilSurface soilAt(vec2 place, vec2 along, float width)
{
    int taps = int(clamp(ceil(length(along) / max(width, 1e-6)), 1.0, 6.0));
    float p = max(width, length(along) / float(taps));
    vec4 sum = vec4(0.0);
    for (int i = 0; i < taps; ++i)
        sum += soilOctaves(place + along * ((float(i) + 0.5) / float(taps) - 0.5), p) / float(taps);
    SoilSurface soil;
    soil.share = max(1.0 + sum.z, 0.2) * vec3(1.0 + 0.12 * sum.w, 1.0, 1.0 - 0.16 * sum.w);
    soil.slope = sum.xy;
    return soil;
}
