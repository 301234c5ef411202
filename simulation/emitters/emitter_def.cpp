#include "simulation/emitters/emitter_def.h"

#include "foundation/snapshot/gpu_particles.h"
#include "foundation/snapshot/material_kind.h"
#include "foundation/snapshot/particle_kind.h"
#include "simulation/gpu_programs/gpu_program.h"
#include "simulation/particles/particle_program.h"
#include "simulation/particles/reach/particle_reach.h"
#include "simulation/solver/effect_def.h"

#include <glm/geometric.hpp>

namespace fx::sim {

namespace {

constexpr float kSpareSeconds = 0.25f; ///< more than steps, and what trails keep for frames between them

bool isAppearanceOf(AppearanceKind appearance, const base::KindDesc& kind)
{
    switch (appearance) {
    case AppearanceKind::Medium:
        return kind == base::kBlobKind;
    case AppearanceKind::Sprite:
    case AppearanceKind::Mesh:
        return kind == base::kParticleKind;
    case AppearanceKind::None:
        break;
    }
    return false;
}

} // namespace

bool EmitterDef::publishes(const base::KindDesc& kind) const
{
    if (kind == base::kRibbonKind)
        return trail.lifetime > 0.0f;
    if (kind == base::kLightKind)
        return light.given;
    if (kind == base::kGpuParticleKind)
        return gpuObstacle(*this).empty();
    if (kind == base::kMaterialKind)
        return hasDetail();
    return isAppearanceOf(appearance.kind, kind);
}

std::shared_ptr<const base::GpuParticleProgram> EmitterDef::gpuProgram() const
{
    return program.of(*this)->gpu;
}

float EmitterDef::reachFrom(const ReachConditions& conditions, const BirthReach& given,
                            std::span<BirthReach> ioOthers) const
{
    return reachOf(*this, conditions, given, ioOthers);
}

Influence EmitterDef::influence() const
{
    Influence result{.seconds = lifetime.max + trail.lifetime + kSpareSeconds};
    if (inWorld && inheritVelocity > 0.0f) {
        result.inherits = inheritVelocity;
        result.extent = births ? births->extent() : glm::length(position) + glm::length(size);
        result.drawnOut = shutter + 0.5f * appearance.stretch;
    }
    return result;
}

std::shared_ptr<const ParticleProgram> SharedProgram::of(const EmitterSettings& settings) const
{
    const std::lock_guard lock(mutex_);
    std::shared_ptr<const ParticleProgram> program = program_.lock();
    if (!program) {
        const auto made = std::make_shared<ParticleProgram>(settings);
        if (gpuObstacle(settings).empty())
            made->gpu = makeGpuProgram(settings);
        program_ = program = made;
    }
    return program;
}

std::vector<const EmitterDef*> emittersOf(const EffectDef& effect)
{
    std::vector<const EmitterDef*> emitters;
    for (const auto& solver : effect.solvers)
        emitters.push_back(dynamic_cast<const EmitterDef*>(solver.get()));
    return emitters;
}

} // namespace fx::sim
