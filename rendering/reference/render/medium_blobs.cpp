#include "rendering/reference/render/medium_blobs.h"

#include "foundation/math/bits.h"
#include "foundation/snapshot/streak.h"
#include "rendering/field_detail/conservation_factor.h"
#include "rendering/frame/snapshot_match.h"
#include "rendering/optics/black_body.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory_resource>

namespace fx::render {

namespace {

namespace column = base::blob_column;
namespace constant = base::blob_constant;

/// A moment of a group: the newer snapshot's elements, and their places in the older.
class GroupMoment
{
public:
    /// @param detail of the group  @param volume for which the elements stand; null: none
    GroupMoment(const base::SnapshotGroup& newer, const base::SnapshotGroup* older, double t,
                double stepSeconds, const BlobDetail& detail, const base::SnapshotGroup* volumeGroup,
                const VolumeLookup& volumes)
        : newer_(newer), older_(older), t_(older ? t : 1.0), stepSeconds_(stepSeconds), detail_(detail)
    {
        place_ = newer.info().placement;
        if (older) {
            const base::Placement& before = older->info().placement;
            place_.position = glm::mix(before.position, place_.position, t);
            place_.rotation = glm::slerp(before.rotation, place_.rotation, float(t));
            place_.scale = glm::mix(before.scale, place_.scale, float(t));
        }
        if (!volumeGroup)
            return;
        base::Placement here = place_;
        here.position = glm::dvec3(0.0);
        groupVolume_ = groupVolume(newer_, *volumeGroup, here, t_);
        volume_ = volumes(groupVolume_);
    }

    void appendTo(MediumList& out)
    {
        if (detail_.isGiven()) {
            base::Placement here = place_; // relative to its own origin, from where floats are exact enough
            here.position = glm::dvec3(0.0);
            groupDetail_ = detail_.groupDetail(here);
        }
        if (volume_ || detail_.isGiven())
            group_ = int32_t(out.details.groups.size());
        if (volume_)
            out.details.groups.push_back({groupDetail_, place_.position, volume_, groupVolume_});
        size_t j = 0;
        for (size_t i = 0; i < newer_.count(); ++i) {
            const size_t old = oldPlaceOf(i, j);
            if (old == kNone && older_ && newer_.column(column::Age)[i] < (1.0 - t_) * stepSeconds_)
                continue; // not yet born
            append(i, old, out);
        }
        if (detail_.isGiven() && !volume_) {
            groupDetail_.factor =
                ConservationFactor(std::pmr::get_default_resource()).of(groupDetail_, casters_);
            out.details.groups.push_back({groupDetail_, place_.position});
            out.details.groups.back().place.tint = base::tintOf(newer_.constants());
        }
    }

private:
    static constexpr size_t kNone = std::numeric_limits<size_t>::max();

    size_t oldPlaceOf(size_t i, size_t& ioNext) const
    {
        if (!older_)
            return kNone;
        const auto ids = older_->ids();
        const uint64_t id = newer_.ids()[i];
        while (ioNext < ids.size() && ids[ioNext] < id)
            ++ioNext;
        return ioNext < ids.size() && ids[ioNext] == id ? ioNext : kNone;
    }

    double value(size_t c, size_t i, size_t old) const
    {
        const double now = double(newer_.column(c)[i]);
        return old == kNone ? now : glm::mix(double(older_->column(c)[old]), now, t_);
    }
    glm::dvec3 vector(size_t c, size_t i, size_t old) const
    {
        return {value(c, i, old), value(c + 1, i, old), value(c + 2, i, old)};
    }

    void append(size_t i, size_t old, MediumList& out)
    {
        const glm::dvec3 velocity = vector(column::VelocityX, i, old);
        glm::dvec3 position = vector(column::PositionX, i, old);
        if (old == kNone && older_)
            position -= velocity * ((1.0 - t_) * stepSeconds_);
        const double scale = double(place_.scale);
        const glm::dquat rotation(place_.rotation);
        const float temperature = float(value(column::Temperature, i, old));

        MediumBlob blob;
        blob.center = place_.position + rotation * (position * scale);
        blob.radius = value(column::Radius, i, old) * scale;
        blob.crossSection = value(column::CrossSection, i, old) * scale * scale;
        blob.albedo = vector(column::AlbedoR, i, old);
        blob.source = sourceOf(blob.albedo, temperature, vector(column::EmissionR, i, old));
        blob.sourceRate = sourceRate(i, old);
        blob.age = value(column::Age, i, old);
        if (old == kNone && older_)
            blob.age -= (1.0 - t_) * stepSeconds_;
        blob.fireShare = glm::clamp(value(column::FireShare, i, old), 0.0, 1.0);
        blob.anisotropy = double(newer_.constants()[constant::Anisotropy]);
        blob.layer = base::MediaLayer(uint32_t(newer_.constants()[constant::Layer]));
        blob.instance = newer_.info().instance;
        blob.velocity = worldVelocity(i, old, position);
        blob.temperature = double(temperature);
        blob.id = newer_.ids()[i];
        const glm::dvec3 streak =
            rotation * (velocity * scale) * double(newer_.constants()[constant::Shutter]);
        if (!isFinite(blob) || !base::isFinite(temperature) || !base::isFinite(glm::dot(streak, streak))) {
            ++out.nonFinite;
            return;
        }
        if (!(blob.crossSection > 0.0 && blob.radius > 0.0))
            return;
        appendStreak(blob, streak, out);
        MediumDetails::Ball ball{group_, {}, temperature, 0.0f, 0.0f};
        if (volume_) {
            const GroupVolume& own = out.details.groups.back().place;
            const glm::dvec3 voxel = own.voxelAt(out.blobs.back().center - place_.position);
            const glm::ivec3 brick(glm::floor(voxel / double(base::kVolumeBrickSide)));
            ball.largest = float(double(volume_->largestIn(brick)) * own.density);
        }
        if (detail_.isGiven() && !volume_) {
            ball.carried = detail_.carried(i, old, old != kNone, glm::vec3(position));
            const MediumBlob& piece = out.blobs.back();
            ball.thinning = thinningOf(groupDetail_, float(piece.crossSection), float(piece.radius));
            const glm::vec3 center(blob.center - place_.position);
            casters_.push_back(
                {{center, float(blob.radius), float(blob.crossSection)}, ball.carried, newer_.ids()[i]});
        }
        out.details.balls.resize(out.blobs.size(), ball); // all pieces of the streak
    }

