#include "rendering/particle_rows/row_casters.h"

#include "foundation/math/bits.h"
#include "foundation/snapshot/particle_kind.h"
#include "rendering/frame/snapshot_match.h"

#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

namespace fx::render {

namespace {

namespace column = base::particle_column;

constexpr float kTexelsOfBall = 1.5f; ///< least radius of a ball: rays through all texels add up to it

bool castsShadow(const RowTechnique* technique)
{
    return technique && technique->ball;
}

/// [row] a power of 2, so that the stretches of a growing group seldom change.
uint32_t rowsOfStretch(uint32_t rows, uint32_t most)
{
    return std::bit_ceil((rows + most - 1) / most);
}

uint32_t mostOfEachGroup(const RowCasterInputs& in, const RowTechniques& techniques)
{
    const base::FrameSnapshot& newer = *in.snapshots->newer;
    uint32_t groups = 0;
    for (size_t g = 0; g < newer.groupCount(); ++g)
        groups += castsShadow(techniques.of(newer.name(g).kind)) ? 1 : 0;
    return std::clamp(kMaxRowCasters / std::max(groups, 1u), kMinGroupCasters, kMaxGroupCasters);
}

/// Where a row is between two snapshots.
class RowMoment
{
public:
    /// @param older null: rows stay where they are  @param t of the way to the newer  @param seconds between
    RowMoment(const base::SnapshotGroup& newer, const base::SnapshotGroup* older, float t, float seconds)
        : newer_(newer), older_(older), t_(t), seconds_(seconds)
    {}

    /// @return false: the row is not yet born
    bool move(uint32_t row, glm::vec3& ioCenter) const
    {
        if (!older_)
            return true;
        const float age = newer_.column(column::Age)[row];
        if (age >= seconds_ && row < older_->count() && older_->column(column::Radius)[row] > 0.0f)
            ioCenter = glm::mix(vector(*older_, column::PositionX, row), ioCenter, t_);
        else if (newer_.has(column::VelocityX))
            ioCenter -= vector(newer_, column::VelocityX, row) * ((1.0f - t_) * seconds_);
        return age >= (1.0f - t_) * seconds_;
    }

private:
    static glm::vec3 vector(const base::SnapshotGroup& group, size_t first, uint32_t row)
    {
        return {group.column(first)[row], group.column(first + 1)[row], group.column(first + 2)[row]};
    }

    const base::SnapshotGroup& newer_;
    const base::SnapshotGroup* older_;
    float t_, seconds_;
};

void addGroup(const RowCasterInputs& in, size_t index, const RowTechnique& technique, uint32_t most,
              std::pmr::vector<MediumCaster>& io)
{
    const base::FrameSnapshot* before = in.snapshots->older;
    const base::SnapshotGroup& newer = in.snapshots->newer->group(index);
    const size_t same = findSameGroup(before, *in.snapshots->newer, index);
    const base::SnapshotGroup* older = same == kNoGroup ? nullptr : &before->group(same);
    const float t = float(glm::clamp(in.interpolation, 0.0, 1.0));
    const float seconds =
        before ? float(base::toSeconds(in.snapshots->newer->tick() - before->tick())) : 0.0f;
    const base::Placement place = placementAt(*in.snapshots, newer, older, t, in.eye);
    const RowMoment moment(newer, technique.isStrip ? nullptr : older, t, seconds);
    const uint32_t rows = technique.instances(newer);
    const uint32_t stretch = rowsOfStretch(rows, most);
    for (uint32_t first = 0; first < rows; first += stretch) {
        RowBall ball = technique.ball(newer, first, std::min(stretch, rows - first));
        if (!(ball.ownSection > 0.0f) || (!moment.move(ball.row, ball.center) && stretch == 1))
            continue;
        const glm::vec3 center = glm::vec3(place.position) + place.rotation * (ball.center * place.scale);
        const float radius = ball.radius * place.scale * std::cbrt(ball.crossSection / ball.ownSection);
        const float section = ball.crossSection * place.scale * place.scale;
        const float values[] = {center.x, center.y, center.z, radius, section};
        if (base::allFinite(values, int(std::size(values))) && radius > 0.0f)
            io.push_back({center, radius, section});
    }
}

} // namespace

float crossSectionOfDepth(float depth, float radius)
{
    return depth * radius * radius * (std::numbers::pi_v<float> / 3.5f);
}

float depthOfOpacity(float opacity)
{
    return -std::log1p(-glm::clamp(opacity, 0.0f, kMaxOpacity));
}

void gatherRowCasters(const RowCasterInputs& in, std::pmr::vector<MediumCaster>& ioCasters)
{
    if (!in.snapshots->newer)
        return;
    const base::FrameSnapshot& newer = *in.snapshots->newer;
    const RowTechniques techniques(in.techniques, newer.schema());
    const uint32_t most = mostOfEachGroup(in, techniques);
    for (size_t g = 0; g < newer.groupCount(); ++g) {
        const RowTechnique* technique = techniques.of(newer.name(g).kind);
        if (castsShadow(technique) && !(g < in.left.size() && in.left[g] != 0) &&
            technique->isThere(newer.group(g)))
            addGroup(in, g, *technique, most, ioCasters);
    }
}

void widenCasters(std::span<MediumCaster> ioCasters, std::span<const MediumCaster> all, int texels)
{
    if (ioCasters.empty())
        return;
    glm::vec3 low(std::numeric_limits<float>::infinity()), high(-low);
    for (const MediumCaster& caster : all) {
        low = glm::min(low, caster.center - caster.radius);
        high = glm::max(high, caster.center + caster.radius);
    }
    const glm::vec3 size = high - low;
    const float least = std::max({size.x, size.y, size.z}) * (kTexelsOfBall / float(texels));
    for (MediumCaster& caster : ioCasters)
        caster.radius = std::max(caster.radius, least);
}

} // namespace fx::render
