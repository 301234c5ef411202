#include "rendering/compositions/volume_voxels.h"

#include "foundation/assets/asset_table.h"
#include "foundation/assets/volume_sequence.h"
#include "rendering/compositions/voxel_texture.h"
#include "rendering/volumes/volume_levels.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace fx::render {

namespace {

constexpr uint32_t kUnusedFrames = 300; ///< after which a volume is forgotten
constexpr uint32_t kUnusedFramesOfSequences = 2;

} // namespace

VolumeVoxels::Volume* VolumeVoxels::known(VoxelsName name)
{
    const auto found = std::ranges::find(volumes_, name, &Volume::name);
    return found == volumes_.end() ? nullptr : &*found;
}

VolumeVoxels::Volume* VolumeVoxels::find(VoxelsName name, const base::AssetTable& assets)
{
    if (Volume* const volume = known(name)) {
        volume->unused = 0;
        return volume;
    }
    auto sequence = assets.sequence(name.asset);
    auto voxels = sequence ? sequence->find(name.frame) : assets.volume(name.asset);
    if (!voxels)
        return nullptr;
    Volume made{.name = name, .sequence = std::move(sequence), .source = std::move(voxels)};
    for (const float extinction : made.source->extinction)
        made.largest = std::max(made.largest, extinction);
    if (!made.sequence)
        made.coarser = assets.coarserLevels(name.asset);
    return &volumes_.emplace_back(std::move(made));
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
        shown.moment = momentOf(volume, pair, *sequence);
        sequence->prefetch(pair.first, std::ranges::count(small_, volume.asset, &SmallSequence::asset) > 0);
    }
    for (const VoxelsName name : {shown.first, shown.second}) {
        Volume* const found = find(name, *assets);
        if (!found)
            return std::nullopt;
        shown.largest = std::max(shown.largest, found->largest);
        const bool waits = found->sequence && found->sequence->waits();
        if (!found->coarser && found->sequence && !waits)
            found->coarser = found->sequence->coarser(name.frame);
        shown.isFine = shown.isFine || (!found->coarser && !waits);
    }
    return shown;
}

void VolumeVoxels::wantCoarser(const base::AssetTable& assets, const ShownVoxels& voxels)
{
    const uint32_t asset = voxels.first.asset;
    const auto sequence = assets.sequence(asset);
    if (!sequence)
        return;
    const auto known = std::ranges::find(small_, asset, &SmallSequence::asset);
    if (known != small_.end()) {
        known->unused = 0;
        return;
    }
    small_.push_back({asset, 0});
    sequence->prefetch(voxels.first.frame, true);
}

void VolumeVoxels::beginFrame()
{
    for (Volume& volume : volumes_)
        ++volume.unused;
    std::erase_if(volumes_, [](const Volume& volume) {
        return volume.unused > (volume.sequence ? kUnusedFramesOfSequences : kUnusedFrames);
    });
    for (SmallSequence& sequence : small_)
        ++sequence.unused;
    std::erase_if(small_, [](const SmallSequence& sequence) { return sequence.unused > kUnusedFrames; });
}

base::Status VolumeVoxels::makeRoom(const ShownVoxels& voxels, int level)
{
    const base::Status status = makeRoom(voxels.first, level);
    return status ? makeRoom(voxels.second, level) : status;
}

base::Status VolumeVoxels::makeRoom(VoxelsName name, int level)
{
    Volume& volume = *known(name);
    if (volume.levels.size() <= size_t(level))
        volume.levels.resize(size_t(level) + 1);
    Level& wanted = volume.levels[size_t(level)];
    if (wanted.voxels.name() != 0)
        return {};
    if (level == 0)
        return upload(packedLevel(MediumVolume(*volume.source)), wanted);
    if (!volume.coarser && volume.sequence)
        volume.coarser = volume.sequence->coarser(name.frame); // in a picture that waits
    if (!volume.coarser)
        return {base::Code::NotFound, "the coarser voxels of a volume could not be made"};
    return upload(volume.coarser->coarser[size_t(level) - 1], wanted);
}

base::Status VolumeVoxels::upload(const base::VolumeLevel& level, Level& out)
{
    out.low = level.index.low();
    out.size = level.index.size();
    out.bricks = level.bricks;
    out.brightest = level.brightest;
    const std::span<const std::byte> table = std::as_bytes(std::span(level.index.table()));
    auto index = GlBuffer::create(device_, table.size(), "volume index");
    auto voxels = makeVoxelTexture(device_, level.voxels, "volume voxels");
    if (!index || !voxels)
        return index ? voxels.status() : index.status();
    device_.gl.NamedBufferSubData(index->name(), 0, GLsizeiptr(table.size()), table.data());
    out.index = std::move(*index);
    out.voxels = std::move(*voxels);
    return {};
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
        io.voxels[k] = graph.importTexture(
            {"volume voxels", held.voxels.width(), held.voxels.height(), Format::RGBA32UI},
            held.voxels.name());
        FieldVolumeBlock::Frame& block = io.block.frames[k];
        block.low = glm::ivec4(held.low, int(held.bricks));
        block.size = glm::ivec4(held.size, 0);
        block.light = glm::vec4(held.brightest, 0.0f, 0.0f, 0.0f);
        const base::LatticeMap& map = k == 0 ? voxels.moment.toFirst : voxels.moment.toSecond;
        block.place = glm::vec4(glm::vec3(map.offset * std::ldexp(1.0, -level)), float(map.scale));
    }
    const double seconds = voxels.moment.seconds;
    io.block.moment = glm::vec4(float(voxels.moment.part), float(voxels.moment.part * seconds),
                                float((1.0 - voxels.moment.part) * seconds), 0.0f);
}

void VolumeVoxels::release()
{
    volumes_.clear();
    small_.clear();
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
