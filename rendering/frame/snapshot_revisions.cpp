#include "rendering/frame/snapshot_revisions.h"

#include "foundation/memory/same_bytes.h"

namespace fx::render {

namespace {

bool samePlace(const base::Placement& a, const base::Placement& b)
{
    return a.position == b.position && a.rotation == b.rotation && a.scale == b.scale;
}

bool sameInfo(const base::GroupInfo& a, const base::GroupInfo& b)
{
    return base::nameOf(a) == base::nameOf(b) && a.count == b.count && samePlace(a.placement, b.placement) &&
           a.bounds.min == b.bounds.min && a.bounds.max == b.bounds.max;
}

bool sameGroup(const base::SnapshotGroup& a, const base::SnapshotGroup& b,
               std::span<const base::ColumnDesc> columns)
{
    if (a.program() != b.program() || !sameInfo(a.info(), b.info()))
        return false;
    if (a.info().isLate && b.info().isLate) // the rows follow from the groups before
        return base::sameBytes(a.constants(), b.constants());
    return haveSameRows(a, b, columns) && base::sameBytes(a.ids(), b.ids()) &&
           base::sameBytes(a.constants(), b.constants());
}

bool samePool(const base::PooledRows& a, const base::PooledRows& b, const base::SnapshotSchema& schema)
{
    const base::KindId kind = a.rows.info().kind;
    return kind == b.rows.info().kind && a.corner == b.corner &&
           base::sameBytes(a.rows.constants(), b.rows.constants()) &&
           haveSameRows(a, b, schema.kind(kind).columns);
}

/// Of pools that are the same.
bool sameEntry(const base::GroupRoster::Entry& a, const base::GroupRoster::Entry& b)
{
    return a.instance == b.instance && a.solver == b.solver && a.pool == b.pool && a.member == b.member &&
           samePlace(a.placement, b.placement);
}

} // namespace

bool holdSame(const base::FrameSnapshot& a, const base::FrameSnapshot& b)
{
    if (&a.schema() != &b.schema() || a.groupCount() != b.groupCount() || a.poolCount() != b.poolCount())
        return false;
    for (size_t p = 0; p < a.poolCount(); ++p)
        if (!samePool(a.pool(p), b.pool(p), a.schema()))
            return false;
    for (size_t g = 0; g < a.groupCount(); ++g) {
        const base::GroupRoster::Entry* const entry = a.pooled(g);
        const base::GroupRoster::Entry* const other = b.pooled(g);
        if (entry || other) {
            if (!entry || !other || !sameEntry(*entry, *other))
                return false;
        } else if (!sameGroup(a.unread(g), b.unread(g), a.schema().kind(a.name(g).kind).columns)) {
            return false;
        }
    }
    return true;
}

RevisionPair SnapshotRevisions::revisionsOf(const base::SnapshotPair& snapshots)
{
    RevisionPair revisions;
    if (snapshots.older) {
        if (!find(*snapshots.older))
            remember(*snapshots.older, nullptr, ++last_);
        revisions.older = find(*snapshots.older)->revision;
    }
    if (snapshots.newer) {
        if (!find(*snapshots.newer)) {
            const bool isSame = snapshots.older && holdSame(*snapshots.newer, *snapshots.older);
            remember(*snapshots.newer, snapshots.older, isSame ? revisions.older : ++last_);
        }
        revisions.newer = find(*snapshots.newer)->revision;
    }
    return revisions;
}

SnapshotRowRevisions SnapshotRevisions::rowsOf(const base::FrameSnapshot& snapshot) const
{
    const Known* known = find(snapshot);
    return known ? known->rows.revisions() : SnapshotRowRevisions{};
}

const SnapshotRevisions::Known* SnapshotRevisions::find(const base::FrameSnapshot& snapshot) const
{
    for (const Known& known : known_)
        if (known.snapshot == snapshot.serial())
            return &known;
    return nullptr;
}

void SnapshotRevisions::remember(const base::FrameSnapshot& snapshot, const base::FrameSnapshot* older,
                                 uint64_t revision)
{
    const SnapshotRowRevisions before = older ? rowsOf(*older) : SnapshotRowRevisions{};
    if (&known_[next_] == (older ? find(*older) : nullptr))
        next_ = (next_ + 1) % known_.size(); // it has to stay for this frame
    Known& known = known_[next_];
    rowIds_.clear();
    for (const base::KindDesc* kind : rowKinds_)
        rowIds_.push_back(snapshot.schema().find(kind->name));
    known.rows.build(snapshot, older, before, rowIds_, lastRows_);
    known.snapshot = snapshot.serial();
    known.revision = revision;
    next_ = (next_ + 1) % known_.size();
}

} // namespace fx::render
