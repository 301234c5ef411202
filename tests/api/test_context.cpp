#include "tests/api/api_fixture.h"

#include <cstring>
#include <string>
#include <vector>

using fx::test::fountainPreset;
using fx::test::HostAllocator;
using ContextApi = fx::test::ApiTest;

namespace {

std::vector<FxResult> loggedErrors;

void collectErrors(void*, FxLogLevel level, FxResult code, const char*)
{
    if (level == FX_LOG_ERROR)
        loggedErrors.push_back(code);
}

/// Fails within the log of another failure.
void failAgain(void* user, FxLogLevel, FxResult, const char*)
{
    static_cast<void>(fxScene_Update(static_cast<FxScene*>(user), 0.0));
}

void* noGlFunction(void*, const char*)
{
    return nullptr;
}

} // namespace

TEST(BaseApi, theLibraryIsThatOfTheHeader)
{
    EXPECT_EQ(fxGetVersion(), uint32_t(FX_VERSION));
}

TEST(BaseApi, everyResultHasAName)
{
    EXPECT_STREQ(fxResultName(FX_OK), "ok");
    for (int code = FX_ERROR_INTERRUPTED; code <= FX_ERROR_INVALID_ARGUMENT; ++code)
        EXPECT_STRNE(fxResultName(FxResult(code)), "unknown") << code;
    EXPECT_STRNE(fxResultName(FX_ERROR_INTERNAL), "unknown");
    EXPECT_STREQ(fxResultName(FxResult(12345)), "unknown");
}

