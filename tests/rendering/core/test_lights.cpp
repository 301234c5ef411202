#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/particle_kind.h"
#include "rendering/optics/black_body.h"
#include "rendering/techniques/draw_techniques.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

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
    EXPECT_NEAR(lights[0].intensity.x / (1e-3f * blackBodyLuminance(1500.0f).x), 1.0f, 0.01f);
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

TEST(EffectLights, thickGasShowsOnlyItsFace)
{
    // One ball of optical depth t sends B s (1 - exp(-t)) / t, seen through the mean depth of its group, s
    // over its face.
    const auto schema = blobSchema();
    const float s = 20.0f;
    const auto snapshot = glowingLine(schema, 1, s, 1500.0f);
    std::array<EffectLight, 1> lights;
    ASSERT_EQ(effectLights(snapshot, lights), 1u);
    const auto escape = [](float t) { return (1.0f - std::exp(-t)) / t; };
    const float pi = std::numbers::pi_v<float>;
    const float expected = s * blackBodyLuminance(1500.0f).x * escape(3.5f * s / pi) * escape(s / pi);
    EXPECT_NEAR(lights[0].intensity.x / expected, 1.0f, 0.01f);
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
