#include "rendering/field_detail/blob_detail.h"

#include "foundation/snapshot/block_groups.h"
#include "rendering/frame/snapshot_match.h"
#include "shaders/formulas/formula.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

namespace {

namespace constant = base::material_constant;
namespace column = base::material_column;

/// Number and weight of the younger generation as one number that grows evenly.
double phaseOf(const base::SnapshotGroup& group)
{
    return double(group.constants()[constant::Generation]) + double(group.constants()[constant::Fade]);
}

} // namespace

float thinningOf(const GroupDetail& detail, float crossSection, float radius)
{
    return thinningOf(detail.numbers, crossSection * detail.scale, radius);
}

BlobDetail::BlobDetail(const base::SnapshotPair& snapshots, size_t group, float t)
{
    const base::FrameSnapshot& newer = *snapshots.newer;
    if (group + 1 >= newer.groupCount())
        return;
    const base::GroupName blobs = newer.name(group);
    const base::GroupName name = newer.name(group + 1);
    if (newer.schema().kind(name.kind) != base::kMaterialKind || name.instance != blobs.instance ||
        name.solver != blobs.solver)
        return;
    const size_t same = findSameGroup(snapshots.older, newer, group + 1);
    read(newer.group(group + 1), same == kNoGroup ? nullptr : &snapshots.older->group(same), t);
}

BlobDetail::BlobDetail(const base::SnapshotGroup& newer, const base::SnapshotGroup* older, float t)
{
    read(newer, older, t);
}

void BlobDetail::read(const base::SnapshotGroup& newer, const base::SnapshotGroup* older, float t)
{
    chosen_ = newer_ = &newer;
    numbers_ = fieldDetailNumbers(chosen_->constants());
    if (!older || older->count() == 0 || phaseOf(*older) > phaseOf(*newer_))
        return;
    const double phase = phaseOf(*older) + double(t) * (phaseOf(*newer_) - phaseOf(*older));
    const float born = newer_->constants()[constant::Generation];
    const bool isUnborn = std::floor(phase) < double(born);
    if (isUnborn && older->constants()[constant::Generation] + 1.0f == born)
        chosen_ = older;
    std::array<float, constant::Count> constants;
    for (size_t c = 0; c < constant::Count; ++c)
        constants[c] = chosen_->constants()[c];
    if (chosen_ == older || !isUnborn)
        constants[constant::Fade] = float(phase - double(constants[constant::Generation]));
    if (older->constants()[constant::Generation] == born) {
        older_ = older;
        t_ = t;
        for (const size_t c : {constant::Growth0, constant::Growth1})
            constants[c] = older->constants()[c] + t * (newer_->constants()[c] - older->constants()[c]);
    }
    numbers_ = fieldDetailNumbers(constants);
}

GroupDetail BlobDetail::groupDetail(const base::Placement& place) const
{
    GroupDetail detail;
    detail.numbers = numbers_;
    detail.scale = place.scale;
    const glm::mat3 toGroup = glm::transpose(glm::mat3_cast(place.rotation)) * (1.0f / place.scale);
    for (size_t g = 0; g < 2; ++g) {
        const FieldDetailNumbers::Generation& own = numbers_.generations[g];
        detail.toCells[g] = toGroup * (own.growth / own.length);
        detail.first[g] = own.offset - detail.toCells[g] * glm::vec3(place.position);
    }
    return detail;
}

std::array<glm::vec3, 2> BlobDetail::carried(size_t newer, size_t older, bool hasOlder,
                                             const glm::vec3& position) const
{
    const bool isOlder = chosen_ != newer_ && hasOlder;
    const base::SnapshotGroup& group = isOlder ? *chosen_ : *newer_;
    const size_t i = isOlder ? older : newer;
    std::array<glm::vec3, 2> result;
    for (size_t g = 0; g < 2; ++g) {
        const size_t first = column::Place0X + 3 * g;
        glm::vec3 place = base::vectorAt(group, first, uint32_t(i));
        if (older_ && hasOlder)
            place = glm::mix(base::vectorAt(*older_, first, uint32_t(older)), place, t_);
        const FieldDetailNumbers::Generation& own = numbers_.generations[g];
        result[g] = (place - own.growth * position) / own.length;
    }
    return result;
}

} // namespace fx::render
