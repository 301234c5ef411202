// Far sprites, meshes and ribbons with a level of detail look like all of them.
#include "particle_fixture.h"

#include <cmath>
#include <functional>
#include <random>
#include <tuple>

using namespace fx;
using namespace fx::test;
namespace constant = base::particle_constant;

namespace {

class ThinnedParticles : public ParticleTest
{
protected:
    static constexpr int kSide = 100; ///< [pixel] 10 a metre with flatCamera()

    void SetUp() override
    {
        ParticleTest::SetUp();
        makeTargets(kSide, kSide);
        white_ = float(*assets_.addImage(1, 1, true, std::vector<uint8_t>(4, 255)));
    }
    static void setBounds(base::SnapshotGroup& group)
    {
        group.editInfo().bounds.min = glm::vec3(-2.0f);
        group.editInfo().bounds.max = glm::vec3(2.0f);
    }
    std::vector<TestParticle> cloud(float radius, float opacity)
    {
        std::mt19937 random(3);
        std::uniform_real_distribution<float> place(-1.9f, 1.9f);
        std::vector<TestParticle> particles(4000);
        for (TestParticle& p : particles) {
            p.center = {place(random), place(random), place(random)};
            p.radius = radius;
            p.color = {1, 1, 1, opacity};
        }
        return particles;
    }
    /// Light on the picture.
    double light(const base::FrameSnapshot& snapshot, float bias)
    {
        view_->settings().lod.bias = bias;
        setPicture(std::vector<float>(size_t(kSide) * kSide * 4, 0.0f));
        const Picture picture = renderPair(snapshot, nullptr, 1.0, flatCamera());
        double sum = 0.0;
        for (size_t i = 0; i < picture.texels.size(); i += 4)
            sum += double(picture.texels[i]);
        return sum;
    }
    /// Draws all and a part of it, and compares their light.
    void expectSame(const base::FrameSnapshot& snapshot, double bound, const char* what)
    {
        const double all = light(snapshot, 0.0f);
        const uint64_t drawn = view_->statistics().particles;
        EXPECT_EQ(view_->statistics().particlesThinned, 0u) << what;
        const double few = light(snapshot, 8.0f);
        const render::FrameStatistics& s = view_->statistics();
        EXPECT_GT(s.particlesThinned, drawn / 2) << what;
        EXPECT_LE(s.particles + s.particlesThinned, drawn) << what;
        EXPECT_GT(all, 100.0) << what << ": something is seen";
        EXPECT_NEAR(few / all, 1.0, bound) << what;
        EXPECT_EQ(light(snapshot, 8.0f), few) << what << ": drawn again";
    }
    float white_ = 0.0f;
};

} // namespace

TEST_F(ThinnedParticles, spritesOfAnyBlendAndOrderKeepTheirLight)
{
    for (const auto blend : {base::ParticleBlend::Additive, base::ParticleBlend::Alpha})
        for (const auto order :
             {base::ParticleOrder::None, base::ParticleOrder::Depth, base::ParticleOrder::Oldest}) {
            auto snapshot = emptySnapshot();
            auto& group = addParticles(snapshot, cloud(0.03f, 0.5f));
            setBounds(group);
            set(group, constant::Texture, white_);
            set(group, constant::Blend, float(blend));
            set(group, constant::Order, float(order));
            expectSame(snapshot, 0.05, blend == base::ParticleBlend::Alpha ? "alpha" : "additive");
        }
}

