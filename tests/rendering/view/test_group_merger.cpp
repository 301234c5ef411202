// Many instances of one preset are one draw, and the picture is that of many draws.
#include "particle_fixture.h"

#include <cmath>

using namespace fx;
using namespace fx::test;
namespace constant = base::particle_constant;

namespace {

class GroupMergerTest : public ParticleTest
{
protected:
    static constexpr int kSide = 64;

    void SetUp() override
    {
        ParticleTest::SetUp();
        makeTargets(kSide, kSide);
    }

    /// `count` instances of three particles; those that may not be merged differ in a constant that shows
    /// nothing.
    void addInstances(base::FrameSnapshot& snapshot, int count, bool mergeable, float drift, float blend,
                      float order)
    {
        nextSolver_ = 100; // the same groups in both snapshots
        for (int i = 0; i < count; ++i) {
            std::vector<TestParticle> particles;
            for (int k = 0; k < 3; ++k) {
                TestParticle p;
                p.center = {drift + 0.3f * float(k), 0.1f * float(k), 0.2f * float(k)};
                p.radius = 0.2f;
                p.color = {float(i % 3) / 2.0f, float(k) / 2.0f, 1.0f, 0.6f};
                p.velocity = {1, 2, 0};
                p.orientation = glm::angleAxis(0.4f * float(k), glm::vec3(0, 0, 1));
                particles.push_back(p);
            }
            auto& group = addParticles(snapshot, particles);
            const float a = float(i) * 0.7f;
            group.editInfo().placement = {{3.5 * std::cos(a), 3.5 * std::sin(a), 0.05 * i},
                                          glm::angleAxis(a, glm::vec3(0, 0, 1)),
                                          0.5f + 0.01f * float(i)};
            set(group, constant::Blend, blend);
            set(group, constant::Order, order);
            set(group, constant::Alignment, 1.0f);
            set(group, constant::Stretch, 0.1f);
            set(group, constant::MotionScale, mergeable ? 0.0f : 1e-6f * float(i));
        }
    }

    Picture picture(int count, bool mergeable, float blend, float order)
    {
        auto older = emptySnapshot(1.0);
        auto newer = emptySnapshot(1.0 + 1.0 / 60.0);
        addInstances(older, count, mergeable, 0.0f, blend, order);
        addInstances(newer, count, mergeable, 0.1f, blend, order);
        setPicture(std::vector<float>(size_t(kSide) * kSide * 4, 0.0f));
        return renderPair(newer, &older, 0.5, flatCamera());
    }
};

} // namespace

TEST_F(GroupMergerTest, aHundredInstancesOfOnePresetAreOneDraw)
{
    const float additive = float(base::ParticleBlend::Additive);
    const float alpha = float(base::ParticleBlend::Alpha);
    for (const float blend : {additive, alpha}) {
        (void)picture(1, true, blend, float(base::ParticleOrder::Depth));
        const uint32_t ofOne = view_->statistics().drawCalls;
        (void)picture(100, true, blend, float(base::ParticleOrder::Depth));
        EXPECT_EQ(view_->statistics().drawCalls, ofOne); // one draw of particles, and what every frame has
        EXPECT_EQ(view_->statistics().particles, 300u);
        (void)picture(100, false, blend, float(base::ParticleOrder::Depth));
        EXPECT_GE(view_->statistics().drawCalls, ofOne + 99);
    }
}

TEST_F(GroupMergerTest, thePictureIsThatOfManyDraws)
{
    for (const auto blend : {base::ParticleBlend::Additive, base::ParticleBlend::Opaque}) {
        const Picture many = picture(9, false, float(blend), 0.0f);
        const Picture one = picture(9, true, float(blend), 0.0f);
        int lit = 0, edges = 0;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x)
                for (size_t c = 0; c < 3; ++c) {
                    lit += many.at(x, y)[c] > 0.0f ? 1 : 0;
                    const float difference = std::abs(one.at(x, y)[c] - many.at(x, y)[c]);
                    ASSERT_LT(difference, 0.1f) << x << ", " << y;
                    edges += difference > 2e-3f ? 1 : 0;
                }
        EXPECT_GT(lit, blend == base::ParticleBlend::Additive ? 100 : 20);
        EXPECT_LE(edges, 3); // the middle of a pixel on the edge of a square, which is rounded otherwise
    }
}

TEST_F(GroupMergerTest, whatIsDrawnInItsOwnOrderStaysByItself)
{
    (void)picture(1, true, float(base::ParticleBlend::Alpha), float(base::ParticleOrder::Oldest));
    const uint32_t ofOne = view_->statistics().drawCalls;
    (void)picture(10, true, float(base::ParticleBlend::Alpha), float(base::ParticleOrder::Oldest));
    EXPECT_EQ(view_->statistics().drawCalls, ofOne + 9);
}
