#include "simulation/sph/gas_store.h"

namespace fx::sim {

GasStore::GasStore(std::pmr::memory_resource* memory, uint32_t capacity)
    : kernels(memory, capacity), listed(memory, size_t(capacity) * kMostListed), pairs(memory, capacity),
      clamped(memory, capacity)
{
    for (base::Column<float>& column : columns)
        column = base::Column<float>(memory, capacity);
    for (base::Column<float>& column : sorted)
        column = base::Column<float>(memory, capacity);
}

} // namespace fx::sim
