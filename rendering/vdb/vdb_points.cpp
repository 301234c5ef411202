#include "rendering/vdb/vdb_points.h"

#include <openvdb/openvdb.h>
#include <openvdb/points/PointAttribute.h>
#include <openvdb/points/PointConversion.h>

#include <type_traits>
#include <vector>

namespace fx::render {

openvdb::GridBase::Ptr makePoints(std::span<const VoxelBall> balls, double voxelSize)
{
    namespace points = openvdb::points;
    std::vector<openvdb::Vec3d> places;
    std::vector<openvdb::Vec3f> velocities;
    std::vector<float> radii;
    std::vector<int64_t> ids, instances;
    for (const VoxelBall& ball : balls) {
        places.emplace_back(ball.center.x, ball.center.y, ball.center.z);
        velocities.emplace_back(float(ball.velocity.x), float(ball.velocity.y), float(ball.velocity.z));
        radii.push_back(float(ball.radius));
        ids.push_back(int64_t(ball.id));
        instances.push_back(int64_t(ball.instance));
    }
    const auto transform = openvdb::math::Transform::createLinearTransform(voxelSize);
    const points::PointAttributeVector<openvdb::Vec3d> positions(places);
    const auto order =
        openvdb::tools::createPointIndexGrid<openvdb::tools::PointIndexGrid>(positions, *transform);
    auto grid =
        points::createPointDataGrid<points::NullCodec, points::PointDataGrid>(*order, positions, *transform);
    const auto addAttribute = [&](const char* name, const auto& values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        points::appendAttribute<Value>(grid->tree(), name);
        points::populateAttribute(grid->tree(), order->tree(), name,
                                  points::PointAttributeVector<Value>(values));
    };
    addAttribute("id", ids);
    addAttribute("instance", instances);
    addAttribute("v", velocities);
    addAttribute("pscale", radii);
    grid->setName("points");
    return grid;
}

} // namespace fx::render
