#include "simulation/ribbons/ribbon_store.h"

#include "foundation/math/half.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

constexpr double kSecondsPerTick = 1.0 / double(base::kTicksPerSecond);
constexpr base::Ticks kPast = base::kTicksPerSecond / 30; ///< for which points are kept after they have gone

/// Where the particle in `row` is at `tick`.
glm::vec3 placeOf(const AppearanceJob& job, uint32_t row, base::Ticks tick, glm::vec3* outVelocity = nullptr)
{
    AppearanceJob at = job;
    at.now = tick;
    MotionTile motion;
    const uint32_t first = row / kTilePadding * kTilePadding;
    readMotion(at, first, kTilePadding, motion);
    const uint32_t i = row - first;
    if (outVelocity)
        *outVelocity = {motion.velocity[0][i], motion.velocity[1][i], motion.velocity[2][i]};
    return {motion.position[0][i], motion.position[1][i], motion.position[2][i]};
}

float distance(const glm::vec3& a, const glm::vec3& b)
{
    const glm::vec3 d = b - a;
    return std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
}

} // namespace

RibbonStore::RibbonStore(const RibbonDef& def, uint32_t rows, std::pmr::memory_resource* memory)
    : def_(def), rows_(rows), lifetime_(std::max<base::Ticks>(base::toTicks(double(def.lifetime)), 1)),
      interval_(lifetime_ / (def.maxPoints - 2) + 1), trails_(rows, memory),
      points_(memory, size_t(rows) * def.maxPoints)
{
    std::fill_n(points_.data(), size_t(rows) * def.maxPoints, Point{});
}

void RibbonStore::clear()
{
    std::fill(trails_.begin(), trails_.end(), Trail{});
    count_ = 0;
}

bool RibbonStore::follow(const AppearanceJob& job, const Span& step, uint32_t& ioRow, base::WorkBudget& work)
{
    const ParticleStore& store = *job.store;
    const uint32_t used = uint32_t(std::min<uint64_t>(store.next(), rows_));
    if (ioRow == 0)
        count_ = 0;
    for (; ioRow < used; ++ioRow) {
        if (work.isSpent())
            return false;
        Trail& trail = trails_[ioRow];
        const uint64_t index = store.index[ioRow];
        if (index != kNoParticle && index != trail.index && store.born[ioRow] >= step.begin &&
            store.born[ioRow] <= step.end)
            begin(job, ioRow);
        if (trail.count == 0)
            continue;
        if (!trail.ended)
            followRow(job, ioRow, step);
        forget(ioRow, step.end);
        count_ += trail.count > 0 ? 1u : 0u;
        work.spend(uint64_t(emitter_work::kTrail));
    }
    return true;
}

/// The first point lies where the particle is born; when its motion is integrated it has moved since.
void RibbonStore::begin(const AppearanceJob& job, uint32_t row)
{
    Trail& trail = trails_[row];
    trail = Trail{};
    trail.index = job.store->index[row];
    for (size_t a = 0; a < 3; ++a)
        trail.tint[int(a)] = job.store->value(stored::TintRed + a, row);
    trail.head.tick = job.store->born[row];
    glm::vec3 velocity;
    trail.head.position = placeOf(job, row, trail.head.tick, &velocity);
    if (!job.program->ballistic)
        trail.head.position -= float(base::toSeconds(job.now - trail.head.tick)) * velocity;
    keep(row, trail.head);
    trail.next = 1;
}

void RibbonStore::keep(uint32_t row, const Point& point)
{
    Trail& trail = trails_[row];
    if (trail.count == def_.maxPoints) {
        trail.first = (trail.first + 1) % def_.maxPoints;
        --trail.count;
    }
    points_[size_t(row) * def_.maxPoints + (trail.first + trail.count) % def_.maxPoints] = point;
    ++trail.count;
}

