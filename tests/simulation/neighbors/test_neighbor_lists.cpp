#include "tests/foundation/every_set.h"
#include "tests/simulation/neighbors/neighbor_stage.h"

using namespace fx;
using namespace fx::test;
using sim::AxisKind;

namespace {

template <class T>
class NeighborLists : public testing::Test
{};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(NeighborLists, Precisions);

sim::Domain mixedBox()
{
    return {{AxisKind::Periodic, AxisKind::Reflecting, AxisKind::Open}, glm::dvec3(-1), glm::dvec3(1)};
}

/// Even, and ten times denser in the middle.
template <class T>
Cloud<T> someCloud()
{
    Cloud<T> cloud;
    cloud.addRandom(2500, 11, -1.0, 2.0, 0.15, 0.25);
    cloud.addRandom(2500, 12, -0.1, 0.2, 0.02, 0.04);
    return cloud;
}

template <class T>
std::vector<std::vector<uint32_t>> allLists(const Searched<T>& s)
{
    std::vector<std::vector<uint32_t>> lists;
    for (const uint32_t slot : s.owners)
        lists.push_back(s.list(slot));
    return lists;
}

} // namespace

TYPED_TEST(NeighborLists, areThoseOfATrialOfAllPairsInARandomCloud)
{
    for (const uint32_t count : {1u, 2u, 15u, 16u, 17u, 100u, 1500u}) {
        Cloud<TypeParam> cloud;
        cloud.addRandom(count, 3, -0.5, 1.0, 0.05, 0.15);
        expectTrialOfAll(searched(cloud, {}));
    }
}

TYPED_TEST(NeighborLists, leaveOutParticlesAtExactlyTheirReach)
{
    Cloud<TypeParam> cloud; // on borders of cells, with pairs at distances 1 and sqrt(2)
    cloud.addLattice(9, -4, 1, 1);
    const auto touching = searched(cloud, {}, {.margin = 0});
    for (const uint32_t slot : touching.owners)
        EXPECT_TRUE(touching.list(slot).empty());
    const auto reaching = searched(cloud, {}, {.margin = 0.0625});
    expectTrialOfAll(reaching);
    for (const uint32_t slot : reaching.owners) {
        const bool inside = std::abs(reaching.cloud.x[slot]) < 4 && std::abs(reaching.cloud.y[slot]) < 4 &&
                            std::abs(reaching.cloud.z[slot]) < 4;
        EXPECT_TRUE(!inside || reaching.list(slot).size() == 6);
    }
}

TYPED_TEST(NeighborLists, holdWhoeverReachesFurtherOfTheTwo)
{
    Cloud<TypeParam> cloud; // densities that differ by 1e6: supports by 100
    cloud.addRandom(1500, 6, -1, 2, 0.2, 0.3);
    cloud.addRandom(1500, 7, -0.01, 0.02, 0.002, 0.003);
    expectTrialOfAll(searched(cloud, {}, {.entriesPerParticle = 2048}));
}

TYPED_TEST(NeighborLists, areSymmetric)
{
    for (const sim::Domain& domain : {sim::Domain{}, mixedBox()}) {
        const auto s = searched(someCloud<TypeParam>(), domain);
        const auto lists = allLists(s);
        for (uint32_t i = 0; i < lists.size(); ++i)
            for (const uint32_t entry : lists[i]) {
                const auto& other = lists[entry & sim::kPlaceMask];
                const uint32_t back = i | (entry & ~sim::kPlaceMask);
                ASSERT_TRUE(std::binary_search(other.begin(), other.end(), back)) << i << " and " << entry;
            }
    }
}

TYPED_TEST(NeighborLists, areTheSameForAnyNumberOfWorkers)
{
    const auto alone = allLists(searched(someCloud<TypeParam>(), mixedBox()));
    for (const uint32_t threads : {2u, 3u, 7u, kBackwards})
        EXPECT_EQ(allLists(searched(someCloud<TypeParam>(), mixedBox(), {.threads = threads})), alone);
}

