#include "simulation/fragments/trail_store.h"

namespace fx::sim {

TrailStore::TrailStore(std::pmr::memory_resource* memory, size_t capacity)
    : id(memory, capacity), born(memory, capacity), dies(memory, capacity)
{
    for (base::Column<float>& column : attributes)
        column = base::Column<float>(memory, capacity);
}

void TrailStore::removeDead(base::Ticks tick)
{
    uint32_t alive = 0;
    for (uint32_t i = 0; i < count; ++i) {
        if (dies[i] <= tick)
            continue;
        if (alive != i) {
            id[alive] = id[i];
            born[alive] = born[i];
            dies[alive] = dies[i];
            for (base::Column<float>& column : attributes)
                column[alive] = column[i];
        }
        ++alive;
    }
    count = alive;
}

void TrailStore::save(StateWriter& writer) const
{
    writer.value(count);
    writer.values(id.first(count));
    writer.values(born.first(count));
    writer.values(dies.first(count));
    for (const base::Column<float>& column : attributes)
        writer.values(column.first(count));
}

void TrailStore::restore(StateReader& reader, base::Ticks now)
{
    count = reader.value<uint32_t>(0, uint32_t(capacity()), "there is room for less smoke of fragments");
    reader.values(id.first(count));
    reader.values(born.first(count));
    reader.values(dies.first(count));
    for (base::Column<float>& column : attributes)
        reader.values(column.first(count));
    for (uint32_t i = 0; i < count && reader.ok(); ++i) {
        reader.require(born[i] >= 0 && born[i] <= now, "smoke of a fragment is not born yet");
        reader.require(dies[i] > born[i], "smoke of a fragment ends before it is born");
    }
}

} // namespace fx::sim
