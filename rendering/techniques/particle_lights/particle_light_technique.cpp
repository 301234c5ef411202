#include "rendering/techniques/draw_techniques.h"

#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/particle_kind.h"

namespace fx::render {

namespace {

namespace column = base::light_column;

constexpr float kMinExtent = 0.05f; // [m] of particles, which have no size as lights

/// Whether the emitter of a light list is seen as a medium, which glows by itself.
bool isShownAsMedium(const base::FrameSnapshot& snapshot, const base::GroupInfo& info)
{
    const base::KindId blobs = snapshot.schema().find(base::kBlobKind.name);
    for (size_t g = 0; g < snapshot.groupCount(); ++g)
        if (snapshot.name(g) == base::GroupName{info.instance, info.solver, blobs})
            return true;
    return false;
}

/// The list of one emitter is one light.
bool lightOf(const base::FrameSnapshot& snapshot, const base::SnapshotGroup& g, EffectLight& outLight)
{
    GroupGlow glow;
    for (size_t i = 0; i < g.count(); ++i) {
        const glm::vec3 position(g.column(column::PositionX)[i], g.column(column::PositionY)[i],
                                 g.column(column::PositionZ)[i]);
        const glm::vec3 intensity(g.column(column::IntensityR)[i], g.column(column::IntensityG)[i],
                                  g.column(column::IntensityB)[i]);
        glow.add(position, intensity, 0.0f);
    }
    if (glow.isDark() || isShownAsMedium(snapshot, g.info()))
        return false;
    outLight = glow.light(g.info().placement, glow.extent(kMinExtent * kMinExtent), 1.0f);
    return true;
}

constexpr LightSource kLights{&base::kLightKind, lightOf};

} // namespace

constexpr DrawTechnique kParticleLightTechnique{
    .name = "particle lights",
    .kind = &base::kLightKind,
    .lights = &kLights,
};

} // namespace fx::render
