#include "rendering/view/snapshot_stamps.h"

#include "foundation/memory/same_bytes.h"

namespace fx::render {

namespace {

bool samePlace(const base::GroupInfo& a, const base::GroupInfo& b)
{
    return a.placement.position == b.placement.position && a.placement.rotation == b.placement.rotation &&
           a.placement.scale == b.placement.scale && a.bounds.min == b.bounds.min &&
           a.bounds.max == b.bounds.max;
}

bool sameGroup(const base::SnapshotGroup& a, const base::SnapshotGroup& b,
               std::span<const base::ColumnDesc> columns)
{
    const base::GroupInfo& info = a.info();
    const base::GroupInfo& other = b.info();
    if (info.kind != other.kind || info.instance != other.instance || info.solver != other.solver ||
        info.count != other.count || a.program() != b.program() || !samePlace(info, other))
        return false;
    for (size_t c = 0; c < columns.size(); ++c) {
        if (a.has(c) != b.has(c))
            return false;
        const bool isWide = columns[c].type == base::ColumnType::U64;
        if (isWide ? !base::sameBytes(a.column64(c), b.column64(c))
                   : !base::sameBytes(a.column(c), b.column(c)))
            return false;
    }
    return base::sameBytes(a.ids(), b.ids()) && base::sameBytes(a.constants(), b.constants());
}

} // namespace

bool holdSame(const base::FrameSnapshot& a, const base::FrameSnapshot& b)
{
    if (&a.schema() != &b.schema() || a.groupCount() != b.groupCount())
        return false;
    for (size_t g = 0; g < a.groupCount(); ++g)
        if (!sameGroup(a.group(g), b.group(g), a.schema().kind(a.group(g).info().kind).columns))
            return false;
    return true;
}

StampPair SnapshotStamps::stampsOf(const base::SnapshotPair& snapshots)
{
    StampPair stamps;
    if (snapshots.older) {
        stamps.older = find(*snapshots.older);
        if (stamps.older == 0)
            remember(*snapshots.older, stamps.older = ++last_);
    }
    if (snapshots.newer) {
        stamps.newer = find(*snapshots.newer);
        if (stamps.newer == 0) {
            const bool isSame = snapshots.older && holdSame(*snapshots.newer, *snapshots.older);
            remember(*snapshots.newer, stamps.newer = isSame ? stamps.older : ++last_);
        }
    }
    return stamps;
}

uint64_t SnapshotStamps::find(const base::FrameSnapshot& snapshot) const
{
    for (const Known& known : known_)
        if (known.snapshot == &snapshot && known.sequence == snapshot.sequence() &&
            known.tick == snapshot.tick())
            return known.stamp;
    return 0;
}

void SnapshotStamps::remember(const base::FrameSnapshot& snapshot, uint64_t stamp)
{
    known_[next_] = {&snapshot, snapshot.sequence(), snapshot.tick(), stamp};
    next_ = (next_ + 1) % known_.size();
}

} // namespace fx::render
