// What presets are expected to need, and what authors are told about it.
#include "fxsdk/presets/effect_cost.h"
#include "fxsdk/presets/preset_loader.h"
#include "simulation/emitters/emitter_def.h"

#include <gtest/gtest.h>

#include <memory_resource>
#include <ostream>
#include <string>

using namespace fx;
using preset::Diagnostic;

namespace {

/// Counts bytes in use.
class Meter final : public std::pmr::memory_resource
{
public:
    uint64_t bytes = 0;

private:
    void* do_allocate(size_t size, size_t alignment) override
    {
        bytes += size;
        return std::pmr::new_delete_resource()->allocate(size, alignment);
    }
    void do_deallocate(void* memory, size_t size, size_t alignment) override
    {
        bytes -= size;
        std::pmr::new_delete_resource()->deallocate(memory, size, alignment);
    }
    bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

/// `count` elements, with their number in the place of every '#' and the next in that of every '$'.
std::string listOf(int count, const std::string& element)
{
    std::string list;
    for (int i = 0; i < count; ++i)
        for (const char c : (i > 0 ? "," : "") + element)
            list += c == '#' ? std::to_string(i) : c == '$' ? std::to_string(i + 1) : std::string(1, c);
    return "[" + list + "]";
}

/// A preset that needs more than any machine has, and the position of its warning.
struct Endless
{
    const char* name;
    const char* list;
    int count;
    const char* element;
    const char* others; ///< members of the preset
    const char* pointer;
    const char* message; ///< part of it
};

void PrintTo(const Endless& endless, std::ostream* out)
{
    *out << endless.name;
}

// clang-format off: one case reads as one block
constexpr Endless kEndless[] = {
    {"rates", "emitters", 64, R"({"name":"e#","maxParticles":1048576,"lifetime":10,"emission":{"rate":1e8}})",
     "", "/emitters/0/emission/rate", "a step of 1/60 s is expected to take about"},
    {"memory", "emitters", 64, R"({"name":"e#","maxParticles":1048576,"lifetime":1,"emission":{"rate":100}})",
     "", "/emitters/0/maxParticles", "MiB of memory, 2 % of it here; lower maxParticles"},
    {"subSteps", "emitters", 1, R"({"maxParticles":200000,"lifetime":1,"emission":{"rate":2e5},
        "forces":{"drag":1,"curlStrength":1,"curlOctaves":2}})",
     R"("subSteps":16,)", "/subSteps", "lower subSteps"},
    {"turbulence", "emitters", 64,
     R"({"name":"e#","maxParticles":200000,"lifetime":0.2,"emission":{"rate":1e6},
        "forces":{"drag":1,"curlStrength":1,"curlOctaves":8}})",
     R"("subSteps":16,)", "/emitters/0/maxParticles",
     "of it here, so updates will not keep up; lower maxParticles"},
    {"fan", "emitters", 2,
     R"({"name":"e#","maxParticles":100000,"lifetime":1,"emission":{"rate":1e5},"events":[
        {"on":"age","age":0.0001,"every":0.004,"emit":"e$"},{"on":"age","age":0.0002,"every":0.004,"emit":"e$"},
        {"on":"age","age":0.0003,"every":0.004,"emit":"e$"},{"on":"age","age":0.0004,"every":0.004,"emit":"e$"},
        {"on":"age","age":0.0005,"every":0.004,"emit":"e$"},{"on":"age","age":0.0006,"every":0.004,"emit":"e$"}]})",
     R"("subSteps":16,)", "/emitters/1/events", "lower the counts of events"},
    {"prewarm", "emitters", 1, R"({"maxParticles":100000,"lifetime":10,"emission":{"rate":10000},
        "forces":{"drag":1,"curlStrength":1,"curlOctaves":8}})",
     R"("prewarm":3600,)", "/prewarm", "before an instance is seen; shorten it"},
    {"gas", "gas", 4, R"({"particles":20000,"soundSpeed":0,"pressureRatio":100,"material":"tnt"})", "",
     "/gas/0/soundSpeed", "give a soundSpeed above 0, or lower particles"},
    {"prewarmOfGas", "gas", 1, R"({"particles":2000})", R"("prewarm":3600,)", "/prewarm", "shorten it"},
    {"fragments", "fragments", 64,
     R"({"count":8192,"lifetime":3600,"trail":{"maxBlobs":200000,"lifetime":3600}})", "",
     "/fragments/0/trail/maxBlobs", "lower maxBlobs"},
};
// clang-format on

