/// @file network.cpp
/// IN-01 to IN-09: illumination networks of any medium.

#include "benchmarks/scenes/chance.h"
#include "benchmarks/stability/stability_row.h"
#include "foundation/tasks/task_runner.h"
#include "rendering/network/scattering_network.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <thread>
#include <vector>

namespace fx::cli {
namespace {

using render::NetworkGrid;
using render::NetworkState;
using render::ScatteringNetwork;
using render::SweepReport;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-5; // of light in float

/// Numbers of a medium, owned.
struct Medium
{
    NetworkGrid grid;
    std::vector<float> extinction, albedo, emission;
    double anisotropy = 0.0;

    bool give(ScatteringNetwork& out) const
    {
        return out.setMedium({grid, extinction, albedo, emission}, {26, 4, anisotropy}).ok();
    }
};

Medium evenMedium(int cells, double extinction, double albedo)
{
    Medium m;
    m.grid = {glm::dvec3(0.0), 1.0 / cells, glm::ivec3(cells)};
    m.extinction.assign(m.grid.count(), float(extinction));
    m.albedo.assign(m.grid.count(), float(albedo));
    m.emission.assign(m.grid.count(), float(1.0 - albedo));
    return m;
}

/// Of any extinction from 0.01 to 100, a fifth of it empty, whose largest albedo is given.
Medium randomMedium(double seed, int cells, double albedo)
{
    bench::Chance chance{uint64_t(seed)};
    Medium m = evenMedium(cells, 0.0, 0.0);
    m.anisotropy = chance.between(-0.3, 0.9);
    for (size_t i = 0; i < m.grid.count(); ++i) {
        m.extinction[i] = chance() < 0.2 ? 0.0f : float(std::pow(10.0, chance.between(-2.0, 2.0)));
        m.albedo[i] = float(albedo * (chance() < 0.5 ? 1.0 : chance()));
        m.emission[i] = float(chance());
    }
    return m;
}

/// One sweep in double, line by line. @param light moments; empty: none
std::vector<double> swept(const Medium& m, const std::vector<double>& light, bool isEmitting)
{
    const render::NetworkPhase phase = render::networkPhase(m.anisotropy, 4);
    const size_t n = m.grid.count();
    const auto isInside = [&](const glm::ivec3& c) {
        return std::min({c.x, c.y, c.z}) >= 0 && std::max({c.x, c.y, c.z}) < m.grid.cells.x;
    };
    std::vector<double> out(4 * n, 0.0);
    for (const render::NeighborDirection& d : render::neighborDirections(26)) {
        const double length = std::sqrt(double(d.squares));
        const auto y = render::harmonics(glm::dvec3(d.step) / length);
        for (size_t first = 0; first < n; ++first) {
            const int side = m.grid.cells.x;
            glm::ivec3 cell(int(first) % side, int(first) / side % side, int(first) / (side * side));
            if (isInside(cell - d.step))
                continue;
            for (double radiance = 0.0; isInside(cell); cell += d.step) {
                const size_t i = m.grid.index(cell);
                const double share = phase.extinctionShare(double(m.albedo[i]));
                const double tau = double(m.extinction[i]) * share * m.grid.side * length;
                double source = isEmitting ? double(m.emission[i]) / share : 0.0;
                for (size_t k = 0; k < 4; ++k)
                    source +=
                        phase.albedo(double(m.albedo[i])) * phase.factors[k > 0] * light[k * n + i] * y[k];
                const double e = tau > 0.0 ? -std::expm1(-tau) / tau : 1.0;
                for (size_t k = 0; k < 4; ++k)
                    out[k * n + i] += d.weight * y[k] * (radiance * e + source * (1.0 - e));
                radiance -= (source - radiance) * std::expm1(-tau);
            }
        }
    }
    return out;
}

/// Light at rest, by elimination.
std::vector<double> solved(const Medium& m)
{
    const size_t n = 4 * m.grid.count();
    std::vector<double> unit(n, 0.0), x = swept(m, unit, true);
    std::vector<std::vector<double>> columns;
    for (size_t c = 0; c < n; ++c) {
        unit[c] = 1.0;
        columns.push_back(swept(m, unit, false));
        unit[c] = 0.0;
        for (double& value : columns.back())
            value = -value;
        columns.back()[c] += 1.0;
    }
    for (size_t p = 0; p < n; ++p) // no pivots: the map is a contraction
        for (size_t r = p + 1; r < n; ++r) {
            const double share = columns[p][r] / columns[p][p];
            for (size_t c = p; share != 0.0 && c < n; ++c)
                columns[c][r] -= share * columns[c][p];
            x[r] -= share * x[p];
        }
    for (size_t p = n; p-- > 0;) {
        for (size_t c = p + 1; c < n; ++c)
            x[p] -= columns[c][p] * x[c];
        x[p] /= columns[p][p];
    }
    return x;
}

/// [1] difference of the scattered power, as a share of it.
template <class T>
double apart(const Medium& m, const std::vector<float>& light, const std::vector<T>& exact)
{
    double difference = 0.0, scattered = 0.0;
    for (size_t i = 0; i < m.grid.count(); ++i) {
        const double weight = double(m.extinction[i]) * double(m.albedo[i]);
        difference += weight * std::abs(double(light[i]) - double(exact[i]));
        scattered += weight * double(exact[i]);
    }
    return scattered > 0.0 ? difference / scattered : 0.0;
}

SweepReport sweep(ScatteringNetwork& network, NetworkState& state, int sweeps, double tolerance = 0.0)
{
    return network.sweep({sweeps, 2, tolerance}, state, *base::makeSerialRunner());
}

/// By how much light after some sweeps is farther from rest than `limit(report)` says.
template <class Limit>
double beyond(const Medium& m, int sweeps, Limit&& limit)
{
    ScatteringNetwork network;
    if (!m.give(network))
        return kInfinity;
    NetworkState state;
    const SweepReport report = sweep(network, state, sweeps);
    return std::max(apart(m, state.light, solved(m)) - limit(report), 0.0);
}

std::vector<StabilitySweep> albedos(bool isQuick)
{
    const auto error = [](auto limit) {
        return
            [limit](double albedo, double seed) { return beyond(randomMedium(seed, 2, albedo), 2, limit); };
    };
    const StabilitySweep bound{"bound after two sweeps",
                               values("albedo", {0.0, 0.5, 0.9, 0.99, 0.999, 1.0}),
                               evenSteps("medium", 0.0, 200.0, 200, isQuick),
                               kRounding,
                               false,
                               error([](const SweepReport& r) { return 1.5 * r.bound; })};
    const StabilitySweep refused{"albedos that are none",
                                 values("albedo", {1.0001, 2.0, -0.001, -1.0, 1e38}),
                                 values("cells", {1, 3}),
                                 0.0,
                                 false,
                                 [](double albedo, double cells) {
                                     ScatteringNetwork network;
                                     Medium m = evenMedium(int(cells), 1.0, 0.5);
                                     m.albedo.back() = float(albedo);
                                     return m.give(network) ? 1.0 : 0.0;
                                 }};
    return {bound, refused, controlOf(bound, "the last change as the bound", error([](const SweepReport& r) {
                                          return r.change;
                                      }))};
}

std::vector<StabilitySweep> balances(bool isQuick)
{
    const StabilitySweep sweeps{"emitted against absorbed and escaped",
                                powersOfTen("extinction [1/m]", -3, 3, 3, isQuick),
                                values("albedo", {0.0, 0.5, 0.9}),
                                kRounding,
                                false,
                                [](double extinction, double albedo) {
                                    Medium m = evenMedium(6, extinction, albedo);
                                    m.extinction[100] *= 5.0f;
                                    ScatteringNetwork network;
                                    m.give(network);
                                    NetworkState state;
                                    sweep(network, state, 200, 1e-7);
                                    const auto energy = network.energy(state, *base::makeSerialRunner());
                                    return std::abs((energy.absorbed + energy.escaped) / energy.emitted -
                                                    1.0);
                                }};
    return {sweeps, controlOf(sweeps, "light behind a cell as its mean", [](double extinction, double) {
                const double tau = extinction / 6.0;
                double light = 0.0, absorbed = 0.0;
                for (int i = 0; i < 6; ++i) {
                    light += (1.0 - light) * -std::expm1(-tau);
                    absorbed += tau * light;
                }
                return std::abs((absorbed + light) / (6.0 * tau) - 1.0);
            })};
}

std::vector<StabilitySweep> fewCells(bool)
{
    const StabilitySweep sweeps{
        "one cell and cells far apart, which scatter nothing",
        values("extinction [1/m]", {0.0, 1e-30, 1e-6, 1.0, 1e6, 1e30}),
        values("cells", {1, 2, 3}),
        2e-6,
        false,
        [](double extinction, double cells) {
            Medium m = evenMedium(int(cells), 0.0, 0.0);
            m.extinction[0] = float(extinction);
            ScatteringNetwork network;
            m.give(network);
            NetworkState state;
            sweep(network, state, 2);
            double mean = 0.0; // of (1 - e) over the directions
            for (const render::NeighborDirection& d : render::neighborDirections(26)) {
                const double tau = double(float(extinction)) * m.grid.side * std::sqrt(double(d.squares));
                mean +=
                    d.weight * (tau < 1e-6 ? 0.5 * tau : 1.0 + std::expm1(-tau) / tau) * 0.28209479177387814;
            }
            const double error = std::abs(double(state.light[0]) - mean);
            return std::isfinite(error) ? error : kInfinity;
        }};
    return {sweeps, controlOf(sweeps, "emission divided by extinction", [](double extinction, double) {
                const double share = (1.0 - std::exp(-extinction)) / extinction;
                return std::isfinite(share) ? 0.0 : kInfinity;
            })};
}

std::vector<StabilitySweep> extinctions(bool isQuick)
{
    const StabilitySweep sweeps{
        "equilibrium with a room of radiance 1",
        powersOfTen("extinction [1/m]", -38, 38, 1, isQuick),
        values("albedo", {0.0, 0.5, 1.0}),
        kRounding,
        false,
        [](double extinction, double albedo) {
            const Medium m = evenMedium(3, extinction, albedo);
            ScatteringNetwork network;
            m.give(network);
            (void)network.setEnvironment(std::vector<float>(26, 1.0f));
            const float one = float(std::sqrt(4.0 * std::numbers::pi));
            NetworkState state{m.grid, 4, std::vector<float>(4 * m.grid.count(), 0.0f)};
            std::fill_n(state.light.begin(), m.grid.count(), one);
            sweep(network, state, 4);
            double worst = 0.0;
            for (size_t i = 0; i < m.grid.count(); ++i)
                worst = std::max(worst, std::abs(double(state.light[i] / one) - 1.0));
            return std::isfinite(double(state.light[13])) ? worst : kInfinity;
        }};
    return {sweeps, controlOf(sweeps, "1 - exp(-tau) over tau in float", [](double extinction, double) {
                const float tau = float(extinction), share = (1.0f - std::exp(-tau)) / tau;
                const double exact = -std::expm1(-double(tau)) / double(tau);
                return std::isfinite(share) ? std::abs(double(share) / exact - 1.0) : kInfinity;
            })};
}

std::vector<StabilitySweep> reciprocities(bool isQuick)
{
    const StabilitySweep sweeps{"light of a cell in another, and the other way round",
                                evenSteps("medium", 0.0, 40.0, 40, isQuick),
                                values("albedo", {0.0, 0.5, 0.95}),
                                5.0 * kRounding,
                                false,
                                [](double seed, double albedo) {
                                    Medium m = randomMedium(seed, 4, albedo);
                                    m.extinction[5] = 2.0f;
                                    m.extinction[58] = 0.3f;
                                    const auto received = [&](size_t from, size_t to) {
                                        std::fill(m.emission.begin(), m.emission.end(), 0.0f);
                                        m.emission[from] = 1.0f;
                                        ScatteringNetwork network;
                                        m.give(network);
                                        NetworkState state;
                                        sweep(network, state, 300, 1e-7);
                                        return double(state.light[to]) / double(m.extinction[from]);
                                    };
                                    const double there = received(5, 58), back = received(58, 5);
                                    return there > 1e-20 ? std::abs(back / there - 1.0) : 0.0;
                                }};
    return {sweeps, controlOf(sweeps, "light behind a cell as its mean", [](double, double) {
                const double first = -std::expm1(-2.0) * std::exp(-0.3) / 2.0;
                const double second = -std::expm1(-0.3) * std::exp(-2.0) / 0.3;
                return std::abs(second / first - 1.0);
            })};
}

std::vector<StabilitySweep> closed(bool)
{
    const StabilitySweep sweeps{
        "albedo 1 that nothing leaves",
        values("extinction [1/m]", {1e6, 1e10, 1e30}),
        values("sweeps", {1, 10, 100}),
        0.0,
        false,
        [](double extinction, double count) {
            Medium m = evenMedium(4, extinction, 1.0);
            std::fill(m.emission.begin(), m.emission.end(), 1.0f);
            ScatteringNetwork network;
            m.give(network);
            NetworkState state;
            const SweepReport report = sweep(network, state, int(count), 1e-9);
            const bool isFinite = std::isfinite(report.bound) &&
                                  std::ranges::all_of(state.light, [](float v) { return std::isfinite(v); });
            return isFinite && report.bound > 0.1 ? 0.0 : 1.0;
        }};
    return {sweeps, controlOf(sweeps, "q / (1 - q) of a largest albedo of 1",
                              [](double, double) { return kInfinity; })};
}

/// Threads, also more than the machine has processors.
struct Workers
{
    uint32_t count;

