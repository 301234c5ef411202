// The factor that gives media back what their detail has eroded: of the noise that is there, smooth in time.
#include "rendering/field_detail/conservation_factor.h"

#include "foundation/random/philox.h"
#include "rendering/field_detail/detailed_field.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <vector>

using namespace fx;
using namespace fx::render;

namespace {

constexpr float kHeight = 5.0f; ///< [m] of a column
constexpr float kRadius = 0.6f; ///< [m] of a ball

FieldDetailNumbers smoke()
{
    FieldDetailNumbers numbers;
    numbers.generations[0] = {0.8f, 1.0f, {1.3f, 6.2f, 4.4f}};
    numbers.generations[1] = {0.8f, 1.0f, {3.1f, 0.2f, 7.7f}};
    numbers.thinnest = 0.3f;
    numbers.densest = 20.0f;
    return numbers;
}

/// In the space of the group.
GroupDetail detailOf(const FieldDetailNumbers& numbers)
{
    GroupDetail detail;
    detail.numbers = numbers;
    for (size_t g = 0; g < 2; ++g) {
        detail.toCells[g] = glm::mat3(numbers.generations[g].growth / numbers.generations[g].length);
        detail.first[g] = numbers.generations[g].offset;
    }
    return detail;
}

float randomOf(uint64_t id, uint32_t which)
{
    return base::randomUnit4(7, which, id, base::RandomPurpose::Attributes)[0];
}

/// Balls of a column that rises and turns. Each is born at the bottom and dies at the top.
/// @param moment [1] lives of a ball since the beginning  @param noise [m] where the noise is
std::vector<DetailedBall> columnOf(int count, float moment, float noise, std::vector<uint64_t>& outIds)
{
    std::vector<DetailedBall> balls;
    outIds.clear();
    const auto oldest = int64_t(std::floor(moment * float(count)));
    for (int64_t i = oldest - count + 1; i <= oldest; ++i) {
        const auto id = uint64_t(i + 1000000);
        const float age = moment - float(i) / float(count);
        const float turn = 6.2832f * randomOf(id, 0) + 0.5f * age, out = 0.7f * std::sqrt(randomOf(id, 1));
        DetailedBall ball;
        ball.center = {out * std::cos(turn), kHeight * age, out * std::sin(turn)};
        ball.radius = kRadius * (0.7f + 0.6f * age);
        ball.crossSection = 240.0f / float(count);
        for (size_t g = 0; g < 2; ++g) // of the places at birth, as a stream that has always risen
            ball.place[g] = {out * std::cos(6.2832f * randomOf(id, 0)) + noise, kHeight * (age - moment),
                             out * std::sin(6.2832f * randomOf(id, 0))};
        balls.push_back(ball);
        outIds.push_back(id);
    }
    return balls;
}

std::vector<DetailedCaster> castersOf(const std::vector<DetailedBall>& balls,
                                      const std::vector<uint64_t>& ids, const FieldDetailNumbers& numbers)
{
    std::vector<DetailedCaster> casters;
    for (size_t i = 0; i < balls.size(); ++i) {
        DetailedCaster caster{{balls[i].center, balls[i].radius, balls[i].crossSection}, {}, ids[i]};
        for (size_t g = 0; g < 2; ++g) {
            const auto& own = numbers.generations[g];
            caster.carried[g] = (balls[i].place[g] - own.growth * balls[i].center) / own.length;
        }
        casters.push_back(caster);
    }
    return casters;
}

float factorOf(const FieldDetailNumbers& numbers, const std::vector<DetailedCaster>& casters)
{
    return ConservationFactor(std::pmr::get_default_resource()).of(detailOf(numbers), casters);
}

float factorAt(int count, float moment, float noise)
{
    std::vector<uint64_t> ids;
    const std::vector<DetailedBall> balls = columnOf(count, moment, noise, ids);
    return factorOf(smoke(), castersOf(balls, ids, smoke()));
}

} // namespace

// A column is so few lumps long that the mean over all noise says little about it.
TEST(ConservationFactor, keepsTheWholeOfAColumnWhateverNoiseItHas)
{
    double worstOfMean = 0.0;
    for (const float noise : {0.0f, 13.7f, 31.2f, 47.9f, 64.4f, 90.1f}) {
        std::vector<uint64_t> ids;
        const std::vector<DetailedBall> balls = columnOf(300, 3.25f, noise, ids);
        const float factor = factorOf(smoke(), castersOf(balls, ids, smoke()));
        const DetailedField field(balls, smoke(), sharedLumpTile());
        double before = 0, after = 0, mean = 0;
        const float spacing = 0.07f;
        for (float z = -1.8f; z < 1.8f; z += spacing)
            for (float y = -0.8f; y < kHeight + 0.8f; y += spacing)
                for (float x = -1.8f; x < 1.8f; x += spacing) {
                    const SmoothMedium smooth = field.smoothAt({x, y, z});
                    if (smooth.extinction == 0.0f)
                        continue;
                    const double k = double(smooth.extinction);
                    before += k;
                    after += k * double(detailAt(smoke(), sharedLumpTile(), smooth, 1e-3f, 5).share);
                    mean += k * double(meanErodedShare(smoke(), smooth.extinction, smooth.thinning));
                }
        EXPECT_NEAR(double(factor) * after / before, 1.0, 0.015) << noise;
        worstOfMean = std::max(worstOfMean, std::abs(after / mean - 1.0));
    }
    EXPECT_GT(worstOfMean, 0.04); // the factor of the mean would miss it
}

