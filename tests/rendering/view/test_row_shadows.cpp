// Sprites, ribbons and meshes in the shadow of media, and the shadow that they cast themselves: against
// optical depths in closed form.
#include "particle_fixture.h"

#include "rendering/frame/exposure.h"
#include "rendering/lights/slices/slice_depths.h"
#include "rendering/particle_rows/row_casters.h"
#include "rendering/techniques/draw_techniques.h"
#include "tests/rendering/gl/heap_counter.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace fx;
using namespace fx::test;
using render::MediumCaster;
namespace constant = base::particle_constant;

namespace {

constexpr int kSide = 100; ///< [pixel] 10 a metre with flatCamera()
constexpr float kPerBall = 0.25f / std::numbers::pi_v<float>;
constexpr float kThin = 0.02f; ///< opacity of a sprite that hardly shades itself

const render::RowTechnique* const kTechniques[] = {render::kSpriteTechnique.rows,
                                                   render::kRibbonTechnique.rows};

class RowShadows : public ParticleTest
{
protected:
    void SetUp() override
    {
        ParticleTest::SetUp();
        makeTargets(kSide, kSide);
        white_ = float(*assets_.addImage(4, 4, true, std::vector<uint8_t>(4 * 4 * 4, 255)));
        render::ViewSettings& settings = view_->settings();
        settings.lighting.sunDirection = {0.0f, 1.0f, 0.0f};
        settings.lighting.sunIlluminance = glm::vec3(1.0f / render::exposureFromEv100(kEv100));
        settings.lighting.groundAlbedo = 0.0f;
        settings.slices.multiple = false;
        settings.slices.resolution = {128, 64};
    }

    /// Makes a group scatter all of the view's light, and emit nothing.
    void light(base::SnapshotGroup& group)
    {
        set(group, constant::Texture, white_);
        set(group, constant::Luminance, 0.0f);
        set(group, constant::Lit, 1.0f);
    }
    /// A black ball of medium with an optical depth through its middle.
    void addBall(base::FrameSnapshot& snapshot, const glm::vec3& center, float radius, float depth)
    {
        namespace column = base::blob_column;
        auto& group = snapshot.addGroup(schema_.find("blob"), 1);
        for (size_t c = 0; c < column::Count; ++c)
            group.editColumn(c)[0] = 0.0f;
        for (size_t k = 0; k < 3; ++k)
            group.editColumn(column::PositionX + k)[0] = center[int(k)];
        group.editColumn(column::Radius)[0] = radius;
        group.editColumn(column::CrossSection)[0] = render::crossSectionOfDepth(depth, radius);
        group.editIds()[0] = 0;
        group.editInfo().count = 1;
        group.editInfo().solver = 1;
        group.editConstants()[base::blob_constant::Layer] = 1.0f;
    }
    Picture draw(const base::FrameSnapshot& snapshot)
    {
        setPicture(std::vector<float>(size_t(kSide) * kSide * 4, 0.0f));
        return renderPair(snapshot, nullptr, 1.0, flatCamera());
    }
    static float at(const Picture& picture, float x, float y)
    {
        return picture.at(int(50.0f + 10.0f * x), int(50.0f + 10.0f * y))[1];
    }

    std::pmr::vector<MediumCaster> castersOf(const base::FrameSnapshot& newer,
                                             const base::FrameSnapshot* older = nullptr, double t = 1.0)
    {
        const base::SnapshotPair pair{&newer, older};
        std::pmr::vector<MediumCaster> casters;
        render::gatherRowCasters({&pair, kTechniques, t, glm::dvec3(0.0)}, casters);
        return casters;
    }
    static double sectionOf(std::span<const MediumCaster> casters)
    {
        double sum = 0.0;
        for (const MediumCaster& caster : casters)
            sum += double(caster.crossSection);
        return sum;
    }
    /// Of all casters on the line along -y through a point.
    static float depthOnLine(std::span<const MediumCaster> casters, const glm::vec3& point)
    {
        render::SliceStack stack;
        EXPECT_TRUE(render::fitParallelSlices({0, 1, 0}, casters, glm::dvec3(0.0), {128, 32}, stack));
        render::SliceDepths depths(std::pmr::get_default_resource());
        depths.build(stack, casters);
        return depths.depthAt(point).total;
    }
    float white_ = 0.0f;
};

} // namespace

