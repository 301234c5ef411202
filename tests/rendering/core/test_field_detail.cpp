// Lumps, and the field that they erode: uniform thresholds, means that are kept, limits.
#include "rendering/field_detail/detailed_field.h"

#include "foundation/random/philox.h"
#include "shaders/formulas/formula.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace fx;
using namespace fx::render;

namespace {

const LumpTile& tile()
{
    static const LumpTile shared(64);
    return shared;
}

/// Random places, one stream for each `seed`.
glm::vec3 anywhere(uint64_t i, float size, uint64_t seed = 1)
{
    const auto r = base::randomUnit4(seed, 0, i, base::RandomPurpose::Attributes);
    return size * glm::vec3(r[0], r[1], r[2]);
}

FieldDetailNumbers fireball()
{
    FieldDetailNumbers numbers;
    numbers.thinnest = 0.6f;
    numbers.densest = 40.0f;
    numbers.generations[1].offset = {3.3f, 1.2f, 6.1f};
    numbers.fade = 0.3f;
    numbers.cooling = 0.16f;
    numbers.glow = 0.09f;
    return numbers;
}

SmoothMedium mediumAt(float extinction, const glm::vec3& p)
{
    return {extinction, {p, p}};
}

/// A square at a random angle, around the origin.
class Pixel
{
public:
    Pixel(uint64_t i, float width) : width_(width)
    {
        const auto r = base::randomUnit4(7, 0, i, base::RandomPurpose::Attributes);
        const float height = 2.0f * r[0] - 1.0f, flat = std::sqrt(1.0f - height * height);
        const glm::vec3 normal(flat * std::cos(6.2831853f * r[1]), flat * std::sin(6.2831853f * r[1]),
                               height);
        const glm::vec3 other = std::abs(height) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
        right_ = glm::normalize(glm::cross(normal, other));
        up_ = glm::cross(normal, right_);
    }
    /// Middle of part k of parts x parts.
    glm::vec3 part(int k, int parts) const
    {
        const float x = (float(k % parts) + 0.5f) / float(parts) - 0.5f;
        const float y = (float(k / parts) + 0.5f) / float(parts) - 0.5f;
        return width_ * (x * right_ + y * up_);
    }

private:
    float width_;
    glm::vec3 right_, up_;
};

/// Balls of the same size that fill a ball of radius 3 m at random.
std::vector<DetailedBall> cloud(float crossSection)
{
    std::vector<DetailedBall> balls;
    for (uint64_t i = 0; balls.size() < 250; ++i) {
        const glm::vec3 p = anywhere(i, 6.0f) - 3.0f;
        if (glm::length(p) < 3.0f)
            balls.push_back({p, 0.9f, crossSection, {p, p}});
    }
    return balls;
}

} // namespace

TEST(LumpTile, hasTheMeanAndTheDeviationThatItIsBroughtTo)
{
    double sum = 0, squares = 0;
    for (const float z : tile().values()) {
        sum += double(z);
        squares += double(z) * double(z);
    }
    const double count = double(tile().values().size());
    EXPECT_NEAR(sum / count, 0.0, 5e-3);
    EXPECT_NEAR(std::sqrt(squares / count), 1.0, 5e-3);
}

TEST(LumpTile, repeatsWithoutASeam)
{
    for (uint64_t i = 0; i < 200; ++i) {
        const glm::vec3 p = anywhere(i, 8.0f);
        EXPECT_NEAR(tile().at(p + glm::vec3(8.0f, -16.0f, 24.0f)), tile().at(p), 1e-4f);
    }
    for (uint64_t i = 0; i < 200; ++i) {
        glm::vec3 seam = anywhere(i, 8.0f);
        seam.x = 8.0f;
        EXPECT_NEAR(tile().at(seam - glm::vec3(1e-3f, 0, 0)), tile().at(seam + glm::vec3(1e-3f, 0, 0)),
                    0.05f);
    }
}

TEST(LumpTile, isTheFormulaAtItsTexels)
{
    for (const glm::ivec3 texel : {glm::ivec3(0, 0, 0), glm::ivec3(5, 17, 60), glm::ivec3(63, 63, 63)}) {
        const glm::vec3 cells = glm::vec3(texel) / 8.0f;
        EXPECT_NEAR(tile().at(cells), (lumpAt(cells) - kLumpMean) / kLumpDeviation, 1e-4f);
    }
}

