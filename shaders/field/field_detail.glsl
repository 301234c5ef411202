#include "formulas/field_detail.fx.h"
#include "formulas/lump_noise.fx.h"

// Detail of fields: what rendering/field_detail/field_detail_numbers.cpp computes on the processor. Layout of FieldDetailBlock
// in rendering/field/field_blocks.h. Needs field/field_blocks.glsl.
struct FieldDetail
{
    vec4 rows[6];  // coordinates in cells of the generations, without what balls carry: dot(row.xyz, p) + row.w
    vec4 erosion;  // x size of lumps [m]; y, z optical depths of a lump that is nothing, that is whole; w ramp
    vec4 noise;    // x gain of an octave; y weight of the second generation; z cooling; w glow
    vec4 lumps;    // xy size of the generations' lumps in the world now [m]; z factor that keeps the whole; w octaves
    vec4 soft;     // x softening as the medium thins; yzw see nearMedium() of field/field_near.glsl
};
layout(binding = 10) uniform sampler3D lumpTile;

const float kLumpCells = 8.0;
const int kDetailTexels = 10; // of FieldDetail
const int kErosionTexel = 6, kSoftTexel = 9; // of them

// first: texel of field/field_blocks.glsl
FieldDetail fieldDetail(int first)
{
    FieldDetail d;
    for (int i = 0; i < 6; ++i)
        d.rows[i] = fieldTexel(first + i);
    d.erosion = fieldTexel(first + kErosionTexel);
    d.noise = fieldTexel(first + 7);
    d.lumps = fieldTexel(first + 8);
    d.soft = fieldTexel(first + 9);
    return d;
}

// Where a medium is between what is eroded away and what is whole.
struct DetailPlace
{
    float s;     // 0 .. 1
    float ramp;  // w
    float blur;  // thinning times softening
};

// @param erosion, soft of FieldDetail; k [1/m] smooth extinction; thinning mean of that of the balls there
DetailPlace detailPlace(vec4 erosion, vec4 soft, float k, float thinning)
{
    float blur = soft.x * thinning;
    float s = fxDetailPlace(k, erosion.x, erosion.y, erosion.z);
    return DetailPlace(fxDetailSoftPlace(s, blur, erosion.y, erosion.z), fxDetailSoftRamp(erosion.w, blur), blur);
}

struct MediumDetail
{
    float share;       // extinction over that of the smooth field
    float temperature; // likewise
    bool isLumpy;      // noise shows here
};

const float kMaxLump = 2.5;   // of lumpTile, which is below it at 99.9 % of its places
// Widths of pixels, in which noise differs from that in their middle as much as in a cube and on a length: the mean square distance
// from the middle is 1/6 in a square, 1/4 in a cube, 1/12 on a length of 1.
const float kPixelOfCube = 1.22;
const float kPixelOfLength = 0.71;
const float kFadedTail = 4.06; // deviations of what has faded out at which fxDetailPassed is 1e-3

// Share of the variance of broad lumps and octaves that shows. size, pixel [m]
float shownVariance(float size, float pixel, float gain, int octaves)
{
    float seen = fxBroadAmplitude() * fxOctaveBand(fxBroadSize() * size, pixel);
    float sum = seen * seen, amplitude = 1.0;
    for (int k = 0; k < octaves; ++k) {
        float band = amplitude * fxOctaveBand(size, pixel);
        sum += band * band;
        amplitude *= gain;
        size *= 1.0 / 2.03;
    }
    return sum;
}

float lumpAt(vec3 u) { return textureLod(lumpTile, u / kLumpCells + 0.5 / vec3(textureSize(lumpTile, 0)), 0.0).r; }
vec3 broadPlace(vec3 u) { return vec3(fxBroadPlace(u.x), fxBroadPlace(u.y), fxBroadPlace(u.z)); }
vec3 nextOctave(vec3 u) { return vec3(fxNextOctaveX(u.x, u.z), fxNextOctaveY(u.x, u.y, u.z), fxNextOctaveZ(u.x, u.y, u.z)); }

