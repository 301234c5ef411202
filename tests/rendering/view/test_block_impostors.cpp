// Impostors of blocks against the balls that they stand for.
#include "block_fixture.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

using namespace fx;
using namespace fx::test;

namespace {

/// Root mean square of the difference over texels that differ from the host's picture in one of both.
double rmsDifference(const Picture& a, const Picture& b)
{
    double sum = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < a.texels.size(); i += 4) {
        if (a.texels[i] == kHostPicture && b.texels[i] == kHostPicture)
            continue;
        for (size_t k = 0; k < 3; ++k) {
            const double difference = double(a.texels[i + k]) - double(b.texels[i + k]);
            sum += difference * difference;
            ++count;
        }
    }
    return std::sqrt(sum / double(std::max<size_t>(count, 1)));
}

double meanOf(const Picture& picture)
{
    double sum = 0.0;
    for (size_t i = 0; i < picture.texels.size(); i += 4)
        sum += double(picture.texels[i]) - double(kHostPicture);
    return sum;
}

constexpr float kAll = 128.0f;

class BlockImpostors : public BlockPictureTest
{
protected:
    void SetUp() override
    {
        BlockPictureTest::SetUp();
        view_->settings().composition = render::Composition::Slabs;
    }

    /// Only what blocks emit: how exactly the medium is drawn. How balls are lit is an approximation of its
    /// own.
    void glowAlone()
    {
        view_->settings().lighting.sunIlluminance = glm::vec3(0.0f);
        view_->settings().lighting.skyLuminance = glm::vec3(0.0f);
    }

    /// Drawn as impostors up to a diameter [pixel], however large their error is.
    Picture drawUpTo(float pixels, const base::FrameSnapshot& snapshot, const glm::dvec3& eye,
                     const glm::dvec3& target = glm::dvec3(0.0))
    {
        view_->settings().blocks = {};
        view_->settings().blocks.maxPixels = pixels;
        view_->settings().blocks.error = 0.0f;
        return draw(snapshot, eye, target);
    }
    /// Drawn as impostors up to a predicted error.
    Picture drawWithin(float error, const base::FrameSnapshot& snapshot, const glm::dvec3& eye)
    {
        view_->settings().blocks = {};
        view_->settings().blocks.maxPixels = kAll;
        view_->settings().blocks.error = error;
        return draw(snapshot, eye);
    }
    Picture drawBalls(const base::FrameSnapshot& snapshot, const glm::dvec3& eye)
    {
        view_->settings().blocks.parallax = 0.0f;
        return draw(snapshot, eye);
    }
};

} // namespace

TEST_F(BlockImpostors, areTheBallsOfTheirBlocks)
{
    glowAlone();
    const base::FrameSnapshot blocks = published(threeBlocks(true));
    for (const double distance : {5.0, 8.0, 14.0}) {
        const glm::dvec3 eye(0.0, 0.25 * distance, distance);
        const Picture impostors = drawUpTo(kAll, blocks, eye);
        EXPECT_EQ(view_->statistics().blockImpostors, 3u);
        EXPECT_EQ(view_->statistics().blobs, 3u);
        const Picture balls = drawBalls(blocks, eye);
        EXPECT_EQ(view_->statistics().blockImpostors, 0u);
        EXPECT_EQ(view_->statistics().blobs, kBallsOfThree);
        const double error = rmsDifference(impostors, balls);
        EXPECT_LE(error, 0.02) << distance;
        EXPECT_NEAR(meanOf(impostors), meanOf(balls), 0.035 * std::abs(meanOf(balls))) << distance;
        if (distance < 10.0)
            continue; // rays through the rim of a near block are not parallel to those of its tile
        view_->settings().blocks = {};
        view_->settings().blocks.error = 0.0f;
        view_->settings().blocks.resolution = 2.0f;
        EXPECT_LE(rmsDifference(draw(blocks, eye), balls), 0.75 * error) << distance;
    }
}

