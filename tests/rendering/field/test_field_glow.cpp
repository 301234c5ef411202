// The light that fields emit, spread over them: no light is made or lost, furnace, inverse square, symmetry,
// and the formula against double.
#include "rendering/field/field_glow_pass.h"
#include "rendering/field/field_light_pass.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/stage/stage_camera.h"
#include "shaders/formulas/formula.h"
#include "tests/rendering/field/field_fixture.h"

#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace fx;
using namespace fx::render;
using namespace fx::test;

namespace {

constexpr int kCells = kGlowCells * kGlowCells * kGlowCells;

glm::ivec3 cellOf(int i)
{
    return {i % kGlowCells, i / kGlowCells % kGlowCells, i / (kGlowCells * kGlowCells)};
}

int indexOf(const glm::ivec3& cell)
{
    return cell.x + kGlowCells * (cell.y + kGlowCells * cell.z);
}

/// A ball in the origin.
FieldBall ball(float radius, float opticalDepth, const glm::vec3& emission, float albedo = 0.0f)
{
    FieldBall b;
    b.radius = radius;
    b.crossSection = opticalDepth * std::numbers::pi_v<float> * radius * radius / 3.5f;
    b.emission = emission;
    b.albedo = glm::vec3(albedo);
    return b;
}

} // namespace

class FieldGlow : public FieldTest
{
protected:
    /// Fills, and spreads the light; textures stay for the test.
    void spread(const std::vector<FieldBall>& balls, int resolution = 48)
    {
        const FieldScene scene(balls, view_);
        fill(scene, resolution);
        ASSERT_EQ(plan_.glows().size(), 1u);
        side_ = plan_.glows()[0].corner.w;
        corner_ = glm::vec3(plan_.glows()[0].corner) + eye_;
        glowVolumes_.clear();
        constexpr Format kFormats[] = {Format::RGBA32F, Format::RGBA16F, Format::RGBA16F, Format::RGBA16F,
                                       Format::RGBA16F};
        for (size_t i = 0; i < 5; ++i) {
            auto made = GlTexture::createVolume(*device_, (i == 2 ? kGlowRays[0] : 1) * kGlowCells,
                                                (i == 2 ? kGlowRays[1] : 1) * kGlowCells, kGlowCells,
                                                glInternalFormat(kFormats[i]), "glow");
            ASSERT_TRUE(made.ok()) << made.status().message();
            glowVolumes_.push_back(std::move(*made));
        }
        graph_->begin();
        FieldGlowPass::Inputs in{};
        in.fieldTexels = importTexelsOfFields();
        in.grids = importBytes(std::as_bytes(plan_.glows()));
        in.field = importTextures();
        in.fieldCount = uint32_t(plan_.fields().size());
        in.gridCount = 1;
        in.extent = glowExtent(plan_.glows());
        ResourceId* const ids[] = {&in.glow.cells, &in.glow.scatter, &in.glow.rays, &in.glow.first,
                                   &in.glow.light};
        for (size_t i = 0; i < 5; ++i)
            *ids[i] = graph_->importTexture(
                {"glow", glowVolumes_[i].width(), glowVolumes_[i].height(), kFormats[i]},
                glowVolumes_[i].name());
        execute(FieldGlowPass::addTo(*graph_, in).glow.light);
        first_ = read(3);
        light_ = read(4);
    }

    std::vector<float> read(size_t texture)
    {
        return readTexture(*device_, glowVolumes_[texture].name(), kGlowCells, kGlowCells * kGlowCells, 4);
    }
    /// [m] world, of the middle of a cell.
    glm::dvec3 middle(int i) const
    {
        return glm::dvec3(corner_) + double(side_) * (glm::dvec3(cellOf(i)) + 0.5);
    }
    /// The mean of a cell of emitted light, not scattered.
    glm::vec3 first(int i) const
    {
        return {first_[size_t(4 * i)], first_[size_t(4 * i + 1)], first_[size_t(4 * i + 2)]};
    }
    glm::vec3 light(int i) const
    {
        return glm::exp(
            glm::vec3(light_[size_t(4 * i)], light_[size_t(4 * i + 1)], light_[size_t(4 * i + 2)]));
    }

    const glm::vec3 eye_{0.0f, 0.0f, 9.0f};
    const CameraView view_ = camera(glm::dvec3(eye_), {0, 0, 0});
    std::vector<GlTexture> glowVolumes_;
    std::vector<float> first_, light_;
    float side_ = 0;
    glm::vec3 corner_{0.0f}; ///< [m] world
};

