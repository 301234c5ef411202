#include "rendering/voxelization/opacity_view.h"

#include "rendering/volumes/block_table.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace fx::render {
namespace {

constexpr double kStep = 0.25;     // [voxel] of the integral along a ray
constexpr float kCovered = 0.001f; // [1] opacity
constexpr int kMargin = 2;         // [pixel]

/// Trilinear extinction at places in voxels. Remembers the last block.
class GridSampler
{
public:
    explicit GridSampler(const MediumGrid& grid) : grid_(grid) {}

    double at(const glm::dvec3& p)
    {
        const glm::dvec3 low = glm::floor(p);
        const glm::dvec3 u = p - low;
        const glm::ivec3 i(low);
        double sum = 0.0;
        for (int c = 0; c < 8; ++c) {
            const glm::ivec3 corner(c & 1, c >> 1 & 1, c >> 2);
            const glm::dvec3 w = glm::mix(1.0 - u, u, glm::dvec3(corner));
            sum += w.x * w.y * w.z * double(voxel(i + corner));
        }
        return sum;
    }

private:
    float voxel(const glm::ivec3& v)
    {
        const glm::ivec3 origin = v & ~(kBlockSide - 1);
        if (!isKnown_ || origin != origin_) {
            isKnown_ = true;
            origin_ = origin;
            block_ = findBlock(grid_.blocks, origin);
        }
        const glm::ivec3 in = v - origin;
        return block_ == kNoBlock
                   ? 0.0f
                   : grid_.density[block_ * size_t(kBlockVoxels) + voxelInBlock(in.x, in.y, in.z)];
    }

    const MediumGrid& grid_;
    bool isKnown_ = false;
    glm::ivec3 origin_{0};
    size_t block_ = kNoBlock;
};

} // namespace

