#include "rendering/image/image_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace fx::image;

TEST(ImageMetrics, equalPicturesDifferByNothing)
{
    const Image a{2, 1, 3, {0, 1, 2, 3, 4, 5}};
    const auto d = compare(a, a);
    EXPECT_EQ(d->max, 0);
    EXPECT_EQ(d->mean, 0);
    EXPECT_EQ(d->rms, 0);
}

TEST(ImageMetrics, measureMaximumMeanAndRootMeanSquare)
{
    const Image a{2, 1, 3, {0, 0, 0, 0, 0, 0}};
    const Image b{2, 1, 3, {3, 0, 0, 0, -4, 0}};
    const auto d = compare(a, b);
    EXPECT_DOUBLE_EQ(d->max, 4);
    EXPECT_DOUBLE_EQ(d->mean, 7.0 / 6);
    EXPECT_DOUBLE_EQ(d->rms, std::sqrt(25.0 / 6));
}

TEST(ImageMetrics, aValueThatIsNotFiniteIsFarFromAllOthers)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    const Image zero{1, 1, 3, {0, 0, 0}};
    EXPECT_TRUE(std::isinf(compare(zero, Image{1, 1, 3, {0, nan, 0}})->max));
    EXPECT_TRUE(std::isinf(compare(zero, Image{1, 1, 3, {0, inf, 0}})->max));
    const Image same{1, 1, 3, {nan, inf, 0}};
    EXPECT_EQ(compare(same, same)->max, 0);
}

TEST(ImageMetrics, picturesOfDifferentSizesCannotBeCompared)
{
    EXPECT_FALSE(compare(Image{1, 2, 3, std::vector<float>(6)}, Image{2, 1, 3, std::vector<float>(6)}).ok());
    EXPECT_FALSE(compare(Image{1, 1, 3, std::vector<float>(3)}, Image{1, 1, 4, std::vector<float>(4)}).ok());
}
