/// @file blocks.cpp
/// IB-01, IB-02 and IB-07 to IB-10: which blocks become impostors, balls or nothing, as a view decides it.

#include "benchmarks/scenes/block_heaps.h"
#include "benchmarks/stability/rows/block_walks.h"
#include "benchmarks/stability/stability_row.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <set>

namespace fx::cli {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

sim::BlocksDef heaps(uint32_t count, uint32_t balls = 12)
{
    sim::BlocksDef def;
    HeapOfBalls heap;
    heap.balls = balls;
    def.types.push_back(heapOf(heap, 1.0f));
    for (uint32_t i = 0; i < count; ++i) {
        sim::BlockPlacement block;
        block.rotation = anyTurn(3, i);
        def.blocks.push_back(block);
    }
    return def;
}

WalkedBlocks walked(sim::BlocksDef def, double pixels, float maxPixels = 128.0f)
{
    if (!sim::completeTypes(def.types).ok())
        return {};
    return WalkedEffect(def).walk({0.0, 0.0, -WalkedEffect::distanceOf(pixels)}, maxPixels);
}

/// Number of entries that differ.
template <class T>
double differing(const std::pmr::vector<T>& a, const std::pmr::vector<T>& b)
{
    size_t count = std::max(a.size(), b.size()) - std::min(a.size(), b.size());
    for (size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        count += std::memcmp(&a[i], &b[i], sizeof(float) * 4) == 0 ? 0 : 1; // what comes first has no gaps
    return double(count);
}

double difference(const WalkedBlocks& a, const WalkedBlocks& b)
{
    return differing(a.balls, b.balls) + differing(a.records, b.records) + differing(a.casters, b.casters) +
           std::fabs(double(a.newTiles) - double(b.newTiles));
}

std::vector<StabilitySweep> emptyBlocks(bool)
{
    enum Kind
    {
        NoDensity,
        NoSize,
        NoBalls
    };
    const auto withEmpty = [](double count, double kind) {
        sim::BlocksDef def = heaps(3);
        def.types.push_back({.name = "nothing", .balls = {}, .loop = {}, .blocks = {}, .ids = {}});
        sim::BlockPlacement empty = def.blocks[0];
        empty.density = int(kind) == NoDensity ? 0.0f : 1.0f;
        empty.scale = int(kind) == NoSize ? 0.0f : 1.0f;
        empty.type = int(kind) == NoBalls ? 1 : 0;
        def.blocks.insert(def.blocks.end(), size_t(count), empty);
        return def;
    };
    const StabilitySweep sweep{"list, tiles and shadows with and without them",
                               values("empty blocks", {0, 1, 10, 1000}),
                               values("no density, size, balls", {NoDensity, NoSize, NoBalls}),
                               0.0,
                               false,
                               [withEmpty](double count, double kind) {
                                   return difference(walked(withEmpty(count, kind), 40.0),
                                                     walked(heaps(3), 40.0));
                               }};
    return {sweep, controlOf(sweep, "one over the cross section of each", [](double count, double) {
                double broken = 0.0;
                for (int i = 0; i < int(count); ++i)
                    broken += std::isfinite(1.0 / (0.0 * double(i + 1))) ? 0.0 : 1.0;
                return broken;
            })};
}

/// Types of blocks, each of `count` blocks of the type before.
sim::BlocksDef nested(int levels, int count)
{
    sim::BlocksDef def = heaps(2, 5);
    for (int level = 1; level < levels; ++level) {
        sim::BlockType type;
        type.name = "level " + std::to_string(level);
        for (int i = 0; i < count; ++i) {
            sim::BlockPlacement part;
            part.position = {float(i) - 0.4f, 0.7f * float(i % 3), -0.3f * float(i)};
            part.rotation = anyTurn(uint64_t(level), uint64_t(i));
            part.scale = 0.6f + 0.1f * float(i);
            part.density = 1.3f;
            part.type = uint32_t(level - 1);
            type.blocks.push_back(part);
        }
        def.types.push_back(type);
    }
    for (sim::BlockPlacement& block : def.blocks)
        block.type = uint32_t(levels - 1);
    return def;
}

/// Largest difference of the balls that a view draws to those of double arithmetic, relative to the farthest.
double nestedError(int levels, int count, bool turnsInner)
{
    constexpr double kAway = 40.0; // [m] no ball is smaller than a pixel there
    sim::BlocksDef def = nested(levels, count);
    if (!sim::completeTypes(def.types).ok())
        return kInf;
    sim::BlocksDef exact = def;
    for (size_t k = 1; k < exact.types.size() && !turnsInner; ++k)
        for (sim::BlockPlacement& part : exact.types[k].blocks)
            part.rotation = {1.0f, 0.0f, 0.0f, 0.0f};
    const auto balls = ballsOf(exact);
    const WalkedBlocks drawn = WalkedEffect(def).walk({0.0, 0.0, -kAway}, 1e-3f);
    if (drawn.balls.size() != balls.size())
        return kInf;
    double extent = 0.0, error = 0.0;
    for (size_t i = 0; i < balls.size(); ++i) {
        const glm::dvec3 got = glm::dvec3(drawn.balls[i].center) + glm::dvec3(0.0, 0.0, kAway);
        extent = std::max(extent, glm::length(balls[i].center));
        error = std::max(error, glm::length(got - balls[i].center));
        error = std::max(error, std::fabs(double(drawn.balls[i].crossSection) / balls[i].crossSection - 1.0));
    }
    return error / std::max(extent, 1.0);
}

std::vector<StabilitySweep> depthOfNesting(bool)
{
    const StabilitySweep sweep{
        "places and cross sections of all balls",
        values("levels", {1, 2, 3, 4}),
        values("blocks in a block", {1, 2, 4}),
        1e-5,
        false,
        [](double levels, double count) { return nestedError(int(levels), int(count), true); }};
    const StabilitySweep refused{"levels that are refused",
                                 values("levels", {0, 5, 6, 8, 16, 32}),
                                 values("blocks in a block", {1, 2}),
                                 0.0,
                                 false,
                                 [](double levels, double count) {
                                     sim::BlocksDef def = nested(std::max(int(levels), 1), int(count));
                                     if (int(levels) == 0) // of a type that there is not
                                         def.types[0].blocks.push_back({.type = 7});
                                     return sim::completeTypes(def.types).ok() ? 1.0 : 0.0;
                                 }};
    return {sweep, refused, controlOf(sweep, "inner blocks are not turned", [](double levels, double count) {
                return nestedError(int(levels), int(count), false);
            })};
}

/// Cross section in the list, and in the shadow, relative to sums in double.
double sumError(double balls, double blocks)
{
    const sim::BlocksDef def = heaps(uint32_t(blocks), uint32_t(balls));
    double exact = 0.0, cast = 0.0;
    for (const sim::ListedBall& ball : def.types[0].balls)
        exact += blocks * double(ball.crossSection);
    const WalkedBlocks drawn = walked(def, 40.0);
    for (const render::MediumCaster& caster : drawn.casters)
        cast += double(caster.crossSection);
    return std::max(std::fabs(drawn.section() / exact - 1.0), std::fabs(cast / exact - 1.0));
}

std::vector<StabilitySweep> fewAndManyBalls(bool)
{
    const StabilitySweep sweep{"cross section of many blocks",
                               values("balls in a block", {1, 10, 100}),
                               values("blocks", {1, 10, 1000}),
                               1e-6,
                               false,
                               sumError};
    const StabilitySweep large{"cross section of one block",
                               values("balls in a block", {1000, 1e4, 6e4, 2e5, 1e6}),
                               values("blocks", {1}),
                               1e-6,
                               false,
                               sumError};
    return {sweep, large, controlOf(large, "loops of at most 65535 turns", [](double balls, double) {
                return 1.0 - std::min(65535.0 / balls, 1.0);
            })};
}

constexpr std::array kOdd = {std::numeric_limits<float>::quiet_NaN(),
                             std::numeric_limits<float>::infinity(),
                             -std::numeric_limits<float>::infinity(),
                             0.0f,
                             -1.0f,
                             1e-40f,
                             1e30f,
                             3e38f};

void setMember(int member, float value, sim::BlockType& ioType, sim::BlockPlacement& ioBlock)
{
    switch (member) {
    case 0:
        ioBlock.scale = value;
        break;
    case 1:
        ioBlock.density = value;
        break;
    case 2:
        ioBlock.position.y = value;
        break;
    case 3:
        ioBlock.rotation.x = value;
        break;
    case 4:
        ioType.balls[0].radius = value;
        break;
    default:
        ioType.balls[0].crossSection = value;
    }
}

std::vector<StabilitySweep> oddNumbers(bool)
{
    const StabilitySweep sweep{
        "numbers that are none",
        values("which number", {0, 1, 2, 3, 4, 5, 6, 7}),
        values("scale, density, place, turn, ball's radius, section", {0, 1, 2, 3, 4, 5}),
        0.0,
        false,
        [](double number, double member) {
            sim::BlocksDef def = heaps(3);
            const WalkedBlocks before = walked(def, 40.0);
            def.types.push_back(def.types[0]);
            def.blocks.push_back(def.blocks[0]);
            def.blocks.back().type = 1;
            setMember(int(member), kOdd[size_t(number)], def.types[1], def.blocks.back());
            const WalkedBlocks after = walked(def, 40.0);
            double lost = before.balls.size() <= after.balls.size() ? 0.0 : 1.0;
            for (size_t i = 0; i < before.balls.size() && lost == 0.0; ++i)
                lost += before.balls[i].center == after.balls[i].center ? 0.0 : 1.0;
            return lost + double(after.broken());
        }};
    return {sweep, controlOf(sweep, "products of whatever comes", [](double number, double) {
                const float value = kOdd[size_t(number)];
                return std::isfinite(value * value) && std::isfinite(1.0f / value) ? 0.0 : 1.0;
            })};
}

/// Share of the cross section that is missing in the list, and tiles that lie outside of the atlas.
double tilesError(double pixels, double blocks, bool leavesOut)
{
    sim::BlocksDef def = heaps(uint32_t(blocks), 4);
    double exact = 0.0;
    for (const render::MediumBlob& ball : ballsOf(def))
        exact += ball.crossSection;
    const WalkedBlocks drawn = walked(def, pixels, 1e6f);
    double section = 0.0, outside = 0.0;
    for (const render::GatheredBlob& ball : drawn.balls)
        section += ball.tile > 0 || !leavesOut ? double(ball.crossSection) : 0.0;
    for (const render::BlockRecord& record : drawn.records) {
        const float size = record.tile.x, x = record.tile.y, y = record.tile.z;
        const bool isInside = size >= float(render::kMinTile) && size <= float(render::kMaxTile) &&
                              x >= 0.0f && y >= 0.0f &&
                              x + size <= float(render::kTilePageColumns * render::kMaxTile) &&
                              y + size <= float(render::kMaxTilePageRows * render::kMaxTile);
        outside += isInside ? 0.0 : 1.0;
    }
    return std::fabs(section / exact - 1.0) + outside;
}

std::vector<StabilitySweep> roomForTiles(bool)
{
    const StabilitySweep sweep{
        "cross section that is missing, tiles outside of the atlas",
        values("pixels", {4, 8, 16, 17, 33, 64, 96, 128, 129, 500}),
        values("blocks", {1, 10, 100, 1000, 4000}),
        1e-5,
        false,
        [](double pixels, double blocks) { return tilesError(pixels, blocks, false); }};
    return {sweep, controlOf(sweep, "blocks without a tile are left out",
                             [](double pixels, double blocks) { return tilesError(pixels, blocks, true); })};
}

/// Tiles that are drawn again when effect and eye have moved together, and how far balls move by that.
double movedError(double distance, double step, bool isFloat)
{
    sim::BlocksDef def = heaps(8);
    (void)sim::completeTypes(def.types); // one short list is never refused
    WalkedEffect effect(def);
    const glm::dvec3 place(0.3, 0.2, -WalkedEffect::distanceOf(40.0));
    const auto relative = [&](double moved) {
        const glm::dvec3 eye(distance + moved, 0.0, distance);
        const glm::dvec3 there = eye + place;
        return isFloat ? glm::dvec3(glm::vec3(there) - glm::vec3(eye)) : there - eye;
    };
    const WalkedBlocks first = effect.walk(relative(0.0), 128.0f);
    const WalkedBlocks second = effect.walk(relative(step), 128.0f);
    if (first.balls.size() != second.balls.size())
        return kInf;
    double error = double(second.newTiles);
    for (size_t i = 0; i < first.balls.size(); ++i)
        error = std::max(error, double(glm::length(first.balls[i].center - second.balls[i].center) /
                                       glm::length(first.balls[i].center)));
    return error;
}

std::vector<StabilitySweep> movingEffect(bool isQuick)
{
    const StabilitySweep sweep{
        "tiles drawn again, and places",
        powersOfTen("distance from the origin [m]", 0, 7, 1, isQuick),
        powersOfTen("step of effect and eye [m]", -3, 5, 1, isQuick),
        1e-6,
        false,
        [](double distance, double step) { return movedError(distance, step, false); }};
    return {sweep, controlOf(sweep, "world positions in float",
                             [](double distance, double step) { return movedError(distance, step, true); })};
}

} // namespace

StabilityRows blocksStability()
{
    return {
        {"IB-01", "empty blocks add nothing", "the same without them", emptyBlocks},
        {"IB-02", "blocks in blocks", "placements composed in double", depthOfNesting},
        {"IB-07", "one ball in each of many blocks, very many in one", "sums in double", fewAndManyBalls},
        {"IB-08", "blocks and balls with any numbers", "finite numbers, other blocks unchanged", oddNumbers},
        {"IB-09", "tiles of any size, and more than there is room for", "sums in double", roomForTiles},
        {"IB-10", "effect and eye move together, anywhere in the world", "the place before", movingEffect},
    };
}

} // namespace fx::cli
