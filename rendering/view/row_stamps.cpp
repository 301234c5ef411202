#include "rendering/view/row_stamps.h"

#include "foundation/math/hash.h"
#include "foundation/memory/same_bytes.h"
#include "foundation/snapshot/particle_kind.h"
#include "rendering/view/snapshot_match.h"

#include <algorithm>
#include <bit>

namespace fx::render {

namespace {

constexpr uint32_t kEmpty = ~0u;
constexpr size_t kMostTries = 16; ///< groups that a group is compared with before it counts as unlike all

bool hasRows(const base::FrameSnapshot& snapshot, const base::SnapshotGroup& group)
{
    const base::KindId kind = group.info().kind;
    return !group.program() && group.count() > 0 &&
           (kind == snapshot.schema().find(base::kParticleKind.name) ||
            kind == snapshot.schema().find(base::kRibbonKind.name));
}

/// Of a few rows: different for nearly all groups that differ.
uint64_t sampleOf(const base::SnapshotGroup& group)
{
    uint64_t hash = base::hashWord(group.info().kind, group.count());
    for (const size_t c : {0, 1, 2, 3}) // place, and age or width
        for (const size_t row : {size_t(0), group.count() / size_t(2), group.count() - size_t(1)})
            if (group.has(c))
                hash = base::hashWord(hash, std::bit_cast<uint32_t>(group.column(c)[row]));
    return hash;
}

} // namespace

bool haveSameRows(const base::SnapshotGroup& a, const base::SnapshotGroup& b,
                  std::span<const base::ColumnDesc> columns)
{
    if (a.info().kind != b.info().kind || a.count() != b.count())
        return false;
    for (size_t c = 0; c < columns.size(); ++c) {
        if (a.has(c) != b.has(c))
            return false;
        const bool isWide = columns[c].type == base::ColumnType::U64;
        if (isWide ? !base::sameBytes(a.column64(c), b.column64(c))
                   : !base::sameBytes(a.column(c), b.column(c)))
            return false;
    }
    return true;
}

uint64_t RowStamps::stampOf(const base::FrameSnapshot& newer, size_t g, const base::FrameSnapshot* older,
                            uint64_t& ioLast) const
{
    const base::SnapshotGroup& group = newer.group(g);
    const size_t same = before_.empty() ? kNoGroup : findSameGroup(older, group.info(), g);
    if (same == kNoGroup || before_[same].stamp == 0 ||
        !haveSameRows(group, older->group(same), newer.schema().kind(group.info().kind).columns))
        return ++ioLast;
    return before_[same].stamp;
}

/// The first group with the same rows gives its stamp to the others.
void RowStamps::findAlike(const base::FrameSnapshot& snapshot, size_t g)
{
    const base::SnapshotGroup& group = snapshot.group(g);
    const auto columns = snapshot.schema().kind(group.info().kind).columns;
    const size_t mask = table_.size() - 1;
    size_t at = sampleOf(group) & mask;
    for (size_t tried = 0; tried < kMostTries; ++tried, at = (at + 1) & mask) {
        if (table_[at] == kEmpty) {
            table_[at] = uint32_t(g);
            return;
        }
        const size_t other = table_[at];
        if (parts_[other].stamp != parts_[g].stamp && !haveSameRows(snapshot.group(other), group, columns))
            continue;
        alike_[g] = uint32_t(other);
        parts_[g].stamp = parts_[other].stamp;
        return;
    }
}

void RowStamps::build(const base::FrameSnapshot& newer, const base::FrameSnapshot* older,
                      const SnapshotRowStamps& before, uint64_t& ioLast)
{
    before_.assign(before.parts.begin(), before.parts.end()); // they may be these
    const size_t count = newer.groupCount();
    parts_.resize(count);
    alike_.resize(count);
    table_.assign(std::bit_ceil(2 * count + 1), kEmpty);
    for (size_t g = 0; g < count; ++g) {
        const base::SnapshotGroup& group = newer.group(g);
        parts_[g] = {0, group.count(), 0};
        alike_[g] = uint32_t(g);
        if (!hasRows(newer, group))
            continue;
        parts_[g].stamp = stampOf(newer, g, older, ioLast);
        findAlike(newer, g);
    }
}

} // namespace fx::render
