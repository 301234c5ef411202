#include "simulation/particles/collisions/obstacles.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

/// A cell of the grid and where in it.
struct HeightCell
{
    uint32_t x, z;
    float u, v; ///< [1] 0..1
};

/// Along the way s in [0, 1], where it is inside of the grid's rectangle.
struct Stretch
{
    double begin = 0.0, end = 1.0;

    void cut(double from, double to, double low, double high)
    {
        const double w = to - from;
        if (w == 0.0) {
            if (from < low || from > high)
                end = -1.0;
            return;
        }
        const double a = (low - from) / w, b = (high - from) / w;
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
    }
};

class HeightObstacle final : public Obstacle
{
public:
    explicit HeightObstacle(const CollisionDef& def)
        : grid_(def.heights), low_(def.position + def.heights->low), lift_(def.position.y + def.margin)
    {}

    Clearance clearance(const StepContext&, const glm::vec3& p) const override
    {
        const glm::vec3 g = (p - low_) / grid_->cell;
        const float lastX = float(grid_->nodes.x - 1), lastZ = float(grid_->nodes.z - 1);
        if (!(g.x >= 0.0f && g.x <= lastX && g.z >= 0.0f && g.z <= lastZ))
            return {1e30f, glm::vec3(0.0f)};
        const HeightCell cell = cellOf(g.x, g.z);
        const glm::vec3 normal = normalIn(cell);
        return {(p.y - heightIn(cell)) * normal.y, normal};
    }
    LegContact meet(const StepContext&, const ContactLeg& leg) const override
    {
        const glm::dvec3 from = (glm::dvec3(leg.from) - glm::dvec3(low_)) / glm::dvec3(grid_->cell);
        const glm::dvec3 to = (glm::dvec3(leg.to) - glm::dvec3(low_)) / glm::dvec3(grid_->cell);
        Stretch stretch;
        stretch.cut(from.x, to.x, 0.0, double(grid_->nodes.x - 1));
        stretch.cut(from.z, to.z, 0.0, double(grid_->nodes.z - 1));
        double s = stretch.begin;
        while (s <= stretch.end) { // (4)
            const double next = nextBorder(from, to, s, stretch.end);
            const double middle = 0.5 * (s + next);
            const HeightCell cell =
                cellOf(float(from.x + middle * (to.x - from.x)), float(from.z + middle * (to.z - from.z)));
            if (const double share = firstBelow(leg, from, to, cell, s, next); share <= next)
                return contactAt(leg, share);
            if (next >= stretch.end)
                break;
            s = next;
        }
        return {};
    }

private:
    HeightCell cellOf(float gx, float gz) const
    {
        const float x = std::clamp(std::floor(gx), 0.0f, float(grid_->nodes.x - 2));
        const float z = std::clamp(std::floor(gz), 0.0f, float(grid_->nodes.z - 2));
        return {uint32_t(x), uint32_t(z), gx - x, gz - z};
    }
    double node(uint32_t x, uint32_t z) const { return double(grid_->values[grid_->index(x, 0, z)]); }
    float heightIn(const HeightCell& c) const
    {
        const double near = node(c.x, c.z) + double(c.u) * (node(c.x + 1, c.z) - node(c.x, c.z));
        const double far = node(c.x, c.z + 1) + double(c.u) * (node(c.x + 1, c.z + 1) - node(c.x, c.z + 1));
        return lift_ + float(near + double(c.v) * (far - near));
    }
    glm::vec3 normalIn(const HeightCell& c) const
    {
        const double u = double(c.u), v = double(c.v);
        const double alongX = (1.0 - v) * (node(c.x + 1, c.z) - node(c.x, c.z)) +
                              v * (node(c.x + 1, c.z + 1) - node(c.x, c.z + 1));
        const double alongZ = (1.0 - u) * (node(c.x, c.z + 1) - node(c.x, c.z)) +
                              u * (node(c.x + 1, c.z + 1) - node(c.x + 1, c.z));
        return glm::vec3(glm::normalize(
            glm::dvec3(-alongX / double(grid_->cell.x), 1.0, -alongZ / double(grid_->cell.z))));
    }
    /// Where the way leaves the cell that it is in just behind s.
    static double nextBorder(const glm::dvec3& from, const glm::dvec3& to, double s, double end)
    {
        double next = end;
        for (const int k : {0, 2}) {
            const double w = to[k] - from[k];
            if (w == 0.0)
                continue;
            const double at = from[k] + s * w;
            double border = w > 0.0 ? std::floor(at) + 1.0 : std::ceil(at) - 1.0;
            double share = (border - from[k]) / w;
            if (share <= s) // rounding: it is on the border already
                share = (border + (w > 0.0 ? 1.0 : -1.0) - from[k]) / w;
            if (share > s)
                next = std::min(next, share);
        }
        return next;
    }
    /// The first s in [begin, end] from which the way is below the cell's surface; more than `end` if none.
    double firstBelow(const ContactLeg& leg, const glm::dvec3& from, const glm::dvec3& to,
                      const HeightCell& cell, double begin, double end) const
    {
        const double h = node(cell.x, cell.z), hx = node(cell.x + 1, cell.z) - h,
                     hz = node(cell.x, cell.z + 1) - h;
        const double hxz = node(cell.x + 1, cell.z + 1) - h - hx - hz;
        const double u = from.x - cell.x, v = from.z - cell.z, du = to.x - from.x, dv = to.z - from.z;
        const double y = double(leg.from.y) - double(lift_), dy = double(leg.to.y) - double(leg.from.y);
        const double a = -hxz * du * dv;
        const double b = dy - hx * du - hz * dv - hxz * (u * dv + v * du);
        const double c = y - h - hx * u - hz * v - hxz * u * v; // height above the surface: c + b s + a s^2
        const double atBegin = c + begin * (b + begin * a);
        if (atBegin <= 0.0)
            return b + 2.0 * a * begin < 0.0 ? begin : INFINITY;
        const double slope = b + 2.0 * a * begin, inside = slope * slope - 4.0 * a * atBegin;
        if (inside < 0.0)
            return INFINITY;
        const double root = std::sqrt(inside);
        const double ahead = slope < 0.0 ? 2.0 * atBegin / (root - slope)
                             : a < 0.0   ? (slope + root) / (-2.0 * a)
                                         : INFINITY;
        return begin + ahead <= end ? begin + ahead : INFINITY;
    }
    LegContact contactAt(const ContactLeg& leg, double share) const
    {
        const glm::vec3 place(glm::dvec3(leg.from) + share * (glm::dvec3(leg.to) - glm::dvec3(leg.from)));
        const glm::vec3 g = (place - low_) / grid_->cell;
        return {true, float(share), place, normalIn(cellOf(g.x, g.z))};
    }

    std::shared_ptr<const FieldGrid> grid_;
    glm::vec3 low_; ///< [m] the first node
    float lift_;    ///< [m] added to all heights
};

} // namespace

std::unique_ptr<Obstacle> makeHeightObstacle(const CollisionDef& def)
{
    return std::make_unique<HeightObstacle>(def);
}

} // namespace fx::sim
