/// @file gas_stage.h
/// Small boxes of gas for tests.
#pragma once

#include "simulation/sph/dynamics/gas_dynamics.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace fx::test {

inline double length(const glm::dvec3& v)
{
    return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

/// A periodic unit box for n^3 particles.
inline sim::GasDynamicsDef periodicBox(uint32_t n, sim::StepScheme steps = sim::StepScheme::Global)
{
    sim::GasDynamicsDef def;
    def.capacity = n * n * n;
    def.state.gamma = 5.0 / 3.0;
    def.steps = steps;
    def.domain.axes.fill(sim::AxisKind::Periodic);
    def.domain.low = glm::dvec3(0.0);
    def.domain.high = glm::dvec3(1.0);
    return def;
}

/// n^3 particles of density 1 in the unit box.
inline std::vector<sim::GasParticle> lattice(uint32_t n, double energy)
{
    std::vector<sim::GasParticle> particles;
    for (uint32_t k = 0; k < n; ++k)
        for (uint32_t j = 0; j < n; ++j)
            for (uint32_t i = 0; i < n; ++i) {
                sim::GasParticle particle;
                particle.position = (glm::dvec3(i, j, k) + 0.5) / double(n);
                particle.mass = 1.0 / (double(n) * n * n);
                particle.energy = energy;
                particles.push_back(particle);
            }
    return particles;
}

/// Distributes `joules` [J] equally among the `count` particles nearest to `center`. Particles at equal
/// distance are selected by smaller index.
inline void heatNearest(std::vector<sim::GasParticle>& particles, const glm::dvec3& center, uint32_t count,
                        double joules)
{
    std::vector<std::pair<double, size_t>> byDistance;
    for (size_t i = 0; i < particles.size(); ++i)
        byDistance.push_back({length(particles[i].position - center), i});
    std::sort(byDistance.begin(), byDistance.end());
    for (uint32_t k = 0; k < count; ++k)
        particles[byDistance[k].second].energy = joules / count / particles[byDistance[k].second].mass;
}

/// A gas with its particles, ready to run on the calling thread.
template <class T>
struct GasStage
{
    GasStage(const sim::GasDynamicsDef& def, const std::vector<sim::GasParticle>& particles)
        : tasks(base::makeSerialRunner()), gas(def, std::pmr::get_default_resource())
    {
        added = gas.add(particles);
        gas.initialize(*tasks);
        before = gas.totals();
    }
    sim::AdvanceReport advance(double seconds) { return gas.advance(seconds, *tasks).value(); }
    double energyError() const { return gas.totals().energy() / before.energy() - 1.0; }

    std::unique_ptr<base::TaskRunner> tasks;
    sim::GasDynamics<T> gas;
    base::Status added;
    sim::GasTotals before;
};

/// A blast of energy 1 J in the middle of cold gas.
template <class T>
GasStage<T> pointBlast(uint32_t n, sim::GasDynamicsDef def, double background = 1e-6)
{
    std::vector<sim::GasParticle> particles = lattice(n, background);
    heatNearest(particles, glm::dvec3(0.5), 32, 1.0);
    return GasStage<T>(def, particles);
}

} // namespace fx::test
