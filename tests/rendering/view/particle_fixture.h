/// @file particle_fixture.h
/// A view with an asset table and hand-made snapshots of particles and ribbons.
#pragma once

#include "foundation/assets/asset_table.h"
#include "foundation/snapshot/particle_kind.h"
#include "tests/rendering/view/view_fixture.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec4.hpp>

namespace fx::test {

/// One row of a group. A radius of 0 marks an empty row.
struct TestParticle
{
    glm::vec3 center{0.0f};
    float radius = 1.0f;
    glm::vec4 color{1.0f};
    float age = 10.0f;
    glm::vec3 velocity{0.0f};
    float angle = 0.0f;
    float frame = 0.0f;
    glm::quat orientation{1.0f, 0.0f, 0.0f, 0.0f};
};

/// One point of a ribbon.
struct TestPoint
{
    glm::vec3 center{0.0f};
    float halfWidth = 1.0f;
    float arc = 0.0f;
    glm::vec4 color{1.0f};
    uint64_t strip = 1;
    float age = 0.0f;
};

/// Converts a color to four binary16 numbers.
uint64_t packColor(const glm::vec4& color);

class ParticleTest : public ViewTest
{
protected:
    void SetUp() override;

    base::FrameSnapshot emptySnapshot(double seconds = 0.0);
    /// Adds a group of particles. The color 1 gives an exposed value of 1. Tests may change the constants of
    /// the group.
    base::SnapshotGroup& addParticles(base::FrameSnapshot& snapshot,
                                      const std::vector<TestParticle>& particles,
                                      base::ColumnSet columns = base::kAllColumns);
    base::SnapshotGroup& addRibbon(base::FrameSnapshot& snapshot, const std::vector<TestPoint>& points);
    Picture renderPair(const base::FrameSnapshot& newer, const base::FrameSnapshot* older,
                       double interpolation, const render::CameraView& camera);

    base::AssetTable assets_{std::pmr::get_default_resource()};
    uint32_t nextSolver_ = 100;
};

/// Sets constant `index` of a group.
inline void set(base::SnapshotGroup& group, size_t index, float value)
{
    group.editConstants()[index] = value;
}

/// A camera with parallel projection on the Z axis, 10 m from the origin. The height of the picture is 10 m.
render::CameraView flatCamera(float aspect = 1.0f);

} // namespace fx::test
