#include "simulation/sph/thermal_flow.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

namespace column = gas_column;

glm::vec3 row(const GasStore& gas, size_t first, uint32_t i)
{
    return {gas.at(first)[i], gas.at(first + 1)[i], gas.at(first + 2)[i]};
}

} // namespace

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

ThermalFlow measureThermal(const GasStore& gas, const glm::vec3& gravity, const glm::vec3& wind)
{
    ThermalFlow flow;
    const float weight = glm::length(gravity);
    if (!(weight > 0.0f) || gas.count == 0)
        return flow;

    glm::dvec3 center(0.0);
    glm::dvec3 velocity(0.0);
    for (uint32_t i = 0; i < gas.count; ++i) {
        center += glm::dvec3(row(gas, column::X, i));
        velocity += glm::dvec3(row(gas, column::VelocityX, i));
    }
    center /= double(gas.count);
    velocity /= double(gas.count);
    double spread = 0;
    for (uint32_t i = 0; i < gas.count; ++i) {
        const glm::dvec3 away = glm::dvec3(row(gas, column::X, i)) - center;
        spread += glm::dot(away, away);
    }
    spread /= double(gas.count);

    flow.center = glm::vec3(center);
    flow.up = gravity * (-1.0f / weight);
    flow.radius = std::max(float(std::sqrt(spread * (5.0 / 3.0))), 1e-3f); // (3)
    flow.speed = std::max(glm::dot(glm::vec3(velocity) - wind, flow.up), 0.0f);
    if (!flow.active())
        return flow;

    glm::dvec3 lift(0.0);
    for (uint32_t i = 0; i < gas.count; ++i)
        lift += glm::dvec3(flow.velocity(row(gas, column::X, i)));
    flow.mean = glm::vec3(lift / double(gas.count)); // (4)
    return flow;
}

} // namespace fx::sim
