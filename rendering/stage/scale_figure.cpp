#include "rendering/stage/scale_figure.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace fx::render {
namespace {

constexpr int kMeridians = 14;    // around the axis of a capsule
constexpr int kQuarter = 5;       // rings of each cap, without its pole
constexpr float kFlatten = 0.72f; // depth of the trunk over its width

constexpr glm::vec3 kSkin(0.36f, 0.24f, 0.18f);
constexpr glm::vec3 kHair(0.05f, 0.04f, 0.035f);
constexpr glm::vec3 kJacket(0.42f, 0.14f, 0.05f);
constexpr glm::vec3 kTrousers(0.075f, 0.085f, 0.11f);
constexpr glm::vec3 kShoes(0.04f, 0.038f, 0.035f);

/// The convex hull of two balls, pressed flat along z.
struct Part
{
    glm::vec3 low, high;         ///< [m] centers, of a figure that stands at the origin and looks along +z
    float lowRadius, highRadius; ///< [m]
    float depth;                 ///< [1] extent along z over that along x, around the centers
    glm::vec3 color;
    bool isPair; ///< true: the mirror image at x = 0 is a part too
};

constexpr std::array kParts{
    Part{{0, 1.655f, 0.01f}, {0, 1.71f, 0.0f}, 0.074f, 0.09f, 1.1f, kSkin, false},              // head
    Part{{0, 1.695f, -0.02f}, {0, 1.7f, -0.015f}, 0.095f, 0.1f, 1.05f, kHair, false},           // hair
    Part{{0, 1.5f, -0.01f}, {0, 1.6f, 0.0f}, 0.058f, 0.052f, 1.0f, kSkin, false},               // neck
    Part{{0, 1.12f, 0.0f}, {0, 1.36f, 0.0f}, 0.15f, 0.175f, kFlatten, kJacket, false},          // chest
    Part{{0, 0.94f, 0.0f}, {0, 1.08f, 0.0f}, 0.158f, 0.145f, kFlatten, kJacket, false},         // hips
    Part{{0.1f, 1.435f, 0.0f}, {0.185f, 1.425f, 0.0f}, 0.065f, 0.062f, 1.0f, kJacket, true},    // shoulder
    Part{{0.25f, 1.13f, -0.01f}, {0.195f, 1.41f, 0.0f}, 0.046f, 0.06f, 1.0f, kJacket, true},    // upper arm
    Part{{0.275f, 0.88f, 0.05f}, {0.25f, 1.13f, -0.01f}, 0.034f, 0.046f, 1.0f, kJacket, true},  // forearm
    Part{{0.282f, 0.77f, 0.075f}, {0.276f, 0.86f, 0.055f}, 0.03f, 0.04f, 1.0f, kSkin, true},    // hand
    Part{{0.1f, 0.5f, 0.005f}, {0.085f, 0.9f, 0.0f}, 0.06f, 0.095f, 1.0f, kTrousers, true},     // thigh
    Part{{0.108f, 0.1f, -0.015f}, {0.1f, 0.5f, 0.005f}, 0.043f, 0.062f, 1.0f, kTrousers, true}, // shank
    Part{{0.118f, 0.042f, 0.1f}, {0.108f, 0.05f, -0.03f}, 0.036f, 0.05f, 1.0f, kShoes, true},   // foot
};

struct Point
{
    glm::vec3 position, normal;
};

class FigureBuilder
{
public:
    explicit FigureBuilder(const ScaleFigure& figure)
        : position_(figure.position), cosine_(std::cos(glm::radians(figure.headingDegrees))),
          sine_(std::sin(glm::radians(figure.headingDegrees)))
    {}

    void add(const Part& part, float side)
    {
        const auto mirrored = [&](const glm::vec3& p) { return glm::vec3(side * p.x, p.y, p.z); };
        const glm::vec3 low = mirrored(part.low), high = mirrored(part.high);
        const glm::vec3 axis = glm::normalize(high - low);
        const glm::vec3 across = glm::normalize(
            glm::cross(axis, std::abs(axis.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0)));
        const glm::vec3 along = glm::cross(axis, across);
        // The cone that touches both balls meets them at this latitude.
        const float tilt = std::asin((part.lowRadius - part.highRadius) / glm::length(high - low));
        constexpr int kRings = 2 * kQuarter + 2;
        std::array<std::array<Point, kMeridians>, kRings> rings;
        for (int r = 0; r < kRings; ++r) {
            const bool isHigh = r > kQuarter;
            const int step = isHigh ? r - kQuarter - 1 : r;
            const float half = glm::half_pi<float>();
            const float latitude = isHigh ? tilt + (half - tilt) * float(step) / float(kQuarter)
                                          : -half + (half + tilt) * float(step) / float(kQuarter);
            for (int m = 0; m < kMeridians; ++m) {
                const float turn = glm::two_pi<float>() * float(m) / float(kMeridians);
                const glm::vec3 out =
                    std::cos(latitude) * (std::cos(turn) * across + std::sin(turn) * along) +
                    std::sin(latitude) * axis;
                const glm::vec3 center = isHigh ? high : low;
                const float radius = isHigh ? part.highRadius : part.lowRadius;
                const glm::vec3 flat(1.0f, 1.0f, part.depth);
                rings[size_t(r)][size_t(m)] = {placed(center + radius * flat * out),
                                               turned(glm::normalize(out / flat))};
            }
        }
        for (size_t r = 0; r + 1 < rings.size(); ++r)
            for (size_t m = 0; m < kMeridians; ++m) {
                const size_t next = (m + 1) % kMeridians;
                addTriangle(rings[r][m], rings[r][next], rings[r + 1][next], part.color);
                addTriangle(rings[r][m], rings[r + 1][next], rings[r + 1][m], part.color);
            }
    }

    StageMesh mesh;

private:
    glm::vec3 turned(const glm::vec3& v) const
    {
        return {cosine_ * v.x + sine_ * v.z, v.y, cosine_ * v.z - sine_ * v.x};
    }
    glm::vec3 placed(const glm::vec3& v) const { return position_ + turned(v); }

    /// Leaves out triangles at the poles, where a side has no length.
    void addTriangle(const Point& a, const Point& b, const Point& c, const glm::vec3& color)
    {
        const glm::vec3 cross = glm::cross(b.position - a.position, c.position - a.position);
        if (glm::length(cross) < 1e-9f)
            return;
        for (const Point* p : {&a, &b, &c}) {
            mesh.positions.push_back(p->position);
            mesh.normals.push_back(p->normal);
            mesh.colors.push_back(color);
        }
    }

    glm::vec3 position_;
    float cosine_, sine_;
};

} // namespace

void addScaleFigure(StageMesh& io, const ScaleFigure& figure)
{
    FigureBuilder builder(figure);
    for (const Part& part : kParts) {
        builder.add(part, 1.0f);
        if (part.isPair)
            builder.add(part, -1.0f);
    }
    const StageMesh& made = builder.mesh;
    io.positions.insert(io.positions.begin(), made.positions.begin(), made.positions.end());
    io.normals.insert(io.normals.begin(), made.normals.begin(), made.normals.end());
    io.colors.insert(io.colors.begin(), made.colors.begin(), made.colors.end());
    io.figureVertices += made.positions.size();
}

void removeScaleFigures(StageMesh& io)
{
    const auto count = std::ptrdiff_t(io.figureVertices);
    io.positions.erase(io.positions.begin(), io.positions.begin() + count);
    io.normals.erase(io.normals.begin(), io.normals.begin() + count);
    io.colors.erase(io.colors.begin(), io.colors.begin() + count);
    io.figureVertices = 0;
}

} // namespace fx::render
