// Everything that is drawn of a group lies within its bounds, whatever the group.
#include "particle_fixture.h"

#include "foundation/random/philox.h"
#include "foundation/snapshot/particle_bounds.h"
#include "rendering/frame/snapshot_match.h"
#include "rendering/frame/view_block.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace fx;
using namespace fx::test;
namespace constant = base::particle_constant;
namespace column = base::particle_column;

namespace {

/// Random numbers of one trial.
class Dice
{
public:
    explicit Dice(uint64_t trial) : trial_(trial) {}
    float unit() { return base::randomUnit4(trial_, 0, next_++, base::RandomPurpose::Position)[0]; }
    float between(float a, float b) { return a + (b - a) * unit(); }
    int below(int count) { return std::min(int(unit() * float(count)), count - 1); }
    glm::vec3 inBall(float radius)
    {
        return radius * glm::vec3(between(-1, 1), between(-1, 1), between(-1, 1));
    }
    glm::quat turn()
    {
        return glm::normalize(glm::quat(between(0.1f, 1), between(-1, 1), between(-1, 1), between(-1, 1)));
    }

private:
    uint64_t trial_;
    uint64_t next_ = 0;
};

/// The pixels that a box may cover, and two more all around: what is smaller than a pixel is widened to one,
/// which at the edge of a wide view is seen aslant.
struct Rectangle
{
    float x0 = std::numeric_limits<float>::infinity(), y0 = x0, x1 = -x0, y1 = -x0;
    bool contains(int x, int y) const
    {
        return float(x) + 1.0f >= x0 - 2.0f && float(x) <= x1 + 2.0f && float(y) + 1.0f >= y0 - 2.0f &&
               float(y) <= y1 + 2.0f;
    }
};

Rectangle project(const base::Bounds& bounds, const base::Placement& place,
                  const render::CameraGeometry& camera, int side)
{
    Rectangle r;
    for (int corner = 0; !bounds.empty() && corner < 8; ++corner) {
        const glm::vec3 local(corner & 1 ? bounds.max.x : bounds.min.x,
                              corner & 2 ? bounds.max.y : bounds.min.y,
                              corner & 4 ? bounds.max.z : bounds.min.z);
        const glm::vec3 p = glm::vec3(place.position) + place.rotation * (local * place.scale);
        const float depth = camera.orthographic ? 1.0f : glm::dot(p, camera.forward);
        if (depth < camera.nearDistance && !camera.orthographic) { // a corner behind the eye bounds nothing
            const float far = std::numeric_limits<float>::infinity();
            return {-far, -far, far, far};
        }
        const float x =
            (glm::dot(p, camera.right) / depth * camera.clipScale.x + camera.clipOffset.x + 1.0f) * 0.5f *
            float(side);
        const float y = (glm::dot(p, camera.up) / depth * camera.clipScale.y + camera.clipOffset.y + 1.0f) *
                        0.5f * float(side);
        r = {std::min(r.x0, x), std::min(r.y0, y), std::max(r.x1, x), std::max(r.y1, y)};
    }
    return r;
}

class ParticleBoundsTest : public ParticleTest
{
protected:
    static constexpr int kSide = 48;

    void SetUp() override
    {
        ParticleTest::SetUp();
        makeTargets(kSide, kSide);
        const std::vector<uint8_t> texel{255, 255, 255, 255};
        white_ = float(*assets_.addImage(1, 1, true, texel));
        std::vector<base::MeshVertex> corners{
            {{2, 0, 0}, {0, 0, 1}, {}}, {{-1, 1, 0}, {0, 0, 1}, {}}, {{0, -1, 1}, {0, 0, 1}, {}}};
        mesh_ = *assets_.addMesh(corners, std::vector<uint32_t>{0, 1, 2});
    }

    TestParticle randomParticle(Dice& dice)
    {
        TestParticle p;
        p.center = dice.inBall(2.0f);
        p.radius = dice.unit() < 0.1f ? 0.0f : dice.between(0.01f, 0.6f);
        p.color = {1, 1, 1, 1};
        p.age = dice.between(0.0f, 0.4f);
        p.velocity = dice.inBall(5.0f);
        p.angle = dice.between(-4.0f, 4.0f);
        p.orientation = dice.turn();
        return p;
    }

    void setConstants(Dice& dice, base::SnapshotGroup& group)
    {
        set(group, constant::Texture, white_);
        set(group, constant::Alignment, float(dice.below(4)));
        const glm::vec3 axis = dice.turn() * glm::vec3(0, 1, 0);
        for (int k = 0; k < 3; ++k)
            set(group, constant::AxisX + size_t(k), axis[k]);
        set(group, constant::Aspect, dice.between(0.2f, 4.0f));
        set(group, constant::Stretch, dice.between(0.0f, 0.5f));
        set(group, constant::Blend, float(dice.below(3)));
        set(group, constant::Order, float(dice.below(4)));
        set(group, constant::Shape,
            float(dice.below(4) == 0 ? base::ParticleShape::Mesh : base::ParticleShape::Sprite));
        set(group, constant::Mesh, float(mesh_));
        group.editInfo().placement = {dice.inBall(1.0f), dice.turn(), dice.between(0.5f, 2.0f)};
    }

    render::CameraView randomCamera(Dice& dice)
    {
        const glm::dvec3 position = glm::dvec3(dice.inBall(6.0f)) + glm::dvec3(0, 0, 9);
        const render::CameraPose pose{position, glm::dvec3(dice.inBall(2.0f)), {0.1f, 1.0f, 0.0f}};
        return dice.below(3) == 0 ? render::orthographicView(pose, 9.0f, 1.0f, 0.1f, 100.0f)
                                  : render::perspectiveView(pose, dice.between(0.4f, 1.6f), 1.0f, 0.1f);
    }

