#include "rendering/compositions/media_compositions.h"

#include "rendering/compositions/slabs/slab_passes.h"
#include "rendering/compositions/slabs/slab_view.h"
#include "rendering/field/field_texels.h"
#include "rendering/field/lump_tile_pass.h"
#include "rendering/passes/impostor_pass.h"
#include "rendering/passes/particle_batch.h"

#include <array>

namespace fx::render {

namespace {

constexpr TimedPass kTimed[] = {{"slab balls", "media"},   {"slab detail upload", "media"},
                                {"field texels", "media"}, {"lump tile", "media"},
                                {"slab upload", "media"},  {"slab cards", "media"},
                                {"slab tiles", "media"},   {"slabs", "media"}};

std::span<const ProgramDesc* const> programs()
{
    static const auto all = [] {
        constexpr size_t kOwn = kSlabPrograms + 6, kShapes = size_t(BatchShape::Count);
        std::array<const ProgramDesc*, kOwn + kShapes + 1> list{};
        for (size_t i = 0; i < kSlabPrograms; ++i)
            list[i] = &slabProgramAt(i);
        list[kSlabPrograms] = &kSlabCardsProgram;
        list[kSlabPrograms + 1] = &kSlabTilesProgram;
        list[kSlabPrograms + 2] = &slabBallsProgram(false);
        list[kSlabPrograms + 3] = &slabBallsProgram(true);
        list[kSlabPrograms + 4] = &kFieldTexelProgram;
        list[kSlabPrograms + 5] = &kLumpTileProgram;
        for (size_t i = 0; i < kShapes; ++i)
            list[kOwn + i] = &cardProgram(BatchShape(i));
        list[kOwn + kShapes] = &kImpostorCardProgram;
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
    .create = create,
    .programs = programs,
    .timedPasses = kTimed,
};

} // namespace fx::render
