#include "simulation/motion/thermal_flow.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace fx::sim {

glm::vec3 ThermalFlow::velocity(const glm::vec3& position) const
{
    const glm::vec3 s = position - center;
    const float z = glm::dot(s, up);
    const float r2 = glm::dot(s, s);
    const float a2 = radius * radius;
    if (r2 < a2) {
        const float along = 1.0f - (2.0f * r2 - z * z) / a2;
        return speed * (up + 1.5f * (along * up + (z / a2) * (s - z * up))); // (1)
    }
    const float r = std::sqrt(r2);
    const float ratio = radius / r;
    return (0.5f * speed * ratio * ratio * ratio) * ((3.0f * z / r2) * s - up); // (2)
}

glm::vec3 ThermalFlow::velocityAbove(float height, const glm::vec3& position) const
{
    const glm::vec3 direct = velocity(position);
    if (!std::isfinite(height))
        return direct;
    const glm::vec3 image = velocity({position.x, 2.0f * height - position.y, position.z});
    return {direct.x + image.x, direct.y - image.y, direct.z + image.z}; // (3)
}

} // namespace fx::sim
