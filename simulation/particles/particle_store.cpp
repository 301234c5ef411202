#include "simulation/particles/particle_store.h"

#include <algorithm>

namespace fx::sim {

namespace {

constexpr uint64_t kMostIndex = uint64_t(1) << 62;

bool isPlace(size_t column)
{
    return column >= stored::X && column <= stored::Z;
}

} // namespace

ParticleStore::ParticleStore(const ParticleProgram& program, std::pmr::memory_resource* memory)
    : constant(program.constant), placed(program.stores[stored::X]),
      capacity_(std::max(program.def.maxParticles, 1u)), brief_(program.brief), mortal_(program.mortal)
{
    // Kernels work on whole vectors: every column can be read and written up to the next multiple.
    const size_t rows = (size_t(capacity_) + kTilePadding - 1) / kTilePadding * kTilePadding;
    index = base::Column<uint64_t>(memory, rows);
    born = base::Column<base::Ticks>(memory, rows);
    std::fill_n(index.data(), rows, kNobody);
    std::fill_n(born.data(), rows, 0);
    if (brief_) {
        bornShort = base::Column<uint32_t>(memory, rows);
        std::fill_n(bornShort.data(), rows, 0u);
    }
    if (program.keepsFlags) {
        flags = base::Column<uint32_t>(memory, rows);
        std::fill_n(flags.data(), rows, 0u);
    }
    for (size_t c = 0; c < stored::Count; ++c) {
        if (!program.stores[c] && !isPlace(c))
            continue;
        values[c] = base::Column<float>(memory, rows);
        if (program.stores[c]) // the place is not touched before it is needed
            std::fill_n(values[c].data(), rows, c == stored::PerLife ? kNoLife : 0.0f);
    }
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
    if (index[row] == kNobody || (brief_ && uint64_t(now - born[row]) > 0xFFFFFFFFu))
        return false;
    return ageOf(row, now) * value(stored::PerLife, row) < 1.0f;
}

RowWindow ParticleStore::window() const
{
    if (empty())
        return {};
    if (next_ - front_ >= capacity_)
        return {capacity_, capacity_, capacity_};
    const uint32_t first = rowOf(front_);
    const uint32_t end = rowOf(next_);
    if (first < end)
        return {end, 0, first};
    return {capacity_, end, first};
}

void ParticleStore::retire(base::Ticks now)
{
    if (now < frontUntil_)
        return;
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
    std::fill_n(index.data(), capacity_, kNobody);
    if (values[stored::PerLife].data())
        std::fill_n(values[stored::PerLife].data(), capacity_, kNoLife);
    front_ = next_ = next;
    frontUntil_ = 0;
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

void ParticleStore::restore(StateReader& reader, base::Ticks now)
{
    const uint64_t front = reader.value<uint64_t>(0, kMostIndex, "an emitter's births are out of range");
    const uint64_t next = reader.value<uint64_t>(0, kMostIndex, "an emitter's births are out of range");
    reader.require(front <= next, "an emitter's births are out of order");
    clear(next);
    front_ = reader.ok() ? front : next;
    placed = reader.flag() || placed;
    const uint32_t count = reader.value<uint32_t>(0, capacity_, "an emitter has room for fewer particles");
    // Rows that nobody lives in must not look alive: their age is more than any life.
    for (uint32_t row = 0; row < capacity_; ++row)
        born[row] = now;
    if (brief_)
        std::fill_n(bornShort.data(), capacity_, uint32_t(now) + 1); // 2^32 - 1 ticks ago
    for (uint32_t i = 0; i < count && reader.ok(); ++i)
        restoreRow(reader, now);
}

void ParticleStore::restoreRow(StateReader& reader, base::Ticks now)
{
    const uint64_t particle = reader.value<uint64_t>();
    reader.require(particle >= front_ && particle < next_, "a particle is not of this emitter");
    const uint32_t row = rowOf(particle);
    reader.require(index[row] == kNobody, "two particles live in one place");
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

} // namespace fx::sim
