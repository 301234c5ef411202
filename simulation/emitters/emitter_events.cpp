// Steps of emitters whose particles cause births in others, or that others cause births in.
#include "simulation/emitters/emitter_solver.h"

#include "foundation/math/hash.h"
#include "foundation/random/philox.h"
#include "foundation/tasks/parallel_rows.h"
#include "simulation/emitters/events/cue_sink.h"
#include "simulation/emitters/events/event_board.h"

#include <algorithm>
#include <new>

namespace fx::sim {

namespace {

constexpr uint32_t kBatch = 4096;                  // births that are made at once
constexpr uint32_t kMinTiles = 4;                  // fewer cost less than handing them to another thread
constexpr uint32_t kMaxScheduledBirths = 1u << 16; // births by the clock in one step
constexpr uint32_t kMaxBirthEvents = 1u << 16;     // of particles that are born in one step

/// Consequence of an event by one rule.
struct Answer
{
    bool applies;
    uint32_t births;
};

/// Draws the consequence, which is equal for any partition of time.
Answer drawAnswer(const StepContext& context, const EventRule& rule, uint32_t number,
                  const ParticleEvent& event)
{
    const uint32_t fewest = std::min(rule.fewest, rule.most);
    if (fewest == rule.most && rule.probability >= 1.0f)
        return {true, fewest};
    uint64_t key = base::hashWord(event.index, uint64_t(event.tick));
    key = base::hashWord(key, uint64_t(number) << 8 | uint64_t(event.kind));
    const auto u = base::randomUnit4(context.seed, context.solverIndex, key, base::RandomPurpose::Events);
    if (!(u[0] < rule.probability))
        return {false, 0};
    const uint32_t choices = rule.most - fewest + 1;
    return {true, fewest + std::min(uint32_t(u[1] * float(choices)), choices - 1)};
}

} // namespace

/// What a step with events keeps in scratch memory.
struct EmitterSolver::Linked
{
    EventRoom old;       ///< events of particles born in earlier steps
    EventRoom young;     ///< events of particles born in this step
    EventList births;    ///< births, and then all that is new
    uint64_t firstNew;   ///< index of the first birth of the step
    uint32_t number = 0; ///< of the rule that is answered
    size_t answered = 0; ///< events of the list in hand
    bool isOpen = false; ///< births have begun
    // Births by the clock and by events, in the order of their ticks. At one tick, those that an event of it
    // caused come before those that the clock gives.
    std::span<const Birth> scheduled{};
    EventRequests requests{};
    uint64_t room = 0;    ///< births by events that are tried
    uint64_t fed = 0;     ///< those that have been
    size_t byClock = 0;   ///< births by the clock that have been
    size_t event = 0;     ///< of the requests
    uint32_t ofEvent = 0; ///< births that it has had
};

/// Whether the step that `context` is about is in hand, with the scratch memory that it keeps.
bool EmitterSolver::isOpen(const StepContext& context) const
{
    const bool isKept = !open_.linked || (context.board && context.board->number() == open_.board);
    return open_.tick == context.tick && isKept;
}

EventScan EmitterSolver::scanOf(const StepContext& context) const
{
    return {interest_,           store_,       appearanceJob(),
            context.solverIndex, context.tick, context.tick + context.stepTicks};
}

void EmitterSolver::openLinked(const StepContext& context)
{
    const bool asks = !def_.events.empty();
    Linked* const linked = context.scratch->allocate<Linked>(1).data();
    open_.board = context.board ? context.board->number() : 0;
    open_.linked = new (linked) Linked{
        EventRoom(*context.scratch, asks ? store_.window().count : 0, interest_.mostOfOne()),
        EventRoom(*context.scratch, 0, 1),
        EventList(context.scratch->allocate<ParticleEvent>(asks ? kMaxBirthEvents : 0)), store_.next()};
}

/// Those that lived before are looked at first: a birth may take the row of one that dies in this step.
/// @return whether the step is complete
bool EmitterSolver::stepWithEvents(const StepContext& context, base::WorkBudget& work)
{
    if (!open_.linked)
        openLinked(context);
    Linked& linked = *open_.linked;
    const bool asks = !def_.events.empty();
    const auto goTo = [this](StepPart part) {
        open_.part = part;
        open_.row = 0;
    };
    if (open_.part == StepPart::Old) {
        if (!(program_.ballistic ? scanOld(context, work)
                                 : move(context, work, 0, asks ? &linked.old : nullptr)))
            return false;
        goTo(StepPart::Births);
    }
    if (open_.part == StepPart::Births) {
        if (!giveLinkedBirth(context, work))
            return false;
        goTo(StepPart::Young);
        const uint32_t first = store_.rowOf(linked.firstNew);
        if (store_.next() - linked.firstNew < store_.capacity() && first < store_.rowOf(store_.next()))
            open_.row = first / kTileRows * kTileRows; // they are in no row before it
    }
    if (open_.part == StepPart::Young) {
        if (asks && !program_.ballistic && linked.young.lists().empty())
            linked.young = EventRoom(*context.scratch, store_.window().count, interest_.mostOfOne());
        const bool areMoved = program_.ballistic || store_.next() == linked.firstNew ||
                              move(context, work, linked.firstNew, asks ? &linked.young : nullptr);
        if (!areMoved)
            return false;
        if (asks)
            hearHost(context, linked.births);
        for (const EventList& list : linked.young.lists())
            linked.births.append(list);
        goTo(StepPart::Answer);
    }
    return !asks || answerEvents(context, work);
}

bool EmitterSolver::scanOld(const StepContext& context, base::WorkBudget& work)
{
    const std::span<const EventList> lists = open_.linked->old.lists();
    const uint32_t first = open_.row / kTileRows, left = uint32_t(lists.size()) - first;
    const uint32_t tiles = work.affords(stepWork_ * kTileRows, left);
    const EventScan scan = scanOf(context);
    parallelRows(*context.tasks, tiles, kMinTiles, [&](uint32_t begin, uint32_t end) {
        for (uint32_t tile = first + begin; tile < first + end; ++tile)
            scan.scanTile(tile * kTileRows, open_.linked->old.of(tile * kTileRows));
    });
    work.spend(uint64_t(stepWork_ * double(tiles) * kTileRows));
    open_.row += tiles * kTileRows;
    return tiles == left;
}

std::span<Birth> EmitterSolver::scheduledBirths(const StepContext& context)
{
    const BirthWindow window{context.tick, context.tick + context.stepTicks,
                             double(context.parameters->intensity), context.parameters->emitting};
    if (schedule_.exhausted(context.tick))
        return {};
    const std::span<Birth> room = context.scratch->allocate<Birth>(kMaxScheduledBirths);
    const BirthCount count = schedule_.advance(window, room);
    context.counters->born += count.total;
    context.counters->dropped += count.total - count.stored;
    dropped_ += count.total - count.stored;
    return room.first(count.stored);
}

/// @return whether all are born
bool EmitterSolver::giveLinkedBirth(const StepContext& context, base::WorkBudget& work)
{
    Linked& linked = *open_.linked;
    const bool isFed = context.board && def_.fed;
    if (isFed && !linked.isOpen && !context.board->order(context.solverIndex, work))
        return false;
    if (!linked.isOpen) {
        linked.scheduled = scheduledBirths(context);
        if (isFed)
            linked.requests = context.board->read(context.solverIndex);
        const uint64_t wanted = linked.requests.asked;
        linked.room = std::min<uint64_t>(wanted, std::max(store_.capacity(), kMinEventBirths));
        context.counters->born += wanted;
        linked.isOpen = true;
    }
    const size_t batch = std::min(kBatch, store_.capacity());
    const std::span<Birth> births = context.scratch->allocate<Birth>(batch);
    const std::span<Origin> origins = context.scratch->allocate<Origin>(batch);
    while (!work.isSpent()) {
        const size_t count = nextBatch(births, origins);
        if (count > 0)
            storeLinked(context, births.first(count), origins.first(count), linked.births);
        work.spend(uint64_t(emitter_work::kBirth * double(count)));
        if (count == batch)
            continue;
        const uint64_t lost = linked.requests.asked - linked.fed;
        context.counters->dropped += lost;
        dropped_ += lost;
        store_.advance(lost);
        return true;
    }
    return false;
}

/// The next births. @return how many; fewer than there is room for at the end
size_t EmitterSolver::nextBatch(std::span<Birth> births, std::span<Origin> origins)
{
    Linked& linked = *open_.linked;
    size_t count = 0;
    const auto addClock = [&] {
        births[count] = {store_.next() + count, linked.scheduled[linked.byClock++].tick};
        origins[count++] = {};
    };
    const auto clockIsBefore = [&](const ParticleEvent& cause) {
        const base::Ticks tick = linked.scheduled[linked.byClock].tick;
        return tick < cause.tick || (tick == cause.tick && cause.scheduled);
    };
    while (count < births.size() && linked.event < linked.requests.births.size()) {
        const EventBirth& event = linked.requests.births[linked.event];
        if (linked.ofEvent == 0 && linked.byClock < linked.scheduled.size() && clockIsBefore(event.cause)) {
            addClock();
        } else if (linked.ofEvent < event.count && linked.fed < linked.room) {
            births[count] = {store_.next() + count, event.cause.tick};
            origins[count++] = {event.cause.position, event.cause.velocity, event.cause.color,
                                !event.cause.scheduled, false};
            ++linked.ofEvent;
            ++linked.fed;
        } else {
            linked.ofEvent = 0;
            ++linked.event;
        }
    }
    while (count < births.size() && linked.event == linked.requests.births.size() &&
           linked.byClock < linked.scheduled.size())
        addClock();
    return count;
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

/// What the rules make of all events. @return whether all are answered
bool EmitterSolver::answerEvents(const StepContext& context, base::WorkBudget& work)
{
    Linked& linked = *open_.linked;
    const std::span<const EventList> lists = linked.old.lists();
    for (; linked.number < def_.events.size(); ++linked.number, open_.row = 0)
        for (; open_.row <= lists.size(); ++open_.row) {
            if (work.isSpent())
                return false;
            const EventList& list = open_.row < lists.size() ? lists[open_.row] : linked.births;
            answerList(context, list);
            work.spend(uint64_t(emitter_work::kEvent * double(list.events().size())));
            linked.answered = 0;
            if (linked.number > 0)
                continue;
            context.counters->dropped += list.dropped();
            dropped_ += list.dropped();
            if (context.cues)
                context.cues->lose(list.dropped());
        }
    return true;
}

/// Leaves on the board what the rule in hand makes of a list.
void EmitterSolver::answerList(const StepContext& context, const EventList& list)
{
    Linked& linked = *open_.linked;
    const EventRule& rule = def_.events[linked.number];
    for (; linked.answered < list.events().size(); ++linked.answered) {
        const ParticleEvent& event = list.events()[linked.answered];
        if (context.board && interest_.answers(rule, event)) {
            const Answer answer = drawAnswer(context, rule, linked.number, event);
            if (context.cues && answer.applies)
                context.cues->post(event, rule, linked.number, space_ ? &space_->home() : nullptr);
            EventBirth birth{event, linked.number, answer.births};
            birth.cause.velocity *= rule.inheritVelocity;
            birth.cause.color = glm::vec3(1.0f) + rule.inheritColor * (event.color - glm::vec3(1.0f));
            context.board->post(rule.target, birth);
        }
        ++context.counters->events;
    }
}

} // namespace fx::sim
