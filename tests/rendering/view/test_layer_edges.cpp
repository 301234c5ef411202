// Media drawn at 1/2 and 1/4 of the picture's size against the full size, at edges of opaque surfaces and
// away from them; with a control that must fail: plain bilinear enlargement.
#include "foundation/random/philox.h"
#include "view_fixture.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace fx;
using namespace fx::test;

namespace {

constexpr int kWidth = 256, kHeight = 160;
constexpr float kNear = 0.1f;
constexpr float kHaloBound = 2.0f; ///< p99 of errors at edges over that of errors away from them

/// Smoke from 3 to 9 m before the eye, some of it glowing.
std::vector<TestBlob> smoke()
{
    std::vector<TestBlob> blobs;
    for (int i = 0; i < 120; ++i) {
        const auto u = base::randomUnit4(5, 0, uint64_t(i), base::RandomPurpose::Position);
        const auto v = base::randomUnit4(5, 1, uint64_t(i), base::RandomPurpose::Attributes);
        TestBlob blob;
        blob.center = {9.0f * u[0] - 4.5f, 5.0f * u[1] - 2.5f, 6.0f * u[2] - 3.0f};
        blob.radius = 0.35f + 0.6f * u[3];
        blob.crossSection = 0.8f * v[0];
        blob.layer = base::MediaLayer(i % 3);
        blob.emission = v[1];
        blobs.push_back(blob);
    }
    return blobs;
}

/// [m] axis distance of the opaque scene: a wall, a floor that runs into it, pillars of 1 to 24 pixels before
/// the smoke and inside of it, one of them before another, and a hole to the sky.
float axisDistance(int x, int y)
{
    constexpr struct
    {
        int first, last;
        float distance;
    } kPillars[] = {{20, 20, 2.5f},   {41, 42, 2.5f},   {63, 65, 5.0f},   {90, 94, 6.0f},   {117, 124, 7.0f},
                    {122, 123, 4.0f}, {150, 173, 5.5f}, {201, 201, 6.5f}, {203, 203, 6.5f}, {230, 233, 3.5f}};
    float distance = x > 180 && x < 196 && y > 90 ? std::numeric_limits<float>::infinity() : 12.0f;
    if (y < 50)
        distance = std::min(distance, 240.0f / (70.0f - float(y)));
    for (const auto& pillar : kPillars)
        if (x >= pillar.first && x <= pillar.last)
            distance = std::min(distance, pillar.distance);
    return distance;
}

float storedDepth(float distance)
{
    return std::isinf(distance) ? 1.0f : 1.0f - kNear / distance;
}

/// Another surface within `reach` pixels.
bool isAtEdge(int x, int y, int reach)
{
    const float here = 1.0f / axisDistance(x, y);
    for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx) {
            const float there =
                1.0f / axisDistance(std::clamp(x + dx, 0, kWidth - 1), std::clamp(y + dy, 0, kHeight - 1));
            if (std::abs(here - there) > 0.15f * std::max(here, there))
                return true;
        }
    return false;
}

struct Errors
{
    double median, p99, worst;
};

Errors errorsOf(std::vector<double> all)
{
    std::sort(all.begin(), all.end());
    return {all[all.size() / 2], all[all.size() * 99 / 100], all.back()};
}

class LayerEdges : public ViewTest
{
protected:
    struct Split
    {
        Errors edge, inside;
    };

    Picture drawn(int divisor)
    {
        drawInto(kWidth, kHeight, 1);
        view_->settings().layerDivisor = divisor;
        return render(snapshotOf(smoke()), camera());
    }

    /// What a picture of 1/divisor of the size becomes when it is enlarged bilinearly without regard to
    /// depth.
    Picture drawnPlainly(int divisor)
    {
        drawInto(kWidth / divisor, kHeight / divisor, divisor);
        view_->settings().layerDivisor = 1;
        const Picture small = render(snapshotOf(smoke()), camera());
        Picture large{kWidth, kHeight, std::vector<float>(size_t(kWidth) * kHeight * 4)};
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x)
                for (size_t c = 0; c < 4; ++c)
                    large.texels[(size_t(y) * kWidth + size_t(x)) * 4 + c] =
                        bilinear(small, x, y, divisor, c);
        return large;
    }

    static Split split(const Picture& picture, const Picture& exact)
    {
        const float most = *std::max_element(exact.texels.begin(), exact.texels.end());
        std::vector<double> edge, inside;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                double error = 0.0;
                for (int c = 0; c < 4; ++c)
                    error = std::max(error, double(std::abs(picture.at(x, y)[c] - exact.at(x, y)[c])));
                if (exact.at(x, y)[3] > 0.0f)
                    (isAtEdge(x, y, 4) ? edge : inside).push_back(error / double(most));
            }
        return {errorsOf(edge), errorsOf(inside)};
    }

private:
    static render::CameraView camera()
    {
        return render::perspectiveView({{0.0, 0.0, 6.0}, {0.0, 0.0, 0.0}, {0.0f, 1.0f, 0.0f}}, 0.9f,
                                       float(kWidth) / kHeight, kNear);
    }

    void drawInto(int width, int height, int step)
    {
        makeTargets(width, height);
        setPicture(std::vector<float>(size_t(width * height) * 4, 0.0f));
        std::vector<float> depth;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                depth.push_back(storedDepth(axisDistance(x * step + step / 2, y * step + step / 2)));
        setDepth(depth);
    }

    static float bilinear(const Picture& small, int x, int y, int divisor, size_t c)
    {
        const float u = (float(x) + 0.5f) / float(divisor) - 0.5f;
        const float v = (float(y) + 0.5f) / float(divisor) - 0.5f;
        const auto at = [&](float i, float j) {
            return small.at(std::clamp(int(i), 0, small.width - 1),
                            std::clamp(int(j), 0, small.height - 1))[c];
        };
        const float i = std::floor(u), j = std::floor(v);
        return std::lerp(std::lerp(at(i, j), at(i + 1, j), u - i),
                         std::lerp(at(i, j + 1), at(i + 1, j + 1), u - i), v - j);
    }
};

} // namespace

TEST_F(LayerEdges, areAsGoodAsTheRestAndPlainEnlargementIsNot)
{
    const Picture exact = drawn(1);
    for (const int divisor : {2, 4}) {
        const Split guided = split(drawn(divisor), exact);
        const Split plain = split(drawnPlainly(divisor), exact);
        for (const auto& [name, s] : {std::pair("guided", guided), std::pair("plain", plain)})
            std::printf(
                "1/%d %-6s  edges: median %.2e p99 %.2e max %.2e   rest: median %.2e p99 %.2e max %.2e\n",
                divisor, name, s.edge.median, s.edge.p99, s.edge.worst, s.inside.median, s.inside.p99,
                s.inside.worst);
        EXPECT_LT(guided.edge.p99, double(kHaloBound) * guided.inside.p99) << divisor;
        EXPECT_GT(plain.edge.p99, double(kHaloBound) * plain.inside.p99) << divisor;
    }
}