TEST_F(BlockImpostors, haveTheColorsOfTheirBalls)
{
    glowAlone();
    sim::BlocksDef def = threeBlocks(true);
    for (sim::ListedBall& ball : def.types[0].balls) // red on the left, blue on the right
        ball.emission = glm::vec3(0.5f - 0.8f * ball.center.x, 0.2f, 0.5f + 0.8f * ball.center.x);
    for (sim::BlockPlacement& block : def.blocks)
        block.rotation = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
    ASSERT_TRUE(sim::completeTypes(def.types).ok());
    const base::FrameSnapshot blocks = published(def);
    const glm::dvec3 eye(0, 0, 8);
    const Picture impostors = drawUpTo(kAll, blocks, eye);
    EXPECT_EQ(view_->statistics().blockImpostors, 3u);
    EXPECT_LE(rmsDifference(impostors, drawBalls(blocks, eye)), 0.03);
    EXPECT_GE(rmsDifference(drawUpTo(kAll, published(threeBlocks(true)), eye), impostors), 0.1);
}

TEST_F(BlockImpostors, areLitAsTheirBallsAre)
{
    const base::FrameSnapshot blocks = published(threeBlocks());
    const glm::dvec3 eye(0.0, 2.0, 8.0);
    const Picture impostors = drawUpTo(kAll, blocks, eye), balls = drawBalls(blocks, eye);
    EXPECT_LE(rmsDifference(impostors, balls), 0.03);
    view_->settings().lighting.sunDirection *= -1.0f; // from behind and below
    EXPECT_LE(rmsDifference(drawUpTo(kAll, blocks, eye), drawBalls(blocks, eye)), 0.03);
    EXPECT_GE(rmsDifference(drawUpTo(kAll, blocks, eye), impostors), 0.06);
}

// A network has other light in front of a block than in its middle: one number and a slope for a block do not
// tell.
TEST_F(BlockImpostors, areLitByNetworksAsTheirBallsAre)
{
    sim::BlocksDef def = threeBlocks();
    view_->settings().slices.network = true;
    for (const float density : {0.5f, 1.0f}) {
        def.density = density;
        const base::FrameSnapshot blocks = published(def);
        for (const glm::dvec3& eye : {glm::dvec3(0.0, 2.0, 8.0), glm::dvec3(6.0, -2.0, -5.0)})
            EXPECT_LE(rmsDifference(drawUpTo(kAll, blocks, eye), drawBalls(blocks, eye)), 0.035 * density);
    }
}

TEST_F(BlockImpostors, areThereWhereTheyAreSmallerThanAPixel)
{
    glowAlone();
    const base::FrameSnapshot blocks = published(threeBlocks(true));
    // What reaches the eye falls with the square of the distance, also where pixels are larger than blocks.
    const double flux = meanOf(drawUpTo(kAll, blocks, {0.0, 0.0, 20.0})) * 20.0 * 20.0;
    for (const double distance : {60.0, 150.0, 400.0}) {
        const Picture far = drawUpTo(kAll, blocks, {0.0, 0.0, distance});
        EXPECT_EQ(view_->statistics().blockImpostors, 3u);
        const double error = std::abs(meanOf(far) * distance * distance - flux);
        EXPECT_LE(error, (distance < 200.0 ? 0.2 : 0.8) * flux) << distance;
        // What is widened to a pixel hides less of what is behind: blocks are better than single balls.
        const double ofBalls = meanOf(drawBalls(blocks, {0.0, 0.0, distance})) * distance * distance;
        EXPECT_LE(error, 0.6 * std::abs(ofBalls - flux)) << distance;
    }
}

