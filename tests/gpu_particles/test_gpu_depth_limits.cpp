// Where a depth texture shows nothing, ends, or changes; views that look seldom or late; pictures.
#include "depth_fixture.h"

namespace fx::test {

TEST_F(GpuDepthContacts, areNoneWithoutDepthOutOfTheWindowBehindTheCameraAndInTheSky)
{
    const Rows freely = playedOnCpu(kFree, 1.6);
    const std::string members = depthMember(R"("bounce": 0.5)");
    expectSame(freely, playedOnCpu(members, 1.6)); // the CPU knows of no depth
    expectSame(freely, playedOnGpu(members, 1.6)); // and here there is none
    const SeenPlane floor{{0, 1, 0}, 0.0};
    for (const auto depth : {render::DepthConvention::Standard, render::DepthConvention::Reversed}) {
        const auto camera = [&](const render::CameraPose& pose) {
            return render::perspectiveView(pose, 1.0f, kAspect, 0.5f, depth);
        };
        see(camera({{30.0, 8.0, 9.0}, {60.0, 0.0, 9.0}}), {floor}); // beside
        expectSame(freely, playedOnGpu(members, 1.6));
        see(camera({{0.3, 8.0, 12.0}, {0.3, 4.0, 30.0}}), {floor}); // behind
        expectSame(freely, playedOnGpu(members, 1.6));
        see(camera(kAbove), {}); // nothing but sky
        expectSame(freely, playedOnGpu(members, 1.6));
        see(camera(kAbove), {floor});
        size_t living = 0, lonely = 0;
        EXPECT_GT(worstOf(freely, playedOnGpu(members, 1.6), living, lonely), 1.0);
    }
}

/// A wall in front of the particles hides them, but they are farther behind it than it is thick.
TEST_F(GpuDepthContacts, letThoseBehindByMoreThanTheThicknessMoveOn)
{
    const Rows freely = playedOnCpu(kFree, 1.6);
    const auto inFront = [](const glm::dvec3& p) { return p.x < 0.5; }; // half of them are seen beside it
    for (const bool isParallel : {false, true}) {
        const render::CameraPose pose{{0.3, 1.5, 25.0}, {0.3, 1.0, 0.0}};
        const auto camera = isParallel ? render::orthographicView(pose, 20.0f, kAspect, 1.0f, 60.0f)
                                       : render::perspectiveView(pose, 0.9f, kAspect, 0.5f);
        see(camera, {{{0, 0, 1}, 12.0, inFront}});
        expectSame(freely, playedOnGpu(depthMember(R"("bounce": 0.5, "thickness": 5)"), 1.6));
        size_t living = 0, lonely = 0;
        const Rows thick = playedOnGpu(depthMember(R"("bounce": 0.5, "thickness": 30)"), 1.6);
        EXPECT_GT(worstOf(freely, thick, living, lonely), 0.3);
    }
}

/// Where the floor ends, the smaller of the two differences is still the floor's: who falls straight down on
/// the last pixel of it rises straight up.
TEST_F(GpuDepthContacts, haveTheNormalOfTheirOwnSurfaceBesideAnEdge)
{
    const auto camera = cameras()[1].camera;
    const auto isLeft = [](const glm::dvec3& p) { return p.x < 0.8; };
    see(camera, {{{0, 1, 0}, 0.0, isLeft}, {{0, 1, 0}, -40.0}}); // to the right of it, something far below
    const auto played = [&](const std::string& collisions, const char* compute) {
        const std::string text = R"({"version": 1, "emitters": [{"shape": "box", "size": [0.6, 0.1, 2],
            "position": [0.5, 1.5, 0], "speed": 0, "radius": 0.03, "lifetime": 1.6, "maxParticles": 2000,
            "emission": {"rate": 1000}, "appearance": {"kind": "sprite"}, "compute": ")";
        OneEffect effect(schema_, load(text + compute + "\", " + collisions + "}]}"), true);
        effect.playTo(1.6);
        const base::FrameSnapshot& snapshot = effect.publish();
        return snapshot.group(0).program() ? computed(snapshot.group(0)) : rowsOf(snapshot.group(0));
    };
    const Rows cpu = played(planeMember(kPlanes[0], R"("bounce": 0.5)"), "cpu");
    const Rows gpu = played(depthMember(R"("bounce": 0.5)"), "gpu");
    const double half = 0.5 * resolutionAt(camera, kHeight, 13.0).pixel;
    size_t beside = 0, wrong = 0, fallen = 0;
    for (size_t i = 0; i < cpu.count(); ++i) {
        if (!cpu.isAlive(i))
            continue;
        const glm::dvec3 there = placeOf(cpu, i);
        const bool isLast = there.x > 0.8 - 3.0 * half && there.x < 0.8 - half;
        beside += isLast ? 1 : 0;
        fallen += there.x > 0.8 + half && placeOf(gpu, i).y < -0.5 ? 1 : 0;
        const double off = glm::length(there - placeOf(gpu, i));
        wrong += there.x < 0.8 - half && off > boundOf(camera, 15.0, 1.6) ? 1 : 0;
    }
    EXPECT_GT(beside, 50u);
    EXPECT_EQ(wrong, 0u);
    EXPECT_GT(fallen, 50u);
}

/// While camera and picture stand still, the time at which a view has read the depth does not matter.
TEST_F(GpuDepthContacts, areTheSameForViewsThatLookSeldomOrLate)
{
    see(cameras()[0].camera, {{kPlanes[1].normal, kPlanes[1].offset}});
    OneEffect gpu(schema_, load(steppedText(depthMember(R"("bounce": 0.5, "friction": 0.1)"), "gpu")), true);
    auto seldom = makeStates();
    for (int i = 1; i <= 32; ++i) {
        gpu.playTo(1.0 + i / 60.0);
        const base::SnapshotGroup& group = gpu.publish().group(0);
        const Rows always = computed(group);
        if (i % 8 != 0)
            continue;
        auto late = makeStates();
        for (render::GpuStates* states : {seldom.get(), late.get()}) {
            const Rows other = computed(group, *states);
            EXPECT_EQ(always.columns, other.columns) << i;
        }
        EXPECT_GT(steps_, 60u) << "the late one begins with the births";
    }
}

/// What is seen moves: particles stay with what they have met, and nothing is thrown.
TEST_F(GpuDepthContacts, pushNobodyWhenASurfaceComes)
{
    const auto camera = cameras()[1].camera;
    see(camera, {{glm::dvec3(0, 1, 0), 0.0}});
    const std::string members = depthMember(R"("bounce": 0.2, "friction": 0.3, "thickness": 1)");
    OneEffect gpu(schema_, load(steppedText(members, "gpu", kFewThatLast)), true);
    gpu.playTo(3.0);
    const Rows before = computed(gpu.publish().group(0));
    setDepth(depthOf(camera, kWidth, kHeight, {{glm::dvec3(0, 1, 0), 0.3}})); // the floor has risen
    gpu.playTo(3.2);
    const Rows after = computed(gpu.publish().group(0));
    size_t living = 0;
    for (size_t i = 0; i < after.count(); ++i)
        if (after.isAlive(i)) {
            ++living;
            EXPECT_LE(glm::length(placeOf(after, i) - placeOf(before, i)), 0.01);
        }
    EXPECT_EQ(living, 50u);
}

/// Through a view: its depth, its camera, and where the instance is.
TEST_F(GpuDepthContacts, areDrawn)
{
    base::Placement place;
    place.position = {40.0, 1.0, -25.0};
    render::CameraPose pose = kAbove;
    pose.position += place.position;
    pose.target += place.position;
    const glm::dvec3& normal = kPlanes[2].normal;
    const double offset = kPlanes[2].offset + glm::dot(normal, place.position);
    see(render::perspectiveView(pose, 1.3f, kAspect, 1.0f), {{normal, offset}});
    const char* const answer = R"("bounce": 0.3)";
    const auto pictureOf = [&](const std::string& members, const char* compute) {
        OneEffect effect(schema_, load(steppedText(members, compute)), true, 7, place);
        effect.playTo(1.6);
        effect.publish();
        effect.playTo(1.6 + 1.0 / 60.0);
        effect.publish();
        return draw(effect.publishedLast(), effect.older());
    };
    const Picture plane = pictureOf(planeMember(kPlanes[2], answer), "cpu");
    const Picture seen = pictureOf(depthMember(answer), "gpu");
    EXPECT_GT(view_->statistics().gpuParticles, 0u);
    const Picture freely = pictureOf(depthMember(answer), "cpu"); // most are below the surface and invisible
    double brightness = 0, difference = 0, without = 0;
    for (size_t i = 0; i < plane.texels.size(); ++i) {
        brightness += double(plane.texels[i]);
        difference += double(std::abs(plane.texels[i] - seen.texels[i]));
        without += double(std::abs(plane.texels[i] - freely.texels[i]));
    }
    EXPECT_GT(brightness, 0.0);
    EXPECT_LE(difference, 0.05 * brightness);
    EXPECT_GE(without, 0.2 * brightness);
}

} // namespace fx::test
