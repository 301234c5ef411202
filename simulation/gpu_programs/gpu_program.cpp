#include "simulation/gpu_programs/gpu_program.h"

#include "simulation/gpu_programs/gpu_replay.h"
#include "simulation/particles/builtin_ops.h"
#include "simulation/particles/gpu_module_source.h"
#include "simulation/particles/particle_program.h"
#include "simulation/particles/reach/particle_reach.h"
#include "simulation/particles/shapes/shape_sample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>

#ifndef FXSDK_GPU_PARTICLES
#define FXSDK_GPU_PARTICLES 0
#endif

namespace fx::sim {

namespace {

constexpr uint32_t kMaxRows = 65535u * 256u; // of the work groups that every OpenGL 4.5 can be asked for
constexpr size_t kMaxModules = 48;

bool changesRate(const Emission& emission)
{
    const auto& curve = emission.rateOverTime;
    for (size_t i = 0; i <= base::kCurveSamples; ++i)
        if (curve.at(float(i) / float(base::kCurveSamples))[0] != curve.at(0.0f)[0])
            return emission.rate > 0.0f;
    return false;
}

bool isKnown(const ShapeOp& births)
{
    const ShapeDef* const shape = shapeOf(births);
    return shape && shape->kind < ShapeKind::Mesh;
}

using Ops = std::vector<std::shared_ptr<const TileOp>>;

/// As ParticleProgram has them.
Ops opsOf(const EmitterSettings& def)
{
    Ops ops;
    addBuiltinOps(def, ops);
    ops.insert(ops.end(), def.modules.begin(), def.modules.end());
    std::stable_sort(ops.begin(), ops.end(),
                     [](const auto& a, const auto& b) { return a->phase() < b->phase(); });
    return ops;
}

constexpr size_t kScratchBytes = 8192; ///< of what modules prepare for a step

/// Where what each module prepares begins, and after the last one the end.
std::vector<size_t> scratchPlaces(const Ops& ops)
{
    std::vector<size_t> places{0};
    for (const auto& op : ops)
        places.push_back(places.back() + (op->scratchBytes() + 63) / 64 * 64);
    return places;
}

std::string_view obstacleOfSteps(const EmitterSettings& def)
{
    constexpr float kSome = 10.0f;
    constexpr float kLongestLife = 0.75f * float(base::kMaxGpuSteps) / 60.0f; // at the usual step
    if (std::max(def.lifetime.min, def.lifetime.max) > kLongestLife)
        return "its particles live through too many steps";
    const Ops ops = opsOf(def);
    base::GpuModules modules;
    for (const auto& op : ops)
        if (const GpuModuleSource* const source = gpuSourceOf(*op); !source || !source->describe(modules))
            return "it meets a mesh or a height field, or is drawn to a mesh, or its vector field is too "
                   "large";
    if (scratchPlaces(ops).back() > kScratchBytes || modules.uses.size() > kMaxModules)
        return "it has too many modules";
    ConditionsRange conditions;
    conditions.strongest = {kSome, kSome, kSome};
    const base::Bounds bounds = boundsOfStepped(def, conditions);
    return std::isfinite(bounds.max.x) ? "" : "nothing says how far its particles may get";
}

/// What the emitter does besides being drawn, or does without support in shaders.
std::string_view obstacleOfModules(const EmitterSettings& def)
{
    if (def.births && !isKnown(*def.births))
        return "its shape is a mesh, a spline or a volume";
    if (changesRate(def.emission))
        return "its rate of births changes";
    if (def.forces.updraft > 0.0f)
        return "it follows the air around the effect's gas";
    return def.isBallistic() ? "" : obstacleOfSteps(def);
}

/// The emitter itself goes along, so that its rows can be made anywhere and at any time.
class EmitterGpuProgram final : public base::GpuParticleProgram
{
public:
    explicit EmitterGpuProgram(const EmitterSettings& def)
        : def_(def), program_((def_.compute = ComputeOn::Cpu, def_))
    {
        numbers = gpuNumbersOf(def_, program_);
        features.shape = gpuShapeOf(def_);
        features.turned = numbers.axis[1] != 1.0f;
        features.frames = def_.appearance.frames == FrameClock::OverLife    ? base::GpuFrames::OverLife
                          : def_.appearance.frames == FrameClock::PerSecond ? base::GpuFrames::PerSecond
                                                                            : base::GpuFrames::First;
        features.brief = program_.brief;
        features.lifeVaries = program_.stores[stored::PerLife];
        features.drags = numbers.drag > 0.0f;
        features.bySpeed = program_.bySpeed != nullptr;
        features.wide = def_.births != nullptr;
        features.lifeTable = program_.byLife.byTable;
        features.speedTable = features.bySpeed && program_.bySpeed->byTable;
        features.columns = program_.published;
        if (!program_.ballistic)
            setModules();
        rows = std::max(def_.maxParticles, 1u);
        float size = 0.0f;
        for (const float sample : samplesOf(def_.sizeOverLife, 0))
            size += sample / float(base::kGpuCurveSamples);
        meanRadius = 0.5f * (numbers.radius[0] + numbers.radius[1]) * size;
    }

