// Media summed up in voxels, as a view draws them: what overlaps against the integral through all balls,
// layers, small layers, what a warm frame costs, and that nothing is there unless it is asked for.
#include "rendering/reference/integral/reference_integral.h"
#include "tests/rendering/gl/heap_counter.h"
#include "tests/rendering/view/permutations.h"
#include "tests/rendering/view/view_fixture.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

using namespace fx;
using namespace fx::test;

namespace {

constexpr int kWidth = 96, kHeight = 64;
const render::CameraPose kPose{{0.0, 0.0, 6.0}, {0.0, 0.0, 0.0}, {0.0f, 1.0f, 0.0f}};

class Volume : public ViewTest
{
protected:
    void SetUp() override
    {
        ViewTest::SetUp();
        makeTargets(kWidth, kHeight);
        view_->settings().composition = render::Composition::Volume;
        view_->settings().voxels = 160;
    }

    Picture drawn(const base::FrameSnapshot& snapshot, const render::CameraView& camera)
    {
        setPicture(std::vector<float>(size_t(color_->width()) * size_t(color_->height()) * 4, 0.0f));
        return render(snapshot, camera);
    }
    Picture drawn(const std::vector<TestBlob>& blobs, const render::CameraView& camera)
    {
        return drawn(snapshotOf(blobs), camera);
    }
    /// Detail whose coordinates are the places of the balls.
    float shrunk_ = 1.0f; ///< size of media with detail when they were born, over that of now

    Picture detailed(const std::vector<TestBlob>& blobs, const render::CameraView& view,
                     bool hasDetail = true)
    {
        return drawn(hasDetail ? detailedSnapshotOf(blobs, shrunk_) : snapshotOf(blobs), view);
    }

    static render::CameraView camera(float nearDistance = 0.1f)
    {
        return render::perspectiveView(kPose, 1.0f, float(kWidth) / kHeight, nearDistance);
    }
    static render::CameraView parallel()
    {
        return render::orthographicView(kPose, 3.0f, float(kWidth) / kHeight, 0.0f, 20.0f);
    }
};

/// Balls within a ball of radius 1.
std::vector<TestBlob> cloud(size_t count, float radius, float opticalDepth)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<float> side(-1.0f, 1.0f), share(0.0f, 1.0f);
    std::vector<TestBlob> blobs;
    while (blobs.size() < count) {
        TestBlob blob;
        blob.center = {side(random), side(random), side(random)};
        if (glm::dot(blob.center, blob.center) > 1.0f)
            continue;
        blob.radius = radius;
        blob.crossSection = opticalDepth * 3.14159265f * radius * radius / 3.5f;
        blob.emission = share(random);
        blobs.push_back(blob);
    }
    return blobs;
}

/// Exact light along the ray of each pixel of parallel(), rows from the bottom.
std::vector<double> exactLight(const std::vector<TestBlob>& blobs)
{
    const auto exponential = [](double x) { return std::exp(x); };
    const auto root = [](double x) { return std::sqrt(x); };
    std::vector<double> lights;
    for (int i = 0; i < kWidth * kHeight; ++i) {
        const double x = (i % kWidth + 0.5 - 0.5 * kWidth) * 3.0 / kHeight;
        const double y = (i / kWidth + 0.5 - 0.5 * kHeight) * 3.0 / kHeight;
        std::vector<render::RayBlob<double>> met;
        for (const TestBlob& blob : blobs) {
            const double dx = double(blob.center.x) - x, dy = double(blob.center.y) - y,
                         r = double(blob.radius);
            const double chord2 = r * r - dx * dx - dy * dy, e = double(blob.emission);
            const double middle = double(blob.crossSection) * 1.04445431404056 / (r * r * r);
            if (chord2 > 0.0)
                met.push_back(
                    {6.0 - double(blob.center.z), chord2, r, middle, {e, e, e}, uint32_t(met.size())});
        }
        render::ReferenceIntegral<double, decltype(exponential)> integral(
            met, {0.0, std::numeric_limits<double>::infinity(), {}}, 2, false, 1e-9, root, exponential);
        lights.push_back(integral.light()[0]);
    }
    return lights;
}

/// 99th percentile of errors over max(light, 5 % of the brightest).
double p99(const Picture& picture, const std::vector<double>& exact)
{
    const double brightest = *std::max_element(exact.begin(), exact.end());
    std::vector<double> errors;
    for (size_t i = 0; i < exact.size(); ++i)
        errors.push_back(std::abs(double(picture.texels[4 * i]) - exact[i]) /
                         std::max(exact[i], 0.05 * brightest));
    std::sort(errors.begin(), errors.end());
    return errors[errors.size() * 99 / 100];
}