void RibbonStore::followRow(const AppearanceJob& job, uint32_t row, const Span& step)
{
    const base::Ticks end = step.end;
    Trail& trail = trails_[row];
    const ParticleStore& store = *job.store;
    const base::Ticks from = std::max(step.begin, store.born[row]);
    base::Ticks until = end;
    if (!store.isAlive(row, end)) {
        trail.ended = true;
        until = store.isAlive(row, from) ? deathTick(store, row, from, end) : end;
    }
    const Point old = trail.head;
    const glm::vec3 last = job.program->ballistic ? glm::vec3(0.0f) : placeOf(job, row, end);
    const auto at = [&](base::Ticks tick) {
        if (job.program->ballistic)
            return placeOf(job, row, tick);
        const double share = end > old.tick ? double(tick - old.tick) / double(end - old.tick) : 1.0;
        return old.position + float(share) * (last - old.position);
    };
    for (base::Ticks tick = trail.next * interval_ + store.born[row]; tick <= until;
         tick += interval_, ++trail.next)
    {
        const Point& newest = pointOf(row, trail.count - 1);
        const glm::vec3 position = at(tick); // (1)
        const float way = distance(newest.position, position);
        if (way > def_.minDistance)
            keep(row, {position, newest.arc + way, tick}); // (2)
    }
    const Point& newest = pointOf(row, trail.count - 1);
    const glm::vec3 position = at(until);
    trail.head = {position, newest.arc + distance(newest.position, position), until};
}

/// Points behind the one that bounds the tail are not needed; a trail of the dead ends with its head.
void RibbonStore::forget(uint32_t row, base::Ticks now)
{
    Trail& trail = trails_[row];
    while (trail.count > 1 && now - pointOf(row, 1).tick >= lifetime_ + kPast) {
        trail.first = (trail.first + 1) % def_.maxPoints;
        --trail.count;
    }
    if (trail.ended && now - trail.head.tick >= lifetime_ + kPast) {
        const uint64_t index = trail.index;
        trail = Trail{};
        trail.index = index;
    }
}

/// Puts points into the columns of a group.
struct RibbonStore::Writer
{
    const RibbonDef& def;
    base::SnapshotGroup& group;
    double perLife;
    base::Ticks now;
    float life; ///< [s]
    uint32_t count = 0;
    base::Bounds bounds{};

    void put(const Point& point, uint64_t strip)
    {
        namespace column = base::ribbon_column;
        const float t = float(double(now - point.tick) * perLife);
        const float half = 0.5f * def.width * std::max(def.widthAlong.at(t)[0], 0.0f);
        group.editColumn(column::PositionX)[count] = point.position.x;
        group.editColumn(column::PositionY)[count] = point.position.y;
        group.editColumn(column::PositionZ)[count] = point.position.z;
        group.editColumn(column::HalfWidth)[count] = half;
        group.editColumn(column::Arc)[count] = point.arc;
        group.editColumn64(column::Strip)[count] = strip;
        group.editColumn(column::Age)[count] = float(double(now - point.tick) * kSecondsPerTick);
        bounds.add(point.position, half);
        ++count;
    }

    /// [m] where a strip ends for its age: the arc length at the age of 1 / perLife. (3)
    float endOf(uint32_t first) const
    {
        namespace column = base::ribbon_column;
        const auto arc = group.editColumn(column::Arc), age = group.editColumn(column::Age);
        for (uint32_t i = count; i-- > first + 1;)
            if (age[i - 1] < life)
                return age[i] <= life
                           ? arc[i]
                           : arc[i] + (arc[i - 1] - arc[i]) * ((age[i] - life) / (age[i] - age[i - 1]));
        return count > first ? arc[first] : 0.0f;
    }

    /// The rows from `first` on are a strip.
    void finish(uint32_t first, const glm::vec3& tint)
    {
        namespace column = base::ribbon_column;
        const auto arc = group.editColumn(column::Arc);
        const float head = count > first ? arc[first] : 0.0f;
        const float end = endOf(first);
        for (uint32_t i = first; i < count; ++i) {
            const float t =
                std::min(group.editColumn(column::Age)[i] * float(perLife / kSecondsPerTick), 1.0f);
            float opacity = def.opacityAlong.at(t)[0];
            if (def.softEnds > 0.0f)
                opacity *=
                    std::clamp(std::min(head - arc[i], arc[i] - end) / def.softEnds, 0.0f, 1.0f); // (4)
            const auto color = def.colorAlong.at(t);
            group.editColumn64(column::Color)[i] =
                base::packHalfs(color[0] * tint.x, color[1] * tint.y, color[2] * tint.z, opacity);
            if (def.arcPerTile <= 0.0f)
                arc[i] = head > end ? (arc[i] - end) / (head - end) : 0.0f; // (5)
        }
    }
};

