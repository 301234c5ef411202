#include "simulation/emitters/events/event_scan.h"

#include "simulation/particles/birth.h"
#include "simulation/particles/event_record.h"

#include <new>

namespace fx::sim {

namespace {

constexpr uint32_t kMaxEvents = 1u << 16; // of one emitter in one step, unless it has few tiles
constexpr uint32_t kMinTileEvents = 16;

bool livesThere(const RowWindow& rows, const ParticleStore& store, uint32_t row)
{
    return row < rows.count && (row < rows.gapBegin || row >= rows.gapEnd) && store.index[row] != kNoParticle;
}

ParticleEvent eventOf(base::Ticks tick, uint64_t index, uint32_t emitter, EventKind kind)
{
    ParticleEvent event{};
    event.tick = tick;
    event.index = index;
    event.emitter = emitter;
    event.kind = kind;
    return event;
}

} // namespace

glm::vec3 colorAt(const EmitterSettings& def, const ParticleStore& store, uint32_t row, base::Ticks tick)
{
    const float life = std::clamp(store.ageOf(row, tick) * store.value(stored::PerLife, row), 0.0f, 1.0f);
    const bool medium = def.appearance.kind == AppearanceKind::Medium;
    const auto color = (medium ? def.albedoOverLife : def.appearance.colorOverLife).at(life);
    glm::vec3 tinted;
    for (size_t a = 0; a < 3; ++a)
        tinted[int(a)] = color[a] * store.value(stored::TintRed + a, row);
    return tinted;
}

EventInterest::EventInterest(std::span<const EventRule> rules, base::Ticks longest)
{
    for (const EventRule& rule : rules) {
        kinds_[size_t(rule.on)] = true;
        colors_ = colors_ || rule.inheritColor != 0.0f;
        if (rule.on == EventKind::Collision) {
            leastSpeed_ = std::min(leastSpeed_, rule.minSpeed);
            leastLastSpeed_ = std::min(leastLastSpeed_, rule.minLastSpeed);
        }
        if (rule.on != EventKind::Age)
            continue;
        ages_.push_back(rule.age);
        for (base::Ticks age = rule.age + rule.every;
             rule.every > 0 && age < longest && ages_.size() < kMaxEventAges; age += rule.every)
            ages_.push_back(age);
    }
    std::stable_sort(ages_.begin(), ages_.end());
    ages_.erase(std::unique(ages_.begin(), ages_.end()), ages_.end());
}

bool EventInterest::answers(const EventRule& rule, const ParticleEvent& event) const
{
    if (rule.on != event.kind)
        return false;
    if (rule.on == EventKind::Age) {
        const base::Ticks beyond = ages_[event.number] - rule.age;
        return beyond == 0 || (rule.every > 0 && beyond > 0 && beyond % rule.every == 0);
    }
    if (rule.on == EventKind::Collision)
        return event.speed >= (event.isLast ? rule.minLastSpeed : rule.minSpeed);
    return rule.on != EventKind::Host || rule.hostEvent == event.number;
}

EventRoom::EventRoom(base::Arena& scratch, uint32_t rows, uint32_t mostOfOne)
    : lists_(scratch.allocate<EventList>((rows + kTileRows - 1) / kTileRows))
{
    const uint32_t tiles = std::max(uint32_t(lists_.size()), 1u);
    const uint32_t ofTile = std::clamp(kMaxEvents / tiles, kMinTileEvents, kTileRows * mostOfOne);
    for (EventList& list : lists_)
        new (&list) EventList(scratch.allocate<ParticleEvent>(ofTile));
}

/// Fills in place and velocity at `tick`, by (4).
void EventScan::addAt(uint32_t row, base::Ticks tick, ParticleEvent event, EventList& out) const
{
    AppearanceJob at = job;
    at.now = tick;
    MotionTile motion;
    const uint32_t first = row / kTilePadding * kTilePadding;
    readMotion(at, first, kTilePadding, motion);
    for (int a = 0; a < 3; ++a) {
        event.position[a] = motion.position[a][row - first];
        event.velocity[a] = motion.velocity[a][row - first];
    }
    if (interest.inColor())
        event.color = colorAt(job.program->def, store, row, tick);
    out.add(event);
}

void EventScan::scanAges(uint32_t row, base::Ticks from, EventList& out) const
{
    const base::Ticks born = store.born[row];
    const bool dies = !store.isAlive(row, end);
    const base::Ticks death = dies ? deathTick(store, row, from, end) : kForever;
    for (uint32_t k = interest.firstAfter(from - born); k < interest.ages().size(); ++k) {
        const base::Ticks tick = born + interest.ages()[k];
        if (tick > end || tick >= death) // (1)
            break;
        ParticleEvent event = eventOf(tick, store.index[row], emitter, EventKind::Age);
        event.number = k;
        addAt(row, tick, event, out);
    }
    if (dies && interest.in(EventKind::Death))
        addAt(row, death, eventOf(death, store.index[row], emitter, EventKind::Death), out);
}

void EventScan::scanTile(uint32_t row, EventList& out) const
{
    const bool wanted = interest.in(EventKind::Death) || interest.in(EventKind::Age);
    const RowWindow rows = store.window();
    const uint32_t last = std::min(row + kTileRows, rows.count);
    for (; wanted && row < last; ++row)
        if (livesThere(rows, store, row) && store.isAlive(row, begin))
            scanAges(row, begin, out);
}

void EventScan::scanBirth(uint64_t index, bool fed, bool birthOnly, EventList& out) const
{
    const uint32_t row = store.rowOf(index);
    const base::Ticks born = store.born[row];
    if (store.index[row] != index || !store.isAlive(row, born))
        return;
    if (interest.in(EventKind::Birth)) {
        ParticleEvent event = eventOf(born, index, emitter, EventKind::Birth);
        event.scheduled = !fed;
        addAt(row, born, event, out);
    }
    if (!birthOnly && born < end)
        scanAges(row, born, out);
}

void EventWatch::touch(const TileContext& context, const Tile& tile, uint32_t i, const TileContact& contact)
{
    if (!interest_.counts(contact))
        return;
    ParticleEvent event = collisionOf(context, tile, i, contact);
    const uint32_t row = tile.firstRow + i;
    if (!store_.isAlive(row, event.tick))
        return;
    if (interest_.inColor())
        event.color = colorAt(def_, store_, row, event.tick);
    room_.of(tile.firstRow).add(event);
}

void EventWatch::see(const TileContext& context, const Tile& tile, const ParticleStore& store)
{
    EventList& out = room_.of(tile.firstRow);
    for (uint32_t i = 0; i < tile.count; ++i) {
        const uint32_t flags = tile.flags[i];
        if ((flags & tile_flag::Empty) != 0)
            continue;
        const uint32_t row = tile.firstRow + i;
        const base::Ticks born = store.born[row];
        const base::Ticks from = std::max(born, context.step.tick);
        const bool dies = from < context.end && !store.isAlive(row, context.end);
        const base::Ticks death = dies ? deathTick(store, row, from, context.end) : kForever;
        ParticleEvent kill = (flags & tile_flag::Killed) != 0 ? killOf(context, tile, i) : ParticleEvent{};
        const bool killed = (flags & tile_flag::Killed) != 0 && kill.tick < death;
        const base::Ticks last = killed ? kill.tick : death;
        const auto add = [&](base::Ticks tick, EventKind kind, uint32_t number) {
            ParticleEvent event = eventOf(tick, store.index[row], context.step.solverIndex, kind);
            const float share = float(double(tick - from) / double(context.end - from)); // (4)
            const glm::vec3 begin(tile.fromX[i], tile.fromY[i], tile.fromZ[i]);
            event.position = begin + share * (glm::vec3(tile.x[i], tile.y[i], tile.z[i]) - begin);
            event.velocity = {tile.vx[i], tile.vy[i], tile.vz[i]};
            event.number = number;
            if (interest_.inColor())
                event.color = colorAt(def_, store, row, tick);
            out.add(event);
        };
        for (uint32_t k = interest_.firstAfter(from - born); k < interest_.ages().size(); ++k) {
            const base::Ticks tick = born + interest_.ages()[k];
            if (tick > context.end || tick >= last)
                break;
            add(tick, EventKind::Age, k);
        }
        if (killed && interest_.inColor())
            kill.color = colorAt(def_, store, row, kill.tick);
        if (killed && interest_.in(EventKind::Death))
            out.add(kill);
        else if (dies && !killed && interest_.in(EventKind::Death))
            add(death, EventKind::Death, 0);
    }
}

} // namespace fx::sim
