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
    vec4 soft;     // x softening as the medium thins
};
layout(binding = 10) uniform sampler3D lumpTile;

const float kLumpCells = 8.0;

// first: texel of field/field_blocks.glsl
FieldDetail fieldDetail(int first)
{
    FieldDetail d;
    for (int i = 0; i < 6; ++i)
        d.rows[i] = fieldTexel(first + i);
    d.erosion = fieldTexel(first + 6);
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

// Broad lumps and octaves of one generation, of deviation 1. u in cells; size [m] of its lumps, pixel [m]; faded variance of those that are
// finer than pixels
float lumpOctaves(vec3 u, float size, float pixel, float gain, int octaves, out float faded)
{
    float broad = fxBroadAmplitude(), seen = fxOctaveBand(fxBroadSize() * size, pixel);
    float amplitude = 1.0, variance = broad * broad, shown = broad * broad * seen * seen;
    vec3 halfTexel = 0.5 / vec3(textureSize(lumpTile, 0));
    vec3 place = vec3(fxBroadPlace(u.x), fxBroadPlace(u.y), fxBroadPlace(u.z));
    float sum = broad * seen * textureLod(lumpTile, place / kLumpCells + halfTexel, 0.0).r;
    for (int k = 0; k < octaves; ++k) {
        float band = fxOctaveBand(size, pixel);
        if (band <= 0.0) { // nor any that follows
            variance += amplitude * amplitude * (1.0 - pow(gain, 2.0 * float(octaves - k))) / (1.0 - gain * gain);
            break;
        }
        sum += amplitude * band * textureLod(lumpTile, u / kLumpCells + halfTexel, 0.0).r;
        variance += amplitude * amplitude;
        shown += amplitude * amplitude * band * band;
        u = vec3(fxNextOctaveX(u.x, u.z), fxNextOctaveY(u.x, u.y, u.z), fxNextOctaveZ(u.x, u.y, u.z));
        amplitude *= gain;
        size *= 1.0 / 2.03;
    }
    faded = max(1.0 - shown / variance, 0.0);
    return sum * inversesqrt(variance);
}

// What light of a medium of one temperature becomes by that of the detail. By Wien's law its power grows with the frequency: that of
// 580 nm is given; those of the primaries are 611, 549 and 464 nm.
vec3 detailedLight(vec3 light, MediumDetail detail, float power)
{
    return light * pow(vec3(detail.temperature), power * (580.0 / vec3(611.0, 549.0, 464.0)));
}

// Whether noise shows.
bool hasLumps(DetailPlace place) { return place.s > 0.0 && place.s < 1.5 + place.ramp; }

// @param p [m] relative to the eye; carried0, carried1 [cell] means of what balls carry
MediumDetail detailOf(FieldDetail d, DetailPlace place, vec3 p, vec3 carried0, vec3 carried1, float pixel)
{
    float ramp = place.ramp, s = place.s;
    float h = 0.5, z = 0.0, share = s > 0.0 ? 1.0 : 0.0;
    // a loop without turns is skipped by software renderers too, a branch is not
    int turns = hasLumps(place) ? 1 : 0;
    for (int turn = 0; turn < turns; ++turn) {
        vec3 u0 = vec3(dot(d.rows[0].xyz, p) + d.rows[0].w, dot(d.rows[1].xyz, p) + d.rows[1].w, dot(d.rows[2].xyz, p) + d.rows[2].w);
        vec3 u1 = vec3(dot(d.rows[3].xyz, p) + d.rows[3].w, dot(d.rows[4].xyz, p) + d.rows[4].w, dot(d.rows[5].xyz, p) + d.rows[5].w);
        int octaves = int(d.lumps.w);
        float gain = fxDetailSoftGain(d.noise.x, place.blur);
        float faded0, faded1;
        float z0 = lumpOctaves(u0 + carried0, d.lumps.x, pixel, gain, octaves, faded0);
        float z1 = lumpOctaves(u1 + carried1, d.lumps.y, pixel, gain, octaves, faded1);
        z = fxBlendGenerations(z0, z1, d.noise.y);
        h = fxDetailThreshold(z);
        share = fxDetailShareOver(s, z, fxBlendFaded(faded0, faded1, d.noise.y), ramp);
    }
    MediumDetail detail;
    detail.share = d.lumps.z * share * fxDetailGain(s, ramp);
    detail.temperature = fxDetailTemperature(1.0, s, h, ramp, z, d.noise.z, d.noise.w);
    detail.isLumpy = turns > 0;
    return detail;
}
