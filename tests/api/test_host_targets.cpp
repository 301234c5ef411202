// What a view does with textures whose names, formats and codes are not what they seem.
#include "tests/api/host_target_fixture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>

using HostTargets = fx::test::HostTargetTest;
using fx::test::ColorFormat;
using fx::test::Outcome;
using fx::test::srgbDecoded;
using fx::test::srgbEncoded;

namespace {

constexpr ColorFormat kSrgb = {GL_SRGB8_ALPHA8, "GL_SRGB8_ALPHA8", ColorFormat::Kind::Srgb, 1.0 / 255,
                               1.0 / 255};

bool has(const Outcome& outcome, const char* words)
{
    return outcome.words.find(words) != std::string::npos;
}

/// Where media add nothing, as the picture over black and over white shows.
std::vector<bool> untouched(const std::vector<float>& overBlack, const std::vector<float>& overWhite)
{
    std::vector<bool> is(overBlack.size() / 4);
    for (size_t p = 0; p < is.size(); ++p) {
        is[p] = true;
        for (size_t c = 0; c < 4; ++c)
            is[p] = is[p] && overBlack[4 * p + c] == 0.0f && overWhite[4 * p + c] == 1.0f;
    }
    return is;
}

} // namespace

TEST_F(HostTargets, pixelsThatNoMediumTouchesKeepTheirBitsInEveryFormat)
{
    const size_t values = size_t(kSize * kSize * 4);
    const FxFrameDef def = frame();
    const std::vector<bool> kept = untouched(reference(def, std::vector<float>(values, 0.0f)),
                                             reference(def, std::vector<float>(values, 1.0f)));
    const auto count = std::count(kept.begin(), kept.end(), true);
    ASSERT_GT(count, kSize * kSize / 8);
    ASSERT_LT(count, kSize * kSize);
    for (const ColorFormat& format : fx::test::kColorFormats) {
        if (format.kind == ColorFormat::Kind::Refused || format.format == GL_RGB9_E5)
            continue;
        std::vector<float> background = gradient();
        for (size_t i = 0; i < values && format.kind == ColorFormat::Kind::Float; i += 5)
            background[i] = i % 2 == 0 ? -0.0f : std::numeric_limits<float>::infinity();
        const GLuint texture = textures_.make2D(format.format, kSize);
        write(texture, background);
        const std::vector<float> before = read(texture);
        FxFrameDef over = def;
        over.colorTexture = texture;
        ASSERT_EQ(render(over).result, FX_OK) << format.name;
        const std::vector<float> after = read(texture);
        EXPECT_NE(std::memcmp(after.data(), before.data(), values * sizeof(float)), 0) << format.name;
        for (size_t i = 0; i < values; ++i) {
            if (kept[i / 4]) {
                ASSERT_EQ(std::bit_cast<uint32_t>(after[i]), std::bit_cast<uint32_t>(before[i]))
                    << format.name << " value " << i << ": " << before[i] << " became " << after[i];
            }
        }
    }
}

TEST_F(HostTargets, srgbCodesComeBackWhenAPictureIsReadAndWrittenWhole)
{
    // an empty scene: glare finds nothing too bright, but the picture goes through its passes and back
    FxScene* scene = nullptr;
    FxView* view = nullptr;
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    ASSERT_EQ(fxCreateScene(context_, &sceneDef, &scene), FX_OK);
    ASSERT_EQ(fxCreateView(context_, scene, nullptr, &view), FX_OK);
    const GLuint texture = textures_.make2D(GL_SRGB8_ALPHA8, kSize);
    write(texture, gradient()); // each of 256 codes
    const std::vector<float> before = read(texture);
    FxFrameDef def = frame();
    def.colorTexture = texture;
    ASSERT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
    EXPECT_GT(fx::test::passNamesOf(view).size(), 0u);
    EXPECT_EQ(read(texture), before);
    EXPECT_EQ(fxDestroyView(view), FX_OK);
    EXPECT_EQ(fxDestroyScene(scene), FX_OK);
}