// At any time, while balls are born and die, below and above the number that is sampled.
TEST(ConservationFactor, changesAsSlowlyAsTheMediumDoes)
{
    for (const int count : {300, 1500}) {
        constexpr int kFrames = 60;
        constexpr float kLives = 0.25f; // that the column has renewed itself in all frames
        float before = factorAt(count, 3.0f, 0.0f), least = before, most = before;
        for (int frame = 1; frame <= kFrames; ++frame) {
            const float now = factorAt(count, 3.0f + kLives * float(frame) / kFrames, 0.0f);
            EXPECT_LT(std::abs(now / before - 1.0f), 0.008f) << count << ' ' << frame;
            before = now;
            least = std::min(least, now);
            most = std::max(most, now);
        }
        EXPECT_GT(most / least, 1.005f) << count; // it does follow the noise
    }
}

TEST(ConservationFactor, hasNoStepWhereSomePlacesAreLeftOut)
{
    std::vector<uint64_t> ids;
    const std::vector<DetailedBall> balls = columnOf(300, 3.25f, 0.0f, ids);
    std::vector<DetailedCaster> casters = castersOf(balls, ids, smoke());
    float before = 0.0f;
    while (casters.size() > 236) {
        const float now = factorOf(smoke(), casters);
        if (before > 0.0f) {
            // of 4 balls among 240, whose share differs by up to a third of the mean
            EXPECT_LT(std::abs(now / before - 1.0f), 0.0055f) << casters.size();
        }
        before = now;
        casters.resize(casters.size() - 4);
    }
}

TEST(ConservationFactor, isTheSameFromAnyEye)
{
    std::vector<uint64_t> ids;
    const std::vector<DetailedBall> balls = columnOf(300, 3.25f, 0.0f, ids);
    std::vector<DetailedCaster> casters = castersOf(balls, ids, smoke());
    const float near = factorOf(smoke(), casters);
    GroupDetail detail = detailOf(smoke());
    const glm::vec3 eye(40.0f, -7.0f, 25.0f);
    for (DetailedCaster& caster : casters)
        caster.ball.center -= eye;
    for (size_t g = 0; g < 2; ++g)
        detail.first[g] += detail.toCells[g] * eye;
    EXPECT_NEAR(ConservationFactor(std::pmr::get_default_resource()).of(detail, casters), near, 1e-4f);
}

TEST(ConservationFactor, hasEqualBitsWhateverWasComputedBefore)
{
    std::vector<uint64_t> ids;
    const std::vector<DetailedBall> balls = columnOf(300, 3.25f, 0.0f, ids);
    const std::vector<DetailedCaster> casters = castersOf(balls, ids, smoke());
    ConservationFactor used(std::pmr::get_default_resource());
    const float first = used.of(detailOf(smoke()), casters);
    used.of(detailOf(smoke()), std::span(casters).first(20));
    EXPECT_EQ(used.of(detailOf(smoke()), casters), first);
    EXPECT_EQ(factorOf(smoke(), casters), first);
}

TEST(ConservationFactor, staysBetweenItsBounds)
{
    std::vector<uint64_t> ids;
    const std::vector<DetailedBall> balls = columnOf(40, 3.25f, 0.0f, ids);
    const std::vector<DetailedCaster> casters = castersOf(balls, ids, smoke());
    EXPECT_EQ(factorOf(smoke(), {}), ConservationFactor::kMax);
    for (const float share : {0.0f, 1e-30f, 1e-4f, 1e-2f, 1.0f, 1e2f, 1e6f, 1e30f}) {
        std::vector<DetailedCaster> some = casters;
        for (DetailedCaster& caster : some)
            caster.ball.crossSection *= share;
        const float factor = factorOf(smoke(), some);
        EXPECT_GE(factor, ConservationFactor::kMin) << share;
        EXPECT_LE(factor, ConservationFactor::kMax) << share;
        if (share < 1e-3f) { // nothing is left
            EXPECT_EQ(factor, ConservationFactor::kMax) << share;
        }
        if (share > 1e5f) { // nothing is eroded
            EXPECT_NEAR(factor, 1.0f, 1e-4f) << share;
        }
    }
}
