// Faults give a status that names the place; nothing crashes and the next frame works.
#include "gl_test.h"

#include <array>
#include <cstring>

namespace fx::render {

using programs::kFill;

class GlFaultsTest : public GlTest
{
protected:
    ResourceId declareFill(int size = 4)
    {
        graph.begin();
        ResourceId target;
        graph.addPass("filler", [&](FrameGraph::Builder& builder) {
            target = builder.write(builder.create(TextureDesc{"target", size, size, Format::RGBA32F}));
            return [target](Backend& to) {
                to.draw({.program = &kFill,
                         .targets = {&target, 1},
                         .uniforms = asUniforms(FillBlock{{5, 0, 0, 0}, {}})});
            };
        });
        graph.keep(target);
        return target;
    }

    /// A pass with side effects that declares nothing.
    template <class Execute>
    base::Status runSloppy(Execute execute)
    {
        addPass(
            graph, "sloppy", [](FrameGraph::Builder& builder) { builder.sideEffect(); }, execute);
        return runGraph();
    }

    void expectMessage(const base::Status& status, base::Code code, std::initializer_list<const char*> words)
    {
        EXPECT_EQ(status.code(), code) << status.message();
        for (const char* word : words)
            EXPECT_NE(status.message().find(word), std::string::npos)
                << "'" << word << "' in: " << status.message();
    }

    void expectNextFrameWorks()
    {
        device->gl.monitor.hook = nullptr;
        const ResourceId target = declareFill();
        ASSERT_TRUE(runGraph().ok()) << backend->status().message();
        EXPECT_EQ(read(target, 1), std::vector<float>(16, 5.0f));
    }

