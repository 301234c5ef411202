#include "rendering/compositions/volume_voxels.h"

#include "foundation/assets/asset_table.h"

#include <algorithm>
#include <span>

namespace fx::render {

namespace {

constexpr uint32_t kUnusedFrames = 300; ///< after which a volume is forgotten

/// A buffer with these bytes.
template <class T>
base::Status fillBuffer(GlDevice& device, const std::vector<T>& values, const char* name, GlBuffer& out)
{
    const std::span<const std::byte> bytes = std::as_bytes(std::span(values));
    base::Result<GlBuffer> made = GlBuffer::create(device, bytes.size(), name);
    if (!made)
        return made.status();
    device.gl.NamedBufferSubData(made->name(), 0, GLsizeiptr(bytes.size()), bytes.data());
    out = std::move(*made);
    return {};
}

} // namespace

const MediumVolume* VolumeVoxels::find(const base::AssetTable* assets, uint32_t asset)
{
    const auto known = std::ranges::find(volumes_, asset, &Volume::asset);
    if (known != volumes_.end()) {
        known->unused = 0;
        return known->levels.front().medium.get();
    }
    const auto voxels = assets ? assets->volume(asset) : nullptr;
    if (!voxels || voxels->bricks.size() > mostBricks())
        return nullptr;
    Volume made{.asset = asset};
    made.levels.emplace_back().medium = std::make_unique<MediumVolume>(*voxels);
    return volumes_.emplace_back(std::move(made)).levels.front().medium.get();
}

void VolumeVoxels::beginFrame()
{
    for (Volume& volume : volumes_)
        ++volume.unused;
    std::erase_if(volumes_, [](const Volume& volume) { return volume.unused > kUnusedFrames; });
}

/// As many as the driver can read from one buffer.
size_t VolumeVoxels::mostBricks() const
{
    GLint most = 0;
    device_.gl.GetIntegerv(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    return size_t(std::max(most, 0)) / (sizeof(MediumVolume::Packed) * base::kVolumeBrickVoxels);
}

base::Status VolumeVoxels::makeRoom(uint32_t asset, int level)
{
    std::vector<Level>& levels = std::ranges::find(volumes_, asset, &Volume::asset)->levels;
    while (levels.size() <= size_t(level)) {
        auto half = std::make_unique<MediumVolume>(levels.back().medium->halved());
        if (half->bricks() > mostBricks())
            return {base::Code::TooLarge, "a volume is so scattered that its coarser voxels need more "
                                          "memory than the driver reads from one buffer"};
        levels.emplace_back().medium = std::move(half);
    }
    Level& wanted = levels[size_t(level)];
    if (wanted.voxels.name() != 0)
        return {};
    if (base::Status status =
            fillBuffer(device_, wanted.medium->index().table(), "volume index", wanted.index);
        !status)
        return status;
    return fillBuffer(device_, wanted.medium->packed(), "volume voxels", wanted.voxels);
}

const VolumeVoxels::Level& VolumeVoxels::levelOf(uint32_t asset, int level) const
{
    return std::ranges::find(volumes_, asset, &Volume::asset)->levels[size_t(level)];
}

void VolumeVoxels::import(FrameGraph& graph, uint32_t asset, int level, FieldVolumePass::Inputs& io) const
{
    const Level& held = levelOf(asset, level);
    io.index = graph.importBuffer({"volume index", held.index.bytes()}, held.index.name());
    io.voxels = graph.importBuffer({"volume voxels", held.voxels.bytes()}, held.voxels.name());
    const base::BrickIndex& index = held.medium->index();
    io.block.low = glm::ivec4(index.low(), io.block.low.w);
    io.block.size = glm::ivec4(index.size(), 0);
}

float VolumeVoxels::brightest(uint32_t asset, int level) const
{
    return levelOf(asset, level).medium->brightest();
}

void VolumeVoxels::release()
{
    volumes_.clear();
}

uint64_t VolumeVoxels::bytes() const
{
    uint64_t sum = 0;
    for (const Volume& volume : volumes_)
        for (const Level& level : volume.levels)
            sum += level.index.bytes() + level.voxels.bytes();
    return sum;
}

} // namespace fx::render