float brightest(const Picture& picture)
{
    return *std::max_element(picture.texels.begin(), picture.texels.end());
}

} // namespace

TEST_F(Volume, ballsThatOverlapAreTheIntegralThroughTheirSum)
{
    const std::vector<TestBlob> blobs = cloud(100, 0.4f, 0.3f);
    const std::vector<double> exact = exactLight(blobs);
    EXPECT_LT(p99(drawn(blobs, parallel()), exact), 0.15) << "a small picture has large voxels";
    view_->settings().voxels = 16;
    EXPECT_GT(p99(drawn(blobs, parallel()), exact), 0.3) << "the control";
}

TEST_F(Volume, noOrderOfBallsIsSeen)
{
    makeTargets(24, 16);
    const auto closeCamera = render::perspectiveView(kPose, 0.5f, 1.5f, 0.1f);
    std::vector<TestBlob> blobs = cloud(270, 0.3f, 0.5f);
    for (size_t i = 0; i < 30; ++i)
        blobs[9 * i].radius = 0.06f; // loose
    const Picture first = drawn(blobs, closeCamera);
    std::mt19937 random(1);
    double most = 0.0;
    for (int i = 0; i < permutations(); ++i) {
        std::shuffle(blobs.begin(), blobs.end(), random);
        most = std::max(most, maxDifference(drawn(blobs, closeCamera), first));
    }
    std::printf("%d orders: largest change %.1e of the brightest value\n", permutations(),
                most / double(brightest(first)));
    EXPECT_LT(most, double(brightest(first)) / 1023.0);
}

TEST_F(Volume, thousandsOfBallsThatAreTooSmallForVoxelsAreTheOneBall)
{
    // one before a cloud and one behind it, so that rays go from one to the other through its field
    constexpr size_t kParts = 3000;
    const TestBlob behind{{0.0f, 0.0f, -2.0f}, 0.1f, 0.005f, 1.0f},
        before{{0.0f, 0.0f, 2.0f}, 0.1f, 0.002f, 1.0f};
    const auto pictureOf = [&](size_t parts) {
        std::vector<TestBlob> blobs = cloud(60, 0.4f, 0.01f);
        for (TestBlob blob : {behind, before}) {
            blob.crossSection /= float(parts);
            blobs.insert(blobs.end(), parts, blob);
        }
        return drawn(blobs, camera());
    };
    const Picture one = pictureOf(1), many = pictureOf(kParts);
    EXPECT_GT(brightest(one), 0.15f);
    EXPECT_LT(maxDifference(one, many), 0.01);
}

TEST_F(Volume, ballsThatAreTooSmallForVoxelsAreExact)
{
    // one among many that it does not touch: where it is alone, it is drawn as in slabs
    std::vector<TestBlob> blobs = cloud(60, 0.4f, 0.3f);
    for (TestBlob& blob : blobs)
        blob.center.x -= 1.5f;
    blobs.push_back({{3.0f, 0.3f, 0.4f}, 0.1f, 0.02f, 1.0f});
    const Picture volume = drawn(blobs, camera());
    view_->settings().composition = render::Composition::Slabs;
    const Picture slabs = drawn(blobs, camera());
    double most = 0.0, brightest_ = 0.0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 3 * kWidth / 4; x < kWidth; ++x) {
            most = std::max(most, double(std::abs(volume.at(x, y)[0] - slabs.at(x, y)[0])));
            brightest_ = std::max(brightest_, double(slabs.at(x, y)[0]));
        }
    EXPECT_GT(brightest_, 0.1);
    EXPECT_LT(most, 1e-4);
}

TEST_F(Volume, aSmallBallIsHiddenByTheMediumBeforeItAndNotByThatBehindIt)
{
    // light of a spark before, within and behind a ball that lets a tenth of the light through
    const auto spark = [&](float z) {
        const std::vector<TestBlob> both{{{0.0f, 0.0f, 0.0f}, 1.5f, 3.0f},
                                         {{0.0f, 0.0f, z}, 0.08f, 0.005f, 1.0f}};
        const std::vector<TestBlob> alone{{{0.0f, 0.0f, 0.0f}, 1.5f, 3.0f}};
        double sum = 0.0;
        const Picture with = drawn(both, parallel()), without = drawn(alone, parallel());
        for (size_t i = 0; i < with.texels.size(); i += 4)
            sum += double(with.texels[i] - without.texels[i]);
        return sum;
    };
    const double before = spark(3.0f), within = spark(0.0f), behind = spark(-3.0f);
    const double through =
        1.0 - double(drawn({{{0, 0, 0}, 1.5f, 3.0f}}, parallel()).at(kWidth / 2, kHeight / 2)[3]);
    EXPECT_GT(before, 0.1);
    EXPECT_NEAR(behind / before, through, 0.02);
    EXPECT_NEAR(within / before, std::sqrt(through), 0.04) << "half of the medium is before it";
}