TEST_F(RowShadows, aThinSpriteIsLitByWhatABallBetweenItAndTheSunLeaves)
{
    for (const float depth : {0.5f, 1.0f, 8.0f}) {
        auto snapshot = emptySnapshot();
        addBall(snapshot, {0, 1, 0}, 1.0f, depth);
        const glm::vec4 thin(1.0f, 1.0f, 1.0f, kThin);
        light(addParticles(snapshot,
                           {{{0, 3, 0}, 0.2f, thin}, {{0, -2, 0}, 0.2f, thin}, {{3, -2, 0}, 0.2f, thin}}));
        const Picture picture = draw(snapshot);
        const float open = kPerBall * kThin;
        EXPECT_NEAR(at(picture, 0, 3), open, 0.03f * open) << "before the ball";
        EXPECT_NEAR(at(picture, 3, -2), open, 0.03f * open) << "beside its shadow";
        EXPECT_NEAR(at(picture, 0, -2), open * std::exp(-depth), 0.03f * open) << "behind it";
    }
}

TEST_F(RowShadows, withoutSlicesNothingIsShaded)
{
    view_->settings().slices.enabled = false;
    auto snapshot = emptySnapshot();
    addBall(snapshot, {0, 1, 0}, 1.0f, 8.0f);
    light(addParticles(snapshot, {{{0, -2, 0}, 1.0f}}));
    EXPECT_NEAR(at(draw(snapshot), 0, -2), kPerBall, 1e-5f);
}

TEST_F(RowShadows, aRibbonIsDarkWhereABallShadesIt)
{
    auto snapshot = emptySnapshot();
    addBall(snapshot, {0, 1, 0}, 1.0f, 8.0f);
    std::vector<TestPoint> points;
    for (int i = 0; i <= 40; ++i)
        points.push_back({{4.0f - 0.2f * float(i), -2.0f, 0.0f}, 0.3f, 0.0f, {1, 1, 1, kThin}});
    light(addRibbon(snapshot, points));
    const Picture picture = draw(snapshot);
    const float open = kPerBall * kThin;
    EXPECT_NEAR(at(picture, 3, -2), open, 0.05f * open);
    EXPECT_NEAR(at(picture, -3, -2), open, 0.05f * open);
    EXPECT_LT(at(picture, 0, -2), 0.02f * open);
}

TEST_F(RowShadows, whatHidesDoesNotShadeItselfButIsShaded)
{
    // squares across the sun's way: each casts a shadow as dense as any
    for (const float depth : {0.0f, 1.0f, 8.0f}) {
        auto snapshot = emptySnapshot();
        addBall(snapshot, {0, 2, 0}, 1.0f, std::max(depth, 1e-6f));
        auto& group = addParticles(snapshot, {{{0, -2, 0}, 0.5f}});
        light(group);
        set(group, constant::Blend, float(base::ParticleBlend::Opaque));
        EXPECT_NEAR(at(draw(snapshot), 0, -2), kPerBall * std::exp(-depth), 0.03f * kPerBall) << depth;
    }
}

