#include "simulation/blocks/blocks_def.h"

#include "foundation/math/hash.h"
#include "simulation/blocks/blocks_solver.h"
#include "simulation/emitters/emitter_detail.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace fx::sim {

namespace {

constexpr double kWrittenBall = 0.25; ///< [unit of base::WorkBudget] work of a ball of an animated type
constexpr double kWrittenBlock = 0.5; ///< [unit of base::WorkBudget] work of a block
constexpr uint64_t kBallBytes = base::blob_column::Count * sizeof(float) + sizeof(uint64_t);
constexpr uint64_t kBlockBytes = base::block_column::Count * sizeof(float) + sizeof(uint64_t);
constexpr uint64_t kMaterialBytes = base::material_column::Count * sizeof(float) + sizeof(uint64_t);
constexpr uint64_t kSnapshots = 3;

uint64_t hashPlacements(uint64_t hash, const std::vector<BlockPlacement>& blocks)
{
    static_assert(sizeof(BlockPlacement) == 11 * 4); // no padding, whose bytes are not defined
    return base::hashBytes(hash, blocks.data(), blocks.size() * sizeof(BlockPlacement));
}

} // namespace

std::unique_ptr<Solver> BlocksDef::create(const base::SnapshotSchema& schema, const Quality& quality,
                                          std::pmr::memory_resource* memory) const
{
    return std::make_unique<BlocksSolver>(*this, schema, quality, memory);
}

uint64_t BlocksDef::expandedCount() const
{
    uint64_t count = 0;
    for (const BlockPlacement& block : blocks)
        count += types[block.type].ballCount;
    uint64_t most = 0;
    for (const uint32_t type : emitted)
        most = std::max(most, types[type].ballCount);
    return count + (emitter ? emitter->maxParticles * most : 0);
}

uint32_t BlocksDef::capacity() const
{
    return uint32_t(std::min<uint64_t>(expandedCount(), maxParticles));
}

bool BlocksDef::isAnimated() const
{
    return std::any_of(types.begin(), types.end(),
                       [](const BlockType& type) { return type.loop != nullptr; });
}

uint64_t BlocksDef::sharedBytes() const
{
    uint64_t bytes = blocks.size() * sizeof(BlockPlacement);
    for (const BlockType& type : types)
        bytes += type.balls.size() * sizeof(ListedBall) + type.blocks.size() * sizeof(BlockPlacement) +
                 (type.loop ? type.loop->bytes() : 0);
    return bytes;
}

/// Of the content of types and of the blocks in snapshots; the expansion counts as capacity().
uint64_t BlocksDef::bytes() const
{
    uint64_t content = 0;
    for (const BlockType& type : types)
        content +=
            type.hasBlocks() ? type.blocks.size() * kBlockBytes : type.phases * type.ballCount * kBallBytes;
    const uint64_t instances = blocks.size() + (emitter ? emitter->maxParticles : 0);
    if (detail.given)
        content += (instances + capacity()) * kMaterialBytes;
    return (emitter ? emitter->bytes() + emitter->maxParticles * kBallBytes : 0) +
           kSnapshots * (content + instances * kBlockBytes);
}

double BlocksDef::workOf(const StepLoad& load) const
{
    double work = kWrittenBlock * double(blocks.size());
    for (const BlockType& type : types)
        work += type.loop ? kWrittenBall * double(type.phases) * double(type.ballCount) : 0.0;
    if (emitter)
        work += emitter->workOf(load) + kWrittenBlock * load.alive;
    return work;
}

bool BlocksDef::publishes(const base::KindDesc& kind) const
{
    return kind == base::kBlobKind || kind == base::kBlockKind || kind == base::kBlockBallKind ||
           (detail.given && (kind == base::kBlockMaterialKind || kind == base::kMaterialKind));
}

float BlocksDef::reach(float gravity, float wind, float seconds) const
{
    if (emitter)
        return emitter->reach(gravity, wind, seconds);
    float farthest = 0.0f;
    for (const BlockPlacement& block : blocks)
        farthest = std::max(farthest, glm::length(block.position) + block.scale * types[block.type].radius);
    return farthest * 1.0001f; // above rounding
}

float BlocksDef::ballRadius() const
{
    double sections = 0, radii = 0;
    const auto add = [&](const BlockType& type, float scale, float factor) {
        const double section = double(factor * scale * scale) * double(type.crossSection);
        sections += section;
        radii += section * double(scale * type.ballRadius);
    };
    for (const BlockPlacement& block : blocks)
        add(types[block.type], block.scale, block.density);
    for (const uint32_t type : emitted)
        add(types[type], meanRadiusOf(*emitter) / std::max(types[type].radius, 1e-6f), 1.0f);
    return sections > 0.0 ? std::max(float(radii / sections), 1e-6f) : 1.0f;
}

uint64_t BlocksDef::hash() const
{
    uint64_t hash = hashPlacements(types.size(), blocks);
    for (const BlockType& type : types) {
        static_assert(sizeof(ListedBall) == 12 * 4); // no padding
        hash = base::hashBytes(hash, type.balls.data(), type.balls.size() * sizeof(ListedBall));
        hash = hashPlacements(base::hashWord(hash, type.phases), type.blocks);
        if (type.loop)
            hash = base::hashWord(hash, type.loop->hash());
    }
    return hash;
}

} // namespace fx::sim