bool RibbonStore::publish(base::Ticks now, base::Ticks past, base::SnapshotGroup& group,
                          PublicationPlace& ioPlace, base::WorkBudget& work) const
{
    Writer out{def_,
               group,
               1.0 / double(lifetime_),
               now,
               float(double(lifetime_) * kSecondsPerTick),
               ioPlace.count,
               ioPlace.bounds};
    const base::Ticks shown = lifetime_ + std::clamp<base::Ticks>(past, 0, kPast);
    for (uint32_t& row = ioPlace.row; row < rows_ && count_ > 0; ++row) {
        if (work.isSpent())
            return false;
        const Trail& trail = trails_[row];
        if (trail.count == 0 || now - trail.head.tick >= shown)
            continue;
        const uint32_t begin = out.count;
        if (trail.head.tick > pointOf(row, trail.count - 1).tick)
            out.put(trail.head, trail.index);
        const Point* younger = &trail.head;
        for (uint32_t k = trail.count; k-- > 0;) {
            const Point& point = pointOf(row, k);
            const base::Ticks over = now - point.tick - shown;
            if (over < 0) {
                out.put(point, trail.index);
            } else {
                Point end = point; // (3)
                const base::Ticks between = younger->tick - point.tick;
                const float share = between > 0 ? float(double(over) / double(between)) : 0.0f;
                end.position += share * (younger->position - point.position);
                end.arc += share * (younger->arc - point.arc);
                end.tick = now - shown;
                out.put(end, trail.index);
                break;
            }
            younger = &point;
        }
        out.finish(begin, trail.tint);
        work.spend(uint64_t(emitter_work::kPoint * double(out.count - begin)));
        ioPlace.count = out.count;
        ioPlace.bounds = out.bounds;
    }
    group.editInfo().count = out.count;
    group.editInfo().bounds = out.bounds;
    return true;
}

void RibbonStore::save(StateWriter& writer) const
{
    writer.value(count_);
    const auto put = [&writer](const Point& point) {
        writer.vector(point.position);
        writer.value(point.arc);
        writer.value(point.tick);
    };
    for (uint32_t row = 0; row < rows_; ++row) {
        const Trail& trail = trails_[row];
        if (trail.count == 0)
            continue;
        writer.value(row);
        writer.value(trail.index);
        writer.value(trail.count);
        writer.value(trail.next);
        writer.flag(trail.ended);
        writer.vector(trail.tint);
        put(trail.head);
        for (uint32_t k = 0; k < trail.count; ++k)
            put(pointOf(row, k));
    }
}

/// For living particles the points are known whose ticks have passed, by (1); the number of the next follows.
void RibbonStore::checkRow(StateReader& reader, const ParticleStore& store, uint32_t row,
                           base::Ticks now) const
{
    const Trail& trail = trails_[row];
    reader.require(trail.head.tick <= now, "a trail is of the future");
    if (trail.ended || !reader.ok())
        return;
    reader.require(store.index[row] == trail.index, "a trail is of no particle");
    const base::Ticks age = trail.head.tick - store.born[row];
    reader.require(age >= 0 && trail.next == uint64_t(age / interval_) + 1, "a trail is out of range");
}

void RibbonStore::restore(StateReader& reader, const ParticleStore& store, base::Ticks now)
{
    clear();
    const uint32_t count = reader.value<uint32_t>(0, rows_, "an emitter has room for fewer trails");
    const auto get = [&reader] {
        Point point;
        point.position = reader.vector();
        point.arc = reader.value<float>();
        point.tick = reader.value<base::Ticks>(0, INT64_MAX / 4, "a point of a trail is out of range");
        return point;
    };
    for (uint32_t i = 0; i < count && reader.ok(); ++i) {
        const uint32_t row = reader.value<uint32_t>(0, rows_ - 1, "a trail is of no particle");
        if (!reader.ok())
            return;
        Trail& trail = trails_[row];
        reader.require(trail.count == 0, "a particle has two trails");
        trail = Trail{};
        trail.index = reader.value<uint64_t>();
        const uint32_t points = reader.value<uint32_t>(1, def_.maxPoints, "a trail has too many points");
        trail.next = reader.value<uint64_t>();
        trail.ended = reader.flag();
        trail.tint = reader.vector();
        trail.head = get();
        for (uint32_t k = 0; k < points && reader.ok(); ++k)
            keep(row, get());
        checkRow(reader, store, row, now);
    }
    count_ = reader.ok() ? count : 0;
}

} // namespace fx::sim
