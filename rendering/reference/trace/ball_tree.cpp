#include "rendering/reference/trace/ball_tree.h"

#include "foundation/simd/floating_point_scope.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace fx::render {

namespace {

constexpr uint32_t kBlock = 4096; ///< balls that one task handles at least
constexpr uint32_t kBatch = CurveBatch::kRoom;
constexpr double kCells = double(1u << 20);   ///< of the curve, along each axis
constexpr int kOctavesPerClass = 3;           ///< radii of one size class differ by less than 8
constexpr int kLastClass = 7;                 ///< classes fill the bits above the place on the curve
constexpr float kAbsent = -1e30f;             ///< extent of a child that is not there
constexpr float kRounding = 1.0f / (1 << 20); ///< of a coordinate, by which boxes are widened

/// Where all balls are, and how large the largest is.
struct Extent
{
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
    double radius = 0.0;

    void add(const Extent& other)
    {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
        radius = std::max(radius, other.radius);
    }
};

Extent extentOf(std::span<const TraceBall> balls, base::TaskRunner& tasks)
{
    std::vector<Extent> parts((balls.size() + kBlock - 1) / kBlock);
    tasks.parallelFor(uint32_t(parts.size()), 1, [&](uint32_t first, uint32_t last) {
        for (uint32_t part = first; part < last; ++part) {
            const size_t begin = size_t(part) * kBlock;
            for (const TraceBall& ball : balls.subspan(begin, std::min<size_t>(kBlock, balls.size() - begin)))
                parts[part].add({ball.center, ball.center, ball.radius});
        }
    });
    Extent extent;
    for (const Extent& part : parts)
        extent.add(part);
    return extent;
}

/// Binary exponent of a normal number.
int exponentOf(double x)
{
    return int(std::bit_cast<uint64_t>(x) >> 52 & 0x7FF);
}

/// Keys of up to kBatch balls: size class above, place on the curve below.
class KeyMaker
{
public:
    explicit KeyMaker(const Extent& extent) : low_(extent.low), largest_(exponentOf(extent.radius))
    {
        const glm::dvec3 size = extent.high - extent.low;
        const double edge = std::max({size.x, size.y, size.z});
        scale_ = edge > 0.0 ? (kCells - 1.0) / edge : 0.0;
    }

    void makeKeys(std::span<const TraceBall> balls, uint32_t firstIndex, KeyedIndex* out)
    {
        const size_t count = balls.size();
        for (size_t i = 0; i < count; ++i) {
            const glm::dvec3 cell = (balls[i].center - low_) * scale_;
            for (int axis = 0; axis < 3; ++axis)
                batch_.cell[size_t(axis)][i] = uint32_t(int32_t(cell[axis]));
        }
        batch_.count = count;
        curvePlaces(batch_);
        for (size_t i = 0; i < count; ++i) {
            const int octaves = largest_ - exponentOf(balls[i].radius);
            const uint64_t sizeClass = uint64_t(std::min(octaves / kOctavesPerClass, kLastClass));
            out[i] = {sizeClass << 60 | batch_.place[i], firstIndex + uint32_t(i)};
        }
    }

private:
    glm::dvec3 low_;
    int largest_;
    double scale_;
    CurveBatch batch_;
};

/// A box in the making.
struct Box
{
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& center, const glm::dvec3& extent)
    {
        low = glm::min(low, center - extent);
        high = glm::max(high, center + extent);
    }
};

void setChild(BallTree::Node& node, uint32_t child, const Box& box)
{
    for (int axis = 0; axis < 3; ++axis) {
        const double center = 0.5 * (box.low[axis] + box.high[axis]);
        const double extent = 0.5 * (box.high[axis] - box.low[axis]);
        const float reach = float(std::abs(center) + extent);
        node.center[axis][child] = float(center);
        node.extent[axis][child] = float(extent) + kRounding * reach;
    }
}

void setAbsent(BallTree::Node& node, uint32_t child)
{
    for (int axis = 0; axis < 3; ++axis) {
        node.center[axis][child] = 0.0f;
        node.extent[axis][child] = kAbsent;
    }
}

