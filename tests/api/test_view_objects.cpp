// Objects of OpenGL that exist: a view takes all of its own with it, a context those that its views shared.
#include "tests/api/library_names.h"
#include "tests/api/view_fixture.h"

#include <map>

using fx::test::kFrame;

namespace {

/// Objects by kind, as OpenGL itself knows them.
using Objects = std::map<std::string, int>;

Objects objectsOf(const fx::render::GlLoader& loader)
{
    constexpr GLuint kMaxNames = 2048; // of a kind; drivers give out the smallest that is free
    Objects objects;
    for (const char* kind : {"Program", "Shader", "Texture", "Buffer", "Framebuffer", "Renderbuffer",
                             "VertexArray", "Sampler", "Query", "ProgramPipeline", "TransformFeedback"})
    {
        const std::string name = std::string("glIs") + kind;
        const auto exists =
            reinterpret_cast<PFNGLISTEXTUREPROC>(loader.getProcAddress(loader.user, name.c_str()));
        for (GLuint i = 1; i <= kMaxNames; ++i)
            objects[kind] += exists(i) ? 1 : 0;
    }
    return objects;
}

/// Counts fences, which have no names, between a context and OpenGL.
class FenceCounter
{
public:
    explicit FenceCounter(const fx::render::GlLoader& real) : real_(real) { current() = this; }
    ~FenceCounter() { current() = nullptr; }
    FenceCounter(const FenceCounter&) = delete;
    FenceCounter& operator=(const FenceCounter&) = delete;
    FxGlLoader hooks() { return {this, &find}; }
    int fences() const { return fences_; } ///< that exist

private:
    static FenceCounter*& current()
    {
        static FenceCounter* counter = nullptr;
        return counter;
    }
    template <class F>
    static F real(const char* name)
    {
        return reinterpret_cast<F>(current()->real_.getProcAddress(current()->real_.user, name));
    }
    static GLsync APIENTRY fenceSync(GLenum condition, GLbitfield flags)
    {
        ++current()->fences_;
        return real<PFNGLFENCESYNCPROC>("glFenceSync")(condition, flags);
    }
    static void APIENTRY deleteSync(GLsync sync)
    {
        current()->fences_ -= sync ? 1 : 0;
        real<PFNGLDELETESYNCPROC>("glDeleteSync")(sync);
    }
    static void* find(void*, const char* name)
    {
        if (std::string(name) == "glFenceSync")
            return reinterpret_cast<void*>(&fenceSync);
        if (std::string(name) == "glDeleteSync")
            return reinterpret_cast<void*>(&deleteSync);
        return current()->real_.getProcAddress(current()->real_.user, name);
    }

    fx::render::GlLoader real_;
    int fences_ = 0;
};

class ViewObjects : public fx::test::ViewApiTest
{
protected:
    FxContext* makeContext(FenceCounter& fences)
    {
        FxContextDef def = fxDefaultContextDef();
        def.workers = 1;
        def.gl = fences.hooks();
        FxContext* context = nullptr;
        EXPECT_EQ(fxCreateContext(&def, &context), FX_OK) << fxGetLastErrorMessage();
        return context;
    }

    /// Shows a preset in a view and a scene of its own for a moment, in all ways that a view knows.
    void show(FxContext* context, FxPresetId preset)
    {
        FxScene* scene = nullptr;
        const FxSceneDef sceneDef = fxDefaultSceneDef();
        ASSERT_EQ(fxCreateScene(context, &sceneDef, &scene), FX_OK);
        FxInstanceDef instance = fxDefaultInstanceDef();
        instance.preset = preset;
        FxInstanceId id{};
        ASSERT_EQ(fxScene_CreateInstance(scene, &instance, &id), FX_OK) << fxGetLastErrorMessage();
        FxViewSettings settings = fxDefaultViewSettings();
        FxView* view = nullptr;
        ASSERT_EQ(fxCreateView(context, scene, &settings, &view), FX_OK) << fxGetLastErrorMessage();
        FxFrameDef def = frame();
        def.origin[1] = 1.0;
        for (int i = 0; i < 4; ++i) {
            settings.activationOverlay = uint32_t(i % 2);
            settings.layerOutputs = uint32_t(i % 2);
            settings.toneMap = uint32_t(i / 2);
            settings.layerScale = i < 2 ? 1.0f : 0.5f;
            ASSERT_EQ(fxView_SetSettings(view, &settings), FX_OK) << fxGetLastErrorMessage();
            for (int k = 0; k < 8; ++k)
                ASSERT_EQ(fxScene_Update(scene, kFrame), FX_OK);
            ASSERT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
        }
        ASSERT_EQ(fxDestroyView(view), FX_OK);
        ASSERT_EQ(fxDestroyScene(scene), FX_OK);
    }
};

} // namespace

TEST_F(ViewObjects, ofAViewGoWithItWhateverItHasShown)
{
    const Objects before = objectsOf(gl_->loader());
    FenceCounter fences(gl_->loader());
    FxContext* const context = makeContext(fences);
    ASSERT_EQ(fxContext_WarmUp(context), FX_OK) << fxGetLastErrorMessage();
    const Objects warm = objectsOf(gl_->loader());
    for (const std::string& name : fx::test::libraryNames()) {
        SCOPED_TRACE(name);
        FxPresetId preset{};
        ASSERT_EQ(fxLoadPresetLibrary(context, name.c_str(), &preset), FX_OK) << fxGetLastErrorMessage();
        show(context, preset);
        EXPECT_EQ(objectsOf(gl_->loader()), warm);
        EXPECT_EQ(fences.fences(), 0);
    }
    ASSERT_EQ(fxDestroyContext(context), FX_OK);
    EXPECT_EQ(objectsOf(gl_->loader()), before);
}

TEST_F(ViewObjects, ofAContextThatWasNotWarmedUpGoWithIt)
{
    const Objects before = objectsOf(gl_->loader());
    FenceCounter fences(gl_->loader());
    FxContext* const context = makeContext(fences);
    FxPresetId preset{};
    ASSERT_EQ(fxLoadPresetLibrary(context, "fireworks", &preset), FX_OK) << fxGetLastErrorMessage();
    show(context, preset);
    EXPECT_NE(objectsOf(gl_->loader()), before); // programs stay for the next view
    ASSERT_EQ(fxDestroyContext(context), FX_OK);
    EXPECT_EQ(objectsOf(gl_->loader()), before);
    EXPECT_EQ(fences.fences(), 0);
}

TEST_F(ViewObjects, ofAProgramAreTheProgramAlone)
{
    warmUp();
    const Objects objects = objectsOf(gl_->loader());
    EXPECT_GT(objects.at("Program"), 20);
    EXPECT_EQ(objects.at("Shader"), 0);
}
