#include "tests/simulation/neighbors/neighbor_stage.h"

using namespace fx;
using namespace fx::test;

namespace {

/// Every box holds its children or particles, tightly, and knows their largest support.
template <class T>
void expectRightBoxes(const sim::TreeView<T>& tree, const Cloud<T>& cloud)
{
    const std::vector<T>* const axes[3] = {&cloud.x, &cloud.y, &cloud.z};
    uint32_t span = 1; // leaves below a box
    for (uint32_t level = 0; level < tree.levels; ++level, span *= sim::kTreeFanOut)
        for (uint32_t node = 0; node < tree.levelCount[level]; ++node) {
            const uint32_t box = tree.levelFirst[level] + node;
            const uint32_t begin = tree.leafBegin[node * span];
            const uint32_t end = tree.leafBegin[std::min((node + 1) * span, tree.levelCount[0])];
            ASSERT_LT(begin, end);
            for (uint32_t a = 0; a < 3; ++a) {
                EXPECT_EQ(tree.low[a][box],
                          *std::min_element(&(*axes[a])[begin], &(*axes[a])[begin] + (end - begin)));
                EXPECT_EQ(tree.high[a][box],
                          *std::max_element(&(*axes[a])[begin], &(*axes[a])[begin] + (end - begin)));
            }
            EXPECT_EQ(tree.reach[box],
                      *std::max_element(&cloud.support[begin], &cloud.support[begin] + (end - begin)));
        }
    EXPECT_EQ(tree.levelCount[tree.levels - 1], 1u);
}

template <class T>
struct Grown
{
    Grown(const Cloud<T>& from, uint32_t threads = 1)
        : tasks(runner(threads)), tree(std::pmr::get_default_resource(), from.count())
    {
        tree.sort(from.columns(), {}, *tasks);
        cloud = from.reordered(tree.order());
        tree.refit(cloud.columns(), *tasks);
    }
    std::unique_ptr<base::TaskRunner> tasks;
    sim::ParticleTree<T> tree;
    Cloud<T> cloud;
};

} // namespace

TEST(ParticleTree, leavesCoverAllPlacesAndHoldFewParticlesEach)
{
    Cloud<float> cloud;
    cloud.addRandom(20'000, 1, -1, 2, 0.1, 0.2);
    for (int i = 0; i < 300; ++i)
        cloud.add(0.5, 0.5, 0.5, 0.1); // no cell can separate these
    const Grown<float> grown(cloud);
    const auto tree = grown.tree.view();
    EXPECT_EQ(tree.leafBegin[0], 0u);
    EXPECT_EQ(tree.leafBegin[tree.levelCount[0]], cloud.count());
    for (uint32_t leaf = 0; leaf < tree.levelCount[0]; ++leaf) {
        EXPECT_LT(tree.leafBegin[leaf], tree.leafBegin[leaf + 1]);
        EXPECT_LE(tree.leafBegin[leaf + 1] - tree.leafBegin[leaf], sim::kMaxLeafParticles);
    }
    EXPECT_LT(tree.levelCount[0], cloud.count() / 5) << "leaves with hardly anybody inside";
}

TEST(ParticleTree, leavesEndWhereCellsEnd)
{
    Cloud<float> cloud; // ten clusters of ten, far apart
    for (int cluster = 0; cluster < 10; ++cluster)
        cloud.addRandom(10, uint64_t(cluster), 100.0 * cluster, 1, 1, 1);
    const Grown<float> grown(cloud);
    const auto tree = grown.tree.view();
    EXPECT_EQ(tree.levelCount[0], 10u);
    for (uint32_t leaf = 0; leaf < tree.levelCount[0]; ++leaf)
        EXPECT_LT(tree.high[0][leaf] - tree.low[0][leaf], 1.0f);
}

TEST(ParticleTree, boxesAreTightForAnyNumberOfWorkers)
{
    Cloud<double> cloud;
    cloud.addRandom(9'000, 2, -1e5, 2e5, 1, 100);
    for (const uint32_t threads : {1u, 3u, kBackwards}) {
        const Grown<double> grown(cloud, threads);
        expectRightBoxes(grown.tree.view(), grown.cloud);
    }
}

TEST(ParticleTree, boxesOfALatticeAreItsOctants)
{
    Cloud<float> cloud;
    cloud.addLattice(32, 0, 1, 2);
    const Grown<float> grown(cloud);
    const auto tree = grown.tree.view();
    EXPECT_EQ(tree.levelCount[0], 32u * 32u * 32u / 16u);
    for (uint32_t leaf = 0; leaf < tree.levelCount[0]; ++leaf) {
        float volume = 1;
        for (uint32_t a = 0; a < 3; ++a)
            volume *= tree.high[a][leaf] - tree.low[a][leaf] + 1;
        EXPECT_EQ(volume, 16.0f);
    }
}

TEST(ParticleTree, refitFollowsMotionAndSaysHowMuchLooserItHasBecome)
{
    Cloud<float> cloud;
    cloud.addLattice(20, 0, 1, 2.4);
    Grown<float> grown(cloud);
    EXPECT_EQ(grown.tree.loosened(), 0.0);
    grown.tree.refit(grown.cloud.columns(), *grown.tasks);
    EXPECT_EQ(grown.tree.loosened(), 0.0) << "nobody has moved";
    double before = 0;
    for (const double distance : {0.5, 1.0, 3.0}) {
        for (uint32_t i = 0; i < cloud.count(); ++i)
            grown.cloud.x[i] += float(i % 2 == 0 ? distance : -distance);
        grown.tree.refit(grown.cloud.columns(), *grown.tasks);
        expectRightBoxes(grown.tree.view(), grown.cloud);
        EXPECT_GT(grown.tree.loosened(), before);
        before = grown.tree.loosened();
    }
    EXPECT_GT(before, 1.0);
    grown.tree.sort(grown.cloud.columns(), {}, *grown.tasks);
    grown.cloud = grown.cloud.reordered(grown.tree.order());
    grown.tree.refit(grown.cloud.columns(), *grown.tasks);
    EXPECT_EQ(grown.tree.loosened(), 0.0);
}

TEST(ParticleTree, evenExpansionLeavesItTightAndShrinkingSupportsDoNot)
{
    Cloud<float> cloud;
    cloud.addLattice(20, 0, 1, 2.4);
    Grown<float> grown(cloud);
    for (uint32_t i = 0; i < cloud.count(); ++i)
        for (std::vector<float>* column :
             {&grown.cloud.x, &grown.cloud.y, &grown.cloud.z, &grown.cloud.support})
            (*column)[i] *= 2;
    grown.tree.refit(grown.cloud.columns(), *grown.tasks);
    EXPECT_NEAR(grown.tree.loosened(), 0.0, 1e-5);
    for (uint32_t i = 0; i < cloud.count(); ++i)
        grown.cloud.support[i] /= 2;
    grown.tree.refit(grown.cloud.columns(), *grown.tasks);
    EXPECT_GT(grown.tree.loosened(), 0.25);
}

TEST(ParticleTree, anEmptyCloudHasNoBoxes)
{
    const Grown<float> grown{Cloud<float>{}};
    EXPECT_EQ(grown.tree.view().levels, 0u);
    EXPECT_TRUE(grown.tree.order().empty());
}
