// Each call of OpenGL that can fail fails once: a frame is drawn, or the picture is the host's, nothing
// leaks, and the next frame is drawn.
#include "tests/api/fault_table.h"
#include "tests/api/gl_faults.h"
#include "tests/api/view_fixture.h"
#include "tests/rendering/gl/gl_host_state.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace {

using fx::render::GlProbe;
using fx::test::FaultRow;
using Objects = std::map<std::string, int>;

float largestDifference(const std::vector<float>& a, const std::vector<float>& b)
{
    float most = 0.0f;
    for (size_t i = 0; i < a.size(); ++i)
        most = std::max(most, std::abs(a[i] - b[i]));
    return most;
}

class GlFaultSweep : public fx::test::ViewApiTest
{
protected:
    GlFaultSweep() : faults_(gl_->loader()), states_(gl_->loader()) {}

    FxContext* makeContext()
    {
        FxContextDef def = fxDefaultContextDef();
        def.workers = 1;
        def.allocator = blocks_.hooks();
        def.gl = faults_.hooks();
        FxContext* context = nullptr;
        const FxResult result = fxCreateContext(&def, &context);
        EXPECT_EQ(result == FX_OK, context != nullptr);
        return context;
    }
    FxScene* makeScene(FxContext* context, std::initializer_list<const char*> presets)
    {
        FxScene* scene = nullptr;
        const FxSceneDef def = fxDefaultSceneDef();
        EXPECT_EQ(fxCreateScene(context, &def, &scene), FX_OK);
        for (const char* preset : presets) {
            FxInstanceDef instance = fxDefaultInstanceDef();
            EXPECT_EQ(fxLoadPresetLibrary(context, preset, &instance.preset), FX_OK);
            FxInstanceId id{};
            EXPECT_EQ(fxScene_CreateInstance(scene, &instance, &id), FX_OK);
        }
        for (int i = 0; i < 20; ++i)
            EXPECT_EQ(fxScene_Update(scene, fx::test::kFrame), FX_OK);
        return scene;
    }
    FxViewSettings settings() const
    {
        FxViewSettings all = fxDefaultViewSettings();
        for (int i = 0; i < 3; ++i) {
            all.sunIlluminance[i] = 60'000.0f;
            all.skyLuminance[i] = 4'000.0f;
        }
        all.composition = FX_COMPOSITION_AUTOMATIC;
        return all;
    }
    /// A view that has not drawn yet draws; with a fault at call `n`, then without.
    /// @return false: there were fewer calls that can fail
    bool drawWithFault(FxContext* context, FxScene* scene, uint64_t n, bool ofCompilers)
    {
        SCOPED_TRACE("call " + std::to_string(n));
        const FxViewSettings all = settings();
        const FxFrameDef def = frame();
        fillPicture();
        const uint64_t hash = hashOf(scene);
        const GlProbe before = states_.probe();
        faults_.failAt(n, ofCompilers);
        FxView* view = nullptr;
        FxResult result = fxCreateView(context, scene, &all, &view);
        if (result == FX_OK)
            result = fxView_Render(view, &def);
        const std::string failed = faults_.failed();
        SCOPED_TRACE(failed);
        const bool isOfTarget =
            failed == "glCheckNamedFramebufferStatus" && result == FX_ERROR_INVALID_ARGUMENT;
        EXPECT_TRUE(result == FX_OK || result == FX_ERROR_OUT_OF_MEMORY || result == FX_ERROR_GL_FAILED ||
                    isOfTarget) // the host's target counts as one that cannot be drawn to

            << result << " " << fxGetLastErrorMessage();
        const bool hasPicture = picture() == (result == FX_OK ? wanted_ : empty_);
        EXPECT_TRUE(hasPicture) << fxGetLastErrorMessage();
        const std::vector<std::string> changed = fx::render::differences(before, states_.probe());
        EXPECT_EQ(changed, std::vector<std::string>());
        const bool isSameScene = hashOf(scene) == hash;
        EXPECT_TRUE(isSameScene);
        faults_.failAt(0, ofCompilers);
        fillPicture();
        bool isNextDrawn = true;
        if (view) {
            EXPECT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
            isNextDrawn = largestDifference(picture(), wanted_) <= 1e-5f; // equal distances sort as before
            EXPECT_TRUE(isNextDrawn);
        }
        EXPECT_EQ(fxDestroyView(view), FX_OK);
        refused_ += result != FX_OK;
        if (failed.empty())
            return false;
        FaultRow& row = failed == "glCheckNamedFramebufferStatus" ? framebuffers_
                        : ofCompilers                             ? compilers_
                                                                  : memoryFaults_;
        ++row.injected;
        row.refused += result != FX_OK;
        FaultRow::add(row.pictures, !hasPicture || !isNextDrawn);
        FaultRow::add(row.glStates, !changed.empty());
        FaultRow::add(row.scenes, !isSameScene);
        return true;
    }
    static uint64_t hashOf(FxScene* scene)
    {
        uint64_t hash = 0;
        EXPECT_EQ(fxScene_GetSimulationHash(scene, &hash), FX_OK);
        return hash;
    }
    /// Number of GL objects that `before` does not have.
    int64_t leftSince(const Objects& before)
    {
        int64_t left = 0;
        for (const auto& [kind, count] : objects())
            left += count - before.at(kind);
        return left;
    }
    Objects objects()
    {
        Objects all;
        for (const char* kind :
             {"Program", "Shader", "Texture", "Buffer", "Framebuffer", "VertexArray", "Sampler", "Query"})
        {
            const auto exists = reinterpret_cast<PFNGLISTEXTUREPROC>(
                gl_->loader().getProcAddress(gl_->loader().user, (std::string("glIs") + kind).c_str()));
            for (GLuint i = 1; i <= 1024; ++i)
                all[kind] += exists(i) ? 1 : 0;
        }
        return all;
    }
    /// Draws without faults: the picture that all frames must have.
    void learn(FxContext* context, FxScene* scene)
    {
        fillPicture();
        empty_ = wanted_ = picture();
        const FxViewSettings all = settings();
        const FxFrameDef def = frame();
        FxView* view = nullptr;
        ASSERT_EQ(fxCreateView(context, scene, &all, &view), FX_OK);
        ASSERT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
        wanted_ = picture();
        ASSERT_NE(wanted_, empty_);
        ASSERT_EQ(fxDestroyView(view), FX_OK);
    }