TEST_F(RowShadows, aSolidMeshIsMattInWhatABallLeavesOfTheSun)
{
    const glm::vec3 n(0, 0, 1);
    const std::vector<base::MeshVertex> corners{
        {{-1, -1, 0}, n, {0, 0}}, {{1, -1, 0}, n, {1, 0}}, {{1, 1, 0}, n, {1, 1}}, {{-1, 1, 0}, n, {0, 1}}};
    const float mesh = float(*assets_.addMesh(corners, std::vector<uint32_t>{0, 1, 2, 0, 2, 3}));
    view_->settings().lighting.sunDirection = {0.0f, 0.8f, 0.6f};
    for (const float depth : {0.0f, 1.0f, 8.0f}) {
        auto snapshot = emptySnapshot();
        addBall(snapshot, {0, -2.0f + 0.8f * 4.0f, 0.6f * 4.0f}, 1.5f, std::max(depth, 1e-6f));
        auto& group = addParticles(snapshot, {{{0, -2, 0}, 0.3f}});
        light(group);
        set(group, constant::Shape, float(base::ParticleShape::Mesh));
        set(group, constant::Mesh, mesh);
        set(group, constant::Blend, float(base::ParticleBlend::Opaque));
        const float open = 0.6f / std::numbers::pi_v<float>;
        EXPECT_NEAR(at(draw(snapshot), 0, -2), open * std::exp(-depth), 0.03f * open) << depth;
    }
}

TEST_F(RowShadows, aThickSpriteHasABrightAndADarkSide)
{
    auto snapshot = emptySnapshot();
    light(addParticles(snapshot, {{{0, 0, 0}, 3.0f, {1, 1, 1, 0.9f}}}));
    const Picture picture = draw(snapshot);
    EXPECT_GT(at(picture, 0, 2.9f), 1.8f * at(picture, 0, -2.9f)) << "the sun stands above";
    view_->settings().lighting.sunDirection = {1.0f, 0.0f, 0.0f};
    const Picture turned = draw(snapshot);
    EXPECT_GT(at(turned, 2.9f, 0), 1.8f * at(turned, -2.9f, 0));
}

TEST_F(RowShadows, theSkyIsDarkerUnderABallAndAsBrightInAFurnace)
{
    render::ViewSettings& settings = view_->settings();
    settings.lighting.sunIlluminance = glm::vec3(0.0f);
    settings.lighting.skyLuminance = glm::vec3(0.5f / render::exposureFromEv100(kEv100));
    const auto seen = [&](float depth, base::ParticleBlend blend) {
        auto snapshot = emptySnapshot();
        addBall(snapshot, {0, 0.5f, 0}, 2.0f, depth);
        auto& group = addParticles(snapshot, {{{0, -2.2f, 0}, 0.3f}});
        light(group);
        set(group, constant::Blend, float(blend));
        return at(draw(snapshot), 0, -2.2f);
    };
    for (const auto blend : {base::ParticleBlend::Alpha, base::ParticleBlend::Opaque})
        EXPECT_LT(seen(8.0f, blend), 0.9f * seen(1e-6f, blend)) << int(blend);
    EXPECT_NEAR(seen(1e-6f, base::ParticleBlend::Opaque), 0.25f, 1e-3f) << "half of it is ground";
    settings.lighting.groundAlbedo = 1.0f;
    settings.slices.multiple = true;
    EXPECT_NEAR(seen(1e-6f, base::ParticleBlend::Alpha), 0.5f, 1e-3f)
        << "what scatters all light is as bright as what surrounds it, however thick it is";
}

TEST_F(RowShadows, halfOfTheLightPassesTheMiddleOfASpriteOfHalfTheOpacity)
{
    auto snapshot = emptySnapshot();
    addParticles(snapshot, {{{0, 2, 0}, 1.0f, {1, 1, 1, 0.5f}}});
    const auto casters = castersOf(snapshot);
    ASSERT_EQ(casters.size(), 1u);
    EXPECT_EQ(casters[0].radius, 1.0f);
    EXPECT_NEAR(depthOnLine(casters, {0, -1, 0}), std::log(2.0f), 0.05f * std::log(2.0f));

    auto& thin = addParticles(snapshot, {{{0, -2, 0}, 0.2f, {1, 1, 1, kThin}}});
    light(thin);
    const float open = kPerBall * kThin;
    EXPECT_NEAR(at(draw(snapshot), 0, -2), 0.5f * open, 0.05f * 0.5f * open);
}

