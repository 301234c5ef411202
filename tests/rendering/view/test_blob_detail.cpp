// The detail of a group of blobs between two snapshots.
#include "foundation/memory/host_memory.h"
#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/frame_snapshot.h"
#include "foundation/snapshot/material_kind.h"
#include "rendering/field_detail/blob_detail.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <vector>

using namespace fx;
using namespace fx::render;

namespace {

namespace column = base::material_column;
namespace constant = base::material_constant;

/// Snapshots with one blob each, at x = 3.
class BlobDetails : public testing::Test
{
protected:
    BlobDetails()
    {
        blob_ = schema_.add(base::kBlobKind);
        material_ = schema_.add(base::kMaterialKind);
    }
    /// @param places x of the blob's coordinates of even and odd generations
    void fill(base::FrameSnapshot& snapshot, float generation, float fade, std::array<float, 2> places)
    {
        snapshot.begin(1, 1);
        snapshot.addGroup(blob_, 1).editInfo().count = 1;
        base::SnapshotGroup& group = snapshot.addGroup(material_, 1);
        group.editInfo().count = 1;
        for (size_t c = 0; c < column::Count; ++c)
            group.editColumn(c)[0] = 0.0f;
        group.editColumn(column::Place0X)[0] = places[0];
        group.editColumn(column::Place1X)[0] = places[1];
        const float constants[] = {generation, fade,  2.0f,  4.0f,  1.0f, 1.0f,
                                   0.5f,       20.0f, 0.25f, 0.55f, 0.0f, 0.0f};
        std::copy(std::begin(constants), std::end(constants), group.editConstants().begin());
    }
    BlobDetail at(float t) { return BlobDetail({.newer = &newer_, .older = &older_}, 0, t); }

    base::HostMemory memory_;
    base::SnapshotSchema schema_;
    base::KindId blob_ = 0, material_ = 0;
    base::FrameSnapshot older_{&schema_, &memory_}, newer_{&schema_, &memory_};
};

} // namespace

TEST_F(BlobDetails, weightsChangeEvenlyAcrossABirth)
{
    fill(older_, 6.0f, 0.8f, {1.0f, 9.0f}); // 6 and 5 live
    fill(newer_, 7.0f, 0.3f, {1.0f, 5.0f}); // 7 is born between the two
    for (const float t : {0.0f, 0.2f, 0.39f, 0.41f, 0.7f, 1.0f}) {
        const float phase = 6.8f + 0.5f * t;
        const bool isBorn = phase >= 7.0f;
        const float fade = phase - (isBorn ? 7.0f : 6.0f);
        const float odd = isBorn ? fade : 1.0f - fade; // weight of the odd generation
        EXPECT_NEAR(at(t).groupDetail({}).numbers.fade, odd, 1e-5f) << t;
        const auto carried = at(t).carried(0, 0, true, {3.0f, 0.0f, 0.0f});
        EXPECT_NEAR(carried[0].x, (1.0f - 3.0f) / 2.0f, 1e-6f);
        EXPECT_NEAR(carried[1].x, ((isBorn ? 5.0f : 9.0f) - 3.0f) / 4.0f, 1e-6f) << t;
    }
}

TEST_F(BlobDetails, aGenerationThatIsBornOrDiesHasNoWeight)
{
    fill(older_, 6.0f, 0.8f, {1.0f, 9.0f});
    fill(newer_, 7.0f, 0.3f, {1.0f, 5.0f});
    EXPECT_NEAR(at(0.3999f).groupDetail({}).numbers.fade, 0.0f, 1e-3f);
    EXPECT_NEAR(at(0.4001f).groupDetail({}).numbers.fade, 0.0f, 1e-3f);
}

TEST_F(BlobDetails, ofBallsThatMoveWithinABlockChangeEvenlyWithinAGeneration)
{
    fill(older_, 6.0f, 0.2f, {1.0f, 9.0f});
    fill(newer_, 6.0f, 0.6f, {2.0f, 9.0f}); // the ball has moved by 1
    for (const float t : {0.0f, 0.3f, 1.0f}) {
        const auto carried = at(t).carried(0, 0, true, {3.0f + t, 0.0f, 0.0f}); // and so has its position
        EXPECT_NEAR(carried[0].x, (1.0f - 3.0f) / 2.0f, 1e-6f) << t;
    }
}

TEST_F(BlobDetails, cellsFollowThePlacementOfTheGroup)
{
    fill(newer_, 7.0f, 0.3f, {1.0f, 5.0f});
    base::Placement place;
    place.position = {4.0, -1.0, 2.0};
    place.rotation = glm::angleAxis(0.7f, glm::normalize(glm::vec3(1, 2, 3)));
    place.scale = 2.5f;
    const GroupDetail detail = BlobDetail({.newer = &newer_}, 0, 1.0f).groupDetail(place);
    const glm::vec3 local(0.3f, -0.8f, 1.4f);
    const glm::vec3 world = glm::vec3(place.position) + place.rotation * (local * place.scale);
    for (size_t g = 0; g < 2; ++g) {
        const glm::vec3 cells = detail.toCells[g] * world + detail.first[g];
        const glm::vec3 want =
            local / detail.numbers.generations[g].length + detail.numbers.generations[g].offset;
        EXPECT_LT(glm::length(cells - want), 1e-4f);
    }
}

TEST_F(BlobDetails, groupsWithoutCoordinatesHaveNone)
{
    newer_.begin(1, 1);
    newer_.addGroup(blob_, 1).editInfo().count = 1;
    EXPECT_FALSE(BlobDetail({.newer = &newer_}, 0, 1.0f).isGiven());
}
