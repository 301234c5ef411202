#include "fxsdk/cli/scene/preview_ground.h"

#include "foundation/random/philox.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>

namespace fx::cli {
namespace {

constexpr glm::vec3 kSoil(0.235f, 0.212f, 0.178f);
constexpr glm::vec3 kDryGrass(0.205f, 0.19f, 0.13f);
constexpr glm::vec3 kDamp(0.125f, 0.112f, 0.092f);
constexpr glm::vec3 kHaze(0.4f, 0.44f, 0.49f); ///< of the air in front of what is far away, as an albedo
constexpr float kHazeLength = 10800.0f; ///< [m] over which air hides all but 1/e: a fifth of it at the trees
constexpr float kFields = 90.0f;        ///< [m] from where on the ground is grass
constexpr float kHorizon = 2400.0f;     ///< [m] half of the ground's side

/// A square ring of cells.
struct Ring
{
    float inner, outer, cell; ///< [m] half sides, multiples of the cell
};
constexpr Ring kRings[] = {{0, 20, 0.5f}, {20, 60, 2}, {60, 180, 10}, {180, kHorizon, 60}};

float valueAt(int x, int z, uint32_t octave)
{
    return base::toUnitFloat(base::philox({uint32_t(x), uint32_t(z), octave, 0}, 0x5011)[0]);
}

/// Smooth noise between 0 and 1 of this period.
float noise(const glm::vec2& p, float period, uint32_t octave)
{
    const glm::vec2 place = p / period, low = glm::floor(place);
    const glm::vec2 part = glm::smoothstep(glm::vec2(0.0f), glm::vec2(1.0f), place - low);
    const int x = int(low.x), z = int(low.y);
    const float near = glm::mix(valueAt(x, z, octave), valueAt(x + 1, z, octave), part.x);
    const float far = glm::mix(valueAt(x, z + 1, octave), valueAt(x + 1, z + 1, octave), part.x);
    return glm::mix(near, far, part.y);
}

/// Color of something at this distance from the middle.
glm::vec3 hazed(const glm::vec3& color, float distance)
{
    return glm::mix(kHaze, color, std::exp(-distance / kHazeLength));
}

glm::vec3 groundColor(const glm::vec2& p)
{
    const float away = glm::length(p);
    const float wide = noise(p, 31.0f, 0), middle = noise(p, 9.0f, 1), small = noise(p, 2.3f, 2);
    const float grass = std::clamp(3.0f * (0.6f * wide + 0.4f * middle) - 1.3f + away / kFields, 0.0f, 1.0f);
    const float damp = std::clamp(3.0f * (0.5f * middle + 0.5f * small) - 1.8f, 0.0f, 0.6f);
    glm::vec3 color = glm::mix(glm::mix(kSoil, kDryGrass, grass), kDamp, damp);
    color *= 1.0f + 0.22f * (small - 0.5f);
    return hazed(color, away);
}

void addTriangle(render::StageMesh& mesh, const glm::vec3 (&corners)[3], const glm::vec3 (&colors)[3])
{
    for (int i = 0; i < 3; ++i) {
        mesh.positions.push_back(corners[i]);
        mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
        mesh.colors.push_back(colors[i]);
    }
}

void addCell(render::StageMesh& mesh, const glm::vec2& low, float side)
{
    const glm::vec2 places[] = {low + glm::vec2(0, side), low + side, low + glm::vec2(side, 0), low};
    glm::vec3 corners[4], colors[4];
    for (int i = 0; i < 4; ++i) {
        corners[i] = {places[i].x, 0.0f, places[i].y};
        colors[i] = groundColor(places[i]);
    }
    addTriangle(mesh, {corners[0], corners[1], corners[2]}, {colors[0], colors[1], colors[2]});
    addTriangle(mesh, {corners[0], corners[2], corners[3]}, {colors[0], colors[2], colors[3]});
}

void addRing(render::StageMesh& mesh, const Ring& ring)
{
    const int count = int(std::lround(2.0f * ring.outer / ring.cell));
    for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j) {
            const glm::vec2 low = glm::vec2(i, j) * ring.cell - ring.outer;
            const glm::vec2 middle = glm::abs(low + 0.5f * ring.cell);
            if (std::max(middle.x, middle.y) > ring.inner)
                addCell(mesh, low, ring.cell);
        }
}

} // namespace

void addPreviewGround(render::StageMesh& mesh)
{
    for (const Ring& ring : kRings)
        addRing(mesh, ring);
    mesh.isSoil = true;
}

} // namespace fx::cli
