// What a simpler shimmer does in the cases H-03, H-04, H-07 and H-08 that test_heat_shimmer.cpp keeps: each
// must fail.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

/// Gray values in rows. Reading outside gives NaN, which stands for whatever lies there.
struct Gray
{
    int width, height;
    std::vector<float> values;

    float read(int x, int y) const
    {
        const bool isInside = x >= 0 && y >= 0 && x < width && y < height;
        return isInside ? values[size_t(y * width + x)] : std::nanf("");
    }
};

/// Four texels with their weights, wherever they are.
float naive(const Gray& picture, float x, float y)
{
    const float fx = x - std::floor(x), fy = y - std::floor(y);
    const int left = int(std::floor(x)), low = int(std::floor(y));
    return (1 - fx) * (1 - fy) * picture.read(left, low) + fx * (1 - fy) * picture.read(left + 1, low) +
           (1 - fx) * fy * picture.read(left, low + 1) + fx * fy * picture.read(left + 1, low + 1);
}

int notFinite(const Gray& picture, float dx, float dy)
{
    int count = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            count += std::isfinite(naive(picture, float(x) + dx, float(y) + dy)) ? 0 : 1;
    return count;
}

Gray flat(int width, int height, float value)
{
    return {width, height, std::vector<float>(size_t(width * height), value)};
}

} // namespace

TEST(NaiveShimmer, readsWhatLiesAroundThePicture)
{
    EXPECT_GE(notFinite(flat(40, 30, 0.5f), 7.3f, 0.0f), 7 * 30);
}

TEST(NaiveShimmer, bleedsTheForeground)
{
    Gray picture = flat(40, 30, 0.0f);
    for (int y = 0; y < 30; ++y)
        for (int x = 18; x < 22; ++x)
            picture.values[size_t(y * 40 + x)] = 1.0f; // a post before the gas
    EXPECT_GT(naive(picture, 14.0f + 5.2f, 15.0f), 0.9f);
}

TEST(NaiveShimmer, spreadsABrokenTexelOverItsNeighbors)
{
    Gray picture = flat(40, 30, 0.5f);
    picture.values[15 * 40 + 20] = std::nanf("");
    EXPECT_GT(notFinite(picture, 0.0f, 0.0f), 1); // even where nothing moves: 0 times NaN
}

TEST(NaiveShimmer, hasNoValueInPicturesOfOneLine)
{
    EXPECT_EQ(notFinite(flat(1, 1, 0.5f), 0.25f, 0.25f), 1);
    EXPECT_EQ(notFinite(flat(1, 37, 0.5f), 0.25f, 0.0f), 37);
}

TEST(NaiveShimmer, changesAConstantPicture)
{
    int changed = 0;
    for (int i = 1; i < 1000; ++i)
        changed += naive(flat(2, 2, 0.1f), 0.001f * float(i), 0.37f) != 0.1f ? 1 : 0;
    EXPECT_GT(changed, 50);
}
