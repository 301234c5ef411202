// Detail of the field of blocks, drawn as balls and as impostors.
#include "block_fixture.h"

#include <cmath>

using namespace fx;
using namespace fx::test;

namespace {

namespace material = base::material_column;

/// Root mean square of the difference over all texels.
double rmsOf(const Picture& a, const Picture& b)
{
    double sum = 0.0;
    for (size_t i = 0; i < a.texels.size(); ++i)
        sum += std::pow(double(a.texels[i]) - double(b.texels[i]), 2.0);
    return std::sqrt(sum / double(a.texels.size()));
}

class BlockDetail : public BlockPictureTest
{
protected:
    void SetUp() override
    {
        BlockPictureTest::SetUp();
        view_->settings().composition = render::Composition::Slabs;
        view_->settings().lighting.sunIlluminance = glm::vec3(0.0f);
        view_->settings().lighting.skyLuminance = glm::vec3(0.0f);
    }

    /// Three blocks whose noise has been carried by another way each.
    base::FrameSnapshot carriedBlocks(bool hasDetail = true)
    {
        sim::BlocksDef def = threeBlocks(true);
        def.detail.given = hasDetail;
        def.detail.billowSize = 1.5f;
        def.detail.crispness = 0.8f;
        def.density = 2.0f;
        base::FrameSnapshot snapshot = published(def);
        for (size_t c = 0; hasDetail && c < material::Count; ++c)
            for (uint32_t i = 0; i < 3; ++i)
                snapshot.editGroup(0).editColumn(c)[i] += 0.37f * float(c + 1) * float(i);
        return snapshot;
    }
    Picture drawBlocks(const base::FrameSnapshot& snapshot, float pixels)
    {
        view_->settings().blocks = {};
        view_->settings().blocks.maxPixels = pixels;
        view_->settings().blocks.error = 0.0f;
        return draw(snapshot, eye_);
    }

    const glm::dvec3 eye_{0.0, 2.0, 8.0};
};

} // namespace

TEST_F(BlockDetail, isThatOfAMediumOfTheSameBalls)
{
    const base::FrameSnapshot blocks = carriedBlocks();
    const Picture asBalls = drawBlocks(blocks, 1.0f); // all are larger
    EXPECT_EQ(view_->statistics().blockImpostors, 0u);
    EXPECT_EQ(view_->statistics().blobs, kBallsOfThree);
    const Picture medium = draw(ballsOf(blocks), eye_);
    EXPECT_LE(rmsOf(asBalls, medium), 1e-4);
    const Picture smooth = drawBlocks(carriedBlocks(false), 1.0f);
    EXPECT_GE(rmsOf(asBalls, smooth), 0.03); // it is seen
}

TEST_F(BlockDetail, movesWithTheCoordinatesOfBlocks)
{
    const base::FrameSnapshot blocks = carriedBlocks();
    const Picture first = drawBlocks(blocks, 1.0f);
    base::FrameSnapshot others = carriedBlocks();
    for (uint32_t i = 0; i < 3; ++i)
        others.editGroup(0).editColumn(material::Place0X)[i] += 0.2f;
    EXPECT_GE(rmsOf(first, drawBlocks(others, 1.0f)), 0.01);
}

TEST_F(BlockDetail, isSeenOnImpostorsAsOnTheirBalls)
{
    const base::FrameSnapshot blocks = carriedBlocks();
    const Picture balls = drawBlocks(blocks, 1.0f);
    const Picture impostors = drawBlocks(blocks, 128.0f);
    EXPECT_EQ(view_->statistics().blockImpostors, 3u);
    const Picture smooth = drawBlocks(carriedBlocks(false), 128.0f);
    EXPECT_LE(rmsOf(impostors, balls), 0.25 * rmsOf(smooth, balls));
}

TEST_F(BlockDetail, isThatOfTheirBallsInAllCompositions)
{
    const base::FrameSnapshot blocks = carriedBlocks(), balls = ballsOf(blocks);
    view_->settings().composition = render::Composition::Volume;
    EXPECT_LE(rmsOf(draw(blocks, eye_), draw(balls, eye_)), 1e-4);
}