TEST_F(BlockImpostors, standBesideFieldsWithDetail)
{
    glowAlone();
    // A ball with detail behind the eye takes part in lists and textures but not in the picture.
    const base::FrameSnapshot blocks = published(threeBlocks(true));
    base::FrameSnapshot both =
        detailedSnapshotOf({{.center = {0.0f, 0.0f, 9.2f}, .radius = 1.0f, .crossSection = 1e-4f}});
    base::GroupInfo info;
    info.instance = 7;
    const sim::BlocksDef def = threeBlocks(true);
    def.create(schema_, {}, std::pmr::get_default_resource())->publish(info, both);
    const glm::dvec3 eye(0, 0, 8);
    const Picture alone = drawUpTo(kAll, blocks, eye), beside = drawUpTo(kAll, both, eye);
    EXPECT_EQ(view_->statistics().blockImpostors, 3u);
    EXPECT_LE(rmsDifference(alone, beside), 0.01);
}

TEST_F(BlockImpostors, becomeTheirBallsWithoutAJump)
{
    glowAlone();
    const base::FrameSnapshot blocks = published(threeBlocks(true));
    const glm::dvec3 eye(0.0, 1.5, 6.0);
    const Picture impostors = drawUpTo(kAll, blocks, eye);
    EXPECT_EQ(view_->statistics().blockImpostors, 3u);
    const Picture balls = drawBalls(blocks, eye);
    double last = meanOf(impostors);
    for (const float most : {60.0f, 45.0f, 40.0f, 36.0f, 32.0f, 28.0f, 24.0f, 16.0f}) {
        const Picture between = drawUpTo(most, blocks, eye);
        EXPECT_NEAR(meanOf(between), last, 0.02 * std::abs(meanOf(balls))) << most;
        last = meanOf(between);
    }
    EXPECT_EQ(view_->statistics().blockImpostors, 0u);
    EXPECT_NEAR(last, meanOf(balls), 1e-5 * std::abs(last));
}

TEST_F(BlockImpostors, areWithinTheErrorThatIsAskedForOrAreBalls)
{
    glowAlone();
    view_->settings().exposureEv100 = std::log2(1.0f / 1.2f); // 1 cd/m2 is white
    const base::FrameSnapshot blocks = published(threeBlocks(true));
    for (const double distance : {4.0, 6.0, 10.0, 20.0}) {
        const glm::dvec3 eye(0.0, 0.25 * distance, distance);
        const Picture balls = drawBalls(blocks, eye);
        for (const float limit : {0.02f, 1.0f / 255.0f, 0.002f, 0.0005f}) {
            const Picture picture = drawWithin(limit, blocks, eye);
            EXPECT_LE(rmsDifference(picture, balls), double(limit)) << distance << ' ' << limit;
            if (limit == 0.02f) {
                EXPECT_EQ(view_->statistics().blockImpostors, 3u) << distance;
            }
            if (limit == 0.0005f) {
                EXPECT_EQ(view_->statistics().blockImpostors, 0u) << distance;
            }
        }
        if (distance >= 10.0) { // a control
            EXPECT_GE(rmsDifference(drawUpTo(kAll, blocks, eye), balls), 1.0 / 255.0) << distance;
        }
    }
}

TEST_F(BlockImpostors, becomeTheirBallsWithoutAJumpAsTheErrorGetsSmaller)
{
    glowAlone();
    view_->settings().exposureEv100 = std::log2(1.0f / 1.2f);
    const base::FrameSnapshot blocks = published(threeBlocks(true));
    const glm::dvec3 eye(0.0, 1.5, 6.0);
    Picture last = drawWithin(0.0015f, blocks, eye);
    EXPECT_EQ(view_->statistics().blockImpostors, 3u);
    const Picture balls = drawBalls(blocks, eye);
    bool isPart = false;
    double largest = 0.0, ofImpostors = 0.0; // step while the balls fade in, and what they differ by
    for (float limit = 0.0015f; limit >= 0.0005f; limit *= 0.98f) {
        const Picture next = drawWithin(limit, blocks, eye);
        const double step = rmsDifference(next, last);
        if (isPart || view_->statistics().blobs > kBallsOfThree) // impostors and balls
            largest = std::max(largest, step);
        else
            ofImpostors = rmsDifference(next, balls);
        isPart = isPart || view_->statistics().blobs > kBallsOfThree;
        EXPECT_LE(step, 0.3 * double(limit)) << limit; // to a finer tile
        last = next;
    }
    EXPECT_LE(largest, 0.3 * ofImpostors); // a block that is either one or the other changes by all of it
    EXPECT_GT(largest, 0.0);
    EXPECT_TRUE(isPart);
    EXPECT_EQ(view_->statistics().blockImpostors, 0u);
}

