// Warnings about what is valid and does nothing: each is given with its place, and goes away with its remedy.
#include "fxsdk/presets/preset_loader.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/gpu_programs/gpu_program.h"
#include "tests/presets/small_png.h"
#include "tests/presets/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory_resource>
#include <ostream>
#include <string>

using namespace fx;
using preset::Diagnostic;

namespace {

/// Members of an emitter that do nothing, what their author is told, and the members of one that does
/// something.
struct Vain
{
    const char* name;
    const char* members;
    const char* pointer; ///< below the emitter
    const char* message; ///< part of it
    const char* mended;
};

void PrintTo(const Vain& vain, std::ostream* out)
{
    *out << vain.name;
}

// clang-format off: one case reads as one block
constexpr Vain kVain[] = {
    {"wind", R"("forces":{"wind":[1,0,0]})", "/forces/wind", "add \"drag\"",
     R"("forces":{"wind":[1,0,0],"drag":1})"},
    {"gust", R"("forces":{"gust":[1,0,0]})", "/forces/gust", "add \"drag\"",
     R"("forces":{"gust":[1,0,0],"quadraticDrag":1})"},
    {"curl", R"("forces":{"curlStrength":1})", "/forces/curlStrength", "add \"drag\"",
     R"("forces":{"curlStrength":1,"drag":1})"},
    {"vortex", R"("forces":{"vortices":[{"radius":1,"speed":2}]})", "/forces/vortices/0", "add \"drag\"",
     R"("forces":{"vortices":[{"radius":1,"speed":2,"hold":1}]})"},
    {"friction", R"("forces":{"friction":0.5})", "/forces/friction", "add \"bounce\"",
     R"("forces":{"friction":0.5,"bounce":0})"},
    {"groundTwice", R"("forces":{"bounce":0.3},"collisions":[{"shape":"ground"}])", "/forces/bounce",
     "no effect on the ground", R"("collisions":[{"shape":"ground","bounce":0.3}])"},
    {"sphereOfNoSize", R"("collisions":[{"shape":"sphere","size":0}])", "/collisions/0/size", "size above 0",
     R"("collisions":[{"shape":"sphere","size":0,"margin":0.1}])"},
    {"tube", R"("shape":"sphere","size":1,"tube":0.2)", "/tube", "it is for \"torus\"",
     R"("shape":"torus","size":1,"tube":0.2)"},
    {"points", R"("shape":"sphere","size":1,"points":[[0,0,0],[1,0,0]])", "/points", "it is for \"spline\"",
     R"("shape":"spline","points":[[0,0,0],[1,0,0]])"},
    {"sizeOfAPoint", R"("size":1)", "/size", "shape \"point\"", R"("shape":"box","size":1)"},
    {"splineOfOnePlace", R"("shape":"spline","points":[[0,1,0],[0,1,0]])", "/points", "are the same",
     R"("shape":"spline","points":[[0,1,0],[0,2,0]])"},
    {"stretch", R"("appearance":{"kind":"sprite","stretch":1})", "/appearance/stretch",
     "\"alignment\": \"velocity\"", R"("appearance":{"kind":"sprite","stretch":1,"alignment":"velocity"})"},
    {"overSpeed", R"("appearance":{"kind":"sprite","colorOverSpeed":[1,0,0]})", "/appearance/colorOverSpeed",
     "\"fastest\"", R"("appearance":{"kind":"sprite","colorOverSpeed":[1,0,0],"fastest":3})"},
    {"frames", R"("appearance":{"kind":"sprite","frames":"over-life"})", "/appearance/frames", "\"texture\"",
     R"("appearance":{"kind":"sprite","frames":"over-life","texture":"dot.png"})"},
    {"framesOfNoRate", R"("appearance":{"kind":"sprite","frames":"per-second","texture":"dot.png"})",
     "/appearance/frames", "\"framesPerSecond\"",
     R"("appearance":{"kind":"sprite","frames":"per-second","framesPerSecond":5,"texture":"dot.png"})"},
    {"textureOfAMedium", R"("appearance":{"texture":"dot.png"})", "/appearance/texture",
     "add \"kind\": \"sprite\"", R"("appearance":{"texture":"dot.png","kind":"sprite"})"},
    {"mediumOfASprite", R"("appearance":{"kind":"sprite"},"detailAmount":1)", "/detailAmount",
     "kind \"sprite\"", R"("detailAmount":1)"},
    {"nothingSeen", R"("appearance":{"kind":"none"})", "/appearance/kind", "nothing of this emitter",
     R"("appearance":{"kind":"none"},"trail":{"lifetime":1})"},
    {"darkLight", R"("appearance":{"kind":"none"},"light":{"intensity":0})", "/light", "add \"intensity\"",
     R"("appearance":{"kind":"none"},"light":{"intensity":2})"},
    {"darkMedium", R"("light":{})", "/light", "\"emissionOverLife\"",
     R"("light":{},"emissionOverLife":[1,1,1])"},
    {"collisionOfNothing", R"("events":[{"on":"collision","emit":"b"}])", "/events/0/on", "\"collisions\"",
     R"("events":[{"on":"collision","emit":"b"}],"forces":{"bounce":0.5})"},
    {"capacity", R"("maxParticles":5)", "/maxParticles", "up to 10 particles", R"("maxParticles":10)"},
};
// clang-format on

/// The warnings of a preset of one emitter with these members and one that events may feed.
std::vector<Diagnostic> warningsOf(const std::string& members)
{
    const test::TempFolder folder;
    folder.write("dot.png", test::smallPng());
    const bool feeds = members.find("\"emit\"") != std::string::npos;
    const std::string path = folder.write(
        "probe.fx.json", "{\"version\":1,\"emitters\":[{\"name\":\"a\",\"emission\":{\"rate\":10},\n" +
                             members + "}" + (feeds ? ",{\"name\":\"b\"}" : "") + "]}");
    std::vector<Diagnostic> found;
    const auto loaded = preset::loadPresetFile(path, &found);
    EXPECT_TRUE(loaded.ok()) << loaded.status().message();
    return found;
}

base::Result<preset::LoadedPreset> load(const std::string& emitters)
{
    return preset::loadPresetText("{\"version\":1,\"emitters\":[" + emitters + "]}", "probe");
}

/// Counts what is taken.
class Meter : public std::pmr::memory_resource
{
public:
    uint64_t bytes = 0;

private:
    void* do_allocate(size_t size, size_t alignment) override
    {
        bytes += size;
        return std::pmr::new_delete_resource()->allocate(size, alignment);
    }
    void do_deallocate(void* p, size_t size, size_t alignment) override
    {
        std::pmr::new_delete_resource()->deallocate(p, size, alignment);
    }
    bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

} // namespace

class VainMember : public ::testing::TestWithParam<Vain>
{};

INSTANTIATE_TEST_SUITE_P(Each, VainMember, ::testing::ValuesIn(kVain),
                         [](const auto& each) { return std::string(each.param.name); });

TEST_P(VainMember, isWarnedAboutWithPlaceAndRemedyAndTheRemedyHelps)
{
    const std::vector<Diagnostic> found = warningsOf(GetParam().members);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_TRUE(found[0].warning);
    EXPECT_EQ(found[0].line, 2) << found[0].message;
    EXPECT_EQ(found[0].pointer, std::string("/emitters/0") + GetParam().pointer) << found[0].message;
    EXPECT_NE(found[0].message.find(GetParam().message), std::string::npos) << found[0].message;
    for (const Diagnostic& left : warningsOf(GetParam().mended))
        ADD_FAILURE() << toString(left);
}

TEST(EmitterLint, windOfTheEffectNeedsDragSomewhere)
{
    const auto warnings = [](const std::string& forces) {
        const auto loaded = preset::loadPresetText(
            R"({"version":1,"wind":[1,0,0],"emitters":[{"emission":{"rate":1},"forces":{)" + forces + "}}]}",
            "p");
        return loaded.ok() ? loaded->warnings.size() : 99;
    };
    EXPECT_EQ(warnings(""), 1u);
    EXPECT_EQ(warnings(R"("drag":1)"), 0u);
}

TEST(EmitterLint, whatTheGpuCannotComputeIsToldWithTheReason)
{
    sim::EmitterDef any;
    any.compute = sim::ComputeOn::Gpu;
    any.appearance.kind = sim::AppearanceKind::Sprite;
    if (!sim::gpuObstacle(any).empty())
        GTEST_SKIP() << "this build computes no particles on the GPU";
    const std::vector<Diagnostic> found = warningsOf(R"("compute":"gpu","appearance":{"kind":"medium"})");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].pointer, "/emitters/0/compute");
    EXPECT_NE(found[0].message.find("media are lit on the CPU"), std::string::npos) << found[0].message;
    EXPECT_TRUE(warningsOf(R"("compute":"gpu","appearance":{"kind":"sprite"})").empty());
    EXPECT_TRUE(warningsOf(R"("compute":"auto","appearance":{"kind":"medium"})").empty());
}

