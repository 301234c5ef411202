#include "simulation/blocks/blocks_solver.h"

#include <algorithm>

namespace fx::sim {

namespace {

constexpr base::Ticks kAlways = INT64_MAX / 4; ///< later than any event

} // namespace

BlocksSolver::BlocksSolver(const BlocksDef& def, const base::SnapshotSchema& schema, const Quality& quality,
                           std::pmr::memory_resource* memory)
    : def_(def), kinds_{schema.find(base::kBlockKind.name), schema.find(base::kBlockBallKind.name),
                        schema.find(base::kBlobKind.name), schema.find(base::kBlockMaterialKind.name),
                        schema.find(base::kMaterialKind.name)},
      hash_(def.hash()), particles_(&schema, memory)
{
    for (const BlockType& type : def.types)
        stride_ = std::max(stride_, type.span);
    if (def.detail.given)
        generations_.radius[0] = generations_.radius[1] = generations_.radiusNow[0] =
            generations_.radiusNow[1] = def.ballRadius();
    if (def.emitter)
        emitter_ = def.emitter->create(schema, quality, memory);
}

void BlocksSolver::step(const StepContext& context)
{
    seed_ = context.seed;
    now_ = context.tick + context.stepTicks;
    if (emitter_)
        emitter_->step(context);
    else
        context.counters->particleSteps += def_.blocks.size();
}

uint32_t BlocksSolver::elementCount() const
{
    return emitter_ ? emitter_->elementCount() : uint32_t(def_.blocks.size());
}

void BlocksSolver::save(StateWriter& writer) const
{
    writer.value(hash_);
    writer.value(now_);
    writer.value(seed_);
    if (emitter_)
        emitter_->save(writer);
}

void BlocksSolver::restore(StateReader& reader)
{
    reader.require(reader.value<uint64_t>() == hash_, "the state belongs to other blocks");
    now_ = reader.value<base::Ticks>(0, kAlways, "the clock of blocks is out of range");
    seed_ = reader.value<uint64_t>();
    if (emitter_)
        emitter_->restore(reader);
}

bool BlocksSolver::canSeek(const StepContext& context, base::Ticks tick) const
{
    return !emitter_ || soughtEmitter()->canSeek(context, tick);
}

void BlocksSolver::seek(const StepContext& context, base::Ticks tick)
{
    seed_ = context.seed;
    now_ = tick;
    if (emitter_)
        soughtEmitter()->seek(context, tick);
}

base::Ticks BlocksSolver::restsUntil(base::Ticks tick) const
{
    if (emitter_)
        return soughtEmitter()->restsUntil(tick);
    return def_.isAnimated() ? tick : std::max(tick, kAlways);
}

void BlocksSolver::standAt(const base::Placement& placement)
{
    if (emitter_)
        soughtEmitter()->standAt(placement);
}

} // namespace fx::sim
