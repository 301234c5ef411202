#include "fxsdk/cli/export/field_voxel_detail.h"

#include "rendering/optics/black_body.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace fx::cli {
namespace {

render::PixelWidth voxelWidth(double voxelSize)
{
    render::PixelWidth width;
    width.constant = voxelSize;
    return width;
}

} // namespace

FieldVoxelDetail::FieldVoxelDetail(const MomentBalls& moment, double voxelSize)
    : moment_(moment), medium_(moment.details, render::BallTree(), glm::dvec3(0.0), voxelWidth(voxelSize))
{}

int32_t FieldVoxelDetail::groupOf(uint32_t ball) const
{
    const int32_t group = moment_.details.balls[ball].group;
    return group < 0 || moment_.details.groups[size_t(group)].volume ? -1 : group;
}

render::VoxelDetail::Values FieldVoxelDetail::valuesOf(uint32_t ball) const
{
    const render::MediumDetails::Ball& own = moment_.details.balls[ball];
    const auto& [first, second] = own.carried;
    return {double(first.x),  double(first.y),  double(first.z),     double(second.x),
            double(second.y), double(second.z), double(own.thinning)};
}

render::VoxelDetail::Factors FieldVoxelDetail::at(size_t group, double extinction, const Values& means,
                                                  const glm::dvec3& place) const
{
    const render::MediumDetail detail =
        medium_.at(group, extinction, {{{means[0], means[1], means[2]}, {means[3], means[4], means[5]}}},
                   means[6], place);
    return {detail.share, detail.temperature};
}

/// As render::DetailMix::source().
double FieldVoxelDetail::luminance(uint32_t ball, float temperature) const
{
    const render::VoxelBall& own = moment_.balls[ball];
    const size_t group = size_t(moment_.details.balls[ball].group);
    const auto hot = float(own.temperature);
    const glm::dvec3 more = glm::dvec3(render::blackBodyLuminance(hot * temperature)) -
                            glm::dvec3(render::blackBodyLuminance(hot));
    const glm::dvec3 light = (1.0 - own.albedo) * glm::dvec3(medium_.tint(group)) * more;
    return std::max(own.luminance + glm::dot(render::kLuminance, light), 0.0);
}

} // namespace fx::cli
