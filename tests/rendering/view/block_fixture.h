// Three blocks, and pictures of blocks.
#pragma once

#include "foundation/snapshot/block_kind.h"
#include "simulation/blocks/blocks_def.h"
#include "view_fixture.h"

#include <algorithm>

namespace fx::test {

constexpr int kBlockPictureSize = 96;      ///< [pixel]
constexpr float kHostPicture = 0.25f;      ///< in all channels
constexpr uint32_t kBallsOfThree = 3 * 40; ///< of threeBlocks()

/// Three turned blocks of one type of 40 balls, which overlap.
/// @param glows true: balls emit and scatter nothing; false: they scatter and emit nothing
inline sim::BlocksDef threeBlocks(bool glows = false)
{
    sim::BlocksDef def;
    sim::BlockType heap;
    heap.name = "heap";
    for (int i = 0; i < 40; ++i) {
        sim::ListedBall ball;
        ball.center = 0.3f * glm::vec3(float(i % 4) - 1.5f, float(i / 4 % 5) - 2.0f, float(i / 20) - 0.5f);
        ball.radius = 0.3f;
        ball.crossSection = 0.2f;
        if (glows)
            ball.emission = glm::vec3(0.9f, 0.6f, 0.4f);
        else
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

class BlockPictureTest : public ViewTest
{
protected:
    void SetUp() override
    {
        schema_.add(base::kBlockKind);
        schema_.add(base::kBlockBallKind);
        schema_.add(base::kBlockMaterialKind);
        schema_.add(base::kMaterialKind);
        ViewTest::SetUp();
        makeTargets(kBlockPictureSize, kBlockPictureSize);
        auto& light = view_->settings().lighting;
        light.sunDirection = glm::normalize(glm::vec3(0.3f, 0.8f, 0.5f));
        light.sunIlluminance = glm::vec3(3.0f);
        light.skyLuminance = glm::vec3(0.3f, 0.4f, 0.5f);
    }

    base::FrameSnapshot published(const sim::BlocksDef& def, const base::GroupInfo& info = {})
    {
        base::FrameSnapshot snapshot(&schema_, std::pmr::get_default_resource());
        snapshot.begin(0, ++sequence_);
        def.create(schema_, {}, std::pmr::get_default_resource())->publish(info, snapshot);
        return snapshot;
    }

    /// The rows of the last groups of `source`, as a medium without blocks.
    base::FrameSnapshot ballsOf(const base::FrameSnapshot& source)
    {
        base::FrameSnapshot snapshot(&schema_, std::pmr::get_default_resource());
        snapshot.begin(0, ++sequence_);
        const size_t end = source.groupCount();
        const bool hasDetail = schema_.kind(source.name(end - 1).kind) == base::kMaterialKind;
        for (size_t g = hasDetail ? end - 2 : end - 1; g < end; ++g) {
            const base::SnapshotGroup& balls = source.group(g);
            base::SnapshotGroup& copy = snapshot.addGroup(balls.info().kind, balls.count());
            copy.editInfo() = balls.info();
            copy.editInfo().isLate = false;
            std::ranges::copy(balls.constants(), copy.editConstants().begin());
            std::ranges::copy(balls.ids(), copy.editIds().begin());
            for (size_t column = 0; column < schema_.kind(balls.info().kind).columns.size(); ++column)
                std::ranges::copy(balls.column(column), copy.editColumn(column).begin());
        }
        return snapshot;
    }

    Picture draw(const base::FrameSnapshot& snapshot, const glm::dvec3& eye,
                 const glm::dvec3& target = glm::dvec3(0.0))
    {
        setPicture(std::vector<float>(kBlockPictureSize * kBlockPictureSize * 4, kHostPicture));
        return render(snapshot, render::perspectiveView({eye, target, {0, 1, 0}}, 0.9f, 1.0f, 0.1f));
    }
};

} // namespace fx::test
