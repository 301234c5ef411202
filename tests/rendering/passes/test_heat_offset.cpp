#include "rendering/frame_graph/recording_backend.h"
#include "rendering/passes/blob_instance.h"
#include "rendering/passes/heat_offset_pass.h"
#include "shaders/formulas/formula.h"
#include "simulation/motion/ambient_air.h"
#include "tests/rendering/passes/post_pass_harness.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <limits>

namespace {

using namespace fx;
using namespace fx::render;

constexpr int kWidth = 96;
constexpr int kHeight = 64;
constexpr float kInf = std::numeric_limits<float>::infinity();

double stream(double x, double y, double phase, double seed)
{
    return formula64::fxHeatEddies(x, y, phase, seed) * formula64::fxHeatColumn(x * x + y * y);
}

BlobInstance ball(glm::vec3 center, float radius, float heat, float seed = 0.25f)
{
    BlobInstance blob{};
    blob.centerRadius = {center, radius};
    blob.medium = {1.0f, heat, 0.0f, seed};
    return blob;
}

/// 90 degrees vertically: one unit of slope is kHeight / 2 pixels.
ViewBlock straightView()
{
    CameraView camera;
    camera.projection = glm::perspective(1.57079637f, float(kWidth) / float(kHeight), 0.1f, 100.0f);
    return makeViewBlock(camera, kWidth, kHeight);
}

class HeatOffset : public test::PostPass
{
protected:
    std::vector<float> draw(const std::vector<BlobInstance>& blobs, float distance, double time)
    {
        graph_->begin();
        const std::vector<float> distances(kWidth * kHeight, distance);
        HeatOffsetPass::Inputs in{};
        in.distance = importScalar(kWidth, kHeight, distances);
        in.blobs = importBytes(std::as_bytes(std::span(blobs)));
        in.count = uint32_t(blobs.size());
        in.anyHeat = true;
        in.width = kWidth;
        in.height = kHeight;
        in.view = straightView();
        in.time = time;
        const ResourceId heat = HeatOffsetPass::addTo(*graph_, in).heat;
        execute(heat);
        return read(heat);
    }
};

} // namespace

TEST(HeatStream, slopesAreThoseOfTheStreamFunction)
{
    constexpr double h = 1e-6;
    for (double x = -0.95; x < 1.0; x += 0.11)
        for (double y = -0.95; y < 1.0; y += 0.13) {
            const double byX = (stream(x + h, y, 0.3, 0.7) - stream(x - h, y, 0.3, 0.7)) / (2 * h);
            const double byY = (stream(x, y + h, 0.3, 0.7) - stream(x, y - h, 0.3, 0.7)) / (2 * h);
            EXPECT_NEAR(formula64::fxHeatStreamX(x, y, 0.3, 0.7), byX, 2e-3);
            EXPECT_NEAR(formula64::fxHeatStreamY(x, y, 0.3, 0.7), byY, 2e-3);
        }
}

TEST(HeatStream, nothingIsBentAtTheRimAndOutside)
{
    for (const float angle : {0.0f, 1.0f, 2.5f, 4.0f})
        for (const float r : {1.0001f, 1.5f, 9.0f}) {
            EXPECT_EQ(formula::fxHeatStreamX(r * std::cos(angle), r * std::sin(angle), 0.1f, 0.2f), 0.0f);
            EXPECT_EQ(formula::fxHeatStreamY(r * std::cos(angle), r * std::sin(angle), 0.1f, 0.2f), 0.0f);
        }
}

TEST(HeatStream, theDisplacementThinsThePictureNowhereOnAverage)
{
    // flux through circles around the center: zero for a curl
    for (const double r : {0.2, 0.5, 0.8}) {
        double flux = 0.0;
        for (int i = 0; i < 4096; ++i) {
            const double a = 2.0 * 3.14159265358979 * i / 4096;
            const double x = r * std::cos(a);
            const double y = r * std::sin(a);
            flux += formula64::fxHeatStreamY(x, y, 0.4, 0.1) * std::cos(a) -
                    formula64::fxHeatStreamX(x, y, 0.4, 0.1) * std::sin(a);
        }
        EXPECT_NEAR(flux / 4096, 0.0, 1e-3) << r;
    }
}

