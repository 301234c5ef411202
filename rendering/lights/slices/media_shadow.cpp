#include "rendering/lights/slices/media_shadow.h"

#include <glm/geometric.hpp>

namespace fx::render {

namespace {

/// A row for places relative to the eye becomes one for places relative to eye - shift.
glm::vec4 shifted(const glm::vec4& row, const glm::dvec3& shift)
{
    return {glm::vec3(row), float(double(row.w) + glm::dot(glm::dvec3(glm::vec3(row)), shift))};
}

} // namespace

MediaShadowBlock mediaShadow(const LightList& list, size_t light, const glm::dvec3& eye,
                             const glm::dvec3& origin)
{
    MediaShadowBlock block;
    const std::span<const SliceLightBlock> lights(list.block().lights);
    if (light >= size_t(list.block().counts.x) || lights[light].tiles.w < 0.5f)
        return block;
    const glm::dvec3 shift = origin - eye;
    if (lights[light].color.w > 0.5f) {
        for (int i = 0; i < 3; ++i)
            block.right[size_t(i)][i] = 1.0f; // the planes have the axes of the world
        block.along[0] = lights[light].along;
        block.tiles[0] = lights[light].tiles;
        block.place = {glm::vec3(glm::dvec3(glm::vec3(lights[light].place)) - shift), 1.0f};
        return block;
    }
    size_t level = 0;
    for (const size_t entry : {light, kFinerPlanes, kFinerPlanes + 1}) {
        const SliceLightBlock& planes = lights[entry];
        if (level > 0 && (light > 0 || planes.tiles.w < 0.5f))
            break;
        block.right[level] = shifted(planes.right, shift);
        block.up[level] = shifted(planes.up, shift);
        block.along[level] = shifted(planes.along, shift);
        block.tiles[level++] = planes.tiles;
    }
    return block;
}

} // namespace fx::render