TEST_F(HostTargets, mediaOverAnSrgbPictureAreBlendedInLight)
{
    // what media do to a pixel is out = light + share * behind; both follow from pictures over black and
    // white
    const size_t values = size_t(kSize * kSize * 4);
    const FxFrameDef def = frame();
    const std::vector<float> black = reference(def, std::vector<float>(values, 0.0f));
    const std::vector<float> white = reference(def, std::vector<float>(values, 1.0f));
    const GLuint texture = textures_.make2D(GL_SRGB8_ALPHA8, kSize);
    write(texture, gradient());
    const std::vector<float> before = read(texture);
    FxFrameDef srgb = def;
    srgb.colorTexture = texture;
    ASSERT_EQ(render(srgb).result, FX_OK);
    const std::vector<float> after = read(texture);
    double worst = 0.0;
    for (size_t i = 0; i < values; ++i) {
        if (i % 4 == 3)
            continue;
        const double share = double(white[i]) - double(black[i]);
        const double light = double(black[i]) + share * srgbDecoded(double(before[i]));
        const double wanted = srgbEncoded(std::clamp(light, 0.0, 1.0));
        worst = std::max(worst, std::abs(double(after[i]) - wanted));
    }
    EXPECT_LE(worst, 2.75 / 255.0); // as faultOf() has it
}

/// The GPU is still busy with one frame when the next is submitted; equal frames over equal pictures are
/// equal.
TEST_F(HostTargets, framesThatFollowWithoutWaitingDoNotDisturbEachOther)
{
    useSettings(false);
    std::vector<GLuint> targets;
    for (int i = 0; i < 8; ++i) {
        targets.push_back(textures_.make2D(GL_RGBA32F, kSize));
        write(targets.back(), gradient());
    }
    FxFrameDef def = frame();
    for (const GLuint target : targets) {
        def.colorTexture = target;
        ASSERT_EQ(render(def).result, FX_OK);
    }
    const std::vector<float> first = read(targets.front());
    for (const GLuint target : targets)
        EXPECT_TRUE(read(target) == first) << target;
}

TEST_F(HostTargets, toneMappedCodesAreStoredInAnSrgbTextureAsTheyAre)
{
    useSettings(true, true);
    const GLuint srgb = textures_.make2D(GL_SRGB8_ALPHA8, kSize);
    write(srgb, gradient());
    const std::vector<float> codes = reference(frame(), lightOf(kSrgb, read(srgb)));
    FxFrameDef def = frame();
    def.colorTexture = srgb;
    ASSERT_EQ(render(def).result, FX_OK);
    const std::vector<float> stored = read(srgb);
    for (size_t i = 0; i < stored.size(); ++i)
        ASSERT_NEAR(stored[i], codes[i], 1.0 / 255.0) << "value " << i;
}

TEST_F(HostTargets, aTextureThatIsAnotherOneUnderTheSameNameIsCheckedAgain)
{
    const GLuint name = textures_.makeMutable(GL_RGBA16F, kSize);
    FxFrameDef def = frame();
    def.colorTexture = name;
    const auto remake = [&](GLenum format, int size, GLenum pixels) {
        textures_.gl.BindTexture(GL_TEXTURE_2D, name);
        textures_.gl.TexImage2D(GL_TEXTURE_2D, 0, GLint(format), size, size, 0, pixels,
                                pixels == GL_RGBA ? GL_FLOAT : GL_UNSIGNED_INT, nullptr);
        textures_.gl.BindTexture(GL_TEXTURE_2D, 0);
        return render(def);
    };
    EXPECT_EQ(remake(GL_RGBA16F, kSize, GL_RGBA).result, FX_OK);
    EXPECT_TRUE(has(remake(GL_RGBA16UI, kSize, GL_RGBA_INTEGER), "GL_RGBA16UI"));
    EXPECT_TRUE(has(remake(GL_RGBA16F, kSize / 2, GL_RGBA), "frame.width is 64"));
    EXPECT_EQ(remake(GL_RGBA8, kSize, GL_RGBA).result, FX_OK);
    textures_.gl.DeleteTextures(1, &name);
    EXPECT_TRUE(has(render(def), "names no texture"));
}

