#include "foundation/random/philox.h"
#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/particle_kind.h"
#include "rendering/optics/black_body.h"
#include "rendering/techniques/draw_techniques.h"
#include "shaders/formulas/formula.h"

#include <gtest/gtest.h>

#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

using namespace fx::render;
namespace column = fx::base::blob_column;

namespace {

/// A snapshot with one group of equal blobs on a line.
fx::base::FrameSnapshot glowingLine(const fx::base::SnapshotSchema& schema, uint32_t count,
                                    float crossSection, float temperature)
{
    fx::base::FrameSnapshot snapshot(&schema, std::pmr::get_default_resource());
    snapshot.begin(0, 1);
    auto& group = snapshot.addGroup(schema.find("blob"), count);
    group.editInfo().count = count;
    group.editInfo().placement.position = {100.0, 0.0, 0.0};
    for (uint32_t i = 0; i < count; ++i) {
        for (size_t c = 0; c < column::Count; ++c)
            group.editColumn(c)[i] = 0.0f;
        group.editIds()[i] = i;
        group.editColumn(column::PositionX)[i] = 50.0f * float(i);
        group.editColumn(column::Radius)[i] = 1.0f;
        group.editColumn(column::CrossSection)[i] = crossSection;
        group.editColumn(column::Temperature)[i] = temperature;
    }
    return snapshot;
}

fx::base::SnapshotSchema blobSchema()
{
    fx::base::SnapshotSchema schema;
    schema.add(fx::base::kBlobKind);
    return schema;
}

} // namespace

TEST(EffectLights, thinGasSendsItsCrossSectionTimesItsLuminance)
{
    const auto schema = blobSchema();
    const auto snapshot = glowingLine(schema, 1, 1e-3f, 1500.0f);
    std::array<EffectLight, 4> lights;
    ASSERT_EQ(effectLights(snapshot, lights), 1u);
    EXPECT_NEAR(lights[0].intensity.x / (1e-3f * blackBodyLuminance(1500.0f).x), 1.0f, 0.02f); // 96 lines
    EXPECT_NEAR(lights[0].position.x, 100.0, 1e-6);
}

TEST(EffectLights, coldGasIsNoLight)
{
    const auto schema = blobSchema();
    const auto snapshot = glowingLine(schema, 3, 1.0f, 400.0f);
    std::array<EffectLight, 4> lights;
    EXPECT_EQ(effectLights(snapshot, lights), 0u);
}

TEST(EffectLights, liesAtTheCenterOfTheEmission)
{
    const auto schema = blobSchema();
    const auto snapshot = glowingLine(schema, 3, 0.1f, 1500.0f);
    std::array<EffectLight, 1> lights;
    ASSERT_EQ(effectLights(snapshot, lights), 1u);
    EXPECT_NEAR(lights[0].position.x, 150.0, 1e-3);
    EXPECT_GT(lights[0].radius, 30.0f);
}

// The integral over all rays past the middle of the ball.
TEST(EffectLights, aBallShowsItsFaceWhateverItsDepth)
{
    const auto schema = blobSchema();
    for (const float s : {0.01f, 0.3f, 3.0f, 20.0f, 200.0f}) {
        const auto snapshot = glowingLine(schema, 1, s, 1500.0f);
        std::array<EffectLight, 1> lights;
        ASSERT_EQ(effectLights(snapshot, lights), 1u);
        double area = 0;
        const int rays = 4000;
        for (int i = 0; i < rays; ++i) {
            const double b = (i + 0.5) / rays;
            const double depth = fx::formula64::fxKernelOpticalDepth(double(s), 1.0, b, 0.0, -2.0, 2.0);
            area += (1.0 - std::exp(-depth)) * 2.0 * std::numbers::pi * b / rays;
        }
        const double expected = area * double(blackBodyLuminance(1500.0f).x);
        EXPECT_NEAR(double(lights[0].intensity.x) / expected, 1.0, 0.04) << s;
    }
}