    /// Swallows one function, whose result is then zero.
    void swallow(const char* function)
    {
        device->gl.monitor.hook = [function](const char* name) { return std::strcmp(name, function) != 0; };
    }
};

TEST_F(GlFaultsTest, anIncompleteFramebufferNamesThePass)
{
    declareFill();
    swallow("glCheckNamedFramebufferStatus");
    expectMessage(runGraph(), base::Code::GlFailed, {"filler", "incomplete"});
    EXPECT_EQ(backend->drawCalls(), 0u);
    expectNextFrameWorks();
}

TEST_F(GlFaultsTest, aTextureThatIsNotRenderableIsSaidSo)
{
    auto host = GlTexture::create(*device, 4, 4, GL_RGB9_E5, "host");
    ASSERT_TRUE(host.ok());
    const ResourceId imported = graph.importTexture({"host", 4, 4, Format::RGBA32F}, host->name());
    ResourceId written;
    graph.addPass("filler", [&](FrameGraph::Builder& builder) {
        written = builder.write(imported);
        return [written](Backend& to) {
            to.draw({.program = &kFill, .targets = {&written, 1}, .uniforms = asUniforms(FillBlock{})});
        };
    });
    graph.keep(written);
    EXPECT_EQ(runGraph().code(), base::Code::GlFailed);
    host = base::Status(base::Code::Internal, "released");
    expectNextFrameWorks();
}

TEST_F(GlFaultsTest, aProgramThatDoesNotCompileStopsTheFrameWithItsLog)
{
    static constexpr ProgramDesc kBroken = {"broken", "fullscreen.vert", "broken.frag", nullptr, nullptr};
    ResourceId target;
    graph.addPass("filler", [&](FrameGraph::Builder& builder) {
        target = builder.write(builder.create(TextureDesc{"target", 4, 4, Format::RGBA32F}));
        return [target](Backend& to) {
            to.draw({.program = &kBroken, .targets = {&target, 1}});
            to.draw({.program = &kFill, .targets = {&target, 1}, .uniforms = asUniforms(FillBlock{})});
        };
    });
    graph.keep(target);
    expectMessage(runGraph(), base::Code::GlFailed, {"broken", "thisIsNoFunction"});
    EXPECT_EQ(backend->drawCalls(), 0u);
    expectNextFrameWorks();
    expectedMessages = messages->serious(); // the driver reports the shader as well
}

TEST_F(GlFaultsTest, aSizeThatNoTextureCanHaveIsRefusedBeforeDrawing)
{
    declareFill(device->limits().textureSize + 1);
    expectMessage(runGraph(), base::Code::InvalidArgument, {"pixels"});
    expectNextFrameWorks();
}

TEST_F(GlFaultsTest, texturesThatDoNotFitIntoMemoryGiveOutOfMemory)
{
    declareFill();
    int errors = 0;
    device->gl.monitor.hook = [&](const char* name) {
        errors += std::strcmp(name, "glTextureStorage2D") == 0;
        return true;
    };
    const auto texture =
        GlTexture::create(*device, 16384, 16384, GL_RGBA32F, "huge"); // 4 GiB: more than llvmpipe takes
    if (texture.ok())
        GTEST_SKIP() << "this driver has memory for 4 GiB in one texture";
    EXPECT_EQ(errors, 1);
    expectMessage(texture.status(), base::Code::OutOfMemory, {"huge", "16384x16384", "out of memory"});
    expectedMessages = messages->serious();
    expectNextFrameWorks();
}

TEST_F(GlFaultsTest, aLostContextIsNoticedBeforeAnythingIsDrawn)
{
    struct Loss
    {
        GlLoader inner;
        static GLenum APIENTRY lost() { return GL_CONTEXT_LOST; }
    } loss{context->loader()};
    const GlLoader loader{&loss, [](void* user, const char* name) -> void* {
                              if (std::strcmp(name, "glGetError") == 0)
                                  return reinterpret_cast<void*>(&Loss::lost);
                              const GlLoader& inner = static_cast<Loss*>(user)->inner;
                              return inner.getProcAddress(inner.user, name);
                          }};
    auto lostDevice = GlDevice::create(loader, std::pmr::get_default_resource());
    ASSERT_TRUE(lostDevice.ok());
    GlBackend lostBackend(**lostDevice, std::pmr::get_default_resource());
    declareFill();
    graph.compile();
    const base::Status status = lostBackend.beginFrame(graph);
    expectMessage(status, base::Code::GlLost, {"context is lost"});
    EXPECT_TRUE((*lostDevice)->isLost());
    const uint64_t calls = (*lostDevice)->callCount();
    graph.execute(lostBackend);
    EXPECT_EQ(lostBackend.drawCalls(), 0u);
    EXPECT_EQ((*lostDevice)->callCount(), calls);
}

TEST_F(GlFaultsTest, touchingAnUndeclaredResourceNamesPassAndResource)
{
    ResourceId undeclared;
    graph.addPass("culled", [&](FrameGraph::Builder& builder) {
        undeclared = builder.write(builder.create(TextureDesc{"secret", 4, 4, Format::RGBA32F}));
        return [](Backend&) {};
    });
    expectMessage(runSloppy([undeclared](Backend& to) {
                      to.clear(undeclared, {0, 0, 0, 0});
                  }),
                  base::Code::Internal, {"sloppy", "secret"});
    expectNextFrameWorks();
}

TEST_F(GlFaultsTest, handlesOfNoResourceAreRefusedByEveryOperation)
{
    const auto refused = [this](auto operation) {
        graph.begin();
        const base::Status status = runSloppy(operation);
        expectMessage(status, base::Code::Internal, {"sloppy"});
    };
    refused([](Backend& to) { to.clear({}, {0, 0, 0, 0}); });
    refused([](Backend& to) { to.upload({}, asUniforms(FillBlock{})); });
    refused([](Backend& to) { to.copyTexture({}, {}); });
    refused([](Backend& to) { to.draw({.program = &kFill}); });
    refused([](Backend& to) { to.draw({}); });
    refused([](Backend& to) { to.dispatch({}); });
    expectNextFrameWorks();
}

TEST_F(GlFaultsTest, aGraphThatIsWrongIsNotExecuted)
{
    graph.begin();
    graph.keep({});
    expectMessage(runGraph(), base::Code::Internal, {"keep"});
    expectNextFrameWorks();
}

TEST_F(GlFaultsTest, aUniformBlockBeyondTheLimitIsRefused)
{
    static std::array<std::byte, size_t(1) << 20> huge{};
    ResourceId target;
    graph.addPass("filler", [&](FrameGraph::Builder& builder) {
        target = builder.write(builder.create(TextureDesc{"target", 4, 4, Format::RGBA32F}));
        return [target](Backend& to) {
            to.draw({.program = &kFill, .targets = {&target, 1}, .uniforms = huge});
        };
    });
    graph.keep(target);
    expectMessage(runGraph(), base::Code::TooLarge, {"filler", "1048576"});
    expectNextFrameWorks();
}

namespace {

/// A driver whose uniform blocks must start at multiples of 256 bytes, and what was bound in it.
struct StrictDriver
{
    static inline GlLoader inner;
    static inline std::vector<GLintptr> offsets;