TEST_F(HostTargets, namesThatAreNoTexturesAreRefusedWithoutAnOpenGlError)
{
    GLuint notATexture = 0; // of a kind that counts names for itself
    while (notATexture <= color_.name() + 100)
        notATexture = textures_.makeBuffer();
    GLuint neverBound = 0;
    textures_.gl.GenTextures(1, &neverBound);
    const std::vector<float> before = picture();
    for (const GLuint name : {notATexture, neverBound, ~0u}) {
        FxFrameDef def = frame();
        def.colorTexture = name;
        EXPECT_TRUE(has(render(def), "frame.colorTexture is")) << name;
        def = frame();
        def.depthTexture = name;
        EXPECT_TRUE(has(render(def), "frame.depthTexture is")) << name;
        def = frame();
        def.target = FX_TARGET_FRAMEBUFFER;
        def.framebuffer = name;
        EXPECT_TRUE(has(render(def), "frame.framebuffer is")) << name;
    }
    textures_.gl.DeleteTextures(1, &neverBound);
    EXPECT_EQ(picture(), before);
    EXPECT_EQ(host_->gl.GetError(), GLenum(GL_NO_ERROR));
}

namespace {

PFNGLGETTEXTUREPARAMETERIVPROC realGetTextureParameter = nullptr;
PFNGLGETINTEGERVPROC realGetInteger = nullptr;

void APIENTRY compatibilityProfile(GLenum what, GLint* out)
{
    realGetInteger(what, out);
    if (what == GL_CONTEXT_PROFILE_MASK)
        *out = GL_CONTEXT_COMPATIBILITY_PROFILE_BIT;
}

/// Mesa's answer outside of core profiles.
void APIENTRY refuseTarget(GLuint texture, GLenum what, GLint* out)
{
    realGetTextureParameter(texture, what == GL_TEXTURE_TARGET ? GLenum(GL_INVALID_ENUM) : what, out);
}

void* findWithoutTarget(void* user, const char* name)
{
    const auto& loader = *static_cast<const fx::render::GlLoader*>(user);
    void* const real = loader.getProcAddress(loader.user, name);
    if (std::strcmp(name, "glGetIntegerv") == 0) {
        realGetInteger = reinterpret_cast<PFNGLGETINTEGERVPROC>(real);
        return reinterpret_cast<void*>(&compatibilityProfile);
    }
    if (std::strcmp(name, "glGetTextureParameteriv") != 0)
        return real;
    realGetTextureParameter = reinterpret_cast<PFNGLGETTEXTUREPARAMETERIVPROC>(real);
    return reinterpret_cast<void*>(&refuseTarget);
}

} // namespace

TEST_F(HostTargets, texturesAreKnownInContextsThatDoNotTellTheirTarget)
{
    const fx::render::GlLoader loader = gl_->loader();
    FxContextDef contextDef = fxDefaultContextDef();
    contextDef.gl = {const_cast<fx::render::GlLoader*>(&loader), &findWithoutTarget};
    FxContext* context = nullptr;
    FxScene* scene = nullptr;
    FxView* view = nullptr;
    FxInstanceDef instance = fxDefaultInstanceDef();
    FxInstanceId id{};
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    ASSERT_EQ(fxCreateContext(&contextDef, &context), FX_OK) << fxGetLastErrorMessage();
    ASSERT_EQ(fxLoadPresetLibrary(context, "campfire", &instance.preset), FX_OK);
    ASSERT_EQ(fxCreateScene(context, &sceneDef, &scene), FX_OK);
    ASSERT_EQ(fxScene_CreateInstance(scene, &instance, &id), FX_OK);
    ASSERT_EQ(fxCreateView(context, scene, nullptr, &view), FX_OK);
    for (int i = 0; i < 20; ++i)
        ASSERT_EQ(fxScene_Update(scene, 1.0 / 60), FX_OK);
    const GLuint array = textures_.make(GL_TEXTURE_2D_ARRAY, GL_RGBA16F, kSize, kSize);
    const GLuint bound = textures_.make2D(GL_RGBA8, kSize);
    textures_.gl.BindTexture(GL_TEXTURE_2D, bound);
    FxFrameDef def = frame();
    const std::vector<float> before = picture();
    EXPECT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
    EXPECT_NE(picture(), before);
    def.colorTexture = textures_.make(GL_TEXTURE_2D_MULTISAMPLE, GL_RGBA16F, kSize, kSize);
    EXPECT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(messages_->serious(), 0u) << messages_->first(); // a host's debug callback receives none
    messages_.reset(); // OpenGL reports the bindings of refused textures that are tried
    for (const GLuint name : {array, textures_.make(GL_TEXTURE_3D, GL_RGBA16F, kSize, kSize)}) {
        def.colorTexture = name;
        EXPECT_EQ(fxView_Render(view, &def), FX_ERROR_INVALID_ARGUMENT);
        EXPECT_NE(
            std::strstr(fxGetLastErrorMessage(), name == array ? "GL_TEXTURE_2D_ARRAY" : "GL_TEXTURE_3D"),
            nullptr)
            << fxGetLastErrorMessage();
    }
    GLint now = 0;
    textures_.gl.GetIntegerv(GL_TEXTURE_BINDING_2D, &now);
    EXPECT_EQ(GLuint(now), bound);
    textures_.gl.BindTexture(GL_TEXTURE_2D, 0);
    EXPECT_EQ(fxDestroyContext(context), FX_OK);
    EXPECT_EQ(host_->gl.GetError(), GLenum(GL_NO_ERROR));
    messages_ = std::make_unique<fx::render::GlMessages>(*host_);
}

