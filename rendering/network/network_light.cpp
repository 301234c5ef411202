#include "rendering/network/network_light.h"

#include "foundation/math/elementary.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace fx::render {

namespace {

constexpr double kNearLamp = 1.5; // [cells]
constexpr double kFar = 1e30;     // [m]

using CellLight = std::array<double, kMaxNetworkMoments>; // [lx] moments

/// Calls add(place) for samples^3 places of a cell.
template <class Add>
void forPlaces(const NetworkGrid& grid, const glm::ivec3& cell, int samples, Add&& add)
{
    for (int i = 0; i < samples * samples * samples; ++i) {
        const glm::dvec3 place((i % samples + 0.5) / samples, (i / samples % samples + 0.5) / samples,
                               (i / (samples * samples) + 0.5) / samples);
        add(grid.corner + grid.side * (glm::dvec3(cell) + place));
    }
}

/// @param inCell(cell) CellLight of a cell
template <class InCell>
void addCells(ScatteringNetwork& io, base::TaskRunner& tasks, InCell&& inCell)
{
    const NetworkGrid& grid = io.grid();
    std::vector<CellLight> cells(grid.count(), CellLight{});
    tasks.parallelFor(uint32_t(grid.cells.y * grid.cells.z), 1, [&](uint32_t begin, uint32_t end) {
        for (int row = int(begin); row < int(end); ++row)
            for (int x = 0; x < grid.cells.x; ++x) {
                const glm::ivec3 cell(x, row % grid.cells.y, row / grid.cells.y);
                if (io.extinction(grid.index(cell)) > 0.0f)
                    cells[grid.index(cell)] = inCell(cell);
            }
    });
    for (size_t cell = 0; cell < cells.size(); ++cell)
        io.addDirect(cell, cells[cell]);
}

} // namespace

void addSun(ScatteringNetwork& io, const NetworkSun& sun, int samples, base::TaskRunner& tasks)
{
    const CellLight unit = harmonics(sun.travel);
    addCells(io, tasks, [&](const glm::ivec3& cell) {
        double sum = 0.0;
        forPlaces(io.grid(), cell, samples, [&](const glm::dvec3& place) {
            sum += base::naturalExp(-io.opticalDepth(place, -sun.travel, kFar));
        });
        CellLight light = unit;
        for (double& moment : light)
            moment *= sun.illuminance * sum / double(samples * samples * samples);
        return light;
    });
}

void addLamp(ScatteringNetwork& io, const NetworkLamp& lamp, int samples, base::TaskRunner& tasks)
{
    const double near = kNearLamp * io.grid().side;
    addCells(io, tasks, [&](const glm::ivec3& cell) {
        const bool isNear = glm::distance(io.grid().middle(cell), lamp.position) < near;
        const int used = isNear ? std::max(samples, kNearLampSamples) : samples;
        CellLight light{};
        forPlaces(io.grid(), cell, used, [&](const glm::dvec3& place) {
            const glm::dvec3 way = place - lamp.position;
            const double distance = glm::length(way);
            if (!(distance > 0.0))
                return;
            const glm::dvec3 travel = way / distance;
            const double free = std::min(lamp.radius, distance);
            const double depth = io.opticalDepth(lamp.position + free * travel, travel, distance - free);
            const double irradiance =
                lamp.intensity * base::naturalExp(-depth) / (distance * distance + lamp.radius * lamp.radius);
            const CellLight here = harmonics(travel);
            for (size_t k = 0; k < here.size(); ++k)
                light[k] += irradiance * here[k] / double(used * used * used);
        });
        return light;
    });
}

} // namespace fx::render
