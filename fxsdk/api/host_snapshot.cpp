#include "fxsdk/api/host_snapshot.h"

#include "foundation/snapshot/particle_kind.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

namespace fx::api {

namespace {

using base::ColumnDesc;
using base::ColumnType;
using base::SnapshotGroup;

/// Whether the names of `count` neighbors differ only in their last letter, which is x, y, z or w.
bool areComponents(std::span<const ColumnDesc> descs, size_t index, size_t count)
{
    if (index + count > descs.size())
        return false;
    const std::string_view first = descs[index].name;
    for (size_t i = 0; i < count; ++i) {
        const std::string_view name = descs[index + i].name;
        const char letter = "xyzw"[i];
        const bool isLast = !name.empty() && (name.back() == letter || name.back() == letter - 'a' + 'A');
        if (!isLast || name.substr(0, name.size() - 1) != first.substr(0, first.size() - 1))
            return false;
    }
    return true;
}

/// Length of a vector of components that begins at `index`; 1 for others.
size_t componentsAt(std::span<const ColumnDesc> descs, size_t index)
{
    switch (meaningOf(descs, index)) {
    case Meaning::Vector:
    case Meaning::Direction:
        return 3;
    case Meaning::Quaternion:
        return 4;
    default:
        return 1;
    }
}

/// Converts the values of one element, or of a group's constants. @param io one for each component
void convert(const HostWorld& world, Meaning meaning, const std::array<float*, 4>& io)
{
    float out[4];
    switch (meaning) {
    case Meaning::Number:
        return;
    case Meaning::Length:
        *io[0] = world.fromMeters(*io[0]);
        return;
    case Meaning::Area:
        *io[0] = world.fromMeters(world.fromMeters(*io[0]));
        return;
    case Meaning::Vector:
        world.writeVector({*io[0], *io[1], *io[2]}, out);
        break;
    case Meaning::Direction:
        world.writeDirection({*io[0], *io[1], *io[2]}, out);
        break;
    case Meaning::Quaternion:
        world.writeRotation({*io[3], *io[0], *io[1], *io[2]}, out);
        *io[3] = out[3];
        break;
    }
    for (size_t i = 0; i < 3; ++i)
        *io[i] = out[i];
}

void convertColumns(const HostWorld& world, std::span<const ColumnDesc> descs, SnapshotGroup& io)
{
    for (size_t c = 0; c < descs.size();) {
        const size_t width = componentsAt(descs, c);
        const Meaning meaning = meaningOf(descs, c);
        if (meaning != Meaning::Number && io.has(c)) {
            std::array<std::span<float>, 4> columns;
            for (size_t i = 0; i < width; ++i)
                columns[i] = io.editColumn(c + i);
            for (size_t row = 0; row < io.count(); ++row) {
                std::array<float*, 4> place{};
                for (size_t i = 0; i < width; ++i)
                    place[i] = &columns[i][row];
                convert(world, meaning, place);
            }
        }
        c += width;
    }
}

void convertConstants(const HostWorld& world, std::span<const ColumnDesc> descs, std::span<float> io)
{
    for (size_t c = 0; c < descs.size();) {
        const size_t width = componentsAt(descs, c);
        std::array<float*, 4> place{};
        for (size_t i = 0; i < width; ++i)
            place[i] = &io[c + i];
        convert(world, meaningOf(descs, c), place);
        c += width;
    }
}

/// Rows that are computed late are computed here.
SnapshotGroup& copyGroup(const SnapshotGroup& from, const base::KindDesc& kind, base::FrameSnapshot& out)
{
    SnapshotGroup& to = out.addGroup(from.info().kind, from.count(), from.present());
    to.editInfo() = from.info();
    std::copy(from.constants().begin(), from.constants().end(), to.editConstants().begin());
    std::copy(from.ids().begin(), from.ids().end(), to.editIds().begin());
    for (size_t c = 0; c < kind.columns.size(); ++c) {
        if (!from.has(c))
            continue;
        if (kind.columns[c].type == ColumnType::F32)
            std::copy(from.column(c).begin(), from.column(c).end(), to.editColumn(c).begin());
        else
            std::copy(from.column64(c).begin(), from.column64(c).end(), to.editColumn64(c).begin());
    }
    return to;
}

/// A ribbon whose texture covers the whole strip has shares of its length in place of lengths.
void keepShares(const SnapshotGroup& from, const base::KindDesc& kind, SnapshotGroup& io)
{
    if (!(kind == base::kRibbonKind) || from.constants()[base::particle_constant::ArcPerTile] != 0.0f)
        return;
    const std::span<const float> arcs = from.column(base::ribbon_column::Arc);
    std::copy(arcs.begin(), arcs.end(), io.editColumn(base::ribbon_column::Arc).begin());
}

} // namespace

Meaning meaningOf(std::span<const ColumnDesc> descs, size_t index)
{
    const ColumnDesc& desc = descs[index];
    if (desc.type != ColumnType::F32)
        return Meaning::Number;
    if (areComponents(descs, index, 4))
        return Meaning::Quaternion;
    if (areComponents(descs, index, 3))
        return desc.unit == "1" ? Meaning::Direction : Meaning::Vector;
    if (desc.unit == "m2")
        return Meaning::Area;
    return desc.unit == "m" ? Meaning::Length : Meaning::Number;
}

std::unique_ptr<base::FrameSnapshot> toHostWorld(const HostWorld& world, const base::FrameSnapshot& snapshot,
                                                 std::pmr::memory_resource* memory)
{
    auto out = std::make_unique<base::FrameSnapshot>(&snapshot.schema(), memory);
    out->begin(snapshot.tick(), snapshot.sequence(), snapshot.step());
    for (size_t g = 0; g < snapshot.groupCount(); ++g) {
        const SnapshotGroup& group = snapshot.group(g);
        const base::KindDesc& kind = snapshot.schema().kind(group.info().kind);
        SnapshotGroup& copy = copyGroup(group, kind, *out);
        convertColumns(world, kind.columns, copy);
        convertConstants(world, kind.constants, copy.editConstants());
        keepShares(group, kind, copy);
        copy.editInfo().bounds = world.bounds(group.info().bounds);
    }
    return out;
}

} // namespace fx::api
