#include "benchmarks/scenes/detail_motion.h"

#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/material_kind.h"
#include "fxsdk/cli/support/interrupt.h"
#include "shaders/formulas/formula.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace fx::cli {

namespace {

constexpr double kFrame = 1.0 / 60.0; ///< [s]
constexpr float kHalf = 0.6931f;      ///< [1] optical depth from which on a pixel is medium

/// A picture, the distance of what is seen, and how much there is.
struct Frame
{
    Picture color, depth, opticalDepth;
};

/// Motion of the medium at a point: mean of its balls, weighted by their extinction.
class Motion
{
public:
    explicit Motion(const SceneMoment& moment)
    {
        namespace column = base::blob_column;
        const base::FrameSnapshot& newer = *moment.snapshots.newer;
        for (size_t g = 0; g < newer.groupCount(); ++g) {
            const base::SnapshotGroup& group = newer.group(g);
            if (newer.schema().kind(group.info().kind) != base::kBlobKind)
                continue;
            for (size_t i = 0; i < group.count(); ++i) {
                const auto value = [&](size_t c) { return group.column(c)[i]; };
                balls_.push_back(
                    {{value(column::PositionX), value(column::PositionY), value(column::PositionZ)},
                     {value(column::VelocityX), value(column::VelocityY), value(column::VelocityZ)},
                     value(column::Radius),
                     value(column::CrossSection)});
            }
        }
    }
    /// [m/s]
    glm::dvec3 at(const glm::dvec3& point) const
    {
        glm::dvec3 sum(0.0);
        double extinction = 0.0;
        for (const Ball& ball : balls_) {
            const glm::vec3 d = glm::vec3(point) - ball.center;
            const double e =
                double(formula::fxKernelExtinction(ball.crossSection, ball.radius, glm::dot(d, d)));
            sum += e * glm::dvec3(ball.velocity);
            extinction += e;
        }
        return extinction > 0.0 ? sum / extinction : glm::dvec3(0.0);
    }

private:
    struct Ball
    {
        glm::vec3 center, velocity;
        float radius, crossSection;
    };
    std::vector<Ball> balls_;
};

/// Numbers of the youngest generations of all groups.
double generationsOf(const SceneMoment& moment)
{
    const base::FrameSnapshot& newer = *moment.snapshots.newer;
    double sum = 0.0;
    for (size_t g = 0; g < newer.groupCount(); ++g)
        if (newer.schema().kind(newer.group(g).info().kind) == base::kMaterialKind)
            sum += double(newer.group(g).constants()[base::material_constant::Generation]);
    return sum;
}

/// Linear between pixels. @return false: beside the picture
bool read(const Picture& picture, double x, double y, glm::dvec3& out)
{
    const double u = std::floor(x), v = std::floor(y);
    if (!(u >= 0.0 && v >= 0.0 && u < picture.width - 1 && v < picture.height - 1))
        return false;
    out = glm::dvec3(0.0);
    for (int corner = 0; corner < 4; ++corner) {
        const int i = int(u) + (corner & 1), j = int(v) + (corner >> 1);
        const double weight = (corner & 1 ? x - u : 1.0 - x + u) * (corner >> 1 ? y - v : 1.0 - y + v);
        const float* const texel = &picture.pixels[4 * (size_t(j) * size_t(picture.width) + size_t(i))];
        out += weight * glm::dvec3(texel[0], texel[1], texel[2]);
    }
    return true;
}

/// [1] of the later frame. @param motion of the medium in it
double residualOf(const Frame& now, const Frame& before, const Motion& motion,
                  const render::ReferenceCamera& camera)
{
    const int side = now.color.width;
    const render::RayGrid grid = camera.grid(side, side);
    double squares = 0.0;
    size_t count = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const size_t i = size_t(y) * size_t(side) + size_t(x);
            const double distance = double(now.depth.pixels[i]);
            if (now.opticalDepth.pixels[i] < kHalf || !(distance < 1e9))
                continue;
            const render::TraceRay ray = grid.ray(x + 0.5, y + 0.5);
            const glm::dvec3 point = camera.eye + ray.origin + ray.direction * distance;
            const glm::dvec3 was = point - motion.at(point) * kFrame - camera.eye;
            const double perSlope = 0.5 * side / (camera.halfHeight * glm::dot(was, camera.forward));
            glm::dvec3 earlier;
            if (!read(before.color, 0.5 * side + perSlope * glm::dot(was, camera.right) - 0.5,
                      0.5 * side - perSlope * glm::dot(was, camera.up) - 0.5, earlier))
                continue;
            const float* const texel = &now.color.pixels[4 * i];
            const glm::dvec3 change = glm::dvec3(texel[0], texel[1], texel[2]) - earlier;
            squares += glm::dot(change, change) / 3.0;
            ++count;
        }
    return count > 0 ? std::sqrt(squares / double(count)) : 0.0;
}

} // namespace

base::Result<MotionResidual> motionResidual(DetailScene& scene, SnapshotRenderer& renderer, int frames,
                                            const std::function<bool()>& stop)
{
    render::ViewSettings settings = detailViewSettings();
    settings.toneMap = true;
    settings.layerOutputs = true;
    settings.voxels = 128;
    renderer.settings() = settings;
    MotionResidual result;
    std::optional<Frame> before;
    double generations = 0.0, sum = 0.0;
    const double start = scene.subject().time;
    for (int frame = 0; frame < frames; ++frame) {
        if (stop())
            return interruptedStatus();
        const double time = start + frame * kFrame;
        if (base::Status status = scene.show(time); !status)
            return status;
        if (base::Status status = renderer.render(scene.moment(), scene.camera(), time); !status)
            return status;
        FrameLayers layers = renderer.read();
        Frame now{std::move(layers.color), std::move(layers.depth), std::move(layers.opticalDepth)};
        const double born = generationsOf(scene.moment());
        if (before) {
            result.frames.push_back(residualOf(now, *before, Motion(scene.moment()), scene.camera()));
            if (born != generations) {
                ++result.births;
                result.atBirths += result.frames.back();
            }
            sum += result.frames.back();
            result.worst = std::max(result.worst, result.frames.back());
        }
        generations = born;
        before = std::move(now);
    }
    result.mean = sum / double(std::max<size_t>(result.frames.size(), 1));
    result.atBirths /= std::max(result.births, 1u);
    return result;
}

} // namespace fx::cli
