#include "simulation/fragments/trail_store.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace fx::sim {

namespace {

constexpr size_t kUsualRows = 8192;
constexpr uint64_t kStateBytes = // of a row in a saved state
    sizeof(uint64_t) + 2 * sizeof(base::Ticks) + trail_column::Count * sizeof(float);

template <class T>
base::Column<T> grown(std::pmr::memory_resource* memory, const base::Column<T>& from, size_t count,
                      size_t rows)
{
    base::Column<T> column(memory, rows);
    std::copy_n(from.data(), count, column.data());
    return column;
}

} // namespace

TrailStore::TrailStore(std::pmr::memory_resource* memory, size_t most, size_t fragments)
    : memory_(memory), most_(most), next_(memory, fragments + 1)
{
    reserve(std::min(most, kUsualRows));
}

uint64_t TrailStore::bytesOf(size_t rows, size_t fragments)
{
    return uint64_t(rows) * (kStateBytes + sizeof(uint32_t)) + uint64_t(fragments + 1) * sizeof(uint32_t);
}

void TrailStore::reserve(size_t rows)
{
    if (rows <= held())
        return;
    const size_t more = std::min(std::max({rows, 2 * held()}), most_);
    base::Column<uint64_t> ids = grown(memory_, id, count, more);
    base::Column<base::Ticks> births = grown(memory_, born, count, more);
    base::Column<base::Ticks> deaths = grown(memory_, dies, count, more);
    std::array<base::Column<float>, trail_column::Count> values;
    for (size_t c = 0; c < values.size(); ++c)
        values[c] = grown(memory_, attributes[c], count, more);
    base::Column<uint32_t> places(memory_, more);
    std::swap(id, ids);
    std::swap(born, births);
    std::swap(dies, deaths);
    std::swap(attributes, values);
    std::swap(order, places);
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

// Blobs of one fragment are created with ascending ids, so that counting the blobs of each fragment sorts
// them.
void TrailStore::sort()
{
    const std::span<uint32_t> next = next_.first(next_.capacity());
    std::ranges::fill(next, 0u);
    for (uint32_t i = 0; i < count; ++i)
        ++next[trailFragment(id[i]) + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (uint32_t i = 0; i < count; ++i)
        order[next[trailFragment(id[i])]++] = i;
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
    reader.require(reader.left() >= kStateBytes * count, "smoke of fragments is cut short");
    if (!reader.ok())
        count = 0;
    reserve(count);
    reader.values(id.first(count));
    reader.values(born.first(count));
    reader.values(dies.first(count));
    for (base::Column<float>& column : attributes)
        reader.values(column.first(count));
    for (uint32_t i = 0; i < count && reader.ok(); ++i) {
        reader.require(born[i] >= 0 && born[i] <= now, "smoke of a fragment is not born yet");
        reader.require(dies[i] > born[i], "smoke of a fragment ends before it is born");
        reader.require(trailFragment(id[i]) + 1 < next_.capacity(), "smoke belongs to no fragment");
    }
    if (!reader.ok())
        count = 0;
    sort();
}

} // namespace fx::sim