    glm::dvec3 sourceOf(const glm::dvec3& albedo, float temperature, const glm::dvec3& emission) const
    {
        const glm::dvec3 tint(base::tintOf(newer_.constants()));
        return (1.0 - albedo) * tint * glm::dvec3(blackBodyLuminance(temperature)) + emission;
    }

    double sourceRate(size_t i, size_t old) const
    {
        if (old == kNone || !(stepSeconds_ > 0.0))
            return 0.0;
        const auto luminance = [&](const base::SnapshotGroup& group, size_t row) {
            const auto at = [&](size_t c) { return double(group.column(c)[row]); };
            const auto three = [&](size_t c) { return glm::dvec3(at(c), at(c + 1), at(c + 2)); };
            return glm::dot(kLuminance, sourceOf(three(column::AlbedoR), float(at(column::Temperature)),
                                                 three(column::EmissionR)));
        };
        const double rate = std::log(luminance(newer_, i) / luminance(*older_, old)) / stepSeconds_;
        return base::isFinite(rate) ? rate : 0.0;
    }

    /// Between two snapshots, the way from one to the other; that of the group included.
    glm::dvec3 worldVelocity(size_t i, size_t old, const glm::dvec3& position) const
    {
        glm::dvec3 local = vector(column::VelocityX, i, old);
        if (!older_ || !(stepSeconds_ > 0.0))
            return glm::dquat(place_.rotation) * (local * double(place_.scale));
        if (old != kNone)
            for (int axis = 0; axis < 3; ++axis)
                local[axis] = (double(newer_.column(column::PositionX + size_t(axis))[i]) -
                               double(older_->column(column::PositionX + size_t(axis))[old])) /
                              stepSeconds_;
        const base::Placement& now = newer_.info().placement;
        const base::Placement& then = older_->info().placement;
        const glm::dvec3 drift = now.position - then.position +
                                 glm::dquat(now.rotation) * (position * double(now.scale)) -
                                 glm::dquat(then.rotation) * (position * double(then.scale));
        return glm::dquat(place_.rotation) * (local * double(place_.scale)) + drift / stepSeconds_;
    }

    static bool isFinite(const MediumBlob& b)
    {
        const double sum = b.center.x + b.center.y + b.center.z + b.radius + b.crossSection + b.albedo.x +
                           b.albedo.y + b.albedo.z + b.source.x + b.source.y + b.source.z + b.fireShare;
        return base::isFinite(sum);
    }

    /// A moving blob is seen along its way while the shutter is open.
    static void appendStreak(const MediumBlob& blob, const glm::dvec3& streak, MediumList& out)
    {
        const base::Streak<double> line = base::streakOf(glm::length(streak), blob.radius);
        for (int k = 0; k < line.count; ++k) {
            out.blobs.push_back(blob);
            out.blobs.back().radius = line.radius;
            out.blobs.back().crossSection *= line.shareOf(k);
            out.blobs.back().center -= streak * (double(k) / line.count);
        }
    }

    const base::SnapshotGroup& newer_;
    const base::SnapshotGroup* older_;
    double t_;
    double stepSeconds_;
    const BlobDetail& detail_;
    GroupVolume groupVolume_;
    std::shared_ptr<const MediumVolume> volume_; ///< null: the blobs are the medium
    GroupDetail groupDetail_;
    int32_t group_ = -1; ///< number of the detail
    std::vector<DetailedCaster> casters_;
    base::Placement place_;
};

} // namespace

MediumList mediumOf(const base::SnapshotPair& snapshots, double interpolation, const VolumeLookup& volumes)
{
    MediumList list;
    if (!snapshots.newer)
        return list;
    const base::FrameSnapshot& newer = *snapshots.newer;
    const base::KindId kind = newer.schema().find(base::kBlobKind.name);
    const double stepSeconds =
        snapshots.older ? base::toSeconds(newer.tick() - snapshots.older->tick()) : 0.0;
    for (size_t g = 0; g < newer.groupCount(); ++g) {
        const base::SnapshotGroup& group = newer.group(g);
        if (group.info().kind != kind)
            continue;
        const BlobDetail detail(snapshots, g, float(glm::clamp(interpolation, 0.0, 1.0)));
        const base::SnapshotGroup* const volume = volumes ? volumeGroup(newer, g) : nullptr;
        const size_t same = findSameGroup(snapshots.older, newer, g);
        const base::SnapshotGroup* const older = same == kNoGroup ? nullptr : &snapshots.older->group(same);
        GroupMoment(group, older, glm::clamp(interpolation, 0.0, 1.0), stepSeconds, detail, volume, volumes)
            .appendTo(list);
    }
    if (!list.details.isGiven())
        list.details.balls.clear();
    return list;
}

} // namespace fx::render
