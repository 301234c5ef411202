// Balls summed into voxels on the GPU against sums in double, and rays through the voxels against closed
// forms.
#include "benchmarks/scenes/cards.h"
#include "rendering/frame/view_block.h"
#include "rendering/reference/integral/reference_integral.h"
#include "rendering/stage/stage_camera.h"
#include "shaders/formulas/formula.h"
#include "tests/rendering/field/field_fixture.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

using namespace fx;
using namespace fx::render;
using namespace fx::test;

namespace {

struct PixelRay
{
    glm::vec3 direction;
    float nearest; ///< [m] where the near plane cuts it
};

PixelRay rayOf(const CameraView& camera, size_t pixel)
{
    const ViewBlock view = makeViewBlock(camera, kFieldWidth, kFieldHeight);
    const float x = (float(pixel % kFieldWidth) + 0.5f) / kFieldWidth * 2.0f - 1.0f;
    const float y = (float(pixel / kFieldWidth) + 0.5f) / kFieldHeight * 2.0f - 1.0f;
    const glm::vec3 d =
        glm::vec3(view.rayDirection) + x * glm::vec3(view.rayDirectionX) + y * glm::vec3(view.rayDirectionY);
    return {glm::normalize(d), view.rayOriginX.w * glm::length(d)};
}

/// Exact transmittance of balls between the near plane and a wall.
double exactTransmittance(const FieldScene& scene, const PixelRay& ray, float from, float wall)
{
    double depth = 0.0;
    for (const BlobInstance& ball : scene.balls) {
        const glm::vec3 c(ball.centerRadius);
        const float tc = glm::dot(c, ray.direction);
        const float h = glm::length(c - tc * ray.direction);
        if (h < ball.centerRadius.w)
            depth += formula64::fxKernelOpticalDepth(ball.medium.x, ball.centerRadius.w, h, tc,
                                                     std::max(ray.nearest, from), wall);
    }
    return std::exp(-depth);
}

/// Largest and mean error of the opacity of a picture.
struct Errors
{
    double largest = 0.0, mean = 0.0;
};

Errors opacityErrors(const std::vector<float>& drawn, const FieldScene& scene, const CameraView& camera,
                     float from, float wall)
{
    Errors errors;
    const size_t count = size_t(kFieldWidth * kFieldHeight);
    for (size_t i = 0; i < count; ++i) {
        const double wanted = 1.0 - exactTransmittance(scene, rayOf(camera, i), from, wall);
        const double error = std::abs(double(drawn[4 * i + 3]) - wanted);
        errors.largest = std::max(errors.largest, error);
        errors.mean += error / double(count);
    }
    return errors;
}

double largestDifference(const std::vector<float>& a, const std::vector<float>& b)
{
    double largest = a.size() == b.size() ? 0.0 : 1e9;
    for (size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        largest = std::max(largest, double(std::abs(a[i] - b[i])));
    return largest;
}

double largestOf(const std::vector<float>& a)
{
    return double(*std::max_element(a.begin(), a.end()));
}

FieldBall loneBall(float crossSection)
{
    FieldBall ball;
    ball.crossSection = crossSection;
    ball.emission = {3.0f, 2.0f, 1.0f};
    return ball;
}

} // namespace

TEST_F(FieldTest, samplesAreTheSumsOfTheProcessor)
{
    std::vector<FieldBall> balls = randomBalls(150, 5, glm::dvec3(-1.5, 0.0, 0.0));
    for (const FieldBall& ball : randomBalls(80, 6, glm::dvec3(1.5, 0.0, 0.5), 1))
        balls.push_back(ball);
    const FieldScene scene(balls, camera({0, 0, 9}, {0, 0, 0}));
    fill(scene, 64, true); // no ball of fire is so small that it stays a ball
    std::vector<double> red, albedo, meanCosine, dust;
    for (const FieldBall& ball : balls) {
        red.push_back(double(ball.emission.r));
        albedo.push_back(double(ball.albedo.r));
        meanCosine.push_back(double(ball.meanCosine));
        dust.push_back(ball.layer == 2 ? 1.0 - double(ball.fireShare) : 0.0);
    }
    const std::vector<float> medium = texels(0), scatter = texels(1), shares = texels(2);
    double worst = 0.0, largest = 0.0, worstMean = 0.0;
    for (size_t b = 0; b < plan_.bricks().size(); ++b)
        for (int i = 0; i < 729; i += 5) {
            const glm::ivec3 s(i % 9, i / 9 % 9, i / 81);
            const uint32_t effect = plan_.bricks()[b].field;
            const FieldBlock& field = plan_.fields()[effect];
            const glm::dvec3 place = placeOfSample(plan_, plan_.bricks()[b], s);
            const size_t texel = 4 * texelOf(b, s);
            const double wanted = sumAt(scene, effect, place, field);
            worst = std::max(worst, std::abs(double(medium[texel + 3]) - wanted));
            largest = std::max(largest, wanted);
            if (wanted < 0.05)
                continue; // no mean of next to nothing
            const auto check = [&](float got, const std::vector<double>& weights, double unit, double least,
                                   double most) {
                const double mean = sumAt(scene, effect, place, field, weights) / unit;
                worstMean = std::max(worstMean, std::abs(double(got) - std::clamp(mean, least, most)));
            };
            check(medium[texel] / medium[texel + 3], red, wanted, -1e9, 1e9);
            check(scatter[texel], albedo, wanted, 0.0, 1.0);
            check(scatter[texel + 3], meanCosine, wanted, -0.95, 0.95);
            check(shares[texel + 1], dust, double(field.limits.y), -1e9, 1e9);
        }
    EXPECT_GT(largest, 0.5);
    EXPECT_LE(worst, 2e-5 * largest);
    EXPECT_LE(worstMean, 2e-3) << "halves";
}

TEST_F(FieldTest, aRimScattersAsNoBallDoesMoreSharply)
{
    // The kernel of voxels is below 0 at rims, so that the extinctions of two balls cancel and the mean of
    // their cosines grows without end. At 1 the phase function is 0/0.
    std::vector<FieldBall> balls;
    for (const double side : {-1.0, 1.0})
        for (int i = 0; i < 40; ++i) {
            FieldBall ball = loneBall(0.2f + 0.1f * float(i));
            ball.center = {side * (0.3 + 0.02 * i), 0.05 * i - 1.0, 0.3 * std::sin(double(i))};
            ball.meanCosine = float(0.9 * side);
            ball.albedo = glm::vec3(0.8f);
            balls.push_back(ball);
        }
    const FieldScene scene(balls, camera({0, 0, 9}, {0, 0, 0}));
    fill(scene, 48);
    const std::vector<float> scatter = texels(1);
    size_t limited = 0;
    for (size_t texel = 0; texel < scatter.size(); texel += 4) {
        const double cosine = double(scatter[texel + 3]);
        ASSERT_LE(std::abs(cosine), 0.9505) << texel / 4; // 0.95 in half precision
        limited += std::abs(cosine) > 0.9495;
        for (const double straight : {-1.0, 1.0})
            EXPECT_TRUE(std::isfinite(formula64::fxHenyeyGreenstein(straight, cosine)));
    }
    EXPECT_GT(limited, 0u); // there are such rims
}

TEST_F(FieldTest, bricksAgreeBitForBitOnTheFacesThatTheyShare)
{
    fill(FieldScene(randomBalls(150, 5, glm::dvec3(0.0)), camera({0, 0, 9}, {0, 0, 0})), 48);
    const std::vector<float> medium = texels(0);
    std::map<std::tuple<int, int, int>, float> places;
    size_t shared = 0, different = 0;
    for (size_t b = 0; b < plan_.bricks().size(); ++b)
        for (int i = 0; i < 729; ++i) {
            const glm::ivec3 s(i % 9, i / 9 % 9, i / 81);
            const uint32_t place = plan_.bricks()[b].place;
            const glm::ivec3 at = 8 * glm::ivec3(place & 1023u, place >> 10 & 1023u, place >> 20) + s;
            const float value = medium[4 * texelOf(b, s) + 3];
            const auto [known, isNew] = places.insert({{at.x, at.y, at.z}, value});
            shared += !isNew;
            different += known->second != value;
        }
    EXPECT_GT(shared, 1000u);
    EXPECT_EQ(different, 0u);
}

TEST_F(FieldTest, aLoneBallIsAsOpaqueAsItsKernel)
{
    const CameraView view = camera({0.3, 0.2, 4}, {0, 0, 0});
    for (const float crossSection : {0.05f, 1.0f, 20.0f}) {
        const FieldScene scene({loneBall(crossSection)}, view);
        fill(scene, 160);
        const Errors errors = opacityErrors(march(view, {}), scene, view, 0.0f, 1e30f);
        EXPECT_LE(errors.largest, crossSection > 10.0f ? 0.06 : 0.005)
            << crossSection; // the rim of the opaque one
        EXPECT_LE(errors.mean, 1.5e-3) << crossSection;
    }
}

TEST_F(FieldTest, anEyeOnTheFaceOfABrickSeesWhatIsBehindIt)
{
    // voxels of 2^-2.75 m and bricks of 8: those of the ball end at z = 0, where parallel rays begin
    FieldBall ball = loneBall(1.0f);
    ball.center = {0.0, 0.0, -1.1};
    ball.radius = 0.6f;
    const CameraView view = orthographicView({{0, 0, 0}, {0, 0, -1}}, 1.6f, 1.5f, 0.0f, 10.0f);
    const FieldScene scene({ball}, view);
    fill(scene, 64);
    const FieldBlock& field = plan_.fields()[0];
    ASSERT_EQ(field.corner.z + 8.0f * field.corner.w * float(field.bricks.z), 0.0f);
    const std::vector<float> drawn = march(view, {});
    EXPECT_GT(drawn[4 * size_t(kFieldHeight / 2 * kFieldWidth + kFieldWidth / 2) + 3], 0.8f);
}

TEST_F(FieldTest, finerVoxelsAreMoreExact)
{
    const CameraView view = camera({0.3, 0.2, 6}, {0, 0, 0});
    const FieldScene scene(randomBalls(60, 5, glm::dvec3(0.0)), view);
    double before = 1.0;
    for (const int resolution : {32, 64, 128}) {
        fill(scene, resolution);
        const double mean = opacityErrors(march(view, {}), scene, view, 0.0f, 1e30f).mean;
        EXPECT_LT(mean, 0.5 * before) << resolution;
        before = mean;
    }
    EXPECT_LE(before, 1e-3);
}

TEST_F(FieldTest, mediumEndsAtWhatIsOpaqueAndBeginsAtTheNearPlane)
{
    const CameraView view = camera({0.0, 0.0, 4}, {0, 0, 0});
    const FieldScene scene({loneBall(1.0f)}, view);
    fill(scene, 160);
    for (const float wall : {3.2f, 3.9f, 4.4f})
        EXPECT_LE(opacityErrors(march(view, {wall}), scene, view, 0.0f, wall).largest, 0.02) << wall;
    EXPECT_EQ(largestOf(march(view, {2.5f})), 0.0) << "a wall before all medium";
    const CameraView inside = camera({0.2, 0.1, 0.3}, {0, 0, -1});
    const FieldScene around({loneBall(1.0f)}, inside);
    fill(around, 160);
    EXPECT_LE(opacityErrors(march(inside, {}), around, inside, 0.0f, 1e30f).largest, 0.02);
}

TEST_F(FieldTest, splittingARayLeavesItsTransmittance)
{
    const CameraView view = camera({0.3, 0.2, 6}, {0, 0, 0});
    fill(FieldScene(randomBalls(150, 5, glm::dvec3(0.0)), view), 160);
    const std::vector<float> whole = march(view, {});
    for (const float cut : {5.0f, 5.73f, 6.4f}) {
        Window front; // up to the plane where the rest begins
        for (size_t i = 0; i < size_t(kFieldWidth * kFieldHeight); ++i)
            front.walls.push_back(
                cut * rayOf(view, i).nearest / rayOf(view, 0).nearest *
                glm::length(rayOf(view, 0).direction /
                            glm::dot(rayOf(view, 0).direction, cameraGeometry(view).forward)));
        const std::vector<float> before = march(view, front);
        const std::vector<float> behind = march(view, {1e30f, cut});
        double worst = 0.0;
        for (size_t i = 3; i < whole.size(); i += 4)
            worst = std::max(
                worst, std::abs(double((1.0f - before[i]) * (1.0f - behind[i])) - (1.0 - double(whole[i]))));
        EXPECT_LE(worst, 3e-3) << cut;
    }
}

TEST_F(FieldTest, aFurnaceOfOneTemperatureShowsItsOwnLight)
{
    std::vector<FieldBall> balls = randomBalls(150, 5, glm::dvec3(0.0));
    const glm::vec3 glow(4.0f, 2.0f, 0.5f);
    for (FieldBall& ball : balls)
        ball.emission = glow;
    const std::vector<float> drawn = picture(balls, camera({0.3, 0.2, 6}, {0, 0, 0}), 160, {});
    double worst = 0.0;
    for (size_t i = 0; i < drawn.size(); i += 4)
        for (int c = 0; c < 3; ++c)
            worst =
                std::max(worst, double(std::abs(drawn[i + size_t(c)] - glow[c] * drawn[i + 3]) / glow[c]));
    EXPECT_GT(largestOf(drawn), 1.0);
    EXPECT_LE(worst, 1e-5);
}

TEST_F(FieldTest, equalInputsGiveEqualBits)
{
    const std::vector<FieldBall> balls = randomBalls(150, 5, glm::dvec3(0.0));
    const CameraView view = camera({0.3, 0.2, 6}, {0, 0, 0});
    const std::vector<float> first = picture(balls, view, 64, {});
    EXPECT_EQ(differentBits(first, picture(balls, view, 64, {})), 0u);
}

TEST_F(FieldTest, theOrderOfBallsDoesNotMatter)
{
    std::vector<FieldBall> balls = randomBalls(150, 5, glm::dvec3(0.0));
    const CameraView view = camera({0.3, 0.2, 6}, {0, 0, 0});
    const std::vector<float> first = picture(balls, view, 48, {});
    for (int i = 0; i < 4; ++i) {
        i == 0 ? std::reverse(balls.begin(), balls.end())
               : (void)std::rotate(balls.begin(), balls.begin() + 37 * i, balls.end());
        EXPECT_LE(largestDifference(first, picture(balls, view, 48, {})), 2e-5 * largestOf(first));
    }
}

TEST_F(FieldTest, overlappingEffectsAreOneMedium)
{
    // two effects with equal boxes have voxels at the same places: their fields add up to that of one effect
    std::vector<FieldBall> balls = randomBalls(150, 5, glm::dvec3(0.0));
    const CameraView view = camera({0.3, 0.2, 6}, {0, 0, 0});
    FieldScene one(balls, view);
    fill(one, 48);
    const std::vector<float> together = march(view, {});
    for (size_t i = 0; i < balls.size(); ++i)
        balls[i].effect = uint32_t(i % 2);
    FieldScene two(balls, view);
    two.effects[0].low = two.effects[1].low = one.effects[0].low;
    two.effects[0].high = two.effects[1].high = one.effects[0].high;
    fill(two, 48);
    ASSERT_EQ(plan_.fields().size(), 2u);
    ASSERT_EQ(plan_.fields()[0].corner.w, plan_.fields()[1].corner.w);
    const std::vector<float> apart = march(view, {});
    double mean = 0.0; // steps begin elsewhere, and rims are cut off before they are added up
    for (size_t i = 0; i < apart.size(); ++i)
        mean += double(std::abs(apart[i] - together[i])) / double(apart.size());
    EXPECT_LE(mean, 3e-3 * largestOf(together));
    std::swap(two.effects[0], two.effects[1]);
    fill(two, 48);
    EXPECT_LE(largestDifference(apart, march(view, {})), 2e-5 * largestOf(together)) << "no order of effects";
}

TEST_F(FieldTest, layersCoverAsMuchAsTheLightDoes)
{
    std::vector<FieldBall> balls = randomBalls(150, 5, glm::dvec3(0.0));
    const CameraView view = camera({0.3, 0.2, 6}, {0, 0, 0});
    const std::vector<float> plain = picture(balls, view, 48, {});
    fill(FieldScene(balls, view), 48, true);
    // without light nothing is scattered; what albedos are is no light
    const std::vector<float> coverage = march(view, {.layers = true}, MediaPass::Coverage);
    double worst = 0.0;
    for (size_t i = 0; i < plain.size(); i += 4) {
        const double sum = double(coverage[i]) + double(coverage[i + 1]) + double(coverage[i + 2]);
        worst = std::max(worst, std::abs(sum - double(coverage[i + 3])));
        worst = std::max(worst, std::abs(double(coverage[i + 3]) - double(plain[i + 3])));
    }
    EXPECT_LE(worst, 1e-2) << "halves";
    const std::vector<float> depth = march(view, {.layers = true}, MediaPass::OpticalDepth);
    for (size_t i = 0; i < depth.size(); ++i)
        ASSERT_NEAR(std::exp(-double(depth[i])), 1.0 - double(plain[4 * i + 3]), 2e-4) << i;
}

namespace {

/// The scene of the curves of `fx accuracy billboards`: parallel rays along z over 2.4 m x 1.6 m, on the
/// right half up to a ground that rises through the balls.
struct CardScene
{
    std::vector<FieldBall> balls;
    std::vector<float> walls;
    std::vector<std::array<double, 3>> exact;

