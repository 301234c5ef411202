#include "rendering/blocks/tile_error.h"

#include "shaders/formulas/formula.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace fx::render {

namespace {

constexpr int kDirections = 8;
constexpr size_t kMostRays = 256, kLeastRays = 8; ///< of a direction
constexpr size_t kEnoughRays = 64;                ///< that meet medium
constexpr size_t kFewRays = 32;                   ///< that meet medium, below which rays are aimed at balls
constexpr size_t kRayBalls = size_t(1) << 19;     ///< rays of a direction times balls, about
/// Rays of all directions below which an error is not known.
constexpr double kLeastCovered = 16.0;
constexpr float kCovered = 0.01f;          ///< [1] opacity from which on a ray counts
constexpr float kTurn = 0.005f;            ///< [rad] by which the slope of opacity is measured
constexpr int kTileCells = 16;             ///< across a block, of the colors of a tile
constexpr int kCells = 48;                 ///< likewise, of which the truth is computed
constexpr float kDensityStep = 1.1892071f; ///< 2^0.25: a tile may be of a density as much off
/// Times of the work on a ray that meets medium, and on each of the balls that it meets, over that of the
/// comparison with a ball.
constexpr uint64_t kWorkOfRay = 500, kWorkOfBall = 100, kWorkOfColoredRay = 8000, kWorkOfColoredBall = 600;
constexpr uint64_t kWorkOfDirection = 1 << 20; ///< beyond it, kLeastRays are enough

/// A ball in the axes of a direction.
struct SeenBall
{
    glm::vec3 center; ///< [m] along right, up and along
    float radius;     ///< [m]
    float perArea;    ///< [1] optical depth through the middle, times the square of the radius
    uint32_t ball;
};

/// kernel-optical-depth (3) at a distance from the middle, of a ball that is no smaller than a texel.
float depthAt(const SeenBall& ball, const glm::vec2& offset, float texel)
{
    const float radius = std::max(ball.radius, texel);
    const float perArea = 1.0f / (radius * radius);
    const float q2 = 1.0f - glm::dot(offset, offset) * perArea;
    if (!(q2 > 0.0f))
        return 0.0f;
    const float q = std::sqrt(q2);
    // As shaders/blocks/block_tiles.comp.glsl stores it.
    const float forInterpolation = std::min(texel * texel * perArea, 0.5f) / 12.0f * q * (15.0f - 25.0f * q2);
    return ball.perArea * perArea * (q2 * q2 * q - forInterpolation);
}

TileAxes axesAcross(const glm::vec3& along)
{
    const glm::vec3 other = std::abs(along.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 right = glm::normalize(glm::cross(along, other));
    return {right, glm::cross(right, along), along};
}

/// One of kDirections directions that are spread evenly, turned against the axes of the block.
glm::vec3 directionOf(int i)
{
    const float z = (2.0f * float(i) + 1.0f) / float(kDirections) - 1.0f;
    const float turn = 2.3999632f * float(i) + 0.7f, flat = std::sqrt(1.0f - z * z);
    return glm::normalize(glm::vec3(flat * std::cos(turn), z, flat * std::sin(turn)));
}

/// Sums of the squares and of the fourth powers of errors.
struct PowerSums
{
    double squares = 0.0, fourths = 0.0;

    void add(double square, double weight)
    {
        squares += weight * square;
        fourths += weight * square * square;
    }
};

/// Sums of one direction.
struct Squares
{
    std::array<PowerSums, kTileSizes> texels{};
    PowerSums shift, albedo, light;
    double weight = 0.0; ///< sum of the weights of rays that are covered
    double rays = 0.0;   ///< number of these
    double area = 0.0;   ///< share of the cross section of the block that they stand for
};
using SquaresOfDensities = std::array<Squares, 2 * kDensityPower + 1>;

size_t raysOf(size_t balls)
{
    return std::clamp(kRayBalls / std::max<size_t>(balls, 1), kLeastRays, kMostRays);
}

/// Power of 2 of the first density, so that the mean depth of content at the middle one is about 1.
int lowestPower(std::span<const BlockBall> balls, float radius)
{
    double section = 0.0, depth = 0.0;
    for (const BlockBall& ball : balls) {
        section += double(ball.medium.w);
        depth += double(ball.medium.w) * double(ball.medium.w) /
                 std::max(double(ball.place.w * ball.place.w), 1e-30);
    }
    const double ofBlock = section / (std::numbers::pi * std::max(double(radius * radius), 1e-30));
    const double ofBalls = depth / std::max(section * std::numbers::pi, 1e-30);
    const double typical = std::clamp(std::max(ofBlock, ofBalls), 1e-9, 1e9);
    return -int(std::lround(std::log2(typical))) - kDensityPower;
}

/// What a ray meets, cell by cell across the block.
struct RayCells
{
    std::array<float, kCells> depth{};
    std::array<glm::vec3, kCells> albedo{}, light{}; ///< times depth
};

struct SeenColor
{
    glm::vec3 albedo{0.0f}, light{0.0f};
};

/// Colors that reach the eye, times the opacity, of cells whose medium is mixed.
SeenColor seenThrough(const RayCells& cells, float density)
{
    SeenColor seen;
    float before = 1.0f, passed = 0.0f;
    for (size_t k = 0; k < kCells; ++k) {
        passed += cells.depth[k];
        const float behind = std::exp(-density * passed);
        const float weight = (before - behind) / std::max(cells.depth[k], 1e-12f);
        seen.albedo += weight * cells.albedo[k];
        seen.light += weight * cells.light[k];
        before = behind;
    }
    return seen;
}

/// The same as a tile shows them, drawn for a density somewhat off.
SeenColor seenOfTile(const RayCells& cells, float density, float opacity)
{
    SeenColor seen;
    float before = 1.0f, passed = 0.0f, sum = 0.0f;
    for (int tile = 0; tile < kTileCells; ++tile) {
        float depth = 0.0f;
        glm::vec3 albedo(0.0f), light(0.0f);
        for (int k = 0; k < kCells / kTileCells; ++k) {
            const auto cell = size_t(tile * (kCells / kTileCells) + k);
            depth += cells.depth[cell];
            albedo += cells.albedo[cell];
            light += cells.light[cell];
        }
        passed += depth;
        const float behind = std::exp(-kDensityStep * density * passed);
        const float weight = (before - behind) / std::max(depth, 1e-12f);
        seen.albedo += weight * albedo;
        seen.light += weight * light;
        sum += before - behind;
        before = behind;
    }
    const float scale = opacity / std::max(sum, 1e-12f);
    return {scale * seen.albedo, scale * seen.light};
}

double meanSquare(const glm::vec3& v)
{
    return double(glm::dot(v, v)) / 3.0;
}

/// Rays through the balls of a block from one direction.
class DirectionRays
{
public:
    DirectionRays(std::span<const BlockBall> balls, float radius, bool isColored, int lowest)
        : balls_(balls), radius_(radius), lowest_(lowest), isColored_(isColored)
    {
        seen_.reserve(balls.size());
        areas_.reserve(balls.size());
        for (const BlockBall& ball : balls)
            areas_.push_back((areas_.empty() ? 0.0 : areas_.back()) + double(ball.place.w * ball.place.w));
    }

    SquaresOfDensities run(int number, size_t rays)
    {
        const TileAxes axes = axesAcross(directionOf(number));
        middle_ = glm::dot(middleOfBalls(), axes.along);
        seen_.clear();
        for (uint32_t i = 0; i < balls_.size(); ++i) {
            const glm::vec3 center(balls_[i].place);
            seen_.push_back(
                {{glm::dot(center, axes.right), glm::dot(center, axes.up), glm::dot(center, axes.along)},
                 balls_[i].place.w,
                 1.11408460164327f * balls_[i].medium.w,
                 i});
        }
        const uint64_t before = work_;
        const size_t met = runOverDisk(number, rays);
        if (met < std::min(kFewRays, rays / 2) && !isEnough(met, before))
            runAtBalls(number, std::min(rays, kEnoughRays));
        return squares_;
    }

    uint64_t work() const { return work_; } ///< of all directions

private:
    bool isEnough(size_t met, uint64_t before) const
    {
        return met >= kEnoughRays || (met >= kLeastRays && work_ - before > kWorkOfDirection);
    }

    glm::vec3 middleOfBalls() const
    {
        glm::vec3 sum(0.0f);
        float section = 0.0f;
        for (const BlockBall& ball : balls_) {
            sum += ball.medium.w * glm::vec3(ball.place);
            section += ball.medium.w;
        }
        return sum / std::max(section, 1e-20f);
    }

    /// @return number of rays that meet medium
    size_t runOverDisk(int number, size_t rays)
    {
        squares_ = {};
        size_t met = 0, ray = 0;
        for (const uint64_t before = work_; ray < rays && !isEnough(met, before); ++ray) {
            // Evenly over the disk, however many there are: additive recurrence by powers of the plastic
            // number.
            const float away = radius_ * std::sqrt(glm::fract(0.5f + 0.7548777f * float(ray)));
            const float turn = 2.0f * std::numbers::pi_v<float> *
                               glm::fract(0.5698403f * float(ray) + 0.13f * float(number));
            met += add(away * glm::vec2(std::cos(turn), std::sin(turn)), 7.0f * turn, false) ? 1 : 0;
        }
        for (Squares& squares : squares_)
            squares.area = squares.weight / double(std::max<size_t>(ray, 1));
        return met;
    }

    /// Rays through any places of any balls. A place in as many balls is met as often, so that it weighs one
    /// over their number: the means are those over the area.
    void runAtBalls(int number, size_t rays)
    {
        squares_ = {};
        size_t ray = 0;
        for (const uint64_t before = work_; ray < rays && !isEnough(ray, before); ++ray) {
            // The same in three dimensions.
            const double at =
                glm::fract(0.5 + 0.8191725 * double(ray) + 0.37 * double(number)) * areas_.back();
            const auto place = std::upper_bound(areas_.begin(), areas_.end() - 1, at) - areas_.begin();
            const SeenBall& ball = seen_[size_t(place)];
            const float away = ball.radius * std::sqrt(glm::fract(0.5f + 0.6710436f * float(ray)));
            const float turn = 2.0f * std::numbers::pi_v<float> *
                               glm::fract(0.5497005f * float(ray) + 0.13f * float(number));
            add(glm::vec2(ball.center) + away * glm::vec2(std::cos(turn), std::sin(turn)), 7.0f * turn, true);
        }
        for (Squares& squares : squares_)
            squares.area =
                std::min(squares.weight / double(ray) * areas_.back() / double(radius_ * radius_), 1.0);
    }

    /// @param isAimed whether the ray weighs one over the number of balls that it meets
    /// @return whether the ray meets medium
    bool add(const glm::vec2& p, float turn, bool isAimed)
    {
        const float coarsest = 2.0f * radius_ / float(kMinTile - 1);
        met_.clear();
        for (const SeenBall& ball : seen_) {
            const float reach = std::max(ball.radius, coarsest) + 1.5f * coarsest;
            if (std::abs(ball.center.x - p.x) < reach && std::abs(ball.center.y - p.y) < reach)
                met_.push_back(ball);
        }
        work_ += seen_.size() + met_.size() * (isColored_ ? kWorkOfColoredBall : kWorkOfBall) +
                 (isColored_ ? kWorkOfColoredRay : kWorkOfRay);
        const Passed passed = along(p, glm::vec2(0.0f), 0.0f);
        const float depth = passed.depth;
        if (!(depth > 0.0f))
            return false;
        const double weight = isAimed ? 1.0 / double(passed.balls) : 1.0;
        std::array<float, kTileSizes> ofTiles{};
        for (size_t size = 0; size < kTileSizes; ++size)
            ofTiles[size] = interpolated(p, kMinTile << size);
        // A tile of another direction is looked up where the middle of the medium is, which it says itself.
        const glm::vec2 turned = kTurn * glm::vec2(std::cos(turn), std::sin(turn));
        const float ofTurned = along(p, turned, along(p, turned, middle_).middle).depth;
        const RayCells cells = isColored_ ? cellsOf(p) : RayCells();
        for (size_t power = 0; power < squares_.size(); ++power)
            addSquares(std::exp2(float(lowest_ + int(power))), depth, weight, ofTiles, ofTurned, cells,
                       squares_[power]);
        return true;
    }

    void addSquares(float density, float depth, double weight, const std::array<float, kTileSizes>& ofTiles,
                    float ofTurned, const RayCells& cells, Squares& io) const
    {
        const float clear = std::exp(-density * depth);
        if (1.0f - clear < kCovered)
            return;
        io.rays += 1.0;
        io.weight += weight;
        const auto square = [&](float other) {
            const double difference = double(std::exp(-density * std::max(other, 0.0f)) - clear);
            return difference * difference;
        };
        for (size_t size = 0; size < kTileSizes; ++size)
            io.texels[size].add(square(ofTiles[size]), weight);
        io.shift.add(square(ofTurned) / double(kTurn * kTurn), weight);
        if (!isColored_)
            return;
        const SeenColor truth = seenThrough(cells, density);
        const SeenColor tile = seenOfTile(cells, density, 1.0f - clear);
        io.albedo.add(meanSquare(tile.albedo - truth.albedo), weight);
        io.light.add(meanSquare(tile.light - truth.light), weight);
    }

    struct Passed
    {
        float depth = 0.0f;  ///< [1]
        float middle = 0.0f; ///< [m] of the medium, before or behind the center of the block
        uint32_t balls = 0;  ///< that it meets
    };
    /// Along a ray of another direction that crosses this one at a depth [m].
    Passed along(const glm::vec2& p, const glm::vec2& turned, float crossing) const
    {
        Passed passed;
        for (const SeenBall& ball : met_) {
            const float of =
                depthAt(ball, glm::vec2(ball.center) - p - (ball.center.z - crossing) * turned, 0.0f);
            passed.depth += of;
            passed.balls += of > 0.0f ? 1 : 0;
            passed.middle += of * ball.center.z;
        }
        passed.middle = passed.depth > 0.0f ? passed.middle / passed.depth : middle_;
        return passed;
    }

    float interpolated(const glm::vec2& p, int size) const
    {
        const float texel = 2.0f * radius_ / float(size - 1);
        const glm::vec2 place = (p + radius_) / texel;
        const glm::vec2 corner = glm::clamp(glm::floor(place), 0.0f, float(size - 2));
        const glm::vec2 share = place - corner;
        float sum = 0.0f;
        for (int i = 0; i < 4; ++i) {
            const glm::vec2 step(float(i % 2), float(i / 2));
            const glm::vec2 weights = glm::mix(1.0f - share, share, step);
            const glm::vec2 at = (corner + step) * texel - radius_;
            float depth = 0.0f;
            for (const SeenBall& ball : met_)
                depth += depthAt(ball, glm::vec2(ball.center) - at, texel);
            sum += weights.x * weights.y * depth;
        }
        return sum;
    }

    RayCells cellsOf(const glm::vec2& p) const
    {
        RayCells cells;
        for (const SeenBall& ball : met_) {
            const float depth = depthAt(ball, glm::vec2(ball.center) - p, 0.0f);
            if (!(depth > 0.0f))
                continue;
            const glm::vec2 away = glm::vec2(ball.center) - p;
            const float half = std::sqrt(std::max(ball.radius * ball.radius - glm::dot(away, away), 1e-12f));
            float before = 0.0f;
            for (size_t k = 0; k < kCells; ++k) {
                const float plane = radius_ * (2.0f * float(k + 1) / float(kCells) - 1.0f);
                const float behind =
                    formula::fxKernelPassed(std::clamp((plane - ball.center.z) / half, -1.0f, 1.0f));
                const float of = depth * (behind - before);
                cells.depth[k] += of;
                cells.albedo[k] += of * glm::vec3(balls_[ball.ball].medium);
                cells.light[k] += of * glm::vec3(balls_[ball.ball].light);
                before = behind;
            }
        }
        return cells;
    }

    std::span<const BlockBall> balls_;
    float radius_;
    float middle_ = 0.0f; ///< [m] depth of the middle of the content
    int lowest_;          ///< power of 2 of the first density
    bool isColored_;
    uint64_t work_ = 0;
    std::vector<double> areas_; ///< [m2] sums of the squares of the radii up to each ball
    std::vector<SeenBall> seen_, met_;
    SquaresOfDensities squares_{};
};

/// Mean and spread of the mean squares of directions, so that few directions are above.
class OverDirections
{
public:
    void add(const PowerSums& sums, double weight)
    {
        if (!(weight > 0.0))
            return;
        const double mean = sums.squares / weight;
        sum_ += mean;
        squares_ += mean * mean;
        fourths_ += sums.fourths / weight;
        ++count_;
    }
    ErrorPart part() const
    {
        const double count = std::max(count_, 1.0), mean = sum_ / count;
        const double variance = std::max(squares_ / count - mean * mean, 0.0);
        return {float(std::sqrt(mean + std::sqrt(variance))), float(std::sqrt(std::sqrt(fourths_ / count)))};
    }

private:
    double sum_ = 0.0, squares_ = 0.0, fourths_ = 0.0, count_ = 0.0;
};

} // namespace

TileErrors predictTileErrors(std::span<const BlockBall> balls, float radius, bool isColored)
{
    TileErrors errors;
    if (balls.empty())
        return errors;
    errors.lowest = lowestPower(balls, radius);
    std::array<SquaresOfDensities, kDirections> all;
    DirectionRays direction(balls, radius, isColored, errors.lowest);
    for (int i = 0; i < kDirections; ++i)
        all[size_t(i)] = direction.run(i, raysOf(balls.size()));
    errors.work = direction.work();
    for (size_t power = errors.ofPowers.size(); power-- > 0;) {
        TileError& error = errors.ofPowers[power];
        double rays = 0.0, area = 0.0;
        for (const SquaresOfDensities& of : all) {
            rays += of[power].rays;
            area += of[power].area;
        }
        error.covered = float(area / double(kDirections));
        if (rays < kLeastCovered) {
            // Denser content of as many rays errs by no less.
            const float covered = error.covered;
            if (power + 1 < errors.ofPowers.size())
                error = errors.ofPowers[power + 1];
            else
                error.texels.fill({1.0f, 1.0f});
            error.covered = covered;
            continue;
        }
        error.rays = float(rays);
        const auto partOf = [&](auto sumsOf) {
            OverDirections over;
            for (const SquaresOfDensities& of : all)
                over.add(sumsOf(of[power]), of[power].weight);
            return over.part();
        };
        for (size_t size = 0; size < kTileSizes; ++size)
            error.texels[size] = partOf([size](const Squares& s) { return s.texels[size]; });
        error.shift = partOf([](const Squares& s) { return s.shift; });
        error.albedo = partOf([](const Squares& s) { return s.albedo; });
        error.light = partOf([](const Squares& s) { return s.light; });
    }
    return errors;
}

} // namespace fx::render
