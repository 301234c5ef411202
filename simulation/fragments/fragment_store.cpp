#include "simulation/fragments/fragment_store.h"

namespace fx::sim {

FragmentStore::FragmentStore(std::pmr::memory_resource* memory, size_t capacity)
    : number(memory, capacity), trailed(memory, capacity), dies(memory, capacity)
{
    for (base::Column<float>& column : attributes)
        column = base::Column<float>(memory, capacity);
}

void FragmentStore::removeDead(base::Ticks tick)
{
    uint32_t alive = 0;
    for (uint32_t i = 0; i < count; ++i) {
        if (dies[i] <= tick)
            continue;
        if (alive != i) {
            number[alive] = number[i];
            trailed[alive] = trailed[i];
            dies[alive] = dies[i];
            for (base::Column<float>& column : attributes)
                column[alive] = column[i];
        }
        ++alive;
    }
    count = alive;
}

void FragmentStore::save(StateWriter& writer) const
{
    writer.value(count);
    writer.values(number.first(count));
    writer.values(trailed.first(count));
    writer.values(dies.first(count));
    for (const base::Column<float>& column : attributes)
        writer.values(column.first(count));
}

void FragmentStore::restore(StateReader& reader)
{
    count = reader.value<uint32_t>(0, uint32_t(capacity()), "there is room for fewer fragments");
    reader.values(number.first(count));
    reader.values(trailed.first(count));
    reader.values(dies.first(count));
    for (base::Column<float>& column : attributes)
        reader.values(column.first(count));
    for (uint32_t i = 0; i < count && reader.ok(); ++i) {
        reader.require(number[i] < capacity() && (i == 0 || number[i] > number[i - 1]),
                       "fragments are out of order");
        reader.require(attributes[fragment_column::Size][i] > 0.0f, "a fragment has no size");
        reader.require(attributes[fragment_column::Due][i] >= 0.0f, "a fragment's smoke is overdue");
        reader.require(attributes[fragment_column::Hottest][i] > 0.0f, "a fragment was never hot");
    }
}

} // namespace fx::sim
