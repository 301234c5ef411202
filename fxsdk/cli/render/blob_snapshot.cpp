#include "fxsdk/cli/render/blob_snapshot.h"

#include <glm/common.hpp>

#include <algorithm>
#include <map>
#include <tuple>
#include <vector>

namespace fx::cli {
namespace {

namespace column = base::blob_column;
namespace constant = base::blob_constant;

constexpr int kPieceBits = 8; ///< of ids, below that of the ball: pieces of a streak have one id in a list

/// Middle of the box around all centers.
glm::dvec3 middleOf(std::span<const render::MediumBlob> blobs)
{
    if (blobs.empty())
        return glm::dvec3(0.0);
    glm::dvec3 low = blobs[0].center, high = low;
    for (const render::MediumBlob& blob : blobs) {
        low = glm::min(low, blob.center);
        high = glm::max(high, blob.center);
    }
    return 0.5 * low + 0.5 * high;
}

void setRow(base::SnapshotGroup& io, uint32_t row, const render::MediumBlob& blob, const glm::dvec3& origin)
{
    for (size_t c = 0; c < column::Count; ++c)
        io.editColumn(c)[row] = 0.0f;
    const auto setVector = [&](size_t first, const glm::dvec3& value) {
        for (size_t k = 0; k < 3; ++k)
            io.editColumn(first + k)[row] = float(value[int(k)]);
    };
    setVector(column::PositionX, blob.center - origin);
    setVector(column::VelocityX, blob.velocity);
    setVector(column::AlbedoR, blob.albedo);
    setVector(column::EmissionR, blob.source);
    io.editColumn(column::Radius)[row] = float(blob.radius);
    io.editColumn(column::CrossSection)[row] = float(blob.crossSection);
    io.editColumn(column::FireShare)[row] = float(blob.fireShare);
}

/// Around all rows.
base::Bounds boundsOf(const base::SnapshotGroup& group)
{
    base::Bounds bounds;
    for (uint32_t row = 0; row < group.count(); ++row)
        bounds.add({group.column(column::PositionX)[row], group.column(column::PositionY)[row],
                    group.column(column::PositionZ)[row]},
                   group.column(column::Radius)[row]);
    return bounds;
}

} // namespace

base::FrameSnapshot snapshotOfBlobs(std::span<const render::MediumBlob> blobs,
                                    const base::SnapshotSchema& schema, uint64_t sequence)
{
    std::map<std::tuple<uint64_t, double, base::MediaLayer>, std::vector<uint32_t>> groups;
    for (size_t i = 0; i < blobs.size(); ++i)
        groups[{blobs[i].instance, blobs[i].anisotropy, blobs[i].layer}].push_back(uint32_t(i));
    const glm::dvec3 origin = middleOf(blobs);
    base::FrameSnapshot snapshot(&schema, std::pmr::get_default_resource());
    snapshot.begin(0, sequence);
    uint32_t solver = 0;
    for (const auto& [properties, members] : groups) {
        const auto& [instance, anisotropy, layer] = properties;
        base::SnapshotGroup& group = snapshot.addGroup(schema.find(base::kBlobKind.name), members.size());
        uint64_t piece = 0; // of a streak, or of a list without ids
        for (uint32_t row = 0; row < members.size(); ++row) {
            setRow(group, row, blobs[members[row]], origin);
            const uint64_t id = blobs[members[row]].id;
            piece = row > 0 && blobs[members[row - 1]].id == id ? piece + 1 : 0;
            group.editIds()[row] = (id << kPieceBits) + piece;
        }
        group.editInfo().count = uint32_t(members.size());
        group.editInfo().instance = instance;
        group.editInfo().solver = solver++;
        group.editInfo().placement.position = origin;
        group.editInfo().bounds = boundsOf(group);
        for (size_t c = 0; c < constant::Count; ++c)
            group.editConstants()[c] = 0.0f;
        group.editConstants()[constant::Layer] = float(layer);
        group.editConstants()[constant::Anisotropy] = float(anisotropy);
    }
    return snapshot;
}

} // namespace fx::cli