TEST_F(RowShadows, aRibbonHasItsOpticalDepthInTheMiddle)
{
    std::vector<TestPoint> points;
    for (int i = 0; i <= 80; ++i)
        points.push_back({{4.0f - 0.1f * float(i), 0.0f, 0.0f}, 0.5f, 0.0f, {1, 1, 1, 0.5f}});
    auto snapshot = emptySnapshot();
    addRibbon(snapshot, points);
    EXPECT_NEAR(depthOnLine(castersOf(snapshot), {0, -1, 0}), std::log(2.0f), 0.05f * std::log(2.0f));
}

TEST_F(RowShadows, whatAddsCastsNoShadowAndWhatHidesANearlyBlackOne)
{
    for (const auto blend :
         {base::ParticleBlend::Alpha, base::ParticleBlend::Additive, base::ParticleBlend::Opaque})
    {
        auto snapshot = emptySnapshot();
        set(addParticles(snapshot, {{{0, 0, 0}, 1.0f, {1, 1, 1, 0.75f}}, {{3, 0, 0}, 0.0f}}), constant::Blend,
            float(blend));
        set(addRibbon(snapshot, {{{4, 4, 0}, 0.5f}, {{3, 4, 0}, 0.5f}}), constant::Blend, float(blend));
        const auto casters = castersOf(snapshot);
        if (blend == base::ParticleBlend::Additive) {
            EXPECT_TRUE(casters.empty());
            continue;
        }
        ASSERT_EQ(casters.size(), 2u) << "the row of radius 0 is empty";
        const float passing = blend == base::ParticleBlend::Alpha ? 0.25f : 0.001f;
        EXPECT_NEAR(casters[0].crossSection, render::crossSectionOfDepth(-std::log(passing), 1.0f), 1e-4f);
    }
}

TEST_F(RowShadows, aStretchOfRowsKeepsItsCrossSectionAndItsVolume)
{
    std::mt19937 random(3);
    const auto uniform = [&] { return float(random() % 1000) * 1e-3f; };
    std::vector<TestParticle> particles(5000);
    double expected = 0.0;
    for (size_t i = 0; i < particles.size(); ++i) {
        TestParticle& p = particles[i];
        p.center = {uniform(), uniform(), uniform()};
        p.radius = i % 7 == 0 ? 0.0f : 0.01f;
        p.color.a = 0.25f * float(1 + i % 3);
        expected += double(render::crossSectionOfDepth(-std::log(1.0f - p.color.a), p.radius));
    }
    auto snapshot = emptySnapshot();
    addParticles(snapshot, particles);
    const auto casters = castersOf(snapshot);
    EXPECT_LE(casters.size(), render::kMaxGroupCasters);
    EXPECT_GE(casters.size(), render::kMaxGroupCasters / 2);
    EXPECT_NEAR(sectionOf(casters), expected, 1e-4 * expected);
    double volume = 0.0;
    for (const MediumCaster& caster : casters)
        volume += std::pow(double(caster.radius), 3.0);
    EXPECT_NEAR(volume, 5000.0 * 6 / 7 * 1e-6, 0.6 * 5000.0 * 6 / 7 * 1e-6)
        << "by the rows that stand for all";

    std::vector<TestPoint> points;
    for (int i = 0; i <= 3000; ++i)
        points.push_back({{0.001f * float(i), 0.0f, 0.0f}, 0.05f, 0.0f, {1, 1, 1, 0.5f}});
    auto strip = emptySnapshot();
    addRibbon(strip, points);
    const double area = 0.05 * 3.0 * 32.0 / 35.0 * std::log(2.0);
    EXPECT_LE(castersOf(strip).size(), render::kMaxGroupCasters);
    EXPECT_NEAR(sectionOf(castersOf(strip)), area, 1e-3 * area);
}