TEST(HeatStream, eddiesStayBelowOneAndRepeatAfterAPeriod)
{
    for (double x = -2.0; x < 2.0; x += 0.17)
        for (double phase = 0.0; phase < 1.0; phase += 0.07) {
            EXPECT_LE(std::abs(formula64::fxHeatEddies(x, 0.3 * x, phase, 0.6)), 1.0 + 1e-12);
            EXPECT_NEAR(formula64::fxHeatEddies(x, 0.4, phase, 0.6),
                        formula64::fxHeatEddies(x, 0.4, phase + 1.0, 0.6), 1e-9);
        }
}

TEST(HeatRefraction, followsTheDensityOfAir)
{
    EXPECT_EQ(formula64::fxHeatShare(0.0), 0.0);
    EXPECT_EQ(formula64::fxHeatShare(sim::kAirKelvin), 0.5); // twice the temperature, half the density
    EXPECT_EQ(formula64::fxHeatShare(-50.0), 0.0);
    EXPECT_LT(formula64::fxHeatShare(3000.0), 1.0);
    EXPECT_NEAR(formula64::fxHeatRefraction(sim::kAirKelvin), 16.0 / 15.0 * 2.73e-4 * 0.5, 1e-12);
}

TEST(HeatPhase, isExactlyPeriodicAfterALongTime)
{
    for (const double t : {0.0, 0.25, 3.125, 7.75, 1e7 + 0.25}) {
        EXPECT_EQ(heatPhase(t), heatPhase(t + kHeatPeriod));
        EXPECT_EQ(heatPhase(t), heatPhase(t + 1250000.0 * kHeatPeriod));
    }
    EXPECT_EQ(heatPhase(2.0), 0.25f);
    EXPECT_EQ(heatPhase(-2.0), 0.75f);
    EXPECT_EQ(heatPhase(double(kInf)), 0.0f);
    EXPECT_EQ(heatPhase(std::nan("")), 0.0f);
    EXPECT_LT(heatPhase(std::nextafter(8.0, 0.0)), 1.0f);
}

TEST_F(HeatOffset, drawsTheCurlOfTheStreamFunctionInPixels)
{
    const glm::dvec3 center(0.0, 0.0, -40.0);
    const double radius = 12.0;
    const auto heat = draw({ball(center, float(radius), 900.0f)}, kInf, 2.0);
    const double scale = formula64::fxHeatRefraction(900.0) * kHeight / 2.0;
    double largest = 0.0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const glm::dvec3 ray =
                glm::normalize(glm::dvec3(2 * x + 1 - kWidth, 2 * y + 1 - kHeight, -kHeight));
            const glm::dvec3 across = (glm::dot(center, ray) * ray - center) / radius;
            const glm::dvec3 horizontal = glm::normalize(glm::dvec3(1, 0, 0) - ray.x * ray);
            const double px = glm::dot(across, horizontal);
            const double py = glm::dot(across, glm::cross(horizontal, ray));
            const double q = glm::dot(across, across);
            const float* got = &heat[size_t(y * kWidth + x) * 4];
            EXPECT_NEAR(got[0], scale * formula64::fxHeatStreamY(px, py, 0.25, 0.25), scale * 1e-3);
            EXPECT_NEAR(got[1], -scale * formula64::fxHeatStreamX(px, py, 0.25, 0.25), scale * 1e-3);
            EXPECT_NEAR(got[2], formula64::fxHeatShare(900.0) * formula64::fxHeatColumn(q), 1e-5);
            EXPECT_TRUE(q < 1.0001 || got[3] == 0.0f);
            largest = std::max(largest, std::hypot(double(got[0]), double(got[1])) / scale);
        }
    EXPECT_GT(largest, 4.0);
    EXPECT_LT(largest, 18.5);
}

