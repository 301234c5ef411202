// An update does no more work than it is granted; what is left is done later, with the same results.
#include "tests/api/api_fixture.h"

#include <map>
#include <ostream>

using fx::test::kFrame;
using fx::test::loadText;

namespace {

/// A preset of much work, in small.
struct Heavy
{
    const char* name;
    const char* preset;
    uint64_t piece;  ///< [unit] no less than its largest piece of work that is not divided, and showing it
    uint64_t budget; ///< [unit] less than its steps take
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
    {"gas", R"({"particles":150,"soundSpeed":0,"pressureRatio":100,"material":"tnt"})", 150 * 200 + 40'000,
     60'000, true},
    {"fan", "", 30'000 + 8 * 2000 * 6, 30'000},
    {"pairs", R"([{"name":"a","maxParticles":500,"lifetime":1,"emission":{"rate":3000},"events":[
        {"on":"age","age":0.001,"every":0.01,"emit":"b","count":65536},
        {"on":"age","age":0.002,"every":0.01,"emit":"b","count":65536}]},
        {"name":"b","maxParticles":1,"lifetime":0.01}])",
     20'000, 3'000},
    {"subSteps", R"({"name":"e#","maxParticles":2000,"lifetime":0.3,"radius":0.1,"emission":{"rate":20000},
        "forces":{"curlStrength":1,"curlOctaves":4,"drag":1}})",
     2000 * 16 + 6 * 2000 * 6, 60'000},
    {"fragments",
     R"({"count":60,"lifetime":30,"speed":200,"trail":{"spacing":0.01,"maxBlobs":2000,"lifetime":30}})",
     2060 * 24 + 6 * 2060 * 6, 40'000},
};

FxSceneStatistics statisticsOf(FxScene* scene)
{
    FxSceneStatistics statistics = {};
    statistics.structSize = sizeof statistics;
    EXPECT_EQ(fxScene_GetStatistics(scene, &statistics), FX_OK);
    return statistics;
}

uint64_t hashOf(FxScene* scene)
{
    uint64_t hash = 0;
    EXPECT_EQ(fxScene_GetStateHash(scene, &hash), FX_OK);
    return hash;
}

uint64_t simulationHashOf(FxScene* scene)
{
    uint64_t hash = 0;
    EXPECT_EQ(fxScene_GetSimulationHash(scene, &hash), FX_OK);
    return hash;
}

/// A scene of a context of its own.
class Host
{
public:
    explicit Host(uint64_t budget, uint32_t workers = 1, int64_t longestDebt = 30 * FX_TICKS_PER_SECOND)
    {
        FxContextDef contextDef = fxDefaultContextDef();
        contextDef.workers = workers;
        EXPECT_EQ(fxCreateContext(&contextDef, &context_), FX_OK);
        FxSceneDef def = fxDefaultSceneDef();
        def.workBudget = budget;
        def.maxCatchUpTicks = longestDebt;
        EXPECT_EQ(fxCreateScene(context_, &def, &scene_), FX_OK);
    }
    ~Host() { fxDestroyContext(context_); }
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;

    FxInstanceId add(const std::string& preset, uint64_t seed = 7)
    {
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = loadText(context_, preset);
        def.seed = seed;
        FxInstanceId id = {};
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
        return id;
    }
    FxSceneStatistics update(double seconds)
    {
        EXPECT_EQ(fxScene_Update(scene_, seconds), FX_OK);
        return statisticsOf(scene_);
    }
    /// Updates by nothing until the debt is paid.
    void payDebt()
    {
        for (int i = 0; i < 100'000 && update(0.0).timeDebtTicks > 0; ++i) {
        }
        EXPECT_EQ(statisticsOf(scene_).timeDebtTicks, 0);
    }
    FxInstanceState stateOf(FxInstanceId id)
    {
        FxInstanceState state = FX_INSTANCE_FINISHED;
        EXPECT_EQ(fxScene_GetInstanceState(scene_, id, &state, nullptr), FX_OK);
        return state;
    }
    FxScene* scene() { return scene_; }

private:
    FxContext* context_ = nullptr;
    FxScene* scene_ = nullptr;
};

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
    Host free(0), bounded(heavy.budget);
    for (Host* const host : {&free, &bounded})
        host->add(presetOf(heavy));
    std::map<int64_t, uint64_t> expected; // by scene time
    uint64_t whole = 0;
    for (int i = 0; i < kFrames; ++i) {
        const FxSceneStatistics statistics = free.update(kFrame);
        EXPECT_EQ(statistics.timeDebtTicks, 0);
        whole = std::max(whole, statistics.updateWork);
        expected[statistics.simulatedTick] = hashOf(free.scene());
    }
    ASSERT_GT(whole, 2 * heavy.budget) << "too little work to be divided";
    int64_t debt = 0;
    for (int i = 0; i < 100'000 && (i < kFrames || debt > 0); ++i) {
        const FxSceneStatistics statistics = bounded.update(i < kFrames ? kFrame : 0.0);
        EXPECT_LE(statistics.updateWork, heavy.budget + heavy.piece) << "update " << i;
        EXPECT_GT(statistics.updateWork, 0u);
        EXPECT_TRUE(i != kFrames - 1 || statistics.timeDebtTicks > 0);
        debt = statistics.timeDebtTicks;
        EXPECT_EQ(statistics.nowTick - statistics.simulatedTick, debt);
        if (statistics.simulatedTick > 0) {
            EXPECT_EQ(hashOf(bounded.scene()), expected[statistics.simulatedTick]) << "update " << i;
        }
    }
    EXPECT_EQ(debt, 0);
    EXPECT_EQ(simulationHashOf(bounded.scene()), simulationHashOf(free.scene()));
    EXPECT_EQ(statisticsOf(bounded.scene()).born, statisticsOf(free.scene()).born);
    EXPECT_EQ(statisticsOf(bounded.scene()).dropped, statisticsOf(free.scene()).dropped);
}