    static void APIENTRY getInteger(GLenum what, GLint* value)
    {
        reinterpret_cast<PFNGLGETINTEGERVPROC>(inner.getProcAddress(inner.user, "glGetIntegerv"))(what,
                                                                                                  value);
        if (what == GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT)
            *value = 256;
    }
    static void APIENTRY bindRange(GLenum target, GLuint, GLuint, GLintptr offset, GLsizeiptr)
    {
        if (target == GL_UNIFORM_BUFFER)
            offsets.push_back(offset);
    }
    static void* find(void*, const char* name)
    {
        if (std::strcmp(name, "glGetIntegerv") == 0)
            return reinterpret_cast<void*>(&getInteger);
        if (std::strcmp(name, "glBindBufferRange") == 0)
            return reinterpret_cast<void*>(&bindRange);
        return inner.getProcAddress(inner.user, name);
    }
};

} // namespace

TEST_F(GlFaultsTest, uniformBlocksStartWhereAStrictDriverWantsThem)
{
    StrictDriver::inner = context->loader();
    StrictDriver::offsets.clear();
    auto strict = GlDevice::create({nullptr, &StrictDriver::find}, std::pmr::get_default_resource());
    ASSERT_TRUE(strict.ok());
    GlUniformRing ring(**strict);
    const std::array<std::byte, 300> bytes{};
    for (const size_t size : {16u, 300u, 1u, 256u, 40u})
        ASSERT_TRUE(ring.bind(std::span(bytes).first(size)).ok());
    EXPECT_EQ(StrictDriver::offsets, (std::vector<GLintptr>{0, 256, 768, 1024, 1280}));
}

/// Every single GL call of a first frame fails to happen once, as an out-of-memory driver might do.
TEST_F(GlFaultsTest, noSwallowedCallCrashesOrSpoilsLaterFrames)
{
    const int wanted = 400;
    for (int fault = 0; fault < wanted; ++fault) {
        backend = std::make_unique<GlBackend>(*device, std::pmr::get_default_resource());
        device->forgetPrograms();
        int call = 0;
        bool happened = false;
        device->gl.monitor.hook = [&](const char*) {
            const bool swallowed = call++ == fault;
            happened |= swallowed;
            return !swallowed;
        };
        declareFill();
        (void)runGraph();
        device->gl.monitor.hook = nullptr;
        backend = std::make_unique<GlBackend>(*device, std::pmr::get_default_resource());
        device->forgetPrograms();
        expectNextFrameWorks();
        if (HasFailure() || !happened)
            break;
        ASSERT_LT(fault, wanted - 1) << "the frame makes more calls than were tried";
    }
    expectedMessages = messages->serious();
}

} // namespace fx::render
