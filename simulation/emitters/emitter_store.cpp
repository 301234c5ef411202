#include "simulation/emitters/emitter_store.h"

namespace fx::sim {

namespace {

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

} // namespace fx::sim
