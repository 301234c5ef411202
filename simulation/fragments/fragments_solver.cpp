#include "simulation/fragments/fragments_solver.h"

#include "foundation/math/elementary.h"
#include "foundation/random/philox.h"
#include "foundation/tasks/parallel_rows.h"
#include "simulation/emitters/births/birth_schedule.h"
#include "simulation/emitters/births/birth_shape.h"
#include "simulation/fragments/fragment_flight.h"
#include "simulation/fragments/fragment_sizes.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>

namespace fx::sim {

namespace {

namespace column = fragment_column;
using base::RandomPurpose;

constexpr uint32_t kMinFlights = 128; // fragments; fewer cost less than handing them to another thread
constexpr uint32_t kMinBlobs = 256;

base::Ticks boundedTicks(float seconds)
{
    return seconds > 0.0f ? base::toTicks(std::min(double(seconds), 1e6)) : 0;
}

/// Directions are drawn as an emitter draws them.
EmitterSettings directionsOf(const FragmentsDef& def)
{
    constexpr float kHalfTurn = std::numbers::pi_v<float>;
    EmitterSettings directions;
    directions.shape = EmitterShape::Cone;
    directions.angle = kHalfTurn;
    if (def.shape == FragmentShape::Hemisphere)
        directions.angle = 0.5f * kHalfTurn;
    if (def.shape == FragmentShape::Cone)
        directions.angle = def.angle;
    return directions;
}

/// A place in the ball, and the direction from its center.
BirthPlace drawPlace(const FragmentsDef& def, const EmitterSettings& directions, const StepContext& s,
                     uint32_t number)
{
    const auto place = base::randomUnit4(s.seed, s.solverIndex, number, RandomPurpose::Position);
    const auto heading = base::randomUnit4(s.seed, s.solverIndex, number, RandomPurpose::Direction);
    BirthPlace drawn = sampleBirth(directions, place, heading);
    drawn.position =
        def.position + def.originRadius * float(base::cubeRoot(double(place[2]))) * drawn.direction;
    return drawn;
}

void createFragment(const FragmentsDef& def, const EmitterSettings& directions, const StepContext& s,
                    base::Ticks start, FragmentStore& store, uint32_t i)
{
    const BirthPlace drawn = drawPlace(def, directions, s, i);
    const auto draws = base::randomUnit4(s.seed, s.solverIndex, i, RandomPurpose::Attributes);
    const auto life = base::randomUnit4(s.seed, s.solverIndex, i, RandomPurpose::Life);
    const float speed = def.speed.at(draws[1]);
    store.number[i] = i;
    store.trailed[i] = 0;
    store.dies[i] = start + std::max(boundedTicks(def.lifetime.at(life[0])), base::Ticks(1));
    store.at(column::X)[i] = drawn.position.x;
    store.at(column::Y)[i] = drawn.position.y;
    store.at(column::Z)[i] = drawn.position.z;
    store.at(column::VelocityX)[i] = speed * drawn.direction.x;
    store.at(column::VelocityY)[i] = speed * drawn.direction.y;
    store.at(column::VelocityZ)[i] = speed * drawn.direction.z;
    store.at(column::Size)[i] = fragmentSize(def, draws[0]);
    store.at(column::Temperature)[i] = def.temperature.at(draws[2]);
    store.at(column::Hottest)[i] = store.at(column::Temperature)[i];
    store.at(column::Due)[i] = def.trail.spacing * life[1];
}

/// The end of a step of flight, with what the ground and the host's geometry do to it.
MotionState bounceFragment(const StepContext& s, const FragmentMatter& matter, float size,
                           const MotionState& from, const MotionState& to, float seconds)
{
    const float restitution = std::min(matter.bounce, 1.0f);
    MotionState state =
        bounce(from, to, seconds, {s.groundHeight + 0.5f * size, restitution, matter.friction});
    if (s.collider)
        s.collider->bounce(from.position, state.position, state.velocity,
                           {0.5f * size, restitution, matter.friction}, seconds);
    return state;
}

/// Flight, ground and cooling of one fragment; what it leaves behind is only counted.
FragmentWay flyFragment(const TrailStep& s, FragmentStore& store, uint32_t i, float seconds)
{
    const FragmentMatter& matter = s.def.matter;
    const float size = store.at(column::Size)[i];
    FragmentWay way{};
    way.from = {
        {store.at(column::X)[i], store.at(column::Y)[i], store.at(column::Z)[i]},
        {store.at(column::VelocityX)[i], store.at(column::VelocityY)[i], store.at(column::VelocityZ)[i]}};
    way.to =
        flyStep(way.from, matter.gravity * s.step.gravity, s.step.wind, dragPerMeter(matter, size), seconds);
    way.to = bounceFragment(s.step, matter, size, way.from, way.to, seconds);
    store.at(column::X)[i] = way.to.position.x;
    store.at(column::Y)[i] = way.to.position.y;
    store.at(column::Z)[i] = way.to.position.z;
    store.at(column::VelocityX)[i] = way.to.velocity.x;
    store.at(column::VelocityY)[i] = way.to.velocity.y;
    store.at(column::VelocityZ)[i] = way.to.velocity.z;

    const glm::vec3 relative = 0.5f * (way.from.velocity + way.to.velocity) - s.step.wind;
    const float speed =
        std::sqrt(relative.x * relative.x + relative.y * relative.y + relative.z * relative.z);
    float& temperature = store.at(column::Temperature)[i];
    temperature = coolStep(temperature, coolingRates(matter, size, speed), seconds);

    const glm::vec3 chord = way.to.position - way.from.position;
    way.length = std::max(std::sqrt(chord.x * chord.x + chord.y * chord.y + chord.z * chord.z),
                          s.def.trail.idle * seconds);
    way.due = store.at(column::Due)[i];
    if (temperature > s.def.trail.coldest)
        way.blobs = blobsAlong(way.length, way.due, s.def.trail.spacing);
    const float left = way.due + float(way.blobs) * s.def.trail.spacing - way.length;
    store.at(column::Due)[i] = std::max(left, 0.0f);
    return way;
}

} // namespace

std::unique_ptr<Solver> FragmentsDef::create(const base::SnapshotSchema& schema, const Quality&,
                                             std::pmr::memory_resource* memory) const
{
    return std::make_unique<FragmentsSolver>(*this, schema.find(base::kBlobKind.name), memory);
}

FragmentsSolver::FragmentsSolver(const FragmentsDef& def, base::KindId kind,
                                 std::pmr::memory_resource* memory)
    : def_(def), kind_(kind), start_(boundedTicks(def.start)), fragments_(memory, def.count),
      trail_(memory, def.capacity() - def.count, def.count), ways_(memory, def.count)
{}

uint64_t FragmentsDef::bytes() const
{
    return uint64_t(count) * (FragmentStore::kRowBytes + sizeof(FragmentWay)) +
           TrailStore::bytesOf(capacity() - count, count);
}

/// All that there is room for moves and is shown; of the smoke, what dies is left anew.
double FragmentsDef::workOf(const StepLoad& load) const
{
    const double left = std::min(load.seconds / std::max(double(trail.lifetime.min), 1e-3), 1.0);
    return (fragment_work::kMoved + fragment_work::kBirth * left + fragment_work::kShown) *
           double(capacity());
}

bool FragmentsSolver::proceed(const StepContext& context, base::WorkBudget& work)
{
    const TrailStep step(def_, context);
    if (open_.tick != context.tick) {
        open_ = {};
        open_.tick = context.tick;
    }
    const base::Ticks begin = std::max(context.tick, start_);
    if (!open_.hasFlown) {
        if (!moveAll(step, work))
            return false;
        trail_.removeDead(step.end);
        if (!released_ && start_ < step.end)
            release(context);
        fly(step, begin);
        work.spend(uint64_t(fragment_work::kMoved * double(fragments_.count)));
    }
    if (!leaveAll(step, begin, work))
        return false;
    for (uint32_t i = 0; i < fragments_.count; ++i)
        fragments_.trailed[i] += ways_[i].blobs;
    fragments_.removeDead(step.end);
    trail_.removeDead(step.end);
    trail_.sort();
    now_ = step.end;
    open_.tick = -1;
    return true;
}

/// The smoke that was there before. @return whether all of it has moved
bool FragmentsSolver::moveAll(const TrailStep& step, base::WorkBudget& work)
{
    const uint32_t first = open_.row, left = trail_.count - first;
    const uint32_t rows = work.affords(fragment_work::kMoved, left);
    parallelRows(*step.step.tasks, rows, kMinBlobs,
                 [&](uint32_t begin, uint32_t end) { moveSmoke(step, trail_, first + begin, first + end); });
    step.step.counters->particleSteps += rows;
    work.spend(uint64_t(fragment_work::kMoved * double(rows)));
    open_.row += rows;
    return rows == left;
}

/// The smoke that is left in the step. @return whether all of it is there
bool FragmentsSolver::leaveAll(const TrailStep& step, base::Ticks begin, base::WorkBudget& work)
{
    const uint32_t first = open_.row, left = trail_.count - first;
    const uint32_t rows = work.affords(fragment_work::kBirth, left);
    parallelRows(*step.step.tasks, rows, kMinBlobs,
                 [&](uint32_t from, uint32_t to) { leaveRows(step, begin, first + from, first + to); });
    work.spend(uint64_t(fragment_work::kBirth * double(rows)));
    open_.row += rows;
    return rows == left;
}

/// Rows of smoke that follow each other, whichever fragments leave them.
void FragmentsSolver::leaveRows(const TrailStep& step, base::Ticks begin, uint32_t first, uint32_t last)
{
    const std::span<const FragmentWay> ways = ways_.first(fragments_.count);
    const auto after = std::upper_bound(ways.begin(), ways.end(), first,
                                        [](uint32_t row, const FragmentWay& way) { return row < way.first; });
    for (uint32_t i = uint32_t(after - ways.begin()) - 1; i < fragments_.count && first < last; ++i) {
        const uint32_t end = std::min(ways[i].first + ways[i].stored, last);
        emitSmoke(step, fragments_, i, ways[i], begin, {first, end}, trail_);
        first = std::max(first, end);
    }
}

void FragmentsSolver::release(const StepContext& context)
{
    released_ = true;
    const InstanceParameters& parameters = *context.parameters;
    if (!parameters.emitting || !(parameters.intensity > 0.0f))
        return;
    const double wanted = std::min(double(def_.count) * double(parameters.intensity) + 0.5, 4294967295.0);
    fragments_.count = std::min(uint32_t(wanted), def_.count);
    context.counters->born += uint64_t(wanted);
    context.counters->dropped += uint64_t(wanted) - fragments_.count;
    const EmitterSettings directions = directionsOf(def_);
    parallelRows(*context.tasks, fragments_.count, kMinFlights, [&](uint32_t first, uint32_t last) {
        for (uint32_t i = first; i < last; ++i)
            createFragment(def_, directions, context, start_, fragments_, i);
    });
}

void FragmentsSolver::fly(const TrailStep& step, base::Ticks begin)
{
    const float seconds = float(base::toSeconds(step.end - begin));
    parallelRows(*step.step.tasks, fragments_.count, kMinFlights, [&](uint32_t first, uint32_t last) {
        for (uint32_t i = first; i < last; ++i)
            ways_[i] = flyFragment(step, fragments_, i, seconds);
    });
    step.step.counters->particleSteps += fragments_.count;
    open_.row = trail_.count;
    makeRoom(step.step);
    open_.hasFlown = true;
}

/// Gives each fragment the rows of the smoke that it leaves.
void FragmentsSolver::makeRoom(const StepContext& context)
{
    const std::span<FragmentWay> ways = ways_.first(fragments_.count);
    uint64_t wanted = trail_.count;
    for (const FragmentWay& way : ways)
        wanted += way.blobs;
    try {
        trail_.reserve(size_t(std::min<uint64_t>(wanted, trail_.capacity())));
    } catch (const std::bad_alloc&) { // what there is no memory for counts as dropped
    }
    uint32_t room = uint32_t(trail_.held()) - trail_.count;
    for (FragmentWay& way : ways) {
        way.first = trail_.count;
        way.stored = std::min(way.blobs, room);
        trail_.count += way.stored;
        room -= way.stored;
        context.counters->born += way.blobs;
        context.counters->dropped += way.blobs - way.stored;
    }
}

bool FragmentsSolver::finished(base::Ticks) const
{
    return released_ && fragments_.count == 0 && trail_.count == 0;
}

void FragmentsSolver::save(StateWriter& writer) const
{
    writer.value(now_);
    writer.flag(released_);
    fragments_.save(writer);
    trail_.save(writer);
}

void FragmentsSolver::restore(StateReader& reader)
{
    open_ = {};
    now_ = reader.value<base::Ticks>(0, kForever, "the clock of fragments is out of range");
    released_ = reader.flag();
    fragments_.restore(reader);
    trail_.restore(reader, now_);
}

} // namespace fx::sim
