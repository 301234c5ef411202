// Which lights of a view get planes, in which order, and where the planes lie in the atlas.
#include "rendering/lights/slices/light_list.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory_resource>
#include <vector>

using namespace fx::render;

namespace {

const std::vector<MediumCaster> kCasters{{{0, 0, 0}, 1.0f, 2.0f}, {{1, 0.5f, 0}, 0.7f, 1.0f}};

class LightListTest : public testing::Test
{
protected:
    void SetUp() override
    {
        settings_.lighting.sunIlluminance = glm::vec3(1e5f);
        settings_.lighting.sunDirection = glm::normalize(glm::vec3(0.3f, 0.8f, 0.5f));
        settings_.lighting.skyLuminance = glm::vec3(1e3f);
    }
    void addHost(const glm::dvec3& position, float intensity, float radius = 0.1f)
    {
        HostLight& light = settings_.hostLights.lights[settings_.hostLights.count++];
        light.position = position;
        light.intensity = glm::vec3(intensity);
        light.radius = radius;
    }
    /// @param resets planes that change their sides do not fade
    void build(bool resets = false) { list_.build({&settings_, eye_, effects_, casters_, resets}); }
    size_t castingLights() const
    {
        size_t count = 0;
        for (const SliceLightBlock& light : list_.lights())
            count += light.tiles.w > 0.0f ? 1 : 0;
        return count;
    }

    ViewSettings settings_;
    glm::dvec3 eye_{0.0};
    std::vector<EffectLight> effects_;
    std::vector<MediumCaster> casters_ = kCasters;
    LightList list_{std::pmr::new_delete_resource()};
};

/// Place of a point in a stack as the shader computes it from the light.
glm::vec3 placeIn(const SliceLightBlock& light, const glm::vec3& p)
{
    return {glm::dot(glm::vec3(light.right), p) + light.right.w,
            glm::dot(glm::vec3(light.up), p) + light.up.w,
            glm::dot(glm::vec3(light.along), p) + light.along.w};
}

} // namespace

TEST_F(LightListTest, theSunComesFirstThenPointsByTheLightThatArrivesThenTheSky)
{
    settings_.slices.castingPoints = 1;
    addHost({30.0, 0.0, 0.0}, 100.0f); // dim where the media are
    addHost({0.0, 3.0, 0.0}, 50.0f);
    effects_ = {{{0.0, 20.0, 0.0}, glm::vec3(1e4f), 0.5f}}; // the brightest of the three
    build();
    ASSERT_EQ(list_.block().counts.x, 4);
    EXPECT_EQ(list_.block().counts.y, int(kSkyAxes));
    EXPECT_EQ(list_.lights()[0].color.w, 0.0f);
    EXPECT_EQ(glm::vec3(list_.lights()[1].place), glm::vec3(0, 20, 0));
    EXPECT_EQ(glm::vec3(list_.lights()[2].place), glm::vec3(0, 3, 0));
    EXPECT_EQ(glm::vec3(list_.lights()[3].place), glm::vec3(30, 0, 0));
    EXPECT_EQ(castingLights(), 2 + kSkyAxes) << "the sun, one point, and the axes of the sky";
    EXPECT_GT(list_.lights()[1].tiles.w, 0.0f);
    EXPECT_EQ(list_.lights()[2].tiles.w, 0.0f);
}

TEST_F(LightListTest, neverMoreLightsThanItHasPlaceFor)
{
    settings_.slices.castingPoints = 4;
    for (size_t i = 0; i < kMaxHostLights; ++i)
        addHost({double(i), 3.0, 0.0}, 100.0f);
    effects_.assign(20, {{0.0, 2.0, 0.0}, glm::vec3(10.0f), 0.5f});
    build();
    constexpr size_t kMax = 1 + kMaxEffectLights + kMaxHostLights;
    EXPECT_EQ(size_t(list_.block().counts.x), kMax);
    EXPECT_EQ(list_.lights().size(), kMax + kSkyAxes);
    EXPECT_EQ(list_.stacks().size(), 1 + 4 + kSkyAxes);
}

