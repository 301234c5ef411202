// Layers over one another by the composite pass, L-02 to L-04, L-06 and L-07. Each has a control: what
// straight alpha, or another form, does in the same case is wrong.
#include "foundation/random/philox.h"
#include "rendering/passes/composite_pass.h"
#include "tests/rendering/passes/post_pass_harness.h"

#include <cmath>
#include <limits>

namespace {

using namespace fx;
using namespace fx::render;
using test::Picture;

constexpr int kWidth = 64, kHeight = 48;
constexpr double kRounding = 0x1p-24;

/// Premultiplied layers of every opacity. @param opacity 0 to 1, or negative for any
Picture layer(uint64_t seed, float opacity = -1.0f)
{
    Picture picture(kWidth, kHeight);
    for (size_t i = 0; i < picture.texels.size(); i += 4) {
        const auto u = base::randomUnit4(seed, 0, i, base::RandomPurpose::Noise);
        const float alpha = opacity < 0.0f ? u[3] : opacity;
        for (size_t c = 0; c < 3; ++c)
            picture.texels[i + c] = u[c] * alpha;
        picture.texels[i + 3] = alpha;
    }
    return picture;
}

class LayerComposition : public test::PostPass
{
protected:
    Picture over(const Picture& media, const Picture& behind, bool inPlace = false)
    {
        graph_->begin();
        CompositePass::Inputs in{};
        in.media = import(media);
        in.picture = import(behind);
        in.width = media.width;
        in.height = media.height;
        in.inPlace = inPlace;
        const ResourceId color = CompositePass::addTo(*graph_, in).color;
        execute(color);
        Picture out(media.width, media.height);
        out.texels = read(color);
        return out;
    }
};

double largestDifference(const Picture& a, const Picture& b)
{
    double most = 0.0;
    for (size_t i = 0; i < a.texels.size(); ++i)
        most = std::max(most, std::fabs(double(a.texels[i]) - double(b.texels[i])));
    return most;
}

} // namespace

TEST_F(LayerComposition, filteringTwoTexelsGoesWithComposition)
{
    // columns are places between a white texel and an empty one, rows are opacities; black behind
    Picture edge(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            std::fill_n(edge.at(x, y), 4, float(y) / 64.0f * (1.0f - float(x) / 64.0f)); // exact in float
    Picture out = over(edge, Picture(kWidth, kHeight, {0.0f, 0.0f, 0.0f, 1.0f}));
    double worst = 0.0, worstStraight = 0.0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const double f = x / 64.0, alpha = y / 64.0, wanted = alpha * (1.0 - f);
            worst = std::max(worst, std::fabs(double(out.at(x, y)[0]) - wanted));
            worstStraight = std::max(
                worstStraight, std::fabs((1.0 - f) * (alpha * (1.0 - f)) - wanted)); // color times alpha
        }
    EXPECT_EQ(worst, 0.0);
    EXPECT_GT(worstStraight, 0.15); // control: a dark rim
}

TEST_F(LayerComposition, layersMayBeGrouped)
{
    const Picture a = layer(1), b = layer(2), c = layer(3);
    const Picture left = over(over(a, b), c), right = over(a, over(b, c));
    EXPECT_LE(largestDifference(left, right), 4.0 * kRounding);
    EXPECT_GT(largestDifference(left, over(over(b, a), c)), 0.1); // control: another order is another picture
}

TEST_F(LayerComposition, emissionWithoutOpacityIsAddedAndAnOpaqueLayerHidesAll)
{
    Picture flame = layer(4, 1.0f);
    for (size_t i = 3; i < flame.texels.size(); i += 4)
        flame.texels[i] = 0.0f;
    const Picture behind = layer(5, 1.0f), added = over(flame, behind);
    size_t straight = 0;
    for (size_t i = 0; i < added.texels.size(); ++i) {
        ASSERT_EQ(added.texels[i], flame.texels[i] + behind.texels[i]);
        straight +=
            added.texels[i] != flame.texels[i / 4 * 4 + 3] * flame.texels[i] + behind.texels[i] ? 1 : 0;
    }
    EXPECT_GT(straight, added.texels.size() / 2); // control: straight alpha loses the flame
    const Picture wall = layer(6, 1.0f);
    EXPECT_EQ(test::differentBits(over(wall, behind).texels, wall.texels), 0u);
}

TEST_F(LayerComposition, brightEmissionDoesNotOverflow)
{
    const Picture flame(kWidth, kHeight, {40000.0f, 3e30f, 0.5f, 0.0f});
    const Picture behind(kWidth, kHeight, {40000.0f, 3e30f, 0.25f, 1.0f});
    const Picture sum = over(flame, behind);
    EXPECT_EQ(sum.texels[0], 80000.0f); // control: half floats end at 65504
    EXPECT_EQ(sum.texels[1], 6e30f);
    EXPECT_EQ(sum.texels[2], 0.75f);
}

TEST_F(LayerComposition, aBrokenTexelHarmsOnlyItself)
{
    for (const float broken : {std::nanf(""), std::numeric_limits<float>::infinity()}) {
        Picture media = layer(7);
        const Picture behind = layer(8, 1.0f);
        Picture healthy = over(media, behind);
        media.at(20, 30)[1] = broken;
        Picture out = over(media, behind);
        EXPECT_FALSE(std::isfinite(out.at(20, 30)[1])); // control: it is there to be seen
        out.at(20, 30)[1] = healthy.at(20, 30)[1];
        EXPECT_EQ(test::differentBits(out.texels, healthy.texels), 0u);
    }
}

TEST_F(LayerComposition, nothingOverAPictureIsThePictureBitForBit)
{
    for (const auto& [width, height] : {std::pair(1, 1), {1, 37}, {37, 1}, {kWidth, kHeight}}) {
        Picture behind(width, height);
        for (size_t i = 0; i < behind.texels.size(); ++i)
            behind.texels[i] =
                i % 4 == 3 ? 1.0f : base::randomUnit4(9, 0, i, base::RandomPurpose::Noise)[0] * 1e6f;
        for (const bool inPlace : {false, true}) {
            const Picture out = over(Picture(width, height, {0, 0, 0, 0}), behind, inPlace);
            EXPECT_EQ(test::differentBits(out.texels, behind.texels), 0u) << width << " x " << height;
            const Picture veil = over(Picture(width, height, {0, 0, 0, 1e-3f}), behind, inPlace);
            EXPECT_GT(test::differentBits(veil.texels, behind.texels), 0u); // control: a thin veil is seen
        }
    }
}
