// Steps of emitters whose particles cause births in others, or that others cause births in.
#include "simulation/emitters/emitter_solver.h"

#include "foundation/math/hash.h"
#include "foundation/random/philox.h"
#include "simulation/emitters/event_board.h"
#include "simulation/parallel.h"

#include <algorithm>

namespace fx::sim {

namespace {

constexpr uint32_t kBatch = 4096;               // births that are made at once
constexpr uint32_t kMinTiles = 4;               // fewer cost less than handing them to another thread
constexpr uint32_t kMostScheduled = 1u << 16;   // births by the clock in one step
constexpr uint32_t kMostBirthEvents = 1u << 16; // of particles that are born in one step

/// How many are born of one event, equal for any partition of time.
uint32_t drawCount(const StepContext& context, const EventRule& rule, uint32_t number,
                   const ParticleEvent& event)
{
    const uint32_t fewest = std::min(rule.fewest, rule.most);
    if (fewest == rule.most && rule.probability >= 1.0f)
        return fewest;
    uint64_t key = base::hashWord(event.index, uint64_t(event.tick));
    key = base::hashWord(key, uint64_t(number) << 8 | uint64_t(event.kind));
    const auto u = base::randomUnit4(context.seed, context.solverIndex, key, base::RandomPurpose::Events);
    if (!(u[0] < rule.probability))
        return 0;
    const uint32_t choices = rule.most - fewest + 1;
    return fewest + std::min(uint32_t(u[1] * float(choices)), choices - 1);
}

} // namespace

EventScan EmitterSolver::scanOf(const StepContext& context) const
{
    return {interest_,           store_,       lookJob(),
            context.solverIndex, context.tick, context.tick + context.stepTicks};
}

/// Those that lived before are looked at first: a birth may take the row of one that dies in this step.
void EmitterSolver::stepWithEvents(const StepContext& context)
{
    const RowWindow rows = store_.window();
    const bool asks = !def_.events.empty();
    EventRoom old(*context.scratch, asks ? rows.count : 0, interest_.mostOfOne());
    if (!program_.ballistic) {
        move(context, 0, asks ? &old : nullptr);
    } else if (asks) {
        const EventScan scan = scanOf(context);
        parallelRows(*context.tasks, uint32_t(old.lists().size()), kMinTiles,
                     [&](uint32_t begin, uint32_t end) {
                         for (uint32_t tile = begin; tile < end; ++tile)
                             scan.scanTile(tile * kTileRows, old.of(tile * kTileRows));
                     });
    }
    const uint64_t firstNew = store_.next();
    EventList births(context.scratch->allocate<ParticleEvent>(asks ? kMostBirthEvents : 0));
    giveLinkedBirth(context, births);
    EventRoom young(*context.scratch, asks && !program_.ballistic ? store_.window().count : 0,
                    interest_.mostOfOne());
    if (!program_.ballistic && store_.next() > firstNew)
        move(context, firstNew, asks ? &young : nullptr);
    if (!asks)
        return;
    hearHost(context, births);
    for (const EventList& list : young.lists())
        births.append(list);
    answerEvents(context, old.lists(), births);
}

std::span<Birth> EmitterSolver::scheduledBirths(const StepContext& context)
{
    const BirthWindow window{context.tick, context.tick + context.stepTicks,
                             double(context.parameters->intensity), context.parameters->emitting};
    if (schedule_.exhausted(context.tick))
        return {};
    const std::span<Birth> room = context.scratch->allocate<Birth>(kMostScheduled);
    const BirthCount count = schedule_.advance(window, room);
    context.counters->born += count.total;
    context.counters->dropped += count.total - count.stored;
    dropped_ += count.total - count.stored;
    return room.first(count.stored);
}

/// Births by the clock and by events, in the order of their ticks. At one tick, those that an event of it
/// caused come before those that the clock gives.
void EmitterSolver::giveLinkedBirth(const StepContext& context, EventList& out)
{
    const std::span<const Birth> scheduled = scheduledBirths(context);
    const EventRequests requests =
        context.board && def_.fed ? context.board->read(context.solverIndex) : EventRequests{};
    const uint64_t wanted = requests.asked;
    const size_t room = size_t(std::min<uint64_t>(wanted, std::max(store_.capacity(), kFewestFed)));
    const std::span<Birth> births = context.scratch->allocate<Birth>(scheduled.size() + room);
    const std::span<Origin> origins = context.scratch->allocate<Origin>(scheduled.size() + room);
    size_t count = 0, byClock = 0, fed = 0;
    const auto addClock = [&] {
        births[count] = {store_.next() + count, scheduled[byClock++].tick};
        origins[count++] = {};
    };
    for (const EventBirth& event : requests.births) {
        while (byClock < scheduled.size() &&
               (scheduled[byClock].tick < event.cause.tick ||
                (scheduled[byClock].tick == event.cause.tick && event.cause.scheduled)))
            addClock();
        for (uint32_t k = 0; k < event.count && fed < room; ++k, ++fed) {
            births[count] = {store_.next() + count, event.cause.tick};
            origins[count++] = {event.cause.position, event.cause.velocity, event.cause.color,
                                !event.cause.scheduled, false};
        }
    }
    while (byClock < scheduled.size())
        addClock();
    context.counters->born += wanted;
    context.counters->dropped += wanted - fed;
    dropped_ += wanted - fed;
    const size_t batch = std::min(kBatch, store_.capacity());
    for (size_t begin = 0; begin < count; begin += batch) {
        const size_t size = std::min(batch, count - begin);
        storeLinked(context, births.subspan(begin, size), origins.subspan(begin, size), out);
    }
    store_.advance(wanted - fed);
}

/// One batch, which has no row twice.
void EmitterSolver::storeLinked(const StepContext& context, std::span<const Birth> births,
                                std::span<const Origin> origins, EventList& out)
{
    storeBatch(context, births);
    for (size_t i = 0; i < births.size() && (def_.fed || space_); ++i) {
        const uint32_t row = store_.rowOf(births[i].index);
        if (store_.index[row] != births[i].index)
            continue;
        if (space_)
            carryBirth(context, births[i], row, origins[i].byClock);
        for (size_t a = 0; a < 3; ++a) {
            store_.values[stored::X + a][row] += origins[i].position[int(a)];
            store_.values[stored::VelocityX + a][row] += origins[i].velocity[int(a)];
            if (def_.tinted)
                store_.values[stored::TintRed + a][row] = origins[i].tint[int(a)];
        }
    }
    if (def_.events.empty())
        return;
    const EventScan scan = scanOf(context);
    for (size_t i = 0; i < births.size(); ++i)
        scan.scanBirth(births[i].index, origins[i].fed, !program_.ballistic, out);
}

void EmitterSolver::hearHost(const StepContext& context, EventList& out)
{
    for (const HostEvent& said : context.hostEvents)
        for (uint32_t k = 0; k < said.count; ++k) {
            ParticleEvent event{};
            event.tick = context.tick;
            event.index = hostEvents_++;
            event.emitter = context.solverIndex;
            event.kind = EventKind::Host;
            event.position = space_ ? space_->placed(def_.position) : def_.position;
            event.scheduled = true;
            event.number = said.event;
            out.add(event);
        }
}

/// Leaves on the board what the rules make of the events.
void EmitterSolver::answerEvents(const StepContext& context, std::span<const EventList> lists,
                                 const EventList& more)
{
    size_t count = more.events().size();
    uint64_t lost = more.dropped();
    for (const EventList& list : lists) {
        count += list.events().size();
        lost += list.dropped();
    }
    context.counters->dropped += lost;
    dropped_ += lost;
    context.counters->events += count * def_.events.size();
    if (!context.board)
        return;
    for (uint32_t number = 0; number < def_.events.size(); ++number) {
        const EventRule& rule = def_.events[number];
        const auto answer = [&](const ParticleEvent& event) {
            if (!interest_.answers(rule, event))
                return;
            EventBirth birth{event, number, drawCount(context, rule, number, event)};
            birth.cause.velocity *= rule.inheritVelocity;
            birth.cause.color = glm::vec3(1.0f) + rule.inheritColor * (event.color - glm::vec3(1.0f));
            context.board->post(rule.target, birth);
        };
        for (const EventList& list : lists)
            std::for_each(list.events().begin(), list.events().end(), answer);
        std::for_each(more.events().begin(), more.events().end(), answer);
    }
}

} // namespace fx::sim
