// What a device needs from the host, and how it compiles programs.
#include "gl_test.h"
#include "rendering/gl/gl_pass_timer.h"

#include <algorithm>
#include <cstring>

namespace fx::render {

namespace {

/// Another loader without one function, or with a context of another version.
struct DoctoredLoader
{
    GlLoader inner;
    const char* hidden = "";
    bool old = false;
    bool lostQueries = false; ///< true: queries are available at once with the result 0, as in a lost context

    GlLoader loader()
    {
        return {this, [](void* user, const char* name) -> void* {
                    auto& self = *static_cast<DoctoredLoader*>(user);
                    if (std::strcmp(name, self.hidden) == 0)
                        return nullptr;
                    if (self.old && std::strcmp(name, "glGetIntegerv") == 0)
                        return reinterpret_cast<void*>(&answerThreePointThree);
                    if (self.lostQueries && std::strcmp(name, "glGetQueryObjectuiv") == 0)
                        return reinterpret_cast<void*>(&answerAvailable);
                    if (self.lostQueries && std::strcmp(name, "glGetQueryObjectui64v") == 0)
                        return reinterpret_cast<void*>(&answerZero);
                    return self.inner.getProcAddress(self.inner.user, name);
                }};
    }

    static void APIENTRY answerThreePointThree(GLenum, GLint* value) { *value = 3; }
    static void APIENTRY answerAvailable(GLuint, GLenum, GLuint* value) { *value = GL_TRUE; }
    static void APIENTRY answerZero(GLuint, GLenum, GLuint64* value) { *value = 0; }
};

bool contains(const std::string& text, const char* word)
{
    return text.find(word) != std::string::npos;
}

} // namespace

class GlDeviceTest : public GlTest
{
protected:
    base::Status createWith(const GlLoader& loader)
    {
        return GlDevice::create(loader, std::pmr::get_default_resource()).status();
    }
};

TEST_F(GlDeviceTest, theLimitsOfTheContextAreKnown)
{
    EXPECT_GE(device->limits().version, 45);
    EXPECT_GE(device->limits().textureSize, 16384);
    EXPECT_GE(device->limits().uniformBlockBytes, 16384);
    EXPECT_GT(device->limits().uniformAlignment, 0);
    EXPECT_TRUE(device->limits().debugContext);
    EXPECT_FALSE(device->limits().renderer.empty());
}

TEST_F(GlDeviceTest, aMissingFunctionIsReportedByName)
{
    DoctoredLoader doctored{context->loader(), "glBindImageTexture"};
    const base::Status status = createWith(doctored.loader());
    EXPECT_EQ(status.code(), base::Code::GlUnsupported);
    EXPECT_TRUE(contains(status.message(), "glBindImageTexture")) << status.message();
    EXPECT_FALSE(contains(status.message(), "glDrawArrays")) << status.message();
}

TEST_F(GlDeviceTest, evenTheFunctionsThatAskForTheVersionMayBeMissing)
{
    for (const char* name : {"glGetIntegerv", "glGetString"}) {
        DoctoredLoader doctored{context->loader(), name};
        const base::Status status = createWith(doctored.loader());
        EXPECT_EQ(status.code(), base::Code::GlUnsupported);
        EXPECT_TRUE(contains(status.message(), name)) << status.message();
    }
}

TEST_F(GlDeviceTest, anOldContextIsRefusedNamingBothVersions)
{
    DoctoredLoader doctored{context->loader(), "glCreateTextures", true};
    const base::Status status = createWith(doctored.loader());
    EXPECT_EQ(status.code(), base::Code::GlUnsupported);
    EXPECT_TRUE(contains(status.message(), "4.5")) << status.message();
    EXPECT_TRUE(contains(status.message(), "3.3")) << status.message();
}

TEST_F(GlDeviceTest, withoutALoaderThereIsNoDevice)
{
    EXPECT_EQ(createWith({}).code(), base::Code::InvalidArgument);
}

TEST_F(GlDeviceTest, everyCallIsCounted)
{
    const uint64_t before = device->callCount();
    device->gl.Flush();
    (void)device->gl.IsEnabled(GL_BLEND);
    EXPECT_EQ(device->callCount(), before + 2);
}

TEST_F(GlDeviceTest, aProgramIsCompiledOnce)
{
    ASSERT_TRUE(device->compile(programs::kFill).ok());
    ASSERT_TRUE(device->compile(programs::kFill).ok());
    EXPECT_EQ(device->programsCompiled(), 1u);
    base::Status status;
    EXPECT_NE(device->program(programs::kFill, status), 0u);
    EXPECT_EQ(device->lateCompiles(), 0u);
    EXPECT_NE(device->program(programs::kSample, status), 0u);
    EXPECT_TRUE(status.ok());
    EXPECT_EQ(device->lateCompiles(), 1u);
    EXPECT_EQ(device->programsCompiled(), 2u);
}

/// Counts how many programs are linked and not yet asked for: what a driver can compile at once.
struct LinkWatch
{
    static inline PFNGLLINKPROGRAMPROC link = nullptr;
    static inline PFNGLGETPROGRAMIVPROC get = nullptr;
    static inline int waiting = 0, most = 0;