OpacityView OpacityView::around(const MediumGrid& grid, const glm::dvec3& direction, int pixels)
{
    const MediumGridSums sums = sumsOf(grid);
    const glm::dvec3 forward = glm::normalize(direction);
    const glm::dvec3 side = glm::normalize(
        glm::cross(forward, std::abs(forward.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
    const glm::dvec3 up = glm::cross(side, forward);
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
    for (int c = 0; c < 8; ++c) {
        const glm::dvec3 corner = grid.place(glm::mix(glm::dvec3(sums.low) - 1.0, glm::dvec3(sums.high) + 1.0,
                                                      glm::dvec3(c & 1, c >> 1 & 1, c >> 2)));
        const glm::dvec2 at(glm::dot(corner, side), glm::dot(corner, up));
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    const double pixel = std::max(high.x - low.x, high.y - low.y) / double(pixels);
    OpacityView view;
    view.right = pixel * side;
    view.up = pixel * up;
    view.width = int(std::ceil((high.x - low.x) / pixel)) + 2 * kMargin;
    view.height = int(std::ceil((high.y - low.y) / pixel)) + 2 * kMargin;
    const double depth = glm::dot(sums.center, forward);
    view.corner = (low.x - pixel * kMargin) * side + (low.y - pixel * kMargin) * up + depth * forward;
    return view;
}

std::vector<float> opacityOf(const MediumGrid& grid, const OpacityView& view, base::TaskRunner& tasks)
{
    std::vector<float> picture(size_t(view.width) * size_t(view.height), 0.0f);
    const MediumGridSums sums = sumsOf(grid);
    if (sums.voxels == 0)
        return picture;
    const glm::dmat3 inverse = glm::inverse(grid.axes);
    const glm::dvec3 forward = glm::normalize(glm::cross(view.up, view.right));
    const glm::dvec3 along = inverse * forward; // [voxel/m]
    const glm::dvec3 low = glm::dvec3(sums.low) - 1.0, high = glm::dvec3(sums.high) + 1.0;
    double shortest = std::numeric_limits<double>::infinity();
    for (int a = 0; a < 3; ++a)
        shortest = std::min(shortest, glm::length(grid.axes[a]));
    const double step = kStep * shortest;
    tasks.parallelFor(uint32_t(view.height), 1, [&](uint32_t begin, uint32_t end) {
        GridSampler sampler(grid);
        for (uint32_t y = begin; y < end; ++y)
            for (int x = 0; x < view.width; ++x) {
                const glm::dvec3 start =
                    inverse * (view.corner + double(x) * view.right + double(y) * view.up - grid.origin);
                double first = -std::numeric_limits<double>::infinity(), last = -first; // [m] in the box
                for (int a = 0; a < 3; ++a) {
                    if (along[a] == 0.0) {
                        if (start[a] < low[a] || start[a] > high[a])
                            last = first;
                        continue;
                    }
                    const double p = (low[a] - start[a]) / along[a], q = (high[a] - start[a]) / along[a];
                    first = std::max(first, std::min(p, q));
                    last = std::min(last, std::max(p, q));
                }
                if (!(last > first))
                    continue;
                const int count = int(std::ceil((last - first) / step));
                const double length = (last - first) / double(count);
                double tau = 0.0;
                for (int k = 0; k < count; ++k)
                    tau += length * sampler.at(start + (first + (double(k) + 0.5) * length) * along);
                picture[size_t(y) * size_t(view.width) + size_t(x)] = float(-std::expm1(-tau));
            }
    });
    return picture;
}

std::vector<float> opacityOf(std::span<const FitBall> balls, const OpacityView& view)
{
    std::vector<double> depth(size_t(view.width) * size_t(view.height), 0.0);
    const double pixel = glm::length(view.right);
    const glm::dvec3 right = view.right / pixel, up = view.up / pixel;
    for (const FitBall& ball : balls) {
        const double x = glm::dot(ball.center - view.corner, right),
                     y = glm::dot(ball.center - view.corner, up);
        const double square = ball.radius * ball.radius;
        const double through = 3.5 * ball.crossSection / (std::numbers::pi * square);
        const int x0 = std::max(int(std::ceil((x - ball.radius) / pixel)), 0);
        const int x1 = std::min(int(std::floor((x + ball.radius) / pixel)), view.width - 1);
        const int y0 = std::max(int(std::ceil((y - ball.radius) / pixel)), 0);
        const int y1 = std::min(int(std::floor((y + ball.radius) / pixel)), view.height - 1);
        for (int j = y0; j <= y1; ++j)
            for (int i = x0; i <= x1; ++i) {
                const double dx = double(i) * pixel - x, dy = double(j) * pixel - y;
                const double inside = 1.0 - (dx * dx + dy * dy) / square;
                if (inside > 0.0)
                    depth[size_t(j) * size_t(view.width) + size_t(i)] +=
                        through * inside * inside * std::sqrt(inside);
            }
    }
    std::vector<float> picture(depth.size());
    std::ranges::transform(depth, picture.begin(), [](double tau) { return float(-std::expm1(-tau)); });
    return picture;
}

double relativeError(std::span<const float> picture, std::span<const float> exact)
{
    double difference = 0.0, sum = 0.0;
    for (size_t i = 0; i < exact.size(); ++i)
        if (std::max(picture[i], exact[i]) > kCovered) {
            difference += double(picture[i] - exact[i]) * double(picture[i] - exact[i]);
            sum += double(exact[i]) * double(exact[i]);
        }
    return sum > 0.0 ? std::sqrt(difference / sum) : 0.0;
}

std::vector<double> viewErrors(const MediumGrid& grid, std::span<const FitBall> balls, int pixels,
                               base::TaskRunner& tasks)
{
    std::vector<double> errors;
    for (const glm::dvec3& direction :
         {glm::dvec3(0, 0, -1), glm::dvec3(-1, 0, 0), glm::dvec3(-0.6, -0.7, -0.4)}) {
        const OpacityView view = OpacityView::around(grid, direction, pixels);
        errors.push_back(relativeError(opacityOf(balls, view), opacityOf(grid, view, tasks)));
    }
    return errors;
}

} // namespace fx::render
