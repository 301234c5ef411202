#include "rendering/view/particle_buffers.h"

#include "foundation/snapshot/gpu_particles.h"
#include "rendering/gl/gl_device.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

namespace fx::render {

namespace {

constexpr uint64_t kSmallest = 1 << 16; ///< [byte]
constexpr uint32_t kIdleFrames = 300;   ///< until the memory is given back

uint64_t roundUp(uint64_t value, uint64_t step)
{
    return (value + step - 1) / step * step;
}

/// Columns that drawing reads.
base::ColumnSet drawnColumns(bool isRibbon)
{
    return isRibbon ? base::kAllColumns : ~base::particle_column::kIndex;
}

bool isDrawn(const base::FrameSnapshot& snapshot, size_t group, bool withComputed, bool& outRibbon)
{
    const base::KindId kind = snapshot.name(group).kind;
    outRibbon = kind == snapshot.schema().find(base::kRibbonKind.name);
    return outRibbon || kind == snapshot.schema().find(base::kParticleKind.name) ||
           (withComputed && snapshot.group(group).program());
}

/// Whether a group of a pool is drawn as it is.
bool drawsPools(const base::FrameSnapshot& snapshot, bool isOlder, std::span<const ParticleGroup> groups)
{
    return snapshot.poolCount() > 0 && std::ranges::any_of(groups, [&](const ParticleGroup& group) {
               return isOlder ? group.older && snapshot.pooled(group.olderIndex)
                              : snapshot.pooled(group.newerIndex) != nullptr;
           });
}

/// Rows of a group: some more than it has, so that others stay where they are when it grows.
uint64_t roomFor(uint64_t rows)
{
    return roundUp(rows, std::max<uint64_t>(std::bit_floor(rows) / 8, 16));
}

/// [byte] a row of the columns that are uploaded.
uint64_t rowBytes(std::span<const base::ColumnDesc> columns, const std::array<int32_t, 16>& places)
{
    uint64_t bytes = 0;
    for (size_t c = 0; c < std::min(columns.size(), places.size()); ++c)
        bytes += places[c] >= 0 ? base::columnElementSize(columns[c].type) : 0;
    return bytes;
}

base::Status ensure(GlDevice& device, GlMappedBuffer& buffer, uint64_t bytes, const char* label)
{
    if (buffer.bytes() >= bytes)
        return buffer.wait();
    base::Result<GlMappedBuffer> made =
        GlMappedBuffer::create(device, std::bit_ceil(std::max(bytes, kSmallest)), label);
    if (!made)
        return made.status();
    buffer = std::move(*made);
    return {};
}

/// Of rows that are thinned out each has its look beside it.
size_t orderBytes(const ParticleGroup& group)
{
    return group.order.size_bytes() * (group.looks.empty() ? 1 : 2);
}

void writeOrder(const ParticleGroup& group, uint32_t* out)
{
    if (group.looks.empty()) {
        std::memcpy(out, group.order.data(), group.order.size_bytes());
        return;
    }
    for (const uint32_t row : group.order) {
        *out++ = row;
        *out++ = group.looks[row];
    }
}

} // namespace

ParticleBuffers::ParticleBuffers(GlDevice& device, std::pmr::memory_resource* memory)
    : device_(device), places_{Place(memory), Place(memory), Place(memory)}, assets_(device, memory),
      emitters_(device, memory), states_(device, memory), jobs_(memory)
{}

uint64_t ParticleBuffers::bytes() const
{
    uint64_t sum = assets_.bytes() + emitters_.bytes() + states_.bytes();
    for (size_t i = 0; i < 3; ++i)
        sum += places_[i].buffer.bytes() + places_[i].computed.bytes() + orders_[i].bytes();
    return sum;
}

ParticleBuffers::Sizes ParticleBuffers::layOut(const base::FrameSnapshot& snapshot,
                                               const SnapshotRowStamps& rows, bool withPools,
                                               std::pmr::vector<GroupPlace>& out) const
{
    const auto alignment = uint64_t(std::max(device_.limits().storageAlignment, 64));
    Sizes end;
    out.assign(snapshot.groupCount(), GroupPlace{});
    for (size_t g = 0; g < snapshot.groupCount(); ++g) {
        bool isRibbon = false;
        if ((snapshot.pooled(g) && !withPools) || !isDrawn(snapshot, g, !refusesGpu_, isRibbon))
            continue;
        const base::SnapshotGroup& group = snapshot.group(g);
        const base::GpuParticleProgram* program = group.program().get();
        const std::span<const base::ColumnDesc> columns =
            program ? base::kParticleColumns : snapshot.schema().kind(group.info().kind).columns;
        GroupPlace& place = out[g];
        if (rows.alikeOf(g) != g) {
            place = out[rows.alikeOf(g)];
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
        place.columns.fill(-1);
        uint64_t words = 0;
        for (size_t c = 0; c < std::min(columns.size(), place.columns.size()); ++c) {
            const bool isThere = program ? (program->features.columns >> c & 1) != 0 : group.has(c);
            if (!isThere || !(drawnColumns(isRibbon) >> c & 1))
                continue;
            place.columns[c] = int32_t(words);
            words += roundUp(roomFor(rowCount(group)) * base::columnElementSize(columns[c].type) / 4, 16);
        }
        place.bytes = words * 4;
        rowsEnd = place.offset + place.bytes;
    }
    return end;
}

void ParticleBuffers::write(const base::FrameSnapshot& snapshot, const SnapshotRowStamps& rows, Place& place)
{
    auto before = place.groupsBefore.begin(); // both lie by rising offsets
    const auto isOfRows = [](const GroupPlace& at) { return at.bytes > 0 && !at.isComputed && !at.isShared; };
    for (size_t g = 0; g < place.groups.size(); ++g) {
        GroupPlace& at = place.groups[g];
        if (at.bytes == 0 && !at.isComputed)
            continue;
        const base::SnapshotGroup& group = snapshot.group(g);
        if (at.isComputed) {
            std::memcpy(place.buffer.data() + at.wordsOffset, group.column64(0).data(), at.wordsBytes);
            uploadedBytes_ += at.wordsBytes;
            continue;
        }
        const auto columns = snapshot.schema().kind(group.info().kind).columns;
        if (at.isShared)
            sharedBytes_ += group.count() * rowBytes(columns, at.columns);
        if (!isOfRows(at))
            continue;
        while (before != place.groupsBefore.end() && (!isOfRows(*before) || before->offset < at.offset))
            ++before;
        const bool isSame = before != place.groupsBefore.end() && before->offset == at.offset &&
                            before->bytes == at.bytes && before->columns == at.columns;
        const RowStamp unknown{0, group.count(), 0};
        writeRows(group, columns, rows.parts.empty() ? std::span(&unknown, 1) : rows.of(g),
                  isSame ? &*before : nullptr, at, place);
    }
}

/// @param before what lay there until now, in the same columns; null: something else
void ParticleBuffers::writeRows(const base::SnapshotGroup& group, std::span<const base::ColumnDesc> columns,
                                std::span<const RowStamp> parts, const GroupPlace* before, GroupPlace& at,
                                Place& place)
{
    at.rowsBegin = place.rows.size();
    auto held =
        before ? place.rowsBefore.begin() + std::ptrdiff_t(before->rowsBegin) : place.rowsBefore.end();
    const auto heldEnd =
        before ? place.rowsBefore.begin() + std::ptrdiff_t(before->rowsEnd) : place.rowsBefore.end();
    for (const RowStamp& part : parts) { // both lie by rising rows
        place.rows.push_back(part);
        while (held != heldEnd && held->first < part.first)
            ++held;
        const uint64_t bytes = part.count * rowBytes(columns, at.columns);
        if (part.stamp != 0 && held != heldEnd && *held == part) {
            keptBytes_ += bytes;
            continue;
        }
        for (size_t c = 0; c < std::min(columns.size(), at.columns.size()); ++c) {
            if (at.columns[c] < 0)
                continue;
            const size_t size = base::columnElementSize(columns[c].type);
            const auto from = columns[c].type == base::ColumnType::U64 ? std::as_bytes(group.column64(c))
                                                                       : std::as_bytes(group.column(c));
            std::memcpy(place.buffer.data() + at.offset + size_t(at.columns[c]) * 4 + part.first * size,
                        from.data() + part.first * size, part.count * size);
        }
        uploadedBytes_ += bytes;
    }
    at.rowsEnd = place.rows.size();
}

base::Status ParticleBuffers::makeResident(const base::FrameSnapshot& snapshot, uint64_t stamp,
                                           const SnapshotRowStamps& rows, bool withPools, Place*& out)
{
    const auto found =
        std::ranges::find_if(places_, [stamp](const Place& place) { return place.stamp == stamp; });
    if (found != places_.end() && (found->hasPools || !withPools)) {
        found->usedFrame = frame_;
        out = &*found;
        return {};
    }
    const auto isUsedEarlier = [](const Place& a, const Place& b) { return a.usedFrame < b.usedFrame; };
    out = found != places_.end() ? &*found : &*std::ranges::min_element(places_, isUsedEarlier);
    out->stamp = 0;
    out->hasPools = withPools;
    out->groupsBefore.swap(out->groups);
    out->rowsBefore.swap(out->rows);
    out->rows.clear();
    const Sizes sizes = layOut(snapshot, rows, withPools, out->groups);
    if (base::Status status = makeRoom(sizes, *out); !status) {
        out->groups.clear(); // nothing of it was written
        return status;
    }
    write(snapshot, rows, *out);
    out->stamp = stamp;
    out->usedFrame = frame_;
    return {};
}

base::Status ParticleBuffers::makeRoom(const Sizes& sizes, Place& place)
{
    const uint32_t name = place.buffer.name();
    if (base::Status status =
            ensure(device_, place.buffer, std::max<uint64_t>(sizes.mapped, 1), "particle rows");
        !status)
        return status;
    if (place.buffer.name() != name)
        place.groupsBefore.clear();
    base::Status status = ensureComputed(place.computed, sizes.computed);
    refusesGpu_ = refusesGpu_ || !status;
    return status;
}

base::Status ParticleBuffers::ensureComputed(GlBuffer& buffer, uint64_t bytes)
{
    if (buffer.bytes() >= bytes)
        return {};
    auto made =
        GlBuffer::create(device_, std::bit_ceil(std::max(bytes, kSmallest)), "computed particle rows");
    if (!made)
        return made.status();
    buffer = std::move(*made);
    return {};
}

base::Status ParticleBuffers::takeRows(Place& place, const base::SnapshotGroup& group, size_t index,
                                       uint32_t batch, bool isNewer, BufferPart& outPart)
{
    GroupPlace& at = place.groups[index];
    outPart = {at.isComputed ? place.computed.name() : place.buffer.name(), {}, at.offset, at.bytes};
    if (!at.isComputed || at.isThere)
        return {};
    const auto emitter = emitters_.find(group.program());
    refusesGpu_ = refusesGpu_ || !emitter;
    if (!emitter)
        return emitter.status();
    const GpuEmitters::Entry& known = **emitter;
    jobs_.push_back({known.program,
                     batch,
                     isNewer,
                     {known.numbers.name(), {}, 0, known.numbers.bytes()},
                     {place.buffer.name(), {}, at.wordsOffset, at.wordsBytes},
                     at.columns,
                     rowCount(group)});
    jobs_.back().meetsDepth = meetsDepth(group.program()->features);
    jobs_.back().place = group.info().placement;
    at.isThere = true;
    const base::Status status = states_.prepare(group, jobs_.back());
    refusesGpu_ = refusesGpu_ || !status;
    return status;
}

void ParticleBuffers::warmUp(const base::GpuParticleProgram& emitter)
{
    refusesGpu_ = refusesGpu_ || !emitters_.compile(emitter);
}

void ParticleBuffers::forgetComputed()
{
    if (jobs_.empty())
        return;
    for (Place& place : places_)
        place.stamp = 0;
    states_.forget();
}

base::Status ParticleBuffers::writeOrders(ParticleFrame& frame)
{
    const auto alignment = uint64_t(std::max(device_.limits().storageAlignment, 64));
    uint64_t bytes = 0;
    for (const ParticleGroup& group : frame.groups())
        bytes = roundUp(bytes, alignment) + orderBytes(group);
    if (bytes == 0)
        return {};
    GlMappedBuffer& buffer = orders_[frame_ % orders_.size()];
    if (base::Status status = ensure(device_, buffer, bytes, "particle orders"); !status)
        return status;
    uint64_t end = 0;
    for (size_t i = 0; i < frame.groups().size(); ++i) {
        const auto order = frame.groups()[i].order;
        if (order.empty())
            continue;
        const uint64_t offset = roundUp(end, alignment);
        writeOrder(frame.groups()[i], reinterpret_cast<uint32_t*>(buffer.data() + offset));
        frame.batches()[i].order = {buffer.name(), {}, offset, orderBytes(frame.groups()[i])};
        end = offset + orderBytes(frame.groups()[i]);
    }
    uploadedBytes_ += end;
    return {};
}

base::Status ParticleBuffers::findAssets(ParticleFrame& frame, const base::AssetTable* assets)
{
    for (size_t i = 0; i < frame.groups().size(); ++i) {
        const ParticleGroup& group = frame.groups()[i];
        ParticleBatch& batch = frame.batches()[i];
        const auto texture = assets_.atlas(assets, group.texture, group.columns, group.rows);
        const auto motion = assets_.atlas(assets, group.motion, group.columns, group.rows);
        if (!texture || !motion)
            return texture ? motion.status() : texture.status();
        batch.texture = texture->texture;
        batch.motion = motion->texture;
        batch.block.atlas.x = float(texture->frames);
        if (!assets || !assets->image(group.texture))
            batch.block.atlas.w = 0.0f;
        if (!assets || !assets->image(group.motion))
            batch.block.strip.x = 0.0f;
        if (batch.shape != BatchShape::Mesh)
            continue;
        const auto mesh = assets_.mesh(assets, group.mesh);
        if (!mesh)
            return mesh.status();
        batch.mesh = {mesh->buffer, {}, 0, mesh->bytes};
        batch.vertices = mesh->indexCount;
        batch.block.rows[3] = int32_t(mesh->firstIndex);
    }
    return {};
}

base::Status ParticleBuffers::prepare(const base::SnapshotPair& snapshots, const UploadStamps& stamps,
                                      ParticleFrame& frame, const base::AssetTable* assets)
{
    uploadedBytes_ = keptBytes_ = sharedBytes_ = 0;
    jobs_.clear();
    if (frame.groups().empty()) {
        idle();
        return {};
    }
    idleFrames_ = 0;
    ++frame_;
    emitters_.nextFrame();
    states_.nextFrame();
    Place* older = nullptr;
    Place* newer = nullptr;
    if (snapshots.older)
        if (base::Status status = makeResident(*snapshots.older, stamps.snapshots.older, stamps.olderRows,
                                               drawsPools(*snapshots.older, true, frame.groups()), older);
            !status)
            return status;
    if (base::Status status = makeResident(*snapshots.newer, stamps.snapshots.newer, stamps.newerRows,
                                           drawsPools(*snapshots.newer, false, frame.groups()), newer);
        !status)
        return status;
    if (base::Status status = writeOrders(frame); !status)
        return status;
    for (size_t i = 0; i < frame.groups().size(); ++i) {
        const ParticleGroup& group = frame.groups()[i];
        ParticleBatch& batch = frame.batches()[i];
        if (group.older) { // the newer ones go on from there
            if (base::Status status =
                    takeRows(*older, *group.older, group.olderIndex, uint32_t(i), false, batch.older);
                !status)
                return status;
            batch.block.olderAt = older->groups[group.olderIndex].columns;
            batch.block.rows[1] = int32_t(rowCount(*group.older));
        }
        if (base::Status status =
                takeRows(*newer, *group.newer, group.newerIndex, uint32_t(i), true, batch.newer);
            !status)
            return status;
        batch.block.newerAt = newer->groups[group.newerIndex].columns;
        batch.block.rows[0] = int32_t(rowCount(*group.newer));
    }
    return findAssets(frame, assets);
}

void ParticleBuffers::keep(const ParticleFrame& frame)
{
    uploadedBytes_ = keptBytes_ = sharedBytes_ = 0;
    jobs_.clear();
    if (frame.groups().empty())
        idle();
}

void ParticleBuffers::idle()
{
    emitters_.nextFrame();
    states_.nextFrame();
    if (++idleFrames_ != kIdleFrames)
        return;
    for (Place& place : places_) {
        place.buffer = {};
        place.computed = {};
        place.stamp = 0;
        place.groups.clear();
    }
    for (GlMappedBuffer& order : orders_)
        order = {};
    assets_.release();
}

void ParticleBuffers::fence()
{
    for (Place& place : places_)
        if (place.usedFrame == frame_ && place.stamp != 0)
            place.buffer.fence();
    if (orders_[frame_ % orders_.size()].name() != 0)
        orders_[frame_ % orders_.size()].fence();
}

} // namespace fx::render
