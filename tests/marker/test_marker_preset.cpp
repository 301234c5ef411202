// Both halves of a technique join through the lists alone: a preset with its member is loaded, simulated and
// drawn by the public functions.
#include "fxsdk/api/context.h"
#include "fxsdk/fxsdk.h"
#include "fxsdk/presets/preset_loader.h"
#include "fxsdk/presets/schema_assembly.h"
#include "rendering/gl/gl_messages.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/platform/gl_context.h"
#include "tests/api/api_fixture.h"
#include "tests/marker/marker_preset.h"
#include "tests/marker/marker_solver.h"
#include "tests/marker/marker_technique.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>

using namespace fx;

namespace {

constexpr int kSize = 64; ///< [pixel]

/// The built-in techniques and markers, one entry more in the list of each half.
struct Lists
{
    Lists()
    {
        const auto presetsBuiltIn = preset::techniques();
        presets.assign(presetsBuiltIn.begin(), presetsBuiltIn.end());
        presets.push_back(test::kMarkerPreset);
        const auto drawsBuiltIn = render::drawTechniques();
        draws.assign(drawsBuiltIn.begin(), drawsBuiltIn.end());
        draws.push_back(&test::kMarkerTechnique);
    }
    api::TechniqueLists all() const { return {presets, draws}; }

    std::vector<preset::Technique> presets;
    std::vector<const render::DrawTechnique*> draws;
};

/// A marker of a side of 2 m at the origin that emits an exposed light of 0.5.
std::string markerText(const std::string& more = "")
{
    return R"({"version": 1, "ground": false, "markers": [
        {"side": 2, "luminance": [4915.2, 4915.2, 4915.2])" +
           more + "}]}"; // 0.5 * 1.2 * 2^13
}

base::Result<preset::LoadedPreset> load(const std::string& text, preset::Techniques techniques)
{
    return preset::loadPresetText(text, "markers", nullptr, nullptr, {}, {}, techniques);
}

/// A host with a picture, and a context with markers.
class MarkerHost : public testing::Test
{
protected:
    MarkerHost()
    {
        auto context = render::createEglContext({.debug = true});
        if (!context)
            throw std::runtime_error(context.status().message());
        gl_ = std::move(*context);
        host_ = std::move(*render::GlDevice::create(gl_->loader(), std::pmr::get_default_resource()));
        messages_ = std::make_unique<render::GlMessages>(*host_);
        color_ = std::move(*render::GlTexture::create(*host_, kSize, kSize, GL_RGBA32F, "host"));
        FxContextDef def = fxDefaultContextDef();
        def.workers = 1;
        def.gl = {gl_->loader().user, gl_->loader().getProcAddress};
        EXPECT_TRUE(api::createContext(def, lists_.all(), &context_).ok());
        context_->device->setSourceOverride(test::markerSource);
        const FxSceneDef sceneDef = fxDefaultSceneDef();
        EXPECT_EQ(fxCreateScene(context_, &sceneDef, &scene_), FX_OK);
        FxViewSettings settings = fxDefaultViewSettings();
        settings.dazzle = 0;
        settings.exposureEv100 = 13.0f;
        EXPECT_EQ(fxCreateView(context_, scene_, &settings, &view_), FX_OK) << fxGetLastErrorMessage();
    }
    ~MarkerHost() override
    {
        EXPECT_EQ(fxDestroyContext(context_), FX_OK) << fxGetLastErrorMessage();
        EXPECT_EQ(messages_->serious(), 0u) << messages_->first();
    }

