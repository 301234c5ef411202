#include "foundation/random/philox.h"
#include "simulation/particles/fields/alias_table.h"
#include "tests/simulation/particles/modules/chi_square.h"

using namespace fx;
using namespace fx::sim;
using namespace fx::test;

namespace {

/// The exact probability of each thing, from a fine lattice of draws.
std::vector<double> probabilities(const AliasTable& table)
{
    std::vector<double> share(table.size());
    constexpr int kCoins = 4096;
    for (uint32_t row = 0; row < table.size(); ++row)
        for (int c = 0; c < kCoins; ++c)
            share[table.draw((double(row) + 0.5) / table.size(), (float(c) + 0.5f) / kCoins)] +=
                1.0 / (double(table.size()) * kCoins);
    return share;
}

} // namespace

TEST(AliasTable, drawsInProportionToTheWeights)
{
    const std::vector<double> weights{1, 2, 3, 4, 0.5, 0, 10, 1e-3};
    const std::vector<double> share = probabilities(AliasTable(weights));
    for (size_t i = 0; i < weights.size(); ++i)
        EXPECT_NEAR(share[i], weights[i] / 20.501, 1e-4) << i;
    EXPECT_EQ(share[5], 0.0) << "what has no weight is never drawn";
}

TEST(AliasTable, weightsThatAreNoWeightsCountAsNone)
{
    const std::vector<double> weights{1, -5, std::nan(""), 1, INFINITY};
    const std::vector<double> share = probabilities(AliasTable(weights));
    EXPECT_NEAR(share[0], 0.5, 1e-4);
    EXPECT_NEAR(share[3], 0.5, 1e-4);
    const std::vector<double> none(4, 0.0);
    for (const double p : probabilities(AliasTable(none)))
        EXPECT_NEAR(p, 0.25, 1e-9);
}

TEST(AliasTable, theEndsOfTheRangesAreInside)
{
    const AliasTable one(std::vector<double>{3.0});
    EXPECT_EQ(one.draw(0.0, 0.0f), 0u);
    EXPECT_EQ(one.draw(1.0, 1.0f), 0u);
}

TEST(AliasTable, aMillionDrawsFromAHundredThingsAreAsOftenAsTheyShould)
{
    std::vector<double> weights(100);
    for (size_t i = 0; i < weights.size(); ++i)
        weights[i] = 1.0 + double(i % 7);
    const AliasTable table(weights);
    std::vector<uint64_t> counts(100);
    constexpr int kDraws = 1'000'000;
    for (int i = 0; i < kDraws; ++i) {
        const auto u = base::randomUnit4(3, 0, uint64_t(i), base::RandomPurpose::Position);
        ++counts[table.draw(double(u[0]), u[1])];
    }
    double sum = 0, chi = 0;
    for (const double w : weights)
        sum += w;
    for (size_t i = 0; i < 100; ++i) {
        const double want = kDraws * weights[i] / sum;
        chi += (double(counts[i]) - want) * (double(counts[i]) - want) / want;
    }
    EXPECT_LT(chi, chiSquareLimit(99, kSidak));
}