TEST_F(BlockImpostors, areNotDrawnForBlocksAroundTheEye)
{
    const base::FrameSnapshot blocks = published(threeBlocks());
    const glm::dvec3 inside(0.05, 0.2, -0.25);
    const Picture some = drawUpTo(kAll, blocks, inside);
    EXPECT_EQ(view_->statistics().blockImpostors, 0u);
    EXPECT_LE(maxDifference(some, drawBalls(blocks, inside)), 1e-6);
}

TEST_F(BlockImpostors, areCutByTheHostsSurfaces)
{
    glowAlone();
    const base::FrameSnapshot blocks = published(threeBlocks(true));
    const glm::dvec3 eye(0.0, 0.0, 8.0);
    const double uncut = std::abs(meanOf(drawBalls(blocks, eye)));
    for (const double depth : {7.4, 8.0, 8.5}) { // within the blocks; standard depth, near plane 0.1 m
        setDepth(std::vector<float>(kBlockPictureSize * kBlockPictureSize, float(1.0 - 0.1 / depth)));
        const Picture impostors = drawUpTo(kAll, blocks, eye);
        EXPECT_EQ(view_->statistics().blockImpostors, 3u);
        const Picture balls = drawBalls(blocks, eye);
        EXPECT_LE(rmsDifference(impostors, balls), 0.02) << depth;
        EXPECT_NEAR(meanOf(impostors), meanOf(balls), 0.03 * uncut) << depth;
    }
    setDepth(std::vector<float>(kBlockPictureSize * kBlockPictureSize, 0.0f)); // at the near plane
    EXPECT_EQ(meanOf(drawUpTo(kAll, blocks, eye)), 0.0);
}

TEST_F(BlockImpostors, doNotChangeWithTheOrderOfInterpenetratingBlocks)
{
    sim::BlocksDef swapped = threeBlocks();
    std::swap(swapped.blocks[0], swapped.blocks[1]);
    const base::FrameSnapshot a = published(threeBlocks()), b = published(swapped);
    const glm::dvec3 eye(0, 2, 8);
    const Picture first = drawUpTo(kAll, a, eye), second = drawUpTo(kAll, b, eye);
    EXPECT_EQ(view_->statistics().blockImpostors, 3u);
    float largest = 0.0f;
    for (const float value : first.texels)
        largest = std::max(largest, value);
    EXPECT_LE(maxDifference(first, second), double(largest) / 1023.0);
}

TEST_F(BlockImpostors, tilesAreDrawnOnceAndOnlyForWhatIsSeen)
{
    const base::FrameSnapshot blocks = published(threeBlocks());
    drawUpTo(kAll, blocks, {0, 0, 8});
    EXPECT_EQ(view_->statistics().blockTilesDrawn, 3u);
    drawUpTo(kAll, published(threeBlocks()), {0, 0, 8});
    EXPECT_EQ(view_->statistics().blockTilesDrawn, 0u);
    setPicture(std::vector<float>(kBlockPictureSize * kBlockPictureSize * 4, kHostPicture));
    render(published(threeBlocks()), // looks away
           render::perspectiveView({{0, 0, 8}, {0, 0, 20}, {0, 1, 0}}, 0.9f, 1.0f, 0.1f));
    EXPECT_EQ(view_->statistics().blockImpostors, 0u);
    EXPECT_EQ(view_->statistics().blockTilesDrawn, 0u);
}