    /// @return lit pixels
    int expectWithin(const Rectangle& r, const Picture& picture, int trial)
    {
        int lit = 0;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                if (!(picture.at(x, y)[0] > 0.0f))
                    continue;
                ++lit;
                EXPECT_TRUE(r.contains(x, y)) << "trial " << trial << ": " << x << ", " << y << " outside of "
                                              << r.x0 << " " << r.y0 << " " << r.x1 << " " << r.y1;
            }
        return lit;
    }

    float white_ = 0.0f;
    base::AssetId mesh_ = 0;
};

} // namespace

TEST_F(ParticleBoundsTest, everyDrawnPixelLiesInsideTheProjectedBounds)
{
    constexpr double kStep = 0.2;
    int lit = 0;
    const std::vector<float> black(size_t(kSide) * kSide * 4, 0.0f);
    for (int trial = 0; trial < 800; ++trial) {
        Dice dice(uint64_t(trial) + 1);
        std::vector<TestParticle> before;
        const int count = 1 + dice.below(5);
        for (int i = 0; i < count; ++i)
            before.push_back(randomParticle(dice));
        std::vector<TestParticle> after = before;
        for (TestParticle& p : after) {
            p.age += float(kStep);
            p.center += p.velocity * dice.between(0.0f, 0.3f);
            if (dice.below(3) == 0) { // another particle in the same row
                p = randomParticle(dice);
                p.age = dice.between(0.0f, float(kStep));
            }
        }
        auto older = emptySnapshot(1.0);
        auto newer = emptySnapshot(1.0 + kStep);
        auto& a = addParticles(older, before);
        auto& b = addParticles(newer, after);
        setConstants(dice, b);
        std::copy(b.constants().begin(), b.constants().end(), a.editConstants().begin());
        a.editInfo().placement = b.info().placement;
        a.editInfo().placement.position += glm::dvec3(dice.inBall(0.5f));
        const float reach = assets_.mesh(mesh_)->reach;
        base::Bounds bounds = base::particleBounds(b, reach, float(kStep));
        const base::Bounds old = base::particleBounds(a, reach, 0.0f);
        bounds.min = glm::min(bounds.min, old.min);
        bounds.max = glm::max(bounds.max, old.max);

        const auto camera = randomCamera(dice);
        const auto geometry = render::cameraGeometry(camera);
        const double t = double(dice.unit());
        setPicture(black);
        const Picture picture = renderPair(newer, &older, t, camera);
        const Rectangle r =
            project(bounds, render::placementAt(b, &a, float(t), geometry.eye), geometry, kSide);
        lit += expectWithin(r, picture, trial);
        if (HasFailure())
            break;
    }
    EXPECT_GT(lit, 50'000) << "most groups are to be seen";
}

TEST_F(ParticleBoundsTest, everyPixelOfARibbonLiesInsideToo)
{
    int lit = 0;
    const std::vector<float> black(size_t(kSide) * kSide * 4, 0.0f);
    for (int trial = 0; trial < 200; ++trial) {
        Dice dice(uint64_t(trial) + 5000);
        std::vector<TestPoint> points;
        glm::vec3 place = dice.inBall(2.0f);
        for (int i = 0; i < 8; ++i) {
            points.push_back({place, dice.between(0.02f, 0.6f), float(i), {1, 1, 1, 1}, uint64_t(i / 5)});
            place += dice.inBall(1.0f);
        }
        auto snapshot = emptySnapshot();
        auto& group = addRibbon(snapshot, points);
        group.editInfo().placement = {dice.inBall(1.0f), dice.turn(), dice.between(0.5f, 2.0f)};
        const auto camera = randomCamera(dice);
        const auto geometry = render::cameraGeometry(camera);
        setPicture(black);
        const Picture picture = renderPair(snapshot, nullptr, 1.0, camera);
        const Rectangle r = project(base::ribbonBounds(group),
                                    render::placementAt(group, nullptr, 1.0f, geometry.eye), geometry, kSide);
        lit += expectWithin(r, picture, trial);
        if (HasFailure())
            break;
    }
    EXPECT_GT(lit, 10'000);
}

TEST_F(ParticleBoundsTest, theyAreTightAroundASingleBallAndIgnoreWhatIsNotThere)
{
    auto snapshot = emptySnapshot();
    TestParticle p{{1, 2, 3}, 0.5f};
    TestParticle gone{{50, 0, 0}, 0.0f};
    TestParticle broken{{std::numeric_limits<float>::quiet_NaN(), 0, 0}, 0.5f};
    auto& group = addParticles(snapshot, {p, gone, broken}, column::kAlways);
    const base::Bounds bounds = base::particleBounds(group, 0.0f, 1.0f);
    EXPECT_NEAR(bounds.max.x, 1.0f + 0.5f * std::sqrt(2.0f), 1e-4f);
    EXPECT_NEAR(bounds.min.z, 3.0f - 0.5f * std::sqrt(2.0f), 1e-4f);
    auto none = emptySnapshot();
    EXPECT_TRUE(base::particleBounds(addParticles(none, {gone}), 0.0f, 0.0f).empty());
}

TEST_F(ParticleBoundsTest, aGroupOutsideTheViewIsNotDrawn)
{
    auto snapshot = emptySnapshot();
    auto& group = addParticles(snapshot, {{{50, 0, 0}, 0.5f}});
    group.editInfo().bounds = base::particleBounds(group, 0.0f, 0.0f);
    (void)renderPair(snapshot, nullptr, 1.0, flatCamera());
    EXPECT_EQ(view_->statistics().particles, 0u);
    EXPECT_EQ(view_->statistics().drawCalls, 0u);
}
