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
    return haveSameRows(a, b, columns) && base::sameBytes(a.ids(), b.ids()) &&
           base::sameBytes(a.constants(), b.constants());
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
        if (!find(*snapshots.older))
            remember(*snapshots.older, nullptr, ++last_);
        stamps.older = find(*snapshots.older)->stamp;
    }
    if (snapshots.newer) {
        if (!find(*snapshots.newer)) {
            const bool isSame = snapshots.older && holdSame(*snapshots.newer, *snapshots.older);
            remember(*snapshots.newer, snapshots.older, isSame ? stamps.older : ++last_);
        }
        stamps.newer = find(*snapshots.newer)->stamp;
    }
    return stamps;
}

SnapshotRowStamps SnapshotStamps::rowsOf(const base::FrameSnapshot& snapshot) const
{
    const Known* known = find(snapshot);
    return known ? known->rows.stamps() : SnapshotRowStamps{};
}

const SnapshotStamps::Known* SnapshotStamps::find(const base::FrameSnapshot& snapshot) const
{
    for (const Known& known : known_)
        if (known.snapshot == &snapshot && known.sequence == snapshot.sequence() &&
            known.tick == snapshot.tick())
            return &known;
    return nullptr;
}

void SnapshotStamps::remember(const base::FrameSnapshot& snapshot, const base::FrameSnapshot* older,
                              uint64_t stamp)
{
    const SnapshotRowStamps before = older ? rowsOf(*older) : SnapshotRowStamps{};
    if (&known_[next_] == (older ? find(*older) : nullptr))
        next_ = (next_ + 1) % known_.size(); // it has to stay for this frame
    Known& known = known_[next_];
    known.rows.build(snapshot, older, before, lastRows_);
    known.snapshot = &snapshot;
    known.sequence = snapshot.sequence();
    known.tick = snapshot.tick();
    known.stamp = stamp;
    next_ = (next_ + 1) % known_.size();
}

} // namespace fx::render
