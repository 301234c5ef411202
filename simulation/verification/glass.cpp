#include "simulation/verification/glass.h"

#include "foundation/random/philox.h"
#include "simulation/sph/dynamics/gas_dynamics.h"
#include "simulation/verification/lattice.h"

#include <memory_resource>

namespace fx::sim {
namespace {

constexpr double kShake = 0.3;    ///< [1] of the distance of particles, either way
constexpr double kEnergy = 0.9;   ///< [J/kg] for a speed of sound of 1
constexpr int kRounds = 40;       ///< after which the density no longer gets more even
constexpr double kRound = 0.6;    ///< [s] in which sound passes 0.6 of the distance of particles
constexpr uint64_t kSeed = 20040; ///< any number

glm::dvec3 shaken(const glm::dvec3& position, uint32_t index)
{
    const base::Random4 words = base::philox({index, 0, 0, uint32_t(base::RandomPurpose::Position)}, kSeed);
    const auto shift = [&](size_t a) { return kShake * (2 * double(base::toUnitFloat(words[a])) - 1); };
    return position + glm::dvec3(shift(0), shift(1), shift(2));
}

} // namespace

std::vector<glm::dvec3> glassBox(const glm::u32vec3& count, double neighbors)
{
    GasDynamicsDef def;
    def.capacity = count.x * count.y * count.z;
    def.neighbors = neighbors;
    def.state.gamma = 5.0 / 3.0;
    def.steps = StepScheme::Global;
    def.viscosity.alphaMin = def.viscosity.alphaMax = 1; // motion is waste here
    def.domain.axes.fill(AxisKind::Periodic);
    def.domain.low = glm::dvec3(0);
    def.domain.high = glm::dvec3(count);
    std::vector<GasParticle> particles;
    Lattice{glm::dvec3(0), 1, count}.forEach([&](const glm::dvec3& position) {
        particles.push_back({shaken(position, uint32_t(particles.size())), glm::dvec3(0), 1, kEnergy});
    });

    const auto tasks = base::makeSerialRunner();
    GasDynamics<double> gas(def, std::pmr::get_default_resource());
    (void)gas.add(particles); // positions are within the box, or wrapped by at most one period
    for (int round = 0; round < kRounds; ++round) {
        (void)gas.advance(kRound, *tasks);
        const GasView<double> view = gas.view();
        for (uint32_t i = 0; i < view.count; ++i)
            view.vx[i] = view.vy[i] = view.vz[i] = 0;
        gas.edited();
        for (uint32_t id = 0; id < gas.count(); ++id)
            gas.setEnergy(id, kEnergy);
    }
    std::vector<glm::dvec3> positions(particles.size());
    for (uint32_t id = 0; id < gas.count(); ++id)
        positions[id] = gas.particle(id).position;
    return positions;
}

} // namespace fx::sim