TEST_F(Volume, framesAreBitEqual)
{
    const base::FrameSnapshot snapshot = snapshotOf(cloud(100, 0.4f, 0.3f));
    const Picture first = drawn(snapshot, camera());
    EXPECT_EQ(maxDifference(drawn(snapshot, camera()), first), 0.0) << "kept";
    EXPECT_EQ(maxDifference(drawn(cloud(100, 0.4f, 0.3f), camera()), first), 0.0) << "drawn again";
}

TEST_F(Volume, theEyeMayBeInsideAndSurfacesCutTheMedium)
{
    const std::vector<TestBlob> inside{{{0.3f, 0.2f, 5.5f}, 1.5f, 3.0f, 1.0f}};
    const Picture volume = drawn(inside, camera());
    view_->settings().composition = render::Composition::Sorted;
    EXPECT_LT(maxDifference(volume, drawn(inside, camera())), 0.02);
    setDepth(std::vector<float>(size_t(kWidth) * kHeight, 1.0f - 0.1f / 5.8f));
    const std::vector<TestBlob> cut{{{0.1f, -0.2f, 0.0f}, 1.5f, 3.0f, 1.0f}};
    const Picture sorted = drawn(cut, camera());
    view_->settings().composition = render::Composition::Volume;
    EXPECT_LT(maxDifference(sorted, drawn(cut, camera())), 0.02);
}

TEST_F(Volume, layersOfOneBallAreThoseOfTheSortedForm)
{
    TestBlob ball{{0.1f, -0.2f, 0.0f}, 1.5f, 3.0f, 1.0f};
    ball.albedo = 0.6f;
    ball.fireShare = 0.25f;
    view_->settings().layerOutputs = true;
    view_->settings().slices.multiple = false; // balls that are sorted do not light themselves
    view_->settings().lighting.skyLuminance = glm::vec3(1.0f);
    for (const base::MediaLayer layer :
         {base::MediaLayer::Fire, base::MediaLayer::Smoke, base::MediaLayer::Dust}) {
        ball.layer = layer;
        const auto targets = [&](render::Composition composition) {
            view_->settings().composition = composition;
            const Picture picture = drawn({ball}, camera());
            const render::LayerTextures all = view_->layers();
            std::vector<Picture> read_{picture};
            for (const uint32_t texture : {all.fire, all.smoke, all.dust})
                read_.push_back(read(texture));
            for (const uint32_t texture : {all.depth, all.opticalDepth})
                read_.push_back(read(texture, 1));
            return read_;
        };
        const auto volume = targets(render::Composition::Volume),
                   sorted = targets(render::Composition::Sorted);
        const double tolerance[] = {0.03, 0.03, 0.03,
                                    0.03, 0.5,  0.03}; // [m] of the depth: a ball has one point
        for (size_t t = 0; t < volume.size(); ++t) {
            double worst = 0.0;
            for (size_t i = 0; i < volume[t].texels.size(); ++i) {
                const size_t pixel = i * size_t(kWidth * kHeight) / volume[t].texels.size();
                if (sorted[0].texels[4 * pixel + 3] > 0.05f)
                    worst = std::max(worst, double(std::abs(volume[t].texels[i] - sorted[t].texels[i])));
            }
            EXPECT_LE(worst, tolerance[t]) << "target " << t << " of layer " << int(layer);
        }
    }
}

TEST_F(Volume, layersAreNotNegativeAndAddUpToThePicture)
{
    view_->settings().voxels = 64;
    std::vector<TestBlob> blobs = cloud(270, 0.3f, 0.5f);
    for (size_t i = 0; i < blobs.size(); ++i) {
        blobs[i].layer = base::MediaLayer(i % 3);
        blobs[i].fireShare = i % 3 == 0 ? 1.0f : 0.1f;
        blobs[i].albedo = i % 3 == 0 ? 0.0f : 0.5f;
        blobs[i].emission = i % 3 == 0 ? blobs[i].emission : 0.0f;
    }
    const Picture picture = drawn(blobs, camera());
    const float brightest = *std::max_element(picture.texels.begin(), picture.texels.end());
    view_->settings().layerOutputs = true;
    (void)drawn(blobs, camera());
    const render::LayerTextures all = view_->layers();
    const Picture layers[] = {read(all.fire), read(all.smoke), read(all.dust)};
    float least = 0.0f, worst = 0.0f;
    for (size_t i = 0; i < picture.texels.size(); ++i) {
        if (i % 4 == 3)
            continue;
        float sum = 0.0f;
        for (const Picture& layer : layers) {
            least = std::min(least, layer.texels[i]);
            sum += layer.texels[i];
        }
        worst = std::max(worst, std::abs(sum - picture.texels[i]));
    }
    EXPECT_GE(least, 0.0f);
    EXPECT_LE(worst, brightest / 1023.0f);
}

