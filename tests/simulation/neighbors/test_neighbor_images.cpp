#include "tests/simulation/neighbors/neighbor_stage.h"

using namespace fx;
using namespace fx::test;
using enum fx::sim::AxisKind;

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

sim::Domain box(sim::AxisKind x, sim::AxisKind y, sim::AxisKind z, double low, double high)
{
    return {{x, y, z}, glm::dvec3(low), glm::dvec3(high)};
}

template <class T>
class NeighborImages : public testing::Test
{};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(NeighborImages, Precisions);

} // namespace

TYPED_TEST(NeighborImages, arePeriodicOnOneTwoAndThreeAxes)
{
    Cloud<TypeParam> cloud;
    cloud.addRandom(1200, 4, -1.0, 2.0, 0.1, 0.3);
    expectTrialOfAll(searched(cloud, box(Periodic, Open, Open, -1, 1)));
    expectTrialOfAll(searched(cloud, box(Open, Periodic, Periodic, -1, 1)));
    expectTrialOfAll(searched(cloud, box(Periodic, Periodic, Periodic, -1, 1)));
}

TYPED_TEST(NeighborImages, giveEveryParticleOfAPeriodicLatticeTheSameNeighbors)
{
    Cloud<TypeParam> cloud; // the first particle of every row lies on the border of the box
    cloud.addLattice(12, 3, 0.25, 0.6);
    const auto s = searched(cloud, box(Periodic, Periodic, Periodic, 3, 6), {.margin = 0});
    expectTrialOfAll(s, 5);
    for (const uint32_t slot : s.owners)
        ASSERT_EQ(s.list(slot).size(),
                  56u); // of a cubic lattice, distances below 2.4 spacings, without itself
}

TYPED_TEST(NeighborImages, ofParticlesThatHaveLeftAPeriodicBoxAreFound)
{
    Cloud<TypeParam> cloud;
    cloud.addRandom(600, 8, -1.0, 2.0, 0.1, 0.3);
    cloud.addRandom(600, 9, -2.5, 5.0, 0.1, 0.3);
    expectTrialOfAll(searched(cloud, box(Periodic, Periodic, Periodic, -1, 1)));
}

TYPED_TEST(NeighborImages, inALongBoxFarFromTheOriginLoseNobody)
{
    sim::Domain domain;
    domain.axes = {Periodic, Open, Periodic};
    domain.low = {1e4, -kInf, -7e3};
    domain.high = {1e4 + 300, kInf, -7e3 + 2};
    Cloud<TypeParam> cloud;
    for (uint32_t i = 0; i < 1500; ++i) {
        const auto u = base::randomUnit4(10, 0, i, base::RandomPurpose::Position);
        cloud.add(1e4 + 300 * double(u[0]), 5 * double(u[1]), -7e3 + 2 * double(u[2]), 0.5);
    }
    expectTrialOfAll(searched(cloud, domain));
}

TYPED_TEST(NeighborImages, nearerThanTheirReachByOneBitAreNotLostToRoundedBoxes)
{
    Cloud<TypeParam> cloud;
    sim::Domain domain;
    domain.axes = {Periodic, Periodic, Periodic};
    domain.low = glm::dvec3(1e4);
    domain.high = glm::dvec3(1e4 + 300);
    for (uint32_t i = 0; i < 1500; ++i) { // on a line, where boxes are as near to each other as particles
        const auto u = base::randomUnit4(21, 0, i, base::RandomPurpose::Position);
        cloud.add(1e4 + 300 * double(u[0]), 1e4 + 20, 1e4 + 20, 1);
    }
    for (uint32_t i = 0; i < cloud.count(); ++i) { // every reach ends just behind the nearest particle
        TypeParam nearest = std::numeric_limits<TypeParam>::max();
        for (uint32_t j = 0; j < cloud.count(); ++j)
            if (const TypeParam d2 = distance2(cloud, domain, i, j, 0); d2 > 0)
                nearest = std::min(nearest, d2);
        cloud.support[i] = std::sqrt(nearest);
        while (!(nearest < cloud.support[i] * cloud.support[i]))
            cloud.support[i] = std::nextafter(cloud.support[i], TypeParam(1e30));
    }
    const auto s = searched(cloud, domain, {.margin = 0});
    expectTrialOfAll(s);
    std::vector<uint32_t> some; // alone, a box is a point
    for (uint32_t slot = 0; slot < cloud.count(); slot += 40)
        some.push_back(slot);
    expectTrialOfAll(searched(cloud, domain, {.margin = 0, .owners = some}));
    expectTrialOfAll(searched(cloud, domain, {.margin = 0, .entriesPerParticle = 0}));
}

TYPED_TEST(NeighborImages, areMirroredInWallsEdgesAndCorners)
{
    Cloud<TypeParam> cloud;
    cloud.addRandom(1200, 5, -1.0, 2.0, 0.1, 0.3);
    cloud.add(-1, 0.2, 1, 0.2); // in two walls
    expectTrialOfAll(searched(cloud, box(Open, Open, Reflecting, -1, kInf)));
    expectTrialOfAll(searched(cloud, box(Open, Reflecting, Open, -kInf, 1)));
    expectTrialOfAll(searched(cloud, box(Reflecting, Periodic, Reflecting, -1, 1)));
    expectTrialOfAll(searched(cloud, box(Reflecting, Reflecting, Reflecting, -1, 1)));
}

TYPED_TEST(NeighborImages, ofAParticleInACornerAreSevenOfItself)
{
    Cloud<TypeParam> cloud;
    cloud.add(0.125, 0.125, 0.125, 0.5); // own images at 0.25, 0.35 and 0.43
    cloud.add(7, 7, 7, 0.5);
    const auto s = searched(cloud, box(Reflecting, Reflecting, Reflecting, 0, kInf), {.margin = 0});
    const uint32_t slot = s.cloud.x[0] < 1 ? 0 : 1;
    std::vector<uint32_t> expected;
    for (uint32_t mirrors = 1; mirrors < 8; ++mirrors)
        expected.push_back(slot | mirrors * sim::kMirrorX);
    EXPECT_EQ(s.list(slot), expected);
    EXPECT_TRUE(s.list(1 - slot).empty());
}

TYPED_TEST(NeighborImages, inBothWallsAreThoseOfTheNearerOne)
{
    Cloud<TypeParam> cloud; // few particles: one group of owners sees both walls
    for (int i = 0; i < 10; ++i)
        cloud.add(0.05 + 0.1 * i, 0.3 * i, 0, 0.45);
    sim::Domain domain;
    domain.axes[0] = Reflecting;
    domain.low.x = 0;
    domain.high.x = 1;
    const auto s = searched(cloud, domain, {.margin = 0});
    expectTrialOfAll(s);
    for (const uint32_t slot : s.owners) {
        const auto list = s.list(slot);
        const TypeParam x = s.cloud.x[slot];
        EXPECT_EQ(std::count(list.begin(), list.end(), slot | sim::kMirrorX), x < 0.225 || x > 0.775 ? 1 : 0);
    }
    // Even where reaches are too long for the box, an entry never means two images.
    for (TypeParam& support : cloud.support)
        support = 2;
    expectTrialOfAll(searched(cloud, domain, {.margin = 0}));
}