TEST(FieldDetail, noiseHasMeanZeroAndDeviationOneWhateverTheFade)
{
    for (const float fade : {0.0f, 0.5f, 0.8f}) {
        FieldDetailNumbers numbers = fireball();
        numbers.fade = fade;
        double sum = 0, squares = 0;
        const int count = 40000;
        for (int i = 0; i < count; ++i) {
            const MediumDetail d =
                detailAt(numbers, tile(), mediumAt(5.0f, anywhere(uint64_t(i), 300.0f)), 1e-3f, 5);
            sum += double(d.noise);
            squares += double(d.noise) * double(d.noise);
        }
        EXPECT_NEAR(sum / count, 0.0, 0.03) << fade;
        EXPECT_NEAR(std::sqrt(squares / count), 1.0, 0.06) << fade; // linear between texels: a little less
    }
}

TEST(FieldDetail, thresholdsAreNearlyUniform)
{
    const int count = 40000;
    std::vector<int> bins(10, 0);
    for (int i = 0; i < count; ++i) {
        const float z =
            detailAt(fireball(), tile(), mediumAt(5.0f, anywhere(uint64_t(i), 300.0f)), 1e-3f, 5).noise;
        ++bins[size_t(std::min(9.0f, 10.0f / (1.0f + std::exp(1.702f * z))))];
    }
    for (const int bin : bins)
        EXPECT_NEAR(double(bin) / count, 0.1, 0.03);
}

TEST(FieldDetail, keepsTheMeanWhereAThinnerPartIsLeft)
{
    const FieldDetailNumbers numbers = fireball();
    for (const float extinction : {3.0f, 8.0f, 20.0f}) {
        double sum = 0;
        const int count = 40000;
        for (int i = 0; i < count; ++i)
            sum += double(
                detailAt(numbers, tile(), mediumAt(extinction, anywhere(uint64_t(i), 300.0f)), 1e-3f, 5)
                    .share);
        EXPECT_NEAR(sum / count, 1.0, 0.04) << extinction;
        EXPECT_NEAR(meanErodedShare(numbers, extinction), 1.0f, 1e-5f);
    }
}

// Medium that spreads: its mean stays, and what noise changes of it dies away.
TEST(FieldDetail, thinMediumBecomesHazeOfTheSameMean)
{
    FieldDetailNumbers numbers = fireball();
    numbers.softening = 1.5f;
    double before = 10.0;
    for (const float thinning : {0.0f, 1.0f, 2.0f, 4.0f, 8.0f}) {
        SmoothMedium medium = mediumAt(8.0f * std::exp(-thinning), {});
        medium.thinning = thinning;
        double sum = 0, squares = 0;
        const int count = 20000;
        for (int i = 0; i < count; ++i) {
            medium.place.fill(anywhere(uint64_t(i), 300.0f));
            const double share = double(detailAt(numbers, tile(), medium, 1e-3f, 5).share);
            sum += share;
            squares += share * share;
        }
        const double deviation = std::sqrt(squares / count - sum / count * sum / count);
        EXPECT_NEAR(sum / count, 1.0, 0.04) << thinning;
        EXPECT_NEAR(meanErodedShare(numbers, medium.extinction, thinning), 1.0f, 1e-5f);
        EXPECT_LT(deviation, 0.9 * before) << thinning;
        before = deviation;
    }
    EXPECT_LT(before, 0.3);
}

// However far away: what fades out leaves the mean over it.
TEST(FieldDetail, keepsTheMeanHoweverMuchOfTheNoiseHasFadedOut)
{
    const FieldDetailNumbers numbers = fireball();
    for (const float pixel : {1e-3f, 0.1f, 0.2f, 0.3f, 0.4f, 0.6f})
        for (const float extinction : {3.0f, 8.0f, 20.0f}) {
            double sum = 0;
            const int count = 20000;
            for (int i = 0; i < count; ++i)
                sum += double(
                    detailAt(numbers, tile(), mediumAt(extinction, anywhere(uint64_t(i), 300.0f)), pixel, 5)
                        .share);
            EXPECT_NEAR(sum / count, 1.0, 0.05) << extinction << ' ' << pixel;
        }
}

TEST(FieldDetail, sharesOverFadedNoiseAreMeansOverIt)
{
    for (const float u : {0.3f, 0.6f, 1.0f})
        for (const float z : {-1.0f, 0.0f, 0.7f})
            for (const float s : {0.1f, 0.5f, 0.9f, 1.2f}) {
                double sum = 0, weights = 0;
                for (double r = -5.0; r <= 5.0; r += 0.01) {
                    const double weight = std::exp(-0.5 * r * r);
                    const float h = formula::fxDetailThreshold(z + std::sqrt(u) * float(r));
                    sum += weight * double(formula::fxDetailShare(s, h, 0.25f));
                    weights += weight;
                }
                EXPECT_NEAR(formula::fxDetailShareOver(s, z, u, 0.25f), sum / weights, 0.02)
                    << u << ' ' << z << ' ' << s;
            }
    EXPECT_EQ(formula::fxDetailShareOver(0.5f, 0.3f, 0.0f, 0.25f),
              formula::fxDetailShare(0.5f, formula::fxDetailThreshold(0.3f), 0.25f));
}