TEST(EmitterLint, capacityCountsWhatEventsGiveBirthTo)
{
    const std::string cause = R"({"name":"a","emission":{"rate":1000},"maxParticles":2000,"events":[
        {"on":"death","emit":"b","count":100}]})"; // 100000 births a second that live for 5 s
    const auto few = load(cause + R"(,{"name":"b","lifetime":5,"maxParticles":5})");
    ASSERT_TRUE(few.ok()) << few.status().message();
    ASSERT_EQ(few->warnings.size(), 1u);
    EXPECT_EQ(few->warnings[0].pointer, "/emitters/1/maxParticles");
    EXPECT_NE(few->warnings[0].message.find("about 500000 particles"), std::string::npos)
        << few->warnings[0].message;
    EXPECT_TRUE(load(cause + R"(,{"name":"b","lifetime":5,"maxParticles":500000})")->warnings.empty());
}

/// So many emitters, each of which causes births in the next one through so many rules.
std::string chainOf(int emitters, int rules)
{
    std::string text;
    for (int i = 0; i < emitters; ++i) {
        text += std::string(i > 0 ? "," : "") + R"({"name":"e)" + std::to_string(i) +
                R"(","maxParticles":1,"lifetime":)" + std::to_string(0.1 + 0.001 * i);
        text += i == 0 ? R"(,"emission":{"rate":1})" : "";
        for (int k = 0; k < rules && i + 1 < emitters; ++k)
            text += std::string(k == 0 ? R"(,"events":[)" : ",") +
                    R"({"on":"age","age":0.01,"every":0.01,"emit":"e)" + std::to_string(i + 1) + "\"}";
        text += i + 1 < emitters ? "]}" : "}";
    }
    return text;
}