    fx::test::HostAllocator blocks_;
    fx::test::GlFaults faults_;
    fx::render::GlHost states_;
    std::vector<float> empty_, wanted_;
    uint64_t refused_ = 0; ///< frames that have failed
    FaultRow memoryFaults_{.fault = "out of memory: buffer, map, texture"};
    FaultRow framebuffers_{.fault = "incomplete framebuffer"};
    FaultRow compilers_{.fault = "compile or link error"};
};

} // namespace

TEST_F(GlFaultSweep, ofMemoryAndFramebuffersLeavesPictureStatesAndObjects)
{
    const Objects before = objects();
    FxContext* const context = makeContext();
    ASSERT_NE(context, nullptr) << fxGetLastErrorMessage();
    ASSERT_EQ(fxContext_WarmUp(context), FX_OK) << fxGetLastErrorMessage();
    FxScene* const scene = makeScene(context, {"campfire", "debris", "magic-trail"});
    learn(context, scene);
    const Objects warm = objects();
    uint64_t n = 1;
    for (; drawWithFault(context, scene, n, false) && !HasFailure(); ++n)
        ASSERT_EQ(objects(), warm) << n;
    std::printf("%llu calls failed, %llu frames were refused\n", static_cast<unsigned long long>(n - 1),
                static_cast<unsigned long long>(refused_));
    EXPECT_GT(refused_, 20u);
    ASSERT_EQ(fxDestroyContext(context), FX_OK);
    EXPECT_EQ(objects(), before);
    EXPECT_EQ(blocks_.blocks(), 0);
    for (FaultRow* const row : {&memoryFaults_, &framebuffers_}) { // of both, which had the same context
        row->glObjects = leftSince(before);
        row->blocks = blocks_.blocks();
        fx::test::FaultTable::note(*row);
    }
}

TEST_F(GlFaultSweep, ofCompilersLeavesPictureStatesAndObjects)
{
    const Objects before = objects();
    uint64_t n = 0;
    for (bool hasFault = true; hasFault && !HasFailure(); ++n) {
        FxContext* const context = makeContext();
        ASSERT_NE(context, nullptr) << fxGetLastErrorMessage();
        FxScene* const scene = makeScene(context, {"sparks"});
        if (n == 0)
            learn(context, scene);
        else
            hasFault = drawWithFault(context, scene, n, true);
        ASSERT_EQ(fxDestroyContext(context), FX_OK);
        ASSERT_EQ(objects(), before) << n;
    }
    std::printf("%llu calls failed, %llu frames were refused\n", static_cast<unsigned long long>(n - 2),
                static_cast<unsigned long long>(refused_));
    EXPECT_GT(refused_, 8u);
    EXPECT_EQ(blocks_.blocks(), 0);
    compilers_.glObjects = leftSince(before);
    compilers_.blocks = blocks_.blocks();
    fx::test::FaultTable::note(compilers_);
}

