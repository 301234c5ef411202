// Tests the noise coordinates of blocks and of the balls in them.
#include "block_fixture.h"
#include "foundation/snapshot/filtered_snapshot.h"
#include "simulation/emitters/emitter_detail.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>

using namespace fx;
using namespace fx::test;

namespace {

namespace material = base::material_column;

sim::FieldDetail detailOfSmoke()
{
    sim::FieldDetail detail;
    detail.given = true;
    return detail;
}

/// Two blocks of three balls, one of them twice as large.
sim::BlocksDef heaps()
{
    sim::BlocksDef def;
    def.types = {
        typeOf("heap", sim::BallList{ballAt({1, 0, 0}), ballAt({-1, 0, 0}, 0.5f), ballAt({0, 1, 0})})};
    EXPECT_TRUE(sim::completeTypes(def.types).ok());
    def.blocks = {placedAt({10, 0, 0}, 0), placedAt({0, 20, 0}, 0, 2.0f)};
    def.detail = detailOfSmoke();
    return def;
}

/// The same heaps, which an emitter gives birth to.
sim::BlocksDef emittedHeaps()
{
    sim::BlocksDef def = heaps();
    def.blocks.clear();
    const auto emitter = boiling(8.0f);
    emitter->maxParticles = 64;
    emitter->detail = def.detail;
    def.emitter = emitter;
    def.emitted = {0};
    return def;
}

glm::vec3 placeIn(const base::SnapshotGroup& group, uint32_t generation, size_t i)
{
    const size_t first = generation % 2 == 0 ? material::Place0X : material::Place1X;
    return {group.column(first)[i], group.column(first + 1)[i], group.column(first + 2)[i]};
}

const base::SnapshotGroup* groupOf(const base::FrameSnapshot& snapshot, const base::KindDesc& kind)
{
    for (size_t g = 0; g < snapshot.groupCount(); ++g)
        if (blockSchema().kind(snapshot.name(g).kind) == kind)
            return &snapshot.group(g);
    return nullptr;
}

/// The group with Owner kNoOwner, which comes before the others.
const base::SnapshotGroup* rootOf(const base::FrameSnapshot& snapshot)
{
    return groupOf(snapshot, base::kBlockKind);
}

} // namespace

TEST(BlockMaterials, areNotThereWithoutDetail)
{
    sim::BlocksDef def = heaps();
    def.detail = {};
    BlockBench bench(def);
    const base::FrameSnapshot& snapshot = bench.look();
    EXPECT_EQ(groupOf(snapshot, base::kMaterialKind), nullptr);
    EXPECT_EQ(groupOf(snapshot, base::kBlockMaterialKind), nullptr);
    EXPECT_FALSE(def.publishes(base::kMaterialKind));
    EXPECT_TRUE(heaps().publishes(base::kMaterialKind));
}

TEST(BlockMaterials, ofBlocksThatDoNotMoveAreTheirPlaces)
{
    BlockBench bench(heaps());
    const base::FrameSnapshot& snapshot = bench.look();
    const base::SnapshotGroup* const blobs = groupOf(snapshot, base::kBlobKind);
    const base::SnapshotGroup* const own = groupOf(snapshot, base::kMaterialKind);
    ASSERT_TRUE(blobs && own);
    ASSERT_EQ(own->count(), 6u);
    EXPECT_EQ(&snapshot.group(snapshot.groupCount() - 1), own); // after that of the balls
    EXPECT_TRUE(std::ranges::equal(own->ids(), blobs->ids()));
    for (size_t i = 0; i < own->count(); ++i)
        for (const uint32_t generation : {0u, 1u})
            EXPECT_LE(glm::length(placeIn(*own, generation, i) - positionOf(*blobs, i)), 1e-5f) << i;
    EXPECT_EQ(own->constants()[base::material_constant::Lossy], 1.0f);
    // Lumps of 1.1 mean radii: by cross section, (2 x 1 + 1 x 0.5) / 3 in the small heap, twice that in the
    // large one, which has four times the cross section.
    const float mean = 2.5f / 3.0f;
    EXPECT_NEAR(own->constants()[base::material_constant::Length0], 1.1f * (mean + 4.0f * 2.0f * mean) / 5.0f,
                1e-5f);
}

