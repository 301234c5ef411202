#include "rendering/frame/row_revisions.h"

#include "foundation/math/hash.h"
#include "foundation/memory/same_bytes.h"
#include "rendering/frame/snapshot_match.h"

#include <algorithm>
#include <bit>

namespace fx::render {

namespace {

constexpr uint32_t kEmpty = ~0u;
constexpr size_t kMaxTries = 16; ///< groups that a group is compared with before it counts as unlike all

bool hasRows(const base::SnapshotGroup& group, std::span<const base::KindId> kinds)
{
    return !group.program() && group.count() > 0 &&
           std::find(kinds.begin(), kinds.end(), group.info().kind) != kinds.end();
}

template <class T>
bool sameRange(const T* a, const T* b, const base::PooledRows::Range& range)
{
    const size_t count = range.end - range.begin;
    return base::sameBytes(std::span(a + range.begin, count), std::span(b + range.begin, count));
}

bool sameRange(const base::PooledRows::Range& a, const base::PooledRows::Range& b)
{
    return a.begin == b.begin && a.end == b.end;
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

bool haveSameRows(const base::PooledRows& a, const base::PooledRows& b,
                  std::span<const base::ColumnDesc> columns)
{
    if (a.writer == 0 || a.writer != b.writer || a.writtenUpTo != b.writtenUpTo ||
        a.rows.present() != b.rows.present() || !sameRange(a.used[0], b.used[0]) ||
        !sameRange(a.used[1], b.used[1]) || !base::sameBytes(std::span(a.counts), std::span(b.counts)))
        return false;
    for (const base::PooledRows::Range& range : a.used)
        for (size_t c = 0; c < columns.size(); ++c) {
            const float* const left = a.rows.start(c);
            const float* const right = b.rows.start(c);
            if (a.rows.has(c) && !(columns[c].type == base::ColumnType::U64
                                       ? sameRange(reinterpret_cast<const uint64_t*>(left),
                                                   reinterpret_cast<const uint64_t*>(right), range)
                                       : sameRange(left, right, range)))
                return false;
        }
    return true;
}

void SamePools::build(const base::FrameSnapshot& newer, const base::FrameSnapshot* older)
{
    same_.assign(newer.poolCount(), kNone);
    for (size_t p = 0; older && p < newer.poolCount(); ++p) {
        const base::PooledRows& pool = newer.pool(p);
        const auto columns = newer.schema().kind(pool.rows.info().kind).columns;
        for (size_t q = 0; q < older->poolCount() && same_[p] == kNone; ++q)
            if (haveSameRows(pool, older->pool(q), columns))
                same_[p] = uint32_t(q);
    }
}

uint64_t RowRevisions::revisionOf(const base::FrameSnapshot& newer, size_t g,
                                  const base::FrameSnapshot* older, uint64_t& ioLast) const
{
    const base::GroupName name = newer.name(g);
    const size_t same = before_.empty() ? kNoGroup : findSameGroup(older, newer, g);
    if (same == kNoGroup || before_[same].revision == 0)
        return ++ioLast;
    const base::GroupRoster::Entry* const entry = newer.pooled(g);
    const base::GroupRoster::Entry* const before = older->pooled(same);
    const bool isSame = entry || before ? entry && before && pools_.holdSame(*entry, *before)
                                        : haveSameRows(newer.group(g), older->group(same),
                                                       newer.schema().kind(name.kind).columns);
    return isSame ? before_[same].revision : ++ioLast;
}

/// The first group with the same rows gives its revision to the others. Those of pools are not compared.
void RowRevisions::findAlike(const base::FrameSnapshot& snapshot, size_t g)
{
    const base::SnapshotGroup& group = snapshot.group(g);
    const auto columns = snapshot.schema().kind(group.info().kind).columns;
    const size_t mask = table_.size() - 1;
    size_t at = sampleOf(group) & mask;
    for (size_t tried = 0; tried < kMaxTries; ++tried, at = (at + 1) & mask) {
        if (table_[at] == kEmpty) {
            table_[at] = uint32_t(g);
            return;
        }
        const size_t other = table_[at];
        if (parts_[other].revision != parts_[g].revision &&
            !haveSameRows(snapshot.group(other), group, columns))
            continue;
        alike_[g] = uint32_t(other);
        parts_[g].revision = parts_[other].revision;
        return;
    }
}

void RowRevisions::build(const base::FrameSnapshot& newer, const base::FrameSnapshot* older,
                         const SnapshotRowRevisions& before, std::span<const base::KindId> kinds,
                         uint64_t& ioLast)
{
    before_.assign(before.parts.begin(), before.parts.end()); // they may be these
    const size_t count = newer.groupCount();
    parts_.resize(count);
    alike_.resize(count);
    table_.assign(std::bit_ceil(2 * count + 1), kEmpty);
    pools_.build(newer, before_.empty() ? nullptr : older);
    for (size_t g = 0; g < count; ++g) {
        alike_[g] = uint32_t(g);
        if (const base::GroupRoster::Entry* const entry = newer.pooled(g)) {
            const uint32_t rows = newer.pool(entry->pool).counts[entry->member];
            parts_[g] = {0, rows, rows > 0 ? revisionOf(newer, g, older, ioLast) : 0};
            continue;
        }
        const base::SnapshotGroup& group = newer.unread(g);
        parts_[g] = {0, group.count(), 0};
        if (!hasRows(group, kinds))
            continue;
        parts_[g].revision = revisionOf(newer, g, older, ioLast);
        findAlike(newer, g);
    }
}

} // namespace fx::render
