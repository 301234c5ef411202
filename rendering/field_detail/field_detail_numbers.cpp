#include "rendering/field_detail/field_detail_numbers.h"

#include "foundation/snapshot/material_kind.h"
#include "shaders/formulas/formula.h"

#include <algorithm>
#include <cmath>

namespace fx::render {

namespace {

namespace constant = base::material_constant;

constexpr uint32_t kOffset = 11; ///< purpose of lumpHash(), and the two that follow
constexpr float kDeepest = 0.5f; ///< [1] s - 1 - w from which on nothing depends on the noise

glm::vec3 offsetOf(uint32_t generation)
{
    const auto part = [&](uint32_t axis) {
        return float(lumpHash(generation & 0xFFFFu, generation >> 16, 0, kOffset + axis)) * 0x1.0p-24f;
    };
    return float(kLumpCells) * glm::vec3(part(0), part(1), part(2));
}

/// Sum of broad lumps and octaves, which would have deviation 1 without fading.
struct Octaves
{
    float sum;
    float faded; ///< variance of what has faded out
};

/// At a place in cells.
Octaves octavesAt(const LumpTile& tile, glm::vec3 p, float length, float gain, float pixel, int octaves)
{
    const float broad = formula::fxBroadAmplitude();
    const float seen = formula::fxOctaveBand(formula::fxBroadSize() * length, pixel);
    float amplitude = 1, sum = 0, variance = broad * broad, shown = broad * broad * seen * seen;
    if (seen > 0.0f)
        sum = broad * seen *
              tile.at({formula::fxBroadPlace(p.x), formula::fxBroadPlace(p.y), formula::fxBroadPlace(p.z)});
    for (int k = 0; k < octaves; ++k) {
        const float band = formula::fxOctaveBand(length, pixel);
        if (band > 0.0f)
            sum += amplitude * band * tile.at(p);
        shown += amplitude * amplitude * band * band;
        variance += amplitude * amplitude; // of all octaves: those that are missing have their mean
        p = {formula::fxNextOctaveX(p.x, p.z), formula::fxNextOctaveY(p.x, p.y, p.z),
             formula::fxNextOctaveZ(p.x, p.y, p.z)};
        amplitude *= gain;
        length *= 1.0f / 2.03f;
    }
    return {sum / std::sqrt(variance), std::max(1.0f - shown / variance, 0.0f)};
}

float placeOf(const FieldDetailNumbers& numbers, float extinction)
{
    return formula::fxDetailPlace(extinction, numbers.length(), numbers.thinnest, numbers.densest);
}

/// s', w' and a of field-detail.
struct SoftPlace
{
    float s, ramp, blur;

    SoftPlace(const FieldDetailNumbers& numbers, float extinction, float thinning)
        : blur(numbers.softening * thinning)
    {
        s = formula::fxDetailSoftPlace(placeOf(numbers, extinction), blur, numbers.thinnest, numbers.densest);
        ramp = formula::fxDetailSoftRamp(numbers.ramp, blur);
    }
};

} // namespace

float FieldDetailNumbers::length() const
{
    return (1.0f - fade) * generations[0].length / generations[0].growth +
           fade * generations[1].length / generations[1].growth;
}

FieldDetailNumbers fieldDetailNumbers(std::span<const float> constants)
{
    FieldDetailNumbers numbers;
    const auto younger = uint32_t(constants[constant::Generation]);
    const size_t slot = younger % 2;
    for (size_t g = 0; g < 2; ++g) {
        numbers.generations[g].length = constants[constant::Length0 + g];
        numbers.generations[g].growth = constants[constant::Growth0 + g];
        const uint32_t number = g == slot ? younger : younger + base::kGenerationCycle - 1;
        numbers.generations[g].offset = offsetOf(number % base::kGenerationCycle);
    }
    numbers.fade = slot == 1 ? constants[constant::Fade] : 1.0f - constants[constant::Fade];
    numbers.thinnest = constants[constant::Thinnest];
    numbers.densest = constants[constant::Densest];
    numbers.ramp = constants[constant::Ramp];
    numbers.gain = constants[constant::Gain];
    numbers.cooling = constants[constant::Cooling];
    numbers.glow = constants[constant::Glow];
    numbers.softening = constants[constant::Softening];
    numbers.isConserved = constants[constant::Lossy] < 0.5f;
    return numbers;
}

float thinningOf(const FieldDetailNumbers& numbers, float crossSection, float radius)
{
    return formula::fxDetailThinning(formula::fxKernelPeak(crossSection, radius) * numbers.length(),
                                     numbers.thinnest, numbers.densest);
}

MediumDetail detailAt(const FieldDetailNumbers& numbers, const LumpTile& tile, const SmoothMedium& medium,
                      float pixel, int octaves)
{
    const auto [s, ramp, blur] = SoftPlace(numbers, medium.extinction, medium.thinning);
    if (s <= 0.0f)
        return {0.0f, 1.0f, 0.0f};
    if (s >= 1.0f + ramp + kDeepest)
        return {}; // whole inside: no noise is needed
    const float gain = formula::fxDetailSoftGain(numbers.gain, blur);
    Octaves z[2];
    for (size_t g = 0; g < 2; ++g) {
        const FieldDetailNumbers::Generation& own = numbers.generations[g];
        z[g] = octavesAt(tile, medium.place[g] / own.length + own.offset, own.length / own.growth, gain,
                         pixel, octaves);
    }
    MediumDetail detail;
    detail.noise = formula::fxBlendGenerations(z[0].sum, z[1].sum, numbers.fade);
    const float faded = formula::fxBlendFaded(z[0].faded, z[1].faded, numbers.fade);
    const float h = formula::fxDetailThreshold(detail.noise);
    detail.share = formula::fxDetailShareOver(s, detail.noise, faded, ramp) * formula::fxDetailGain(s, ramp);
    detail.temperature =
        formula::fxDetailTemperature(1.0f, s, h, ramp, detail.noise, numbers.cooling, numbers.glow);
    return detail;
}

/// k n grows up to the place where m = 1/6; from there its logarithm is convex in s, so that the largest
/// value is at an end. n is no more than for w = 1 without softening, whatever the thinning.
float maxErodedExtinction(const FieldDetailNumbers& numbers, float most)
{
    constexpr float kMargin = 1.0f + 1e-5f;
    const bool isSoft = numbers.softening > 0.0f;
    const float w = isSoft ? 1.0f : numbers.ramp, s = placeOf(numbers, most);
    if (s <= 0.0f)
        return isSoft ? kMargin * kMaxDetailGain * most : 0.0f;
    const float capped = w > 1.0f / 3.0f ? std::sqrt(w / 3.0f) : 1.0f / 6.0f + 0.5f * w; // m = 1/6
    const float atEnd = most * formula::fxDetailGain(s, w);
    if (s <= capped)
        return kMargin * atEnd;
    const float extinction =
        numbers.thinnest / numbers.length() * std::pow(numbers.densest / numbers.thinnest, capped);
    return kMargin * std::max(atEnd, extinction * formula::fxDetailGain(capped, w));
}

float meanErodedShare(const FieldDetailNumbers& numbers, float extinction, float thinning)
{
    const auto [s, ramp, blur] = SoftPlace(numbers, extinction, thinning);
    return formula::fxDetailMean(s, ramp) * formula::fxDetailGain(s, ramp);
}

} // namespace fx::render
