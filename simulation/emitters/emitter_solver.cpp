#include "simulation/emitters/emitter_solver.h"

#include "foundation/random/philox.h"
#include "simulation/parallel.h"

namespace fx::sim {

namespace {
constexpr uint32_t kMinBatch = 512; // particles; fewer cost less than handing them to another thread
}

std::unique_ptr<Solver> EmitterDef::create(const base::SnapshotSchema& schema, const Quality&,
                                           std::pmr::memory_resource* memory) const
{
    return std::make_unique<EmitterSolver>(*this, schema.find(base::kBlobKind.name), memory);
}

EmitterSolver::EmitterSolver(const EmitterDef& def, base::KindId kind, std::pmr::memory_resource* memory)
    : def_(def), kind_(kind), schedule_(def.emission, memory), store_(memory, def.maxParticles)
{}

void EmitterSolver::step(const StepContext& context)
{
    if (!started_) {
        schedule_.setPhase(
            base::randomUnit4(context.seed, context.solverIndex, 0, base::RandomPurpose::BirthPhase)[0]);
        started_ = true;
    }
    // Scratch is sized by the capacity, so that after the first step the arena never grows.
    const size_t capacity = store_.capacity();
    const EmitterScratch scratch{context.scratch->allocate<glm::vec3>(capacity),
                                 context.scratch->allocate<float>(capacity)};
    const std::span<uint32_t> kept = context.scratch->allocate<uint32_t>(capacity);
    const std::span<Birth> births = context.scratch->allocate<Birth>(capacity);

    const EmitterStep step(def_, context);
    move(step, scratch, 0, store_.count);
    store_.removeDead(0, step.end, kept);
    const uint32_t firstBorn = store_.count;
    giveBirth(step, births.first(capacity - firstBorn));
    move(step, scratch, firstBorn, store_.count);
    store_.removeDead(firstBorn, step.end, kept);
    now_ = step.end;
}

void EmitterSolver::giveBirth(const EmitterStep& step, std::span<Birth> births)
{
    const StepContext& context = step.step;
    const uint32_t first = store_.count;
    const BirthWindow window{context.tick, step.end, double(context.parameters->intensity),
                             context.parameters->emitting};
    const BirthCount count = schedule_.advance(window, births);
    context.counters->born += count.total;
    context.counters->dropped += count.total - count.stored;
    for (uint32_t i = 0; i < count.stored; ++i) {
        store_.index[first + i] = births[i].index;
        store_.born[first + i] = births[i].tick;
    }
    parallelRows(*context.tasks, count.stored, kMinBatch, [&](uint32_t begin, uint32_t end) {
        createParticles(step, store_, first + begin, first + end);
    });
    store_.count = first + count.stored;
}

void EmitterSolver::move(const EmitterStep& step, const EmitterScratch& scratch, uint32_t begin, uint32_t end)
{
    parallelRows(*step.step.tasks, end - begin, kMinBatch, [&](uint32_t first, uint32_t last) {
        moveParticles(step, store_, scratch, begin + first, begin + last);
    });
    step.step.counters->particleSteps += end - begin;
}

bool EmitterSolver::finished(base::Ticks tick) const
{
    return store_.count == 0 && schedule_.exhausted(tick);
}

void EmitterSolver::save(StateWriter& writer) const
{
    writer.value(now_);
    writer.flag(started_);
    schedule_.save(writer);
    store_.save(writer);
}

void EmitterSolver::restore(StateReader& reader)
{
    now_ = reader.value<base::Ticks>(0, kForever, "an emitter's clock is out of range");
    started_ = reader.flag();
    schedule_.restore(reader);
    store_.restore(reader, now_);
}

} // namespace fx::sim