    explicit CardScene(uint32_t count)
    {
        for (const cli::Card& card : cli::overlappingCards(count)) {
            FieldBall ball;
            ball.center = {-card.x, card.y, card.z}; // the camera looks along z, so that its right is -x
            ball.radius = card.radius;
            ball.crossSection = card.crossSection;
            ball.emission = {card.emission[0], card.emission[1], card.emission[2]};
            balls.push_back(ball);
        }
        for (int y = 0; y < kFieldHeight; ++y)
            for (int x = 0; x < kFieldWidth; ++x)
                addPixel((x + 0.5 - 0.5 * kFieldWidth) * 2.4 / kFieldWidth,
                         (y + 0.5 - 0.5 * kFieldHeight) * 2.4 / kFieldWidth);
    }

private:
    void addPixel(double px, double py)
    {
        walls.push_back(px < 0.0 ? std::numeric_limits<float>::infinity() : float(2.0 + 0.8 * py));
        std::vector<RayBlob<double>> met;
        for (const FieldBall& ball : balls) {
            const double dx = ball.center.x + px, dy = ball.center.y - py, r = double(ball.radius);
            const double chord2 = r * r - dx * dx - dy * dy;
            if (chord2 > 0.0)
                met.push_back({ball.center.z,
                               chord2,
                               r,
                               double(ball.crossSection) * 1.04445431404056 / (r * r * r),
                               {double(ball.emission.x), double(ball.emission.y), double(ball.emission.z)},
                               uint32_t(met.size())});
        }
        const auto exponential = [](double x) { return std::exp(x); };
        ReferenceIntegral<double, decltype(exponential)> integral(
            met, {0.0, double(walls.back()), {}}, 2, false, 1e-9, [](double x) { return std::sqrt(x); },
            exponential);
        exact.push_back(integral.light());
    }
};

} // namespace

TEST_F(FieldTest, ballsThatOverlapAreTheIntegralThroughTheirSum)
{
    const CardScene scene(270);
    const CameraView view = orthographicView({{0, 0, 0}, {0, 0, 1}}, 1.6f, 1.5f, 0.0f, 10.0f);
    double brightest = 0.0;
    for (const auto& light : scene.exact)
        brightest = std::max({brightest, light[0], light[1], light[2]});
    Window window;
    window.walls = scene.walls;
    for (const auto& [resolution, bound, middle] : {std::tuple(96, 0.15, 4e-3), {128, 0.06, 2e-3}}) {
        const std::vector<float> drawn = picture(scene.balls, view, resolution, window);
        std::vector<double> errors; // over max(channel, 5 % of the brightest)
        for (size_t i = 0; i < scene.exact.size(); ++i)
            for (size_t c = 0; c < 3; ++c)
                errors.push_back(std::abs(double(drawn[4 * i + c]) - scene.exact[i][c]) /
                                 std::max(scene.exact[i][c], 0.05 * brightest));
        std::sort(errors.begin(), errors.end());
        EXPECT_LE(errors[errors.size() * 99 / 100], bound) << resolution;
        EXPECT_LE(errors[errors.size() / 2], middle)
            << resolution; // twice that with slopes of the wrong sign
    }
}