Box boxOf(const BallTree::Leaf& leaf)
{
    Box box;
    for (uint32_t i = 0; i < BallTree::kWidth && leaf.radius[i] > 0.0; ++i)
        box.add({leaf.x[i], leaf.y[i], leaf.z[i]}, glm::dvec3(leaf.radius[i]));
    return box;
}

Box boxOf(const BallTree::Node& node)
{
    Box box;
    for (uint32_t i = 0; i < BallTree::kWidth && node.extent[0][i] >= 0.0f; ++i)
        box.add({node.center[0][i], node.center[1][i], node.center[2][i]},
                {node.extent[0][i], node.extent[1][i], node.extent[2][i]});
    return box;
}

uint32_t eighthOf(uint32_t count)
{
    return (count + BallTree::kWidth - 1) / BallTree::kWidth;
}

} // namespace

void BallTree::build(std::span<const TraceBall> balls, const glm::dvec3& origin, base::TaskRunner& tasks)
{
    const base::FloatingPointScope floatingPoint;
    count_ = uint32_t(balls.size());
    origin_ = origin;
    levelBegin_.clear();
    leaves_.resize(eighthOf(count_));
    if (count_ == 0)
        return;
    sortBalls(balls, tasks);
    fillLeaves(balls, tasks);
    fillLevels(tasks);
}

void BallTree::sortBalls(std::span<const TraceBall> balls, base::TaskRunner& tasks)
{
    const Extent extent = extentOf(balls, tasks);
    order_.resize(count_);
    tasks.parallelFor(count_, kBlock, [&](uint32_t begin, uint32_t end) {
        const base::FloatingPointScope floatingPoint;
        KeyMaker keys(extent);
        for (uint32_t i = begin; i < end; i += kBatch)
            keys.makeKeys(balls.subspan(i, std::min(kBatch, end - i)), i, order_.data() + i);
    });
    sortByKey(order_, scratch_, tasks);
}

void BallTree::fillLeaves(std::span<const TraceBall> balls, base::TaskRunner& tasks)
{
    tasks.parallelFor(uint32_t(leaves_.size()), kBlock / kWidth, [&](uint32_t begin, uint32_t end) {
        for (uint32_t l = begin; l < end; ++l) {
            Leaf& leaf = leaves_[l];
            for (uint32_t i = 0; i < kWidth; ++i) {
                const uint32_t place = l * kWidth + i;
                const bool isUsed = place < count_;
                const uint32_t index = isUsed ? order_[place].index : 0;
                const glm::dvec3 center = isUsed ? balls[index].center - origin_ : glm::dvec3(0.0);
                leaf.x[i] = center.x;
                leaf.y[i] = center.y;
                leaf.z[i] = center.z;
                leaf.radius[i] = isUsed ? balls[index].radius : -1e30;
            }
        }
    });
}

void BallTree::fillLevels(base::TaskRunner& tasks)
{
    uint32_t total = 0;
    for (uint32_t size = uint32_t(leaves_.size()); levelBegin_.empty() || size > 1;) {
        size = eighthOf(size);
        levelBegin_.push_back(total);
        total += size;
    }
    nodes_.resize(total);
    uint32_t children = uint32_t(leaves_.size());
    for (uint32_t level = 0; level < levels(); ++level) {
        const uint32_t size = eighthOf(children);
        tasks.parallelFor(size, kBlock / (kWidth * kWidth), [&](uint32_t begin, uint32_t end) {
            for (uint32_t n = begin; n < end; ++n) {
                Node& target = nodes_[levelBegin_[level] + n];
                for (uint32_t k = 0; k < kWidth; ++k) {
                    const uint32_t child = n * kWidth + k;
                    if (child >= children)
                        setAbsent(target, k);
                    else
                        setChild(target, k,
                                 level == 0 ? boxOf(leaves_[child]) : boxOf(node(level - 1, child)));
                }
            }
        });
        children = size;
    }
}

} // namespace fx::render