TYPED_TEST(NeighborLists, areTheSameForEveryInstructionSet)
{
    const auto lists = allLists(searched(someCloud<TypeParam>(), mixedBox()));
    const auto open = allLists(searched(someCloud<TypeParam>(), {}, {.entriesPerParticle = 20}));
    test::everySet([&](base::InstructionSet set) {
        EXPECT_EQ(base::instructionSet(), set);
        EXPECT_EQ(allLists(searched(someCloud<TypeParam>(), mixedBox())), lists);
        EXPECT_EQ(allLists(searched(someCloud<TypeParam>(), {}, {.entriesPerParticle = 20})), open);
    });
}

TYPED_TEST(NeighborLists, ofFewOwnersAreThoseThatAllWouldHave)
{
    const auto all = searched(someCloud<TypeParam>(), mixedBox());
    for (const uint32_t stride : {2u, 7u, 100u, 4999u}) {
        std::vector<uint32_t> owners;
        for (uint32_t slot = stride / 2; slot < all.cloud.count(); slot += stride)
            owners.push_back(slot);
        const auto few = searched(someCloud<TypeParam>(), mixedBox(), {.owners = owners});
        for (const uint32_t slot : owners)
            ASSERT_EQ(few.list(slot), all.list(slot)) << "place " << slot << ", every " << stride;
    }
}

TYPED_TEST(NeighborLists, withoutRoomAreFoundAnewWhenAskedFor)
{
    const auto roomy = searched(someCloud<TypeParam>(), mixedBox());
    EXPECT_LE(roomy.lists->unlisted(), 10u); // those with more than 2048 neighbors never have one
    for (const uint32_t entries : {0u, 1u, 40u}) {
        const auto narrow = searched(someCloud<TypeParam>(), mixedBox(), {.entriesPerParticle = entries});
        EXPECT_GT(narrow.lists->unlisted(), 0u);
        EXPECT_EQ(allLists(narrow), allLists(roomy));
    }
}

TYPED_TEST(NeighborLists, stayExactWhenParticlesMoveAndTheTreeIsOnlyRefit)
{
    auto s = searched(someCloud<TypeParam>(), mixedBox());
    const auto tasks = runner(1);
    for (int step = 0; step < 3; ++step) {
        for (uint32_t i = 0; i < s.cloud.count(); ++i) {
            const auto u = base::randomUnit4(20 + uint64_t(step), 0, i, base::RandomPurpose::Position);
            s.cloud.x[i] += TypeParam(0.3 * (double(u[0]) - 0.5));
            s.cloud.y[i] *= TypeParam(u[1]); // stays between the walls
            s.cloud.z[i] += TypeParam(0.3 * (double(u[2]) - 0.5));
            s.cloud.support[i] *= TypeParam(0.8 + 0.4 * double(u[3]));
        }
        s.tree->refit(s.cloud.columns(), *tasks);
        s.lists->build(*s.tree, s.domain, s.owners, s.margin, *tasks);
        expectTrialOfAll(s, 7);
    }
}

TYPED_TEST(NeighborLists, withMarginCoverAllPairsWhileMotionsStayBelowHalfOfIt)
{
    auto s = searched(someCloud<TypeParam>(), {}, {.margin = 0.25});
    const auto lists = allLists(s);
    const std::vector<TypeParam> support = s.cloud.support;
    const double largest = 0.002; // of any motion
    for (uint32_t i = 0; i < s.cloud.count(); ++i) {
        s.cloud.x[i] += TypeParam(i % 2 == 0 ? largest : -largest) * TypeParam(0.999);
        s.cloud.support[i] = TypeParam(0.999) * (TypeParam(1.25) * support[i] - TypeParam(2 * largest));
    }
    for (uint32_t i = 0; i < s.cloud.count(); i += 11)
        for (const uint32_t j : trialOfAll(s.cloud, {}, TypeParam(0), i))
            ASSERT_TRUE(std::binary_search(lists[i].begin(), lists[i].end(), j)) << i << " and " << j;
}