TEST_P(HeavyPreset, isDividedAtTheSamePlacesForAnyNumberOfThreads)
{
    const Heavy& heavy = GetParam();
    if (heavy.needsGas)
        FX_NEEDS_GAS();
    Host one(heavy.budget, 1), two(heavy.budget, 2);
    for (Host* const host : {&one, &two})
        host->add(presetOf(heavy));
    for (int i = 0; i < 12; ++i) {
        const FxSceneStatistics a = one.update(kFrame), b = two.update(kFrame);
        EXPECT_EQ(a.simulatedTick, b.simulatedTick);
        EXPECT_EQ(a.updateWork, b.updateWork);
        EXPECT_EQ(hashOf(one.scene()), hashOf(two.scene()));
    }
}

namespace {

/// Motion that has no closed form, with two seconds of past, in each of which it is 600 steps of its
/// particles.
std::string swirlPreset(double prewarm)
{
    return R"({"version":1,"duration":60,"prewarm":)" + std::to_string(prewarm) +
           R"(,"emitters":[{"name":"e","maxParticles":300,"lifetime":1,"radius":0.1,"emission":{"rate":250},
               "forces":{"curlStrength":1,"curlOctaves":2,"drag":1}}]})";
}

} // namespace

TEST(WorkBudget, prewarmIsSpreadOverUpdatesWhileTheSceneGoesOn)
{
    Host free(0), bounded(20'000);
    FxInstanceId late = {};
    for (Host* const host : {&free, &bounded}) {
        host->add(swirlPreset(0), 1);
        late = host->add(swirlPreset(4), 2);
    }
    int waking = 0;
    for (int i = 0; i < 400 && (i < 5 || bounded.stateOf(late) == FX_INSTANCE_WAKING); ++i) {
        waking += bounded.stateOf(late) == FX_INSTANCE_WAKING ? 1 : 0;
        free.update(kFrame);
        const FxSceneStatistics statistics = bounded.update(kFrame);
        EXPECT_EQ(statistics.timeDebtTicks, 0) << "the others wait for it";
        EXPECT_LE(statistics.updateWork, 20'000u + 300 * 40);
    }
    EXPECT_GT(waking, 3);
    EXPECT_EQ(bounded.stateOf(late), FX_INSTANCE_ACTIVE);
    EXPECT_EQ(simulationHashOf(bounded.scene()), simulationHashOf(free.scene()));
    free.update(kFrame);
    bounded.update(kFrame);
    EXPECT_EQ(hashOf(bounded.scene()), hashOf(free.scene()));
}

TEST(WorkBudget, hashesAndStatesCountAPastThatIsNotSimulatedYet)
{
    Host free(0), bounded(5'000);
    for (Host* const host : {&free, &bounded})
        host->add(swirlPreset(3));
    free.update(kFrame);
    bounded.update(kFrame);
    EXPECT_EQ(statisticsOf(bounded.scene()).instancesWaking, 1u);
    EXPECT_EQ(simulationHashOf(bounded.scene()), simulationHashOf(free.scene()));
}

TEST(WorkBudget, seekingFarIsSpreadOverUpdates)
{
    Host free(0), bounded(20'000);
    const FxInstanceId there = free.add(swirlPreset(0)), id = bounded.add(swirlPreset(0));
    for (Host* const host : {&free, &bounded}) {
        host->update(kFrame);
        ASSERT_EQ(fxScene_SeekInstance(host->scene(), host == &free ? there : id, 5.0), FX_OK);
    }
    EXPECT_EQ(bounded.stateOf(id), FX_INSTANCE_WAKING);
    EXPECT_EQ(free.stateOf(there), FX_INSTANCE_ACTIVE);
    for (int i = 0; i < 400 && (i < 2 || bounded.stateOf(id) == FX_INSTANCE_WAKING); ++i) {
        free.update(kFrame);
        EXPECT_LE(bounded.update(kFrame).updateWork, 20'000u + 300 * 40);
    }
    EXPECT_EQ(bounded.stateOf(id), FX_INSTANCE_ACTIVE);
    EXPECT_EQ(simulationHashOf(bounded.scene()), simulationHashOf(free.scene()));
}

TEST(WorkBudget, whatTheHostDoesWhileAStepIsInHandHoldsFromItsEndOn)
{
    const Heavy& heavy = kHeavy[3];
    Host one(heavy.budget, 1), two(heavy.budget, 2);
    uint64_t hashes[2] = {};
    for (int h = 0; h < 2; ++h) {
        Host& host = h == 0 ? one : two;
        const FxInstanceId first = host.add(presetOf(heavy), 1), second = host.add(presetOf(heavy), 2);
        ASSERT_GT(host.update(kFrame).timeDebtTicks, 0);
        const double position[3] = {1, 2, 3};
        const float rotation[4] = {0, 0, 0, 1};
        EXPECT_EQ(fxScene_SetTransform(host.scene(), first, position, rotation, 1.0f), FX_OK);
        FxInstanceParameters parameters = fxDefaultInstanceParameters();
        parameters.intensity = 0.5f;
        parameters.wind[0] = 3.0f;
        EXPECT_EQ(fxScene_SetParameters(host.scene(), first, &parameters), FX_OK);
        EXPECT_EQ(fxScene_SetInstanceSpeed(host.scene(), first, 2.0f), FX_OK);
        EXPECT_EQ(fxScene_DestroyInstance(host.scene(), second), FX_OK);
        EXPECT_EQ(fxScene_DestroyInstance(host.scene(), second), FX_ERROR_STALE_ID);
        const FxInstanceId third = host.add(presetOf(heavy), 3);
        EXPECT_EQ(host.stateOf(third), FX_INSTANCE_DORMANT);
        EXPECT_EQ(fxScene_SeekInstance(host.scene(), first, 0.1), FX_OK);
        for (int i = 0; i < 6; ++i)
            host.update(kFrame);
        host.payDebt();
        EXPECT_EQ(host.stateOf(third), FX_INSTANCE_ACTIVE);
        EXPECT_EQ(statisticsOf(host.scene()).instances, 2u);
        hashes[h] = simulationHashOf(host.scene());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(WorkBudget, aStepInHandIsCompleteBeforeAStateIsSaved)
{
    const Heavy& heavy = kHeavy[3];
    Host host(heavy.budget), other(0), free(0);
    host.add(presetOf(heavy));
    free.add(presetOf(heavy));
    ASSERT_GT(host.update(kFrame).timeDebtTicks, 0);
    size_t size = 0;
    ASSERT_EQ(fxScene_SaveState(host.scene(), nullptr, 0, &size), FX_OK);
    std::vector<std::byte> state(size);
    ASSERT_EQ(fxScene_SaveState(host.scene(), state.data(), size, &size), FX_OK);
    EXPECT_EQ(statisticsOf(host.scene()).timeDebtTicks, 0);
    other.add(presetOf(heavy)); // so that the preset is known
    ASSERT_EQ(fxScene_RestoreState(other.scene(), state.data(), size), FX_OK);
    free.update(kFrame);
    EXPECT_EQ(simulationHashOf(host.scene()), simulationHashOf(free.scene()));
    for (int i = 0; i < 3; ++i) {
        host.update(kFrame);
        free.update(kFrame);
        other.update(kFrame);
    }
    host.payDebt();
    EXPECT_EQ(hashOf(host.scene()), hashOf(free.scene()));
    EXPECT_EQ(hashOf(other.scene()), hashOf(free.scene()));
}

TEST(WorkBudget, debtBeyondTheLongestAbsenceIsDroppedAndCounted)
{
    const Heavy& heavy = kHeavy[3];
    const int64_t longest = FX_TICKS_PER_SECOND / 10;
    Host host(heavy.budget, 1, longest);
    host.add(presetOf(heavy));
    FxSceneStatistics statistics = {};
    for (int i = 0; i < 60; ++i) {
        statistics = host.update(kFrame);
        EXPECT_LE(statistics.timeDebtTicks, longest);
    }
    EXPECT_GT(statistics.droppedTicks, 0);
    const int64_t all = 60 * (FX_TICKS_PER_SECOND / 60);
    EXPECT_EQ(statistics.simulatedTick + statistics.timeDebtTicks + statistics.droppedTicks, all);
}

TEST(WorkBudget, ordinaryScenesNeverMeetTheUsualOne)
{
    const FxSceneDef def = fxDefaultSceneDef();
    Host host(def.workBudget);
    for (uint64_t seed = 0; seed < 20; ++seed)
        host.add(swirlPreset(2), seed);
    for (int i = 0; i < 30; ++i) {
        const FxSceneStatistics statistics = host.update(kFrame);
        EXPECT_LT(statistics.updateWork, def.workBudget / 2);
        EXPECT_EQ(statistics.timeDebtTicks, 0);
        EXPECT_EQ(statistics.instancesWaking, 0u);
    }
}