TEST(FieldGlowFormulas, areThoseOfTheirComment)
{
    for (double tau = 1e-6; tau < 1e3; tau *= 1.3) {
        const double e = -std::expm1(-tau) / tau, r = tau < 1e-3 ? 0.5 - tau / 6.0 : (1.0 - e) / tau;
        EXPECT_NEAR(formula64::fxGlowShare(tau), e, 2e-6) << tau;
        EXPECT_NEAR(formula::fxGlowShare(float(tau)), e, 2e-6) << tau;
        EXPECT_NEAR(formula64::fxGlowRest(tau), r, 1e-4) << tau;
        EXPECT_NEAR(formula::fxGlowRest(float(tau)), r, 1e-4) << tau;
    }
    EXPECT_EQ(formula::fxGlowShare(0.0f), 1.0f);
    EXPECT_EQ(formula::fxGlowRest(0.0f), 0.5f);
    for (const float albedo : {0.0f, 0.2f, 0.9f})
        EXPECT_NEAR(formula::fxGlowOrders((1.0f - albedo) * 7.0f, (1.0f - albedo * albedo) * 7.0f, albedo),
                    7.0f, 1e-5f);
    EXPECT_EQ(formula::fxGlowOrders(0.0f, 0.0f, 0.5f), 0.0f);
    EXPECT_EQ(formula::fxGlowOrders(1.0f, 3.0f, 0.0f), 3.0f) << "black medium scatters nothing";
}

TEST_F(FieldGlow, deepInAHotMediumItIsThatOfTheMedium)
{
    for (const float albedo : {0.0f, 0.3f, 0.8f}) {
        spread({ball(2.0f, 400.0f, (1.0f - albedo) * glm::vec3(5, 3, 1), albedo)});
        const int center = indexOf(glm::ivec3(kGlowCells / 2));
        EXPECT_NEAR(light(center).r, 5.0f, 0.05f) << albedo;
        EXPECT_NEAR(light(center).g, 3.0f, 0.03f) << albedo;
        EXPECT_NEAR(light(center).b, 1.0f, 0.01f) << albedo;
        for (int i = 0; i < kCells; ++i)
            ASSERT_LT(light(i).r, 5.05f) << "nowhere is more light than in a furnace";
    }
}

TEST_F(FieldGlow, ofAThinEmitterItFallsWithTheSquareOfTheDistance)
{
    FieldBall far = ball(0.8f, 1e-4f, glm::vec3(0.0f)); // makes room around the emitter
    far.effect = 1;
    std::vector<FieldBall> balls{ball(0.8f, 0.02f, glm::vec3(40.0f))};
    for (const float x : {-1.4f, 1.4f}) {
        far.center = {x, x, x};
        balls.push_back(far);
    }
    spread(balls);
    const double power = 40.0 * double(balls[0].crossSection); // [exposed m2] all that it emits
    double sums[3] = {}, squares[3] = {};
    int counts[3] = {};
    for (int i = 0; i < kCells; ++i) {
        const double r = glm::length(middle(i)) / 0.8;
        const int shell = r > 1.0 && r < 1.25 ? 0 : r > 1.25 && r < 1.5 ? 1 : r > 1.5 && r < 1.8 ? 2 : -1;
        if (shell < 0)
            continue;
        // mean of 1 / d^2 over a ball of the kernel: second moments are R^2 / 3
        const double exact = power / (4.0 * std::numbers::pi * r * r * 0.64) * (1.0 + 1.0 / (9.0 * r * r));
        const double q = double(light(i).r) / exact;
        sums[shell] += q;
        squares[shell] += q * q;
        ++counts[shell];
    }
    for (int shell = 0; shell < 3; ++shell) {
        const double mean = sums[shell] / counts[shell];
        EXPECT_NEAR(mean, 1.0, 0.06) << shell;
        EXPECT_LT(std::sqrt(squares[shell] / counts[shell] - mean * mean), 0.5) << shell;
    }
}

TEST_F(FieldGlow, whatAShellAbsorbsIsWhatItsCoreEmits)
{
    FieldBall shell = ball(2.0f, 60.0f, glm::vec3(0.0f));
    shell.effect = 1;
    spread({ball(0.7f, 3.0f, glm::vec3(9, 4, 2)), shell});
    const std::vector<float> medium = [&] { // after the second order: extinction; emission is black
        return read(0);
    }();
    glm::dvec3 absorbed(0.0);
    for (int i = 0; i < kCells; ++i)
        absorbed += double(medium[size_t(4 * i + 3)]) * glm::dvec3(first(i)) * std::pow(double(side_), 3.0);
    const double section = double(ball(0.7f, 3.0f, {}).crossSection);
    EXPECT_NEAR(absorbed.r, 9.0 * section, 0.02 * 9.0 * section);
    EXPECT_NEAR(absorbed.g, 4.0 * section, 0.02 * 4.0 * section);
    EXPECT_NEAR(absorbed.b, 2.0 * section, 0.02 * 2.0 * section);
}

