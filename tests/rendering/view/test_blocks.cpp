// Pictures of blocks are those of the balls that they expand to.
#include "foundation/snapshot/block_kind.h"
#include "simulation/blocks/blocks_def.h"
#include "view_fixture.h"

#include <algorithm>

using namespace fx;
using namespace fx::test;

namespace {

constexpr int kSize = 96;
constexpr uint32_t kBalls = 3 * 40; ///< of all blocks

/// Three turned blocks of one type of 40 balls, which overlap.
sim::BlocksDef threeBlocks()
{
    sim::BlocksDef def;
    sim::BlockType heap;
    heap.name = "heap";
    for (int i = 0; i < 40; ++i) {
        sim::ListedBall ball;
        ball.center = 0.3f * glm::vec3(float(i % 4) - 1.5f, float(i / 4 % 5) - 2.0f, float(i / 20) - 0.5f);
        ball.radius = 0.3f;
        ball.crossSection = 0.2f;
        ball.albedo = glm::vec3(0.8f);
        heap.balls.push_back(ball);
    }
    def.types.push_back(heap);
    EXPECT_TRUE(sim::completeTypes(def.types).ok());
    for (int k = 0; k < 3; ++k) {
        sim::BlockPlacement placed;
        placed.position = {0.7f * float(k) - 0.7f, 0.2f * float(k), -0.3f * float(k)};
        placed.rotation = sim::turnOf(sim::BlockTurn::Free, 5, uint64_t(k));
        placed.scale = 0.8f + 0.2f * float(k);
        def.blocks.push_back(placed);
    }
    return def;
}

class BlockPictures : public ViewTest
{
protected:
    void SetUp() override
    {
        schema_.add(base::kBlockKind);
        schema_.add(base::kBlockBallKind);
        ViewTest::SetUp();
        makeTargets(kSize, kSize);
        auto& light = view_->settings().lighting;
        light.sunDirection = glm::normalize(glm::vec3(0.3f, 0.8f, 0.5f));
        light.sunIlluminance = glm::vec3(3.0f);
        light.skyLuminance = glm::vec3(0.3f, 0.4f, 0.5f);
    }

    base::FrameSnapshot published(const sim::BlocksDef& def)
    {
        base::FrameSnapshot snapshot(&schema_, std::pmr::get_default_resource());
        snapshot.begin(0, ++sequence_);
        def.create(schema_, {}, std::pmr::get_default_resource())->publish({}, snapshot);
        return snapshot;
    }

    /// The rows of the last group of `source`, as a medium without blocks.
    base::FrameSnapshot ballsOf(const base::FrameSnapshot& source)
    {
        const base::SnapshotGroup& balls = source.group(source.groupCount() - 1);
        base::FrameSnapshot snapshot(&schema_, std::pmr::get_default_resource());
        snapshot.begin(0, ++sequence_);
        base::SnapshotGroup& copy = snapshot.addGroup(balls.info().kind, balls.count());
        copy.editInfo() = balls.info();
        copy.editInfo().isLate = false;
        std::ranges::copy(balls.constants(), copy.editConstants().begin());
        std::ranges::copy(balls.ids(), copy.editIds().begin());
        for (size_t column = 0; column < base::blob_column::Count; ++column)
            std::ranges::copy(balls.column(column), copy.editColumn(column).begin());
        return snapshot;
    }

    Picture draw(const base::FrameSnapshot& snapshot, const glm::dvec3& eye)
    {
        setPicture(std::vector<float>(kSize * kSize * 4, 0.25f));
        return render(snapshot, render::perspectiveView({eye, {0, 0, 0}, {0, 1, 0}}, 0.9f, 1.0f, 0.1f));
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
        EXPECT_EQ(view_->statistics().blockParticles, kBalls);
        const Picture ofBalls = draw(ballsOf(blocks), {0, 1, 4});
        EXPECT_EQ(view_->statistics().blocks, 0u);
        EXPECT_EQ(view_->statistics().blobs, kBalls);
        EXPECT_EQ(maxDifference(ofBlocks, ofBalls), 0.0);
        EXPECT_GT(
            maxDifference(ofBlocks, Picture{kSize, kSize, std::vector<float>(kSize * kSize * 4, 0.25f)}),
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