// Against rays through all balls of a cloud of even temperature, in three directions.
TEST(EffectLights, aCloudOfBallsSendsWhatItsFaceShows)
{
    const auto schema = blobSchema();
    for (const float s : {0.02f, 0.3f, 2.0f}) {
        const uint32_t count = 300;
        auto snapshot = glowingLine(schema, count, s, 1500.0f);
        auto& group = snapshot.editGroup(0);
        std::vector<glm::dvec3> places;
        for (uint32_t i = 0; i < count; ++i) {
            const auto r = fx::base::randomUnit4(7, 0, i, fx::base::RandomPurpose::Attributes);
            const double z = 2.0 * double(r[0]) - 1.0, turn = 2.0 * std::numbers::pi * double(r[1]);
            const double out = 3.0 * std::cbrt(double(r[2])), across = std::sqrt(1.0 - z * z);
            places.push_back(out * glm::dvec3(across * std::cos(turn), across * std::sin(turn), z));
            for (int a = 0; a < 3; ++a)
                group.editColumn(column::PositionX + size_t(a))[i] = float(places.back()[a]);
        }
        std::array<EffectLight, 1> lights;
        ASSERT_EQ(effectLights(snapshot, lights), 1u);
        double area = 0;
        const double step = 0.1;
        for (int axis = 0; axis < 3; ++axis)
            for (double x = -4.0; x < 4.0; x += step)
                for (double y = -4.0; y < 4.0; y += step) {
                    double depth = 0;
                    for (const glm::dvec3& p : places) {
                        const double b = std::hypot(p[axis] - x, p[(axis + 1) % 3] - y);
                        depth += fx::formula64::fxKernelOpticalDepth(double(s), 1.0, b, 0.0, -2.0, 2.0);
                    }
                    area += (1.0 - std::exp(-depth)) * step * step / 3.0;
                }
        const double expected = area * double(blackBodyLuminance(1500.0f).x);
        EXPECT_NEAR(double(lights[0].intensity.x) / expected, 1.0, 0.1) << s;
        EXPECT_NEAR(lights[0].ownReach, 3.3f, 0.3f);
    }
}

// Both in one group: balls around a hot one, through which exp(-depth) passes.
TEST(EffectLights, coldGasAroundAFireHidesIt)
{
    const auto schema = blobSchema();
    const auto lightBehind = [&](float s) {
        auto snapshot = glowingLine(schema, 2, 0.05f, 1500.0f);
        auto& group = snapshot.editGroup(0);
        for (size_t i = 0; i < 2; ++i)
            group.editColumn(column::PositionX)[i] = 0.0f;
        group.editColumn(column::Radius)[1] = 6.0f;
        group.editColumn(column::CrossSection)[1] = s;
        group.editColumn(column::Temperature)[1] = 300.0f;
        std::array<EffectLight, 1> lights;
        EXPECT_EQ(effectLights(snapshot, lights), 1u);
        EXPECT_TRUE(s < 1.0f || lights[0].ownReach > 5.0f)
            << "the shadow of the cold gas is in the intensity";
        return double(lights[0].intensity.x);
    };
    const double free = lightBehind(1e-6f);
    for (const float s : {20.0f, 60.0f, 200.0f}) {
        const double depth = fx::formula64::fxKernelOpticalDepth(double(s), 6.0, 0.0, 0.0, 0.0, 6.0);
        EXPECT_NEAR(lightBehind(s) / free / std::exp(-depth), 1.0, 0.15) << s;
    }
}

TEST(EffectLights, aListOfParticleLightsShinesAsOneLightInItsMiddle)
{
    namespace light = fx::base::light_column;
    fx::base::SnapshotSchema schema = blobSchema();
    schema.add(fx::base::kLightKind);
    fx::base::FrameSnapshot snapshot(&schema, std::pmr::get_default_resource());
    snapshot.begin(0, 1);
    auto& group = snapshot.addGroup(schema.find("light"), 2);
    group.editInfo().count = 2;
    group.editInfo().placement.position = {0.0, 10.0, 0.0};
    group.editInfo().placement.scale = 2.0f;
    for (uint32_t i = 0; i < 2; ++i)
        for (size_t c = 0; c < light::Count; ++c)
            group.editColumn(c)[i] = 0.0f;
    group.editColumn(light::PositionX)[1] = 4.0f;
    group.editColumn(light::IntensityR)[0] = 100.0f;
    group.editColumn(light::IntensityG)[1] = 300.0f;
    std::array<EffectLight, 4> out;
    ASSERT_EQ(effectLights(snapshot, out), 1u);
    EXPECT_NEAR(out[0].position.x, 6.0, 1e-5); // 3/4 of the way, twice as large
    EXPECT_NEAR(out[0].position.y, 10.0, 1e-5);
    EXPECT_NEAR(out[0].intensity.r, 400.0f, 1e-3f); // lengths are doubled, luminances are not
    EXPECT_NEAR(out[0].intensity.g, 1200.0f, 1e-3f);
    EXPECT_NEAR(out[0].radius, 2.0f * std::sqrt(3.0f), 1e-4f); // rms distance of 1/4 at 3 m, 3/4 at 1 m
}