TEST_F(Volume, aMediumOfOneLuminanceShowsItWhateverItsDetail)
{
    std::vector<TestBlob> blobs = cloud(120, 0.45f, 0.8f);
    for (TestBlob& blob : blobs)
        blob.emission = 1.0f;
    const Picture furnace = detailed(blobs, camera()), plain = detailed(blobs, camera(), false);
    double worst = 0.0, change = 0.0;
    for (size_t i = 0; i < furnace.texels.size(); i += 4) {
        worst = std::max(worst, double(std::abs(furnace.texels[i] - furnace.texels[i + 3])));
        change = std::max(change, double(std::abs(furnace.texels[i + 3] - plain.texels[i + 3])));
    }
    EXPECT_LT(worst, 5e-3) << "Kirchhoff: light is luminance times opacity";
    EXPECT_GT(change, 0.1) << "the detail is seen";
}

TEST_F(Volume, slabsHaveTheDetailOfVoxels)
{
    shrunk_ = 2.0f;
    std::vector<TestBlob> blobs = cloud(120, 0.45f, 0.8f);
    for (TestBlob& blob : blobs)
        blob.emission = 1.0f;
    const Picture voxels = detailed(blobs, camera());
    const auto apartFrom = [&](const Picture& picture) {
        double squares = 0.0, worst = 0.0;
        for (size_t i = 0; i < picture.texels.size(); i += 4) {
            const double apart = double(picture.texels[i + 3] - voxels.texels[i + 3]);
            squares += apart * apart;
            worst = std::max(worst, double(std::abs(picture.texels[i] - picture.texels[i + 3])));
        }
        EXPECT_LT(worst, 5e-3) << "Kirchhoff: light is luminance times opacity";
        return std::sqrt(squares / double(picture.texels.size() / 4));
    };
    view_->settings().composition = render::Composition::Slabs;
    const double smooth = apartFrom(detailed(blobs, camera(), false));
    for (const int slabs : {6, 16}) {
        view_->settings().slabs = slabs;
        const Picture picture = detailed(blobs, camera());
        const double apart = apartFrom(picture);
        EXPECT_LT(apart, (slabs == 6 ? 0.4 : 0.11) * smooth) << slabs << " slabs, of " << smooth;
        std::vector<TestBlob> shuffled = blobs;
        std::mt19937 random(3);
        std::shuffle(shuffled.begin(), shuffled.end(), random);
        EXPECT_LT(maxDifference(detailed(shuffled, camera()), picture), 1.0 / 1023.0);
    }
}

TEST_F(Volume, slabsShowDetailOfThousandsOfBallsInOneTile)
{
    makeTargets(8, 8);
    view_->settings().composition = render::Composition::Slabs;
    const TestBlob whole{{0.0f, 0.0f, 0.0f}, 1.5f, 6.0f, 1.0f};
    const auto parted = [&](size_t count) {
        TestBlob part = whole;
        part.crossSection /= float(count);
        return detailed(std::vector<TestBlob>(count, part), camera());
    };
    for (const int slabs : {6, 16}) {
        view_->settings().slabs = slabs;
        const Picture few = parted(300);
        EXPECT_GT(brightest(few), 0.5f);
        const size_t count = slabs == 6 ? 12500 : 9000; // more than a list holds
        EXPECT_LT(maxDifference(parted(count), few), 0.03) << count << " balls, " << slabs << " slabs";
    }
}

TEST_F(Volume, detailInAParallelViewDoesNotDependOnTheDistance)
{
    std::vector<TestBlob> blobs = cloud(120, 0.45f, 0.8f);
    for (TestBlob& blob : blobs)
        blob.emission = 1.0f;
    const auto from = [&](double distance, bool hasDetail) {
        return detailed(blobs,
                        render::orthographicView({{0, 0, distance}, {0, 0, 0}}, 4.0f,
                                                 float(kWidth) / float(kHeight), 0.1f, 5000.0f),
                        hasDetail);
    };
    const Picture near = from(8.0, true);
    EXPECT_LT(maxDifference(from(1024.0, true), near), 5e-3);
    EXPECT_GT(maxDifference(from(8.0, false), near), 0.1) << "the detail is seen";
}