TEST_F(HeatOffset, gasBehindAWallBendsNothing)
{
    for (const float v : draw({ball({0, 0, -10}, 2.0f, 900.0f)}, 7.0f, 0.0))
        ASSERT_EQ(v, 0.0f);
}

TEST_F(HeatOffset, aWallThroughTheMiddleHalvesTheHeat)
{
    const auto whole = draw({ball({0, 0, -10}, 2.0f, 900.0f)}, kInf, 0.0);
    const auto half = draw({ball({0, 0, -10}, 2.0f, 900.0f)}, 10.0f, 0.0);
    const size_t middle = size_t(kHeight / 2 * kWidth + kWidth / 2) * 4;
    EXPECT_NEAR(half[middle + 2], 0.5f * whole[middle + 2], 1e-3f);
    EXPECT_NEAR(half[middle], 0.5f * whole[middle], 1e-3f);
}

TEST_F(HeatOffset, coldBlobsDrawNothingAndEqualOnesAddUp)
{
    const BlobInstance hot = ball({1, 0.5f, -8}, 2.0f, 500.0f);
    const auto one = draw({hot, ball({0, 0, -5}, 3.0f, 0.0f)}, kInf, 1.0);
    const auto two = draw({hot, hot}, kInf, 1.0);
    float largest = 0.0f;
    for (size_t i = 0; i < one.size(); ++i) {
        ASSERT_EQ(two[i], 2.0f * one[i]);
        largest = std::max(largest, one[i]);
    }
    EXPECT_GT(largest, 0.0f);
    // distance comes along, weighted
    const size_t at = size_t((kHeight / 2 + 2) * kWidth + kWidth / 2 + 4) * 4;
    EXPECT_NEAR(one[at + 3] / one[at + 2], 8.06f, 0.05f);
}

TEST_F(HeatOffset, looksTheSameAfterAPeriodAndDifferentBetween)
{
    const std::vector<BlobInstance> blobs{ball({0, 0, -6}, 2.0f, 700.0f)};
    const auto first = draw(blobs, kInf, 0.75);
    EXPECT_EQ(test::differentBits(first, draw(blobs, kInf, 0.75 + 1e6 * kHeatPeriod)), 0u);
    EXPECT_GT(test::differentBits(first, draw(blobs, kInf, 0.80)), 100u);
}

TEST(HeatOffsetInTheGraph, isAbsentWithoutHeatOrStrength)
{
    HeatOffsetPass::Inputs in{};
    in.count = 5;
    in.anyHeat = true;
    in.width = in.height = 16;
    const auto adds = [](HeatOffsetPass::Inputs inputs) {
        FrameGraph graph(std::pmr::new_delete_resource());
        graph.begin();
        inputs.blobs = graph.importBuffer({"blobs", 400}, 1);
        inputs.distance = graph.importTexture({"distance", 16, 16, Format::R32F}, 2);
        const ResourceId heat = HeatOffsetPass::addTo(graph, inputs).heat;
        if (heat.valid())
            graph.keep(heat);
        graph.compile();
        RecordingBackend backend(graph);
        graph.execute(backend);
        EXPECT_TRUE(backend.violations().empty()) << backend.violations().front();
        EXPECT_EQ(heat.valid(), !graph.executedPasses().empty());
        return heat.valid();
    };
    EXPECT_TRUE(adds(in));
    in.anyHeat = false;
    EXPECT_FALSE(adds(in));
    in.anyHeat = true;
    in.count = 0;
    EXPECT_FALSE(adds(in));
    in.count = 5;
    in.settings.strength = 0.0f;
    EXPECT_FALSE(adds(in));
    in.settings = {.strength = 1.0f, .maxOffset = 0.0f};
    EXPECT_FALSE(adds(in));
}
