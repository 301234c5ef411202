/// @file field_voxel_detail.h
/// Detail of fields for the balls of a moment, as voxels take it.
#pragma once

#include "fxsdk/cli/export/ball_source.h"
#include "rendering/reference/render/medium_details.h"
#include "rendering/voxelization/voxel_detail.h"

#include <glm/vec3.hpp>

namespace fx::cli {

/// Noise finer than a voxel fades out, as that finer than a pixel does in pictures. Of a volume the balls of
/// its bricks have detail.
class FieldVoxelDetail final : public render::VoxelDetail
{
public:
    /// @param moment must outlive this object  @param voxelSize [m]
    FieldVoxelDetail(const MomentBalls& moment, double voxelSize);

    size_t groups() const override { return moment_.details.groups.size(); }
    int32_t groupOf(uint32_t ball) const override;
    Values valuesOf(uint32_t ball) const override;
    Factors at(size_t group, double extinction, const Values& means, const glm::dvec3& place) const override;
    double luminance(uint32_t ball, float temperature) const override;

private:
    const MomentBalls& moment_;
    render::DetailedMedium medium_; ///< without balls
};

} // namespace fx::cli
