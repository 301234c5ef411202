#include "rendering/blocks/block_error.h"

#include "shaders/formulas/formula.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::render {

namespace {

constexpr int kDirections = 8;
constexpr size_t kMostRays = 256, kLeastRays = 8; ///< of a direction
constexpr size_t kEnoughRays = 64;                ///< that meet medium
constexpr size_t kRayBalls = size_t(1) << 19;     ///< rays of a direction times balls, about
constexpr float kCovered = 0.01f;                 ///< [1] opacity from which on a ray counts
constexpr float kTurn = 0.005f;                   ///< [rad] by which the slope of opacity is measured
constexpr int kTileCells = 16;                    ///< across a block, of the colors of a tile
constexpr int kCells = 48;                        ///< likewise, of which the truth is computed
constexpr float kDensityStep = 1.1892071f;        ///< 2^0.25: a tile may be of a density as much off
constexpr uint64_t kBallsOfFrame = 1 << 14;       ///< that are predicted in a frame, about
constexpr size_t kMostEntries = 4096;
constexpr uint64_t kUnusedFrames = 240;

/// [1] Errors are predicted from few rays.
constexpr float kSafety = 1.2f;
/// [1] Standard deviations of the mean square of as many rays as a block has pixels.
constexpr float kDeviations = 4.0f;
/// [rad] about the largest difference of directions in the finest cell
constexpr float kFinestAngle = 4.2f / float(kMaxDirectionCells);

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

    void add(double square)
    {
        squares += square;
        fourths += square * square;
    }
};

/// Sums of one direction.
struct Squares
{
    std::array<PowerSums, kTileSizes> texels{};
    PowerSums shift, albedo, light;
    uint32_t rays = 0;  ///< that are covered
    uint32_t tried = 0; ///< all
};
using SquaresOfDensities = std::array<Squares, std::tuple_size_v<TileErrors>>;