TEST_F(ThinnedParticles, whatIsLeftLooksTheSameHoweverItsRowsAreListed)
{
    // More than half of the rows, less than half, and less than half in an order: three ways to tell the
    // shader.
    const std::vector<TestParticle> particles = cloud(0.03f, 0.5f);
    std::vector<TestParticle> among = particles;
    among.resize(particles.size() + 70'000, TestParticle{{}, 0.0f}); // empty rows change no level
    auto plain = emptySnapshot();
    auto sparse = emptySnapshot();
    auto ordered = emptySnapshot();
    using Listed = std::tuple<base::FrameSnapshot*, const std::vector<TestParticle>*, base::ParticleOrder>;
    for (const auto& [snapshot, rows, order] : {Listed(&plain, &particles, base::ParticleOrder::None),
                                                Listed(&sparse, &among, base::ParticleOrder::None),
                                                Listed(&ordered, &particles, base::ParticleOrder::Depth)})
    {
        auto& group = addParticles(*snapshot, *rows);
        setBounds(group);
        set(group, constant::Texture, white_);
        set(group, constant::Blend, float(base::ParticleBlend::Additive)); // any order gives the same light
        set(group, constant::Order, float(order));
    }
    bool keptMost = false;
    bool keptFew = false;
    for (const float bias : {0.8f, 1.0f, 1.3f, 1.7f, 2.2f, 3.0f, 4.0f, 8.0f}) {
        const double wanted = light(plain, bias);
        const render::FrameStatistics& s = view_->statistics();
        keptMost = keptMost || (s.particlesThinned > 0 && s.particles > s.particlesThinned);
        keptFew = keptFew || s.particles < s.particlesThinned;
        EXPECT_EQ(s.particles + s.particlesThinned, particles.size()) << bias;
        EXPECT_NEAR(light(sparse, bias) / wanted, 1.0, 1e-4) << bias;
        EXPECT_NEAR(light(ordered, bias) / wanted, 1.0, 1e-4) << bias;
    }
    EXPECT_TRUE(keptMost && keptFew);
}

TEST_F(ThinnedParticles, streaksKeepTheirLightAndTheirLength)
{
    std::vector<TestParticle> particles = cloud(0.02f, 0.2f);
    for (TestParticle& p : particles)
        p.velocity = {0, 10, 0};
    auto snapshot = emptySnapshot();
    auto& group = addParticles(snapshot, particles);
    setBounds(group);
    set(group, constant::Texture, white_);
    set(group, constant::Blend, float(base::ParticleBlend::Additive));
    set(group, constant::Alignment, float(base::SpriteAlignment::Velocity));
    set(group, constant::Stretch, 0.1f); // half a metre to both sides
    expectSame(snapshot, 0.05, "streaks");
    setPicture(std::vector<float>(size_t(kSide) * kSide * 4, 0.0f));
    const Picture few = renderPair(snapshot, nullptr, 1.0, flatCamera());
    for (int y = 0; y < 24; ++y) // 2.5 m below the middle and more
        for (int x = 0; x < kSide; ++x)
            ASSERT_EQ(few.at(x, y)[0], 0.0f) << x << ", " << y;
}

TEST_F(ThinnedParticles, solidMeshesCoverAsMuch)
{
    const std::vector<base::MeshVertex> corners{{{-1, -1, 0}, {0, 0, 1}, {0, 0}},
                                                {{1, -1, 0}, {0, 0, 1}, {1, 0}},
                                                {{1, 1, 0}, {0, 0, 1}, {1, 1}},
                                                {{-1, 1, 0}, {0, 0, 1}, {0, 1}}};
    const float square = float(*assets_.addMesh(corners, std::vector<uint32_t>{0, 1, 2, 0, 2, 3}));
    auto snapshot = emptySnapshot();
    auto& group = addParticles(snapshot, cloud(0.03f, 1.0f));
    setBounds(group);
    set(group, constant::Shape, float(base::ParticleShape::Mesh));
    set(group, constant::Mesh, square);
    set(group, constant::Blend, float(base::ParticleBlend::Opaque));
    expectSame(snapshot, 0.1, "meshes");
}

TEST_F(ThinnedParticles, ribbonsKeepTheirLight)
{
    std::mt19937 random(4);
    std::uniform_real_distribution<float> place(-1.5f, 1.5f);
    std::vector<TestPoint> points;
    for (uint64_t strip = 0; strip < 500; ++strip) {
        const glm::vec3 begin(place(random), place(random), place(random));
        for (int k = 0; k < 6; ++k)
            points.push_back(
                {begin + glm::vec3(0.06f * float(k), 0, 0), 0.02f, 0.0f, {1, 1, 1, 0.3f}, strip});
    }
    auto snapshot = emptySnapshot();
    auto& group = addRibbon(snapshot, points);
    setBounds(group);
    set(group, constant::Texture, white_);
    set(group, constant::Blend, float(base::ParticleBlend::Additive));
    expectSame(snapshot, 0.06, "ribbons");
}

TEST_F(ThinnedParticles, ofEffectsThatAreMergedEachHasItsOwnLevel)
{
    auto snapshot = emptySnapshot();
    for (int effect = 0; effect < 3; ++effect) {
        std::vector<TestParticle> few = cloud(0.03f, 0.5f);
        few.resize(1200);
        auto& group = addParticles(snapshot, few);
        setBounds(group);
        group.editInfo().instance = uint64_t(effect + 1);
        group.editInfo().placement.position = {double(effect) - 1.0, 0, 0};
        set(group, constant::Texture, white_);
        set(group, constant::Blend, float(base::ParticleBlend::Additive));
    }
    expectSame(snapshot, 0.06, "merged");
    EXPECT_LE(view_->statistics().drawCalls, 4u) << "they are one draw";
}
