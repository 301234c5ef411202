// Pictures of blocks are those of the balls that they expand to.
#include "block_fixture.h"

using namespace fx;
using namespace fx::test;

namespace {

/// Blocks drawn ball by ball.
class BlockPictures : public BlockPictureTest
{
protected:
    void SetUp() override
    {
        BlockPictureTest::SetUp();
        view_->settings().blocks.parallax = 0.0f;
    }
};

} // namespace

TEST_F(BlockPictures, equalThoseOfTheirBallsInAllCompositions)
{
    for (const auto composition :
         {render::Composition::Sorted, render::Composition::Slabs, render::Composition::Volume})
    {
        view_->settings().composition = composition;
        const base::FrameSnapshot blocks = published(threeBlocks());
        const Picture ofBlocks = draw(blocks, {0, 1, 4});
        EXPECT_EQ(view_->statistics().blockInstances, 3u);
        EXPECT_EQ(view_->statistics().blocks, 1u);
        EXPECT_EQ(view_->statistics().blockParticles, kBallsOfThree);
        const Picture ofBalls = draw(ballsOf(blocks), {0, 1, 4});
        EXPECT_EQ(view_->statistics().blocks, 0u);
        EXPECT_EQ(view_->statistics().blobs, kBallsOfThree);
        EXPECT_EQ(maxDifference(ofBlocks, ofBalls), 0.0);
        EXPECT_GT(maxDifference(
                      ofBlocks,
                      Picture{kBlockPictureSize, kBlockPictureSize,
                              std::vector<float>(kBlockPictureSize * kBlockPictureSize * 4, kHostPicture)}),
                  0.1);
    }
}

TEST_F(BlockPictures, areSeenFromInsideOfABlock)
{
    view_->settings().composition = render::Composition::Slabs;
    const base::FrameSnapshot blocks = published(threeBlocks());
    const glm::dvec3 inside(0.05, 0.2, -0.25);
    EXPECT_EQ(maxDifference(draw(blocks, inside), draw(ballsOf(blocks), inside)), 0.0);
}

TEST_F(BlockPictures, doNotChangeWithTheOrderOfInterpenetratingBlocksWhereMediaAreSummed)
{
    sim::BlocksDef swapped = threeBlocks();
    std::swap(swapped.blocks[0], swapped.blocks[1]);
    const base::FrameSnapshot a = published(threeBlocks()), b = published(swapped);
    for (const auto composition : {render::Composition::Slabs, render::Composition::Volume}) {
        view_->settings().composition = composition;
        const Picture first = draw(a, {0, 1, 4}), second = draw(b, {0, 1, 4});
        float largest = 0.0f;
        for (const float value : first.texels)
            largest = std::max(largest, value);
        EXPECT_LE(maxDifference(first, second), double(largest) / 1023.0);
    }
}