// Noise of two generations, of deviation 1. gain of an octave; u0, u1 in cells; pixel [m]; least, most: octaves that cannot bring it back between them are
// left out; faded variance of those that are finer than pixels
float blendedLumps(FieldDetail d, float gain, vec3 u0, vec3 u1, float pixel, float least, float most, out float faded)
{
    int octaves = int(d.lumps.w);
    float broad = fxBroadAmplitude();
    float variance = broad * broad + (1.0 - pow(gain, 2.0 * float(octaves))) / (1.0 - gain * gain);
    vec2 shown = vec2(shownVariance(d.lumps.x, pixel, gain, octaves), shownVariance(d.lumps.y, pixel, gain, octaves));
    vec2 unseen = max(1.0 - shown / variance, vec2(0.0));
    faded = fxBlendFaded(unseen.x, unseen.y, d.noise.y);
    float tail = kFadedTail * sqrt(faded);
    vec2 weight = inversesqrt(variance) * vec2(fxBlendGenerations(1.0, 0.0, d.noise.y), fxBlendGenerations(0.0, 1.0, d.noise.y));
    vec2 size = d.lumps.xy;
    vec2 now = broad * weight * vec2(fxOctaveBand(fxBroadSize() * size.x, pixel), fxOctaveBand(fxBroadSize() * size.y, pixel));
    float sum = now.x * lumpAt(broadPlace(u0)) + now.y * lumpAt(broadPlace(u1));
    float left = (1.0 - pow(gain, float(octaves))) / (1.0 - gain); // of the sum of amplitudes
    float amplitude = 1.0;
    for (int k = 0; k < octaves; ++k) {
        now = amplitude * weight * vec2(fxOctaveBand(size.x, pixel), fxOctaveBand(size.y, pixel));
        float reach = kMaxLump * left * (weight.x + weight.y) + tail;
        if (now.x + now.y <= 0.0 || sum + reach < least || sum - reach > most)
            break; // nor does any that follows
        sum += now.x * lumpAt(u0) + now.y * lumpAt(u1);
        left -= amplitude;
        u0 = nextOctave(u0);
        u1 = nextOctave(u1);
        amplitude *= gain;
        size *= 1.0 / 2.03;
    }
    return sum;
}

// What light of a medium of one temperature becomes by that of the detail. By Wien's law its power grows with the frequency: that of
// 580 nm is given; those of the primaries are 611, 549 and 464 nm.
vec3 detailedLight(vec3 light, MediumDetail detail, float power)
{
    return light * pow(vec3(detail.temperature), power * (580.0 / vec3(611.0, 549.0, 464.0)));
}

// Whether noise shows. isGlowing: the temperature matters
bool hasLumps(DetailPlace place, bool isGlowing) { return place.s > 0.0 && place.s < (isGlowing ? 1.5 : 1.0) + place.ramp; }

// The noise at which a threshold is h.
float noiseOf(float h)
{
    float inside = clamp(h, 1e-6, 1.0 - 1e-6);
    return log(1.0 / inside - 1.0) * (1.0 / 1.702);
}

// @param p [m] relative to the eye; carried0, carried1 [cell] means of what balls carry
MediumDetail detailOf(FieldDetail d, DetailPlace place, vec3 p, vec3 carried0, vec3 carried1, float pixel, bool isGlowing)
{
    const float kNoLump = 1e3;
    float ramp = place.ramp, s = place.s;
    float h = 0.5, z = 0.0, share = s > 0.0 ? 1.0 : 0.0;
    MediumDetail detail;
    detail.isLumpy = hasLumps(place, isGlowing);
    if (detail.isLumpy) {
        vec3 u0 = vec3(dot(d.rows[0].xyz, p) + d.rows[0].w, dot(d.rows[1].xyz, p) + d.rows[1].w, dot(d.rows[2].xyz, p) + d.rows[2].w);
        vec3 u1 = vec3(dot(d.rows[3].xyz, p) + d.rows[3].w, dot(d.rows[4].xyz, p) + d.rows[4].w, dot(d.rows[5].xyz, p) + d.rows[5].w);
        float least = s < 1.0 ? noiseOf(s) : -kNoLump; // below it nothing is left
        float most = s > ramp ? noiseOf(s - ramp) : kNoLump; // above it all is
        float faded;
        z = blendedLumps(d, fxDetailSoftGain(d.noise.x, place.blur), u0 + carried0, u1 + carried1, pixel, least, isGlowing ? kNoLump : most, faded);
        h = fxDetailThreshold(z);
        share = fxDetailShareOver(s, z, faded, ramp);
    }
    detail.share = d.lumps.z * share * fxDetailGain(s, ramp);
    detail.temperature = fxDetailTemperature(1.0, s, h, ramp, z, d.noise.z, d.noise.w);
    return detail;
}