TEST_F(Volume, smallLayersLookTheSame)
{
    const std::vector<TestBlob> blobs = cloud(100, 0.4f, 0.3f);
    const Picture full = drawn(blobs, camera());
    view_->settings().layerDivisor = 2;
    const Picture half = drawn(blobs, camera());
    double mean = 0.0;
    for (size_t i = 0; i < full.texels.size(); ++i)
        mean += double(std::abs(full.texels[i] - half.texels[i])) / double(full.texels.size());
    EXPECT_GT(brightest(full), 0.3f);
    EXPECT_LT(mean, 0.01);
}

TEST_F(Volume, effectsThatOverlapHaveNoOrder)
{
    // the same two clouds as two instances, first one and then the other; they pass through each other
    std::vector<TestBlob> a = cloud(100, 0.4f, 0.3f), b = cloud(60, 0.35f, 0.5f);
    for (TestBlob& blob : b)
        blob.center += glm::vec3(0.4f, 0.1f, 0.2f);
    const auto of = [&](const std::vector<TestBlob>& first, const std::vector<TestBlob>& second) {
        base::FrameSnapshot snapshot = snapshotOf(first);
        const base::FrameSnapshot other = snapshotOf(second);
        return std::pair(drawn(snapshot, camera()), drawn(other, camera()));
    };
    std::vector<TestBlob> ab = a, ba = b;
    ab.insert(ab.end(), b.begin(), b.end());
    ba.insert(ba.end(), a.begin(), a.end());
    const auto [first, second] = of(ab, ba);
    EXPECT_LT(maxDifference(first, second), double(brightest(first)) / 1023.0);
}

TEST_F(Volume, aWarmFrameAllocatesAndCompilesNothing)
{
    ASSERT_TRUE(view_->warmUp().ok());
    view_->settings().lighting.skyLuminance = glm::vec3(1.0f);
    std::vector<TestBlob> moved = cloud(100, 0.4f, 0.3f);
    const base::FrameSnapshot first = snapshotOf(moved);
    for (TestBlob& blob : moved)
        blob.center.y += 0.01f;
    const base::FrameSnapshot second = snapshotOf(moved);
    render::FrameRequest request;
    request.targets.color = color_->name();
    request.targets.width = kWidth;
    request.targets.height = kHeight;
    request.camera = camera();
    for (int frame = 0; frame < 15; ++frame) {
        request.camera.origin.x = 0.001 * (frame % 3);
        const base::SnapshotPair pair{frame % 2 == 0 ? &first : &second, nullptr};
        render::HeapCounter counter;
        const bool good = view_->render(pair, request).ok();
        const int taken = counter.stop();
        ASSERT_TRUE(good);
        if (frame < 9)
            continue;
        EXPECT_EQ(taken, 0) << "frame " << frame;
        EXPECT_EQ(view_->statistics().programsCompiled, 0u);
    }
}

TEST_F(Volume, whatIsNotAskedForIsNotThere)
{
    const auto names = [&] {
        std::string all;
        for (const std::string_view pass : view_->executedPasses())
            all += std::string(pass) + ",";
        return all;
    };
    const std::vector<TestBlob> blobs = cloud(100, 0.4f, 0.3f);
    view_->settings().composition = render::Composition::Sorted;
    (void)drawn(blobs, camera());
    EXPECT_EQ(names().find("field"), std::string::npos);
    const uint64_t without = view_->statistics().textureBytes;
    view_->settings().composition = render::Composition::Volume;
    const base::FrameSnapshot snapshot = snapshotOf(blobs);
    (void)drawn(snapshot, camera());
    EXPECT_NE(names().find("field fill"), std::string::npos);
    EXPECT_GT(view_->statistics().textureBytes, without + (1u << 20));
    (void)drawn(snapshot, camera());
    for (const char* pass : {"field upload", "field texels", "field fill", "field light"})
        EXPECT_EQ(names().find(pass), std::string::npos) << "at rest the field is kept";
    const base::FrameSnapshot nothing(&schema_, std::pmr::new_delete_resource());
    for (int i = 0; i < 400; ++i)
        (void)drawn(nothing, camera());
    EXPECT_EQ(view_->statistics().textureBytes, 0u) << "given back";
}
