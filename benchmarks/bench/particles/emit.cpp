// fx bench emit: births. Every particle lives for one step, so that each step makes all of them anew: drawn
// from the instance's seed, stored, published.
#include "benchmarks/bench/particles/bench_stage.h"
#include "benchmarks/bench/particles/particle_rows.h"
#include "fxsdk/cli/support/interrupt.h"
#include "simulation/particles/particle_program.h"

#include <algorithm>
#include <array>
#include <limits>

namespace fx::cli {
namespace {

constexpr std::array<std::string_view, 3> kVariants{"point", "sphere", "cone"};
constexpr float kStepsPerSecond = 60.0f;

std::shared_ptr<const sim::EffectDef> emitter(std::string_view variant, uint64_t count)
{
    auto def = std::make_unique<sim::EmitterDef>();
    def->appearance.kind = sim::AppearanceKind::Sprite;
    def->maxParticles = uint32_t(2 * count + 16);
    def->lifetime = {1.0f / kStepsPerSecond, 1.0f / kStepsPerSecond};
    def->emission.rate = float(count) * kStepsPerSecond;
    def->emission.duration = std::numeric_limits<float>::infinity();
    def->speed = {1.0f, 3.0f};
    def->radius = {0.05f, 0.1f};
    if (variant == "sphere") {
        def->shape = sim::EmitterShape::Sphere;
        def->size = {0.5f, 0.0f, 0.0f};
    } else if (variant == "cone") {
        def->shape = sim::EmitterShape::Cone;
        def->size = {0.5f, 0.0f, 0.0f};
        def->angle = 0.5f;
    }
    auto effect = std::make_shared<sim::EffectDef>();
    effect->solvers.push_back(std::move(def));
    return effect;
}

/// [byte] that have to be written of each birth, and read and written to publish it.
double bytesOfBirth(const sim::EffectDef& effect)
{
    const sim::ParticleProgram program(static_cast<const sim::EmitterDef&>(*effect.solvers.front()));
    size_t stored = sizeof(base::Ticks) + sizeof(uint64_t) + (program.brief ? sizeof(uint32_t) : 0);
    for (const bool isStored : program.stores)
        stored += isStored ? sizeof(float) : 0;
    return double(stored + sim::bytesMoved(program));
}

base::Result<BenchRow> measure(const BenchSettings& settings, std::string_view variant)
{
    const std::shared_ptr<const sim::EffectDef> effect = emitter(variant, settings.count);
    BenchStage stage(settings.threads);
    stage.add(effect, 1);
    stage.play(4);
    const uint64_t before = stage.counters().born;
    const uint32_t steps = settings.steps > 0
                               ? settings.steps
                               : uint32_t(std::clamp<uint64_t>(20'000'000 / settings.count, 30, 500));
    for (uint32_t i = 0; i < steps; ++i) {
        if (interruptRequested())
            return interruptedStatus();
        stage.playTimed();
    }
    const double born = double(stage.counters().born - before) / double(steps);
    BenchRow row;
    row.medianNanoseconds = 1e9 * quantile(stage.times(), 0.5) / born;
    row.p95Nanoseconds = 1e9 * quantile(stage.times(), 0.95) / born;
    row.hash = stage.hash();
    row.bytesPerParticle = bytesOfBirth(*effect);
    row.bandwidthFraction = row.bytesPerParticle / row.medianNanoseconds /
                            copyGigabytes(stage.tasks(), row.bytesPerParticle * born);
    row.more = {{"ns_per_particle_min", 1e9 * quantile(stage.times(), 0.0) / born},
                {"born_per_step", born},
                {"steps", steps},
                {"dropped", stage.counters().dropped}};
    return row;
}

constexpr BenchEntry kEntry{"emit",          "Births: all particles are new in every step",
                            kVariants,       true,
                            false,           false,
                            40'000,          10'000'000,
                            "births a step", measure};

} // namespace

BenchMeasurement emitBench()
{
    return measurementOf(kEntry);
}

} // namespace fx::cli