std::vector<Diagnostic> findingsOf(const Endless& endless)
{
    std::string list = listOf(endless.count, endless.element);
    const std::string dangling = "\"e" + std::to_string(endless.count) + "\"";
    for (size_t at = list.find(dangling); at != std::string::npos; at = list.find(dangling))
        list.replace(at, dangling.size(), "\"sink\"");
    if (std::string(endless.name) == "fan")
        list.insert(list.size() - 1, R"(,{"name":"sink","maxParticles":1,"lifetime":0.01})");
    std::vector<Diagnostic> found;
    const auto loaded =
        preset::loadPresetText(R"({"version":1,"duration":86400,)" + std::string(endless.others) + "\"" +
                                   endless.list + "\":" + list + "}",
                               "endless", &found);
    EXPECT_TRUE(loaded.ok()) << loaded.status().message();
    return found;
}

class EndlessPreset : public ::testing::TestWithParam<Endless>
{};

INSTANTIATE_TEST_SUITE_P(Each, EndlessPreset, ::testing::ValuesIn(kEndless),
                         [](const auto& each) { return std::string(each.param.name); });

} // namespace

TEST_P(EndlessPreset, isWarnedAboutWithTheMemberToChange)
{
    if (std::string(GetParam().list) == "gas" && !FXSDK_WITH_SPH)
        GTEST_SKIP() << "this build has no gases";
    std::string all;
    bool isTold = false;
    for (const Diagnostic& finding : findingsOf(GetParam())) {
        EXPECT_TRUE(finding.warning);
        all += preset::toString(finding) + "\n";
        isTold = isTold || (finding.pointer == GetParam().pointer &&
                            finding.message.find(GetParam().message) != std::string::npos);
    }
    EXPECT_TRUE(isTold) << all;
}

TEST(EffectCost, presetsOfTheLibraryNeedLittle)
{
    for (const base::EmbeddedText& text : preset::presetLibrary()) {
        if (!FXSDK_WITH_SPH && text.text.find("\"gas\"") != std::string_view::npos)
            continue;
        const auto loaded = preset::loadPresetText(text.text, std::string(text.name));
        ASSERT_TRUE(loaded.ok()) << text.name << ": " << loaded.status().message();
        const sim::EffectCost& cost = loaded->effect->cost;
        const bool moves = text.text.find("\"volumes\"") == std::string_view::npos;
        EXPECT_EQ(cost.stepWork > 0.0, moves) << text.name;
        EXPECT_LT(cost.stepWork, preset::kMuchStepWork) << text.name;
        EXPECT_LT(cost.startWork, preset::kMuchStartWork) << text.name;
        EXPECT_LT(cost.memory, preset::kMuchMemory) << text.name;
        EXPECT_GE(cost.memory, loaded->effect->bytes()) << text.name;
    }
}

TEST(EffectCost, bytesOfGasesAndFragmentsAreAboutThoseThatAreTaken)
{
    base::SnapshotSchema schema;
    for (const std::string parts : {R"("gas":[{"particles":3000}])", R"("gas":[{"particles":20000}])",
                                    R"("fragments":[{"count":8000,"trail":{"maxBlobs":1}}])"})
    {
        if (parts.starts_with("\"gas\"") && !FXSDK_WITH_SPH)
            continue;
        const auto loaded = preset::loadPresetText(R"({"version":1,"duration":5,)" + parts + "}", "p");
        ASSERT_TRUE(loaded.ok()) << loaded.status().message();
        Meter meter;
        const auto solver = loaded->effect->solvers[0]->create(schema, {}, &meter);
        const double told = double(loaded->effect->bytes());
        EXPECT_GT(told, 0.75 * double(meter.bytes)) << parts << ": " << told << " of " << meter.bytes;
        EXPECT_LT(told, 3.0 * double(meter.bytes)) << parts << ": " << told << " of " << meter.bytes;
    }
}
