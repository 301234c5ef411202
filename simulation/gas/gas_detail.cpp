#include "simulation/gas/gas_detail.h"

#include "foundation/memory/arena.h"
#include "simulation/state/state_reader.h"
#include "simulation/state/state_writer.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace fx::sim {

namespace {

/// [m] of the supports.
float medianSupport(const GasView<const float>& gas, base::Arena& scratch)
{
    const std::span<float> sorted = scratch.allocate<float>(gas.count);
    std::copy_n(gas.support, gas.count, sorted.begin());
    const auto middle = sorted.begin() + std::ptrdiff_t(gas.count / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return *middle;
}

} // namespace

double GasDetail::shearRate(const GasView<const float>& gas)
{
    double squares = 0;
    for (uint32_t i = 0; i < gas.count; ++i)
        squares += double(gas.curl[i]) * double(gas.curl[i]);
    return std::sqrt(0.5 * squares / std::max(gas.count, 1u)); // (1)
}

void GasDetail::begin(const GasView<const float>& gas, base::Arena& scratch)
{
    clock_ = GenerationClock();
    const float radius = 0.5f * growth_ * medianSupport(gas, scratch);
    shared_.radiusNow[0] = shared_.radiusNow[1] = radius;
    for (const uint64_t generation : {clock_.younger() - 1, clock_.younger()})
        bear(generation, gas);
}

void GasDetail::follow(const GasView<const float>& gas, double seconds, base::Arena& scratch)
{
    const double shear = double(detail_.liveliness) * shearRate(gas) * seconds;
    const uint64_t born = clock_.advance(shear, seconds);
    const float radius = 0.5f * growth_ * medianSupport(gas, scratch);
    shared_.radiusNow[0] = shared_.radiusNow[1] = radius;
    for (uint64_t back = std::min<uint64_t>(born, 2); back > 0; --back)
        bear(clock_.younger() - (back - 1), gas);
}

void GasDetail::bear(uint64_t generation, const GasView<const float>& gas)
{
    shared_.radius[generation % 2] = shared_.radiusNow[0];
    for (uint32_t i = 0; i < gas.count; ++i)
        coordinates_.set(generation, gas.id[i], {gas.x[i], gas.y[i], gas.z[i]}); // (3)
}

void GasDetail::publish(base::KindId kind, uint32_t capacity, base::FrameSnapshot& snapshot) const
{
    DetailGenerations generations = shared_;
    generations.younger = clock_.younger();
    generations.fade = clock_.fade();
    base::SnapshotGroup& group = addMaterial(detail_, generations, kind, capacity, snapshot);
    const std::span<const uint64_t> ids = snapshot.editGroup(snapshot.addedCount() - 2).ids();
    std::copy(ids.begin(), ids.end(), group.editIds().begin());
    for (size_t c = 0; c < MaterialCoordinates::kColumns; ++c)
        std::ranges::copy(coordinates_.rows(c, group.count()), group.editColumn(c).begin());
}

void GasDetail::save(StateWriter& writer, uint32_t particles) const
{
    writer.value(clock_.younger());
    writer.value(clock_.fade());
    for (size_t g = 0; g < 2; ++g) {
        writer.value(shared_.radius[g]);
        writer.value(shared_.radiusNow[g]);
    }
    for (size_t c = 0; c < MaterialCoordinates::kColumns; ++c)
        writer.values(coordinates_.rows(c, particles));
}

void GasDetail::restore(StateReader& reader, uint32_t particles)
{
    const char* const kClock = "a gas's generation of detail is out of range";
    const char* const kRadius = "a gas's size of detail is out of range";
    const auto younger = reader.value<uint64_t>(1, uint64_t(1) << 40, kClock);
    clock_.set(younger, reader.value<double>(0.0, 1.0, kClock));
    for (size_t g = 0; g < 2; ++g) {
        shared_.radius[g] = reader.value<float>(1e-9f, 1e9f, kRadius);
        shared_.radiusNow[g] = reader.value<float>(1e-9f, 1e9f, kRadius);
    }
    for (size_t c = 0; c < MaterialCoordinates::kColumns; ++c)
        reader.values(coordinates_.rows(c, particles));
}

} // namespace fx::sim