    std::unique_ptr<base::TaskRunner> runner() { return base::makeHostRunner({this, run}); }
    static void run(void* self, uint32_t count, uint32_t minBatch, base::LoopBody body, void* argument)
    {
        const uint32_t most = static_cast<Workers*>(self)->count;
        const uint32_t each = std::max((count + most - 1) / most, minBatch);
        std::vector<std::thread> threads;
        for (uint32_t begin = 0; begin < count; begin += each)
            threads.emplace_back([=] { body(argument, begin, std::min(begin + each, count)); });
        for (std::thread& thread : threads)
            thread.join();
    }
};

std::vector<StabilitySweep> workers(bool isQuick)
{
    const StabilitySweep sweeps{"numbers that differ from those of one worker",
                                evenSteps("workers", 1.0, 16.0, 15, isQuick),
                                values("medium", {1, 2, 3}),
                                0.0,
                                false,
                                [](double count, double seed) {
                                    const Medium m = randomMedium(seed, 6, 0.95);
                                    const auto light = [&](base::TaskRunner& tasks) {
                                        ScatteringNetwork network;
                                        m.give(network);
                                        NetworkState state;
                                        network.sweep({5, 3, 0.0}, state, tasks);
                                        return state.light;
                                    };
                                    const auto one = light(*base::makeSerialRunner());
                                    const auto many =
                                        light(*base::makeTbbRunner(uint32_t(std::lround(count))));
                                    double different = 0.0;
                                    for (size_t i = 0; i < one.size(); ++i)
                                        different += one[i] != many[i];
                                    return different;
                                }};
    return {sweeps,
            controlOf(sweeps, "sums in the order in which workers end", [](double count, double seed) {
                bench::Chance chance{uint64_t(seed)};
                std::vector<float> light(26);
                double different = 0.0;
                for (int cell = 0; cell < 216; ++cell) {
                    float forward = 0.0f, turned = 0.0f;
                    for (float& value : light)
                        value = float(chance());
                    for (size_t d = 0; d < 26; ++d) {
                        forward += light[d];
                        turned += light[(d + size_t(count)) % 26];
                    }
                    different += forward != turned;
                }
                return different;
            })};
}

std::vector<StabilitySweep> eliminations(bool isQuick)
{
    const auto error = [](int sweeps) {
        return [sweeps](double cells, double albedo) {
            const Medium m = randomMedium(cells, int(cells), albedo);
            return beyond(m, sweeps, [&](const SweepReport& r) { return sweeps > 1 ? 1.5 * r.bound : 0.0; });
        };
    };
    const StabilitySweep sweeps{"light after 60 sweeps against elimination",
                                values("cells along an axis", isQuick ? std::vector<double>{1, 2, 3}
                                                                      : std::vector<double>{1, 2, 3, 4, 5}),
                                values("albedo", {0.5, 0.9, 0.99}),
                                kRounding,
                                false,
                                error(60)};
    return {sweeps, controlOf(sweeps, "light that is scattered once", error(1))};
}

std::vector<StabilitySweep> warmStarts(bool isQuick)
{
    const auto error = [](bool isResampled) {
        return [isResampled](double seed, double cells) {
            const Medium m = randomMedium(seed, 6, 0.9);
            Medium before = m;
            before.grid.corner += cells * m.grid.side;
            ScatteringNetwork network, earlier;
            m.give(network);
            before.give(earlier);
            NetworkState cold, warm;
            const SweepReport first = sweep(network, cold, 200, 1e-6);
            sweep(earlier, warm, 200, 1e-6);
            if (!isResampled) {
                warm.grid = m.grid;
                std::reverse(warm.light.begin(), warm.light.end()); // light of other cells
                return apart(m, warm.light, cold.light);
            }
            const SweepReport second = sweep(network, warm, 200, 1e-6);
            return std::max(apart(m, warm.light, cold.light) - 1.5 * (first.bound + second.bound), 0.0);
        };
    };
    const StabilitySweep sweeps{"light of a moved box against none",
                                evenSteps("medium", 0.0, 20.0, 20, isQuick),
                                values("cells", {0.3, 1.0, 20.0}),
                                kRounding,
                                false,
                                error(true)};
    return {sweeps, controlOf(sweeps, "light of other cells, not swept", error(false))};
}

} // namespace

StabilityRows networkStability()
{
    return {
        {"IN-01", "albedo up to 1, and beyond", "elimination in double; the bound", albedos},
        {"IN-02", "balance of energy", "what is emitted", balances},
        {"IN-03", "one cell, isolated cells, none", "the mean along its lines", fewCells},
        {"IN-04", "any extinction, none among them", "a room of radiance 1", extinctions},
        {"IN-05", "reciprocity", "the way back", reciprocities},
        {"IN-06", "closed, albedo 1", "finite, and the bound says that it is not at rest", closed},
        {"IN-07", "number of workers", "one worker", workers},
        {"IN-08", "light at rest", "elimination in double; the bound", eliminations},
        {"IN-09", "start from light of another box", "start from none", warmStarts},
    };
}

} // namespace fx::cli
