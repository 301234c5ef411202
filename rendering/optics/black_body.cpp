#include "rendering/optics/black_body.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace fx::render {

namespace {

constexpr double kCoolest = 400.0;   // [K] darker than 1e-6 cd/m2 below
constexpr double kHottest = 10000.0; // [K]
constexpr int kEntries = 256;

/// Planck's law (1) [W/(m2 sr m)].
double spectralRadiance(double wavelength, double temperature)
{
    constexpr double kFirst = 1.191042972e-16; // 2 h c^2 [W m2 / sr]
    constexpr double kSecond = 1.438776877e-2; // h c / k [m K]
    const double l5 = std::pow(wavelength, 5.0);
    return kFirst / l5 / std::expm1(kSecond / (wavelength * temperature));
}

/// One lobe of the fit: a Gaussian with different widths on both sides [nm].
double lobe(double x, double mean, double left, double right)
{
    const double t = (x - mean) * (x < mean ? left : right);
    return std::exp(-0.5 * t * t);
}

/// CIE 1931 2-degree color matching functions at `nm`, fit of [WSS13].
glm::dvec3 colorMatching(double nm)
{
    return {1.056 * lobe(nm, 599.8, 1 / 37.9, 1 / 31.0) + 0.362 * lobe(nm, 442.0, 1 / 16.0, 1 / 26.7) -
                0.065 * lobe(nm, 501.1, 1 / 20.4, 1 / 26.2),
            0.821 * lobe(nm, 568.8, 1 / 46.9, 1 / 40.5) + 0.286 * lobe(nm, 530.9, 1 / 16.3, 1 / 31.1),
            1.217 * lobe(nm, 437.0, 1 / 11.8, 1 / 36.0) + 0.681 * lobe(nm, 459.0, 1 / 26.0, 1 / 13.8)};
}

/// Logarithms of the table, one temperature each; kDark where a channel is 0.
struct Table
{
    static constexpr float kDark = -100.0f;
    std::array<glm::vec3, kEntries> logRgb;

    Table()
    {
        for (int i = 0; i < kEntries; ++i) {
            const double t = 1.0 / inverse(i);
            const glm::dvec3 rgb = integrateBlackBody(t);
            for (int c = 0; c < 3; ++c)
                logRgb[size_t(i)][c] = rgb[c] > 1e-40 ? float(std::log(rgb[c])) : kDark;
        }
    }

    /// 1 / T of entry i [1/K].
    static double inverse(double i)
    {
        return 1 / kCoolest + (1 / kHottest - 1 / kCoolest) * i / (kEntries - 1);
    }
    /// Entry of 1 / T, fractional.
    static double entry(double inverseT)
    {
        return (inverseT - 1 / kCoolest) / (1 / kHottest - 1 / kCoolest) * (kEntries - 1);
    }
};

} // namespace

glm::dvec3 integrateBlackBody(double temperature)
{
    glm::dvec3 xyz(0.0);
    for (int nm = 380; nm <= 780; nm += 5)
        xyz += colorMatching(nm) * spectralRadiance(nm * 1e-9, temperature) * 5e-9; // (2)
    xyz *= 683.0;
    const glm::dvec3 rgb(3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
                         -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
                         0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z); // (3)
    return glm::max(rgb, glm::dvec3(0.0));
}

glm::vec3 blackBodyLuminance(float temperature)
{
    static const Table table; // built at the first use, constant afterwards
    if (!(temperature > float(kCoolest)))
        return glm::vec3(0.0f);
    const double e = std::min(Table::entry(1.0 / double(temperature)), double(kEntries - 1));
    const int i = std::clamp(int(e), 0, kEntries - 2);
    const float f = float(e - i);
    glm::vec3 rgb;
    for (int c = 0; c < 3; ++c) {
        const float a = table.logRgb[size_t(i)][c];
        const float b = table.logRgb[size_t(i) + 1][c];
        rgb[c] = a == Table::kDark || b == Table::kDark ? 0.0f : std::exp(a + f * (b - a));
    }
    return rgb;
}

} // namespace fx::render
