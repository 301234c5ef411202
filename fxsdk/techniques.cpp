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

constexpr std::array kTechniques
{
    Technique{"emitters", "emitters", "emitters.schema.json", buildEmitter, &base::kBlobKind, {}},
        Technique{"fragments", "fragments", "fragments.schema.json", buildFragments, &base::kBlobKind, {}},
#if FXSDK_WITH_SPH
        Technique{"sph gas", "gas", "gas.schema.json", buildGas, &base::kBlobKind, {}},
#endif
        Technique{"spherical billboards", "", "", nullptr, &base::kBlobKind, kMediaPasses},
        Technique{"sprites and meshes", "", "", nullptr, &base::kParticleKind, kParticlePasses},
        Technique{"particles on the GPU", "", "", nullptr, &base::kGpuParticleKind, kGpuPasses},
        Technique{"ribbons", "", "", nullptr, &base::kRibbonKind, kMediaPasses},
        Technique{"particle lights", "", "", nullptr, &base::kLightKind, {}},
        Technique{"heat shimmer", "", "", nullptr, nullptr, kShimmerPasses},
        Technique{"dazzle", "", "", nullptr, nullptr, kDazzlePasses},
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
