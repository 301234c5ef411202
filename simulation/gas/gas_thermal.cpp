#include "simulation/gas/gas_thermal.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

glm::dvec3 positionOf(const GasView<const float>& gas, uint32_t i)
{
    return {gas.x[i], gas.y[i], gas.z[i]};
}

} // namespace

ThermalFlow measureThermal(const GasView<const float>& gas, const glm::vec3& gravity, const glm::vec3& wind)
{
    ThermalFlow flow;
    const float weight = glm::length(gravity);
    if (gas.count == 0)
        return flow;

    double mass = 0;
    glm::dvec3 center(0.0);
    glm::dvec3 momentum(0.0);
    for (uint32_t i = 0; i < gas.count; ++i) {
        const double m = gas.mass[i];
        mass += m;
        center += m * positionOf(gas, i);
        momentum += m * glm::dvec3(gas.vx[i], gas.vy[i], gas.vz[i]);
    }
    center /= mass;
    double spread = 0;
    for (uint32_t i = 0; i < gas.count; ++i) {
        const glm::dvec3 away = positionOf(gas, i) - center;
        spread += double(gas.mass[i]) * glm::dot(away, away);
    }
    flow.center = glm::vec3(center);
    flow.radius = std::max(float(std::sqrt(spread / mass * (5.0 / 3.0))), 1e-3f); // (1)
    if (!(weight > 0.0f))
        return flow;
    flow.up = gravity * (-1.0f / weight);
    flow.speed = std::max(glm::dot(glm::vec3(momentum / mass) - wind, flow.up), 0.0f);
    if (!flow.active())
        return flow;

    glm::dvec3 lift(0.0);
    for (uint32_t i = 0; i < gas.count; ++i)
        lift += double(gas.mass[i]) * glm::dvec3(flow.velocity(glm::vec3(positionOf(gas, i))));
    flow.mean = glm::vec3(lift / mass); // (2)
    return flow;
}

} // namespace fx::sim