TEST_F(LightListTest, withoutMediaOrWithoutSlicesNothingHasPlanes)
{
    addHost({0.0, 3.0, 0.0}, 100.0f);
    settings_.slices.enabled = false;
    build();
    EXPECT_EQ(list_.block().counts.x, 2);
    EXPECT_EQ(list_.block().counts.y, 0);
    EXPECT_TRUE(list_.stacks().empty());
    EXPECT_EQ(list_.atlasWidth() + list_.atlasHeight(), 0);
    settings_.slices.enabled = true;
    casters_.clear();
    build();
    EXPECT_EQ(list_.block().counts.x, 2);
    EXPECT_TRUE(list_.stacks().empty());
}

TEST_F(LightListTest, noTwoStacksShareATexelAndAllLieInTheAtlas)
{
    for (const SliceResolution& size : {SliceResolution{8, 2}, {24, 17}, {64, 9}, {128, 32}, {512, 128}})
        for (int points = 0; points <= 4; ++points) {
            settings_.slices = {true, size, points, 2, true};
            settings_.hostLights.count = 0;
            for (int i = 0; i < points; ++i)
                addHost({double(i), 3.0, 0.0}, 100.0f);
            build(true);
            const auto blocks = list_.stackBlocks();
            ASSERT_EQ(blocks.size(), 1 + size_t(points) + kSkyAxes);
            const auto right = [](const glm::vec4& t) {
                return t.x + t.z * std::min(t.w, float(kSliceTileColumns));
            };
            const auto top = [](const glm::vec4& t) {
                return t.y + t.z * std::ceil(t.w / float(kSliceTileColumns));
            };
            for (size_t i = 0; i < blocks.size(); ++i) {
                const glm::vec4& a = blocks[i].tiles;
                EXPECT_LE(right(a), float(list_.atlasWidth()));
                EXPECT_LE(top(a), float(list_.atlasHeight()));
                EXPECT_LE(int(a.z), list_.mostTexels());
                for (size_t k = 0; k < i; ++k) {
                    const glm::vec4& b = blocks[k].tiles;
                    EXPECT_TRUE(right(a) <= b.x || right(b) <= a.x || top(a) <= b.y || top(b) <= a.y)
                        << i << " and " << k << " of " << size.texels << " x " << size.planes;
                }
            }
            EXPECT_LE(std::max(list_.atlasWidth(), list_.atlasHeight()), 16384) << "what OpenGL 4.5 grants";
        }
}

TEST_F(LightListTest, theShadersPlacesAreThoseOfTheStack)
{
    build();
    const SliceStack& stack = list_.stacks()[0];
    for (const glm::vec3& p : {glm::vec3(0.0f), glm::vec3(1.0f, 0.2f, -0.3f), glm::vec3(-4.0f, 2.0f, 9.0f)}) {
        const SlicePlace place = stack.placeOf(p);
        const glm::vec3 shader = placeIn(list_.lights()[0], p);
        EXPECT_NEAR(shader.x, place.x, 1e-4f);
        EXPECT_NEAR(shader.y, place.y, 1e-4f);
        EXPECT_NEAR(shader.z, place.plane, 1e-4f);
    }
}

TEST_F(LightListTest, planesStayInTheWorldWhileTheEyeMoves)
{
    settings_.slices.castingPoints = 1;
    addHost({0.0, 3.0, 0.0}, 100.0f);
    build();
    const std::vector<SliceStack> first(list_.stacks().begin(), list_.stacks().end());
    const uint64_t revision = list_.placesRevision();
    for (const glm::dvec3& step : {glm::dvec3(0.25, -0.125, 7.0),
                                   {64.0, -32.0, 0.5},
                                   {0.3, -0.1, 7.7},
                                   {12.7, 3.3, -21.1},
                                   {0.0, 0.0, 0.0}})
    {
        eye_ = step;
        for (size_t i = 0; i < casters_.size(); ++i)
            casters_[i].center = glm::vec3(glm::dvec3(kCasters[i].center) - eye_);
        build();
        EXPECT_EQ(list_.placesRevision(), revision);
        ASSERT_EQ(list_.stacks().size(), first.size());
        for (size_t i = 0; i < first.size(); ++i)
            EXPECT_LT(glm::length(list_.stacks()[i].origin - glm::vec3(glm::dvec3(first[i].origin) - eye_)),
                      1e-4f);
    }
}

