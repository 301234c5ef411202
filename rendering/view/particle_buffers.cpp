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
    const base::KindId kind = snapshot.group(group).info().kind;
    outRibbon = kind == snapshot.schema().find(base::kRibbonKind.name);
    return outRibbon || (withComputed && snapshot.group(group).program()) ||
           kind == snapshot.schema().find(base::kParticleKind.name);
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

} // namespace

ParticleBuffers::ParticleBuffers(GlDevice& device, std::pmr::memory_resource* memory)
    : device_(device), places_{Place{{}, {}, {}, 0, std::pmr::vector<GroupPlace>(memory)},
                               Place{{}, {}, {}, 0, std::pmr::vector<GroupPlace>(memory)},
                               Place{{}, {}, {}, 0, std::pmr::vector<GroupPlace>(memory)}},
      assets_(device, memory), emitters_(device, memory), states_(device, memory), jobs_(memory)
{}

uint64_t ParticleBuffers::bytes() const
{
    uint64_t sum = assets_.bytes() + emitters_.bytes() + states_.bytes();
    for (size_t i = 0; i < 3; ++i)
        sum += places_[i].buffer.bytes() + places_[i].computed.bytes() + orders_[i].bytes();
    return sum;
}

ParticleBuffers::Sizes ParticleBuffers::layOut(const base::FrameSnapshot& snapshot,
                                               std::pmr::vector<GroupPlace>& out) const
{
    const auto alignment = uint64_t(std::max(device_.limits().storageAlignment, 64));
    Sizes end;
    out.assign(snapshot.groupCount(), GroupPlace{});
    for (size_t g = 0; g < snapshot.groupCount(); ++g) {
        bool isRibbon = false;
        if (!isDrawn(snapshot, g, !refusesGpu_, isRibbon))
            continue;
        const base::SnapshotGroup& group = snapshot.group(g);
        const base::GpuParticleProgram* program = group.program().get();
        const std::span<const base::ColumnDesc> columns =
            program ? base::kParticleColumns : snapshot.schema().kind(group.info().kind).columns;
        GroupPlace& place = out[g];
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
            words += roundUp(rowCount(group) * base::columnElementSize(columns[c].type) / 4, 16);
        }
        place.bytes = words * 4;
        rowsEnd = place.offset + place.bytes;
    }
    return end;
}

void ParticleBuffers::write(const base::FrameSnapshot& snapshot, Place& place)
{
    for (size_t g = 0; g < place.groups.size(); ++g) {
        const GroupPlace& at = place.groups[g];
        const base::SnapshotGroup& group = snapshot.group(g);
        const auto columns = snapshot.schema().kind(group.info().kind).columns;
        if (at.isComputed) {
            std::memcpy(place.buffer.data() + at.wordsOffset, group.column64(0).data(), at.wordsBytes);
            uploadedBytes_ += at.wordsBytes;
            continue;
        }
        for (size_t c = 0; at.bytes > 0 && c < std::min(columns.size(), at.columns.size()); ++c) {
            if (at.columns[c] < 0)
                continue;
            std::byte* target = place.buffer.data() + at.offset + size_t(at.columns[c]) * 4;
            const bool isWide = columns[c].type == base::ColumnType::U64;
            const auto bytes = isWide ? std::as_bytes(group.column64(c)) : std::as_bytes(group.column(c));
            std::memcpy(target, bytes.data(), bytes.size());
            uploadedBytes_ += bytes.size();
        }
    }
}

base::Status ParticleBuffers::makeResident(const base::FrameSnapshot& snapshot, uint64_t stamp, Place*& out)
{
    for (Place& place : places_)
        if (place.stamp == stamp) {
            place.usedFrame = frame_;
            out = &place;
            return {};
        }
    out = &*std::min_element(places_.begin(), places_.end(),
                             [](const Place& a, const Place& b) { return a.usedFrame < b.usedFrame; });
    out->stamp = 0;
    const Sizes sizes = layOut(snapshot, out->groups);
    if (base::Status status =
            ensure(device_, out->buffer, std::max<uint64_t>(sizes.mapped, 1), "particle rows");
        !status)
        return status;
    if (base::Status status = ensureComputed(out->computed, sizes.computed); !status) {
        refusesGpu_ = true;
        return status;
    }
    write(snapshot, *out);
    out->stamp = stamp;
    out->usedFrame = frame_;
    return {};
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
        bytes = roundUp(bytes, alignment) + group.order.size_bytes();
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
        std::memcpy(buffer.data() + offset, order.data(), order.size_bytes());
        frame.batches()[i].order = {buffer.name(), {}, offset, order.size_bytes()};
        end = offset + order.size_bytes();
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

base::Status ParticleBuffers::prepare(const base::SnapshotPair& snapshots, const StampPair& stamps,
                                      ParticleFrame& frame, const base::AssetTable* assets)
{
    uploadedBytes_ = 0;
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
        if (base::Status status = makeResident(*snapshots.older, stamps.older, older); !status)
            return status;
    if (base::Status status = makeResident(*snapshots.newer, stamps.newer, newer); !status)
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
    uploadedBytes_ = 0;
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
