#include "simulation/sph/dynamics/gas_columns.h"

#include "foundation/tasks/parallel_rows.h"

#include <utility>

namespace fx::sim {

namespace {

template <class E>
void permuteColumn(base::Column<E>& column, base::Column<E>& spare, std::span<const uint32_t> order,
                   base::TaskRunner& tasks)
{
    parallelRows(tasks, uint32_t(order.size()), 4096, [&](uint32_t begin, uint32_t end) {
        for (uint32_t slot = begin; slot < end; ++slot)
            spare[slot] = column[order[slot]];
    });
    std::swap(column, spare);
}

} // namespace

template <class T>
GasColumns<T>::GasColumns(std::pmr::memory_resource* memory, uint32_t capacity)
    : id(memory, capacity), begin(memory, capacity), end(memory, capacity), drifted(memory, capacity),
      level(memory, capacity), spare_(memory, capacity), spareTicks_(memory, capacity),
      spareIds_(memory, capacity), spareLevels_(memory, capacity)
{
    for (base::Column<T>* column : lasting())
        *column = base::Column<T>(memory, capacity);
}

template <class T>
void GasColumns<T>::permute(std::span<const uint32_t> order, base::TaskRunner& tasks)
{
    permuteColumn(id, spareIds_, order, tasks);
    for (base::Column<T>* column : lasting())
        permuteColumn(*column, spare_, order, tasks);
    for (base::Column<uint64_t>* column : {&begin, &end, &drifted})
        permuteColumn(*column, spareTicks_, order, tasks);
    permuteColumn(level, spareLevels_, order, tasks);
}

template <class T>
std::array<base::Column<T>*, 29> GasColumns<T>::lasting()
{
    return {&x,
            &y,
            &z,
            &vx,
            &vy,
            &vz,
            &mass,
            &entropy,
            &ax,
            &ay,
            &az,
            &entropyRate,
            &support,
            &density,
            &correction,
            &divergence,
            &expansion,
            &divergenceBefore,
            &curl,
            &exposure,
            &viscosity,
            &limiter,
            &pressure,
            &energy,
            &pressureRate,
            &energyRate,
            &sound,
            &heatToEntropy,
            &wantedStep};
}

template struct GasColumns<float>;
template struct GasColumns<double>;

} // namespace fx::sim