TEST(BlockMaterials, stayWithTheirBlocksAsTheseMove)
{
    BlockBench bench(emittedHeaps());
    bench.play(60);
    const uint32_t generation = uint32_t(
        groupOf(bench.look(), base::kMaterialKind)->constants()[base::material_constant::Generation]);
    const auto placesOf = [&](const base::FrameSnapshot& snapshot) {
        std::vector<std::pair<uint64_t, glm::vec3>> places;
        const base::SnapshotGroup* const own = groupOf(snapshot, base::kMaterialKind);
        for (size_t i = 0; i < own->count(); ++i)
            places.emplace_back(own->ids()[i], placeIn(*own, generation, i));
        return places;
    };
    const auto before = placesOf(bench.look());
    const glm::vec3 start = positionOf(*groupOf(bench.look(), base::kBlobKind), 0);
    bench.play(3);
    const base::FrameSnapshot& later = bench.look();
    ASSERT_EQ(uint32_t(groupOf(later, base::kMaterialKind)->constants()[base::material_constant::Generation]),
              generation);
    EXPECT_GT(glm::length(positionOf(*groupOf(later, base::kBlobKind), 0) - start), 1e-3f);
    size_t same = 0;
    for (const auto& [id, place] : placesOf(later))
        for (const auto& [oldId, oldPlace] : before)
            if (id == oldId) {
                EXPECT_LE(glm::length(place - oldPlace), 1e-4f) << id;
                ++same;
            }
    EXPECT_GE(same, 9u);
}

TEST(BlockMaterials, ofBallsAreAsFarApartAsTheBalls)
{
    BlockBench bench(emittedHeaps());
    bench.play(90);
    const base::FrameSnapshot& snapshot = bench.look();
    const base::SnapshotGroup &blobs = *groupOf(snapshot, base::kBlobKind),
                              &own = *groupOf(snapshot, base::kMaterialKind);
    const base::SnapshotGroup &root = *rootOf(snapshot),
                              &ofBlocks = *groupOf(snapshot, base::kBlockMaterialKind);
    ASSERT_EQ(ofBlocks.count(), root.count());
    ASSERT_EQ(own.count(), 3 * root.count());
    for (size_t i = 0; i < own.count(); ++i)
        for (const uint32_t generation : {0u, 1u}) {
            const glm::vec3 away = positionOf(blobs, i) - positionOf(root, i / 3);
            EXPECT_LE(glm::length(placeIn(own, generation, i) - placeIn(ofBlocks, generation, i / 3) - away),
                      1e-5f);
        }
}

TEST(BlockMaterials, haveTheGenerationsOfTheEmitter)
{
    namespace constant = base::material_constant;
    BlockBench bench(emittedHeaps());
    const base::Ticks period = sim::EmitterDetail::periodOf(*emittedHeaps().emitter);
    const int steps = int(2.6 * double(period) / double(kBlockStep));
    bench.play(steps);
    const base::FrameSnapshot& snapshot = bench.look();
    const base::SnapshotGroup &ofBlocks = *groupOf(snapshot, base::kBlockMaterialKind),
                              &ofBalls = *groupOf(snapshot, base::kMaterialKind);
    EXPECT_EQ(ofBlocks.constants()[constant::Generation], 3.0f); // 1, 2, and the third
    EXPECT_NEAR(ofBlocks.constants()[constant::Fade], 0.6f, 0.05f);
    for (size_t c = 0; c < constant::Count; ++c)
        EXPECT_EQ(ofBalls.constants()[c], ofBlocks.constants()[c]) << c;
}

TEST(BlockMaterials, areThereInSnapshotsWithoutSomeInstances)
{
    BlockBench bench(emittedHeaps());
    bench.play(60);
    const base::FrameSnapshot& snapshot = bench.look();
    base::HostMemory memory;
    base::FrameSnapshot copy(&blockSchema(), &memory);
    base::copyWithout(snapshot, std::array<uint64_t, 1>{77}, copy);
    const base::SnapshotGroup &before = *groupOf(snapshot, base::kMaterialKind),
                              &after = *groupOf(copy, base::kMaterialKind);
    ASSERT_GT(before.count(), 0u);
    ASSERT_EQ(after.count(), before.count());
    EXPECT_TRUE(std::ranges::equal(before.ids(), after.ids()));
    for (size_t c = 0; c < material::Count; ++c)
        EXPECT_TRUE(std::ranges::equal(before.column(c), after.column(c))) << c;
}

TEST(BlockMaterials, ofAStateContinueAsTheyWere)
{
    BlockBench first(emittedHeaps()), second(emittedHeaps());
    first.play(70);
    ASSERT_TRUE(second.restore(first.state(), first.tick()));
    first.play(40);
    second.play(40);
    const base::SnapshotGroup &a = *groupOf(first.look(), base::kMaterialKind),
                              &b = *groupOf(second.look(), base::kMaterialKind);
    ASSERT_GT(a.count(), 0u);
    for (size_t c = 0; c < material::Count; ++c)
        EXPECT_TRUE(std::ranges::equal(a.column(c), b.column(c))) << c;
}
