#include "rendering/particle_rows/particle_buffers.h"

#include "foundation/snapshot/gpu_particles.h"
#include "rendering/frame/snapshot_match.h"
#include "rendering/gl/gl_device.h"
#include "rendering/lod/stochastic_simplification.h"

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

/// Whether a group of a pool is drawn as it is.
bool drawsPools(const base::FrameSnapshot& snapshot, bool isOlder, std::span<const ParticleGroup> groups)
{
    return snapshot.poolCount() > 0 && std::ranges::any_of(groups, [&](const ParticleGroup& group) {
               return isOlder ? group.older && snapshot.pooled(group.olderIndex)
                              : snapshot.pooled(group.newerIndex) != nullptr;
           });
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

/// What tells which rows are drawn, and how.
size_t orderBytes(const ParticleGroup& group)
{
    const size_t words =
        group.orderForm == OrderForm::RowFactorsOnly ? group.factors.size() : group.order.size();
    return words * (group.orderForm == OrderForm::FactorsBeside ? 8 : 4);
}

void writeOrder(const ParticleGroup& group, uint32_t* out)
{
    switch (group.orderForm) {
    case OrderForm::FactorsBeside:
        for (const uint32_t row : group.order) {
            *out++ = row;
            *out++ = group.factors[row];
        }
        break;
    case OrderForm::RowFactorsOnly:
        std::memcpy(out, group.factors.data(), group.factors.size_bytes());
        break;
    default:
        std::memcpy(out, group.order.data(), group.order.size_bytes());
    }
}

} // namespace

ParticleBuffers::ParticleBuffers(GlDevice& device, std::span<const RowTechnique* const> techniques,
                                 std::pmr::memory_resource* memory)
    : device_(device), techniques_(techniques), places_{Place(memory), Place(memory), Place(memory)},
      assets_(device, memory), emitters_(device, memory), states_(device, memory), jobs_(memory),
      wanted_(memory), older_(memory)
{}

uint64_t ParticleBuffers::bytes() const
{
    uint64_t sum = assets_.bytes() + emitters_.bytes() + states_.bytes();
    for (size_t i = 0; i < 3; ++i)
        sum += places_[i].buffer.bytes() + places_[i].computed.bytes() + orders_[i].bytes();
    return sum;
}

ParticleBuffers::Place* ParticleBuffers::find(uint64_t revision, bool withPools)
{
    const auto found = std::ranges::find_if(places_, [&](const Place& place) {
        return revision != 0 && place.revision == revision && (place.hasPools || !withPools);
    });
    return found == places_.end() ? nullptr : &*found;
}

void ParticleBuffers::listWanted(const Source& source, const ParticleFrame& frame)
{
    wanted_.assign(source.snapshot->groupCount(), 0);
    for (const ParticleGroup& group : frame.groups()) {
        if (source.isOlder && !group.older)
            continue;
        const size_t index = source.isOlder ? group.olderIndex : group.newerIndex;
        wanted_[index] = 1;
        if (isAlike(source, index))
            wanted_[source.rows.alikeOf(index)] = 1;
    }
}

base::Status ParticleBuffers::makeResident(const Source& source, const ParticleFrame& frame, Place*& out)
{
    listWanted(source, frame);
    out = find(source.revision, source.withPools);
    if (out) {
        write(source, *out); // what was not drawn until now
        out->usedFrame = frame_;
        return {};
    }
    const auto isUsedEarlier = [](const Place& a, const Place& b) { return a.usedFrame < b.usedFrame; };
    out = find(source.revision, false);
    out = out ? out : &*std::ranges::min_element(places_, isUsedEarlier);
    out->revision = 0;
    out->hasPools = source.withPools;
    out->groupsBefore.swap(out->groups);
    out->rowsBefore.swap(out->rows);
    out->rows.clear();
    const Sizes sizes = layOut(source, out->groups);
    if (base::Status status = makeRoom(sizes, *out); !status) {
        out->groups.clear(); // nothing of it was written
        return status;
    }
    write(source, *out);
    out->groupsBefore.clear();
    out->revision = source.revision;
    out->usedFrame = frame_;
    return {};
}

