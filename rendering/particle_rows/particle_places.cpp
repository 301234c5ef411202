// Where rows lie in the buffers of a place, and what is written there.
#include "foundation/snapshot/gpu_particles.h"
#include "rendering/frame/snapshot_match.h"
#include "rendering/gl/gl_device.h"
#include "rendering/particle_rows/particle_buffers.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace fx::render {

namespace {

uint64_t roundUp(uint64_t value, uint64_t step)
{
    return (value + step - 1) / step * step;
}

/// Whether a row goes on with the strip of the row before is in its color, by the sign of its opacity.
void writeRibbonColors(const base::SnapshotGroup& group, const RowRevision& part, std::byte* out)
{
    constexpr uint64_t kGoesOn = uint64_t(1) << 63;
    const auto colors = group.column64(base::ribbon_column::Color);
    const auto strips = group.column64(base::ribbon_column::Strip);
    for (size_t i = part.first; i < size_t(part.first) + part.count; ++i) {
        const bool goesOn = i > 0 && strips[i] == strips[i - 1];
        const uint64_t words = (colors[i] & ~kGoesOn) | (goesOn ? kGoesOn : 0);
        std::memcpy(out + i * sizeof words, &words, sizeof words);
    }
}

/// Rows of a group: some more than it has, so that others stay where they are when it grows.
uint64_t roomFor(uint64_t rows)
{
    return roundUp(rows, std::max<uint64_t>(std::bit_floor(rows) / 8, 16));
}

/// [byte] a row of the columns that are uploaded.
uint64_t rowBytes(std::span<const base::ColumnDesc> columns, const RowPlaces& places, bool isPacked)
{
    if (isPacked)
        return packedRowBytes(places);
    uint64_t bytes = 0;
    for (size_t c = 0; c < std::min(columns.size(), places.size()); ++c)
        bytes += places[c] >= 0 ? base::columnElementSize(columns[c].type) : 0;
    return bytes;
}

std::span<const RowRevision> partsOf(const SnapshotRowRevisions& rows, size_t group, const RowRevision& whole)
{
    return rows.parts.empty() ? std::span(&whole, 1) : rows.of(group);
}

} // namespace

size_t ParticleBuffers::olderOf(size_t group) const
{
    return group < older_.size() ? older_[group] : kNoGroup;
}

bool ParticleBuffers::isAlike(const Source& source, size_t group) const
{
    const size_t first = source.rows.alikeOf(group);
    if (first == group || !source.older)
        return first != group;
    const size_t before = olderOf(group);
    const size_t firstBefore = olderOf(first);
    if (before == kNoGroup || firstBefore == kNoGroup)
        return before == firstBefore;
    return source.olderRows.alikeOf(before) == source.olderRows.alikeOf(firstBefore);
}

/// Of rows that are not packed.
void ParticleBuffers::layOutRows(const base::SnapshotGroup& group, const RowTechnique& technique,
                                 GroupPlace& out) const
{
    const base::GpuParticleProgram* program = group.program().get();
    const std::span<const base::ColumnDesc> columns = technique.columns;
    out.columns.fill(-1);
    uint64_t words = 0;
    for (size_t c = 0; c < std::min(columns.size(), out.columns.size()); ++c) {
        const bool isThere = program ? (program->features.columns >> c & 1) != 0 : group.has(c);
        if (!isThere || !(technique.drawnColumns >> c & 1))
            continue;
        out.columns[c] = int32_t(words);
        words += roundUp(roomFor(technique.rows(group)) * base::columnElementSize(columns[c].type) / 4, 16);
    }
    out.bytes = words * 4;
}

ParticleBuffers::Sizes ParticleBuffers::layOut(const Source& source, std::pmr::vector<GroupPlace>& out) const
{
    const base::FrameSnapshot& snapshot = *source.snapshot;
    const auto alignment = uint64_t(std::max(device_.limits().storageAlignment, 64));
    Sizes end;
    out.assign(snapshot.groupCount(), GroupPlace{});
    const RowTechniques techniques(techniques_, snapshot.schema());
    for (size_t g = 0; g < snapshot.groupCount(); ++g) {
        const RowTechnique* technique = techniques.of(snapshot.name(g).kind);
        if (!technique || (snapshot.pooled(g) && !source.withPools) || (technique->isComputed && refusesGpu_))
            continue;
        const base::SnapshotGroup& group = snapshot.group(g);
        const base::GpuParticleProgram* program = group.program().get();
        GroupPlace& place = out[g];
        if (isAlike(source, g)) {
            place = out[source.rows.alikeOf(g)];
            place.isShared = true;
            continue;
        }
        place.isComputed = program != nullptr;
        if (program) {
            place.wordsOffset = roundUp(end.mapped, alignment);
            place.wordsBytes = group.column64(0).size_bytes();
            end.mapped = place.wordsOffset + place.wordsBytes;
        }
        uint64_t& rowsEnd = program ? end.computed : end.mapped;
        place.offset = roundUp(rowsEnd, alignment);
        place.isPacked = !technique->isComputed && !technique->isStrip;
        if (place.isPacked)
            place.bytes = layOutPacked(group, roomFor(technique->rows(group)), place.columns) * 4;
        else
            layOutRows(group, *technique, place);
        rowsEnd = place.offset + place.bytes;
    }
    return end;
}

