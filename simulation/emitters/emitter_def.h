/// @file emitter_def.h
/// The definition of an emitter: its settings, and the creation of its solvers.
#pragma once

#include "simulation/detail/field_detail.h"
#include "simulation/particles/emitter_settings.h"
#include "simulation/solver/solver.h"

#include <memory>
#include <mutex>
#include <vector>

namespace fx::sim {

struct ParticleProgram;

/// Compiled program shared by all solvers of a definition. The first solver creates the program. A copy of a
/// definition creates its own program.
class SharedProgram
{
public:
    SharedProgram() = default;
    SharedProgram(const SharedProgram&) {}
    SharedProgram& operator=(const SharedProgram&) { return *this; }

    /// [any thread]
    std::shared_ptr<const ParticleProgram> of(const EmitterSettings& settings) const;

private:
    mutable std::mutex mutex_;
    mutable std::weak_ptr<const ParticleProgram> program_;
};

/// Definition of an emitter. The definition must not change while solvers of it exist.
struct EmitterDef final : SolverDef, EmitterSettings
{
    SharedProgram program;
    FieldDetail detail; ///< detail of the field of a medium

    std::unique_ptr<Solver> create(const base::SnapshotSchema& schema, const Quality& quality,
                                   std::pmr::memory_resource* memory) const override;
    uint32_t capacity() const override { return maxParticles; }
    uint64_t bytes() const override;
    double workOf(const StepLoad& load) const override;
    bool publishes(const base::KindDesc& kind) const override;
    bool bendsLight() const override { return appearance.kind == AppearanceKind::Medium && heat > 0.0f; }
    /// True if the particles of the emitter have coordinates for the detail of the field.
    bool hasDetail() const { return detail.given && appearance.kind == AppearanceKind::Medium; }
    std::shared_ptr<const base::GpuParticleProgram> gpuProgram() const override;
    Influence influence() const override;
    bool collides() const override;
    bool dependsOnPlacement() const override { return inWorld; }
    bool followsThermals() const override { return forces.updraft > 0.0f; }
    /// Policy of hidden instances. The policy is Analytic if the state is a pure function of time. This
    /// requires motion in closed form, without events, trails or motion of the instance. In all other cases,
    /// the policy is Replay.
    CatchUp catchUp() const override
    {
        const bool isAlone = !fed && events.empty() && !inWorld && !(trail.lifetime > 0.0f);
        return isBallistic() && isAlone && !hasDetail() ? CatchUp::Analytic : CatchUp::Replay;
    }
    float reach(float gravity, float wind, float seconds) const override
    {
        return reachFrom({gravity, wind, seconds}, {}, {});
    }
    float reachFrom(const ReachConditions& conditions, const BirthReach& births,
                    std::span<BirthReach> ioOthers) const override;
};

struct EffectDef;

/// Returns the definitions of the emitters of an effect, indexed by solver; null for solvers that are not
/// emitters. The function is for code that inspects emitters. All other code uses SolverDef.
std::vector<const EmitterDef*> emittersOf(const EffectDef& effect);

} // namespace fx::sim
