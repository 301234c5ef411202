#include "rendering/volumes/volume_place.h"

#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/material_kind.h"
#include "foundation/snapshot/volume_kind.h"

#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

namespace {

constexpr double kTurned = 1e-6; ///< largest component of a rotation about an axis that counts as none

} // namespace

glm::dvec3 GroupVolume::origin() const
{
    return glm::transpose(toVoxels) * (side * side) * -first; // the inverse of a rotation over `side`
}

const base::SnapshotGroup* volumeGroup(const base::FrameSnapshot& snapshot, size_t group)
{
    const base::GroupName blobs = snapshot.name(group);
    for (size_t g = group + 1; g < snapshot.groupCount(); ++g) {
        const base::GroupName next = snapshot.name(g);
        if (next.instance != blobs.instance || next.solver != blobs.solver)
            return nullptr;
        const base::KindDesc& kind = snapshot.schema().kind(next.kind);
        if (kind == base::kVolumeKind)
            return &snapshot.group(g);
        if (!(kind == base::kMaterialKind))
            return nullptr;
    }
    return nullptr;
}

GroupVolume groupVolume(const base::SnapshotGroup& blobs, const base::SnapshotGroup& volume,
                        const base::Placement& place, double t)
{
    namespace c = base::volume_constant;
    const auto constants = volume.constants();
    const double scale = double(place.scale), own = double(constants[c::Side]);
    GroupVolume out;
    out.asset = uint32_t(constants[c::Asset]);
    out.frame = glm::mix(double(constants[c::FrameBefore]), double(constants[c::Frame]), t);
    out.loops = constants[c::Loops] > 0.0f;
    out.frameSeconds = double(constants[c::FrameSeconds]);
    out.lattice = uint32_t(constants[c::Lattice]);
    out.side = own * scale;
    out.density = double(constants[c::Density]) / scale;
    const glm::dquat rotation(place.rotation);
    out.isAligned = std::max({std::abs(rotation.x), std::abs(rotation.y), std::abs(rotation.z)}) < kTurned;
    out.toVoxels =
        (out.isAligned ? glm::dmat3(1.0) : glm::transpose(glm::mat3_cast(rotation))) * (1.0 / out.side);
    const glm::dvec3 origin{constants[c::OriginX], constants[c::OriginY], constants[c::OriginZ]};
    out.first = -(out.toVoxels * place.position) - origin / own;
    if (blobs.count() > 0)
        out.fireShare = glm::clamp(blobs.column(base::blob_column::FireShare)[0], 0.0f, 1.0f);
    out.tint = base::tintOf(blobs.constants());
    out.anisotropy = blobs.constants()[base::blob_constant::Anisotropy];
    out.layer = uint32_t(blobs.constants()[base::blob_constant::Layer]);
    return out;
}

FramePair framePair(const GroupVolume& volume, uint32_t count)
{
    const double begun = volume.loops ? std::floor(volume.frame / double(count)) * double(count) : 0.0;
    const double frame = std::max(volume.frame, 0.0) - std::max(begun, 0.0);
    const auto last = double(count - 1);
    FramePair pair;
    pair.first = uint32_t(std::min(frame, last));
    pair.part =
        pair.first == count - 1 && !volume.loops ? 0.0 : std::clamp(frame - double(pair.first), 0.0, 1.0);
    pair.second = pair.part > 0.0 ? (pair.first + 1) % count : pair.first;
    return pair;
}

MediumVolume::Moment momentOf(const GroupVolume& volume, const FramePair& pair,
                              const base::VolumeSequence& sequence)
{
    const base::VolumeLattice shown = sequence.lattice(volume.lattice);
    const auto mapTo = [&](uint32_t frame) {
        const base::VolumeLattice own = sequence.lattice(frame);
        return own == shown ? base::LatticeMap() : base::LatticeMap(shown, own);
    };
    return {pair.part, sequence.hasVelocities() ? volume.frameSeconds : 0.0, mapTo(pair.first),
            mapTo(pair.second)};
}

} // namespace fx::render