TEST(EmitterLint, longChainsOfManyRulesAreCountedOnceAnEmitter)
{
    // 32^63 ways lead to the last emitter: following each of them would never end.
    const auto loaded = load(chainOf(64, 32));
    ASSERT_TRUE(loaded.ok()) << loaded.status().message();
    EXPECT_EQ(loaded->effect->solvers.size(), 64u);
    EXPECT_EQ(loaded->warnings.size(), 64u - 1u); // all but the first have room for too few
}

TEST(EmitterLint, aCapacityIsTooSmallForMoreThanItsOwnNumber)
{
    const auto warningsOfCapacity = [](double rate, double lifetime, int capacity) {
        return load(R"({"maxParticles":)" + std::to_string(capacity) + R"(,"emission":{"rate":)" +
                    std::to_string(rate) + R"(},"lifetime":)" + std::to_string(lifetime) + "}")
            ->warnings;
    };
    EXPECT_TRUE(warningsOfCapacity(10, 1.1, 11).empty()); // 1.1 is a little more as a float
    EXPECT_TRUE(warningsOfCapacity(125000, 1.6, 200000).empty());
    for (const double rate : {3.3, 10.0, 625.0, 40000.0})
        for (const double lifetime : {0.3, 0.7, 1.1, 1.6, 5.0})
            for (int less = -1; less <= 2; ++less) {
                const int capacity = std::max(int(rate * lifetime) - less, 1);
                for (const Diagnostic& warning : warningsOfCapacity(rate, lifetime, capacity)) {
                    const std::string text = warning.message.substr(warning.message.find("up to ") + 6);
                    EXPECT_GT(std::stoi(text), capacity) << warning.message;
                }
            }
}

