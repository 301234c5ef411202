#include "tests/api/view_fixture.h"

#include <algorithm>
#include <cmath>

namespace fx::test {

namespace {

/// Hot gray particles about the origin, with shimmer: every pass has something to do.
constexpr const char* kFlames = R"({"version": 1, "name": "flames", "ground": false, "emitters": [
    {"layer": "fire", "shape": "sphere", "size": 0.5, "emission": {"rate": 60}, "lifetime": 1, "radius": 0.5,
     "temperature": 1700, "heat": 1, "fireShare": 0.5, "detailAmount": 0.5, "forces": {"gravity": 0}},
    {"layer": "dust", "shape": "sphere", "size": 0.5, "emission": {"rate": 20}, "lifetime": 1, "radius": 0.5,
     "albedoOverLife": [0.5, 0.5, 0.5], "forces": {"gravity": 0}}]})";

render::GlTexture makeTexture(render::GlDevice& device, int size, GLenum format)
{
    auto texture = render::GlTexture::create(device, size, size, format, "host");
    EXPECT_TRUE(texture.ok()) << texture.status().message();
    return std::move(*texture);
}

} // namespace

ViewApiTest::ViewApiTest()
{
    render::GlContextOptions options;
    options.debug = true;
    auto context = render::createEglContext(options);
    if (!context)
        throw std::runtime_error(context.status().message());
    gl_ = std::move(*context);
    auto device = render::GlDevice::create(gl_->loader(), std::pmr::get_default_resource());
    if (!device)
        throw std::runtime_error(device.status().message());
    host_ = std::move(*device);
    messages_ = std::make_unique<render::GlMessages>(*host_);
    color_ = makeTexture(*host_, kSize, GL_RGBA32F);
    depth_ = makeTexture(*host_, kSize, GL_DEPTH_COMPONENT32F);
    const float far = 1.0f;
    host_->gl.ClearTexImage(depth_.name(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, &far);
    fillPicture();

    FxContextDef contextDef = fxDefaultContextDef();
    contextDef.allocator = memory_.hooks();
    contextDef.workers = 1;
    contextDef.gl = {gl_->loader().user, gl_->loader().getProcAddress};
    EXPECT_EQ(fxCreateContext(&contextDef, &context_), FX_OK) << fxGetLastErrorMessage();
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    EXPECT_EQ(fxCreateScene(context_, &sceneDef, &scene_), FX_OK);
    FxInstanceDef instance = fxDefaultInstanceDef();
    instance.preset = loadText(context_, kFlames);
    FxInstanceId id{};
    EXPECT_EQ(fxScene_CreateInstance(scene_, &instance, &id), FX_OK);
    EXPECT_EQ(fxCreateView(context_, scene_, nullptr, &view_), FX_OK) << fxGetLastErrorMessage();
}

ViewApiTest::~ViewApiTest()
{
    EXPECT_EQ(fxDestroyContext(context_), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(memory_.blocks(), 0);
    EXPECT_EQ(messages_->serious(), 0u) << messages_->first();
    EXPECT_EQ(host_->gl.GetError(), GLenum(GL_NO_ERROR));
}

FxFrameDef frameBefore(uint32_t color, uint32_t depth, int side)
{
    FxFrameDef def = fxDefaultFrameDef();
    def.origin[2] = 3.0; // three metres before the flames
    const float nearPlane = 0.1f, farPlane = 100.0f;
    def.projection[0] = def.projection[5] = 1.0f; // 90 degrees
    def.projection[10] = (farPlane + nearPlane) / (nearPlane - farPlane);
    def.projection[11] = -1.0f;
    def.projection[14] = 2.0f * farPlane * nearPlane / (nearPlane - farPlane);
    def.projection[15] = 0.0f;
    def.colorTexture = color;
    def.depthTexture = depth;
    def.width = def.height = side;
    return def;
}

FxFrameDef ViewApiTest::frame() const
{
    return frameBefore(color_.name(), depth_.name(), kSize);
}

void ViewApiTest::warmUp()
{
    EXPECT_EQ(fxContext_WarmUp(context_), FX_OK) << fxGetLastErrorMessage();
}

void ViewApiTest::fillPicture()
{
    const float color[4] = {kBackground, kBackground, kBackground, 1.0f};
    host_->gl.ClearTexImage(color_.name(), 0, GL_RGBA, GL_FLOAT, color);
}

std::vector<float> ViewApiTest::picture()
{
    return render::readTexture(*host_, color_.name(), kSize, kSize, 4);
}

FxViewStatistics ViewApiTest::statistics() const
{
    FxViewStatistics statistics{};
    statistics.structSize = sizeof statistics;
    EXPECT_EQ(fxView_GetStatistics(view_, &statistics), FX_OK) << fxGetLastErrorMessage();
    return statistics;
}

void ViewApiTest::update(int frames)
{
    for (int i = 0; i < frames; ++i)
        EXPECT_EQ(fxScene_Update(scene_, kFrame), FX_OK) << fxGetLastErrorMessage();
}

std::vector<std::string> passNamesOf(FxView* view)
{
    std::vector<std::string> names;
    uint32_t count = 0;
    EXPECT_EQ(fxView_GetPassCount(view, &count), FX_OK);
    for (uint32_t i = 0; i < count; ++i) {
        char name[64];
        EXPECT_EQ(fxView_GetPassName(view, i, name, sizeof name), FX_OK);
        names.push_back(name);
    }
    return names;
}

float largestShownDifference(const std::vector<float>& a, const std::vector<float>& b)
{
    float most = 0.0f;
    for (size_t i = 0; i < a.size(); ++i)
        most = std::max(most, std::abs(std::min(a[i], 1.0f) - std::min(b[i], 1.0f)));
    return most;
}

} // namespace fx::test