    static void APIENTRY countLink(GLuint program)
    {
        most = std::max(most, ++waiting);
        link(program);
    }
    static void APIENTRY countGet(GLuint program, GLenum what, GLint* value)
    {
        waiting -= what == GL_LINK_STATUS ? 1 : 0;
        get(program, what, value);
    }
    template <class Function>
    static void* keep(void* original, Function& kept, Function counting)
    {
        kept = reinterpret_cast<Function>(original);
        return reinterpret_cast<void*>(counting);
    }
};

TEST_F(GlDeviceTest, programsAreStartedBeforeTheDriverIsAskedForTheFirst)
{
    GlLoader inner = context->loader();
    const GlLoader watched{&inner, [](void* user, const char* name) -> void* {
                               const GlLoader& loader = *static_cast<const GlLoader*>(user);
                               void* const original = loader.getProcAddress(loader.user, name);
                               if (std::string_view(name) == "glLinkProgram")
                                   return LinkWatch::keep(original, LinkWatch::link, &LinkWatch::countLink);
                               if (std::string_view(name) == "glGetProgramiv")
                                   return LinkWatch::keep(original, LinkWatch::get, &LinkWatch::countGet);
                               return original;
                           }};
    auto watching = GlDevice::create(watched, std::pmr::get_default_resource());
    ASSERT_TRUE(watching.ok());
    (*watching)->setSourceOverride([](std::string_view name, std::string_view) { return testShader(name); });
    const ProgramDesc* const programs[] = {&programs::kFill, &programs::kSample, &programs::kFill};
    ASSERT_TRUE((*watching)->compile(programs).ok());
    EXPECT_EQ(LinkWatch::most, 2);
    EXPECT_EQ(LinkWatch::waiting, 0);
    EXPECT_EQ((*watching)->programsCompiled(), 2u);
}

TEST_F(GlDeviceTest, programsBeforeABrokenOneAreCompiled)
{
    static constexpr ProgramDesc kBroken = {"media", "fullscreen.vert", "broken.frag", nullptr, nullptr};
    static constexpr ProgramDesc kMissing = {"missing", "fullscreen.vert", "no/such.frag", nullptr, nullptr};
    const ProgramDesc* const broken[] = {&programs::kFill, &kBroken, &programs::kSample};
    EXPECT_EQ(device->compile(broken).code(), base::Code::GlFailed);
    const ProgramDesc* const missing[] = {&kMissing, &programs::kSample};
    EXPECT_EQ(device->compile(missing).code(), base::Code::NotFound);
    EXPECT_EQ(device->programsCompiled(), 1u);
    base::Status status;
    EXPECT_NE(device->program(programs::kFill, status), 0u);
    EXPECT_EQ(device->lateCompiles(), 0u);
    expectedMessages = messages->serious();
}

TEST_F(GlDeviceTest, aShaderThatDoesNotCompileIsReportedWithStageFileAndLog)
{
    static constexpr ProgramDesc kBroken = {"media", "fullscreen.vert", "broken.frag", nullptr, nullptr};
    const base::Status status = device->compile(kBroken);
    EXPECT_EQ(status.code(), base::Code::GlFailed);
    for (const char* word : {"media", "fragment", "broken.frag", "thisIsNoFunction"})
        EXPECT_TRUE(contains(status.message(), word)) << status.message();
    EXPECT_EQ(device->programsCompiled(), 0u);
    expectedMessages = messages->serious(); // the driver reports the shader as well
}

TEST_F(GlDeviceTest, stagesThatDoNotFitTogetherAreReported)
{
    device->setSourceOverride([](std::string_view name, std::string_view) -> std::optional<std::string> {
        if (name == "a.vert")
            return "#version 450 core\nlayout(location = 0) out vec2 v;\nvoid main() { v = vec2(0); "
                   "gl_Position = vec4(0); }\n";
        return "#version 450 core\nlayout(location = 0) in vec4 v;\nlayout(location = 0) out vec4 c;\nvoid "
               "main() { c = v; }\n";
    });
    static constexpr ProgramDesc kMisfit = {"misfit", "a.vert", "b.frag", nullptr, nullptr};
    const base::Status status = device->compile(kMisfit);
    EXPECT_EQ(status.code(), base::Code::GlFailed);
    EXPECT_TRUE(contains(status.message(), "misfit")) << status.message();
    EXPECT_TRUE(contains(status.message(), "does not link")) << status.message();
    expectedMessages = messages->serious();
}

TEST_F(GlDeviceTest, aShaderThatDoesNotExistIsReportedByName)
{
    static constexpr ProgramDesc kMissing = {"missing", "fullscreen.vert", "no/such.frag", nullptr, nullptr};
    const base::Status status = device->compile(kMissing);
    EXPECT_EQ(status.code(), base::Code::NotFound);
    EXPECT_TRUE(contains(status.message(), "no/such.frag")) << status.message();
}

TEST_F(GlDeviceTest, definitionsReachTheSourceAndForgottenProgramsAreCompiledAgain)
{
    std::string seen;
    device->setSourceOverride([&](std::string_view name, std::string_view defines) {
        seen = defines;
        return testShader(name);
    });
    static constexpr ProgramDesc kDefined = {"defined", "fullscreen.vert", "fill.frag", nullptr, "FX_FORM=2"};
    ASSERT_TRUE(device->compile(kDefined).ok());
    EXPECT_EQ(seen, "FX_FORM=2");
    device->forgetPrograms();
    ASSERT_TRUE(device->compile(kDefined).ok());
    EXPECT_EQ(device->programsCompiled(), 2u);
}

TEST_F(GlDeviceTest, heldBytesAreCountedWhileTexturesAndBuffersLive)
{
    {
        auto texture = GlTexture::create(*device, 10, 5, GL_RGBA16F, "texture");
        auto buffer = GlBuffer::create(*device, 100, "buffer");
        ASSERT_TRUE(texture.ok() && buffer.ok());
        EXPECT_EQ(device->textureBytes(), 400u);
        EXPECT_EQ(device->bufferBytes(), 100u);
        GlTexture moved = std::move(*texture);
        EXPECT_EQ(device->textureBytes(), 400u);
        EXPECT_EQ(moved.width(), 10);
    }
    EXPECT_EQ(device->textureBytes(), 0u);
    EXPECT_EQ(device->bufferBytes(), 0u);
}

TEST_F(GlDeviceTest, impossibleSizesAreRefusedWithoutAnyCall)
{
    const uint64_t before = device->callCount();
    const int largest = device->limits().textureSize;
    for (const auto& [width, height] :
         {std::pair{0, 4}, std::pair{4, 0}, std::pair{-1, 4}, std::pair{largest + 1, 4}})
    {
        const auto texture = GlTexture::create(*device, width, height, GL_R32F, "impossible");
        EXPECT_EQ(texture.status().code(), base::Code::InvalidArgument);
        EXPECT_TRUE(contains(texture.status().message(), "impossible"));
    }
    EXPECT_EQ(GlBuffer::create(*device, 0, "empty").status().code(), base::Code::InvalidArgument);
    EXPECT_EQ(device->callCount(), before);
}

TEST_F(GlDeviceTest, queriesOfALostContextAreNoTimes)
{
    DoctoredLoader lost{context->loader()};
    lost.lostQueries = true;
    auto made = GlDevice::create(lost.loader(), std::pmr::get_default_resource());
    ASSERT_TRUE(made.ok()) << made.status().message();
    const auto measure = [](GlPassTimer& timer, TimingClock clock) {
        timer.beginFrame(clock, 7);
        timer.beginPasses();
        timer.endFrame(true);
        GroupTimes times;
        return timer.take(times);
    };
    GlPassTimer timer(**made, {});
    EXPECT_FALSE(measure(timer, TimingClock::Gpu));
    EXPECT_TRUE(measure(timer, TimingClock::Host)); // is not held up by the frame before
}

} // namespace fx::render
