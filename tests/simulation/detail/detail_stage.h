/// @file detail_stage.h
/// Access to the groups of material coordinates in a snapshot, for tests.
#pragma once

#include "tests/simulation/stage.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <vector>

namespace fx::test {

namespace column = base::material_column;
namespace constant = base::material_constant;

/// The groups of one solver: blobs, and material coordinates if the solver publishes them.
struct DetailGroups
{
    explicit DetailGroups(const base::FrameSnapshot& snapshot)
    {
        for (size_t g = 0; g < snapshot.groupCount(); ++g) {
            const base::SnapshotGroup& group = snapshot.group(g);
            (snapshot.schema().kind(group.info().kind) == base::kMaterialKind ? material : blobs) = &group;
        }
    }
    const base::SnapshotGroup* blobs = nullptr;
    const base::SnapshotGroup* material = nullptr;

    static glm::vec3 vector(const base::SnapshotGroup& group, size_t first, size_t i)
    {
        return {group.column(first)[i], group.column(first + 1)[i], group.column(first + 2)[i]};
    }
    glm::vec3 position(size_t i) const { return vector(*blobs, base::blob_column::PositionX, i); }
    glm::vec3 velocity(size_t i) const { return vector(*blobs, base::blob_column::VelocityX, i); }
    uint32_t younger() const { return uint32_t(material->constants()[constant::Generation]); }
    float fade() const { return material->constants()[constant::Fade]; }
    glm::vec3 place(uint32_t generation, size_t i) const
    {
        return vector(*material, generation % 2 == 0 ? column::Place0X : column::Place1X, i);
    }
};

/// All columns and ids of a group, as numbers.
inline std::vector<float> allOf(const base::SnapshotGroup& group, size_t columns)
{
    std::vector<float> all(group.constants().begin(), group.constants().end());
    for (const uint64_t id : group.ids())
        all.push_back(float(id & 0xFFFFFF));
    for (size_t c = 0; c < columns; ++c)
        all.insert(all.end(), group.column(c).begin(), group.column(c).end());
    return all;
}

} // namespace fx::test