TEST_F(HostTargets, whatTheViewItselfDrawsToIsRefusedAndAnotherViewsIsNot)
{
    FxViewSettings settings = fxDefaultViewSettings();
    settings.layerOutputs = 1;
    ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK);
    ASSERT_EQ(render(frame()).result, FX_OK);
    FxLayerTextures layers{};
    layers.structSize = sizeof layers;
    ASSERT_EQ(fxView_GetLayerTextures(view_, &layers), FX_OK);
    FxFrameDef def = frame();
    def.colorTexture = layers.media;
    EXPECT_TRUE(has(render(def), "frame.colorTexture is a texture of this view"));
    FxFrameDef deep = frame();
    deep.depthTexture = layers.depth;
    EXPECT_TRUE(has(render(deep), "frame.depthTexture is a texture of this view"));
    FxView* other = nullptr;
    ASSERT_EQ(fxCreateView(context_, scene_, nullptr, &other), FX_OK);
    EXPECT_EQ(fxView_Render(other, &def), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(fxDestroyView(other), FX_OK);
}

TEST_F(HostTargets, aRefusedFrameLeavesTheNextOneAsItWouldHaveBeen)
{
    useSettings(false);
    FxFrameDef def = frame();
    const auto play = [&](bool refuse) {
        fillPicture();
        EXPECT_EQ(render(def).result, FX_OK); // glare adapts anew
        if (refuse) {
            FxFrameDef bad = def;
            bad.width = 2 * kSize;
            EXPECT_EQ(fxView_Render(view_, &bad), FX_ERROR_INVALID_ARGUMENT);
        }
        fillPicture();
        EXPECT_EQ(fxView_Render(view_, &def), FX_OK);
        return picture();
    };
    const std::vector<float> wanted = play(false);
    EXPECT_EQ(play(true), wanted);
}

TEST_F(HostTargets, checkingTargetsTakesFewCallsAndNoneWhileNothingIsDrawn)
{
    FxFrameDef def = frame();
    def.depthTexture = 0;
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK);
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK);
    const uint64_t withoutDepth = statistics().glCalls;
    def = frame();
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK);
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK);
    const uint64_t withDepth = statistics().glCalls;
    EXPECT_LE(withDepth - withoutDepth, 8u + 8u); // facts of one texture, and a draw instead of a clear
    RecordProperty("gl_calls", int(withDepth));
    // a picture in two textures by turns is known as well as one
    const GLuint second = textures_.make2D(GL_RGBA32F, kSize);
    FxFrameDef other = def;
    other.colorTexture = second;
    ASSERT_EQ(fxView_Render(view_, &other), FX_OK);
    for (int i = 0; i < 4; ++i) {
        ASSERT_EQ(fxView_Render(view_, i % 2 == 0 ? &def : &other), FX_OK);
        EXPECT_EQ(statistics().glCalls, withDepth) << i;
    }
}

