#include "rendering/compositions/volume/volume_composition.h"

#include "rendering/compositions/volume/volume_view.h"

#include <array>

namespace fx::render {

namespace {

constexpr TimedPass kTimed[] = {{"loose blob upload", "volume"},
                                {"field upload", "volume"},
                                {"field fill", "volume"},
                                {"field light", "volume"}};

std::span<const ProgramDesc* const> programs()
{
    static const std::array<const ProgramDesc*, 6> all{&fieldFillProgram(false),  &fieldFillProgram(true),
                                                       &fieldLightProgram(false), &fieldLightProgram(true),
                                                       &fieldMarchProgram(false), &fieldMarchProgram(true)};
    return all;
}

std::unique_ptr<CompositionView> create(const TechniqueSetup& setup)
{
    return std::make_unique<VolumeView>(setup);
}

} // namespace

constexpr MediaComposition kVolumeComposition{
    .value = Composition::Volume,
    .meaning = "balls of an effect summed up in voxels, through which rays march; no order of balls is seen",
    .needsOrder = false,
    .create = create,
    .programs = programs,
    .timedPasses = kTimed,
};

} // namespace fx::render
