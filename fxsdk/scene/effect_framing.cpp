#include "fxsdk/scene/effect_framing.h"

#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/block_groups.h"
#include "foundation/snapshot/gpu_particles.h"
#include "foundation/snapshot/particle_kind.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace fx::scene {

namespace {

constexpr double kLeftOut = 0.02;        ///< [1] share of a moment's weight that may lie beyond each side
constexpr double kSeenRadius = 0.7;      ///< [1] of a blob's radius: its profile fades towards the rim
constexpr double kMargin = 1.08;         ///< [1]
constexpr double kNearest = 0.3;         ///< [m] smallest half height of what is framed
const glm::dvec3 kView(0.25, 0.12, 1.0); ///< from the effect to the camera

double discOf(double radius)
{
    return std::numbers::pi * radius * radius;
}

glm::dvec3 inWorld(const base::Placement& placement, const glm::vec3& local)
{
    return placement.position + glm::dvec3(placement.rotation * (placement.scale * local));
}

} // namespace

/// The value below which `share` of the weight lies.
double EffectFraming::quantile(Weights& values, double share)
{
    std::sort(values.begin(), values.end());
    double total = 0;
    for (const auto& [value, weight] : values)
        total += weight;
    double sum = 0;
    for (const auto& [value, weight] : values) {
        sum += weight;
        if (sum >= share * total)
            return value;
    }
    return values.back().first;
}

void EffectFraming::add(const base::FrameSnapshot& snapshot)
{
    const base::KindId blobs = snapshot.schema().find(base::kBlobKind.name);
    for (size_t g = 0; g < snapshot.groupCount(); ++g)
        if (snapshot.group(g).info().kind == blobs)
            addMedia(snapshot.group(g));
}

void EffectFraming::add(const base::FrameSnapshot& snapshot, LocalId instance)
{
    const base::KindId blobs = snapshot.schema().find(base::kBlobKind.name);
    const base::KindId particles = snapshot.schema().find(base::kParticleKind.name);
    const base::KindId onGpu = snapshot.schema().find(base::kGpuParticleKind.name);
    for (size_t g = 0; g < snapshot.groupCount(); ++g) {
        if (snapshot.name(g).instance != instance)
            continue;
        const base::KindId kind = snapshot.group(g).info().kind;
        if (kind == blobs)
            addMedia(snapshot.group(g));
        else if (kind == particles)
            addParticles(snapshot.group(g));
        else if (kind == onGpu)
            addBounds(snapshot.group(g).info());
    }
}

void EffectFraming::add(const std::vector<glm::vec4>& places)
{
    for (const glm::vec4& place : places)
        addBall({glm::dvec3(place), double(place.w), discOf(double(place.w))});
}

void EffectFraming::addParticles(const base::SnapshotGroup& group)
{
    namespace column = base::particle_column;
    const base::Placement& placement = group.info().placement;
    for (size_t i = 0; i < group.count(); ++i) {
        const glm::vec3 local = base::vectorAt(group, column::PositionX, uint32_t(i));
        const double radius = double(group.column(column::Radius)[i] * placement.scale);
        addBall({inWorld(placement, local), radius, discOf(radius)});
    }
}

/// Particles whose places are not on the CPU.
void EffectFraming::addBounds(const base::GroupInfo& info)
{
    const glm::vec3 extent = info.bounds.max - info.bounds.min;
    if (info.count == 0 || !(extent.x >= 0.0f && extent.y >= 0.0f && extent.z >= 0.0f))
        return;
    const double radius = 0.5 * double(info.placement.scale * glm::length(extent));
    addBall({inWorld(info.placement, 0.5f * (info.bounds.min + info.bounds.max)), radius, discOf(radius)});
}

void EffectFraming::addMedia(const base::SnapshotGroup& group)
{
    namespace column = base::blob_column;
    const base::Placement& placement = group.info().placement;
    for (size_t i = 0; i < group.count(); ++i) {
        const glm::vec3 local = base::vectorAt(group, column::PositionX, uint32_t(i));
        const double radius = double(group.column(column::Radius)[i] * placement.scale);
        const double section =
            double(group.column(column::CrossSection)[i]) * double(placement.scale) * double(placement.scale);
        addBall({inWorld(placement, local), kSeenRadius * radius,
                 std::min(section, discOf(radius))}); // what a dense blob hides is its disc
    }
}

void EffectFraming::addBall(const Ball& ball)
{
    if (std::isfinite(ball.weight * (glm::dot(ball.center, ball.center) + ball.radius)) && ball.weight > 0.0)
        moments_.back().push_back(ball);
}

bool EffectFraming::isEmpty() const
{
    return std::all_of(moments_.begin(), moments_.end(), [](const auto& balls) { return balls.empty(); });
}

/// What all moments need.
EffectFraming::Span EffectFraming::spanAlong(const glm::dvec3& axis) const
{
    Span span{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
    Weights low(moments_.get_allocator()), high(moments_.get_allocator());
    for (const std::pmr::vector<Ball>& balls : moments_) {
        low.clear();
        high.clear();
        for (const Ball& ball : balls) {
            low.emplace_back(glm::dot(ball.center, axis) - ball.radius, ball.weight);
            high.emplace_back(glm::dot(ball.center, axis) + ball.radius, ball.weight);
        }
        if (balls.empty())
            continue;
        span.low = std::min(span.low, quantile(low, kLeftOut));
        span.high = std::max(span.high, quantile(high, 1.0 - kLeftOut));
    }
    return span;
}

EffectFraming::Camera EffectFraming::place(double fovY, double aspect, double ground,
                                           double mostHalfHeight) const
{
    const glm::dvec3 back = glm::normalize(kView);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back));
    const glm::dvec3 up = glm::cross(back, right);
    const Span across = spanAlong(right), along = spanAlong(up), deep = spanAlong(back);
    const glm::dvec3 target = right * across.middle() + up * along.middle() + back * deep.middle();
    const double tangent = std::tan(0.5 * fovY);

    Weights wanted(moments_.get_allocator()); // distances from which a ball is inside of the picture
    double distance = kNearest / tangent;
    for (const std::pmr::vector<Ball>& balls : moments_) {
        wanted.clear();
        for (const Ball& ball : balls) {
            const glm::dvec3 way = ball.center - target;
            const double beside = (std::abs(glm::dot(way, right)) + ball.radius) / (tangent * aspect);
            const double above = (std::abs(glm::dot(way, up)) + ball.radius) / tangent;
            wanted.emplace_back(glm::dot(way, back) + std::max(beside, above), ball.weight);
        }
        if (!wanted.empty())
            distance = std::max(distance, quantile(wanted, 1.0 - kLeftOut));
    }
    distance = kMargin * std::min(distance, mostHalfHeight / tangent);
    Camera camera{target + distance * back, target, float(std::min(0.1, 0.01 * distance))};
    camera.position.y = std::max(camera.position.y, ground + 0.1 * distance * tangent);
    return camera;
}

} // namespace fx::scene
