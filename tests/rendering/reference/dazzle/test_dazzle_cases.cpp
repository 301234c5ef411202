// The hard cases of the dazzle, DZ-01 to DZ-09. Each has a control: what plain code does in the same case is
// wrong, so that the test can tell.
#include "foundation/random/philox.h"
#include "rendering/reference/dazzle/dazzle_levels.h"
#include "rendering/reference/dazzle/dazzle_light.h"
#include "rendering/reference/dazzle/dazzle_reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace {

using namespace fx;
using namespace fx::render;

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
const DazzleSettings kAll{.white = 1.0f, .a = 1.0f};

std::vector<float> gray(std::vector<float> values)
{
    std::vector<float> rgba;
    for (const float v : values)
        rgba.insert(rgba.end(), {v, v, v, 1.0f});
    return rgba;
}

std::vector<float> randomGray(size_t pixels, uint64_t seed)
{
    std::vector<float> values;
    for (size_t i = 0; i < pixels; ++i) {
        const auto u = base::randomUnit4(seed, 0, i, base::RandomPurpose::Noise);
        values.push_back(u[0] < 0.05f ? 1.0f + 3.0f * u[1] : 0.9f * u[1]);
    }
    return values;
}

std::vector<float> dazzled(const std::vector<float>& rgba, int width, int height,
                           DazzleHistory* outHistory = nullptr)
{
    DazzleHistory history{};
    std::vector<float> out = dazzleReference(rgba, width, height, kAll, 0.0, true, history);
    if (outHistory)
        *outHistory = history;
    return out;
}

/// What one would write: sums in T, one share for all, no guards.
template <class T>
std::vector<T> naive(const std::vector<float>& values)
{
    T over = 0, headroom = 0;
    for (const float v : values) {
        over += T(v) > T(1) ? T(v) - T(1) : T(0);
        headroom += T(v) > T(1) ? T(0) : T(1) - T(v);
    }
    std::vector<T> out;
    for (const float v : values)
        out.push_back(T(v) > T(1) ? T(1) : T(v) + (T(1) - T(v)) * (over / headroom));
    return out;
}

uint64_t redQuanta(const std::vector<float>& rgba)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < rgba.size(); i += 4)
        sum += uint64_t(double(rgba[i]) * 0x1p24);
    return sum;
}

int bits(DazzleCount value)
{
    const uint64_t high = uint64_t(value >> 64);
    return high != 0 ? 128 - std::countl_zero(high) : 64 - std::countl_zero(uint64_t(value));
}

size_t differentBits(const std::vector<float>& a, const std::vector<float>& b)
{
    size_t count = 0;
    for (size_t i = 0; i < a.size(); ++i)
        count += std::bit_cast<uint32_t>(a[i]) != std::bit_cast<uint32_t>(b[i]) ? 1 : 0;
    return count;
}

} // namespace

TEST(DazzleCases, dz01_noPixelsAndOnePixelAreDefined)
{
    EXPECT_TRUE(dazzled({}, 0, 0).empty());
    for (const float v : {0.0f, 0.5f, 1.0f, 7.0f}) {
        const auto out = dazzled(gray({v}), 1, 1);
        EXPECT_EQ(out[0], std::min(v, 1.0f));
        EXPECT_EQ(out[3], 1.0f);
    }
    EXPECT_TRUE(std::isnan(naive<double>({1.0f})[0])); // control: 0 / 0
}

TEST(DazzleCases, dz02_picturesFullOf65504AreSummedExactlyUpTo16K)
{
    struct Size
    {
        uint64_t width, height;
        int bits;
    };
    const DazzleCounter counter(1.0f);
    for (const Size& size : {Size{1920, 1080, 61}, {3840, 2160, 63}, {7680, 4320, 65}, {15360, 8640, 67}}) {
        const std::vector<float> row(size.width * 4, 65504.0f);
        DazzleSums sums;
        uint64_t inSixtyFour = 0;
        for (uint64_t y = 0; y < size.height; ++y) {
            addDazzleLight(row, counter, sums);
            inSixtyFour += size.width * 65503 * (1u << 24);
        }
        const DazzleCount want = DazzleCount(size.width * size.height) * 65503 * (1u << 24);
        for (const DazzleSum& channel : sums.channels) {
            EXPECT_TRUE(channel.overflow == want);
            EXPECT_TRUE(channel.headroom == 0);
            EXPECT_EQ(bits(channel.overflow), size.bits);
        }
        EXPECT_EQ(DazzleCount(inSixtyFour) != want, size.bits > 64); // control: 64 bits wrap
    }
}

TEST(DazzleCases, dz03_oneBrokenPixelIsReplacedAndCountedAndTheOthersDoNotNotice)
{
    const std::vector<float> healthy = randomGray(300, 3);
    for (const auto& [broken, replacement] :
         {std::pair{kNan, 0.0f}, {-kNan, 0.0f}, {-kInf, 0.0f}, {kInf, 65504.0f}})
    {
        std::vector<float> withBroken = healthy, withReplacement = healthy;
        withBroken[77] = broken;
        withReplacement[77] = replacement;
        DazzleHistory history{};
        const auto out = dazzled(gray(withBroken), 20, 15, &history);
        EXPECT_EQ(differentBits(out, dazzled(gray(withReplacement), 20, 15)), 0u);
        EXPECT_EQ(history.replaced, 3u);
        // control: one spoils all
        EXPECT_NE(naive<double>(withBroken)[0], naive<double>(withReplacement)[0]);
    }
}