TEST(BaseApi, aMessageNamesFunctionAndArgument)
{
    ASSERT_EQ(fxCreateContext(nullptr, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_STREQ(fxGetLastErrorMessage(), "fxCreateContext: outContext is null");
}

TEST(CreateContext, whatIsWrongInTheDefinitionIsRefusedAndTheOutputStays)
{
    const auto refused = [](void (*spoil)(FxContextDef&)) {
        FxContextDef def = fxDefaultContextDef();
        spoil(def);
        FxContext* context = reinterpret_cast<FxContext*>(uintptr_t(8));
        const FxResult result = fxCreateContext(&def, &context);
        EXPECT_EQ(context, reinterpret_cast<FxContext*>(uintptr_t(8)));
        return result;
    };
    FxContext* context = nullptr;
    EXPECT_EQ(fxCreateContext(nullptr, &context), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(refused([](FxContextDef& def) { def.structSize = 0; }), FX_ERROR_VERSION);
    EXPECT_EQ(refused([](FxContextDef& def) { def.headerVersion += 65536; }), FX_ERROR_VERSION);
    EXPECT_EQ(refused([](FxContextDef& def) { def.flags = 2; }), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(refused([](FxContextDef& def) { def.workers = 257; }), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(refused([](FxContextDef& def) {
                  def.allocator.allocate = [](void*, size_t, size_t) -> void* { return nullptr; };
              }),
              FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(refused([](FxContextDef& def) {
                  def.assets.open = [](void*, const char*, size_t*) -> const void* { return nullptr; };
              }),
              FX_ERROR_INVALID_ARGUMENT);
}

TEST(CreateContext, aLoaderThatKnowsNothingIsRefusedAndEverythingIsGivenBack)
{
    HostAllocator memory;
    FxContextDef def = fxDefaultContextDef();
    def.allocator = memory.hooks();
    def.gl.getProcAddress = &noGlFunction;
    FxContext* context = nullptr;
    EXPECT_EQ(fxCreateContext(&def, &context), FX_ERROR_GL_UNSUPPORTED);
    EXPECT_NE(std::strstr(fxGetLastErrorMessage(), "gl"), nullptr) << fxGetLastErrorMessage();
    EXPECT_EQ(context, nullptr);
    EXPECT_EQ(memory.blocks(), 0);
}

TEST(CreateContext, whatItTookFromTheHostItGivesBackWithEverythingInIt)
{
    HostAllocator memory;
    FxContextDef def = fxDefaultContextDef();
    def.allocator = memory.hooks();
    FxContext* context = nullptr;
    ASSERT_EQ(fxCreateContext(&def, &context), FX_OK);
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    FxScene* scene = nullptr;
    ASSERT_EQ(fxCreateScene(context, &sceneDef, &scene), FX_OK);
    FxInstanceDef instance = fxDefaultInstanceDef();
    instance.preset = fx::test::loadText(context, fountainPreset());
    FxInstanceId id;
    ASSERT_EQ(fxScene_CreateInstance(scene, &instance, &id), FX_OK);
    ASSERT_EQ(fxScene_Update(scene, fx::test::kFrame), FX_OK);
    EXPECT_GT(memory.blocks(), 0);
    ASSERT_EQ(fxDestroyContext(context), FX_OK);
    EXPECT_EQ(memory.blocks(), 0);
    EXPECT_EQ(memory.bytes(), 0);
}

TEST(CreateContext, destroyingNothingIsAllowed)
{
    EXPECT_EQ(fxDestroyContext(nullptr), FX_OK);
}

TEST_F(ContextApi, withoutGlNothingOfGlWorks)
{
    EXPECT_EQ(fxContext_WarmUp(context_), FX_ERROR_NO_GL);
    EXPECT_EQ(fxContext_AdoptGlThread(context_), FX_ERROR_NO_GL);
    FxView* view = nullptr;
    EXPECT_EQ(fxCreateView(context_, scene_, nullptr, &view), FX_ERROR_NO_GL);
    EXPECT_EQ(view, nullptr);
    EXPECT_EQ(fxContext_WarmUp(nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxContext_AdoptGlThread(nullptr), FX_ERROR_INVALID_ARGUMENT);
}

TEST_F(ContextApi, theCountersTellWhatThereIs)
{
    FxMemoryStats stats{};
    EXPECT_EQ(fxContext_GetMemoryStats(context_, &stats), FX_ERROR_VERSION); // structSize is not set
    EXPECT_EQ(fxContext_GetMemoryStats(context_, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxContext_GetMemoryStats(nullptr, &stats), FX_ERROR_INVALID_ARGUMENT);
    stats.structSize = sizeof stats;
    ASSERT_EQ(fxContext_GetMemoryStats(context_, &stats), FX_OK);
    EXPECT_EQ(stats.presets, 1u);
    EXPECT_EQ(stats.scenes, 1u);
    EXPECT_EQ(stats.views, 0u);
    EXPECT_GT(stats.bytesInUse, 0u);
    EXPECT_GT(stats.allocationCount, 0u);
}

TEST(Log, aCallbackThatFailsLeavesTheMessageOfTheCallThatIsReported)
{
    FxContextDef def = fxDefaultContextDef();
    def.log.write = &failAgain; // updates no scene
    FxContext* context = nullptr;
    ASSERT_EQ(fxCreateContext(&def, &context), FX_OK);
    EXPECT_EQ(fxUnloadPreset(context, FxPresetId{5}), FX_ERROR_STALE_ID);
    EXPECT_EQ(std::strncmp(fxGetLastErrorMessage(), "fxUnloadPreset: ", 16), 0) << fxGetLastErrorMessage();
    EXPECT_EQ(fxDestroyContext(context), FX_OK);
}

TEST(Log, aFailureIsReportedToTheHostOfTheObject)
{
    loggedErrors.clear();
    FxContextDef def = fxDefaultContextDef();
    def.log.write = &collectErrors;
    FxContext* context = nullptr;
    ASSERT_EQ(fxCreateContext(&def, &context), FX_OK);
    EXPECT_EQ(fxUnloadPreset(context, FxPresetId{5}), FX_ERROR_STALE_ID);
    EXPECT_EQ(loggedErrors, std::vector<FxResult>{FX_ERROR_STALE_ID});
    EXPECT_EQ(fxDestroyContext(context), FX_OK);
    EXPECT_EQ(loggedErrors.size(), 1u);
}

TEST(Log, anUpdateThatIsShortenedIsSaidOnce)
{
    static std::vector<std::string> warnings;
    warnings.clear();
    FxContextDef def = fxDefaultContextDef();
    def.log.write = [](void*, FxLogLevel level, FxResult, const char* message) {
        if (level == FX_LOG_WARNING)
            warnings.emplace_back(message);
    };
    FxContext* context = nullptr;
    ASSERT_EQ(fxCreateContext(&def, &context), FX_OK);
    FxScene* scene = nullptr;
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    ASSERT_EQ(fxCreateScene(context, &sceneDef, &scene), FX_OK);
    EXPECT_EQ(fxScene_Update(scene, 1.0 / 60.0), FX_OK);
    EXPECT_TRUE(warnings.empty());
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(fxScene_Update(scene, 5.0), FX_OK);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("5.000000 s was shortened to 0.066667 s"), std::string::npos) << warnings[0];
    EXPECT_EQ(fxDestroyContext(context), FX_OK);
}