TEST_F(HostTargets, savingStatesTakesFewerCallsThanDrawing)
{
    const auto calls = [&](bool save, bool inPlace) {
        FxViewSettings settings = fxDefaultViewSettings();
        settings.saveState = save ? 1 : 0;
        if (inPlace) {
            settings.dazzle = 0;
            settings.shimmerStrength = 0;
        }
        EXPECT_EQ(fxView_SetSettings(view_, &settings), FX_OK);
        for (int i = 0; i < 2; ++i)
            EXPECT_EQ(render(frame()).result, FX_OK);
        return statistics().glCalls;
    };
    for (const bool inPlace : {true, false}) {
        const uint64_t saved = calls(true, inPlace);
        const uint64_t unsaved = calls(false, inPlace);
        std::printf("%s: %llu GL calls a frame, %llu with saveState 0\n",
                    inPlace ? "media alone" : "all passes", static_cast<unsigned long long>(saved),
                    static_cast<unsigned long long>(unsaved));
        EXPECT_LT(saved - unsaved, unsaved);
    }
}

TEST_F(HostTargets, whileTransformFeedbackRunsNothingIsDrawnWithTheHostsProgram)
{
    const fx::render::GlLoader load = gl_->loader();
#define FX_LOAD(TYPE, name) reinterpret_cast<PFNGL##TYPE##PROC>(load.getProcAddress(load.user, "gl" #name))
    const char* source =
        "#version 450 core\nout vec4 caught;\n"
        "void main() { gl_Position = caught = vec4(float(gl_VertexID) * 4.0 - 1.0, 0.0, 0.0, 1.0); }";
    const char* varying = "caught";
    const GLuint shader = host_->gl.CreateShader(GL_VERTEX_SHADER), program = host_->gl.CreateProgram();
    host_->gl.ShaderSource(shader, 1, &source, nullptr);
    host_->gl.CompileShader(shader);
    host_->gl.AttachShader(program, shader);
    FX_LOAD(TRANSFORMFEEDBACKVARYINGS, TransformFeedbackVaryings)
    (program, 1, &varying, GL_INTERLEAVED_ATTRIBS);
    host_->gl.LinkProgram(program);
    host_->gl.UseProgram(program);
    host_->gl.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, textures_.makeBuffer());
    const std::vector<float> before = picture();
    FX_LOAD(BEGINTRANSFORMFEEDBACK, BeginTransformFeedback)(GL_TRIANGLES);
    const Outcome running = render(frame());
    FX_LOAD(PAUSETRANSFORMFEEDBACK, PauseTransformFeedback)();
    EXPECT_EQ(picture(), before);
    const Outcome paused = render(frame());
    FX_LOAD(RESUMETRANSFORMFEEDBACK, ResumeTransformFeedback)();
    FX_LOAD(ENDTRANSFORMFEEDBACK, EndTransformFeedback)();
    EXPECT_EQ(running.result, FX_ERROR_INVALID_ARGUMENT);
    EXPECT_TRUE(has(running, "transform feedback is active: end or pause it")) << running.words;
    EXPECT_EQ(paused.result, FX_OK) << paused.words;
    EXPECT_NE(picture(), before);
    host_->gl.UseProgram(0);
    host_->gl.DeleteProgram(program);
    host_->gl.DeleteShader(shader);
#undef FX_LOAD
}

TEST_F(HostTargets, clipOriginMustBeWhatTheFrameSays)
{
    FxFrameDef def = frame();
    const std::vector<float> before = picture();
    textures_.gl.ClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    EXPECT_TRUE(has(render(def), "frame.upperLeftOrigin is 0, but glClipControl says GL_UPPER_LEFT"));
    EXPECT_EQ(picture(), before);
    def.upperLeftOrigin = 1;
    EXPECT_EQ(render(def).result, FX_OK) << fxGetLastErrorMessage();
    textures_.gl.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    EXPECT_TRUE(has(render(def), "frame.upperLeftOrigin is 1, but glClipControl says GL_LOWER_LEFT"));
}
