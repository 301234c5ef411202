#include "simulation/particles/particle_store.h"

#include "simulation/particles/birth.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <type_traits>

namespace fx::sim {

namespace {

constexpr uint64_t kMaxIndex = uint64_t(1) << 62;

constexpr base::Ticks kLongAgo = base::Ticks(1) << 61; // longer than any life
constexpr uint32_t kBeyondBrief = uint32_t(1) << 31;   // [tick] 3.04 s, longer than any brief life
constexpr size_t kFewRows = 1024;
constexpr size_t kSkew = 320; ///< [byte] between large columns: else all of them meet in the same cache sets

bool isPlace(size_t column)
{
    return column >= stored::X && column <= stored::Z;
}

/// Kernels work on whole vectors: every column can be read and written up to the next multiple.
size_t paddedRows(uint32_t capacity)
{
    return (size_t(capacity) + kTilePadding - 1) / kTilePadding * kTilePadding;
}

size_t columnBytes(size_t rows, size_t size)
{
    return rows * size + (rows > kFewRows ? kSkew : 0);
}

/// Cuts memory into columns of `rows` rows.
class Columns
{
public:
    Columns(std::byte* memory, size_t rows) : memory_(memory), rows_(rows) {}

    template <class T>
    void place(StoredColumn<T>& column, std::optional<std::type_identity_t<T>> first)
    {
        column = StoredColumn<T>(reinterpret_cast<T*>(memory_));
        if (first)
            std::fill_n(column.data(), rows_, *first);
        memory_ += columnBytes(rows_, sizeof(T));
    }

private:
    std::byte* memory_;
    size_t rows_;
};

} // namespace

size_t ParticleStore::bytesOf(const ParticleProgram& program, uint32_t capacity)
{
    const size_t rows = paddedRows(capacity);
    size_t bytes = columnBytes(rows, sizeof(uint64_t)) + columnBytes(rows, sizeof(base::Ticks));
    if (program.brief)
        bytes += columnBytes(rows, sizeof(uint32_t));
    if (program.keepsFlags)
        bytes += columnBytes(rows, sizeof(uint32_t));
    for (size_t c = 0; c < stored::Count; ++c)
        if (program.stores[c] || isPlace(c)) // places have room even where they are not used yet
            bytes += columnBytes(rows, sizeof(float));
    return bytes;
}

ParticleStore::ParticleStore(const ParticleProgram& program, std::pmr::memory_resource* memory,
                             uint32_t capacity)
    : capacity_(capacity > 0 ? capacity : std::max(program.def.maxParticles, 1u)), brief_(program.brief),
      mortal_(program.mortal), alwaysPlaced_(program.stores[stored::X]), placed(program.stores[stored::X]),
      constant(program.constant)
{
    memory_ = base::Column<std::byte>(memory, bytesOf(program, capacity_));
    Columns columns(memory_.data(), paddedRows(capacity_));
    if (brief_)
        columns.place(bornShort, 0u);
    for (size_t c = 0; c < stored::Count; ++c)
        if (program.stores[c])
            columns.place(values[c], c == stored::PerLife ? kNoLife : 0.0f);
    columns.place(index, kNoParticle);
    columns.place(born, base::Ticks(0));
    if (program.keepsFlags)
        columns.place(flags, 0u);
    for (size_t c = stored::X; c <= stored::Z; ++c)
        if (!program.stores[c])
            columns.place(values[c], std::nullopt); // not touched before it is needed
}

float ParticleStore::ageOf(uint32_t row, base::Ticks now) const
{
    const base::Ticks ticks = now - born[row];
    if (!brief_)
        return float(double(ticks) * (1.0 / double(base::kTicksPerSecond)));
    const uint32_t word = uint32_t(ticks);
    return (float(word >> 16) * 65536.0f + float(word & 0xFFFFu)) *
           float(1.0 / double(base::kTicksPerSecond));
}

bool ParticleStore::isAlive(uint32_t row, base::Ticks now) const
{
    if (index[row] == kNoParticle || (brief_ && uint64_t(now - born[row]) > 0xFFFFFFFFu))
        return false;
    return ageOf(row, now) * value(stored::PerLife, row) < 1.0f;
}

void ParticleStore::retireFront(base::Ticks now)
{
    if (next_ - front_ > 2 * uint64_t(capacity_)) // births were dropped: most indices in between never lived
        searchFront(now);
    for (; front_ < next_; ++front_)
        if (const uint32_t row = rowOf(front_); index[row] == front_ && isAlive(row, now)) {
            const double life = double(base::kTicksPerSecond) / double(value(stored::PerLife, row));
            frontUntil_ = mortal_ ? 0 : born[row] + base::Ticks(0.999 * life); // with more than rounding
            return;
        }
}

void ParticleStore::searchFront(base::Ticks now)
{
    uint64_t oldest = next_;
    for (uint32_t row = 0; row < capacity_; ++row)
        if (index[row] < oldest && isAlive(row, now))
            oldest = index[row];
    front_ = oldest;
}

base::Ticks ParticleStore::allLiveUntil() const
{
    base::Ticks until = std::numeric_limits<base::Ticks>::max();
    for (uint32_t row = 0; row < capacity_; ++row) {
        if (index[row] == kNoParticle)
            return 0;
        const double life = double(base::kTicksPerSecond) / double(value(stored::PerLife, row));
        until = std::min(until, born[row] + base::Ticks(0.999 * life)); // with more than rounding
    }
    return until;
}

uint32_t ParticleStore::countAlive(base::Ticks now) const
{
    const RowWindow rows = window();
    uint32_t alive = 0;
    for (uint32_t row = 0; row < rows.count; ++row)
        if (row < rows.gapBegin || row >= rows.gapEnd)
            alive += isAlive(row, now) ? 1u : 0u;
    return alive;
}

void ParticleStore::clear(uint64_t next)
{
    std::fill_n(index.data(), capacity_, kNoParticle);
    if (values[stored::PerLife].data())
        std::fill_n(values[stored::PerLife].data(), capacity_, kNoLife);
    front_ = next_ = next;
    frontUntil_ = 0;
}

void ParticleStore::clear(uint64_t front, uint64_t next, base::Ticks now)
{
    clear(next);
    front_ = front;
    for (uint32_t row = 0; row < capacity_; ++row)
        endRow(row, now);
}

void ParticleStore::copyRow(const ParticleStore& from, uint32_t fromRow, uint32_t row, const Birth& birth)
{
    index[row] = birth.index;
    born[row] = birth.tick;
    if (brief_)
        bornShort[row] = uint32_t(birth.tick);
    for (size_t c = 0; c < stored::Count; ++c)
        if (values[c].data() && (placed || !isPlace(c)))
            values[c][row] = from.values[c][fromRow];
}

void ParticleStore::endRow(uint32_t row, base::Ticks now)
{
    index[row] = kNoParticle;
    born[row] = now - kLongAgo;
    if (brief_)
        bornShort[row] = uint32_t(now) - kBeyondBrief;
    if (values[stored::PerLife].data())
        values[stored::PerLife][row] = kNoLife;
}

void ParticleStore::save(StateWriter& writer, base::Ticks now) const
{
    writer.value(front_);
    writer.value(next_);
    writer.flag(placed);
    writer.value(countAlive(now));
    const RowWindow rows = window();
    for (uint32_t row = 0; row < rows.count; ++row) {
        if ((row >= rows.gapBegin && row < rows.gapEnd) || !isAlive(row, now))
            continue;
        writer.value(index[row]);
        writer.value(born[row]);
        if (flags.data())
            writer.value(flags[row]);
        for (size_t c = 0; c < stored::Count; ++c)
            if (values[c].data() && (placed || !isPlace(c)))
                writer.value(values[c][row]);
    }
}

void ParticleStore::saveEmpty(StateWriter& writer) const
{
    writer.value(next_);
    writer.value(next_);
    writer.flag(placed);
    writer.value(uint32_t(0));
}

void ParticleStore::restore(StateReader& reader, base::Ticks now)
{
    const uint64_t front = reader.value<uint64_t>(0, kMaxIndex, "an emitter's births are out of range");
    const uint64_t next = reader.value<uint64_t>(0, kMaxIndex, "an emitter's births are out of range");
    reader.require(front <= next, "an emitter's births are out of order");
    clear(next);
    front_ = reader.ok() ? front : next;
    placed = reader.flag() || alwaysPlaced_;
    const uint32_t count = reader.value<uint32_t>(0, capacity_, "an emitter has room for fewer particles");
    for (uint32_t row = 0; row < capacity_; ++row)
        endRow(row, now);
    for (uint32_t i = 0; i < count && reader.ok(); ++i)
        restoreRow(reader, now);
}

void ParticleStore::restoreRow(StateReader& reader, base::Ticks now)
{
    const uint64_t particle = reader.value<uint64_t>();
    reader.require(particle >= front_ && particle < next_, "a particle is not of this emitter");
    const uint32_t row = rowOf(particle);
    reader.require(index[row] == kNoParticle, "two particles live in one place");
    index[row] = particle;
    born[row] = reader.value<base::Ticks>(0, now, "a particle is not born yet");
    if (brief_)
        bornShort[row] = uint32_t(born[row]);
    if (flags.data())
        flags[row] =
            reader.value<uint32_t>(0, tile_flag::Stuck | tile_flag::Collided, "a particle has unknown flags");
    for (size_t c = 0; c < stored::Count; ++c)
        if (values[c].data() && (placed || !isPlace(c)))
            reader.values(std::span<float>(&values[c][row], 1));
    const float perLife = value(stored::PerLife, row);
    reader.require(perLife > 0.0f && perLife <= kNoLife && isAlive(row, now), "a particle is dead");
}

base::Ticks deathTick(const ParticleStore& store, uint32_t row, base::Ticks from, base::Ticks to)
{
    while (to - from > 1) {
        const base::Ticks middle = from + (to - from) / 2;
        (store.isAlive(row, middle) ? from : to) = middle;
    }
    return to;
}

} // namespace fx::sim
