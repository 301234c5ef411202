#include "tests/rendering/network/network_cases.h"

#include "foundation/random/philox.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::test {

using namespace render;

namespace {

constexpr double kSphere = 4.0 * std::numbers::pi;

double chance(uint64_t seed, uint32_t i, uint32_t k)
{
    return double(base::toUnitFloat(base::philox({i, k, 0, 0}, seed)[0]));
}

/// One sweep from the comment: radiance along each line, cell by cell.
std::vector<double> sweptOnce(const NetworkCase& c, const std::vector<double>& light)
{
    const NetworkPhase phase = networkPhase(c.settings.anisotropy, c.settings.moments);
    const size_t n = c.grid.count();
    std::vector<double> out(light.size(), 0.0);
    const auto directions = neighborDirections(c.settings.directions);
    for (size_t d = 0; d < directions.size(); ++d) {
        const glm::ivec3 step = directions[d].step;
        const double length = glm::length(glm::dvec3(step));
        const auto y = harmonics(glm::dvec3(step) / length);
        for (size_t start = 0; start < n; ++start) {
            glm::ivec3 cell(int(start) % c.grid.cells.x, int(start) / c.grid.cells.x % c.grid.cells.y,
                            int(start) / (c.grid.cells.x * c.grid.cells.y));
            const auto isInside = [&](const glm::ivec3& q) {
                return glm::all(glm::greaterThanEqual(q, glm::ivec3(0))) &&
                       glm::all(glm::lessThan(q, c.grid.cells));
            };
            if (isInside(cell - step))
                continue; // not the first of its line
            double radiance = c.environment.empty() ? 0.0 : double(c.environment[d]);
            for (; isInside(cell); cell += step) {
                const size_t i = c.grid.index(cell);
                const double albedo = double(c.albedo[i]), share = 1.0 - albedo * phase.peak;
                const double tau = double(c.extinction[i]) * share * c.grid.side * length;
                const double e = tau > 0.0 ? -std::expm1(-tau) / tau : 1.0;
                double source = share > 0.0 && !c.emission.empty() ? double(c.emission[i]) / share : 0.0;
                for (int k = 0; k < c.settings.moments; ++k)
                    source += albedo * (1.0 - phase.peak) / share * phase.factors[size_t(harmonicBand(k))] *
                              light[size_t(k) * n + i] * y[size_t(k)];
                const double mean = radiance * e + source * (1.0 - e);
                for (int k = 0; k < c.settings.moments; ++k)
                    out[size_t(k) * n + i] += directions[d].weight * y[size_t(k)] * mean;
                radiance += (source - radiance) * -std::expm1(-tau);
            }
        }
    }
    return out;
}

} // namespace

void NetworkCase::give(ScatteringNetwork& outNetwork) const
{
    ASSERT_TRUE(outNetwork.setMedium(medium(), settings).ok());
    if (!environment.empty()) {
        ASSERT_TRUE(outNetwork.setEnvironment(environment).ok());
    }
}

NetworkCase evenCase(const glm::ivec3& cells, float opticalDepth, float albedo,
                     const NetworkSettings& settings)
{
    NetworkCase c;
    c.grid = {glm::dvec3(0.0), 1.0 / cells.x, cells};
    c.settings = settings;
    c.extinction.assign(c.grid.count(), opticalDepth);
    c.albedo.assign(c.grid.count(), albedo);
    c.emission.assign(c.grid.count(), 0.0f);
    return c;
}

NetworkCase randomCase(uint64_t seed, const glm::ivec3& cells, double mostAlbedo)
{
    NetworkCase c;
    c.settings.directions = std::array{6, 14, 26}[size_t(3.0 * chance(seed, 0, 0))];
    c.settings.moments = c.settings.directions == 6 || chance(seed, 0, 1) < 0.5 ? 4 : 9;
    c.settings.anisotropy = -0.3 + 1.25 * chance(seed, 0, 2);
    c.grid = {glm::dvec3(-1.0), 0.1 + 2.0 * chance(seed, 0, 3), cells};
    for (uint32_t i = 0; i < c.grid.count(); ++i) {
        const double kind = chance(seed, i, 4);
        c.extinction.push_back(kind < 0.2 ? 0.0f : float(std::pow(10.0, 4.0 * chance(seed, i, 5) - 2.0)));
        c.albedo.push_back(kind > 0.9 ? 0.0f : float(mostAlbedo * std::sqrt(chance(seed, i, 6))));
        c.emission.push_back(chance(seed, i, 7) < 0.5 ? 0.0f : float(chance(seed, i, 8)));
    }
    for (uint32_t d = 0; d < uint32_t(c.settings.directions); ++d)
        c.environment.push_back(float(chance(seed, d, 9)));
    return c;
}

std::vector<double> solvedExactly(const NetworkCase& c)
{
    const size_t n = c.grid.count() * size_t(c.settings.moments);
    NetworkCase dark = c;
    std::fill(dark.emission.begin(), dark.emission.end(), 0.0f);
    dark.environment.clear();
    const std::vector<double> first = sweptOnce(c, std::vector<double>(n, 0.0));
    std::vector<std::vector<double>> rows(n, std::vector<double>(n + 1, 0.0)); // (1 - A) x = first
    for (size_t column = 0; column < n; ++column) {
        std::vector<double> unit(n, 0.0);
        unit[column] = 1.0;
        const std::vector<double> image = sweptOnce(dark, unit);
        for (size_t r = 0; r < n; ++r)
            rows[r][column] = (r == column ? 1.0 : 0.0) - image[r];
    }
    for (size_t r = 0; r < n; ++r)
        rows[r][n] = first[r];
    for (size_t p = 0; p < n; ++p) {
        size_t pivot = p;
        for (size_t r = p; r < n; ++r)
            if (std::abs(rows[r][p]) > std::abs(rows[pivot][p]))
                pivot = r;
        std::swap(rows[p], rows[pivot]);
        for (size_t r = p + 1; r < n; ++r) {
            const double share = rows[r][p] / rows[p][p];
            for (size_t k = p; share != 0.0 && k <= n; ++k)
                rows[r][k] -= share * rows[p][k];
        }
    }
    std::vector<double> x(n);
    for (size_t p = n; p-- > 0;) {
        double sum = rows[p][n];
        for (size_t k = p + 1; k < n; ++k)
            sum -= rows[p][k] * x[k];
        x[p] = sum / rows[p][p];
    }
    return x;
}

double scatteredError(const NetworkCase& c, const std::vector<float>& light, const std::vector<double>& exact)
{
    const NetworkPhase phase = networkPhase(c.settings.anisotropy, c.settings.moments);
    const size_t n = c.grid.count();
    double error = 0.0, scattered = 0.0;
    for (const NeighborDirection& d : neighborDirections(c.settings.directions)) {
        const auto y = harmonics(glm::normalize(glm::dvec3(d.step)));
        for (size_t i = 0; i < n; ++i) {
            double difference = 0.0;
            for (int k = 0; k < c.settings.moments; ++k) {
                const size_t at = size_t(k) * n + i;
                difference +=
                    phase.factors[size_t(harmonicBand(k))] * y[size_t(k)] * (double(light[at]) - exact[at]);
            }
            const double albedo = double(c.albedo[i]);
            const double weight = d.weight * double(c.extinction[i]) * albedo * (1.0 - phase.peak);
            error += weight * std::abs(difference);
            scattered += weight * exact[i] / std::sqrt(kSphere);
        }
    }
    return scattered > 0.0 ? error / scattered : 0.0;
}

} // namespace fx::test
