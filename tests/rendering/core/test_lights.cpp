#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/particle_kind.h"
#include "rendering/lights/extinction_grid.h"
#include "rendering/optics/black_body.h"
#include "rendering/techniques/draw_techniques.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

using namespace fx::render;
namespace column = fx::base::blob_column;

namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

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

TEST(ExtinctionGrid, holdsTheCrossSectionOfItsBlobs)
{
    ExtinctionGrid grid(std::pmr::get_default_resource());
    const std::array<GridBlob, 3> blobs{
        {{{0, 0, 0}, 1.0f, 2.0f}, {{3, 1, 0}, 0.5f, 0.7f}, {{-2, 4, 1}, 2.0f, 5.0f}}};
    grid.build(blobs);
    EXPECT_NEAR(grid.totalCrossSection(), 7.7, 1e-5);
}

TEST(ExtinctionGrid, withoutBlobsLetsEverythingThrough)
{
    ExtinctionGrid grid(std::pmr::get_default_resource());
    grid.build({});
    EXPECT_EQ(grid.transmittance({0, 0, 0}, {0, 1, 0}, kFar), 1.0f);
}

TEST(ExtinctionGrid, shadowsWhatLiesBehindAndNotWhatLiesBeside)
{
    ExtinctionGrid grid(std::pmr::get_default_resource());
    const std::array<GridBlob, 2> blobs{{{{0, 5, 0}, 2.0f, 12.0f}, {{0, -5, 0}, 2.0f, 0.0f}}};
    grid.build(blobs);
    EXPECT_LT(grid.transmittance({0, -5, 0}, {0, 1, 0}, kFar), 0.3f);
    EXPECT_GT(grid.transmittance({0, -5, 0}, {0, -1, 0}, kFar), 0.999f);
    EXPECT_GT(grid.transmittance({0, -5, 0}, {0, 1, 0}, 3.0f), 0.999f)
        << "what is beyond the light casts no shadow";
}

TEST(ExtinctionGrid, throughAWideSlabMatchesBeersLaw)
{
    // 40 x 40 blobs in a plane: extinction per area is 1 m2 / (0.25 m)^2 * 0.05 = 0.8
    std::vector<GridBlob> blobs;
    for (int x = 0; x < 40; ++x)
        for (int z = 0; z < 40; ++z)
            blobs.push_back({{0.25f * float(x), 0.0f, 0.25f * float(z)}, 0.6f, 0.05f});
    blobs.push_back({{5.0f, -8.0f, 5.0f}, 0.6f, 0.0f});
    ExtinctionGrid grid(std::pmr::get_default_resource());
    grid.build(blobs);
    EXPECT_NEAR(grid.transmittance({5.0f, -8.0f, 5.0f}, {0, 1, 0}, kFar), std::exp(-0.8f), 0.08f);
}

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

TEST(BallLight, isFiniteAtItsCenterAndFallsWithTheSquareFarAway)
{
    const BallLight light({0, 0, 0}, {100, 100, 100}, 1.0f);
    EXPECT_EQ(light.at({0, 0, 0}).illuminance.x, 100.0f);
    EXPECT_NEAR(light.at({0, 100, 0}).illuminance.x / 0.01f, 1.0f, 1e-3f);
    EXPECT_NEAR(light.at({0, 100, 0}).direction.y, -1.0f, 1e-6f);
}

TEST(BallLight, ofAnyRadiusIsAtItsSurfaceHalfAsBrightAsAtItsCenter)
{
    const BallLight light({0, 0, 0}, {100, 100, 100}, 2.0f);
    EXPECT_FLOAT_EQ(light.at({0, 0, 0}).illuminance.x, 25.0f);
    EXPECT_FLOAT_EQ(light.at({0, 2, 0}).illuminance.x, 12.5f);
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