/// Whether neither of the two snapshots is there, nor is expected to be used again.
bool ParticleBuffers::mixes(const base::SnapshotPair& snapshots, const UploadRevisions& revisions,
                            ParticleFrame& frame)
{
    const RevisionPair mixedBefore = mixed_;
    mixed_ = {};
    const bool isComputed =
        std::ranges::any_of(frame.batches(), [](const ParticleBatch& batch) { return batch.isComputed; });
    const bool hasOlder = std::ranges::any_of(frame.groups(), [](const auto& group) { return group.older; });
    if (!snapshots.older || !hasOlder || isComputed || frame.keepsSnapshots() ||
        revisions.snapshots == mixedBefore ||
        find(revisions.snapshots.newer, drawsPools(*snapshots.newer, false, frame.groups())) ||
        find(revisions.snapshots.older, drawsPools(*snapshots.older, true, frame.groups())))
        return false;
    mixed_ = revisions.snapshots;
    return true;
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
                     group.program()->rows});
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
        place.revision = 0;
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
        if (orderBytes(frame.groups()[i]) == 0)
            continue;
        const uint64_t offset = roundUp(end, alignment);
        writeOrder(frame.groups()[i], reinterpret_cast<uint32_t*>(buffer.data() + offset));
        frame.batches()[i].order = {buffer.name(), {}, offset, orderBytes(frame.groups()[i])};
        end = offset + orderBytes(frame.groups()[i]);
    }
    drawn_[2] = &buffer;
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

/// @param older null afterwards: the rows of the newer are those of the frame's moment
base::Status ParticleBuffers::makeTwoResident(const base::SnapshotPair& snapshots,
                                              const UploadRevisions& revisions, ParticleFrame& frame,
                                              Place*& older, Place*& newer)
{
    Source source{snapshots.newer, revisions.snapshots.newer, revisions.newerRows,
                  drawsPools(*snapshots.newer, false, frame.groups()), false};
    if (mixes(snapshots, revisions, frame)) {
        const base::Ticks between = snapshots.newer->tick() - snapshots.older->tick();
        source.moment = {frame.batches()[0].block.moment.x, float(base::toSeconds(between))};
        older_.assign(snapshots.newer->groupCount(), kNoGroup);
        for (const ParticleGroup& group : frame.groups())
            if (group.older)
                older_[group.newerIndex] = group.olderIndex;
        source.revision = 0;
        source.older = snapshots.older;
        source.olderRows = revisions.olderRows;
        return makeResident(source, frame, newer);
    }
    if (snapshots.older)
        if (base::Status status =
                makeResident({snapshots.older, revisions.snapshots.older, revisions.olderRows,
                              drawsPools(*snapshots.older, true, frame.groups()), true},
                             frame, older);
            !status)
            return status;
    return makeResident(source, frame, newer);
}

base::Status ParticleBuffers::prepare(const base::SnapshotPair& snapshots, const UploadRevisions& revisions,
                                      ParticleFrame& frame, const base::AssetTable* assets)
{
    uploadedBytes_ = keptBytes_ = sharedBytes_ = 0;
    jobs_.clear();
    drawn_ = {};
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
    if (base::Status status = makeTwoResident(snapshots, revisions, frame, older, newer); !status)
        return status;
    drawn_ = {older ? &older->buffer : nullptr, &newer->buffer};
    if (base::Status status = writeOrders(frame); !status)
        return status;
    for (size_t i = 0; i < frame.groups().size(); ++i) {
        const ParticleGroup& group = frame.groups()[i];
        ParticleBatch& batch = frame.batches()[i];
        if (group.older && !older)
            batch.block.moment.z = 0.0f; // rows are those of the moment
        if (group.older && older) {      // the newer ones go on from there
            if (base::Status status =
                    takeRows(*older, *group.older, group.olderIndex, uint32_t(i), false, batch.older);
                !status)
                return status;
            batch.block.olderAt = older->groups[group.olderIndex].columns;
            batch.block.rows[1] = int32_t(group.technique->rows(*group.older));
        }
        if (base::Status status =
                takeRows(*newer, *group.newer, group.newerIndex, uint32_t(i), true, batch.newer);
            !status)
            return status;
        batch.block.newerAt = newer->groups[group.newerIndex].columns;
        batch.block.rows[0] = int32_t(group.technique->rows(*group.newer));
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
    drawn_ = {};
    emitters_.nextFrame();
    states_.nextFrame();
    if (++idleFrames_ != kIdleFrames)
        return;
    for (Place& place : places_) {
        place.buffer = {};
        place.computed = {};
        place.revision = 0;
        place.groups.clear();
    }
    for (GlMappedBuffer& order : orders_)
        order = {};
    assets_.release();
}

void ParticleBuffers::fence()
{
    for (GlMappedBuffer* buffer : drawn_)
        if (buffer)
            buffer->fence();
}

} // namespace fx::render
