#include "rendering/particle_rows/particle_estimate.h"

#include "foundation/snapshot/gpu_particles.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

namespace {

constexpr size_t kStride = 61; ///< rows from one that is looked at to the next

/// A row as a rectangle across the view.
struct Card
{
    glm::vec3 center; ///< [m] in the group's axes
    float area;       ///< [m2]; 0: nothing is drawn
};

Card spriteAt(const base::SnapshotGroup& group, size_t i)
{
    namespace column = base::particle_column;
    namespace constant = base::particle_constant;
    const auto c = group.constants();
    const auto at = [&](size_t k) { return group.column(k)[i]; };
    const float radius = at(column::Radius);
    float high = radius;
    if (c[constant::Alignment] == float(base::SpriteAlignment::Velocity) && group.has(column::VelocityX)) {
        const glm::vec3 velocity(at(column::VelocityX), at(column::VelocityY), at(column::VelocityZ));
        high += 0.5f * c[constant::Stretch] * glm::length(velocity);
    }
    const glm::vec3 center(at(column::PositionX), at(column::PositionY), at(column::PositionZ));
    return {center, radius > 0.0f ? 4.0f * radius * c[constant::Aspect] * high : 0.0f};
}

/// Nobody knows the rows before they are computed: all are in the middle of where they can be.
Card meanCard(const base::SnapshotGroup& group, const base::GpuParticleProgram& program)
{
    const float aspect = group.constants()[base::particle_constant::Aspect];
    const base::Bounds& bounds = group.info().bounds;
    const glm::vec3 middle = bounds.empty() ? glm::vec3(0.0f) : 0.5f * (bounds.min + bounds.max);
    return {middle, 4.0f * program.meanRadius * program.meanRadius * aspect};
}

/// The piece from row i, which is not the last, to the next.
Card pieceAt(const base::SnapshotGroup& group, size_t i)
{
    namespace column = base::ribbon_column;
    const auto pointAt = [&](size_t row) {
        return glm::vec3(group.column(column::PositionX)[row], group.column(column::PositionY)[row],
                         group.column(column::PositionZ)[row]);
    };
    const auto strips = group.column64(column::Strip);
    const bool isPiece = strips[i] == strips[i + 1];
    const glm::vec3 begin = pointAt(i);
    const glm::vec3 end = isPiece ? pointAt(i + 1) : begin;
    return {0.5f * (begin + end), 2.0f * group.column(column::HalfWidth)[i] * glm::distance(begin, end)};
}

} // namespace

FragmentCounts estimateParticles(const base::SnapshotGroup& group, bool isRibbon,
                                 const base::Placement& place, const CameraGeometry& camera, int width,
                                 int height)
{
    const double window = double(width) * double(height);
    const double pixelsPerSlope = 0.5 * double(height) * std::abs(double(camera.clipScale.y));
    std::array<double, kLayerDivisors.size()> sums{};
    const base::GpuParticleProgram* const program = group.program().get();
    const size_t rows = program    ? program->rows
                        : isRibbon ? std::max<size_t>(group.count(), 1) - 1
                                   : group.count();
    for (size_t i = 0; i < rows; i += kStride) {
        const Card card = program    ? meanCard(group, *program)
                          : isRibbon ? pieceAt(group, i)
                                     : spriteAt(group, i);
        const glm::vec3 center = glm::vec3(place.position) + place.rotation * (card.center * place.scale);
        const float depth = camera.orthographic ? 1.0f : glm::dot(center, camera.forward);
        if (!(card.area > 0.0f) || !(depth > 0.0f))
            continue;
        const double perMetre = pixelsPerSlope * double(place.scale) /
                                double(camera.orthographic ? 1.0f : std::max(depth, camera.nearDistance));
        const double pixels = double(card.area) * perMetre * perMetre;
        for (size_t k = 0; k < sums.size() && std::isfinite(pixels); ++k) {
            const double perTexel = double(kLayerDivisors[k]) * double(kLayerDivisors[k]);
            sums[k] += std::max(std::min(pixels, window) / perTexel, 1.0); // none is smaller than a texel
        }
    }
    const size_t looked = (rows + kStride - 1) / kStride;
    FragmentCounts counts{};
    for (size_t k = 0; k < sums.size(); ++k)
        counts[k] = looked > 0 ? uint64_t(sums[k] * double(rows) / double(looked)) : 0;
    return counts;
}

} // namespace fx::render
