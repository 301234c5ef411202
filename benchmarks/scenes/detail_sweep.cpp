#include "benchmarks/scenes/detail_sweep.h"

#include "fxsdk/cli/support/interrupt.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace fx::cli {

namespace {

constexpr double kFrame = 1.0 / 60.0; ///< [s]
constexpr int kPixelsPerRay = 4;      ///< along an axis, of the picture whose pixels the detail is made for

/// A camera of parallel rays around all balls.
render::ReferenceCamera cameraAround(const std::vector<render::MediumBlob>& blobs)
{
    glm::dvec3 low(1e30), high(-1e30);
    for (const render::MediumBlob& blob : blobs) {
        low = glm::min(low, blob.center - blob.radius);
        high = glm::max(high, blob.center + blob.radius);
    }
    const glm::dvec3 middle = 0.5 * (low + high);
    auto camera = render::ReferenceCamera::lookAt({middle.x, middle.y, high.z + 1.0}, middle,
                                                  glm::dvec3(0.0, 1.0, 0.0));
    camera.orthographic = true;
    camera.halfHeight = 0.5 * std::max(high.x - low.x, high.y - low.y);
    camera.nearDistance = 1e-3;
    return camera;
}

/// [1] sum of the optical depths of all rays.
double wholeDepth(const render::ReferenceScene& scene, int side)
{
    double sum = 0.0;
    for (const float depth : integratedDepth(scene, side, kPixelsPerRay * side))
        sum += double(depth);
    return sum;
}

} // namespace

base::Result<ExtinctionSweep> sweepExtinction(const DetailSubject& subject, int count, int side,
                                              const std::function<bool()>& stop)
{
    const auto scene = DetailScene::create(subject, subject.first);
    if (!scene.ok())
        return scene.status();
    ExtinctionSweep sweep;
    for (int i = 0; i < count; ++i) {
        if (stop())
            return interruptedStatus();
        const double time =
            subject.first + (subject.last - subject.first) * double(i) / double(std::max(count - 1, 1));
        if (base::Status status = (*scene)->show(time); !status)
            return status;
        render::ReferenceScene on = (*scene)->reference(render::kMaxDetailOctaves);
        render::ReferenceScene off = (*scene)->reference(0);
        on.camera = off.camera = cameraAround(off.blobs);
        sweep.times.push_back(time);
        sweep.ratios.push_back(wholeDepth(on, side) / wholeDepth(off, side));
    }
    return sweep;
}

base::Result<std::vector<double>> factorsOfFrames(const DetailSubject& subject, int frames,
                                                  const std::function<bool()>& stop)
{
    const auto scene = DetailScene::create(subject, subject.time);
    if (!scene.ok())
        return scene.status();
    std::vector<double> factors;
    for (int frame = 0; frame < frames; ++frame) {
        if (stop())
            return interruptedStatus();
        if (base::Status status = (*scene)->show(subject.time + frame * kFrame); !status)
            return status;
        const render::ReferenceScene now = (*scene)->reference(render::kMaxDetailOctaves);
        std::vector<double> whole(now.details.groups.size(), 0.0);
        for (size_t i = 0; i < now.blobs.size(); ++i)
            if (const int32_t group = now.details.balls[i].group; group >= 0)
                whole[size_t(group)] += now.blobs[i].crossSection;
        const auto largest = std::max_element(whole.begin(), whole.end());
        factors.push_back(largest == whole.end()
                              ? 1.0
                              : double(now.details.groups[size_t(largest - whole.begin())].detail.factor));
    }
    return factors;
}

} // namespace fx::cli