TEST(FieldDetail, whatIsLeftStaysBelowItsBound)
{
    EXPECT_EQ(formula::fxDetailGain(0.0f, 0.25f), kMaxDetailGain);
    for (const float ramp : {0.05f, 0.25f, 0.4f, 1.0f}) {
        FieldDetailNumbers numbers = fireball();
        numbers.ramp = ramp;
        float most = 0.0f; // of what thinner medium may have at most
        for (float extinction = 0.3f; extinction < 3000.0f; extinction *= 1.01f) {
            const float s =
                formula::fxDetailPlace(extinction, numbers.length(), numbers.thinnest, numbers.densest);
            most = std::max(most, s > 0.0f ? extinction * formula::fxDetailGain(s, ramp) : 0.0f);
            const float bound = maxErodedExtinction(numbers, extinction);
            EXPECT_GE(bound, most) << ramp << ' ' << extinction;
            EXPECT_LE(bound, 1.03f * most) << ramp << ' ' << extinction;
        }
    }
    for (uint64_t i = 0; i < 2000; ++i) {
        const float extinction = 0.5f + 30.0f * anywhere(i, 1.0f, 4).x;
        const MediumDetail detail =
            detailAt(fireball(), tile(), mediumAt(extinction, anywhere(i, 300.0f)), 1e-3f, 5);
        EXPECT_LE(extinction * detail.share, maxErodedExtinction(fireball(), extinction));
        FieldDetailNumbers soft = fireball();
        soft.softening = 1.5f;
        SmoothMedium medium = mediumAt(extinction * extinction * 0.01f, anywhere(i, 300.0f));
        medium.thinning = 5.0f * anywhere(i, 1.0f, 5).x;
        EXPECT_LE(medium.extinction * detailAt(soft, tile(), medium, 1e-3f, 5).share,
                  maxErodedExtinction(soft, medium.extinction));
    }
}

TEST(FieldDetail, thinMediumIsErodedAndDenseMediumIsNot)
{
    const FieldDetailNumbers numbers = fireball();
    for (uint64_t i = 0; i < 100; ++i) {
        const glm::vec3 p = anywhere(i, 50.0f);
        EXPECT_EQ(detailAt(numbers, tile(), mediumAt(0.59f, p), 1e-3f, 5).share, 0.0f);
        const MediumDetail dense = detailAt(numbers, tile(), mediumAt(2000.0f, p), 1e-3f, 5);
        EXPECT_EQ(dense.share, 1.0f);
        EXPECT_EQ(dense.temperature, 1.0f);
        EXPECT_EQ(detailAt(numbers, tile(), mediumAt(0.0f, p), 1e-3f, 5).share, 0.0f);
    }
}

TEST(FieldDetail, theBandIsTheMeanCorrelationOverAPixel)
{
    constexpr int kPlaces = 20000, kParts = 4;
    for (const float lump : {0.35f, 0.5f, 0.7f, 1.0f, 1.4f, 2.0f, 4.0f, 8.0f}) { // [pixel]
        double products = 0, squares = 0;
        for (uint64_t i = 0; i < kPlaces; ++i) {
            const glm::vec3 p = anywhere(i, 8.0f);
            const Pixel pixel(i, 1.0f / lump);
            double mean = 0;
            for (int k = 0; k < kParts * kParts; ++k)
                mean += double(tile().at(p + pixel.part(k, kParts))) / (kParts * kParts);
            const double middle = double(tile().at(p));
            products += middle * mean;
            squares += middle * middle;
        }
        EXPECT_NEAR(formula::fxOctaveBand(lump, 1.0f), products / squares, 0.04) << lump;
    }
}