TEST_F(GlFaultSweep, aMissingFunctionIsNamed)
{
    ASSERT_EQ(fxDestroyContext(makeContext()), FX_OK);
    const Objects before = objects();
    const std::set<std::string> names = faults_.asked();
    EXPECT_GT(names.size(), 100u);
    FaultRow missing{.fault = "missing function"};
    for (const std::string& name : names) {
        faults_.hide(name);
        FxContext* const context = makeContext();
        EXPECT_EQ(context, nullptr) << name;
        ++missing.injected;
        missing.refused += context == nullptr;
        EXPECT_NE(std::string(fxGetLastErrorMessage()).find(name), std::string::npos)
            << fxGetLastErrorMessage();
        fxDestroyContext(context);
        ASSERT_EQ(objects(), before) << name;
    }
    EXPECT_EQ(blocks_.blocks(), 0);
    missing.glObjects = leftSince(before);
    missing.blocks = blocks_.blocks();
    fx::test::FaultTable::note(missing);
}

TEST_F(GlFaultSweep, aTargetOfAnotherSizeInEachFrameLeaksNothing)
{
    const Objects none = objects();
    FxContext* const context = makeContext();
    ASSERT_EQ(fxContext_WarmUp(context), FX_OK) << fxGetLastErrorMessage();
    FxScene* const scene = makeScene(context, {"campfire", "debris"});
    const Objects warm = objects();
    const FxViewSettings all = settings();
    FxView* view = nullptr;
    ASSERT_EQ(fxCreateView(context, scene, &all, &view), FX_OK);
    const auto draw = [&](int width, int height) {
        FxFrameDef def = frame();
        def.width = width;
        def.height = height;
        return fxView_Render(view, &def);
    };
    const uint64_t hash = hashOf(scene);
    const GlProbe states = states_.probe();
    FaultRow sizes{.fault = "another size in each frame"};
    FaultRow wrong{.fault = "target of no size, or too large"};
    uint64_t most = 0;
    for (int i = 0; i < 80; ++i) {
        ASSERT_EQ(draw(1 + i * 37 % kSize, 1 + i * 23 % kSize), FX_OK) << fxGetLastErrorMessage();
        ++sizes.injected;
        FaultRow::add(sizes.glStates, !fx::render::differences(states, states_.probe()).empty());
        FaultRow::add(sizes.scenes, hashOf(scene) != hash);
        FxViewStatistics statistics{};
        statistics.structSize = sizeof statistics;
        ASSERT_EQ(fxView_GetStatistics(view, &statistics), FX_OK);
        if (i < 40)
            most = std::max(most, statistics.textureBytes);
        EXPECT_LE(statistics.textureBytes, 2 * most) << i;
    }
    fillPicture();
    const std::vector<float> before = picture();
    for (const int size : {0, -1, kSize + 1, 16'384, 16'385, 1 << 30})
        for (const bool isWidth : {true, false}) {
            const FxResult result = isWidth ? draw(size, kSize) : draw(kSize, size);
            EXPECT_EQ(result, FX_ERROR_INVALID_ARGUMENT) << size;
            ++wrong.injected;
            wrong.refused += result != FX_OK;
            FaultRow::add(wrong.glStates, !fx::render::differences(states, states_.probe()).empty());
            FaultRow::add(wrong.scenes, hashOf(scene) != hash);
            FaultRow::add(wrong.pictures, picture() != before);
        }
    EXPECT_EQ(picture(), before);
    for (const auto& count : {sizes.glStates, wrong.glStates, sizes.scenes, wrong.scenes, wrong.pictures})
        EXPECT_EQ(count, 0);
    EXPECT_EQ(draw(kSize, kSize), FX_OK) << fxGetLastErrorMessage();
    ASSERT_EQ(fxDestroyView(view), FX_OK);
    EXPECT_EQ(objects(), warm);
    ASSERT_EQ(fxDestroyContext(context), FX_OK);
    EXPECT_EQ(objects(), none);
    sizes.glObjects = wrong.glObjects = leftSince(none);
    sizes.blocks = wrong.blocks = blocks_.blocks();
    EXPECT_EQ(blocks_.blocks(), 0);
    fx::test::FaultTable::note(sizes);
    fx::test::FaultTable::note(wrong);
}