    void replay(const base::SnapshotGroup& group, base::FrameSnapshot& out) const override
    {
        replayGroup(program_, group, out);
    }
    void writeSteps(const base::SnapshotGroup& group, int64_t since,
                    std::vector<uint32_t>& out) const override
    {
        const base::GpuParticleMoment moment = base::gpuMomentOf(group);
        const base::Ticks from = std::max(since, moment.now - longestKept(program_));
        for (uint32_t r = 0; r < moment.stepRuns; ++r) {
            const base::GpuStepRun run = base::gpuStepRunOf(group, moment, r);
            for (uint32_t i = base::gpuStepsBefore(run, moment.now, from); i < run.count; ++i)
                writeStep(moment, run, i, out);
        }
    }

private:
    void setModules()
    {
        base::GpuModules modules;
        for (const auto& op : program_.ops) {
            wordPlaces_.push_back(modules.stepWords);
            sources_.push_back(gpuSourceOf(*op));
            sources_.back()->describe(modules);
        }
        features.steps = true;
        features.modules = std::move(modules.uses);
        moduleNumbers = std::move(modules.numbers);
        features.stepWords = base::kGpuStepHead + modules.stepWords;
        kills = modules.kills;
        dependsOnHost = modules.dependsOnHost;
        places_ = scratchPlaces(program_.ops);
    }

    void writeStep(const base::GpuParticleMoment& moment, const base::GpuStepRun& run, uint32_t number,
                   std::vector<uint32_t>& out) const
    {
        const base::Ticks begin = moment.now - run.age + run.length * base::Ticks(number);
        const glm::vec3 gravity(run.gravity[0], run.gravity[1], run.gravity[2]);
        const StepContext step = contextOf(
            {begin, begin + run.length, gravity, {run.wind[0], run.wind[1], run.wind[2]}, run.ground},
            {moment.seed, moment.solver});
        const TileContext context{step, begin + run.length, step.wind + def_.forces.wind,
                                  base::toSeconds(begin), step.seconds()};
        const glm::vec3& wind = context.wind;
        const base::GpuStepWords head{moment.now - context.end,
                                      uint32_t(run.length),
                                      context.seconds,
                                      {gravity.x, gravity.y, gravity.z},
                                      {wind.x, wind.y, wind.z},
                                      run.ground,
                                      0};
        const size_t at = out.size();
        out.resize(at + features.stepWords);
        std::memcpy(&out[at], &head, sizeof head);
        alignas(64) std::array<std::byte, kScratchBytes> scratch;
        uint32_t* const words = out.data() + at + base::kGpuStepHead;
        for (size_t k = 0; k < program_.ops.size(); ++k) {
            const TileOp& op = *program_.ops[k];
            op.prepare(context, scratch.data() + places_[k]);
            sources_[k]->writeWords(scratch.data() + places_[k], words + wordPlaces_[k]);
        }
    }

    EmitterSettings def_;
    ParticleProgram program_;
    std::vector<size_t> places_; ///< of what modules prepare
    std::vector<uint32_t> wordPlaces_;
    std::vector<const GpuModuleSource*> sources_; ///< the program's modules
};

} // namespace

std::string_view gpuObstacle(const EmitterSettings& def)
{
    if (!FXSDK_GPU_PARTICLES)
        return "the library was built without FXSDK_GPU_PARTICLES";
    if (def.compute == ComputeOn::Cpu)
        return "its preset does not ask for the GPU";
    if (def.compute == ComputeOn::Auto && def.maxParticles < kManyParticles)
        return "it has too few particles to be worth it";
    if (def.appearance.kind == AppearanceKind::Medium)
        return "media are lit on the CPU";
    if (def.appearance.kind == AppearanceKind::None)
        return "it is not drawn";
    if (def.fed || !def.events.empty())
        return "it takes part in events";
    if (def.trail.lifetime > 0.0f)
        return "its particles leave trails";
    if (def.inWorld)
        return "its particles stay behind in the world";
    if (def.light.given)
        return "its particles are lights for the host";
    if (def.maxParticles > kMaxRows)
        return "it has more particles than one dispatch reaches";
    return obstacleOfModules(def);
}

std::shared_ptr<const base::GpuParticleProgram> makeGpuProgram(const EmitterSettings& def)
{
    return std::make_shared<const EmitterGpuProgram>(def);
}

} // namespace fx::sim
