// Presets of much work, in small: an update does no more of it than it is granted, with the same results.
#include "tests/api/budget_host.h"

#include <map>
#include <ostream>
#include <utility>

using namespace fx::test;

namespace {

/// A preset of much work, in small.
struct Heavy
{
    const char* name;
    const char* preset;
    uint64_t budget; ///< [unit] less than its steps take, and much more than a piece that is not divided
    bool needsGas = false;
};

void PrintTo(const Heavy& heavy, std::ostream* out)
{
    *out << heavy.name;
}

/// `count` elements of a list, of which each is `element` with its number in the place of every '#'.
std::string listOf(int count, const std::string& element)
{
    std::string list;
    for (int i = 0; i < count; ++i)
        for (const char c : (i > 0 ? "," : "") + element)
            list += c == '#' ? std::to_string(i) : std::string(1, c);
    return "[" + list + "]";
}

/// Each particle that is born in one of them causes births in the next.
std::string fanOf(int emitters)
{
    std::string list;
    for (int i = 0; i < emitters; ++i) {
        const std::string number = std::to_string(i), next = std::to_string(i + 1);
        list += std::string(i > 0 ? "," : "") + R"({"name":"e)" + number +
                R"(","maxParticles":2000,"lifetime":0.05,"radius":0.1)";
        list += i == 0 ? R"(,"emission":{"rate":600})" : "";
        list +=
            i + 1 < emitters ? R"(,"events":[{"on":"birth","emit":"e)" + next + R"(","count":4096}]})" : "}";
    }
    return "[" + list + "]";
}

std::string presetOf(const Heavy& heavy)
{
    const std::string name = heavy.name;
    std::string parts;
    if (name == "fan")
        parts = R"("emitters":)" + fanOf(8);
    else if (name == "gas")
        parts = R"("gas":)" + listOf(3, heavy.preset);
    else if (name == "fragments")
        parts = R"("fragments":)" + listOf(6, heavy.preset);
    else
        parts = std::string(heavy.preset).front() == '['
                    ? R"("emitters":)" + std::string(heavy.preset)
                    : R"("subSteps":8,"emitters":)" + listOf(6, heavy.preset);
    return R"({"version":1,"duration":20,)" + parts + "}";
}

constexpr Heavy kHeavy[] = {
    {"gas", R"({"particles":150,"soundSpeed":0,"pressureRatio":100,"material":"tnt"})", 120'000, true},
    {"fan", "", 60'000},
    {"pairs", R"([{"name":"a","maxParticles":500,"lifetime":1,"emission":{"rate":3000},"events":[
        {"on":"age","age":0.001,"every":0.01,"emit":"b","count":65536},
        {"on":"age","age":0.002,"every":0.01,"emit":"b","count":65536}]},
        {"name":"b","maxParticles":1,"lifetime":0.01}])",
     8'000},
    {"subSteps", R"({"name":"e#","maxParticles":2000,"lifetime":0.3,"radius":0.1,"emission":{"rate":20000},
        "forces":{"curlStrength":1,"curlOctaves":4,"drag":1}})",
     120'000},
    {"fragments",
     R"({"count":60,"lifetime":30,"speed":200,"trail":{"spacing":0.01,"maxBlobs":2000,"lifetime":30}})",
     30'000},
    {"large", R"([{"name":"e","maxParticles":60000,"lifetime":0.05,"radius":0.1,"emission":{"rate":300000,
        "bursts":[{"time":0.01,"count":40000}]},"forces":{"curlStrength":1,"drag":1}}])",
     40'000},
    {"full", R"([{"name":"e","maxParticles":20000,"lifetime":{"min":0.02,"max":0.2},"radius":0.1,
        "emission":{"rate":2000000}}])",
     40'000},
    {"drawn", R"([{"name":"e","maxParticles":40000,"lifetime":1,"radius":0.1,"emission":{"rate":400000},
        "appearance":{"kind":"sprite"},"trail":{"lifetime":0.2,"maxPoints":8},"light":{"count":8}}])",
     60'000},
};

constexpr double kMaxShareOver = 1.3; ///< [1] of the budget that the largest update may take

class HeavyPreset : public ::testing::TestWithParam<Heavy>
{};

INSTANTIATE_TEST_SUITE_P(Each, HeavyPreset, ::testing::ValuesIn(kHeavy),
                         [](const auto& each) { return std::string(each.param.name); });

} // namespace

TEST_P(HeavyPreset, staysWithinTheBudgetAndGivesTheSameBits)
{
    const Heavy& heavy = GetParam();
    if (heavy.needsGas)
        FX_NEEDS_GAS();
    constexpr int kFrames = 8;
    Host free(0);
    free.add(presetOf(heavy));
    std::map<int64_t, uint64_t> expected; // by scene time
    uint64_t whole = 0;
    for (int i = 0; i < kFrames; ++i) {
        const FxSceneStatistics statistics = free.update(kFrame);
        EXPECT_EQ(statistics.timeDebtTicks, 0);
        whole = std::max(whole, statistics.updateWork);
        expected[statistics.simulatedTick] = hashOf(free.scene());
    }
    ASSERT_GT(whole, 2 * heavy.budget) << "too little work to be divided";
    for (const auto& [budget, workers] : {std::pair(heavy.budget, 1u), std::pair(whole / 2, 4u)}) {
        Host bounded(budget, workers);
        bounded.add(presetOf(heavy));
        int64_t debt = 0, shown = 0;
        for (int i = 0; i < 100'000 && (i < kFrames || debt > 0); ++i) {
            const FxSceneStatistics statistics = bounded.update(i < kFrames ? kFrame : 0.0);
            EXPECT_LE(double(statistics.updateWork), kMaxShareOver * double(budget)) << "update " << i;
            EXPECT_TRUE(statistics.updateWork > 0 || statistics.timeDebtTicks == 0);
            EXPECT_TRUE(i != kFrames - 1 || statistics.timeDebtTicks > 0 || budget > heavy.budget);
            debt = statistics.timeDebtTicks;
            EXPECT_EQ(statistics.nowTick - statistics.simulatedTick, debt);
            if (statistics.simulatedTick > shown) {
                EXPECT_EQ(hashOf(bounded.scene()), expected[statistics.simulatedTick]) << "update " << i;
            }
            shown = statistics.simulatedTick;
        }
        EXPECT_EQ(debt, 0);
        EXPECT_EQ(simulationHashOf(bounded.scene()), simulationHashOf(free.scene()));
        EXPECT_EQ(statisticsOf(bounded.scene()).born, statisticsOf(free.scene()).born);
        EXPECT_EQ(statisticsOf(bounded.scene()).dropped, statisticsOf(free.scene()).dropped);
    }
}

TEST_P(HeavyPreset, isDividedAtTheSamePlacesForAnyNumberOfThreads)
{
    const Heavy& heavy = GetParam();
    if (heavy.needsGas)
        FX_NEEDS_GAS();
    Host one(heavy.budget, 1), two(heavy.budget, 2), four(heavy.budget, 4);
    for (Host* const host : {&one, &two, &four})
        host->add(presetOf(heavy));
    for (int i = 0; i < 12; ++i) {
        const FxSceneStatistics a = one.update(kFrame);
        for (Host* const other : {&two, &four}) {
            const FxSceneStatistics b = other->update(kFrame);
            EXPECT_EQ(a.simulatedTick, b.simulatedTick);
            EXPECT_EQ(a.updateWork, b.updateWork);
            EXPECT_EQ(hashOf(one.scene()), hashOf(other->scene()));
        }
    }
}
