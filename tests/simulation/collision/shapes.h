/// @file shapes.h
/// Meshes for tests, with distances in closed form.
#pragma once

#include "simulation/collision/distance_field.h"
#include "simulation/collision/mesh_surface.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <thread>
#include <vector>

namespace fx::test {

/// List of triangles. Each triangle has three consecutive positions.
using Soup = std::vector<glm::vec3>;

inline void addQuad(Soup& soup, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                    const glm::vec3& d)
{
    soup.insert(soup.end(), {a, b, c, a, c, d});
}

/// Reverses the orientation of every triangle of a mesh.
inline Soup insideOut(Soup soup)
{
    for (size_t i = 0; i + 2 < soup.size(); i += 3)
        std::swap(soup[i + 1], soup[i + 2]);
    return soup;
}

/// The six sides of a box, counter-clockwise seen from outside.
inline Soup boxMesh(const glm::vec3& low, const glm::vec3& high)
{
    Soup soup;
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 u(0.0f), v(0.0f), w(0.0f);
        u[axis] = high[axis] - low[axis];
        v[(axis + 1) % 3] = high[(axis + 1) % 3] - low[(axis + 1) % 3];
        w[(axis + 2) % 3] = high[(axis + 2) % 3] - low[(axis + 2) % 3];
        addQuad(soup, low, low + w, low + v + w, low + v);
        addQuad(soup, low + u, low + u + v, low + u + v + w, low + u + w);
    }
    return soup;
}

/// A sphere of 4 n (n - 1) triangles. There are 2 n meridians, with 2 (n - 1) triangles between two
/// neighboring meridians.
inline Soup sphereMesh(float radius, int n)
{
    const auto at = [&](int i, int k) {
        const double polar = std::numbers::pi * i / n, azimuth = std::numbers::pi * (k % (2 * n)) / n;
        const double s = i == 0 || i == n ? 0.0 : std::sin(polar);
        return radius * glm::vec3(s * std::cos(azimuth), std::cos(polar), -s * std::sin(azimuth));
    };
    Soup soup;
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < 2 * n; ++k) {
            if (i > 0)
                soup.insert(soup.end(), {at(i, k), at(i + 1, k), at(i, k + 1)});
            if (i + 1 < n)
                soup.insert(soup.end(), {at(i, k + 1), at(i + 1, k), at(i + 1, k + 1)});
        }
    return soup;
}

/// A square sheet in the plane x = 0 with the half side `half`.
inline Soup sheetMesh(float half)
{
    Soup soup;
    addQuad(soup, {0, -half, -half}, {0, half, -half}, {0, half, half}, {0, -half, half});
    return soup;
}

inline Soup joined(Soup a, const Soup& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// Exact signed distance to a box.
inline double boxDistance(const glm::dvec3& p, const glm::dvec3& low, const glm::dvec3& high)
{
    const glm::dvec3 q = glm::max(low - p, p - high);
    const double outside = glm::length(glm::max(q, glm::dvec3(0.0)));
    return outside + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

inline sim::TriangleMesh viewOf(const Soup& soup)
{
    sim::TriangleMesh mesh;
    mesh.positions = soup;
    return mesh;
}

inline std::shared_ptr<const sim::DistanceField> fieldOf(const Soup& soup, float cell)
{
    const std::unique_ptr<base::TaskRunner> tasks = base::makeSerialRunner();
    auto field = sim::DistanceField::build(viewOf(soup), cell, *tasks, std::pmr::get_default_resource());
    EXPECT_TRUE(field.ok()) << field.status().message();
    return field.ok() ? *field : nullptr;
}

/// Creates a runner that runs each loop on `threads` threads, for any number of processors.
inline std::unique_ptr<base::TaskRunner> threadedRunner(uint32_t threads)
{
    static constexpr uint32_t kCounts[] = {0, 1, 2, 3, 4, 5, 6, 7};
    const auto run = [](void* user, uint32_t count, uint32_t minBatch, base::LoopBody body, void* argument) {
        const uint32_t wanted = *static_cast<const uint32_t*>(user);
        const uint32_t size = std::max(minBatch, (count + wanted - 1) / wanted);
        std::vector<std::jthread> workers;
        for (uint32_t begin = 0; begin < count; begin += size)
            workers.emplace_back(body, argument, begin, std::min(begin + size, count));
    };
    return base::makeHostRunner({const_cast<uint32_t*>(&kCounts[threads]), run});
}

/// Position number `i` of a sequence that fills the box from -1 to 1 evenly without lying on a grid.
inline glm::vec3 quasiRandom(uint32_t i)
{
    const auto part = [i](double step) { return float(2.0 * std::fmod(0.5 + i * step, 1.0) - 1.0); };
    return {part(0.8191725133961645), part(0.6710436067037893), part(0.5497004779019703)};
}

} // namespace fx::test
