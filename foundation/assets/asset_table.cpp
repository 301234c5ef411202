#include "foundation/assets/asset_table.h"

#include "foundation/math/bits.h"
#include "foundation/math/hash.h"
#include "foundation/memory/same_bytes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <string>

namespace fx::base {

namespace {

Status invalid(std::string why)
{
    return {Code::InvalidArgument, std::move(why)};
}

Status checkMesh(std::span<const MeshVertex> vertices, std::span<const uint32_t> indices)
{
    if (indices.empty() || indices.size() % 3 != 0)
        return invalid("mesh: " + std::to_string(indices.size()) +
                       " indices; three a triangle and at least one triangle are needed");
    for (const uint32_t index : indices)
        if (index >= vertices.size())
            return invalid("mesh: a triangle names vertex " + std::to_string(index) + " of " +
                           std::to_string(vertices.size()));
    static_assert(sizeof(MeshVertex) == 8 * sizeof(float));
    if (!allFinite(reinterpret_cast<const float*>(vertices.data()), int(vertices.size() * 8)))
        return invalid("mesh: a coordinate is not finite");
    return {};
}

} // namespace

const AssetTable::Entry* AssetTable::entry(AssetId id) const
{
    return id == 0 || id > kMaxAssets ? nullptr : byId_[id - 1].load(std::memory_order_acquire);
}

const ImageAsset* AssetTable::image(AssetId id) const
{
    const Entry* found = entry(id);
    return found ? found->image.get() : nullptr;
}

const MeshAsset* AssetTable::mesh(AssetId id) const
{
    const Entry* found = entry(id);
    return found ? found->mesh.get() : nullptr;
}

std::shared_ptr<const VoxelVolume> AssetTable::volume(AssetId id) const
{
    const Entry* found = entry(id);
    return found ? found->volume : nullptr;
}

CoarserLevels AssetTable::coarserLevels(AssetId id) const
{
    const Entry* found = entry(id);
    return found ? found->coarser : nullptr;
}

std::shared_ptr<VolumeSequence> AssetTable::sequence(AssetId id) const
{
    const Entry* found = entry(id);
    return found ? found->sequence : nullptr;
}

/// Id of the entry of that hash for which `same` holds; 0 for none. The caller holds the lock.
template <class Same>
AssetId AssetTable::find(uint64_t hash, const Same& same) const
{
    for (size_t i = 0; i < owned_.size(); ++i)
        if (owned_[i]->hash == hash && same(*owned_[i]))
            return AssetId(i + 1);
    return 0;
}

/// The caller holds the lock.
Result<AssetId> AssetTable::publish(Entry entry, uint64_t bytes)
{
    if (owned_.size() == kMaxAssets)
        return Status(Code::Capacity,
                      "assets: " + std::to_string(kMaxAssets) +
                          " images, meshes and volumes are loaded already; use fewer different ones");
    entry.bytes = bytes;
    owned_.push_back(std::make_unique<Entry>(std::move(entry)));
    const auto id = AssetId(owned_.size());
    byId_[id - 1].store(owned_.back().get(), std::memory_order_release);
    size_.store(id, std::memory_order_release);
    bytes_.fetch_add(bytes, std::memory_order_relaxed);
    return id;
}

void AssetTable::truncate(uint32_t count)
{
    const std::scoped_lock lock(adding_);
    while (owned_.size() > count) {
        byId_[owned_.size() - 1].store(nullptr, std::memory_order_release);
        bytes_.fetch_sub(owned_.back()->bytes, std::memory_order_relaxed);
        owned_.pop_back();
    }
    size_.store(uint32_t(owned_.size()), std::memory_order_release);
}

Result<AssetId> AssetTable::addImage(int width, int height, bool isSrgb, std::span<const uint8_t> rgba)
{
    if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide ||
        rgba.size() != size_t(width) * size_t(height) * 4)
        return invalid("image: " + std::to_string(width) + " x " + std::to_string(height) + " texels in " +
                       std::to_string(rgba.size()) + " bytes; sides of 1 to " + std::to_string(kLargestSide) +
                       " and four bytes a texel are needed");
    uint64_t hash = hashWord(uint64_t(width), uint64_t(height) * 2 + (isSrgb ? 1 : 0));
    hash = hashBytes(hash, rgba.data(), rgba.size());
    const std::scoped_lock lock(adding_);
    const AssetId known = find(hash, [&](const Entry& e) {
        return e.image && e.image->width == width && e.image->height == height && e.image->isSrgb == isSrgb &&
               sameBytes(std::span<const uint8_t>(e.image->rgba), rgba);
    });
    if (known)
        return known;
    Entry entry;
    entry.hash = hash;
    entry.image = std::make_unique<ImageAsset>(
        ImageAsset{width, height, isSrgb, std::pmr::vector<uint8_t>(rgba.begin(), rgba.end(), memory_)});
    return publish(std::move(entry), rgba.size());
}

Result<AssetId> AssetTable::addMesh(std::span<const MeshVertex> vertices, std::span<const uint32_t> indices)
{
    if (Status status = checkMesh(vertices, indices); !status)
        return status;
    uint64_t hash = hashBytes(1, vertices.data(), vertices.size_bytes());
    hash = hashBytes(hash, indices.data(), indices.size_bytes());
    const std::scoped_lock lock(adding_);
    const AssetId known = find(hash, [&](const Entry& e) {
        return e.mesh && sameBytes(std::span<const MeshVertex>(e.mesh->vertices), vertices) &&
               sameBytes(std::span<const uint32_t>(e.mesh->indices), indices);
    });
    if (known)
        return known;
    float reach = 0.0f;
    for (const MeshVertex& vertex : vertices)
        reach = std::max(reach, glm::length(vertex.position));
    Entry entry;
    entry.hash = hash;
    entry.mesh = std::make_unique<MeshAsset>(
        MeshAsset{std::pmr::vector<MeshVertex>(vertices.begin(), vertices.end(), memory_),
                  std::pmr::vector<uint32_t>(indices.begin(), indices.end(), memory_), reach});
    return publish(std::move(entry), vertices.size_bytes() + indices.size_bytes());
}

Result<AssetId> AssetTable::addVolume(std::shared_ptr<const VoxelVolume> volume, uint64_t hash,
                                      CoarserLevels coarser)
{
    const std::scoped_lock lock(adding_);
    if (const AssetId known = find(hash, [&](const Entry& e) { return e.volume && *e.volume == *volume; }))
        return known;
    const uint64_t bytes = volume->bytes() + (coarser ? coarser->bytes() : 0);
    Entry entry;
    entry.hash = hash;
    entry.volume = std::move(volume);
    entry.coarser = std::move(coarser);
    return publish(std::move(entry), bytes);
}

Result<AssetId> AssetTable::addSequence(std::shared_ptr<VolumeSequence> sequence, uint64_t hash)
{
    const std::scoped_lock lock(adding_);
    if (const AssetId known = find(hash, [](const Entry& e) { return e.sequence != nullptr; }))
        return known;
    Entry entry;
    entry.hash = hash;
    entry.sequence = std::move(sequence);
    return publish(std::move(entry), 0);
}

} // namespace fx::base
