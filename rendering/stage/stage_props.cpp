#include "rendering/stage/stage_props.h"

#include <glm/trigonometric.hpp>

#include <cmath>
#include <cstddef>

namespace fx::render {

void addStageProps(StageMesh& io, const StageMesh& props, const PropPlacement& placement)
{
    const float angle = glm::radians(placement.headingDegrees);
    const float cosine = std::cos(angle), sine = std::sin(angle);
    const auto turned = [&](const glm::vec3& v) {
        return glm::vec3(cosine * v.x + sine * v.z, v.y, cosine * v.z - sine * v.x);
    };
    std::vector<glm::vec3> positions, normals;
    positions.reserve(props.positions.size());
    normals.reserve(props.normals.size());
    for (const glm::vec3& p : props.positions)
        positions.push_back(placement.position + placement.scale * turned(p));
    for (const glm::vec3& n : props.normals)
        normals.push_back(turned(n));
    const auto at = std::ptrdiff_t(io.figureVertices);
    io.positions.insert(io.positions.begin() + at, positions.begin(), positions.end());
    io.normals.insert(io.normals.begin() + at, normals.begin(), normals.end());
    io.colors.insert(io.colors.begin() + at, props.colors.begin(), props.colors.end());
    io.propVertices += props.positions.size();
}

} // namespace fx::render
