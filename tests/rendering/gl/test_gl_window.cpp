// A hidden window and no window at all are two providers of the same renderer.
#include "gl_test.h"

#include <cmath>
#include <cstdlib>

namespace fx::render {

namespace {

constexpr int kSize = 64;
constexpr ProgramDesc kWave = {"wave", "wave.vert", "wave.frag", nullptr, nullptr};

std::optional<std::string> waveShader(std::string_view name, std::string_view)
{
    if (name == "wave.vert")
        return R"(#version 450 core
layout(location = 0) out vec2 at;
void main()
{
    at = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(at, 0.0, 1.0);
}
)";
    return R"(#version 450 core
layout(location = 0) in vec2 at;
layout(location = 0) out vec4 color;
void main() { color = vec4(exp(-dot(at, at)), sin(9.0 * at.x), sqrt(abs(at.y)), 1.0); }
)";
}

/// Draws the same picture with whatever context is current.
std::vector<float> drawWave(GlContext& context, uint32_t& outSerious)
{
    auto device = GlDevice::create(context.loader(), std::pmr::get_default_resource());
    if (!device) {
        ADD_FAILURE() << device.status().message();
        return {};
    }
    (*device)->setSourceOverride(waveShader);
    GlMessages messages(**device);
    GlBackend backend(**device, std::pmr::get_default_resource());
    FrameGraph graph(std::pmr::get_default_resource());
    graph.begin();
    ResourceId target;
    graph.addPass("wave", [&](FrameGraph::Builder& builder) {
        target = builder.write(builder.create(TextureDesc{"target", kSize, kSize, Format::RGBA32F}));
        return [target](Backend& to) { to.draw({.program = &kWave, .targets = {&target, 1}}); };
    });
    graph.keep(target);
    graph.compile();
    EXPECT_TRUE(backend.beginFrame(graph).ok());
    graph.execute(backend);
    EXPECT_TRUE(backend.endFrame().ok()) << backend.status().message();
    outSerious = messages.serious();
    return readTexture(**device, backend.textureName(target), kSize, kSize, 4);
}

} // namespace

TEST(GlWindow, aHiddenWindowGivesTheSameImageAsNoWindow)
{
    uint32_t serious = 0;
    std::vector<float> windowed;
    {
        auto window = createGlfwContext({.debug = true});
        if (!window) {
            ASSERT_EQ(std::getenv("FX_DISPLAY_REQUIRED"), nullptr) << window.status().message();
            GTEST_SKIP() << window.status().message();
        }
        EXPECT_NE((*window)->description().find("GLFW"), std::string::npos);
        EXPECT_FALSE((*window)->closeRequested());
        windowed = drawWave(**window, serious);
        (*window)->swapBuffers();
        EXPECT_EQ(serious, 0u);
    }
    auto windowless = createEglContext({.debug = true});
    ASSERT_TRUE(windowless.ok()) << windowless.status().message();
    const std::vector<float> expected = drawWave(**windowless, serious);
    EXPECT_EQ(serious, 0u);
    ASSERT_EQ(windowed.size(), expected.size());
    float largest = 0;
    for (size_t i = 0; i < expected.size(); ++i)
        largest = std::max(largest, std::abs(windowed[i] - expected[i]));
    EXPECT_LE(largest, 1e-6f); // zero when both are the same driver
    EXPECT_NEAR(expected[4 * (kSize / 2 * kSize + kSize / 2)], std::exp(-2.0 / (kSize * kSize)), 1e-5);
}

TEST(GlWindow, contextsCanTakeTurnsOnOneThread)
{
    auto first = createEglContext({});
    auto second = createEglContext({});
    ASSERT_TRUE(first.ok() && second.ok());
    uint32_t serious = 0;
    ASSERT_TRUE((*first)->makeCurrent().ok());
    const auto a = drawWave(**first, serious);
    ASSERT_TRUE((*second)->makeCurrent().ok());
    EXPECT_EQ(drawWave(**second, serious), a);
    EXPECT_NE((*first)->description().find("EGL"), std::string::npos);
}

} // namespace fx::render