// The mean share over a pixel, of the whole noise, against the share that a ray through its middle gets.
TEST(FieldDetail, aFadedShareIsNearerToTheMeanOverAPixelThanTheWholeNoiseInItsMiddle)
{
    constexpr int kPlaces = 1500, kParts = 6;
    const FieldDetailNumbers numbers = fireball();
    for (const float width : {0.1f, 0.25f, 0.5f}) { // [m]
        double faded = 0, whole = 0, bias = 0;
        for (uint64_t i = 0; i < kPlaces; ++i) {
            const glm::vec3 p = anywhere(i, 300.0f);
            const Pixel pixel(i, width);
            const auto share = [&](const glm::vec3& at, float own) {
                return double(detailAt(numbers, tile(), mediumAt(6.0f, at), own, 5).share);
            };
            double mean = 0;
            for (int k = 0; k < kParts * kParts; ++k)
                mean += share(p + pixel.part(k, kParts), 1e-3f) / (kParts * kParts);
            const double difference = share(p, width) - mean;
            faded += difference * difference;
            bias += difference;
            whole += (share(p, 1e-3f) - mean) * (share(p, 1e-3f) - mean);
        }
        EXPECT_LT(faded, 0.5 * whole) << width; // of the squares
        EXPECT_NEAR(bias / kPlaces, 0.0, 0.03) << width;
    }
}

TEST(FieldDetail, octavesFarBelowAPixelHaveFadedOut)
{
    const FieldDetailNumbers numbers = fireball();
    const double broad = double(formula::fxBroadAmplitude());
    double variance = broad * broad; // of broad lumps and five octaves over that of the first
    for (int k = 0; k < 5; ++k)
        variance += std::pow(double(numbers.gain), 2.0 * k);
    const auto noise = [&](const SmoothMedium& medium, float pixel, int octaves) {
        return detailAt(numbers, tile(), medium, pixel, octaves).noise;
    };
    for (uint64_t i = 0; i < 100; ++i) {
        const SmoothMedium medium = mediumAt(5.0f, anywhere(i, 50.0f));
        EXPECT_EQ(noise(medium, 9.0f, 5), 0.0f); // broad lumps of 2.6 m
        EXPECT_NE(noise(medium, 3.0f, 5), 0.0f);
        EXPECT_NEAR(double(noise(medium, 1.7f, 5)) * std::sqrt(variance),
                    double(noise(medium, 1.7f, 1)) * std::sqrt(1.0 + broad * broad), 1e-4);
        EXPECT_NE(noise(medium, 0.05f, 5), noise(medium, 0.05f, 3));
    }
}

TEST(FieldDetail, movesWithItsBalls)
{
    const FieldDetailNumbers numbers = fireball();
    std::vector<DetailedBall> balls = cloud(20.0f);
    const DetailedField still(balls, numbers, tile());
    const glm::vec3 way(3.7f, -2.1f, 0.4f);
    for (DetailedBall& ball : balls)
        ball.center += way;
    const DetailedField moved(balls, numbers, tile());
    for (uint64_t i = 0; i < 200; ++i) {
        const glm::vec3 p = anywhere(i, 6.0f, 2) - 3.0f;
        EXPECT_NEAR(moved.at(p + way, 1e-2f).noise, still.at(p, 1e-2f).noise, 5e-3f);
    }
}

TEST(FieldDetail, swellsWithItsBalls)
{
    FieldDetailNumbers numbers = fireball();
    std::vector<DetailedBall> balls = cloud(20.0f);
    const DetailedField before(balls, numbers, tile());
    for (DetailedBall& ball : balls) {
        ball.center *= 2.0f;
        ball.radius *= 2.0f;
        ball.crossSection *= 4.0f; // of the same optical depth
    }
    for (auto& generation : numbers.generations)
        generation.growth = 0.5f;
    const DetailedField after(balls, numbers, tile());
    for (uint64_t i = 0; i < 200; ++i) {
        const glm::vec3 p = anywhere(i, 6.0f, 2) - 3.0f;
        EXPECT_NEAR(after.at(2.0f * p, 2e-2f).noise, before.at(p, 1e-2f).noise, 5e-3f);
    }
}

// What is left of a whole cloud, on against off.
TEST(FieldDetail, keepsTheWholeExtinctionOfACloud)
{
    for (const float crossSection : {0.3f, 3.0f, 20.0f}) {
        FieldDetailNumbers numbers = fireball();
        numbers.softening = crossSection < 3.0f ? 1.5f : 0.0f;
        DetailedField field(cloud(crossSection), numbers, tile());
        field.conserveIntegral(0.25f);
        double smooth = 0, detailed = 0;
        const float spacing = 0.1f;
        for (float z = -4.0f; z < 4.0f; z += spacing)
            for (float y = -4.0f; y < 4.0f; y += spacing)
                for (float x = -4.0f; x < 4.0f; x += spacing) {
                    if (x * x + y * y + z * z > 16.0f)
                        continue;
                    smooth += double(field.smoothAt({x, y, z}).extinction);
                    detailed += double(field.extinctionAt({x, y, z}, 0.02f, 3));
                }
        EXPECT_NEAR(detailed / smooth, 1.0, 0.02) << crossSection << " factor " << field.factor();
    }
}
