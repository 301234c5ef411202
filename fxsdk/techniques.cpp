#include "fxsdk/techniques.h"

#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/gpu_particles.h"
#include "foundation/snapshot/material_kind.h"
#include "fxsdk/presets/emitters/emitter_technique.h"
#include "fxsdk/presets/fragments/fragments_technique.h"
#if FXSDK_WITH_SPH
#include "fxsdk/presets/gas/gas_technique.h"
#endif

#include <array>

namespace fx::preset {

namespace {

constexpr std::array<std::string_view, 3> kMediaPasses{"scene distance", "media", "composite"};
constexpr std::array<std::string_view, 4> kParticlePasses{"scene distance", "solid particles", "media",
                                                          "composite"};
constexpr std::array<std::string_view, 2> kGpuPasses{"gpu particles", "gpu particle order"};
constexpr std::array<std::string_view, 2> kShimmerPasses{"heat offset", "heat shimmer"};
constexpr std::array<std::string_view, 3> kDazzlePasses{"dazzle sum", "dazzle budget", "dazzle deal"};

/// What is seen may saturate the sensor.
bool usesDazzle(const sim::EffectDef& effect)
{
    return effect.publishes(base::kBlobKind) || effect.publishes(base::kParticleKind) ||
           effect.publishes(base::kRibbonKind);
}

bool usesShimmer(const sim::EffectDef& effect)
{
    return effect.bendsLight();
}

/// Emitters are first: their rules name solvers by their place among the emitters.
constexpr Technique kTechniques[] = {
    kEmitterTechnique,
    kFragmentsTechnique,
#if FXSDK_WITH_SPH
    kGasTechnique,
#endif
    {.name = "spherical billboards", .kind = &base::kBlobKind, .passes = kMediaPasses},
    {.name = "detail of fields", .kind = &base::kMaterialKind},
    {.name = "sprites and meshes", .kind = &base::kParticleKind, .passes = kParticlePasses},
    {.name = "particles on the GPU", .kind = &base::kGpuParticleKind, .passes = kGpuPasses},
    {.name = "ribbons", .kind = &base::kRibbonKind, .passes = kMediaPasses},
    {.name = "particle lights", .kind = &base::kLightKind},
    {.name = "heat shimmer", .isUsedBy = usesShimmer, .passes = kShimmerPasses},
    {.name = "dazzle", .isUsedBy = usesDazzle, .passes = kDazzlePasses},
};

#if !FXSDK_WITH_SPH
constexpr std::array kMissing{MissingTechnique{"gas", "FXSDK_WITH_SPH"}};
#endif

} // namespace

Techniques techniques()
{
    return kTechniques;
}

bool isUsed(const Technique& technique, const sim::EffectDef& effect)
{
    return technique.isUsedBy ? technique.isUsedBy(effect)
                              : technique.kind && effect.publishes(*technique.kind);
}

std::span<const MissingTechnique> missingTechniques()
{
#if FXSDK_WITH_SPH
    return {};
#else
    return kMissing;
#endif
}

void registerKinds(base::SnapshotSchema& schema, Techniques techniques)
{
    for (const Technique& technique : techniques)
        if (technique.kind)
            static_cast<void>(schema.add(*technique.kind));
}

} // namespace fx::preset