TEST_F(RowShadows, manyGroupsShareTheMostCasters)
{
    auto snapshot = emptySnapshot();
    const std::vector<TestParticle> particles(300, {{0, 0, 0}, 0.5f, {1, 1, 1, 0.5f}});
    for (int i = 0; i < 100; ++i)
        addParticles(snapshot, particles);
    const auto casters = castersOf(snapshot);
    EXPECT_LE(casters.size(), render::kMaxRowCasters);
    EXPECT_GE(casters.size(), 100u * render::kMinGroupCasters);
    const double section = 30000.0 * double(render::crossSectionOfDepth(std::log(2.0f), 0.5f));
    EXPECT_NEAR(sectionOf(casters), section, 1e-4 * section);
}

TEST_F(RowShadows, castersMoveBetweenSnapshots)
{
    TestParticle p{{0, 0, 0}, 0.5f, glm::vec4(1.0f), 10.0f, {60.0f, 0.0f, 0.0f}};
    auto older = emptySnapshot(0.0);
    addParticles(older, {p, p});
    p.center.x = 1.0f;
    TestParticle born = p;
    born.age = 0.25f / 60.0f;
    auto newer = emptySnapshot(1.0 / 60.0);
    addParticles(newer, {p, born});
    const auto half = castersOf(newer, &older, 0.5);
    ASSERT_EQ(half.size(), 1u) << "the second is not yet born";
    EXPECT_NEAR(half[0].center.x, 0.5f, 1e-5f);
    const auto late = castersOf(newer, &older, 0.875);
    ASSERT_EQ(late.size(), 2u);
    EXPECT_NEAR(late[0].center.x, 0.875f, 1e-5f);
    EXPECT_NEAR(late[1].center.x, 1.0f - 0.125f, 1e-4f) << "on its way since it was born";
}

TEST_F(RowShadows, ballsThatTexelsCouldMissBecomeWiderWithTheSameCrossSection)
{
    std::pmr::vector<MediumCaster> casters{{{0, 0, 0}, 0.01f, 0.5f}, {{20, 0, 0}, 1.0f, 2.0f}};
    render::widenCasters(casters, casters, 128);
    EXPECT_NEAR(casters[0].radius, 21.01f * 1.5f / 128.0f, 1e-4f);
    EXPECT_EQ(casters[0].crossSection, 0.5f);
    EXPECT_EQ(casters[1].radius, 1.0f);
}

TEST_F(RowShadows, aRestingFrameKeepsItsPlanesAndAWarmOneAllocatesNothing)
{
    ASSERT_TRUE(view_->warmUp().ok());
    const auto scene = [this](float x) {
        auto snapshot = emptySnapshot();
        addBall(snapshot, {x, 1, 0}, 1.0f, 1.0f);
        light(addParticles(snapshot, std::vector<TestParticle>(300, {{x, -2, 0}, 0.2f})));
        light(addRibbon(snapshot, {{{x, 4, 0}, 0.5f}, {{3, 4, 0}, 0.5f}}));
        return snapshot;
    };
    const auto a = scene(0.0f), b = scene(0.5f);
    const auto hasSlices = [this] {
        return std::ranges::find(view_->executedPasses(), "light slices") != view_->executedPasses().end();
    };
    for (const auto* snapshot : {&a, &b, &a})
        (void)draw(*snapshot);
    EXPECT_TRUE(hasSlices());
    (void)draw(a);
    EXPECT_TRUE(view_->statistics().keptLists);
    EXPECT_FALSE(hasSlices());

    render::FrameRequest request;
    request.camera = flatCamera();
    request.targets.color = color_->name();
    request.targets.width = request.targets.height = kSide;
    const base::SnapshotPair pair{&b, nullptr};
    const render::HeapCounter counter;
    const bool good = view_->render(pair, request).ok();
    EXPECT_EQ(counter.stop(), 0);
    EXPECT_TRUE(good);
    EXPECT_TRUE(hasSlices());
}