float densityOf(size_t power)
{
    return std::exp2(float(int(power) - kDensityPower));
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
    DirectionRays(std::span<const BlockBall> balls, float radius, bool isColored)
        : balls_(balls), radius_(radius), isColored_(isColored)
    {
        seen_.reserve(balls.size());
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
        squares_ = {};
        size_t met = 0, ray = 0;
        for (; ray < rays && met < kEnoughRays; ++ray) {
            // Evenly over the disk, however many there are: additive recurrence by powers of the plastic
            // number.
            const float away = radius_ * std::sqrt(glm::fract(0.5f + 0.7548777f * float(ray)));
            const float turn = 2.0f * std::numbers::pi_v<float> *
                               glm::fract(0.5698403f * float(ray) + 0.13f * float(number));
            met += add(away * glm::vec2(std::cos(turn), std::sin(turn)), 7.0f * turn) ? 1 : 0;
        }
        for (Squares& squares : squares_)
            squares.tried = uint32_t(ray);
        return squares_;
    }

private:
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

    /// @return whether the ray meets medium
    bool add(const glm::vec2& p, float turn)
    {
        const float coarsest = 2.0f * radius_ / float(kMinTile - 1);
        met_.clear();
        for (const SeenBall& ball : seen_) {
            const float reach = std::max(ball.radius, coarsest) + 1.5f * coarsest;
            if (std::abs(ball.center.x - p.x) < reach && std::abs(ball.center.y - p.y) < reach)
                met_.push_back(ball);
        }
        const float depth = along(p, glm::vec2(0.0f), 0.0f).depth;
        if (!(depth > 0.0f))
            return false;
        std::array<float, kTileSizes> ofTiles{};
        for (size_t size = 0; size < kTileSizes; ++size)
            ofTiles[size] = interpolated(p, kMinTile << size);
        // A tile of another direction is looked up where the middle of the medium is, which it says itself.
        const glm::vec2 turned = kTurn * glm::vec2(std::cos(turn), std::sin(turn));
        const float ofTurned = along(p, turned, along(p, turned, middle_).middle).depth;
        const RayCells cells = isColored_ ? cellsOf(p) : RayCells();
        for (size_t power = 0; power < squares_.size(); ++power)
            addSquares(densityOf(power), depth, ofTiles, ofTurned, cells, squares_[power]);
        return true;
    }

    void addSquares(float density, float depth, const std::array<float, kTileSizes>& ofTiles, float ofTurned,
                    const RayCells& cells, Squares& io) const
    {
        const float clear = std::exp(-density * depth);
        if (1.0f - clear < kCovered)
            return;
        ++io.rays;
        const auto square = [&](float other) {
            const double difference = double(std::exp(-density * std::max(other, 0.0f)) - clear);
            return difference * difference;
        };
        for (size_t size = 0; size < kTileSizes; ++size)
            io.texels[size].add(square(ofTiles[size]));
        io.shift.add(square(ofTurned) / double(kTurn * kTurn));
        if (!isColored_)
            return;
        const SeenColor truth = seenThrough(cells, density);
        const SeenColor tile = seenOfTile(cells, density, 1.0f - clear);
        io.albedo.add(meanSquare(tile.albedo - truth.albedo));
        io.light.add(meanSquare(tile.light - truth.light));
    }

    struct Passed
    {
        float depth = 0.0f;  ///< [1]
        float middle = 0.0f; ///< [m] of the medium, before or behind the center of the block
    };
    /// Along a ray of another direction that crosses this one at a depth [m].
    Passed along(const glm::vec2& p, const glm::vec2& turned, float crossing) const
    {
        Passed passed;
        for (const SeenBall& ball : met_) {
            const float of =
                depthAt(ball, glm::vec2(ball.center) - p - (ball.center.z - crossing) * turned, 0.0f);
            passed.depth += of;
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
    bool isColored_;
    std::vector<SeenBall> seen_, met_;
    SquaresOfDensities squares_{};
};

/// Mean and spread of the mean squares of directions, so that few directions are above.
class OverDirections
{
public:
    void add(const PowerSums& sums, uint32_t rays)
    {
        if (rays == 0)
            return;
        const double mean = sums.squares / double(rays);
        sum_ += mean;
        squares_ += mean * mean;
        fourths_ += sums.fourths / double(rays);
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

ErrorPart mixed(const ErrorPart& a, const ErrorPart& b, float t)
{
    return {glm::mix(a.rms, b.rms, t), glm::mix(a.tail, b.tail, t)};
}

TileError mixed(const TileError& a, const TileError& b, float t)
{
    TileError out;
    for (size_t i = 0; i < kTileSizes; ++i)
        out.texels[i] = mixed(a.texels[i], b.texels[i], t);
    out.shift = mixed(a.shift, b.shift, t);
    out.albedo = mixed(a.albedo, b.albedo, t);
    out.light = mixed(a.light, b.light, t);
    out.covered = glm::mix(a.covered, b.covered, t);
    return out;
}

float squareOf(float x)
{
    return x * x;
}

} // namespace

TileErrors predictTileErrors(std::span<const BlockBall> balls, float radius, bool isColored)
{
    const size_t rays = std::clamp(kRayBalls / std::max<size_t>(balls.size(), 1), kLeastRays, kMostRays);
    std::array<SquaresOfDensities, kDirections> all;
    DirectionRays direction(balls, radius, isColored);
    for (int i = 0; i < kDirections; ++i)
        all[size_t(i)] = direction.run(i, rays);
    TileErrors errors;
    for (size_t power = 0; power < errors.size(); ++power) {
        const auto partOf = [&](auto sumsOf) {
            OverDirections over;
            for (const SquaresOfDensities& of : all)
                over.add(sumsOf(of[power]), of[power].rays);
            return over.part();
        };
        for (size_t size = 0; size < kTileSizes; ++size)
            errors[power].texels[size] = partOf([size](const Squares& s) { return s.texels[size]; });
        errors[power].shift = partOf([](const Squares& s) { return s.shift; });
        errors[power].albedo = partOf([](const Squares& s) { return s.albedo; });
        errors[power].light = partOf([](const Squares& s) { return s.light; });
        double met = 0.0, tried = 0.0;
        for (const SquaresOfDensities& of : all) {
            met += double(of[power].rays);
            tried += double(of[power].tried);
        }
        errors[power].covered = float(met / std::max(tried, 1.0));
    }
    return errors;
}

TileError errorAt(const TileErrors& errors, float density)
{
    const float power = std::log2(std::max(density, 1e-20f)) + float(kDensityPower);
    if (power <= 0.0f) {
        TileError none;
        none.covered = errors.front().covered;
        return mixed(none, errors.front(), std::exp2(power));
    }
    const float place = std::min(power, float(errors.size() - 1));
    const auto below = std::min(size_t(place), errors.size() - 2);
    return mixed(errors[below], errors[below + 1], place - float(below));
}

TileSource sourceOf(const BlockContent& content, float exposure)
{
    // How media will be lit is not known: they count as white where they scatter everything.
    const glm::vec3 value = exposure * content.light + content.albedo;
    return {exposure, float(std::sqrt(meanSquare(value)))};
}

TileChoice chooseTile(const TileError& error, const TileSource& source, const TileView& view, float limit)
{
    const float pixels =
        std::max(0.25f * std::numbers::pi_v<float> * squareOf(view.pixels) * error.covered, 1.0f);
    const float ofTail = kDeviations / std::sqrt(pixels);
    const auto of = [&](const ErrorPart& part) {
        return std::sqrt(squareOf(part.rms) + ofTail * squareOf(part.tail));
    };
    // Tiles of near blocks are wider, and errors of interpolation proportional to the square of a texel.
    const float wider = 1.0f / (1.0f - squareOf(std::min(view.nearness, kMaxNearness)));
    const float color = source.exposure * of(error.light) + of(error.albedo);
    const float shift = source.value * of(error.shift);
    const float most = squareOf(limit / kSafety);
    const auto ofTexels = [&](size_t size) {
        return squareOf(color) + squareOf(source.value * wider * of(error.texels[size]));
    };
    TileChoice choice;
    choice.least = kSafety * std::sqrt(ofTexels(kTileSizes - 1) + squareOf(shift * kFinestAngle));
    size_t size = 0;
    while (size + 1 < kTileSizes && ofTexels(size) > 0.5f * most)
        ++size;
    choice.texels = kMinTile << size;
    const float rest = std::sqrt(std::max(most - ofTexels(size), 0.0f));
    choice.angle = std::max(rest / std::max(shift, 1e-6f), kFinestAngle);
    return choice;
}

void BlockErrors::begin(bool isSpread)
{
    isSpread_ = isSpread;
    ++frame_;
    work_ = 0;
    deferred_ = 0;
    if (entries_.size() > kMostEntries)
        std::erase_if(entries_,
                      [&](const auto& entry) { return entry.second.frame + kUnusedFrames < frame_; });
}

const TileErrors* BlockErrors::find(uint32_t variant, const BlockContents& contents, double seconds)
{
    const BlockContent& content = contents.of(variant);
    const auto known = entries_.find(content.identity);
    const bool isKnown = known != entries_.end();
    const double passed = isKnown && content.isAnimated ? std::abs(seconds - known->second.seconds) : 0.0;
    if (!isKnown || passed > kSeconds) {
        if (isSpread_ && work_ > kBallsOfFrame) {
            ++deferred_;
            return isKnown ? &known->second.shown : nullptr;
        }
        Entry& entry = entries_[content.identity];
        predict(variant, contents, entry.to);
        entry.from = isKnown && passed <= 4.0 * kSeconds ? entry.shown : entry.to; // after a jump, at once
        entry.shown = entry.from;
        entry.seconds = seconds;
        entry.frame = frame_;
        return &entry.shown;
    }
    Entry& entry = known->second;
    entry.frame = frame_;
    if (content.isAnimated)
        for (size_t i = 0; i < entry.shown.size(); ++i)
            entry.shown[i] = mixed(entry.from[i], entry.to[i], float(passed / kSeconds));
    return &entry.shown;
}

void BlockErrors::predict(uint32_t variant, const BlockContents& contents, TileErrors& out)
{
    const BlockContent& content = contents.of(variant);
    balls_.clear();
    contents.balls(variant, balls_);
    work_ += balls_.size();
    out = predictTileErrors(balls_, content.radius, content.isColored);
}

} // namespace fx::render
