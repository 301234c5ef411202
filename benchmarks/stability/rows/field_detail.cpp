/// @file field_detail.cpp
/// FD-01 to FD-05: detail of fields at the ends of its ranges.

#include "benchmarks/stability/stability_row.h"
#include "foundation/snapshot/material_kind.h"
#include "rendering/field_detail/conservation_factor.h"
#include "rendering/reference/render/medium_details.h"
#include "shaders/formulas/formula.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory_resource>
#include <vector>

namespace fx::cli {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const render::LumpTile& tile()
{
    static const render::LumpTile shared;
    return shared;
}

render::FieldDetailNumbers numbersOf(double size)
{
    render::FieldDetailNumbers numbers;
    for (auto& generation : numbers.generations)
        generation.length = float(size);
    numbers.thinnest = 0.6f;
    numbers.densest = 40.0f;
    numbers.fade = 0.3f;
    numbers.cooling = 0.16f;
    numbers.glow = 0.09f;
    return numbers;
}

/// By how much a share leaves what is possible: 0 where nothing is left, 1 deep inside, else within the
/// largest gain.
double shareError(double share, double depth)
{
    if (!std::isfinite(share))
        return kInfinity;
    if (depth <= 0.6)
        return std::fabs(share);
    if (depth >= 40.0 * std::pow(40.0 / 0.6, 0.75))
        return std::fabs(share - 1.0);
    return std::fmax(std::fmax(-share, share - double(render::kMaxDetailGain)), 0.0);
}

std::vector<StabilitySweep> extinctions(bool isQuick)
{
    const StabilitySweep sweep{
        "extinction and size of billows of any magnitude",
        powersOfTen("extinction [1/m]", -36, 36, 3, isQuick),
        powersOfTen("billows [m]", -4, 4, 2, isQuick),
        1e-6,
        false,
        [](double extinction, double size) {
            render::SmoothMedium medium{float(extinction), {}};
            medium.place.fill(glm::vec3(float(0.37 * size)));
            const render::MediumDetail detail =
                render::detailAt(numbersOf(size), tile(), medium, float(1e-3 * size), 5);
            const double heat = std::isfinite(detail.temperature) ? double(detail.temperature) : kInfinity;
            return std::fmax(shareError(double(detail.share), double(float(extinction) * float(size))),
                             std::fmax(heat - 1.136, 0.704 - heat));
        }};
    return {sweep, controlOf(sweep, "without limits of the logarithm", [](double extinction, double size) {
                const float s = std::log(float(extinction) * float(size) / 0.6f) / std::log(40.0f / 0.6f);
                const float share = std::min((s - 0.5f) / 0.25f, 1.0f) / std::min(s - 0.125f, 1.0f);
                return shareError(double(share), double(float(extinction) * float(size)));
            })};
}

/// A share at a place, with everything moved by `away`.
double movedShare(double away, double at, bool isRelative)
{
    render::GroupDetail detail;
    detail.numbers = numbersOf(1.0);
    const glm::dvec3 origin(away, -0.3 * away, 0.7 * away), place(0.31 + at, 0.77, 0.13 - at);
    const glm::dvec3 none(0.0);
    for (size_t g = 0; g < 2; ++g) {
        detail.toCells[g] = glm::mat3(1.0f);
        detail.first[g] = isRelative ? glm::vec3(0.0f) : -glm::vec3(origin);
    }
    render::MediumDetails details;
    details.groups.push_back({detail, isRelative ? origin : none});
    const glm::dvec3 eye = isRelative ? origin + glm::dvec3(0.0, 0.0, 5.0) : none;
    render::PixelWidth pixel;
    pixel.constant = 1e-3;
    const render::DetailedMedium medium(details, render::BallTree(), eye, pixel);
    const glm::dvec3 seen = origin + place - eye;
    return double(medium.at(0, 8.0, {}, 0.0, isRelative ? seen : glm::dvec3(glm::vec3(seen))).share);
}

std::vector<StabilitySweep> places(bool isQuick)
{
    const auto error = [](bool isRelative) {
        return [isRelative](double away, double at) {
            return std::fabs(movedShare(away, at, isRelative) - movedShare(0.0, at, true));
        };
    };
    const StabilitySweep sweep{"an effect anywhere in the world",
                               powersOfTen("distance [m]", 0, 7, 4, isQuick),
                               evenSteps("place [m]", 0.0, 3.0, 60, isQuick),
                               2e-3,
                               false,
                               error(true)};
    return {sweep, controlOf(sweep, "places relative to the world, in float", error(false))};
}

/// Noise at a place whose older generation keeps its coordinates.
double noiseAt(uint32_t younger, double fade, double at)
{
    namespace constant = base::material_constant;
    std::array<float, constant::Count> constants{};
    constants[constant::Generation] = float(younger);
    constants[constant::Fade] = float(fade);
    for (const size_t c : {constant::Length0, constant::Length1, constant::Growth0, constant::Growth1})
        constants[c] = 1.0f;
    constants[constant::Thinnest] = 0.6f;
    constants[constant::Densest] = 40.0f;
    constants[constant::Ramp] = 0.25f;
    constants[constant::Gain] = 0.55f;
    render::SmoothMedium medium{8.0f, {}};
    medium.place.fill(glm::vec3(float(at), 0.4f, 0.9f));
    return double(render::detailAt(render::fieldDetailNumbers(constants), tile(), medium, 1e-3f, 5).noise);
}

std::vector<StabilitySweep> renewals(bool isQuick)
{
    const auto jump = [](double fadeAfter) {
        return [fadeAfter](double generation, double at) {
            const uint32_t before = uint32_t(generation);
            return std::fabs(noiseAt(before, 1.0, at) -
                             noiseAt((before + 1) % base::kGenerationCycle, fadeAfter, at));
        };
    };
    const StabilitySweep sweep{
        "from one generation to the next",
        values("generation", {0, 1, 2, 7, 4095, 65535, 65536, double(base::kGenerationCycle) - 1.0}),
        evenSteps("place [m]", 0.0, 8.0, 100, isQuick),
        1e-5,
        false,
        jump(0.0)};
    return {sweep, controlOf(sweep, "cut instead of faded", jump(1.0))};
}

std::vector<StabilitySweep> fades(bool isQuick)
{
    const auto error = [](bool keepsDeviation) {
        return [keepsDeviation](double fade, double octaves) {
            double squares = 0.0, variance = 0.0;
            for (int k = 0; k < int(octaves); ++k)
                variance += std::pow(0.55, 2 * k);
            for (int i = 0; i < 256; ++i) { // pairs of opposite signs: mean 0, deviation 1, independent
                const float z0 = i & 1 ? 1.0f : -1.0f, z1 = i & 2 ? 1.0f : -1.0f;
                const float z = keepsDeviation ? formula::fxBlendGenerations(z0, z1, float(fade))
                                               : (1.0f - float(fade)) * z0 + float(fade) * z1;
                squares += double(z) * double(z) / 256.0;
            }
            return std::fabs(squares - 1.0) * std::fmin(variance, 1.0);
        };
    };
    const StabilitySweep sweep{"contrast at any weight of a generation",
                               evenSteps("fade", 0.0, 1.0, 100, isQuick),
                               values("octaves", {1, 3, 5}),
                               1e-6,
                               false,
                               error(true)};
    return {sweep, controlOf(sweep, "weights that add up to 1", error(false))};
}

/// Factor of a heap of balls, each of the given optical depth through its middle.
/// @param isBounded false: what the formula gives without its bounds
double wholeFactor(double depth, double size, bool isBounded)
{
    render::GroupDetail detail;
    detail.numbers = numbersOf(size);
    for (size_t g = 0; g < 2; ++g)
        detail.toCells[g] = glm::mat3(float(1.0 / size));
    std::vector<render::DetailedCaster> balls;
    for (int i = 0; i < 27; ++i) {
        const glm::vec3 cells(float(i % 3), float(i / 3 % 3), float(i / 9));
        const auto section = float(depth * size * size);
        balls.push_back({{float(size) * 0.7f * cells, float(size), section}, {}, uint64_t(i)});
    }
    const double factor =
        double(render::ConservationFactor(std::pmr::get_default_resource()).of(detail, balls));
    if (isBounded)
        return factor;
    double left = 0.0; // of the mean over all noise
    for (const render::DetailedCaster& ball : balls)
        left += double(render::meanErodedShare(
            detail.numbers, formula::fxKernelPeak(ball.ball.crossSection, ball.ball.radius)));
    return double(balls.size()) / left;
}

std::vector<StabilitySweep> factors(bool isQuick)
{
    const auto error = [](bool isBounded) {
        return [isBounded](double depth, double size) {
            const double factor = wholeFactor(depth, size, isBounded);
            if (!std::isfinite(factor))
                return kInfinity;
            return std::fmax(std::fmax(factor - double(render::ConservationFactor::kMax),
                                       double(render::ConservationFactor::kMin) - factor),
                             0.0);
        };
    };
    const StabilitySweep sweep{"balls of any extinction and size",
                               powersOfTen("optical depth of a ball", -12, 12, 2, isQuick),
                               powersOfTen("billows [m]", -3, 3, 2, isQuick),
                               1e-6,
                               false,
                               error(true)};
    return {sweep, controlOf(sweep, "without bounds", error(false))};
}

} // namespace

StabilityRows fieldDetailStability()
{
    return {
        {"FD-01", "detail of any extinction, none among them", "0 below, 1 deep inside", extinctions},
        {"FD-02", "detail up to 1e7 m from the world's origin", "the same at the origin", places},
        {"FD-03", "renewal of coordinates, however often", "the noise before", renewals},
        {"FD-04", "two generations at any weight", "deviation 1", fades},
        {"FD-05", "the factor that keeps the whole extinction", "between 1/4 and 4", factors},
    };
}

} // namespace fx::cli