TEST_F(LightListTest, wideScenesHaveFinerPlanesNearTheEye)
{
    build();
    EXPECT_EQ(list_.block().lights[kFinerPlanes].tiles.w, 0.0f) << "a small scene needs none";
    casters_.push_back({{400.0f, 0.0f, 0.0f}, 2.0f, 1.0f});
    casters_.push_back({{30.0f, 0.0f, 0.0f}, 2.0f, 1.0f});
    build();
    const auto metresOfTexel = [&](size_t entry) {
        return 1.0f / glm::length(glm::vec3(list_.block().lights[entry].right));
    };
    ASSERT_GT(list_.block().lights[kFinerPlanes + 1].tiles.w, 0.0f);
    EXPECT_LT(metresOfTexel(kFinerPlanes), 0.5f * metresOfTexel(0));
    EXPECT_LT(metresOfTexel(kFinerPlanes + 1), metresOfTexel(kFinerPlanes));
}

TEST_F(LightListTest, finerPlanesCoverTheirBallWhereverTheEyeIsAndFollowItInSteps)
{
    casters_ = {{{-60.0f, 0.0f, 0.0f}, 2.0f, 1.0f},
                {{60.0f, 0.0f, 0.0f}, 2.0f, 1.0f},
                {{2.0f, 0.0f, 1.0f}, 2.0f, 1.0f}};
    const std::vector<MediumCaster> still = casters_;
    size_t revisions = 0;
    uint64_t last = 0;
    for (int i = 0; i < 200; ++i) {
        eye_ = glm::dvec3(0.02 * i, 0.003 * i, -0.011 * i);
        for (size_t k = 0; k < still.size(); ++k)
            casters_[k].center = glm::vec3(glm::dvec3(still[k].center) - eye_);
        build();
        revisions += list_.placesRevision() != last ? 1 : 0;
        last = list_.placesRevision();
        const SliceLightBlock& finer = list_.block().lights[kFinerPlanes];
        ASSERT_GT(finer.tiles.w, 0.0f);
        ASSERT_GT(finer.place.w, 5.0f);
        for (const glm::vec4& axis : {finer.right, finer.up, finer.along}) {
            const float reach =
                finer.place.w * glm::length(glm::vec3(axis)); // of the ball, in texels or planes
            const float end = axis == finer.along ? finer.tiles.w - 1.0f : finer.tiles.z;
            ASSERT_GE(axis.w - reach, 0.0f) << i;
            ASSERT_LE(axis.w + reach, end) << i;
        }
    }
    EXPECT_GT(revisions, 1u);
    EXPECT_LT(revisions, 20u);
}

TEST_F(LightListTest, planesThatChangeTheirSidesFadeInAndAreThenAlone)
{
    build();
    const size_t stacks = list_.stacks().size();
    const float before = list_.stacks()[0].texel;
    casters_.back().center.x = 1.3f; // a little wider: the next sides
    float last = 1.0f;
    for (int k = 0; k < kFadeFrames; ++k) {
        build();
        const SliceLightBlock& old = list_.block().lights[kFadingEntries];
        if (k + 1 < kFadeFrames) {
            ASSERT_GT(list_.stacks().size(), stacks);
            EXPECT_FLOAT_EQ(1.0f / glm::length(glm::vec3(old.right)), before);
            EXPECT_GT(old.tiles.w, 0.0f);
            EXPECT_NEAR(last - old.color.r, 1.0f / float(kFadeFrames), 1e-5f) << k;
        } else {
            EXPECT_EQ(old.color.r, 0.0f);
        }
        last = old.color.r;
    }
    EXPECT_EQ(list_.stacks().size(), stacks);
    EXPECT_GT(list_.stacks()[0].texel, before);
    LightList fresh(std::pmr::new_delete_resource());
    fresh.build({&settings_, eye_, effects_, casters_});
    EXPECT_EQ(fresh.placesRevision(), list_.placesRevision()) << "what was before is forgotten";
}

