/// @file block_rays.cpp
/// IB-03 to IB-06: rays through impostors, looked up as shaders/blocks/ does it, from tiles that are computed
/// on the processor with the formulas that the shaders are compiled from.

#include "benchmarks/scenes/block_heaps.h"
#include "benchmarks/scenes/chance.h"
#include "benchmarks/scenes/slice_forms.h"
#include "benchmarks/stability/rows/block_walks.h"
#include "benchmarks/stability/rows/processor_tile.h"
#include "benchmarks/stability/stability_row.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

namespace fx::cli {
namespace {

render::TileAxes axesAlong(const glm::vec3& along)
{
    const glm::vec3 other = std::abs(along.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 right = glm::normalize(glm::cross(along, other));
    return {right, glm::cross(right, along), along};
}

double opacity(double depth)
{
    return -std::expm1(-depth);
}

/// One block of one heap.
sim::BlocksDef blockOf(const HeapOfBalls& heap)
{
    sim::BlocksDef def;
    def.types.push_back(heapOf(heap, 1.0f));
    def.blocks.emplace_back();
    (void)sim::completeTypes(def.types); // one short list is never refused
    return def;
}

/// A block of radius about 1 m, its balls, and the exact medium.
class Heap
{
public:
    explicit Heap(const HeapOfBalls& heap) : Heap(blockOf(heap)) {}
    explicit Heap(const sim::BlocksDef& def) : def_(def), effect_(def_), balls_(effect_.ballsOf(top()))
    {
        std::vector<render::MediumCaster> casters;
        for (const render::MediumBlob& ball : cli::ballsOf(def_))
            casters.push_back({glm::vec3(ball.center), float(ball.radius), float(ball.crossSection)});
        medium_.emplace(mediumOf(casters));
    }

    std::span<const render::BlockBall> balls() const { return balls_; }
    float radius() const { return effect_.content(top()).radius; }
    WalkedEffect& effect() { return effect_; }

    double exact(const BlockRay& ray, double t0, double t1) const
    {
        return medium_->opticalDepth({-glm::dvec3(ray.toCenter), glm::dvec3(ray.direction)}, t0, t1);
    }
    /// As many rays squared from a distance [m] to the disk across the block.
    std::vector<BlockRay> rays(const glm::vec3& along, double distance, int side) const
    {
        const render::TileAxes axes = axesAlong(along);
        std::vector<BlockRay> made;
        for (int i = 0; i < side * side; ++i) {
            const float x = (2.0f * float(i % side) + 1.0f) / float(side) - 1.0f;
            const float y = (2.0f * float(i / side) + 1.0f) / float(side) - 1.0f;
            if (x * x + y * y < 0.9f)
                made.push_back(
                    {glm::normalize(along * float(distance) + radius() * (x * axes.right + y * axes.up)),
                     along * float(distance), radius()});
        }
        return made;
    }

private:
    uint32_t top() const { return def_.blocks[0].type; }

    sim::BlocksDef def_;
    WalkedEffect effect_;
    std::pmr::vector<render::BlockBall> balls_;
    std::optional<render::BlobMedium> medium_;
};

glm::vec3 directionOf(uint64_t number)
{
    return anyTurn(17, number) * glm::vec3(0.0f, 0.0f, -1.0f);
}

/// The tile of the cell in which a direction lies, as a view chooses it. @param pixels [pixel] diameter
ProcessorTile tileFor(const Heap& heap, const glm::vec3& along, double pixels, double parallax, int size)
{
    const int cells = render::cellsForAngle(along, float(2.0 * parallax / pixels));
    return {heap.balls(), render::axesOfCell(render::directionCell(along, cells), cells), heap.radius(),
            size};
}

/// Opacities along rays as a view draws them: share of the impostor, and balls.
struct NearPicture
{
    std::vector<double> drawn, exact;
};

NearPicture nearPicture(Heap& heap, double distance, bool isHard)
{
    const glm::vec3 along(0.0f, 0.0f, -1.0f);
    const WalkedBlocks walked = heap.effect().walk({0.0, 0.0, -distance * double(heap.radius())}, 1e6f);
    double share = 0.0;
    for (const render::GatheredBlob& ball : walked.balls)
        share += ball.tile > 0 ? double(ball.crossSection) : 0.0;
    share /= double(heap.effect().content(0).crossSection);
    if (isHard)
        share = distance < 1.5 ? 0.0 : 1.0;
    const ProcessorTile tile = tileFor(heap, along, 128.0, 0.5, render::kMaxTile);
    NearPicture picture;
    // The same rays of the block from every distance, so that only the distance changes.
    for (const BlockRay& ray : heap.rays(along, distance * double(heap.radius()), 8)) {
        const double exact = heap.exact(ray, 0.0, 1e3);
        const double impostor = share > 0.0 ? tile.depth(ray, 0.0f, 1e3f) : 0.0;
        picture.exact.push_back(opacity(exact));
        picture.drawn.push_back(opacity(share * impostor + (1.0 - share) * exact));
    }
    return picture;
}

/// Change in a step of 0.01 radii beyond that of the balls, relative to the mean; infinite where there is an
/// impostor around the eye.
double stepError(double distance, double seed, bool isHard)
{
    Heap heap({.balls = 40, .depth = 2.0, .seed = uint64_t(seed)});
    const NearPicture a = nearPicture(heap, distance - 0.01, isHard), b = nearPicture(heap, distance, isHard);
    double change = 0.0, sum = 0.0;
    for (size_t i = 0; i < a.drawn.size(); ++i) {
        change += std::fabs((b.drawn[i] - a.drawn[i]) - (b.exact[i] - a.exact[i]));
        sum += b.exact[i];
    }
    return change / sum;
}

std::vector<StabilitySweep> nearEye(bool isQuick)
{
    const StabilitySweep sweep{"change in a step of 0.01 radii",
                               evenSteps("distance [radius]", 1.2, 2.2, isQuick ? 100 : 50, isQuick),
                               values("heap", {1, 2, 3}),
                               0.02,
                               false,
                               [](double distance, double seed) { return stepError(distance, seed, false); }};
    const StabilitySweep inside{"impostors nearer than 1.5 radii",
                                evenSteps("distance [radius]", 0.0, 1.5, 50, isQuick),
                                values("heap", {1, 2, 3}),
                                0.0,
                                false,
                                [](double distance, double seed) {
                                    Heap heap({.seed = uint64_t(seed)});
                                    const glm::dvec3 place(0.0, 0.0, -distance * double(heap.radius()));
                                    return double(heap.effect().walk(place, 1e6f).counts.impostors);
                                }};
    return {sweep, inside, controlOf(sweep, "switched at 1.5 radii", [](double distance, double seed) {
                return stepError(distance, seed, true);
            })};
}

/// Root mean square difference of opacity between the tile of a cell and one of the exact direction, both so
/// fine that texels have no part in it.
double refreshError(double pixels, double number, double parallax)
{
    const Heap heap({.balls = 40, .depth = 2.0, .seed = uint64_t(number) + 1});
    const glm::vec3 along = directionOf(uint64_t(number));
    const ProcessorTile kept = tileFor(heap, along, pixels, parallax, render::kMaxTile);
    const ProcessorTile fresh(heap.balls(), axesAlong(along), heap.radius(), kept.size());
    double squares = 0.0;
    const auto rays = heap.rays(along, 40.0, std::clamp(int(pixels), 8, 24));
    for (const BlockRay& ray : rays) {
        const double difference =
            opacity(kept.depth(ray, 0.0f, 1e3f)) - opacity(fresh.depth(ray, 0.0f, 1e3f));
        squares += difference * difference;
    }
    return std::sqrt(squares / double(rays.size()));
}

/// Root mean square error of the light of a block, white is 1, that a view draws as an impostor; 0 if it
/// draws balls. @param limit [1] of the predicted error; 0: none
double chosenError(double distance, double number, float limit)
{
    bench::Chance chance(300 + uint64_t(number));
    HeapOfBalls form;
    form.seed = uint64_t(number) + 1;
    form.balls = uint32_t(std::pow(100.0, chance()));
    form.smallest = chance.between(0.2, 0.4);
    form.largest = form.smallest + chance.between(0.0, 0.2);
    form.depth = 0.1 * std::pow(100.0, chance());
    const glm::vec3 along(0.0f, 0.0f, -1.0f);
    sim::BlocksDef def = blockOf(form);
    def.blocks[0].rotation = anyTurn(19, uint64_t(number));
    Heap heap(def);
    const double away = distance * double(heap.radius());
    const WalkedBlocks walked = heap.effect().walk({0.0, 0.0, -away}, 1e6f, {}, limit);
    if (walked.counts.impostors == 0)
        return 0.0;
    const render::BlockRecord& record = walked.records[0];
    const glm::quat back = glm::conjugate(def.blocks[0].rotation);
    const glm::vec3 right = back * glm::vec3(record.right), up = back * glm::vec3(record.up);
    const ProcessorTile tile(heap.balls(), {right, up, glm::cross(up, right)}, heap.radius(),
                             int(record.tile.x),
                             {.nearness = record.right.w - std::floor(record.right.w),
                              .isHalf = true,
                              .isForInterpolation = true,
                              .middle = std::floor(record.right.w) / 127.0f - 1.0f});
    double squares = 0.0;
    size_t covered = 0;
    for (const BlockRay& ray : heap.rays(along, away, 24)) {
        const double exact = opacity(heap.exact(ray, 0.0, 1e3));
        const BlockRay turned{back * ray.direction, back * ray.toCenter, ray.radius};
        const double difference = opacity(tile.depth(turned, 0.0f, 1e3f)) - exact;
        squares += exact < 0.01 ? 0.0 : difference * difference;
        covered += exact < 0.01 ? 0 : 1;
    }
    const glm::vec3 light = heap.effect().content(0).light; // at an exposure of 1 m2/cd
    const double white = std::sqrt(double(glm::dot(light, light)) / 3.0);
    return white * std::sqrt(squares / double(std::max<size_t>(covered, 1)));
}

/// Share of cases from `first` on that a view draws as balls: impostors are not exact by being refused.
double refusedShare(double distance, double first)
{
    constexpr int kCases = 20;
    double refused = 0.0;
    for (int i = 0; i < kCases; ++i)
        refused += chosenError(distance, first + double(i), 1.0f / 255.0f) > 0.0 ? 0.0 : 1.0;
    return refused / double(kCases);
}

std::vector<StabilitySweep> refresh(bool isQuick)
{
    const StabilitySweep large{
        "large blocks",
        values("pixels", {64, 80, 96}),
        evenSteps("case", 0, 40, 40, isQuick),
        1.0 / 255.0,
        false,
        [](double pixels, double number) { return refreshError(pixels, number, 0.5); }};
    // A shift by half a pixel is a larger part of a small block.
    StabilitySweep small = large;
    small.name = "small blocks, times pixels over 60";
    small.x = values("pixels", {6, 12, 24, 48});
    small.error = [](double pixels, double number) {
        return refreshError(pixels, number, 0.5) * pixels / 60.0;
    };
    const StabilitySweep chosen{
        "impostors that a view draws, against balls",
        values("distance [radius]", {3, 8, 20, 60}),
        evenSteps("case", 0, 60, 60, isQuick),
        1.0 / 255.0,
        false,
        [](double distance, double number) { return chosenError(distance, number, 1.0f / 255.0f); }};
    const StabilitySweep refused{"share of blocks that a view draws as balls",
                                 chosen.x,
                                 values("first case", {0, 20, 40}),
                                 0.5,
                                 false,
                                 refusedShare};
    return {large,
            small,
            chosen,
            refused,
            controlOf(large, "tiles kept up to 8 pixels",
                      [](double pixels, double number) { return refreshError(pixels, number, 8.0); }),
            controlOf(chosen, "error not limited",
                      [](double distance, double number) { return chosenError(distance, number, 0.0f); })};
}

/// A heap, and blocks of it. @param depth [1] of the whole, about
sim::BlocksDef nested(int levels, double depth)
{
    sim::BlocksDef def;
    def.types.push_back(heapOf({.balls = 20, .depth = depth}, 1.0f));
    for (int level = 1; level < levels; ++level) {
        sim::BlockType type;
        type.name = "level";
        for (int i = 0; i < 3; ++i) {
            sim::BlockPlacement part;
            part.position = 0.4f * directionOf(uint64_t(10 * level + i));
            part.rotation = anyTurn(uint64_t(level), uint64_t(i));
            part.scale = 0.6f;
            part.type = uint32_t(level - 1);
            type.blocks.push_back(part);
        }
        def.types.push_back(type);
    }
    def.blocks.emplace_back();
    def.blocks[0].type = uint32_t(levels - 1);
    (void)sim::completeTypes(def.types); // three levels are never refused
    return def;
}

enum class Texels
{
    Float,
    Half,
    AddedOpacities
};

/// Difference of opacity at the texels of a tile.
double nestedTileError(double levels, double depth, Texels texels)
{
    constexpr int kSide = render::kMaxTile, kEach = 6;
    const Heap heap(nested(int(levels), depth));
    const glm::vec3 along = directionOf(3);
    const render::TileAxes axes = axesAlong(along);
    const ProcessorTile tile(heap.balls(), axes, heap.radius(), kSide, {0.0f, texels == Texels::Half, false});
    double worst = 0.0;
    for (int y = 0; y < kSide; y += kEach)
        for (int x = 0; x < kSide; x += kEach) {
            const glm::vec2 p =
                (2.0f * glm::vec2(float(x), float(y)) / float(kSide - 1) - 1.0f) * heap.radius();
            // The eye is beside the axis, and the ray parallel to it.
            const BlockRay ray{axes.along, 4.0f * axes.along - p.x * axes.right - p.y * axes.up,
                               heap.radius()};
            const double exact = opacity(heap.exact(ray, 0.0, 1e3));
            double got = opacity(double(tile.texel(x, y)[kPlanes]));
            if (texels == Texels::AddedOpacities)
                got = double(tile.texel(x, y)[kPlanes]);
            worst = std::max(worst, std::fabs(got - exact));
        }
    return worst;
}

std::vector<StabilitySweep> hierarchyAndFlat(bool isQuick)
{
    const auto errorOf = [](Texels texels) {
        return [texels](double levels, double depth) { return nestedTileError(levels, depth, texels); };
    };
    const StabilitySweep sweep{"opacity at texels of the outermost block, float",
                               values("levels", {1, 2, 3, 4}),
                               powersOfTen("tau", -3, 2, 2, isQuick),
                               1e-4,
                               false,
                               errorOf(Texels::Float)};
    StabilitySweep stored = sweep;
    stored.name = "stored as half";
    stored.limit = 2e-4; // half a unit in the last place of 11 bits, times the largest tau exp(-tau)
    stored.error = errorOf(Texels::Half);
    return {sweep, stored, controlOf(sweep, "opacities of balls are added", errorOf(Texels::AddedOpacities))};
}

/// @param isCard the whole impostor stands in the plane through its center
double cutError(double place, double number, bool isCard, bool ofTheSum)
{
    const Heap heap({.balls = 40, .depth = 2.0, .seed = uint64_t(number) + 1});
    const glm::vec3 along = directionOf(uint64_t(number));
    const ProcessorTile tile = tileFor(heap, along, 96.0, 0.5, render::kMaxTile);
    const float cut = float(10.0 + place * double(heap.radius()));
    double squares = 0.0, worst = 0.0;
    const auto rays = heap.rays(along, 10.0, 12);
    for (const BlockRay& ray : rays) {
        const double whole = tile.depth(ray, 0.0f, 1e3f);
        const double front = isCard ? (cut > 10.0f ? whole : 0.0) : tile.depth(ray, 0.0f, cut);
        const double behind = isCard ? whole : tile.depth(ray, cut, 1e3f); // the card behind the plane again
        worst = std::max(worst, std::fabs(opacity(front + behind) - opacity(whole)));
        const double difference = opacity(front) - opacity(heap.exact(ray, 0.0, double(cut)));
        squares += difference * difference;
    }
    return ofTheSum ? worst : std::sqrt(squares / double(rays.size()));
}

std::vector<StabilitySweep> cutBySurface(bool isQuick)
{
    const StabilitySweep sum{
        "sum of the parts",
        evenSteps("place of the plane [radius]", -1.1, 1.1, 44, isQuick),
        values("heap", {1, 2, 3, 4}),
        1e-6,
        false,
        [](double place, double number) { return cutError(place, number, false, true); }};
    const StabilitySweep front{
        "what is in front, against balls", sum.x, sum.y, 0.05, false, [](double place, double number) {
            return cutError(place, number, false, false);
        }};
    return {sum, front, controlOf(front, "a card through the center", [](double place, double number) {
                return cutError(place, number, true, false);
            })};
}

} // namespace

StabilityRows blockRaysStability()
{
    return {
        {"IB-03", "the eye near a block", "balls by double arithmetic", nearEye},
        {"IB-04", "tiles of directions nearby", "tiles of the exact direction", refresh},
        {"IB-05", "blocks of blocks and all of their balls", "balls by double arithmetic", hierarchyAndFlat},
        {"IB-06", "a plane cuts a block", "balls by double arithmetic", cutBySurface},
    };
}

} // namespace fx::cli
