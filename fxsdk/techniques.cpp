#include "fxsdk/techniques.h"

#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/gpu_particles.h"
#include "fxsdk/presets/emitter_preset.h"
#include "fxsdk/presets/fragments_preset.h"
#if FXSDK_WITH_SPH
#include "fxsdk/presets/gas_preset.h"
#endif
#include "simulation/emitters/emitter_def.h"
#include "simulation/emitters/gpu_program.h"

#include <algorithm>
#include <array>

namespace fx::preset {

namespace {

constexpr std::array<std::string_view, 3> kMediaPasses{"scene distance", "media", "composite"};
constexpr std::array<std::string_view, 4> kParticlePasses{"scene distance", "solid particles", "media",
                                                          "composite"};
constexpr std::array<std::string_view, 2> kGpuPasses{"gpu particles", "gpu particle order"};
constexpr std::array<std::string_view, 2> kShimmerPasses{"heat offset", "heat shimmer"};
constexpr std::array<std::string_view, 3> kDazzlePasses{"dazzle sum", "dazzle budget", "dazzle deal"};

using sim::Appearance;
using sim::EmitterDef;

/// True when one of the effect's emitters is such.
bool hasEmitter(const sim::EffectDef& effect, bool (*isSuch)(const EmitterDef&))
{
    return std::any_of(effect.solvers.begin(), effect.solvers.end(), [&](const auto& solver) {
        const auto* emitter = dynamic_cast<const EmitterDef*>(solver.get());
        return emitter && isSuch(*emitter);
    });
}

/// Gases and fragments are media.
bool hasMedia(const sim::EffectDef& effect, bool (*isSuch)(const EmitterDef&))
{
    return hasEmitter(effect, isSuch) ||
           std::any_of(effect.solvers.begin(), effect.solvers.end(), [](const auto& solver) {
               return dynamic_cast<const EmitterDef*>(solver.get()) == nullptr;
           });
}

bool usesBillboards(const sim::EffectDef& effect)
{
    return hasMedia(effect, [](const EmitterDef& e) { return e.look.kind == Appearance::Medium; });
}

bool usesSprites(const sim::EffectDef& effect)
{
    return hasEmitter(effect, [](const EmitterDef& e) {
        return e.look.kind == Appearance::Sprite || e.look.kind == Appearance::Mesh;
    });
}

bool usesGpu(const sim::EffectDef& effect)
{
    return hasEmitter(effect, [](const EmitterDef& e) { return sim::gpuObstacle(e).empty(); });
}

bool usesRibbons(const sim::EffectDef& effect)
{
    return hasEmitter(effect, [](const EmitterDef& e) { return e.trail.lifetime > 0.0f; });
}

bool usesLights(const sim::EffectDef& effect)
{
    return hasEmitter(effect, [](const EmitterDef& e) { return e.light.given; });
}

bool usesShimmer(const sim::EffectDef& effect)
{
    return hasMedia(effect,
                    [](const EmitterDef& e) { return e.look.kind == Appearance::Medium && e.heat > 0.0f; });
}

/// What is seen may saturate the sensor.
bool usesDazzle(const sim::EffectDef& effect)
{
    return usesBillboards(effect) || usesSprites(effect) || usesRibbons(effect);
}

constexpr std::array kTechniques
{
    Technique{"emitters", "emitters", "emitters.schema.json", buildEmitter, nullptr, &base::kBlobKind, {}},
        Technique{"fragments",      "fragments", "fragments.schema.json", buildFragments, nullptr,
                  &base::kBlobKind, {}},
#if FXSDK_WITH_SPH
        Technique{"sph gas", "gas", "gas.schema.json", buildGas, nullptr, &base::kBlobKind, {}},
#endif
        Technique{"spherical billboards", "", "", nullptr, usesBillboards, &base::kBlobKind, kMediaPasses},
        Technique{"sprites and meshes", "", "", nullptr, usesSprites, &base::kParticleKind, kParticlePasses},
        Technique{"particles on the GPU", "", "", nullptr, usesGpu, &base::kGpuParticleKind, kGpuPasses},
        Technique{"ribbons", "", "", nullptr, usesRibbons, &base::kRibbonKind, kMediaPasses},
        Technique{"particle lights", "", "", nullptr, usesLights, &base::kLightKind, {}},
        Technique{"heat shimmer", "", "", nullptr, usesShimmer, nullptr, kShimmerPasses},
        Technique{"dazzle", "", "", nullptr, usesDazzle, nullptr, kDazzlePasses},
};

#if !FXSDK_WITH_SPH
constexpr std::array kMissing{MissingTechnique{"gas", "FXSDK_WITH_SPH"}};
#endif

} // namespace

std::span<const Technique> techniques()
{
    return kTechniques;
}

std::span<const MissingTechnique> missingTechniques()
{
#if FXSDK_WITH_SPH
    return {};
#else
    return kMissing;
#endif
}

void registerKinds(base::SnapshotSchema& schema)
{
    for (const Technique& technique : techniques())
        if (technique.kind)
            static_cast<void>(schema.add(*technique.kind));
}

} // namespace fx::preset
