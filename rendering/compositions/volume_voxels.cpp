#include "rendering/compositions/volume_voxels.h"

#include "foundation/assets/asset_table.h"
#include "foundation/assets/volume_sequence.h"

#include <algorithm>
#include <span>

namespace fx::render {

namespace {

constexpr uint32_t kUnusedFrames = 300; ///< after which a volume is forgotten
constexpr uint32_t kUnusedFramesOfSequences = 2;

/// [byte] of the buffer of voxels
size_t voxelBytes(size_t bricks, bool hasVelocities)
{
    const size_t bytes = bricks * base::kVolumeBrickVoxels * sizeof(MediumVolume::Packed);
    return hasVelocities ? bytes + bytes / 2 : bytes;
}

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

VolumeVoxels::Volume* VolumeVoxels::known(VoxelsName name)
{
    const auto found = std::ranges::find(volumes_, name, &Volume::name);
    return found == volumes_.end() ? nullptr : &*found;
}

const MediumVolume* VolumeVoxels::find(VoxelsName name, const base::AssetTable& assets)
{
    if (Volume* const volume = known(name)) {
        volume->unused = 0;
        return volume->levels.front().medium.get();
    }
    const auto sequence = assets.sequence(name.asset);
    const auto voxels = sequence ? sequence->find(name.frame) : assets.volume(name.asset);
    if (!voxels || voxelBytes(voxels->bricks.size(), !voxels->velocity.empty()) > mostBytes())
        return nullptr;
    Volume made{.name = name, .isFrame = sequence != nullptr};
    made.levels.emplace_back().medium = std::make_unique<MediumVolume>(*voxels);
    return volumes_.emplace_back(std::move(made)).levels.front().medium.get();
}

std::optional<ShownVoxels> VolumeVoxels::find(const base::AssetTable* assets, const GroupVolume& volume)
{
    if (!assets)
        return std::nullopt;
    ShownVoxels shown;
    shown.first.asset = shown.second.asset = volume.asset;
    if (const auto sequence = assets->sequence(volume.asset)) {
        const FramePair pair = framePair(volume, sequence->count());
        shown.first.frame = pair.first;
        shown.second.frame = pair.second;
        shown.moment = {pair.part, sequence->hasVelocities() ? volume.frameSeconds : 0.0};
        sequence->prefetch(pair.first);
    }
    for (const VoxelsName name : {shown.first, shown.second}) {
        const MediumVolume* const medium = find(name, *assets);
        if (!medium)
            return std::nullopt;
        shown.largest = std::max(shown.largest, medium->largest());
    }
    return shown;
}

void VolumeVoxels::beginFrame()
{
    for (Volume& volume : volumes_)
        ++volume.unused;
    std::erase_if(volumes_, [](const Volume& volume) {
        return volume.unused > (volume.isFrame ? kUnusedFramesOfSequences : kUnusedFrames);
    });
}

/// As many as the driver can read from one buffer.
size_t VolumeVoxels::mostBytes() const
{
    GLint most = 0;
    device_.gl.GetIntegerv(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    return size_t(std::max(most, 0));
}

base::Status VolumeVoxels::makeRoom(const ShownVoxels& voxels, int level)
{
    const base::Status status = makeRoom(voxels.first, level);
    return status ? makeRoom(voxels.second, level) : status;
}

base::Status VolumeVoxels::makeRoom(VoxelsName name, int level)
{
    std::vector<Level>& levels = known(name)->levels;
    while (levels.size() <= size_t(level)) {
        auto half = std::make_unique<MediumVolume>(levels.back().medium->halved());
        if (voxelBytes(half->bricks(), half->hasVelocities()) > mostBytes())
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
    return fillBuffer(device_, wanted.medium->packedWithVelocities(), "volume voxels", wanted.voxels);
}

const VolumeVoxels::Level& VolumeVoxels::levelOf(VoxelsName name, int level) const
{
    return std::ranges::find(volumes_, name, &Volume::name)->levels[size_t(level)];
}

void VolumeVoxels::import(FrameGraph& graph, const ShownVoxels& voxels, int level,
                          FieldVolumePass::Inputs& io) const
{
    const bool isBetween = voxels.first != voxels.second;
    for (int k = 0; k < (isBetween ? 2 : 1); ++k) {
        const Level& held = levelOf(k == 0 ? voxels.first : voxels.second, level);
        io.index[k] = graph.importBuffer({"volume index", held.index.bytes()}, held.index.name());
        io.voxels[k] = graph.importBuffer({"volume voxels", held.voxels.bytes()}, held.voxels.name());
        const base::BrickIndex& index = held.medium->index();
        FieldVolumeBlock::Frame& block = io.block.frames[k];
        block.low = glm::ivec4(index.low(), int(held.medium->bricks()));
        block.size = glm::ivec4(index.size(), 0);
        block.light = glm::vec4(held.medium->brightest(), 0.0f, 0.0f, 0.0f);
    }
    const double seconds = voxels.moment.seconds;
    io.block.moment = glm::vec4(float(voxels.moment.part), float(voxels.moment.part * seconds),
                                float((1.0 - voxels.moment.part) * seconds), 0.0f);
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
