/// A list of blobs as a snapshot, and back.

#include "fxsdk/cli/render/blob_snapshot.h"

#include "fxsdk/cli/render/blob_list_reader.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace fx::cli {
namespace {

constexpr const char* kList = "x[m],y[m],z[m],radius[m],tau_area[m2],albedo,er,eg,eb,g\n"
                              "1000000.5,0,0,1,2,0.5,4,2,1,0.25\n"
                              "1000001.5,-1,3,0.5,1,0.75,0,0,8,-0.5\n"
                              "999999,2,1,0.25,4,0,1,2,3,0.25\n";

base::SnapshotSchema blobSchema()
{
    base::SnapshotSchema schema;
    schema.add(base::kBlobKind);
    return schema;
}

TEST(BlobSnapshot, holdsEveryBlobOfTheList)
{
    const auto blobs = readBlobList(kList, "a.blobs.csv");
    ASSERT_TRUE(blobs.ok());
    const base::SnapshotSchema schema = blobSchema();
    const base::FrameSnapshot snapshot = snapshotOfBlobs(*blobs, schema, 1);
    EXPECT_EQ(snapshot.groupCount(), 2u) << "one for each anisotropy";
    render::MediumList back = render::mediumOf({&snapshot, nullptr}, 1.0);
    EXPECT_EQ(back.nonFinite, 0u);
    ASSERT_EQ(back.blobs.size(), 3u);
    for (const render::MediumBlob& blob : *blobs) {
        const auto same =
            std::find_if(back.blobs.begin(), back.blobs.end(), [&](const render::MediumBlob& b) {
                return glm::length(b.center - blob.center) < 1e-6;
            });
        ASSERT_NE(same, back.blobs.end());
        EXPECT_EQ(same->radius, blob.radius);
        EXPECT_EQ(same->crossSection, blob.crossSection);
        EXPECT_EQ(same->albedo, blob.albedo);
        EXPECT_EQ(same->source, blob.source) << "cold: no light but its own";
        EXPECT_EQ(same->anisotropy, blob.anisotropy);
        EXPECT_EQ(same->layer, blob.layer);
    }
}

TEST(BlobSnapshot, boundsHoldEveryBlob)
{
    const auto blobs = readBlobList(kList, "a.blobs.csv");
    const base::SnapshotSchema schema = blobSchema();
    const base::FrameSnapshot snapshot = snapshotOfBlobs(*blobs, schema, 1);
    for (size_t g = 0; g < snapshot.groupCount(); ++g) {
        const base::SnapshotGroup& group = snapshot.group(g);
        for (uint32_t row = 0; row < group.count(); ++row) {
            const float x = group.column(base::blob_column::PositionX)[row];
            const float radius = group.column(base::blob_column::Radius)[row];
            EXPECT_LE(group.info().bounds.min.x, x - radius);
            EXPECT_GE(group.info().bounds.max.x, x + radius);
        }
    }
}

/// Ids by the position of the ball along x.
std::map<double, uint64_t> idsByPlace(std::span<const render::MediumBlob> blobs)
{
    const base::SnapshotSchema schema = blobSchema();
    const base::FrameSnapshot snapshot = snapshotOfBlobs(blobs, schema, 1);
    std::map<double, uint64_t> ids;
    for (const render::MediumBlob& blob : render::mediumOf({&snapshot, nullptr}, 1.0).blobs)
        ids[std::round(blob.center.x)] = blob.id;
    return ids;
}

TEST(BlobSnapshot, aBallKeepsItsIdWhenOthersDieAndPiecesOfAStreakDiffer)
{
    std::vector<render::MediumBlob> blobs;
    for (const uint64_t id : {uint64_t(3), uint64_t(7), uint64_t(7), uint64_t(7), uint64_t(1) << 40}) {
        render::MediumBlob blob;
        blob.center.x = double(blobs.size());
        blob.radius = blob.crossSection = 1.0;
        blob.id = id;
        blobs.push_back(blob);
    }
    const std::map<double, uint64_t> all = idsByPlace(blobs);
    std::set<uint64_t> distinct;
    for (const auto& [place, id] : all)
        distinct.insert(id);
    EXPECT_EQ(distinct.size(), blobs.size());
    blobs.erase(blobs.begin());
    const std::map<double, uint64_t> left = idsByPlace(blobs);
    EXPECT_EQ(left.size(), blobs.size());
    for (const auto& [place, id] : left)
        EXPECT_EQ(id, all.at(place));
    for (render::MediumBlob& blob : blobs)
        blob.id = 0; // a list without ids
    distinct.clear();
    for (const auto& [place, id] : idsByPlace(blobs))
        distinct.insert(id);
    EXPECT_EQ(distinct.size(), blobs.size());
}

TEST(BlobSnapshot, anEmptyListHasNoGroups)
{
    const base::SnapshotSchema schema = blobSchema();
    EXPECT_EQ(snapshotOfBlobs({}, schema, 1).groupCount(), 0u);
}

} // namespace
} // namespace fx::cli