    void add(const std::string& text)
    {
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = test::loadText(context_, text);
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK) << fxGetLastErrorMessage();
    }
    void update(int frames)
    {
        for (int i = 0; i < frames; ++i)
            EXPECT_EQ(fxScene_Update(scene_, test::kFrame), FX_OK) << fxGetLastErrorMessage();
    }
    /// RGBA of a frame whose camera stands 10 m before the origin and sees 90 degrees.
    std::vector<float> draw()
    {
        const float black[4] = {0, 0, 0, 1};
        host_->gl.ClearTexImage(color_.name(), 0, GL_RGBA, GL_FLOAT, black);
        FxFrameDef def = fxDefaultFrameDef();
        def.origin[2] = 10.0;
        const float nearPlane = 0.1f, farPlane = 100.0f;
        def.projection[0] = def.projection[5] = 1.0f;
        def.projection[10] = (farPlane + nearPlane) / (nearPlane - farPlane);
        def.projection[11] = -1.0f;
        def.projection[14] = 2.0f * farPlane * nearPlane / (nearPlane - farPlane);
        def.projection[15] = 0.0f;
        def.colorTexture = color_.name();
        def.width = def.height = kSize;
        EXPECT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
        return render::readTexture(*host_, color_.name(), kSize, kSize, 4);
    }
    static float redAt(const std::vector<float>& picture, int x, int y)
    {
        return picture[size_t(y * kSize + x) * 4];
    }

    Lists lists_;
    std::unique_ptr<render::GlContext> gl_;
    std::unique_ptr<render::GlDevice> host_;
    std::unique_ptr<render::GlMessages> messages_;
    render::GlTexture color_;
    FxContext* context_ = nullptr;
    FxScene* scene_ = nullptr;
    FxView* view_ = nullptr;
};

} // namespace

TEST_F(MarkerHost, loadsAPresetWithTheMemberAndDrawsIt)
{
    add(markerText());
    update(2);
    const std::vector<float> picture = draw();
    EXPECT_NEAR(redAt(picture, kSize / 2, kSize / 2), 0.5f, 1e-3f);
    EXPECT_EQ(redAt(picture, 2, 2), 0.0f);
    FxViewStatistics statistics{};
    statistics.structSize = sizeof statistics;
    EXPECT_EQ(fxView_GetStatistics(view_, &statistics), FX_OK);
    EXPECT_GT(statistics.estimatedFragments, 0u);
}

TEST_F(MarkerHost, drawsItWhereItsSolverHasMovedItTo)
{
    add(markerText(R"(, "rise": 4)"));
    update(61); // 4 m up: 13 pixels
    const std::vector<float> picture = draw();
    EXPECT_EQ(redAt(picture, kSize / 2, kSize / 2), 0.0f);
    EXPECT_NEAR(redAt(picture, kSize / 2, kSize / 2 + 13), 0.5f, 1e-3f);
}

TEST(MarkerPreset, isRefusedWhereItsTechniqueIsNotInTheList)
{
    EXPECT_TRUE(load(markerText(), Lists().presets).ok());
    const auto refused = load(markerText(), preset::techniques());
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.status().message().find("unknown member \"markers\""), std::string::npos)
        << refused.status().message();
}

TEST(MarkerPreset, itsSchemaChecksItsMembersAndItsWarningsAreGiven)
{
    const Lists lists;
    const auto wrong = load(R"({"version": 1, "markers": [{"side": -1}]})", lists.presets);
    ASSERT_FALSE(wrong.ok());
    EXPECT_NE(wrong.status().message().find("/markers/0/side: found -1; allowed is a number"),
              std::string::npos)
        << wrong.status().message();
    const auto black = load(R"({"version": 1, "markers": [{"luminance": [0, 0, 0]}]})", lists.presets);
    ASSERT_TRUE(black.ok()) << black.status().message();
    ASSERT_EQ(black->warnings.size(), 1u);
    EXPECT_EQ(black->warnings[0].pointer, "/markers/0/luminance");
}

TEST(MarkerPreset, itsCostIsThatOfItsSolver)
{
    const auto loaded = load(markerText(), Lists().presets);
    ASSERT_TRUE(loaded.ok()) << loaded.status().message();
    EXPECT_DOUBLE_EQ(loaded->effect->cost.stepWork, 1.0);
    EXPECT_TRUE(loaded->effect->publishes(test::kMarkerKind));
    EXPECT_FALSE(loaded->effect->bendsLight());
}

TEST(MarkerPreset, itsElementsAreInTheSchemaBesideTheBuiltInOnes)
{
    const auto schema = preset::presetSchema(Lists().presets);
    const auto builtIn = preset::presetSchema();
    EXPECT_EQ(schema["properties"].size(), builtIn["properties"].size() + 1);
    EXPECT_EQ(schema["properties"]["markers"]["items"]["properties"]["side"]["default"], 1);
}
