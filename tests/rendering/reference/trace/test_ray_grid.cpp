/// The rays of a picture and the frustum of a tile.

#include "rendering/reference/trace/ray_grid.h"

#include "tests/rendering/reference/trace/ball_scenes.h"

#include <gtest/gtest.h>

#include <limits>

namespace fx::render {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

RayGrid perspectiveGrid()
{
    RayGrid grid;
    grid.direction = {-1.0, 0.6, -1.0};
    grid.directionX = {2.0 / 64, 0.0, 0.0};
    grid.directionY = {0.0, -1.2 / 40, 0.0};
    return grid;
}

RayGrid parallelGrid()
{
    RayGrid grid;
    grid.origin = {-5.0, 3.0, 2.0};
    grid.originX = {10.0 / 64, 0.0, 0.0};
    grid.originY = {0.0, -6.0 / 40, 0.0};
    grid.direction = {0.0, 0.0, -1.0};
    return grid;
}

double leastDistance(const TileFrustum& frustum, const glm::dvec3& point)
{
    double least = kInf;
    for (const TileFrustum::Plane& plane : frustum.planes)
        least = std::min(least, glm::dot(plane.normal, point) + plane.offset);
    return least;
}

TEST(RayGrid, directionsAreUnitAndTheirDepthIsTheLengthPerDepth)
{
    double lengthPerDepth = 0.0;
    const TraceRay ray = perspectiveGrid().ray(3.5, 30.5, &lengthPerDepth);
    EXPECT_NEAR(glm::length(ray.direction), 1.0, 1e-15);
    EXPECT_NEAR(-ray.direction.z * lengthPerDepth, 1.0, 1e-15);
}

TEST(RayGrid, aFrustumHoldsEveryPointOfItsRaysUpToTheFarEnd)
{
    test::Chance chance(3);
    for (const RayGrid& grid : {perspectiveGrid(), parallelGrid()}) {
        const PixelRect rect{8, 16, 16, 24};
        const TileFrustum frustum = frustumOf(grid, rect, 40.0);
        for (int i = 0; i < 1000; ++i) {
            const TraceRay ray = grid.ray(chance.between(8, 16), chance.between(16, 24));
            EXPECT_GE(leastDistance(frustum, ray.origin + ray.direction * chance.between(0, 40)), 0.0);
        }
    }
}

TEST(RayGrid, aFrustumExcludesWhatIsBesideBehindOrBeyond)
{
    for (const RayGrid& grid : {perspectiveGrid(), parallelGrid()}) {
        const TileFrustum frustum = frustumOf(grid, {8, 16, 16, 24}, 40.0);
        const TraceRay middle = grid.ray(12, 20);
        EXPECT_LT(leastDistance(frustum, middle.origin - middle.direction), 0.0);
        EXPECT_LT(leastDistance(frustum, middle.origin + middle.direction * 41.0), 0.0);
        for (const PixelRect& beside : {PixelRect{7.5, 20, 0, 0}, PixelRect{16.5, 20, 0, 0},
                                        PixelRect{12, 15.5, 0, 0}, PixelRect{12, 24.5, 0, 0}})
        {
            const TraceRay ray = grid.ray(beside.x0, beside.y0);
            EXPECT_LT(leastDistance(frustum, ray.origin + ray.direction * 10.0), 0.0);
        }
    }
}

} // namespace
} // namespace fx::render
