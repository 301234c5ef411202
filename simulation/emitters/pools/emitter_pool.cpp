#include "simulation/emitters/pools/emitter_pool.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <new>

namespace fx::sim {

namespace {

constexpr uint32_t kFirstRows = 256;
constexpr double kSurely = 0.999; // of a life, with more than rounding

/// Pools are made by several threads.
uint64_t nextOrder()
{
    static std::atomic<uint64_t> last{0};
    return ++last;
}

/// Prefetches data that is used soon.
void fetchAhead(const void* data, size_t bytes)
{
    for (size_t at = 0; at < bytes; at += 64)
        __builtin_prefetch(static_cast<const char*>(data) + at);
}

bool sameBits(const glm::vec3& a, const glm::vec3& b)
{
    const auto bits = [](float x) { return std::bit_cast<uint32_t>(x); };
    return bits(a.x) == bits(b.x) && bits(a.y) == bits(b.y) && bits(a.z) == bits(b.z);
}

} // namespace

EmitterPool::EmitterPool(std::shared_ptr<const ParticleProgram> program, const glm::vec3& pull,
                         uint64_t& revision, std::pmr::memory_resource* memory)
    : program_(std::move(program)), pull_(pull), each_(std::max(program_->def.maxParticles, 1u)),
      revision_(revision), memory_(memory), store_(*program_, memory, kFirstRows), owner_(kFirstRows),
      index_(kFirstRows), number_(nextOrder())
{
    births_.reserve(kTileRows);
}

bool EmitterPool::fits(const ParticleProgram& program, const glm::vec3& pull) const
{
    return program.number == program_->number && sameBits(pull, pull_);
}

bool EmitterPool::lives(uint64_t serial, base::Ticks tick, uint32_t& outRow) const
{
    if (serial < store_.front() || serial >= store_.next())
        return false;
    outRow = store_.rowOf(serial);
    return store_.index[outRow] == serial && store_.isAlive(outRow, tick);
}

/// Room for one more member, so that nothing later has to ask for memory unless births come ever faster.
void EmitterPool::makeRoom(uint32_t member, uint64_t rows)
{
    const size_t slots = std::max<size_t>(members_.size(), member + 1);
    const auto reserve = [](auto& list, size_t size) {
        if (list.capacity() < size)
            list.reserve(std::max(size, 2 * list.capacity()));
    };
    reserve(members_, slots);
    reserve(wake_, slots);
    reserve(counts_, slots);
    reserve(free_, slots);
    reserve(due_, slots);
    reserve(serial_, slots * each_);
    const uint64_t most = (uint64_t(taken_) + 1) * each_;
    if (most > store_.capacity() || store_.next() - store_.front() + rows > store_.capacity())
        rebuild(most);
}

/// Gives the living rows another ring, of at least `rows` rows.
void EmitterPool::rebuild(uint64_t rows)
{
    const RowWindow window = store_.window();
    const uint64_t used = std::min<uint64_t>(window.count, store_.next() - store_.front());
    const uint64_t wanted = std::max({rows + rows / 8, used + used / 2, uint64_t(kFirstRows)});
    const uint32_t capacity = uint32_t((wanted + kTilePadding - 1) / kTilePadding * kTilePadding);
    ParticleStore store(*program_, memory_, capacity);
    std::vector<uint32_t> owner(capacity);
    std::vector<uint64_t> index(capacity);
    store.clear(store_.next()); // no serial number is given twice
    for (uint64_t serial = store_.front(); serial < store_.next(); ++serial) {
        uint32_t row = store_.rowOf(serial);
        const base::Ticks since = std::max(now_, store_.born[row]); // it may have been born in this step
        if (!lives(serial, since, row))
            continue;
        const uint32_t to = store.rowOf(store.next());
        store.copyRow(store_, row, to, {store.next(), store_.born[row]});
        owner[to] = owner_[row];
        index[to] = index_[row];
        serial_[placeOfName(owner[to])] = store.next();
        store.advance(1);
    }
    store_ = std::move(store);
    owner_.swap(owner);
    index_.swap(index);
    number_ = nextOrder();
}

void EmitterPool::put(uint32_t member, uint64_t particle, uint32_t row, uint64_t serial)
{
    const uint32_t to = store_.rowOf(serial);
    owner_[to] = base::PooledRows::nameOf(member, row);
    index_[to] = particle;
    serial_[placeOf(member, row)] = serial;
}

uint32_t EmitterPool::admit(const PoolEntry& entry, base::Ticks now)
{
    const ParticleStore& own = entry.emitter->store();
    const uint32_t m = free_.empty() ? uint32_t(members_.size()) : free_.back();
    if (m >= base::PooledRows::kMaxMembers)
        return kNoMember;
    now_ = now;
    if (taken_ == 0) // time may have gone on, or back, since the last member left its rows
        store_.clear(store_.next());
    try {
        makeRoom(m, own.rowsInUse());
    } catch (const std::bad_alloc&) {
        return kNoMember;
    }
    if (m == members_.size()) {
        members_.emplace_back();
        wake_.push_back(kForever);
        counts_.push_back(0);
        serial_.resize(serial_.size() + each_);
    } else {
        free_.pop_back();
    }
    std::fill_n(serial_.begin() + std::ptrdiff_t(placeOf(m, 0)), each_, kNoParticle);
    Member& member = members_[m];
    member = Member{};
    member.emitter = entry.emitter;
    member.seed = entry.seed;
    member.user = entry.user;
    member.offset = entry.offset;
    member.births = entry.births;
    member.births.tick -= entry.offset;
    member.end = entry.end - entry.offset;
    member.front = own.front();
    member.next = own.next();
    member.frontRow = own.rowOf(own.front());
    member.nextRow = own.rowOf(own.next());
    takeRows(m, own);
    member.highWater = entry.emitter->highWater();
    member.dropped = entry.emitter->dropped();
    ++taken_;
    ++revision_;
    retire(m);
    wakeLater(m);
    return m;
}

/// Copies the living particles of the member's previous store.
void EmitterPool::takeRows(uint32_t m, const ParticleStore& own)
{
    const base::Ticks offset = members_[m].offset;
    for (uint64_t particle = own.front(); particle < own.next(); ++particle) {
        const uint32_t row = own.rowOf(particle);
        if (own.index[row] != particle || !own.isAlive(row, now_ + offset))
            continue;
        const uint64_t serial = store_.next();
        store_.copyRow(own, row, store_.rowOf(serial), {serial, own.born[row] - offset});
        put(m, particle, row, serial);
        store_.advance(1);
    }
}

void EmitterPool::forget(uint32_t m)
{
    uint32_t row = 0;
    for (uint32_t r = 0; r < each_; ++r)
        if (lives(serial_[placeOf(m, r)], now_, row))
            store_.endRow(row, now_);
    rowsInUse_ -= members_[m].rows;
    members_[m] = Member{};
    wake_[m] = kForever;
    counts_[m] = 0;
    free_.push_back(m);
    --taken_;
    ++revision_;
}

uint32_t EmitterPool::countAlive(uint32_t m) const
{
    uint32_t alive = 0, row = 0;
    for (uint32_t r = 0; r < each_; ++r)
        alive += lives(serial_[placeOf(m, r)], now_, row) ? 1u : 0u;
    return alive;
}

void EmitterPool::write(uint32_t m) const
{
    const Member& member = members_[m];
    const base::Ticks local = now_ + member.offset;
    ParticleStore& own = member.emitter->store();
    own.clear(member.front, member.next, local);
    uint32_t row = 0;
    for (uint32_t r = 0; r < each_; ++r)
        if (lives(serial_[placeOf(m, r)], now_, row))
            own.copyRow(store_, row, r, {index_[row], store_.born[row] + member.offset});
    member.emitter->takeBack(local, member.highWater, member.dropped);
}

void EmitterPool::step(base::Ticks to, StepCounters& counters, std::vector<uint32_t>& outLeft)
{
    due_.clear();
    for (uint32_t m = 0; m < wake_.size(); ++m) {
        if (wake_[m] > to)
            continue;
        due_.push_back(m);
        fetchAhead(&members_[m], sizeof(Member));
        fetchAhead(&serial_[placeOf(m, 0)], std::min<size_t>(each_, 32) * sizeof(uint64_t));
    }
    for (const uint32_t m : due_)
        giveBirths(m, to, counters);
    makeBirths();
    now_ = to;
    store_.retire(to);
    for (const uint32_t m : due_) {
        retire(m);
        wakeLater(m);
    }
    counters.particleSteps += rowsInUse_;
    for (const uint32_t m : due_)
        if (const Member& member = members_[m]; member.rows == 0 || member.end <= to) {
            outLeft.push_back(member.user);
            member.emitter->leavePool();
        }
}

void EmitterPool::giveBirths(uint32_t m, base::Ticks to, StepCounters& counters)
{
    Member& member = members_[m];
    const base::Ticks until = std::min(to, member.end);
    for (; member.births.tick < until; member.births.goOn()) {
        const uint32_t place = member.nextRow;
        const uint64_t particle = member.next++;
        member.nextRow = place + 1 == each_ ? 0 : place + 1;
        ++counters.born;
        const uint64_t before = serial_[placeOf(m, place)];
        if (before >= store_.next() && before != kNoParticle)
            makeBirths(); // it is born in this step, too
        uint32_t row = 0;
        if (lives(before, member.births.tick, row) || !findRoom()) {
            ++counters.dropped;
            ++member.dropped;
            continue;
        }
        const uint64_t serial = store_.next() + births_.size();
        put(m, particle, place, serial);
        births_.push_back({{serial, member.births.tick}, particle, member.seed});
    }
}

/// Room for one more birth. @return false when there is no memory for more rows
bool EmitterPool::findRoom()
{
    if (births_.size() == kTileRows)
        makeBirths();
    if (store_.next() - store_.front() + births_.size() < store_.capacity())
        return true;
    makeBirths();
    try {
        rebuild(uint64_t(taken_) * each_);
    } catch (const std::bad_alloc&) {
        return false;
    }
    return true;
}

void EmitterPool::makeBirths()
{
    if (births_.empty())
        return;
    storePooled(*program_, 0, births_, store_);
    store_.advance(births_.size());
    births_.clear();
}

/// Lets go what has died at the old end of a member's window, as ParticleStore::retire() does.
void EmitterPool::retire(uint32_t m)
{
    Member& member = members_[m];
    if (now_ >= member.frontUntil) {
        uint32_t row = 0;
        for (; member.front < member.next; ++member.front) {
            if (lives(serial_[placeOf(m, member.frontRow)], now_, row) && index_[row] == member.front) {
                const double life =
                    double(base::kTicksPerSecond) / double(store_.value(stored::PerLife, row));
                member.frontUntil = store_.born[row] + base::Ticks(kSurely * life);
                break;
            }
            member.frontRow = member.frontRow + 1 == each_ ? 0 : member.frontRow + 1;
        }
    }
    const uint32_t rows = uint32_t(std::min<uint64_t>(member.next - member.front, each_));
    rowsInUse_ += rows;
    rowsInUse_ -= member.rows;
    member.rows = rows;
    member.highWater = std::max(member.highWater, rows);
    const bool isWhole = rows == each_ || member.frontRow >= member.nextRow;
    counts_[m] = rows == 0 ? 0 : isWhole ? each_ : member.nextRow;
}

void EmitterPool::wakeLater(uint32_t m)
{
    const Member& member = members_[m];
    wake_[m] = std::min({member.births.tick + 1, member.frontUntil, member.end});
}

} // namespace fx::sim