void ParticleBuffers::write(const Source& source, Place& place)
{
    const base::FrameSnapshot& snapshot = *source.snapshot;
    auto before = place.groupsBefore.begin(); // both lie by rising offsets
    const auto isOfRows = [](const GroupPlace& at) { return at.bytes > 0 && !at.isComputed && !at.isShared; };
    for (size_t g = 0; g < place.groups.size(); ++g) {
        GroupPlace& at = place.groups[g];
        if ((at.bytes == 0 && !at.isComputed) || wanted_[g] == 0 || at.isWritten)
            continue;
        at.isWritten = true;
        const base::SnapshotGroup& group = snapshot.group(g);
        if (at.isComputed) {
            std::memcpy(place.buffer.data() + at.wordsOffset, group.column64(0).data(), at.wordsBytes);
            uploadedBytes_ += at.wordsBytes;
            continue;
        }
        const auto columns = snapshot.schema().kind(group.info().kind).columns;
        if (at.isShared)
            sharedBytes_ += group.count() * rowBytes(columns, at.columns, at.isPacked);
        if (!isOfRows(at))
            continue;
        while (before != place.groupsBefore.end() && (!isOfRows(*before) || before->offset < at.offset))
            ++before;
        const bool isSame = before != place.groupsBefore.end() && before->offset == at.offset &&
                            before->bytes == at.bytes && before->columns == at.columns &&
                            before->isPacked == at.isPacked;
        writeRows(source, g, isSame ? &*before : nullptr, place);
    }
}

void ParticleBuffers::writeRows(const Source& source, size_t index, const GroupPlace* before, Place& place)
{
    const base::SnapshotGroup& group = source.snapshot->group(index);
    GroupPlace& at = place.groups[index];
    const uint64_t bytesOfRow =
        rowBytes(source.snapshot->schema().kind(group.info().kind).columns, at.columns, at.isPacked);
    at.rowsBegin = place.rows.size();
    auto held =
        before ? place.rowsBefore.begin() + std::ptrdiff_t(before->rowsBegin) : place.rowsBefore.end();
    const auto heldEnd =
        before ? place.rowsBefore.begin() + std::ptrdiff_t(before->rowsEnd) : place.rowsBefore.end();
    const RowRevision unknown{0, group.count(), 0};
    const size_t olderIndex = source.older && at.isPacked ? olderOf(index) : kNoGroup;
    const auto olderParts = olderIndex == kNoGroup || source.olderRows.parts.empty()
                                ? std::span<const RowRevision>{}
                                : source.olderRows.of(olderIndex);
    auto old = olderParts.begin();
    for (RowRevision part : partsOf(source.rows, index, unknown)) { // all lie by rising rows
        while (old != olderParts.end() && old->first < part.first)
            ++old;
        const bool stands = part.revision != 0 && old != olderParts.end() && *old == part;
        if (olderIndex != kNoGroup && !stands)
            part.revision = 0; // it is of this moment only
        place.rows.push_back(part);
        while (held != heldEnd && held->first < part.first)
            ++held;
        if (part.revision != 0 && held != heldEnd && *held == part) {
            keptBytes_ += part.count * bytesOfRow;
            continue;
        }
        writePart(source, index, part, stands, place);
        uploadedBytes_ += part.count * bytesOfRow;
    }
    at.rowsEnd = place.rows.size();
}

void ParticleBuffers::writePart(const Source& source, size_t index, const RowRevision& part, bool stands,
                                Place& place)
{
    const base::SnapshotGroup& group = source.snapshot->group(index);
    const GroupPlace& at = place.groups[index];
    std::byte* const out = place.buffer.data() + at.offset;
    if (at.isPacked) {
        const size_t olderIndex = source.older && !stands ? olderOf(index) : kNoGroup;
        if (olderIndex == kNoGroup)
            packRows(group, part.first, part.count, at.columns, out);
        else
            packRowsBetween(group, source.older->group(olderIndex), source.moment, part.first, part.count,
                            at.columns, out);
        return;
    }
    const auto columns = source.snapshot->schema().kind(group.info().kind).columns;
    for (size_t c = 0; c < std::min(columns.size(), at.columns.size()); ++c) { // of a ribbon
        if (at.columns[c] < 0)
            continue;
        if (c == base::ribbon_column::Color) {
            writeRibbonColors(group, part, out + size_t(at.columns[c]) * 4);
            continue;
        }
        const size_t size = base::columnElementSize(columns[c].type);
        const auto from = columns[c].type == base::ColumnType::U64 ? std::as_bytes(group.column64(c))
                                                                   : std::as_bytes(group.column(c));
        std::memcpy(out + size_t(at.columns[c]) * 4 + part.first * size, from.data() + part.first * size,
                    part.count * size);
    }
}

} // namespace fx::render