// A hot core in cold soot: what is left behind a depth tau of the soot is no more than exp(-tau) of what
// comes to it.
TEST_F(FieldGlow, behindALayerOfSootTheLightHasDecayed)
{
    FieldBall shell = ball(2.0f, 150.0f, glm::vec3(0.0f));
    shell.effect = 1;
    spread({ball(0.7f, 3.0f, glm::vec3(900, 400, 200)), shell});
    // the way to a cell is known within half of its side
    const double slack =
        std::exp(0.5 * double(side_) * formula64::fxKernelPeak(double(shell.crossSection), 2.0));
    int count = 0;
    for (int i = 0; i < kCells; ++i) {
        const double r = glm::length(middle(i));
        if (r < 1.1 || r > 1.7)
            continue;
        const double tau = formula64::fxKernelOpticalDepth(double(shell.crossSection), 2.0, 0.0, 0.0, 0.8, r);
        // the core is seen under a solid angle
        const double most = 900.0 * std::exp(-tau) * 0.5 * (1.0 - std::sqrt(1.0 - 0.49 / (r * r)));
        ASSERT_LT(double(light(i).r), slack * most + 2e-6) << r;
        ++count;
    }
    EXPECT_GT(count, 400);
}

TEST_F(FieldGlow, ofARoundEmitterItIsTheSameOnAllSides)
{
    spread({ball(1.5f, 2.0f, glm::vec3(10.0f), 0.5f)});
    const glm::dvec3 center = glm::dvec3(corner_) + 16.0 * double(side_);
    ASSERT_LT(glm::length(center), 1e-4) << "the middle of the grid is that of the ball";
    for (int i = 0; i < kCells; ++i) {
        const glm::ivec3 c = cellOf(i);
        for (const glm::ivec3 other :
             {glm::ivec3(31 - c.x, c.y, c.z), glm::ivec3(c.y, c.x, c.z), glm::ivec3(c.z, c.y, c.x)})
            ASSERT_NEAR(light(i).r, light(indexOf(other)).r, 0.02f + 0.01f * light(i).r) << i;
    }
}

TEST_F(FieldGlow, aPointThatStandsForTheMediumIsNotCountedOnceMore)
{
    const std::vector<FieldBall> balls{ball(1.5f, 2.0f, glm::vec3(1.0f), 0.5f)};
    LightListBlock lights{};
    lights.counts = {2, 0, 1, 0};
    lights.lights[0].place = {0, 1, 0, 0};
    lights.lights[1].place = glm::vec4(-eye_, 0.2f);
    lights.lights[1].cone = {0, 0, 0, 1}; // to all sides
    const auto litBy = [&](float kind, bool withGlow) {
        lights.lights[1].color = {4.0f, 4.0f, 4.0f, kind};
        spread(balls);
        graph_->begin();
        const ViewBlock view = makeViewBlock(view_, kFieldWidth, kFieldHeight);
        FieldLightPass::Inputs in{importBytes(std::as_bytes(plan_.fields())),
                                  importBytes(std::as_bytes(plan_.bricks())),
                                  importTextures(),
                                  {.lights = importBytes(std::as_bytes(std::span(&lights, 1)))},
                                  &view,
                                  uint32_t(plan_.bricks().size())};
        in.glow =
            graph_->importTexture({"glow", kGlowCells, kGlowCells, Format::RGBA16F}, glowVolumes_[4].name());
        in.grids = importBytes(std::as_bytes(plan_.glows()));
        if (!withGlow) {
            std::vector<FieldBlock> fields(plan_.fields().begin(), plan_.fields().end());
            for (FieldBlock& field : fields)
                field.limits.w = 0.0f;
            in.fields = importBytes(std::as_bytes(std::span(fields)));
        }
        execute(FieldLightPass::addTo(*graph_, in).textures.medium);
        const std::vector<float> medium = texels(0);
        double sum = 0;
        for (size_t i = 0; i < medium.size(); i += 4)
            sum += std::isfinite(medium[i]) ? double(medium[i]) : 0.0;
        return sum;
    };
    const double own = litBy(2.0f, true), other = litBy(1.0f, true), point = litBy(2.0f, false);
    lights.lights[1].place = {100.0f, 0.0f, 0.0f, 0.2f}; // too far to light anything
    const double alone = litBy(2.0f, true), dark = litBy(2.0f, false);
    EXPECT_NEAR(own / alone, 1.0, 1e-3);
    EXPECT_GT(other, 1.2 * alone);
    EXPECT_GT(point, 1.2 * dark);
    EXPECT_GT(alone, 1.02 * dark) << "the medium lights itself";
}

TEST_F(FieldGlow, fieldsThatDoNotEmitHaveNoGrid)
{
    const FieldScene scene({ball(1.0f, 2.0f, glm::vec3(0.0f))}, view_);
    plan_.build(scene.inputs(256, 256, 48));
    EXPECT_TRUE(plan_.glows().empty());
    EXPECT_EQ(plan_.fields()[0].limits.w, 0.0f);
}
