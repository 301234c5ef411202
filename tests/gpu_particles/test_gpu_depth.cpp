// Particles that collide with planes that a depth texture shows, against the planes themselves.
#include "depth_fixture.h"

#include <glm/gtc/quaternion.hpp>

namespace fx::test {

TEST_F(GpuDepthContacts, areThoseOfThePlaneThatIsSeen)
{
    const Rows freely = playedOnCpu(kFree, 1.6);
    for (const char* answer : {R"("bounce": 0)", R"("response": "stick")", R"("bounce": 0.5, "margin": 0.1)"})
        for (const PlaneCase& plane : kPlanes) {
            const Rows cpu = playedOnCpu(planeMember(plane, answer), 1.6);
            const auto effect = load(steppedText(depthMember(answer), "gpu"));
            for (const CameraCase& c : cameras()) {
                SCOPED_TRACE(std::string(c.name) + ", " + plane.name + ", " + answer);
                see(c.camera, {{plane.normal, plane.offset}});
                OneEffect gpu(schema_, effect, true);
                gpu.playTo(1.6);
                const Rows rows = computed(gpu.publish().group(0));
                size_t living = 0, lonely = 0;
                EXPECT_LE(worstOf(cpu, rows, living, lonely), boundOf(c.camera, 15.0, 1.6));
                EXPECT_EQ(lonely, 0u);
                EXPECT_GT(living, 300u);
                EXPECT_GT(worstOf(freely, rows, living, lonely), 1.0);
            }
        }
}

TEST_F(GpuDepthContacts, bringParticlesToRestOnWhatIsSeen)
{
    const PlaneCase& plane = kPlanes[0];
    for (const CameraCase& c : cameras()) {
        SCOPED_TRACE(c.name);
        see(c.camera, {{plane.normal, plane.offset}});
        const std::string members = depthMember(R"("bounce": 0.2, "friction": 0.3)");
        OneEffect gpu(schema_, load(steppedText(members, "gpu", kFewThatLast)), true);
        gpu.playTo(3.0);
        const Rows early = computed(gpu.publish().group(0));
        gpu.playTo(3.4);
        const Rows late = computed(gpu.publish().group(0));
        const double shift = 3.0 * resolutionAt(c.camera, kHeight, 15.0).error;
        size_t living = 0;
        for (size_t i = 0; i < late.count(); ++i) {
            if (!late.isAlive(i))
                continue;
            ++living;
            EXPECT_NEAR(placeOf(late, i).y, 0.0, shift + 1e-5); // and what lifts it
            EXPECT_LE(glm::length(placeOf(late, i) - placeOf(early, i)), 0.01);
        }
        EXPECT_EQ(living, 50u);
    }
}

TEST_F(GpuDepthContacts, killWhereThePlaneDoes)
{
    for (const CameraCase& c : cameras()) {
        SCOPED_TRACE(c.name);
        see(c.camera, {{kPlanes[1].normal, kPlanes[1].offset}});
        size_t living = 0, lonely = 0;
        const Rows cpu = playedOnCpu(planeMember(kPlanes[1], R"("response": "kill")"), 1.6);
        const Rows gpu = playedOnGpu(depthMember(R"("response": "kill")"), 1.6);
        EXPECT_LE(worstOf(cpu, gpu, living, lonely), sameWithin()) << "those that live have touched nothing";
        EXPECT_LE(lonely, 1u) << "one that is at the surface this very moment";
        EXPECT_GT(living, 150u);
        const Rows all = playedOnCpu(kFree, 1.6);
        worstOf(all, gpu, living, lonely);
        EXPECT_GT(lonely, 50u);
    }
}

/// Nothing that crosses the surface within a step is missed, however thin and however fast.
TEST_F(GpuDepthContacts, stopWhatIsFastBeforeWhatIsThin)
{
    for (const CameraCase& c : cameras()) {
        SCOPED_TRACE(c.name);
        see(c.camera, {{glm::dvec3(0, 1, 0), 0.0}});
        const std::string members =
            R"("position": [0, 1, 0], "angleDegrees": 20, "speed": {"min": -300, "max": -20},
            "radius": 0.02, "lifetime": 2, "emission": {"rate": 200}, )" +
            depthMember(R"("thickness": 0.02, "response": "stick")");
        OneEffect gpu(schema_,
                      load(R"({"version": 1, "emitters": [{"compute": "gpu", "shape": "cone", "size": 0.1,
            "maxParticles": 500, "appearance": {"kind": "sprite"}, )" +
                           members + "}]}"),
                      true);
        gpu.playTo(1.0);
        const Rows rows = computed(gpu.publish().group(0));
        size_t below = 0, living = 0;
        for (size_t i = 0; i < rows.count(); ++i) {
            living += rows.isAlive(i) ? 1 : 0;
            below += rows.isAlive(i) && placeOf(rows, i).y < -1e-3 ? 1 : 0;
        }
        EXPECT_EQ(below, 0u);
        EXPECT_GE(living, 195u);
    }
}

/// Instances stand anywhere, turned and larger; far from the origin everything is relative to the eye.
TEST_F(GpuDepthContacts, areInThePlaceOfTheInstance)
{
    base::Placement place;
    place.position = {300'000.0, 20.0, -200'000.0};
    place.rotation = glm::angleAxis(0.6f, glm::normalize(glm::vec3(0.3f, 1.0f, -0.4f)));
    place.scale = 1.5f;
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.2, 1.0, 0.1));
    const glm::dquat turn(place.rotation);
    const PlaneCase local{"local", glm::conjugate(turn) * normal, 0.1};
    const SeenPlane seen{normal, glm::dot(normal, place.position) + 0.1 * double(place.scale)};
    render::CameraPose pose = kAbove;
    pose.position = place.position + 1.5 * pose.position;
    pose.target = place.position + 1.5 * pose.target;
    const auto camera = render::perspectiveView(pose, 1.3f, kAspect, 0.1f, render::DepthConvention::Reversed);
    see(camera, {seen});
    const char* const answer = R"("bounce": 0.5, "margin": 0.05)";
    OneEffect cpu(schema_, load(steppedText(planeMember(local, answer), "cpu")), false, 7, place);
    OneEffect gpu(schema_, load(steppedText(depthMember(answer), "gpu")), true, 7, place);
    for (OneEffect* effect : {&cpu, &gpu}) {
        effect->playTo(1.6);
        effect->publish();
    }
    size_t living = 0, lonely = 0;
    const Rows rows = computed(gpu.publishedLast().group(0));
    // The double-precision planes of the test are rounded where the instance is: 2^-52 of 4e5 m.
    EXPECT_LE(worstOf(rowsOf(cpu.publishedLast().group(0)), rows, living, lonely),
              boundOf(camera, 25.0, 1.6));
    EXPECT_GT(living, 300u);
    EXPECT_EQ(lonely, 0u);
    EXPECT_GT(worstOf(playedOnCpu(kFree, 1.6), rows, living, lonely), 1.0);
}

} // namespace fx::test
