#include "tests/simulation/neighbors/neighbor_stage.h"

using namespace fx;
using namespace fx::test;

namespace {

/// Memory that counts what is asked of it.
class CountingMemory final : public std::pmr::memory_resource
{
public:
    size_t calls = 0;
    size_t bytes = 0;

private:
    void* do_allocate(size_t size, size_t alignment) override
    {
        ++calls;
        bytes += size;
        return std::pmr::new_delete_resource()->allocate(size, alignment);
    }
    void do_deallocate(void* memory, size_t size, size_t alignment) override
    {
        std::pmr::new_delete_resource()->deallocate(memory, size, alignment);
    }
    bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

} // namespace

TEST(NeighborExtremes, aMillionInOneSmallCellBesideAWideCloudAreFoundInBoundedMemory)
{
    constexpr uint32_t kMany = 1'000'000;
    Cloud<float> cloud; // one cell of the curve is 0.5 m wide; the cluster has a fifth of it
    cloud.addRandom(kMany, 1, 0.1, 0.1, 0.0024, 0.0024);
    cloud.addRandom(2'000, 2, -5e5, 1e6, 1e5, 1e5);
    CountingMemory memory;
    sim::ParticleTree<float> tree(&memory, cloud.count());
    sim::NeighborLists<float> lists(&memory, cloud.count(), 96);
    const size_t calls = memory.calls;
    EXPECT_LT(memory.bytes, size_t(cloud.count()) * (96 * 4 + 150));
    const auto tasks = runner(2);
    tree.sort(cloud.columns(), {}, *tasks);
    Searched<float> s;
    s.cloud = cloud.reordered(tree.order());
    tree.refit(s.cloud.columns(), *tasks);
    lists.build(tree, {}, everyone(cloud.count()), 0.0f, *tasks);
    EXPECT_EQ(memory.calls, calls) << "allocated while searching";
    // Particles that reach across the whole cluster have too many neighbors for a list; no other list may be
    // lost.
    EXPECT_LE(lists.unlisted(), 2'000u);
    for (uint32_t slot = 0; slot < cloud.count(); slot += 20'011) {
        if (s.cloud.support[slot] > 1)
            continue;
        std::vector<uint32_t> found;
        lists.forEachPiece(slot, [&](const uint32_t* entries, uint32_t count, bool) {
            found.insert(found.end(), entries, entries + count);
        });
        EXPECT_EQ(found, trialOfAll(s.cloud, {}, 0.0f, slot));
    }
}

TEST(NeighborExtremes, fourThousandCoincidentParticlesFindEachOtherInFewPieces)
{
    Cloud<float> cloud;
    for (int i = 0; i < 4096; ++i)
        cloud.add(-1, 2, 3, 0.5);
    cloud.add(-1, 2, 3.25, 0.125);
    const auto s = searched(cloud, {}, {.margin = 0, .entriesPerParticle = 64});
    EXPECT_EQ(s.lists->unlisted(), 4097u);
    for (uint32_t slot = 0; slot < 4097; slot += 128) {
        uint32_t pieces = 0;
        uint32_t total = 0;
        s.lists->forEachPiece(slot, [&](const uint32_t*, uint32_t count, bool) {
            ++pieces;
            total += count;
        });
        EXPECT_EQ(total, 4096u);
        EXPECT_LE(pieces, 5u);
    }
    EXPECT_EQ(s.list(77), trialOfAll(s.cloud, {}, 0.0f, 77));
}

TEST(NeighborExtremes, aSparseParticleWithManyNeighborsDoesNotCostOthersTheirLists)
{
    Cloud<float> cloud;
    cloud.addLattice(24, 0, 1, 1.8);
    cloud.add(12.1, 11.9, 12.2, 9); // reaches three thousand
    const auto s = searched(cloud, {}, {.margin = 0});
    EXPECT_EQ(s.lists->unlisted(), 1u);
    expectTrialOfAll(s, 97);
}

TEST(NeighborExtremes, coordinatesToTwoToThe31AreNoDifferent)
{
    constexpr double kFar = 2147483648.0;
    Cloud<float> single;
    single.addRandom(2000, 3, -kFar, 2 * kFar, 1e8, 9e8);
    single.add(-kFar, -kFar, -kFar, 1);
    single.add(kFar, kFar, kFar, 1);
    expectTrialOfAll(searched(single, {}), 3);
    Cloud<double> precise; // clusters of 1 m at opposite corners
    precise.addRandom(700, 4, -kFar, 1, 0.1, 0.2);
    precise.addRandom(700, 5, kFar - 1, 1, 0.1, 0.2);
    const auto s = searched(precise, {});
    expectTrialOfAll(s, 3);
    EXPECT_GT(s.lists->entries(), 1400u);
}

TEST(NeighborExtremes, supportsWithoutBoundReachEverybody)
{
    Cloud<float> cloud;
    cloud.addRandom(300, 6, -1e6, 2e6, 1e30, 1e30);
    const auto s = searched(cloud, {});
    for (const uint32_t slot : s.owners)
        EXPECT_EQ(s.list(slot).size(), 299u);
}

TEST(NeighborExtremes, aParticleAtNanHasNoNeighborsAndCostsNobodyTheirs)
{
    Cloud<float> cloud;
    cloud.addRandom(1000, 8, -1, 2, 0.2, 0.3);
    for (const uint32_t i : {0u, 1u, 400u, 999u})
        cloud.y[i] = std::numeric_limits<float>::quiet_NaN();
    cloud.x[400] = std::numeric_limits<float>::quiet_NaN();
    const auto s = searched(cloud, {});
    expectTrialOfAll(s);
    EXPECT_GT(s.lists->entries(), 1000u);
}

TEST(NeighborExtremes, nobodyHasNoNeighbors)
{
    const auto s = searched(Cloud<float>{}, {});
    EXPECT_EQ(s.lists->entries(), 0u);
}
