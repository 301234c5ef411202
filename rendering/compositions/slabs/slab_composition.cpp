#include "rendering/compositions/media_compositions.h"

#include "rendering/compositions/slabs/slab_passes.h"
#include "rendering/compositions/slabs/slab_view.h"
#include "rendering/field/field_fill_pass.h"
#include "rendering/field/field_glow_pass.h"
#include "rendering/field/field_texels.h"
#include "rendering/field/field_volume_pass.h"
#include "rendering/field/lump_tile_pass.h"
#include "rendering/network/network_passes.h"
#include "rendering/passes/blob_light_pass.h"
#include "rendering/passes/impostor_pass.h"
#include "rendering/passes/particle_batch.h"

#include <vector>

namespace fx::render {

namespace {

constexpr TimedPass kTimed[] = {{"slab balls", "media"},      {"slab detail upload", "media"},
                                {"field texels", "media"},    {"lump tile", "media"},
                                {"slab upload", "media"},     {"slab cards", "media"},
                                {"slab tiles", "media"},      {"slabs", "media"},
                                {"field upload", "volume"},   {"field fill", "volume"},
                                {"field volume", "volume"},   {"glow source", "volume"},
                                {"network upload", "volume"}, {"network prepare", "volume"},
                                {"network rays", "volume"},   {"network sum", "volume"}};

std::span<const ProgramDesc* const> programs()
{
    static const auto all = [] {
        std::vector<const ProgramDesc*> list{&kSlabCardsProgram,
                                             &kSlabTilesProgram,
                                             &slabBallsProgram(false),
                                             &slabBallsProgram(true),
                                             &slabBallsProgram(false, true),
                                             &slabBallsProgram(true, true),
                                             &kFieldTexelProgram,
                                             &kLumpTileProgram,
                                             &kImpostorCardProgram,
                                             &glowSourceProgram(false),
                                             &glowSourceProgram(true),
                                             &kNetworkPrepareProgram,
                                             &kNetworkRaysProgram,
                                             &kNetworkSumProgram,
                                             &blobLightProgram(true),
                                             &fieldFillProgram(false, false),
                                             &fieldFillProgram(false, true),
                                             &fieldVolumeProgram(false, false, false),
                                             &fieldVolumeProgram(false, true, false),
                                             &fieldVolumeProgram(false, false, true),
                                             &fieldVolumeProgram(false, true, true)};
        for (size_t i = 0; i < kSlabPrograms; ++i)
            list.push_back(&slabProgramAt(i));
        for (size_t i = 0; i < size_t(BatchShape::Count); ++i)
            list.push_back(&cardProgram(BatchShape(i)));
        return list;
    }();
    return all;
}

std::unique_ptr<CompositionView> create(const TechniqueSetup& setup)
{
    return std::make_unique<SlabView>(setup);
}

} // namespace

constexpr MediaComposition kSlabComposition{
    .value = Composition::Slabs,
    .meaning = "all media of a pixel summed up in slabs across its ray; no order is seen",
    .needsOrder = false,
    .drawsTiles = true,
    .create = create,
    .programs = programs,
    .timedPasses = kTimed,
};

} // namespace fx::render
