#include "simulation/emitters/emitter_store.h"

namespace fx::sim {

namespace {

constexpr base::Ticks kLatestDeath = INT64_MAX / 2; ///< kForever and the longest life

template <class T>
void gather(base::Column<T>& column, uint32_t first, std::span<const uint32_t> rows)
{
    T* values = column.data();
    for (size_t i = 0; i < rows.size(); ++i)
        values[first + i] = values[rows[i]]; // rows ascend and rows[i] >= first + i
}

} // namespace

EmitterStore::EmitterStore(std::pmr::memory_resource* memory, size_t capacity)
    : index(memory, capacity), born(memory, capacity), dies(memory, capacity)
{
    for (base::Column<float>& column : attributes)
        column = base::Column<float>(memory, capacity);
}

void EmitterStore::removeDead(uint32_t first, base::Ticks tick, std::span<uint32_t> kept)
{
    uint32_t alive = 0;
    for (uint32_t i = first; i < count; ++i)
        if (dies[i] > tick)
            kept[alive++] = i;
    if (first + alive == count)
        return;

    const std::span<const uint32_t> rows = kept.first(alive);
    gather(index, first, rows);
    gather(born, first, rows);
    gather(dies, first, rows);
    for (base::Column<float>& column : attributes)
        gather(column, first, rows);
    count = first + alive;
}

void EmitterStore::save(StateWriter& writer) const
{
    writer.value(count);
    writer.values(index.first(count));
    writer.values(born.first(count));
    writer.values(dies.first(count));
    for (const base::Column<float>& column : attributes)
        writer.values(column.first(count));
}

void EmitterStore::restore(StateReader& reader, base::Ticks now)
{
    count = reader.value<uint32_t>(0, uint32_t(capacity()), "an emitter has room for fewer particles");
    reader.values(index.first(count));
    reader.values(born.first(count));
    reader.values(dies.first(count));
    for (base::Column<float>& column : attributes)
        reader.values(column.first(count));
    for (uint32_t i = 0; i < count && reader.ok(); ++i) {
        reader.require(i == 0 || index[i] > index[i - 1], "particles of an emitter are out of order");
        reader.require(born[i] >= 0 && born[i] <= now, "a particle is not born yet");
        reader.require(dies[i] > now && dies[i] <= kLatestDeath, "a particle is dead or immortal");
    }
}

} // namespace fx::sim
