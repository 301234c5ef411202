/// @file ball_scenes.h
/// Sets of balls and rays for the tests of this folder, and a brute-force intersection test.
#pragma once

#include "benchmarks/scenes/chance.h"
#include "rendering/reference/trace/ball_tree.h"
#include "rendering/reference/trace/ray_grid.h"

#include <cmath>
#include <string>
#include <vector>

namespace fx::test {

using bench::Chance;
using Balls = std::vector<render::TraceBall>;

/// A set of balls with a name for messages.
struct BallScene
{
    std::string name;
    Balls balls;
};

inline Balls randomBalls(size_t count, double smallest, double largest, uint64_t seed)
{
    Chance chance(seed);
    Balls balls;
    for (size_t i = 0; i < count; ++i)
        balls.push_back({chance.inCube(), smallest * std::pow(largest / smallest, chance())});
    return balls;
}

inline Balls clusteredBalls(size_t count, uint64_t seed)
{
    Chance chance(seed);
    Balls balls;
    glm::dvec3 middle(0.0);
    for (size_t i = 0; i < count; ++i) {
        if (i % 97 == 0)
            middle = 50.0 * chance.inCube();
        balls.push_back({middle + 0.01 * chance.inCube(), 0.002 + 0.003 * chance()});
    }
    return balls;
}

/// Sets of balls: random, clustered and coincident balls, a single ball, no ball, and balls of very different
/// sizes.
inline std::vector<BallScene> ballScenes()
{
    std::vector<BallScene> scenes;
    scenes.push_back({"none", {}});
    scenes.push_back({"one", randomBalls(1, 0.3, 0.3, 1)});
    scenes.push_back({"nine", randomBalls(9, 0.1, 0.5, 2)});
    scenes.push_back({"random", randomBalls(3000, 0.02, 0.2, 3)});
    scenes.push_back({"clustered", clusteredBalls(2500, 4)});
    scenes.push_back({"coincident", Balls(700, {glm::dvec3(0.1, 0.2, -0.3), 0.25})});
    scenes.push_back({"of all sizes", randomBalls(2000, 1e-6, 1e3, 5)});
    Balls plane = randomBalls(1000, 0.01, 0.1, 6);
    for (render::TraceBall& ball : plane)
        ball.center.y = 0.0;
    scenes.push_back({"in a plane", plane});
    Balls far = randomBalls(500, 0.01, 0.1, 7);
    far.push_back({glm::dvec3(3e6, -2e6, 1e6), 1e-3});
    scenes.push_back({"with one far away", far});
    return scenes;
}

/// True if a ray intersects a ball between two ray parameters, computed directly from the definition.
inline bool meets(const render::TraceRay& ray, const render::TraceBall& ball, double begin, double end,
                  const glm::dvec3& origin = glm::dvec3(0.0))
{
    const glm::dvec3 c = ball.center - origin - ray.origin;
    const double t = c.x * ray.direction.x + c.y * ray.direction.y + c.z * ray.direction.z;
    const glm::dvec3 p = c - t * ray.direction;
    const double square = ball.radius * ball.radius - (p.x * p.x + p.y * p.y + p.z * p.z);
    if (!(square > 0.0))
        return false;
    const double half = std::sqrt(square);
    return t + half > begin && t - half < end;
}

} // namespace fx::test