TEST_F(BlockImpostors, tilesStayWhenEffectAndEyeMoveTogether)
{
    glowAlone();
    const glm::dvec3 far(1e5, 0.0, -1e5);
    const Picture here = drawUpTo(kAll, published(threeBlocks(true)), {0, 2, 8});
    base::GroupInfo moved;
    moved.placement.position = far;
    const Picture there = drawUpTo(kAll, published(threeBlocks(true), moved), far + glm::dvec3(0, 2, 8), far);
    EXPECT_EQ(view_->statistics().blockTilesDrawn, 0u);
    EXPECT_LE(rmsDifference(here, there), 1e-3);
}

TEST_F(BlockImpostors, emptyBlocksAddNothing)
{
    sim::BlocksDef def = threeBlocks();
    const Picture without = drawUpTo(kAll, published(def), {0, 2, 8});
    sim::BlockPlacement thin = def.blocks[0];
    thin.density = 0.0f;
    def.blocks.push_back(thin);
    EXPECT_EQ(maxDifference(without, drawUpTo(kAll, published(def), {0, 2, 8})), 0.0);
    EXPECT_EQ(view_->statistics().blockImpostors, 3u);
    for (sim::BlockPlacement& block : def.blocks)
        block.density = 0.0f;
    EXPECT_EQ(meanOf(drawUpTo(kAll, published(def), {0, 2, 8})), 0.0);
    EXPECT_EQ(view_->statistics().blockTilesDrawn, 0u);
}

TEST_F(BlockImpostors, blocksThatAreNotFiniteAreLeftOut)
{
    sim::BlocksDef def = threeBlocks();
    const Picture without = drawUpTo(kAll, published(def), {0, 2, 8});
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 0.0f})
    {
        sim::BlocksDef broken = def;
        sim::BlockPlacement block = def.blocks[0];
        block.scale = bad;
        broken.blocks.push_back(block);
        EXPECT_EQ(maxDifference(without, drawUpTo(kAll, published(broken), {0, 2, 8})), 0.0) << bad;
    }
}

TEST_F(BlockImpostors, oneBallInEachOfManyBlocksAndVeryManyBallsInOne)
{
    glowAlone();
    sim::BlocksDef def;
    sim::BlockType single, huge;
    single.name = "single";
    single.balls.push_back(
        {.center = {}, .radius = 0.2f, .crossSection = 0.05f, .emission = glm::vec3(1.0f)});
    huge.name = "huge";
    for (uint32_t i = 0; i < 70'000; ++i)
        huge.balls.push_back({.center = 0.02f * glm::vec3(float(i % 41) - 20.0f, float(i / 41 % 41) - 20.0f,
                                                          float(i / 1681) - 20.0f),
                              .radius = 0.03f,
                              .crossSection = 1e-5f,
                              .emission = glm::vec3(1.0f)});
    def.types = {single, huge};
    ASSERT_TRUE(sim::completeTypes(def.types).ok());
    for (int i = 0; i < 1000; ++i) {
        sim::BlockPlacement block;
        block.position = {0.15f * float(i % 10 - 5), 0.15f * float(i / 10 % 10 - 5),
                          0.15f * float(i / 100 - 5)};
        def.blocks.push_back(block);
    }
    const glm::dvec3 eye(0, 0, 9);
    const base::FrameSnapshot many = published(def);
    const Picture impostors = drawUpTo(kAll, many, eye);
    EXPECT_EQ(view_->statistics().blockImpostors, 1000u);
    EXPECT_LE(rmsDifference(impostors, drawBalls(many, eye)), 0.0126);
    sim::BlockPlacement one;
    one.type = 1;
    def.blocks = {one};
    const base::FrameSnapshot whole = published(def);
    const Picture balls = drawUpTo(kAll, whole, eye);
    EXPECT_EQ(view_->statistics().blockImpostors, 0u); // too many balls for a tile
    EXPECT_LE(maxDifference(balls, drawBalls(whole, eye)), 1e-5);
}
