#include "fxsdk/techniques.h"

#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/gpu_particles.h"
#include "fxsdk/presets/emitter_preset.h"
#include "fxsdk/presets/fragments_preset.h"
#if FXSDK_WITH_SPH
#include "fxsdk/presets/gas_preset.h"
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

constexpr std::array kTechniques
{
    Technique{"emitters", "emitters", "emitters.schema.json", buildEmitter, nullptr, &base::kBlobKind, {}},
        Technique{"fragments",      "fragments", "fragments.schema.json", buildFragments, nullptr,
                  &base::kBlobKind, {}},
#if FXSDK_WITH_SPH
        Technique{"sph gas", "gas", "gas.schema.json", buildGas, nullptr, &base::kBlobKind, {}},
#endif
        Technique{"spherical billboards", "", "", nullptr, nullptr, &base::kBlobKind, kMediaPasses},
        Technique{"sprites and meshes", "", "", nullptr, nullptr, &base::kParticleKind, kParticlePasses},
        Technique{"particles on the GPU", "", "", nullptr, nullptr, &base::kGpuParticleKind, kGpuPasses},
        Technique{"ribbons", "", "", nullptr, nullptr, &base::kRibbonKind, kMediaPasses},
        Technique{"particle lights", "", "", nullptr, nullptr, &base::kLightKind, {}},
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

void registerKinds(base::SnapshotSchema& schema)
{
    for (const Technique& technique : techniques())
        if (technique.kind)
            static_cast<void>(schema.add(*technique.kind));
}

} // namespace fx::preset
