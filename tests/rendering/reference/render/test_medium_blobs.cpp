/// Blobs between two snapshots.

#include "rendering/reference/render/medium_blobs.h"

#include "rendering/optics/black_body.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory_resource>
#include <vector>

namespace fx::render {
namespace {

namespace column = base::blob_column;
namespace constant = base::blob_constant;

/// Two snapshots of one group.
class MediumBlobs : public ::testing::Test
{
protected:
    MediumBlobs() { kind_ = schema_.add(base::kBlobKind); }

    /// Adds a group with elements of the given ids, all of radius 1, cross section 2, at rest in the origin.
    base::SnapshotGroup& addGroup(base::FrameSnapshot& snapshot, const std::vector<uint64_t>& ids)
    {
        base::SnapshotGroup& group = snapshot.addGroup(kind_, ids.size());
        group.editInfo().count = uint32_t(ids.size());
        group.editInfo().instance = 5;
        std::copy(ids.begin(), ids.end(), group.editIds().begin());
        for (size_t c = 0; c < column::Count; ++c)
            for (size_t i = 0; i < ids.size(); ++i)
                group.editColumn(c)[i] =
                    c == column::Radius ? 1.0f : (c == column::CrossSection ? 2.0f : 0.0f);
        for (float& value : group.editConstants())
            value = 0.0f;
        return group;
    }

    base::SnapshotPair pair() { return {&newer_, &older_}; }

    void SetUp() override
    {
        older_.begin(0, 1);
        newer_.begin(base::kTicksPerSecond, 2);
    }