TEST(DazzleCases, dz04_emptyAndSingleLevelsAreDefined)
{
    EXPECT_TRUE(dazzleLevels({}, 1.0).empty());
    const std::vector<uint32_t> allOver(10, 400), allSame(10, 77);
    EXPECT_EQ(dazzleLevels(allOver, 1.0), std::vector<uint8_t>(10, 255));
    EXPECT_EQ(dazzleLevels(allSame, 1.0), std::vector<uint8_t>(10, 77));
    std::vector<uint32_t> tied(10, 77);
    tied.push_back(255 + 25);
    const std::vector<uint8_t> out = dazzleLevels(tied, 1.0); // 25 among 10 equal ones: five get 2, five 3
    EXPECT_EQ(std::count(out.begin(), out.end(), 79), 5);
    EXPECT_EQ(std::count(out.begin(), out.end(), 80), 5);

    // control: the published loop goes on below the darkest level in use, where the headroom left is 0
    int64_t headroom = 10 * (255 - 77);
    int divisionsByZero = 0;
    for (int i = 255; i >= 0; --i) {
        divisionsByZero += headroom == 0 ? 1 : 0;
        headroom -= i == 77 ? 10 * (255 - 77) : 0;
    }
    EXPECT_EQ(divisionsByZero, 77);
}

TEST(DazzleCases, dz05_adaptationDependsOnTimeAloneAndIgnoresTimesThatAreNone)
{
    const double eps = std::numeric_limits<double>::epsilon();
    for (const double tau : {0.05, 0.4, 2.0}) {
        double cut = 1.0, plain = 1.0;
        for (int i = 0; i < 60; ++i) {
            cut *= dazzleKeep(1.0 / 60.0, tau);
            plain *= 1.0 - 1.0 / 60.0 / tau;
        }
        EXPECT_NEAR(cut, dazzleKeep(1.0, tau), 4 * eps);
        EXPECT_GT(std::abs(plain - std::exp(-1.0 / tau)),
                  1e-9); // control: a step of the differential equation
    }
    for (const double none : {0.0, -1.0, double(kNan), -double(kInf)})
        EXPECT_EQ(dazzleKeep(none, 0.4), 1.0);
    EXPECT_TRUE(std::isnan(std::exp(-double(kNan) / 0.4))); // control
}

TEST(DazzleCases, dz06_picturesSmallerThanATileKeepEveryQuantum)
{
    size_t lossy = 0;
    for (int width = 1; width <= 20; ++width)
        for (int height = 1; height <= 20; ++height) {
            const size_t pixels = size_t(width) * size_t(height);
            const std::vector<float> values = randomGray(pixels, uint64_t(width * 100 + height));
            const auto in = gray(values);
            const auto out = dazzled(in, width, height);
            EXPECT_EQ(redQuanta(out), std::min(redQuanta(in), pixels << 24)) << width << " x " << height;
            uint64_t rounded = 0; // control: each pixel's share rounded for itself
            for (const double v : naive<double>(values))
                rounded += uint64_t(std::min(v, 1.0) * 0x1p24 + 0.5);
            lossy += rounded != redQuanta(out) ? 1 : 0;
        }
    EXPECT_GT(lossy, 200u);
}

TEST(DazzleCases, dz07_aPictureBelowWhiteKeepsEveryBit)
{
    std::vector<float> values = randomGray(500, 7);
    for (float& v : values)
        v = std::min(v, 1.0f) * 0.37f;
    values[3] = 1e-42f;
    const auto in = gray(values);
    EXPECT_EQ(differentBits(dazzled(in, 25, 20), in), 0u);
    auto throughQuanta = in; // control: dealing nothing by way of the integers drops what is below a quantum
    for (float& v : throughQuanta)
        v = float(uint32_t(v * 0x1p24f)) * 0x1p-24f;
    EXPECT_GT(differentBits(throughQuanta, in), 100u);
}

TEST(DazzleCases, dz08_negativePixelsCountAsBlackAndAreCounted)
{
    std::vector<float> values(64, 0.5f);
    values[9] = -3.0f;
    values[40] = 5.0f;
    DazzleHistory history{};
    const auto out = dazzled(gray(values), 8, 8, &history);
    EXPECT_EQ(history.replaced, 3u);
    EXPECT_GT(out[9 * 4], 0.0f);
    values[9] = 0.0f;
    EXPECT_EQ(differentBits(out, dazzled(gray(values), 8, 8)), 0u);
    values[9] = -3.0f;
    EXPECT_LT(naive<double>(values)[9], 0.0); // control: negative light stays, and took four times its share
}

TEST(DazzleCases, dz09_sumsDoNotDependOnTheOrderOfThePixels)
{
    std::vector<float> values;
    for (int i = 0; i < 3840 * 2160; ++i)
        values.push_back(i < 300 ? 65504.0f : 0.4f + 0.3f * float(i % 7) / 7.0f);
    const auto sumsOf = [](const std::vector<float>& picture) {
        const DazzleCounter counter(1.0f);
        DazzleSums sums;
        for (const float v : picture) {
            const float pixel[4] = {v, v, v, 1.0f};
            addDazzleLight(pixel, counter, sums);
        }
        return sums.channels[0];
    };
    const DazzleSum forward = sumsOf(values);
    float inSequence = 0.0f;
    for (const float v : values)
        inSequence += v;
    std::reverse(values.begin(), values.end());
    const DazzleSum backward = sumsOf(values);
    float inReverse = 0.0f;
    double exact = 0.0;
    for (const float v : values) {
        inReverse += v;
        exact += double(v);
    }
    EXPECT_TRUE(forward.overflow == backward.overflow && forward.headroom == backward.headroom);
    EXPECT_TRUE(forward.overflow == DazzleCount(300) * 65503 * (1u << 24));
    EXPECT_GT(std::abs(double(inSequence) / exact - 1.0), 0.01); // control: floats, one after the other
    EXPECT_GT(std::abs(double(inSequence) / double(inReverse) - 1.0), 1e-5);
}
