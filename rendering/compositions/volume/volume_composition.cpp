#include "rendering/compositions/media_compositions.h"

#include "rendering/compositions/volume/volume_view.h"
#include "rendering/field/field_fill_pass.h"
#include "rendering/field/field_volume_pass.h"

#include <vector>

namespace fx::render {

namespace {

// Passes that slabs have too are in their list.
constexpr TimedPass kTimed[] = {{"loose blob upload", "volume"}, {"field slices", "volume"},
                                {"field near", "volume"},        {"field light", "volume"},
                                {"glow upload", "volume"},       {"glow rays", "volume"},
                                {"glow sum", "volume"},          {"field march", "media"}};

std::span<const ProgramDesc* const> programs()
{
    static const auto all = [] {
        const std::span<const ProgramDesc* const> ofSlabs = kSlabComposition.programs(); // the loose
        std::vector<const ProgramDesc*> list(ofSlabs.begin(), ofSlabs.end());
        list.insert(list.end(),
                    {&kFieldSlicesProgram, &kGlowSourceAgainProgram, &glowRaysProgram(false),
                     &glowRaysProgram(true), &glowSumProgram(false), &glowSumProgram(true),
                     &fieldNearProgram(false), &fieldNearProgram(true), &kFieldNearDetailProgram});
        for (const bool detail : {false, true}) {
            list.push_back(&fieldFillProgram(true, detail)); // without layers: of networks in slabs
            for (const bool between : {false, true})
                list.push_back(&fieldVolumeProgram(true, between, detail));
            for (const bool layers : {false, true})
                for (const bool network : {false, true})
                    list.push_back(&fieldLightProgram(layers, detail, network));
        }
        for (size_t i = 0; i < kFieldMarchPrograms; ++i)
            list.push_back(&fieldMarchProgramAt(i));
        return list;
    }();
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
    .fitsToVisible = true,
    .create = create,
    .programs = programs,
    .timedPasses = kTimed,
};

} // namespace fx::render
