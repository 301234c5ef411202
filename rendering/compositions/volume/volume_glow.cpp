#include "rendering/compositions/volume/volume_glow.h"

#include <algorithm>
#include <bit>
#include <string_view>

namespace fx::render {

namespace {

constexpr std::string_view kNames[] = {"glow cells", "glow scatter", "glow rays", "glow first", "glow light"};
constexpr Format kFormats[] = {Format::RGBA32F, Format::RGBA16F, Format::RGBA16F, Format::RGBA16F,
                               Format::RGBA16F};
constexpr size_t kRays = 2; ///< number of the texture of rays

} // namespace

base::Status VolumeGlow::makeRoom(std::span<const FieldGlowBlock> grids)
{
    if (grids.empty())
        return {};
    if (base::Status status = render::makeRoom(device_, buffer_, grids.size_bytes(), "glow grids"); !status)
        return status;
    for (size_t i = 0; i < volumes_.size(); ++i) {
        const int across = i == kRays ? kGlowRays[0] : 1, up = i == kRays ? kGlowRays[1] : 1;
        const int depth = kGlowCells * int(std::bit_ceil(grids.size()));
        if (volumes_[i].name() != 0 && volumes_[i].depth() >= depth)
            continue;
        volumes_[i] = {};
        auto created = GlTexture::createVolume(device_, across * kGlowCells, up * kGlowCells, depth,
                                               glInternalFormat(kFormats[i]), kNames[i].data());
        if (!created)
            return created.status();
        volumes_[i] = std::move(*created);
    }
    return {};
}

void VolumeGlow::importAll(FrameGraph& graph, std::span<const FieldGlowBlock> grids)
{
    textures_ = {};
    grids_ = {};
    if (grids.empty())
        return;
    grids_ = graph.importBuffer({"glow grids", std::bit_ceil(grids.size_bytes())}, buffer_.name());
    ResourceId* const ids[] = {&textures_.cells, &textures_.scatter, &textures_.rays, &textures_.first,
                               &textures_.light};
    for (size_t i = 0; i < volumes_.size(); ++i)
        *ids[i] = graph.importTexture({kNames[i], volumes_[i].width(), volumes_[i].height(), kFormats[i]},
                                      volumes_[i].name());
}

void VolumeGlow::addPasses(FrameGraph& graph, FieldGlowPass::Inputs in, std::span<const FieldGlowBlock> grids)
{
    if (grids.empty())
        return;
    graph.addPass("glow upload", [&](FrameGraph::Builder& builder) {
        grids_ = builder.write(grids_);
        return [buffer = grids_, grids](Backend& backend) { backend.upload(buffer, std::as_bytes(grids)); };
    });
    in.grids = grids_;
    in.glow = textures_;
    in.gridCount = uint32_t(grids.size());
    in.extent = glowExtent(grids);
    textures_ = FieldGlowPass::addTo(graph, in).glow;
}

void VolumeGlow::release()
{
    volumes_ = {};
    buffer_ = {};
}

uint64_t VolumeGlow::bytes() const
{
    uint64_t sum = buffer_.bytes();
    for (const GlTexture& volume : volumes_)
        sum += volume.bytes();
    return sum;
}

} // namespace fx::render
