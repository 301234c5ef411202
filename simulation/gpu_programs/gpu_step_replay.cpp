// Steps that were taken without rows, taken again on the CPU.
#include "simulation/gpu_programs/gpu_replay.h"

#include "foundation/memory/arena.h"
#include "foundation/snapshot/gpu_particles.h"
#include "simulation/particles/tile_step.h"

#include <algorithm>
#include <limits>

namespace fx::sim {

namespace {

const InstanceParameters kNoParameters{};
constexpr base::Ticks kRounding = 16; ///< [tick] more than ages are rounded by, besides their 2^-20

} // namespace

base::Ticks longestKept(const ParticleProgram& program)
{
    return program.longestLife + program.longestLife / (1 << 20) + kRounding;
}

std::vector<ReplayStep> stepsOf(const base::SnapshotGroup& group, base::Ticks since)
{
    std::vector<ReplayStep> steps;
    const base::GpuParticleMoment moment = base::gpuMomentOf(group);
    for (uint32_t r = 0; r < moment.stepRuns; ++r) {
        const base::GpuStepRun run = base::gpuStepRunOf(group, moment, r);
        const base::Ticks begin = moment.now - run.age;
        for (uint32_t i = base::gpuStepsBefore(run, moment.now, since); i < run.count; ++i) {
            const base::Ticks at = begin + run.length * base::Ticks(i);
            steps.push_back({at,
                             at + run.length,
                             {run.gravity[0], run.gravity[1], run.gravity[2]},
                             {run.wind[0], run.wind[1], run.wind[2]},
                             run.ground});
        }
    }
    return steps;
}

StepContext contextOf(const ReplayStep& step, const BirthKey& key)
{
    StepContext context{};
    context.tick = step.begin;
    context.stepTicks = step.end - step.begin;
    context.seed = key.seed;
    context.solverIndex = key.solver;
    context.gravity = step.gravity;
    context.wind = step.wind;
    context.groundHeight = step.ground;
    context.parameters = &kNoParameters;
    return context;
}

AppearanceJob replaySteps(const ParticleProgram& program, const ReplayInput& in, ParticleStore& store)
{
    store.clear(in.first);
    store.placed = in.placed;
    std::vector<base::Ticks> ticks(in.next - in.first);
    in.ticksOf(in.first, ticks);
    std::vector<Birth> births;
    size_t born = 0;
    const auto bearUntil = [&](base::Ticks end) {
        births.clear();
        for (; born < ticks.size() && ticks[born] < end; ++born)
            births.push_back({in.first + born, ticks[born]});
        storeBirths(program, in.key, births, store);
        store.advance(births.size());
    };
    base::Arena scratch(std::pmr::get_default_resource());
    for (const ReplayStep& step : in.steps) {
        bearUntil(step.end);
        if (store.empty())
            continue;
        StepContext context = contextOf(step, in.key);
        context.scratch = &scratch;
        TileStep(program, context).run(store, 0, store.window().count);
        scratch.reset();
    }
    bearUntil(std::numeric_limits<base::Ticks>::max());
    store.retire(in.now);
    AppearanceJob job{&program, &store, {}, in.now, in.conditions[0].begin, in.conditions[0].pull};
    job.rows = store.window();
    return job;
}

} // namespace fx::sim