TEST(EmitterLint, repeatedEventsCountNoMoreThanThoseWhoLiveCanCause)
{
    const auto warnings = [](const std::string& capacity) { // 10 that puff every 0.1 s, for 1 s each: 10 * 11
        return load(R"({"emission":{"bursts":[{"time":0,"count":10}]},"lifetime":5,"events":[
            {"on":"age","age":0.1,"every":0.1,"emit":"b"}]},{"name":"b","maxParticles":)" +
                    capacity + "}")
            ->warnings.size();
    };
    EXPECT_EQ(warnings("110"), 0u);
    EXPECT_EQ(warnings("105"), 1u);
}

TEST(EmitterLint, aLostTargetIsTheOnlyError)
{
    const std::string b = R"(,{"name":"b"})";
    for (const std::string& rest : {R"("c"}]})" + b, R"("b"}]})" + b + b, R"("a"}]})" + b}) {
        std::vector<Diagnostic> found;
        static_cast<void>(preset::loadPresetText(
            R"({"version":1,"emitters":[{"name":"a","emission":{"rate":1},"events":[{"on":"death","emit":)" +
                rest + "]}",
            "probe", &found));
        EXPECT_EQ(found.size(), 1u) << rest;
    }
}

TEST(EmitterLint, theBytesThatAreToldAreThoseThatAreTaken)
{
    base::SnapshotSchema schema;
    for (const std::string members :
         {R"("maxParticles":5000,"appearance":{"kind":"sprite"})",
          R"("maxParticles":700,"trail":{"lifetime":1,"maxPoints":20},"light":{})",
          R"("maxParticles":3000,"forces":{"drag":1,"curlStrength":1})"})
    {
        const auto loaded = load(R"({"emission":{"rate":1},)" + members + "}");
        ASSERT_TRUE(loaded.ok()) << loaded.status().message();
        Meter meter;
        const auto solver = loaded->effect->solvers[0]->create(schema, {}, &meter);
        const double told = double(loaded->effect->bytes());
        EXPECT_NEAR(told / double(meter.bytes), 1.0, 0.01)
            << members << ": " << told << " of " << meter.bytes;
    }
}

TEST(EmitterLint, muchMemoryIsWarnedAbout)
{
    const auto loaded =
        load(R"({"emission":{"rate":1},"maxParticles":16777216,"trail":{"lifetime":1,"maxPoints":256}})");
    ASSERT_TRUE(loaded.ok()) << loaded.status().message();
    ASSERT_EQ(loaded->warnings.size(), 1u);
    EXPECT_NE(loaded->warnings[0].message.find("MiB of memory"), std::string::npos)
        << loaded->warnings[0].message;
}

TEST(EmitterLint, misspeltChoicesAndMissingFilesAreExplained)
{
    const auto messageOf = [](const std::string& members) {
        return load(R"({"emission":{"rate":1},)" + members + "}").status().message();
    };
    EXPECT_NE(messageOf(R"("shape":"spere")").find("did you mean \"sphere\"?"), std::string::npos);
    EXPECT_NE(messageOf(R"("shape":"mesh")").find("\"file\": \"stone.obj\""), std::string::npos);
    EXPECT_NE(messageOf(R"("shape":"volume")").find("(*.fxgrid) of 1 channel"), std::string::npos);
    EXPECT_NE(messageOf(R"("forces":{"vectorFields":[{"file":"a.fxgrid"}]})").find("a.fxgrid"),
              std::string::npos);
}

TEST(EmitterLint, brokenMeshesAndGridsAreNamed)
{
    const test::TempFolder folder;
    folder.write("bad.obj", "v 0 0\n");
    folder.write("bad.fxgrid", "vdb");
    const auto messageOf = [&](const std::string& members) {
        const std::string path = folder.write(
            "probe.fx.json", "{\"version\":1,\"emitters\":[{\"emission\":{\"rate\":1}," + members + "}]}");
        return preset::loadPresetFile(path).status().message();
    };
    const std::string mesh = messageOf(R"("shape":"mesh","file":"bad.obj")");
    EXPECT_NE(mesh.find("asset \"bad.obj\": line 1"), std::string::npos) << mesh;
    const std::string grid = messageOf(R"("shape":"volume","file":"bad.fxgrid")");
    EXPECT_NE(grid.find("asset \"bad.fxgrid\": byte 0"), std::string::npos) << grid;
    EXPECT_NE(grid.find("docs/howto/grids.md"), std::string::npos) << grid;
}
