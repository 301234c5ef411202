#include "fxsdk/scene_file/scene_file.h"
#include "fxsdk/scene_file/validate_file.h"
#include "tests/presets/temp_folder.h"

#include <ostream>
#include <sys/resource.h>

using namespace fx::preset;
using fx::test::TempFolder;

namespace {

struct Broken
{
    const char* name;
    const char* members; ///< after "version" and "camera"
    const char* pointer;
    const char* message;
};

void PrintTo(const Broken& broken, std::ostream* out)
{
    *out << broken.name;
}

constexpr Broken kBroken[] = {
    {"absoluteMesh", "\"mesh\":{\"file\":\"/etc/passwd\"}", "/mesh/file", "an absolute path"},
    {"meshAboveTheFolder", "\"mesh\":{\"file\":\"../m.obj\"}", "/mesh/file", "\"..\" leads out"},
    {"missingMesh", "\"mesh\":{\"file\":\"none.obj\"}", "/mesh/file", "does not exist"},
    {"missingImage", "\"background\":{\"image\":\"none.png\"}", "/background/image", "does not exist"},
    {"imageThatIsNone", "\"background\":{\"image\":\"text.png\"}", "/background/image", "PNG"},
    {"hdrThatIsNone", "\"background\":{\"image\":\"text.hdr\"}", "/background/image", "Radiance"},
    {"absolutePreset", "\"instances\":[{\"preset\":\"/x.fx.json\"}]", "/instances/0/preset",
     "an absolute path"},
    {"presetAboveTheFolder", "\"instances\":[{\"preset\":\"a/../../x.fx.json\"}]", "/instances/0/preset",
     "\"..\" leads out"},
    {"unknownLibraryPreset", "\"instances\":[{\"preset\":\"library:explosoin\"}]", "/instances/0/preset",
     "it holds: artillery-dirt ash-plume"},
    {"brokenPreset", "\"instances\":[{\"preset\":\"broken.fx.json\"}]", "/instances/0/preset",
     "broken.fx.json:1:25: /duration"},
    {"missingPresetMember", "\"instances\":[{}]", "/instances/0", "\"preset\" is missing"},
    {"unknownMember", "\"instances\":[{\"preset\":\"library:steam\",\"positon\":[0,0,0]}]",
     "/instances/0/positon", "did you mean \"position\"?"},
    {"twoRotations",
     "\"instances\":[{\"preset\":\"library:steam\",\"rotationDegrees\":[0,0,0],\"quaternion\":[0,0,0,1]}]",
     "/instances/0/quaternion", "one of them"},
    {"zeroQuaternion", "\"instances\":[{\"preset\":\"library:steam\",\"quaternion\":[0,0,0,0]}]",
     "/instances/0/quaternion", "length 0"},
    {"zeroSun", "\"lighting\":{\"sunDirection\":[0,0,0]}", "/lighting/sunDirection", "length 0"},
    {"glareThatFalls", "\"dazzle\":{\"a\":1,\"b\":8}", "/dazzle/b", "not monotone"},
    {"glareBelowZero", "\"dazzle\":{\"a\":1,\"b\":-2}", "/dazzle/b", "not monotone"},
    {"unknownForm", "\"form\":\"cube\"", "/form", "one of \"planar\", \"constant\", \"kernel\""},
};

constexpr const char* kBrokenCameras[] = {
    R"({"position":[1,1,1],"target":[1,1,1]})",
    R"({"position":[0,0,0],"target":[0,5,0]})",
    R"({"up":[0,0,0]})",
    R"({"fovYDegrees":50,"orthographicHeight":5})",
    R"({"keys":[{"time":1,"position":[0,0,0],"target":[1,0,0]},{"time":1,"position":[0,0,0],"target":[1,0,0]}]})",
};

std::vector<Diagnostic> validate(const TempFolder& folder, const std::string& text)
{
    folder.write("text.png", "this is not a picture");
    folder.write("text.hdr", "this is not a picture");
    folder.write("broken.fx.json", "{\"version\":1,\"duration\":-1}");
    return validateFile(folder.write("s.scene.json", text));
}

/// Most memory that this process has had; 0 under sanitizers, whose own memory would count.
long peakMegabytes()
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    return 0;
#else
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;
#endif
}

} // namespace

class BrokenScene : public ::testing::TestWithParam<Broken>
{};

INSTANTIATE_TEST_SUITE_P(Each, BrokenScene, ::testing::ValuesIn(kBroken),
                         [](const auto& each) { return std::string(each.param.name); });

TEST_P(BrokenScene, isRefusedWithLinePointerAndRemedy)
{
    const TempFolder folder;
    const std::string text = std::string("{\"version\":1,\"camera\":{},\n") + GetParam().members + "}";
    const std::vector<Diagnostic> diagnostics = validate(folder, text);
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].line, 2);
    EXPECT_EQ(diagnostics[0].pointer, GetParam().pointer) << diagnostics[0].message;
    EXPECT_NE(diagnostics[0].message.find(GetParam().message), std::string::npos) << diagnostics[0].message;
}

TEST(BrokenScenes, camerasThatSeeNothingAreRefused)
{
    const TempFolder folder;
    for (const char* camera : kBrokenCameras) {
        const auto diagnostics = validate(folder, std::string("{\"version\":1,\"camera\":") + camera + "}");
        ASSERT_EQ(diagnostics.size(), 1u) << camera;
        EXPECT_EQ(diagnostics[0].pointer.substr(0, 7), "/camera");
    }
}

TEST(BrokenScenes, aPresetThatIsMissingIsReportedOnceForAllItsInstances)
{
    const TempFolder folder;
    std::string text = "{\"version\":1,\"camera\":{},\"instances\":[";
    for (int i = 0; i < 500; ++i)
        text += "{\"preset\":\"none.fx.json\"},";
    text.back() = ']';
    EXPECT_EQ(validate(folder, text + "}").size(), 1u);
}

TEST(BrokenScenes, aFileOfAnotherKindIsToldWhatIsKnown)
{
    const TempFolder folder;
    const auto diagnostics = validateFile(folder.write("a.json", "{}"));
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_NE(diagnostics[0].message.find(".scene.json"), std::string::npos);
}

TEST(BrokenScenes, floodsOfErrorsTakeLittleMemory)
{
    const TempFolder folder;
    std::string text = "{\"version\":1,\"camera\":{},\"instances\":[";
    const std::string bad =
        "{\"preset\":1,\"position\":[\"a\",\"b\",\"c\"],\"wind\":{\"a\":1,\"b\":2},\"scale\":\"s\"},";
    for (int i = 0; i < 16'000; ++i)
        text += bad;
    text.back() = ']';
    const auto diagnostics = validate(folder, text + "}");
    EXPECT_EQ(diagnostics.size(), 100u);
    EXPECT_LT(peakMegabytes(), 200);
}

TEST(BrokenScenes, theLargestTextThatIsReadTakesLittleMemory)
{
    const TempFolder folder;
    const std::string path = folder.write("s.scene.json", "{\"version\":1,\"camera\":{},\"instances\":[");
    {
        std::ofstream file(path, std::ios::app); // in pieces: this test must not need the memory itself
        for (size_t bytes = 0; bytes < (size_t(63) << 20); bytes += 24)
            file << "[{\"a\":{\"b\":1}},{\"a\":2}],";
        file << "0]}";
    }
    EXPECT_FALSE(validateFile(path).empty());
    EXPECT_LT(peakMegabytes(), 200);
}
