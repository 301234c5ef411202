#include "simulation/blocks/block_type.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace fx::sim {

namespace {

using base::Code;
using base::Status;

constexpr float kRoundedUp = 1.0001f;

/// Mean radius of balls, by their cross section.
class MeanRadius
{
public:
    void add(float radius, float crossSection)
    {
        sections_ += double(crossSection);
        radii_ += double(crossSection) * double(radius);
    }
    void writeTo(BlockType& io) const
    {
        io.crossSection = float(sections_);
        io.ballRadius = sections_ > 0.0 ? float(radii_ / sections_) : 0.0f;
    }

private:
    double sections_ = 0, radii_ = 0;
};

void measureBalls(BlockType& io)
{
    MeanRadius mean;
    for (const ListedBall& ball : io.balls) {
        io.radius = std::max(io.radius, kRoundedUp * (glm::length(ball.center) + ball.radius));
        mean.add(ball.radius, ball.crossSection);
    }
    mean.writeTo(io);
    io.span = io.ballCount = io.balls.size();
}

void measureLoop(BlockType& io)
{
    io.radius = kRoundedUp * io.loop->radius();
    io.span = io.loop->span();
    io.ballCount = io.loop->maxBalls();
    io.ballRadius = io.loop->ballRadius();
    io.crossSection = io.loop->crossSection();
}

Status measureBlocks(std::span<const BlockType> before, BlockType& io)
{
    io.ids.clear();
    io.levels = 1;
    io.phases = 1;
    MeanRadius mean;
    for (const BlockPlacement& block : io.blocks) {
        if (block.type >= before.size())
            return {Code::InvalidArgument,
                    "\"" + io.name + "\" consists of blocks of a type that does not come before it"};
        const BlockType& inner = before[block.type];
        io.ids.push_back(io.span);
        io.span += inner.span;
        io.ballCount += inner.ballCount;
        io.blockCount += 1 + inner.blockCount;
        io.levels = std::max(io.levels, 1 + inner.levels);
        io.phases = std::max(io.phases, inner.phases);
        io.radius =
            std::max(io.radius, kRoundedUp * (glm::length(block.position) + block.scale * inner.radius));
        mean.add(block.scale * inner.ballRadius,
                 block.density * block.scale * block.scale * inner.crossSection);
    }
    mean.writeTo(io);
    if (io.levels > base::kMaxBlockLevels)
        return {Code::InvalidArgument, "\"" + io.name + "\" has " + std::to_string(io.levels) +
                                           " levels of blocks; allowed are " +
                                           std::to_string(base::kMaxBlockLevels) + "; use fewer levels"};
    return {};
}

} // namespace

Status completeTypes(std::span<BlockType> ioTypes)
{
    for (size_t i = 0; i < ioTypes.size(); ++i) {
        BlockType& type = ioTypes[i];
        type.radius = 0.0f;
        type.span = type.ballCount = type.blockCount = 0;
        if (type.loop)
            measureLoop(type);
        else if (!type.hasBlocks())
            measureBalls(type);
        else if (Status status = measureBlocks(ioTypes.first(i), type); !status)
            return status;
        if (type.span > kMaxBlockSpan)
            return {Code::TooLarge, "\"" + type.name + "\" has too many balls; use fewer blocks"};
        if (type.blockCount > kMaxInnerBlocks)
            return {Code::TooLarge, "\"" + type.name + "\" consists of " + std::to_string(type.blockCount) +
                                        " blocks; allowed are " + std::to_string(kMaxInnerBlocks) +
                                        "; use fewer blocks"};
    }
    return {};
}

} // namespace fx::sim
