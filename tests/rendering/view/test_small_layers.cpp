// Views whose media are drawn smaller than the picture: what must hold besides sharp edges.
#include "foundation/random/philox.h"
#include "view_fixture.h"

#include <algorithm>
#include <cmath>

using namespace fx;
using namespace fx::test;

namespace {

constexpr int kWidth = 149, kHeight = 98; // no multiples of 4
constexpr float kNear = 0.1f;

std::vector<TestBlob> cloud(int count, float leastRadius, float mostRadius)
{
    std::vector<TestBlob> blobs;
    for (int i = 0; i < count; ++i) {
        const auto u = base::randomUnit4(17, 0, uint64_t(i), base::RandomPurpose::Position);
        const auto v = base::randomUnit4(17, 1, uint64_t(i), base::RandomPurpose::Attributes);
        TestBlob blob;
        blob.center = {5.0f * u[0] - 2.5f, 3.0f * u[1] - 1.5f, 4.0f * u[2] - 2.0f};
        blob.radius = leastRadius + (mostRadius - leastRadius) * u[3];
        blob.crossSection = blob.radius * blob.radius * v[0];
        blob.layer = base::MediaLayer(i % 3);
        blob.emission = v[1];
        blob.fireShare = 0.3f;
        blobs.push_back(blob);
    }
    return blobs;
}

class SmallLayers : public ViewTest
{
protected:
    void SetUp() override
    {
        ViewTest::SetUp();
        makeTargets(kWidth, kHeight);
        std::vector<float> depth; // a pillar before a wall
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x)
                depth.push_back(1.0f - kNear / (x >= 60 && x < 67 ? 5.0f : 15.0f));
        setDepth(depth);
    }

    Picture drawn(const std::vector<TestBlob>& blobs, int divisor, double z = 6.0)
    {
        setPicture(host_);
        view_->settings().layerDivisor = divisor;
        return render(snapshotOf(blobs), render::perspectiveView({{0.0, 0.0, z}, {0.0, 0.0, -9.0}, {0, 1, 0}},
                                                                 0.9f, float(kWidth) / kHeight, kNear));
    }
    uint32_t lastDivisor() const { return uint32_t(view_->statistics().layerDivisor); }

    std::vector<float> host_ = std::vector<float>(size_t(kWidth) * kHeight * 4, 0.0f);
};

double meanDifference(const Picture& a, const Picture& b)
{
    double sum = 0.0;
    for (size_t i = 0; i < a.texels.size(); ++i)
        sum += double(std::abs(a.texels[i] - b.texels[i]));
    return sum / double(a.texels.size());
}

double sumOf(const Picture& picture)
{
    double sum = 0.0;
    for (size_t i = 0; i < picture.texels.size(); i += 4)
        sum += double(picture.texels[i]);
    return sum;
}

} // namespace

TEST_F(SmallLayers, lieOverThePictureWithoutAShift)
{
    const auto blobs = cloud(40, 0.5f, 1.0f);
    const Picture full = drawn(blobs, 1);
    for (const int divisor : {2, 4}) {
        const Picture small = drawn(blobs, divisor);
        Picture shifted = small; // control: by a single pixel
        for (size_t i = 4; i < shifted.texels.size(); ++i)
            shifted.texels[i] = small.texels[i - 4];
        EXPECT_LT(meanDifference(small, full), 1.2e-3 * divisor) << divisor;
        EXPECT_GT(meanDifference(shifted, full), 2.0 * meanDifference(small, full)) << divisor;
    }
}

TEST_F(SmallLayers, recomposeToThePicture)
{
    const auto blobs = cloud(60, 0.3f, 1.0f);
    for (const int divisor : {1, 2, 4}) {
        const Picture plain = drawn(blobs, divisor);
        view_->settings().layerOutputs = true;
        const Picture layered = drawn(blobs, divisor);
        view_->settings().layerOutputs = false;
        EXPECT_LT(maxDifference(plain, layered), 1e-5) << divisor;

        const auto layers = view_->layers();
        const Picture fire = read(layers.fire), smoke = read(layers.smoke), dust = read(layers.dust);
        const Picture media = read(layers.media);
        const Picture depth = read(layers.depth, 1);
        for (size_t i = 0; i < media.texels.size(); ++i) {
            const bool isColor = i % 4 != 3;
            if (isColor)
                ASSERT_EQ(media.texels[i], fire.texels[i] + smoke.texels[i] + dust.texels[i]);
            else
                ASSERT_EQ(media.texels[i] > 0.0f, std::isfinite(depth.texels[i / 4]));
        }
        for (size_t i = 0; i < depth.texels.size(); ++i)
            if (std::isfinite(depth.texels[i])) {
                ASSERT_GT(depth.texels[i], 2.0f);
                ASSERT_LT(depth.texels[i], 11.0f);
            }
    }
}

TEST_F(SmallLayers, leaveShimmerAtWork)
{
    auto blobs = cloud(40, 0.5f, 1.0f);
    for (TestBlob& blob : blobs) {
        blob.heat = 900.0f;
        blob.crossSection *= 0.05f;
    }
    for (size_t i = 0; i < host_.size(); ++i)
        host_[i] = float((i / 4) % 7) / 7.0f; // stripes that can be bent
    const Picture full = drawn(blobs, 1);
    const Picture small = drawn(blobs, 2);
    view_->settings().shimmer.strength = 0.0f;
    const Picture straight = drawn(blobs, 2);
    EXPECT_GT(meanDifference(small, straight), 3.0 * meanDifference(small, full));
}

TEST_F(SmallLayers, keepTheLightOfSparks)
{
    const auto sparks = cloud(300, 0.003f, 0.01f); // a tenth of a pixel
    const double full = sumOf(drawn(sparks, 1));
    EXPECT_GT(full, 0.0);
    EXPECT_NEAR(sumOf(drawn(sparks, 2)) / full, 1.0, 0.1);
    EXPECT_NEAR(sumOf(drawn(sparks, 4)) / full, 1.0, 0.15);
}

TEST_F(SmallLayers, areEstimatedWithinAFactorOfWhatIsCounted)
{
    useDepth_ = false;
    view_->settings().countOverdraw = true;
    view_->settings().detail = false;
    const auto blobs = cloud(200, 0.2f, 0.8f);
    for (const double z : {7.0, 3.0, 0.0}) // outside of the cloud, at its border, inside
        for (const int divisor : {1, 2, 4}) {
            drawn(blobs, divisor, z);
            const auto& counted = view_->statistics();
            const double ratio = double(counted.estimatedFragments) / double(counted.shadedFragments);
            EXPECT_GT(ratio, 0.95) << z << " 1/" << divisor;
            EXPECT_LT(ratio, 1.5) << z << " 1/" << divisor; // a disc is 1 / 1.27 of its square
        }
}

TEST_F(SmallLayers, keepTheBudgetOfFragments)
{
    const auto blobs = cloud(200, 0.5f, 0.8f);
    drawn(blobs, 1);
    EXPECT_EQ(lastDivisor(), 1u);
    const uint64_t full = view_->statistics().estimatedFragments;
    view_->settings().fragmentBudget = full / 2;
    drawn(blobs, 1);
    EXPECT_EQ(lastDivisor(), 2u);
    EXPECT_LE(view_->statistics().estimatedFragments, full / 2);
    view_->settings().fragmentBudget = full / 6;
    drawn(blobs, 1);
    EXPECT_EQ(lastDivisor(), 4u);
    view_->settings().fragmentBudget = 0;
    drawn(blobs, 1);
    EXPECT_EQ(lastDivisor(), 1u);
}
