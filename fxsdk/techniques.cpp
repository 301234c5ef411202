#include "fxsdk/techniques.h"

#include "fxsdk/presets/blocks/blocks_technique.h"
#include "fxsdk/presets/clouds/clouds_technique.h"
#include "fxsdk/presets/emitters/emitter_technique.h"
#include "fxsdk/presets/fragments/fragments_technique.h"
#include "fxsdk/presets/volumes/volumes_technique.h"
#if FXSDK_WITH_SPH
#include "fxsdk/presets/gas/gas_technique.h"
#endif

#include <array>

namespace fx::preset {

namespace {

/// Emitters are first: their rules name solvers by their place among the emitters.
constexpr Technique kTechniques[] = {
    kEmitterTechnique, kFragmentsTechnique,
#if FXSDK_WITH_SPH
    kGasTechnique,
#endif
    kCloudsTechnique,  kVolumesTechnique,   kBlocksTechnique,
};

#if !FXSDK_WITH_SPH
constexpr std::array kMissing{MissingTechnique{"gas", "FXSDK_WITH_SPH"}};
#endif

} // namespace

Techniques techniques()
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

void registerKinds(base::SnapshotSchema& schema, Techniques techniques)
{
    for (const Technique& technique : techniques)
        for (const base::KindDesc* kind : technique.kinds)
            static_cast<void>(schema.add(*kind));
}

} // namespace fx::preset
