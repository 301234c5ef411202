#include "foundation/snapshot/block_kind.h"
#include "rendering/techniques/blocks/block_view.h"
#include "rendering/techniques/draw_techniques.h"

namespace fx::render {

namespace {

constexpr TimedPass kPasses[] = {
    {"block upload", "blocks"}, {"block tile upload", "blocks"}, {"block tiles", "blocks"}};

std::span<const ProgramDesc* const> programs()
{
    static constexpr const ProgramDesc* kPrograms[] = {&kBlockTilesProgram};
    return kPrograms;
}

std::unique_ptr<TechniqueView> create(const TechniqueSetup& setup)
{
    return std::make_unique<BlockView>(setup);
}

} // namespace

constexpr DrawTechnique kBlockTechnique{
    .name = "particle blocks",
    .kind = &base::kBlockKind,
    .create = create,
    .programs = programs,
    .passes = kPasses,
};

constexpr DrawTechnique kBlockBallTechnique{
    .name = "balls of particle blocks",
    .kind = &base::kBlockBallKind,
};

constexpr DrawTechnique kBlockMaterialTechnique{
    .name = "coordinates of particle blocks",
    .kind = &base::kBlockMaterialKind,
};

} // namespace fx::render
