#include "rendering/view/fragment_budget.h"

#include "rendering/passes/view_block.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::render {

namespace {
constexpr size_t kStride = 17;
constexpr int kLargest = 4;
constexpr double kReturn = 2.0 / 3.0;
} // namespace

double coveredPixels(std::span<const BlobInstance> blobs, const CameraView& camera,
                     const HostTargets& targets)
{
    const CameraGeometry g = cameraGeometry(camera);
    const double screen = double(targets.width) * double(targets.height);
    const double pixelsPerSlope = 0.5 * double(targets.height) * std::abs(double(g.clipScale.y));
    double sum = 0.0;
    for (size_t i = 0; i < blobs.size(); i += kStride) {
        const glm::vec3 center(blobs[i].centerRadius);
        const double depth =
            g.orthographic ? 1.0 : std::max(double(glm::length(center)), double(blobs[i].centerRadius.w));
        const double radius = double(blobs[i].centerRadius.w) * pixelsPerSlope / std::max(depth, 1e-9);
        sum += std::min(std::numbers::pi * radius * radius, screen);
    }
    return sum * double(kStride);
}

void FragmentBudget::decide(double expected, uint64_t budget, int least, bool isFixed)
{
    expected_ = expected;
    least = least >= kLargest ? kLargest : least >= 2 ? 2 : 1;
    divisor_ = std::max(divisor_, least);
    if (isFixed || budget == 0) {
        divisor_ = least;
        return;
    }
    const auto cost = [&](int divisor) { return expected / double(divisor * divisor); };
    while (divisor_ < kLargest && cost(divisor_) > double(budget))
        divisor_ *= 2;
    while (divisor_ > least && cost(divisor_ / 2) < kReturn * double(budget))
        divisor_ /= 2;
}

} // namespace fx::render
