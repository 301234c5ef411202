#include "rendering/reference/path/homogeneous_medium.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fx::render {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

struct Piece
{
    double begin, end; ///< [m] end <= begin: the ray misses
};

Piece ballPiece(const MediumShape& shape, const TraceRay& ray)
{
    const glm::dvec3 toCenter = shape.center - ray.origin;
    const double nearest = glm::dot(toCenter, ray.direction);
    const glm::dvec3 across = toCenter - nearest * ray.direction;
    const double half2 = shape.extent.x * shape.extent.x - glm::dot(across, across);
    const double half = half2 > 0.0 ? std::sqrt(half2) : 0.0;
    return {nearest - half, nearest + half};
}

Piece boxPiece(const MediumShape& shape, const TraceRay& ray, int firstAxis, int axes)
{
    Piece piece{-kFar, kFar};
    for (int axis = firstAxis; axis < firstAxis + axes; ++axis) {
        const double offset = shape.center[axis] - ray.origin[axis];
        if (ray.direction[axis] == 0.0) {
            if (std::abs(offset) > shape.extent[axis])
                return {0.0, 0.0};
            continue;
        }
        const double a = (offset - shape.extent[axis]) / ray.direction[axis];
        const double b = (offset + shape.extent[axis]) / ray.direction[axis];
        piece = {std::max(piece.begin, std::min(a, b)), std::min(piece.end, std::max(a, b))};
    }
    return piece;
}

Piece pieceOf(const MediumShape& shape, const TraceRay& ray)
{
    switch (shape.kind) {
    case MediumShape::Kind::Ball:
        return ballPiece(shape, ray);
    case MediumShape::Kind::Slab:
        return boxPiece(shape, ray, 1, 1);
    case MediumShape::Kind::Box:
        return boxPiece(shape, ray, 0, 3);
    }
    return {0.0, 0.0};
}

class HomogeneousWalk final : public MediumWalk
{
public:
    HomogeneousWalk(const MediumShape& shape, const MediumPoint& point, bool knowsDepth, double looseness)
        : shape_(shape), point_(point), knowsDepth_(knowsDepth),
          majorant_(looseness * std::max({point.extinction.x, point.extinction.y, point.extinction.z}))
    {}

    void start(const TraceRay& ray, double begin, double end) override
    {
        const Piece piece = pieceOf(shape_, ray);
        segment_ = {std::max(piece.begin, begin), std::min(piece.end, end), majorant_};
    }
    bool next(MajorantSegment& out) override
    {
        if (!(segment_.begin < segment_.end) || !(majorant_ > 0.0))
            return false;
        out = segment_;
        segment_.end = segment_.begin;
        return true;
    }
    MediumPoint at(double, double) override { return point_; }
    bool opticalDepth(const TraceRay& ray, double begin, double end, glm::dvec3& out) override
    {
        const Piece piece = pieceOf(shape_, ray);
        const double length = std::max(0.0, std::min(piece.end, end) - std::max(piece.begin, begin));
        out = length > 0.0 ? length * point_.extinction : glm::dvec3(0.0);
        return knowsDepth_;
    }

private:
    MediumShape shape_;
    MediumPoint point_;
    bool knowsDepth_;
    double majorant_; ///< [1/m]
    MajorantSegment segment_;
};

class HomogeneousDepthWalk final : public DepthWalk
{
public:
    HomogeneousDepthWalk(const MediumShape& shape, const MediumPoint& point) : shape_(shape), point_(point) {}

    void start(const TraceRay& ray, double begin, double end) override
    {
        const Piece piece = pieceOf(shape_, ray);
        begin_ = std::max(piece.begin, begin);
        end_ = std::max(begin_, std::min(piece.end, end));
    }
    double depth() const override { return end_ > begin_ ? (end_ - begin_) * point_.extinction.x : 0.0; }
    double depthTo(double parameter) const override
    {
        return end_ > begin_ ? (std::clamp(parameter, begin_, end_) - begin_) * point_.extinction.x : 0.0;
    }
    double parameterAt(double depth) const override { return begin_ + depth / point_.extinction.x; }
    MediumPoint at(double parameter, double) const override
    {
        return parameter >= begin_ && parameter <= end_ ? point_ : MediumPoint();
    }
    std::pair<double, double> extent() const override { return {begin_, end_}; }
    double emitted() const override
    {
        return end_ > begin_ ? (end_ - begin_) * (point_.emission.x + point_.emission.y + point_.emission.z)
                             : 0.0;
    }
    double emissionParameter(double u) const override { return begin_ + u * (end_ - begin_); }
    double emissionDensity() const override { return 0.0; }

private:
    MediumShape shape_;
    MediumPoint point_;
    double begin_ = 0.0, end_ = 0.0;
};

} // namespace

std::unique_ptr<MediumWalk> HomogeneousMedium::walk() const
{
    return std::make_unique<HomogeneousWalk>(shape_, point_, knowsDepth_, looseness_);
}

std::unique_ptr<DepthWalk> HomogeneousMedium::depthWalk() const
{
    if (!knowsDepth_ || point_.extinction != glm::dvec3(point_.extinction.x))
        return nullptr;
    return std::make_unique<HomogeneousDepthWalk>(shape_, point_);
}

double HomogeneousMedium::majorant() const
{
    return looseness_ * std::max({point_.extinction.x, point_.extinction.y, point_.extinction.z});
}

} // namespace fx::render
