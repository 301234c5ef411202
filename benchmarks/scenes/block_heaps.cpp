#include "benchmarks/scenes/block_heaps.h"

#include "benchmarks/scenes/chance.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace fx::cli {

namespace {

struct Placement
{
    glm::dvec3 position{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    double scale = 1.0, density = 1.0;
};

void addBalls(const sim::BlocksDef& def, const sim::BlockPlacement& block, const Placement& outer,
              std::vector<render::MediumBlob>& out)
{
    const Placement inner{outer.position + outer.rotation * (outer.scale * glm::dvec3(block.position)),
                          outer.rotation * glm::dquat(block.rotation), outer.scale * double(block.scale),
                          outer.density * double(block.density)};
    const sim::BlockType& type = def.types[block.type];
    for (const sim::ListedBall& ball : type.balls) {
        render::MediumBlob blob;
        blob.center = inner.position + inner.rotation * (inner.scale * glm::dvec3(ball.center));
        blob.radius = inner.scale * double(ball.radius);
        blob.crossSection = inner.density * inner.scale * inner.scale * double(ball.crossSection);
        blob.source = glm::dvec3(ball.emission);
        blob.albedo = glm::dvec3(ball.albedo);
        out.push_back(blob);
    }
    for (const sim::BlockPlacement& part : type.blocks)
        addBalls(def, part, inner, out);
}

} // namespace

sim::BlockType heapOf(const HeapOfBalls& heap, float brightest)
{
    bench::Chance chance(heap.seed);
    sim::BlockType type;
    type.name = "heap";
    for (uint32_t i = 0; i < heap.balls; ++i) {
        sim::ListedBall ball;
        const double radius = chance.between(heap.smallest, heap.largest);
        ball.radius = float(radius);
        const double place = std::cbrt(chance()); // [1] on the way from the center to the rim of the heap
        ball.center = glm::vec3(chance.direction() * (1.0 - radius) * place);
        // Together, balls have the depth on the disk of radius 1.
        ball.crossSection = float(heap.depth * std::numbers::pi / double(heap.balls));
        glm::dvec3 color;
        for (const int channel : {2, 1, 0}) // the order of the heaps that the documents measure
            color[channel] = chance.between(0.2, 1.0);
        ball.emission = brightest * (heap.isColored ? glm::vec3(color) : glm::vec3(1.0f, 0.7f, 0.4f));
        type.balls.push_back(ball);
    }
    return type;
}

glm::quat anyTurn(uint64_t seed, uint64_t index)
{
    return sim::turnOf(sim::BlockTurn::Free, seed, index);
}

std::vector<render::MediumBlob> ballsOf(const sim::BlocksDef& blocks)
{
    std::vector<render::MediumBlob> balls;
    for (const sim::BlockPlacement& block : blocks.blocks)
        addBalls(blocks, block, {}, balls);
    return balls;
}

} // namespace fx::cli
