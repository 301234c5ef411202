#include "simulation/sph/gas_solver.h"

#include "foundation/snapshot/blob_kind.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/parallel.h"
#include "simulation/sph/gas_density.h"
#include "simulation/sph/gas_forces.h"
#include "simulation/sph/gas_optics.h"
#include "simulation/sph/gas_release.h"
#include "simulation/sph/wendland.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

namespace column = gas_column;
namespace sorted = gas_sorted;

constexpr uint32_t kMinBatch = 64; ///< particles; each has some sixty neighbors
constexpr float kCourant = 0.5f;   ///< [1] part of a smoothing length that sound may cross in a sub-step

/// State columns that the loops over neighbors need, and where they go.
constexpr size_t kGathered[][2] = {
    {column::X, sorted::X},
    {column::Y, sorted::Y},
    {column::Z, sorted::Z},
    {column::VelocityX, sorted::VelocityX},
    {column::VelocityY, sorted::VelocityY},
    {column::VelocityZ, sorted::VelocityZ},
    {column::Smoothing, sorted::Smoothing},
};

} // namespace

std::unique_ptr<Solver> GasDef::create(const base::SnapshotSchema& schema,
                                       std::pmr::memory_resource* memory) const
{
    return std::make_unique<GasSolver>(*this, schema.find(base::kBlobKind.name), memory);
}

GasSolver::GasSolver(const GasDef& def, base::KindId kind, std::pmr::memory_resource* memory)
    : def_(def), kind_(kind), gas_(memory, std::max(def.particles, 1u)),
      grid_(memory, std::max(def.particles, 1u)),
      released_(def.start > 0.0f ? base::toTicks(std::min(double(def.start), 1e9)) : 0)
{}

void GasSolver::step(const StepContext& context)
{
    now_ = context.tick + context.stepTicks;
    if (done_ || now_ <= released_ || (!begun_ && !release(context)))
        return;

    const GasMotion motion(def_, context, gas_);
    parallelRows(*context.tasks, gas_.count, kMinBatch,
                 [&](uint32_t begin, uint32_t end) { sampleAir(motion, gas_, begin, end); });
    const double seconds = base::toSeconds(now_ - std::max(context.tick, released_));
    double left = seconds;
    for (uint32_t n = 0; n < kMostGasSubSteps && left > 0.0; ++n)
        left -= subStep(motion, left);
    if (left > 0.0)
        ++context.counters->clamped;

    parallelRows(*context.tasks, gas_.count, kMinBatch, [&](uint32_t begin, uint32_t end) {
        coolGas(def_, gas_, float(seconds - left), begin, end);
    });
    retireWhenDissolved();
}

/// Lets the gas go, or never, when the host wants nothing new.
bool GasSolver::release(const StepContext& context)
{
    begun_ = true;
    done_ = !context.parameters->emitting || !(context.parameters->intensity > 0.0f);
    if (done_)
        return false;
    releaseGas(def_, context, gas_);
    context.counters->born += gas_.count;
    return true;
}

/// Advances by as much of `left` [s] as is stable and returns it.
double GasSolver::subStep(const GasMotion& motion, double left)
{
    base::TaskRunner& tasks = *motion.step.tasks;
    sortParticles();
    parallelRows(tasks, gas_.count, kMinBatch, [&](uint32_t begin, uint32_t end) {
        sumDensity(grid_, gas_, begin, end);
        for (uint32_t i = begin; i < end; ++i)
            gas_.sortedAt(sorted::Push)[i] =
                pressurePush(gas_.sortedAt(sorted::Density)[i], gas_.sortedAt(sorted::Equilibrium)[i],
                             gas_.sortedAt(sorted::Sound)[i]);
    });
    parallelRows(tasks, gas_.count, kMinBatch,
                 [&](uint32_t begin, uint32_t end) { sumForces(grid_, gas_, def_.viscosity, begin, end); });

    const double parts = std::ceil(left / double(stableSeconds()));
    const double seconds = parts > 1.0 ? left / parts : left;
    parallelRows(tasks, gas_.count, kMinBatch, [&](uint32_t begin, uint32_t end) {
        moveGas(motion, grid_, gas_, float(seconds), begin, end);
        adaptParticles(begin, end);
    });
    countWork(*motion.step.counters);
    return seconds;
}

void GasSolver::sortParticles()
{
    const float* const smoothing = gas_.at(column::Smoothing);
    const float largest = *std::max_element(smoothing, smoothing + gas_.count);
    grid_.build({gas_.columns[column::X].first(gas_.count), gas_.columns[column::Y].first(gas_.count),
                 gas_.columns[column::Z].first(gas_.count)},
                kWendlandSupport * largest);

    const std::span<const uint32_t> order = grid_.order();
    for (const auto& [from, to] : kGathered)
        for (uint32_t place = 0; place < gas_.count; ++place)
            gas_.sortedAt(to)[place] = gas_.at(from)[order[place]];
    for (uint32_t place = 0; place < gas_.count; ++place) {
        const float temperature = gas_.at(column::Temperature)[order[place]];
        const float mixing = gas_.at(column::Mixing)[order[place]];
        gas_.kernels[place] = Wendland(gas_.sortedAt(sorted::Smoothing)[place]);
        gas_.sortedAt(sorted::Sound)[place] = def_.soundSpeed * std::sqrt(temperature / def_.temperature);
        gas_.sortedAt(sorted::Equilibrium)[place] = kAirDensity * kAirTemperature / (temperature * mixing);
    }
}

/// The longest sub-step during which neither sound nor an approaching neighbor crosses too much of a
/// particle.
float GasSolver::stableSeconds() const
{
    float shortest = 1.0f;
    for (uint32_t i = 0; i < gas_.count; ++i) {
        const float sound = gas_.sortedAt(sorted::Sound)[i];
        const float signal =
            sound + 0.6f * def_.viscosity * (sound + 2.0f * gas_.sortedAt(sorted::Approach)[i]);
        shortest =
            std::min(shortest, kCourant * gas_.sortedAt(sorted::Smoothing)[i] / std::max(signal, 1e-3f));
    }
    return shortest;
}

void GasSolver::adaptParticles(uint32_t begin, uint32_t end)
{
    for (uint32_t place = begin; place < end; ++place) {
        float& smoothing = gas_.at(column::Smoothing)[grid_.order()[place]];
        smoothing = adaptSmoothing(smoothing, gas_.mass, gas_.sortedAt(sorted::Density)[place],
                                   gas_.sortedAt(sorted::Equilibrium)[place]);
    }
}

void GasSolver::countWork(StepCounters& counters) const
{
    uint64_t ordered = 0; // each pair is found by both of its particles
    for (uint32_t i = 0; i < gas_.count; ++i) {
        ordered += gas_.pairs[i];
        counters.clamped += gas_.clamped[i];
    }
    counters.neighborPairs += ordered / 2;
    counters.particleSteps += gas_.count;
    ++counters.subSteps;
}

void GasSolver::retireWhenDissolved()
{
    const float* const presence = gas_.at(column::Presence);
    const auto isGone = [](float p) { return p <= kFaintest; };
    if (!std::all_of(presence, presence + gas_.count, isGone))
        return;
    gas_.count = 0;
    done_ = true;
}

} // namespace fx::sim