    base::SnapshotSchema schema_;
    base::KindId kind_;
    base::FrameSnapshot older_{&schema_, std::pmr::get_default_resource()};
    base::FrameSnapshot newer_{&schema_, std::pmr::get_default_resource()};
};

TEST_F(MediumBlobs, aMatchedBlobIsBetweenItsTwoStates)
{
    addGroup(older_, {3, 8}).editColumn(column::PositionX)[1] = 1.0f;
    base::SnapshotGroup& group = addGroup(newer_, {8});
    group.editColumn(column::PositionX)[0] = 3.0f;
    group.editColumn(column::Radius)[0] = 2.0f;
    const MediumList list = mediumOf(pair(), 0.25);
    ASSERT_EQ(list.blobs.size(), 1u);
    EXPECT_DOUBLE_EQ(list.blobs[0].center.x, 1.5);
    EXPECT_DOUBLE_EQ(list.blobs[0].radius, 1.25);
}

TEST_F(MediumBlobs, severalGroupsOfASolverAreMatchedInTheirOrder)
{
    for (const bool isShifted : {false, true}) { // by the group of another instance, which has ended
        SetUp();
        if (isShifted)
            addGroup(older_, {1}).editInfo().instance = 4;
        for (base::FrameSnapshot* const snapshot : {&older_, &newer_}) {
            addGroup(*snapshot, {3, 8});
            addGroup(*snapshot, {5, 8}).editColumn(column::PositionX)[1] = snapshot == &older_ ? 1.0f : 3.0f;
        }
        const MediumList list = mediumOf(pair(), 0.25);
        ASSERT_EQ(list.blobs.size(), 4u);
        EXPECT_DOUBLE_EQ(list.blobs[1].center.x, 0.0);
        EXPECT_DOUBLE_EQ(list.blobs[3].center.x, 1.5);
    }
}

TEST_F(MediumBlobs, haveTheirAgeAndTheRateOfTheirLight)
{
    base::SnapshotGroup& before = addGroup(older_, {7, 8});
    base::SnapshotGroup& group = addGroup(newer_, {7, 8, 9});
    before.editColumn(column::Temperature)[0] = 1800.0f;
    group.editColumn(column::Temperature)[0] = 1500.0f;
    before.editColumn(column::Age)[0] = 2.0f;
    group.editColumn(column::Age)[0] = 3.0f;
    before.editColumn(column::EmissionG)[1] = 10.0f;
    group.editColumn(column::EmissionG)[1] = 30.0f;
    group.editColumn(column::EmissionG)[2] = 30.0f;
    group.editColumn(column::Age)[2] = 0.9f;
    const MediumList list = mediumOf(pair(), 0.5);
    ASSERT_EQ(list.blobs.size(), 3u);
    const auto luminance = [](float temperature) {
        return glm::dot(kLuminance, glm::dvec3(blackBodyLuminance(temperature)));
    };
    EXPECT_NEAR(list.blobs[0].sourceRate, std::log(luminance(1500.0f) / luminance(1800.0f)), 1e-6);
    EXPECT_NEAR(list.blobs[1].sourceRate, std::log(3.0), 1e-6); // a second
    EXPECT_EQ(list.blobs[2].sourceRate, 0.0);                   // born in this step
    EXPECT_NEAR(list.blobs[0].age, 2.5, 1e-6);
    EXPECT_NEAR(list.blobs[2].age, 0.4, 1e-6);
}

TEST_F(MediumBlobs, anUnbornBlobIsLeftOutAndANewbornIsCarriedBack)
{
    addGroup(older_, {});
    base::SnapshotGroup& group = addGroup(newer_, {1, 2});
    group.editColumn(column::Age)[0] = 0.1f;
    group.editColumn(column::Age)[1] = 0.6f;
    group.editColumn(column::VelocityY)[1] = 2.0f;
    const MediumList list = mediumOf(pair(), 0.5);
    ASSERT_EQ(list.blobs.size(), 1u);
    EXPECT_DOUBLE_EQ(list.blobs[0].center.y, -1.0);
}

TEST_F(MediumBlobs, placementTurnsScalesAndMovesInDouble)
{
    base::SnapshotGroup& group = addGroup(newer_, {1});
    group.editColumn(column::PositionX)[0] = 1.0f;
    group.editInfo().placement.position = {1e7, 0.1, 0.0};
    group.editInfo().placement.rotation = glm::angleAxis(float(M_PI / 2), glm::vec3(0, 0, 1));
    group.editInfo().placement.scale = 3.0f;
    const MediumList list = mediumOf({&newer_, nullptr}, 1.0);
    ASSERT_EQ(list.blobs.size(), 1u);
    EXPECT_NEAR(list.blobs[0].center.x, 1e7, 1e-6);
    EXPECT_NEAR(list.blobs[0].center.y, 3.1, 1e-6);
    EXPECT_DOUBLE_EQ(list.blobs[0].radius, 3.0);
    EXPECT_DOUBLE_EQ(list.blobs[0].crossSection, 18.0);
}

TEST_F(MediumBlobs, lightIsTheAbsorbingShareOfABlackBodyAndTheOwnEmission)
{
    base::SnapshotGroup& group = addGroup(newer_, {1});
    group.editColumn(column::Temperature)[0] = 1800.0f;
    group.editColumn(column::AlbedoR)[0] = 0.25f;
    group.editColumn(column::EmissionR)[0] = 7.0f;
    const glm::dvec3 source = mediumOf({&newer_, nullptr}, 1.0).blobs[0].source;
    const glm::dvec3 black(blackBodyLuminance(1800.0f));
    EXPECT_DOUBLE_EQ(source.x, 0.75 * black.x + 7.0);
    EXPECT_DOUBLE_EQ(source.y, black.y);
}

TEST_F(MediumBlobs, aShutterDrawsABlobOutWithoutAddingMedium)
{
    base::SnapshotGroup& group = addGroup(newer_, {1});
    group.editColumn(column::VelocityX)[0] = 30.0f;
    group.editConstants()[constant::Shutter] = 0.1f;
    const MediumList list = mediumOf({&newer_, nullptr}, 1.0);
    ASSERT_EQ(list.blobs.size(), 4u); // 3 m in steps of at most a radius
    double sum = 0.0;
    for (const MediumBlob& blob : list.blobs)
        sum += blob.crossSection;
    EXPECT_DOUBLE_EQ(sum, 2.0);
    EXPECT_NEAR(list.blobs.back().center.x, -2.25, 1e-6);
}

TEST_F(MediumBlobs, aStreakOfAnyLengthHasNoGaps)
{
    base::SnapshotGroup& group = addGroup(newer_, {1});
    group.editConstants()[constant::Shutter] = 0.1f;
    const double radius = mediumOf({&newer_, nullptr}, 1.0).blobs[0].radius;
    for (const double radii : {0.5, 3.5, 11.0, 40.0, 63.5, 100.0, 1e4, 1e7}) {
        group.editColumn(column::VelocityX)[0] = float(10.0 * radii * radius); // radii of way in 0.1 s
        const std::vector<MediumBlob> blobs = mediumOf({&newer_, nullptr}, 1.0).blobs;
        double sum = blobs[0].crossSection;
        for (size_t k = 1; k < blobs.size(); ++k) {
            const double apart = blobs[k - 1].center.x - blobs[k].center.x;
            ASSERT_LE(apart, blobs[k].radius * (1.0 + 1e-6)) << radii;
            sum += blobs[k].crossSection;
        }
        EXPECT_NEAR(sum, 2.0, 1e-12) << radii;
        EXPECT_NEAR(-blobs.back().center.x - radii * radius, 0.0, blobs[0].radius * (1.0 + 1e-6)) << radii;
        EXPECT_NEAR(blobs[0].radius / radius, std::max(radii / 64.0, 1.0), 1e-6 * radii) << radii;
    }
}

TEST_F(MediumBlobs, numbersThatAreNotFiniteAreCountedAndLeftOut)
{
    base::SnapshotGroup& group = addGroup(newer_, {1, 2, 3});
    group.editColumn(column::PositionZ)[0] = std::numeric_limits<float>::quiet_NaN();
    group.editColumn(column::EmissionB)[2] = std::numeric_limits<float>::infinity();
    const MediumList list = mediumOf({&newer_, nullptr}, 1.0);
    EXPECT_EQ(list.blobs.size(), 1u);
    EXPECT_EQ(list.nonFinite, 2u);
}

} // namespace
} // namespace fx::render
