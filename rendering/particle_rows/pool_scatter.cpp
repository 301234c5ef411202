#include "rendering/particle_rows/pool_scatter.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cstring>

namespace fx::render {

namespace column = base::particle_column;

namespace {

/// One column after the other, which also brings them near for rows that come in any order.
void clear(std::span<const base::ColumnDesc> columns, base::SnapshotGroup& out)
{
    for (size_t c = 0; c < columns.size(); ++c)
        if (out.has(c))
            std::memset(out.editColumn(c).data(), 0, out.count() * base::columnElementSize(columns[c].type));
}

} // namespace

PoolScatter::PoolScatter(std::pmr::memory_resource* memory)
    : first_(memory), targets_(memory), extents_(memory), moves_(memory), begin_(memory), ends_(memory),
      isSentTo_(memory)
{}

void PoolScatter::begin(const base::FrameSnapshot& snapshot, size_t groups)
{
    first_.clear();
    size_t members = 0;
    bool anyMoving = false;
    for (size_t p = 0; p < snapshot.poolCount(); ++p) {
        anyMoving = anyMoving || snapshot.pool(p).velocityColumn != 0;
        first_.push_back(members);
        members += snapshot.pool(p).counts.size();
    }
    first_.push_back(members);
    targets_.assign(members, Target{});
    extents_.assign(anyMoving ? members : 0, base::RowExtent{});
    begin_.resize(groups);
    ends_.resize(groups);
    isSentTo_.assign(groups, 0);
}

void PoolScatter::run(const base::FrameSnapshot& snapshot, std::span<base::SnapshotGroup* const> groups)
{
    uint32_t rows = 0;
    for (size_t g = 0; g < groups.size(); ++g) {
        begin_[g] = rows;
        rows += groups[g]->count();
        if (isSentTo_[g] != 0)
            clear(snapshot.schema().kind(groups[g]->info().kind).columns, *groups[g]);
    }
    moves_.resize(rows);
    for (size_t p = 0; p < snapshot.poolCount(); ++p) {
        const base::PooledRows& pool = snapshot.pool(p);
        const auto columns = snapshot.schema().kind(pool.rows.info().kind).columns;
        const std::span<const Target> targets(targets_.data() + first_[p], first_[p + 1] - first_[p]);
        const bool isMoving = pool.velocityColumn != 0;
        list(pool, targets, std::span(extents_).subspan(isMoving ? first_[p] : 0));
        for (uint32_t g = 0; g < groups.size(); ++g) {
            if (movesOf(g).empty())
                continue;
            move(pool, columns, g, *groups[g]);
            if (pool.rows.has(column::OrientationX))
                turn(pool, targets, g, *groups[g]);
        }
    }
}

/// Where each row goes.
void PoolScatter::list(const base::PooledRows& pool, std::span<const Target> targets,
                       std::span<base::RowExtent> extents)
{
    std::ranges::copy(begin_, ends_.begin());
    const bool isMoving = pool.velocityColumn != 0;
    pool.forEachRow([&](uint32_t row) {
        const Target& target = targets[pool.memberOf(row)];
        if (pool.placeOf(row) >= target.rows)
            return;
        moves_[ends_[target.group]++] = {row, target.firstRow + pool.placeOf(row)};
        if (isMoving)
            pool.measure(row, extents[pool.memberOf(row)]);
    });
}

void PoolScatter::move(const base::PooledRows& pool, std::span<const base::ColumnDesc> columns,
                       uint32_t group, base::SnapshotGroup& out) const
{
    const std::span<const Move> moves = movesOf(group);
    const auto copy = [moves](const auto* from, auto* to) {
        for (const Move& row : moves)
            to[row.to] = from[row.from];
    };
    for (size_t c = 0; c < columns.size(); ++c) {
        const bool isOrientation = c >= column::OrientationX && c <= column::OrientationW;
        if (!pool.rows.has(c) || isOrientation)
            continue;
        const float* const from = pool.rows.start(c);
        if (columns[c].type == base::ColumnType::U64)
            copy(reinterpret_cast<const uint64_t*>(from), out.editColumn64(c).data());
        else
            copy(from, out.editColumn(c).data());
    }
}

/// Orientations, into the axes of the world.
void PoolScatter::turn(const base::PooledRows& pool, std::span<const Target> targets, uint32_t group,
                       base::SnapshotGroup& out) const
{
    for (const Move& row : movesOf(group)) {
        const auto at = [&](size_t a) { return pool.rows.start(column::OrientationX + a)[row.from]; };
        const glm::quat& rotation = targets[pool.memberOf(row.from)].entry->placement.rotation;
        const glm::quat turned = rotation * glm::quat(at(3), at(0), at(1), at(2));
        const float values[] = {turned.x, turned.y, turned.z, turned.w};
        for (size_t a = 0; a < 4; ++a)
            out.editColumn(column::OrientationX + a)[row.to] = values[a];
    }
}

} // namespace fx::render
