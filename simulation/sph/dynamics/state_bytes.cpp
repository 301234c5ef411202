#include "simulation/sph/dynamics/gas_operations.h"

#include "foundation/math/bits.h"
#include "foundation/math/hash.h"
#include "simulation/sph/dynamics/neighborhood.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>

namespace fx::sim {

namespace {

constexpr uint64_t kMagic = 0x32736e7964584653u; ///< "SFXdyns2"

struct Header
{
    uint64_t magic;
    uint64_t definition; ///< hash of what must be equal
    uint64_t hash;       ///< of the bytes after the header
    double pressureScale, soundScale;
    double smallestSupport, largestSupport; ///< [m] of the density rules
    uint32_t count;
    uint32_t delayed;
    uint32_t fresh, stale, shaken, treeIsSorted;
    double listMargin, listMoved, listGrowth, listPerStep; ///< of ListState; margin < 0: not valid
};

uint64_t hashDefinition(const GasDynamicsDef& def, size_t elementSize)
{
    const double numbers[] = {double(def.kernel),
                              def.neighbors,
                              def.state.gamma,
                              def.state.stiffness,
                              def.state.jwlA,
                              def.state.jwlB,
                              def.state.jwlR1,
                              def.state.jwlR2,
                              def.state.referenceDensity,
                              def.viscosity.alphaMin,
                              def.viscosity.alphaMax,
                              def.viscosity.decay,
                              def.viscosity.beta,
                              def.viscosity.conductivity,
                              double(def.viscosity.limiter),
                              double(def.steps),
                              def.courant,
                              def.volumeChange,
                              def.neighborStepRatio,
                              def.domain.low.x,
                              def.domain.low.y,
                              def.domain.low.z,
                              def.domain.high.x,
                              def.domain.high.y,
                              def.domain.high.z,
                              double(def.domain.axes[0]),
                              double(def.domain.axes[1]),
                              double(def.domain.axes[2]),
                              def.gravity.x,
                              def.gravity.y,
                              def.gravity.z,
                              def.ambientPressure,
                              double(def.tension),
                              double(def.exact),
                              double(elementSize)};
    return base::hashBytes(0, numbers, sizeof(numbers));
}

void append(std::vector<std::byte>& out, const void* data, size_t size)
{
    const size_t at = out.size();
    out.resize(at + size);
    if (size > 0)
        std::memcpy(out.data() + at, data, size);
}

/// What tree and lists are made of.
template <class T>
std::array<base::Column<T>*, 8> treeColumns(DynamicsState<T>& s)
{
    return {&s.sortedX, &s.sortedY, &s.sortedZ, &s.sortedSupport,
            &s.listX,   &s.listY,   &s.listZ,   &s.listSupport};
}

/// Calls f(data, size) for every array that the bytes hold.
template <class T, class F>
void forEachArray(DynamicsState<T>& s, F&& f)
{
    const size_t count = s.count;
    s.gas.forEachLasting([&](auto& column) { f(column.data(), count * sizeof(column[0])); });
    for (base::Column<T>* column : treeColumns(s))
        f(column->data(), count * sizeof(T));
    f(s.delayed.data(), s.delayed.size() * sizeof(DelayedHeat));
}

} // namespace

template <class T>
void saveState(const DynamicsState<T>& state, std::vector<std::byte>& out)
{
    DynamicsState<T>& s = const_cast<DynamicsState<T>&>(state); // only read
    Header header{};
    header.magic = kMagic;
    header.definition = hashDefinition(s.def, sizeof(T));
    header.pressureScale = s.pressureScale;
    header.soundScale = s.soundScale;
    header.smallestSupport = s.densityRules.smallestSupport;
    header.largestSupport = s.densityRules.largestSupport;
    header.count = s.count;
    header.delayed = uint32_t(s.delayed.size());
    header.fresh = s.fresh;
    header.stale = s.stale;
    header.treeIsSorted = treeIsGood(s) || s.mustRecoverTree;
    header.shaken = s.shaken;
    const ListState& lists = s.listState;
    header.listMargin = header.treeIsSorted && lists.valid ? lists.margin : -1.0;
    header.listMoved = lists.moved;
    header.listGrowth = lists.growth;
    header.listPerStep = lists.perStep;
    const size_t start = out.size();
    append(out, &header, sizeof(header));
    forEachArray(s, [&out](const void* data, size_t size) { append(out, data, size); });
    header.hash =
        base::hashBytes(0, out.data() + start + sizeof(header), out.size() - start - sizeof(header));
    std::memcpy(out.data() + start, &header, sizeof(header));
}

namespace {

/// Whether the arrays of a state with this header are as long as what follows it.
template <class T>
bool fitsInto(DynamicsState<T>& s, const Header& header, size_t size)
{
    const auto isScale = [](double x) { return x > 0 && x <= 1; };
    const auto isLength = [](double x) { return x >= 0 && x <= 1e30; };
    if (!isScale(header.pressureScale) || !isScale(header.soundScale) || !isLength(header.smallestSupport) ||
        !isLength(header.largestSupport) || !isLength(header.listMoved) || !isLength(header.listGrowth) ||
        !isLength(header.listPerStep) || !(header.listMargin <= 1) ||
        header.delayed > size / sizeof(DelayedHeat))
        return false;
    const uint32_t count = s.count;
    const size_t delayed = s.delayed.size();
    s.count = header.count;
    s.delayed.resize(header.delayed);
    size_t wanted = 0;
    forEachArray(s, [&wanted](void*, size_t part) { wanted += part; });
    s.count = count;
    s.delayed.resize(std::min(delayed, s.delayed.size()));
    return wanted == size;
}

/// Whether what has been read can be stepped: every id once, finite numbers, masses.
template <class T>
bool isPlausible(DynamicsState<T>& s)
{
    bool ok = true;
    s.gas.forEachLasting([&](auto& column) {
        if constexpr (std::is_floating_point_v<std::remove_reference_t<decltype(column[0])>>)
            for (uint32_t i = 0; i < s.count; ++i)
                ok = ok && base::isFinite(column[i]);
    });
    for (const base::Column<T>* column : treeColumns(s))
        for (uint32_t i = 0; i < s.count; ++i)
            ok = ok && base::isFinite((*column)[i]);
    for (uint32_t i = 0; i < s.count; ++i)
        s.slot[i] = s.count;
    for (uint32_t i = 0; ok && i < s.count; ++i) {
        const uint32_t id = s.gas.id[i];
        ok = id < s.count && s.slot[id] == s.count && s.gas.mass[i] > 0 && s.gas.entropy[i] >= 0 &&
             s.gas.support[i] >= 0;
        if (ok)
            s.slot[id] = i;
    }
    for (const DelayedHeat& heat : s.delayed)
        ok = ok && heat.id < s.count && base::isFinite(heat.seconds) && base::isFinite(heat.joules);
    return ok;
}

} // namespace

template <class T>
base::Status restoreState(DynamicsState<T>& s, std::span<const std::byte> bytes)
{
    const auto refuse = [](const char* why) { return base::Status(base::Code::InvalidArgument, why); };
    Header header;
    if (bytes.size() < sizeof(header))
        return refuse("gas state: too short");
    std::memcpy(&header, bytes.data(), sizeof(header));
    if (header.magic != kMagic || header.definition != hashDefinition(s.def, sizeof(T)))
        return refuse("gas state: saved from another definition");
    if (header.count > s.def.capacity)
        return base::Status(base::Code::Capacity, "gas state: more particles than this gas can hold");
    if (header.hash != base::hashBytes(0, bytes.data() + sizeof(header), bytes.size() - sizeof(header)))
        return refuse("gas state: damaged");
    if (!fitsInto(s, header, bytes.size() - sizeof(header)))
        return refuse("gas state: its parts do not fit together");
    s.pressureScale = header.pressureScale;
    s.soundScale = header.soundScale;
    s.densityRules.smallestSupport = header.smallestSupport;
    s.densityRules.largestSupport = header.largestSupport;
    s.count = header.count;
    s.delayed.resize(header.delayed);
    s.fresh = header.fresh != 0;
    s.stale = header.stale != 0;
    s.shaken = header.shaken != 0;
    const std::byte* from = bytes.data() + sizeof(header);
    forEachArray(s, [&from](void* data, size_t size) {
        if (size > 0)
            std::memcpy(data, from, size);
        from += size;
    });
    if (!isPlausible(s)) {
        s.count = 0;
        s.delayed.clear();
        s.treeIsSorted = s.mustRecoverTree = false;
        s.listState = {};
        return refuse("gas state: impossible values");
    }
    for (uint32_t i = 0; i < s.count; ++i) {
        s.slot[s.gas.id[i]] = i;
        s.gas.begin[i] = s.gas.end[i] = s.gas.drifted[i] = 0;
        s.gas.level[i] = 0;
    }
    s.treeIsSorted = false;
    s.mustRecoverTree = header.treeIsSorted != 0;
    s.listState = {s.mustRecoverTree && header.listMargin >= 0, std::max(header.listMargin, 0.0),
                   header.listMoved, header.listGrowth, header.listPerStep};
    return {};
}

template void saveState<float>(const DynamicsState<float>&, std::vector<std::byte>&);
template void saveState<double>(const DynamicsState<double>&, std::vector<std::byte>&);
template base::Status restoreState<float>(DynamicsState<float>&, std::span<const std::byte>);
template base::Status restoreState<double>(DynamicsState<double>&, std::span<const std::byte>);

} // namespace fx::sim
