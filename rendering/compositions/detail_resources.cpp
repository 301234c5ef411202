#include "rendering/compositions/detail_resources.h"

#include "rendering/field/lump_tile_pass.h"

namespace fx::render {

FieldDetailBlock detailBlock(const GroupDetail& detail, int octaves)
{
    const FieldDetailNumbers& numbers = detail.numbers;
    FieldDetailBlock block;
    for (int g = 0; g < 2; ++g)
        for (int row = 0; row < 3; ++row)
            block.rows[3 * g + row] = {detail.toCells[g][0][row], detail.toCells[g][1][row],
                                       detail.toCells[g][2][row], detail.first[g][row]};
    block.erosion = {numbers.length() * detail.scale, numbers.thinnest, numbers.densest, numbers.ramp};
    block.noise = {numbers.gain, numbers.fade, numbers.cooling, numbers.glow};
    const auto size = [&](size_t g) {
        return detail.scale * numbers.generations[g].length / numbers.generations[g].growth;
    };
    block.lumps = {size(0), size(1), detail.factor, float(octaves)};
    block.soft = {numbers.softening, 0.0f, 0.0f, 0.0f};
    return block;
}

base::Status LumpTileTexture::makeRoom(GlDevice& device)
{
    if (texture_.name() != 0)
        return {};
    auto created = GlTexture::createVolume(device, kLumpTileTexels, kLumpTileTexels, kLumpTileTexels,
                                           glInternalFormat(Format::R32F), "lump tile");
    if (!created)
        return created.status();
    texture_ = std::move(*created);
    isFilled_ = false;
    return {};
}

ResourceId LumpTileTexture::addTo(FrameGraph& graph)
{
    ResourceId tile =
        graph.importTexture({"lump tile", kLumpTileTexels, kLumpTileTexels, Format::R32F}, texture_.name());
    if (!isFilled_)
        tile = LumpTilePass::addTo(graph, tile);
    isFilled_ = true;
    return tile;
}

} // namespace fx::render