TEST_F(LightListTest, aFrameThatIsListedTwiceFadesByOneStep)
{
    LightList once(std::pmr::new_delete_resource());
    const std::vector<MediumCaster> held = casters_;
    build();
    once.build({&settings_, eye_, effects_, casters_});
    casters_.back().center.x = 1.3f;
    for (int k = 0; k < kFadeFrames + 2; ++k) {
        list_.build({&settings_, eye_, effects_, held});
        list_.rebuild({&settings_, eye_, effects_, casters_});
        once.build({&settings_, eye_, effects_, casters_});
        EXPECT_EQ(list_.block().lights[kFadingEntries].color.r, once.block().lights[kFadingEntries].color.r)
            << k;
        EXPECT_EQ(list_.placesRevision(), once.placesRevision()) << k;
    }
}

TEST_F(LightListTest, afterACutNothingFades)
{
    build();
    casters_.back().center.x = 1.3f;
    list_.build({&settings_, eye_, effects_, casters_, true});
    EXPECT_EQ(list_.block().lights[kFadingEntries].color.r, 0.0f);
    casters_.back().center.x = 40.0f; // not what was there before
    build();
    EXPECT_EQ(list_.block().lights[kFadingEntries].color.r, 0.0f);
}

TEST_F(LightListTest, lightsThatGiveNothingOrAreNoNumbersCastNoShadow)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    settings_.slices.castingPoints = 2;
    addHost({0.0, 3.0, 0.0}, 0.0f);
    addHost({0.0, 3.0, 0.0}, nan);
    addHost({double(nan), 3.0, 0.0}, 5.0f);
    addHost({1.0, 3.0, 0.0}, 1e30f);
    addHost({2.0, 3.0, 0.0}, 7.0f);
    build();
    ASSERT_EQ(list_.block().counts.x, 3) << "the sun and two points";
    EXPECT_EQ(list_.lights()[1].place.x, 1.0f);
    EXPECT_EQ(list_.lights()[2].place.x, 2.0f);
    for (const SliceLightBlock& light : list_.lights())
        for (const glm::vec4& v : {light.along, light.tiles, light.color, light.place, light.cone})
            for (int c = 0; c < 4; ++c)
                EXPECT_TRUE(std::isfinite(v[c]));
}

TEST_F(LightListTest, planesHaveTheSameRevisionWhileTheSameLightsCastThem)
{
    settings_.slices.castingPoints = 1;
    addHost({0.0, 3.0, 0.0}, 100.0f);
    addHost({0.0, -3.0, 0.0}, 90.0f);
    const auto key = [&] {
        build(true);
        return list_.placesRevision();
    };
    const uint64_t first = key();
    settings_.hostLights.lights[0].intensity *= 0.95f;
    settings_.lighting.sunIlluminance *= 2.0f;
    eye_.x += 1.0;
    for (MediumCaster& caster : casters_)
        caster.center.x -= 1.0f; // the same places in the world
    EXPECT_EQ(key(), first) << "a flicker changes no plane";
    settings_.hostLights.lights[1].intensity *= 3.0f;
    EXPECT_NE(key(), first) << "now the second casts";
    settings_.hostLights.lights[1].intensity /= 3.0f;
    settings_.hostLights.lights[0].radius *= 2.0f;
    EXPECT_NE(key(), first) << "media within what glows do not count";
    settings_.hostLights.lights[0].radius /= 2.0f;
    ASSERT_EQ(key(), first);
    settings_.lighting.skyLuminance = glm::vec3(0.0f);
    EXPECT_EQ(key(), first) << "the ground still shines";
    settings_.lighting.groundAlbedo = 0.0f;
    EXPECT_NE(key(), first);
}

TEST_F(LightListTest, equalInputsGiveEqualBits)
{
    addHost({0.0, 3.0, 0.0}, 100.0f);
    build();
    const std::vector<SliceLightBlock> first(list_.lights().begin(), list_.lights().end());
    build();
    ASSERT_EQ(list_.lights().size(), first.size());
    for (size_t i = 0; i < first.size(); ++i) {
        EXPECT_EQ(first[i].right, list_.lights()[i].right);
        EXPECT_EQ(first[i].along, list_.lights()[i].along);
        EXPECT_EQ(first[i].tiles, list_.lights()[i].tiles);
        EXPECT_EQ(first[i].place, list_.lights()[i].place);
    }
}
