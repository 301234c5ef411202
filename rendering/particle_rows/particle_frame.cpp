#include "rendering/particle_rows/particle_frame.h"

#include "rendering/draw_order/depth_keys.h"
#include "rendering/frame/exposure.h"
#include "rendering/frame/snapshot_match.h"
#include "rendering/frame/view_volume.h"
#include "rendering/lod/stochastic_simplification.h"
#include "rendering/particle_rows/particle_estimate.h"
#include "rendering/passes/output_marks.h"

#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

namespace {

namespace column = base::particle_column;
namespace constant = base::particle_constant;

constexpr float kMinHalfSide = 0.5f; ///< [pixel] half the side of the smallest square: it covers one pixel
constexpr uint64_t kFramesKept = 120;

/// Center and radius of local bounds, relative to the eye.
struct Ball
{
    glm::vec3 center;
    float radius; ///< < 0: nothing is known
};

Ball ballOf(const base::SnapshotGroup& newer, const base::SnapshotGroup* older, const base::Placement& place)
{
    base::Bounds bounds = newer.info().bounds;
    if (bounds.empty())
        return {glm::vec3(place.position), -1.0f};
    if (older && !older->info().bounds.empty()) {
        bounds.min = glm::min(bounds.min, older->info().bounds.min);
        bounds.max = glm::max(bounds.max, older->info().bounds.max);
    }
    const glm::vec3 middle = 0.5f * (bounds.min + bounds.max);
    return {glm::vec3(place.position) + place.rotation * (middle * place.scale),
            0.5f * glm::length(bounds.max - bounds.min) * place.scale};
}

/// Middle of the rows when the writer has not given bounds.
glm::vec3 middleOfRows(const base::SnapshotGroup& group, const RowTechnique& technique)
{
    const base::Bounds bounds = technique.bounds(group);
    return bounds.empty() ? glm::vec3(0.0f) : 0.5f * (bounds.min + bounds.max);
}

uint32_t asId(float value)
{
    return value >= 1.0f && value < 16777216.0f ? uint32_t(value) : 0u;
}

/// What distances of a group's rows are measured from, see rowDistances().
struct SortOrigin
{
    glm::vec3 eye;
    float offset;
};

SortOrigin sortOrigin(const CameraGeometry& camera, const base::Placement& place, float bias)
{
    const glm::quat back = glm::conjugate(place.rotation);
    if (camera.orthographic)
        return {back * camera.forward, glm::dot(glm::vec3(place.position), camera.forward) - bias};
    return {back * -glm::vec3(place.position) / place.scale, 0.0f - bias};
}

int asCount(float value)
{
    return value >= 1.0f && value <= 4096.0f ? int(value) : 1;
}

} // namespace

/// The order of one group, by which the next begins.
struct ParticleFrame::Orderer
{
    explicit Orderer(std::pmr::memory_resource* memory)
        : sort(memory), distances(memory), factors(memory), kept(memory)
    {}

    uint64_t instance = 0;
    uint32_t solver = 0;
    uint32_t kind = 0;
    uint64_t usedFrame = 0;
    base::ParticleOrder mode = base::ParticleOrder::None;
    DepthSort sort;
    std::pmr::vector<float> distances;
    std::pmr::vector<uint32_t> factors; ///< by row, where it is thinned out
    std::pmr::vector<uint32_t> kept;    ///< rows, where they have no order
};

ParticleFrame::ParticleFrame(std::pmr::memory_resource* memory)
    : memory_(memory), groups_(memory), batches_(memory), streams_(memory), gpuOrders_(memory),
      orderers_(memory)
{}

ParticleFrame::~ParticleFrame() = default;

void ParticleFrame::build(const ParticleFrameInputs& in)
{
    ++frame_;
    groups_.clear();
    batches_.clear();
    streams_.clear();
    gpuOrders_.clear();
    drawn_ = {};
    orderedRows_ = thinnedRows_ = 0;
    fragments_ = {};
    keepsSnapshots_ = in.settings->outputs != 0;
    if (!in.snapshots->newer)
        return;
    const base::FrameSnapshot& newer = *in.snapshots->newer;
    const RowTechniques techniques(in.techniques, newer.schema());
    for (size_t g = 0; g < newer.groupCount(); ++g) {
        const RowTechnique* technique = techniques.of(newer.name(g).kind);
        if (technique && !(g < in.left.size() && in.left[g] != 0) && technique->isThere(newer.group(g)))
            addGroup(in, g, *technique);
    }
    std::erase_if(orderers_, [&](const auto& orderer) { return frame_ - orderer->usedFrame > kFramesKept; });
}

void ParticleFrame::dropComputed()
{
    std::erase_if(streams_, [&](const DrawStream& stream) { return batches_[stream.batch].isComputed; });
    std::pmr::vector<uint32_t> kept(batches_.size(), 0u, memory_); // where batches are now
    size_t count = 0;
    for (size_t i = 0; i < batches_.size(); ++i) {
        if (batches_[i].isComputed)
            continue;
        kept[i] = uint32_t(count);
        groups_[count] = groups_[i];
        batches_[count++] = batches_[i];
    }
    for (DrawStream& stream : streams_)
        stream.batch = kept[stream.batch];
    groups_.erase(groups_.begin() + std::ptrdiff_t(count), groups_.end());
    gpuOrders_.clear();
    batches_.erase(batches_.begin() + std::ptrdiff_t(count), batches_.end());
}

void ParticleFrame::addGroup(const ParticleFrameInputs& in, size_t index, const RowTechnique& technique)
{
    const base::SnapshotGroup& newer = in.snapshots->newer->group(index);
    const auto constants = newer.constants();
    const size_t olderIndex = findSameGroup(in.snapshots->older, *in.snapshots->newer, index);
    const base::SnapshotGroup* older =
        olderIndex == kNoGroup ? nullptr : &in.snapshots->older->group(olderIndex);
    const float t = float(glm::clamp(in.request->interpolation, 0.0, 1.0));
    const base::Placement place = placementAt(*in.snapshots, newer, older, t, in.camera->eye);
    const Ball ball = ballOf(newer, older, place);
    if (ball.radius >= 0.0f && !ViewVolume(*in.camera).touches(ball.center, ball.radius))
        return;

    ParticleGroup group{&technique,
                        &newer,
                        technique.isStrip ? nullptr : older,
                        index,
                        olderIndex,
                        {},
                        {},
                        asId(constants[constant::Texture]),
                        asId(constants[constant::Motion]),
                        asId(constants[constant::Mesh]),
                        asCount(constants[constant::TileColumns]),
                        asCount(constants[constant::TileRows])};
    ParticleBatch batch;
    batch.shape = technique.shape(newer);
    batch.isSolid = constants[constant::Blend] == float(base::ParticleBlend::Opaque);
    batch.repeats = technique.isStrip && constants[constant::ArcPerTile] > 0.0f;
    batch.instances = technique.instances(newer);
    batch.isComputed = technique.isComputed;
    if (technique.isStrip)
        group.columns = group.rows = 1;
    fillBlock(in, place, group, batch);
    DrawStream stream;
    stream.batch = uint32_t(batches_.size());
    stream.count = batch.instances;
    stream.adds = constants[constant::Blend] == float(base::ParticleBlend::Additive);
    if (!batch.isSolid) {
        const glm::vec3 middle =
            ball.radius >= 0.0f
                ? ball.center
                : ball.center + place.rotation * (middleOfRows(newer, technique) * place.scale);
        const float distance =
            in.camera->orthographic ? glm::dot(middle, in.camera->forward) : glm::length(middle);
        stream.distance = distance - constants[constant::OrderBias];
        if (batch.isComputed)
            orderOnGpu(in, place, group, batch);
    }
    uint32_t shownRows = batch.instances;
    const uint64_t thinnedBefore = thinnedRows_;
    if (!batch.isComputed)
        arrangeRows(in, place, group, batch, stream, shownRows);
    if (shownRows == 0)
        return;
    countRows(group, batch, thinnedRows_ - thinnedBefore);
    groups_.push_back(group);
    batches_.push_back(batch);
    if (batch.isSolid)
        return; // always drawn at full size
    streams_.push_back(stream);
    add(estimateRows(newer, technique, place, *in.camera, in.request->targets.width,
                     in.request->targets.height),
        fragments_);
}

/// @param thinned of them that are left to others
void ParticleFrame::countRows(const ParticleGroup& group, const ParticleBatch& batch, uint64_t thinned)
{
    const bool isStrip = group.technique->isStrip;
    const uint64_t shown = batch.isComputed
                               ? batch.instances
                               : countDrawn(*group.newer, 0, group.newer->count(), isStrip).pieces - thinned;
    (isStrip                           ? drawn_.ribbonPieces
     : batch.shape == BatchShape::Mesh ? drawn_.meshes
                                       : drawn_.sprites) += shown;
}

void ParticleFrame::fillBlock(const ParticleFrameInputs& in, const base::Placement& place,
                              ParticleGroup& group, ParticleBatch& batch)
{
    const auto c = group.newer->constants();
    const float exposure = exposureFromEv100(in.settings->exposureEv100);
    const bool isStrip = group.technique->isStrip;
    const bool hasPast = group.older || (isStrip && in.snapshots->older);
    const float seconds =
        hasPast ? float(base::toSeconds(in.snapshots->newer->tick() - in.snapshots->older->tick())) : 0.0f;
    const glm::vec3 axis =
        place.rotation * glm::vec3(c[constant::AxisX], c[constant::AxisY], c[constant::AxisZ]);
    ParticleBlock& b = batch.block;
    b = {};
    b.view = makeViewBlock(in.request->camera, in.request->targets.width, in.request->targets.height);
    b.view.sunDirection = {in.settings->lighting.sunDirection, b.view.sunDirection.w};
    b.placePosition = {glm::vec3(place.position), place.scale};
    b.placeRotation = {place.rotation.x, place.rotation.y, place.rotation.z, place.rotation.w};
    b.alignAxis = {axis, c[constant::Alignment]};
    b.appearance = {c[isStrip ? constant::TailAge : constant::Aspect], c[constant::Stretch],
                    c[constant::Softness], c[constant::Blend]};
    b.shine = {c[constant::Luminance] * exposure, c[constant::Lit], c[constant::Layer], 0.0f};
    b.moment = {float(glm::clamp(in.request->interpolation, 0.0, 1.0)), seconds, hasPast ? 1.0f : 0.0f,
                kMinHalfSide};
    b.atlas = {float(group.columns * group.rows), c[constant::FrameBlend], c[constant::MotionScale],
               group.texture ? 1.0f : 0.0f};
    b.strip = {group.motion ? 1.0f : 0.0f, c[constant::ArcPerTile], 0.0f, c[constant::Edge]};
    if (in.settings->outputs == 0)
        return;
    const base::SnapshotGroup* past =
        group.olderIndex == kNoGroup ? nullptr : &in.snapshots->older->group(group.olderIndex);
    const PlaceDrift drift = placeDrift(*group.newer, past, seconds);
    for (int row = 0; row < 3; ++row)
        batch.drift[size_t(row)] = {drift.turn[0][row], drift.turn[1][row], drift.turn[2][row],
                                    drift.shift[row]};
    batch.instance = instanceWords(in.request->instances.of(group.newer->info().instance));
}

ParticleFrame::Orderer& ParticleFrame::ordererOf(const base::GroupInfo& info)
{
    for (size_t i = 0; i < orderers_.size(); ++i) { // they come in the order of the frame before, mostly
        const size_t at = (lastOrderer_ + 1 + i) % orderers_.size();
        Orderer& orderer = *orderers_[at];
        if (orderer.instance == info.instance && orderer.solver == info.solver && orderer.kind == info.kind &&
            orderer.usedFrame != frame_)
        {
            lastOrderer_ = at;
            return orderer;
        }
    }
    lastOrderer_ = orderers_.size();
    orderers_.push_back(std::make_unique<Orderer>(memory_));
    Orderer& made = *orderers_.back();
    made.instance = info.instance;
    made.solver = info.solver;
    made.kind = info.kind;
    return made;
}

void ParticleFrame::orderOnGpu(const ParticleFrameInputs& in, const base::Placement& place,
                               const ParticleGroup& group, ParticleBatch& batch)
{
    const auto constants = group.newer->constants();
    const auto mode = base::ParticleOrder(uint32_t(constants[constant::Order]));
    if (mode == base::ParticleOrder::None)
        return;
    const SortOrigin origin = sortOrigin(*in.camera, place, constants[constant::OrderBias]);
    gpuOrders_.push_back({uint32_t(batches_.size()), mode != base::ParticleOrder::Depth,
                          mode == base::ParticleOrder::Youngest, in.camera->orthographic, origin.eye,
                          place.scale, origin.offset});
    batch.block.strip.z = float(OrderForm::Rows);
}

bool ParticleFrame::thin(const ParticleFrameInputs& in, const base::Placement& place,
                         const ParticleGroup& group, const ParticleBatch& batch, Orderer& orderer)
{
    const RowShape shape = group.technique->isStrip ? (batch.isSolid ? RowShape::SolidStrip : RowShape::Strip)
                                                    : (batch.isSolid ? RowShape::Body : RowShape::Card);
    const float pixels = 0.5f * float(in.request->targets.height) * std::abs(in.camera->clipScale.y);
    const auto parts = in.merger ? in.merger->partsOf(group.newerIndex) : std::span<const RowPart>{};
    return simplifyRows({group.newer, parts, place, shape, in.camera, pixels}, *in.lod, orderer.factors,
                        thinnedRows_);
}

/// The shortest; all keep looks as they are, so that a change of the form changes no picture.
OrderForm ParticleFrame::formOf(const ParticleGroup& group, base::ParticleOrder mode, uint32_t rows)
{
    if (group.factors.empty())
        return OrderForm::Rows;
    return mode == base::ParticleOrder::None && group.order.size() >= rows / 2 ? OrderForm::RowFactorsOnly
                                                                               : OrderForm::FactorsBeside;
}

/// Which rows are drawn, and in which order. Computed ones are neither thinned out nor ordered here.
void ParticleFrame::arrangeRows(const ParticleFrameInputs& in, const base::Placement& place,
                                ParticleGroup& group, ParticleBatch& batch, DrawStream& stream,
                                uint32_t& shownRows)
{
    const base::SnapshotGroup& rows = *group.newer;
    const auto mode = batch.isSolid || group.technique->isStrip
                          ? base::ParticleOrder::None
                          : base::ParticleOrder(uint32_t(rows.constants()[constant::Order]));
    const bool mayThin = in.lod && in.lod->isOn();
    if (mode == base::ParticleOrder::None && !mayThin)
        return;
    Orderer& orderer = ordererOf(rows.info());
    orderer.usedFrame = frame_;
    const bool isThinned = mayThin && thin(in, place, group, batch, orderer);
    if (mode != base::ParticleOrder::None) {
        sortRows(in, place, group, mode, isThinned, orderer);
        orderedRows_ += group.order.size();
    } else if (isThinned) {
        orderer.kept.clear();
        for (uint32_t i = 0; i < batch.instances; ++i)
            if (orderer.factors[i] != 0)
                orderer.kept.push_back(i);
        group.order = orderer.kept;
    } else {
        return;
    }
    if (isThinned)
        group.factors = orderer.factors;
    shownRows = uint32_t(group.order.size());
    group.orderForm = formOf(group, mode, batch.instances);
    batch.block.strip.z = float(group.orderForm);
    if (group.orderForm == OrderForm::RowFactorsOnly) { // all are drawn, to see there whether they are
        group.order = {};
        group.factors = group.factors.first(shownRows == 0 ? 0 : batch.instances);
    }
    batch.instances = stream.count = group.order.empty() ? uint32_t(group.factors.size()) : shownRows;
    if (shownRows == 0)
        batch.instances = stream.count = 0;
    if (mode == base::ParticleOrder::Depth) {
        stream.distances = orderer.distances.data();
        stream.order = group.order.data();
    }
}

/// Empty rows are left out of an order. Distances are those of the newer snapshot: what happens within a step
/// hardly changes the order.
void ParticleFrame::sortRows(const ParticleFrameInputs& in, const base::Placement& place,
                             ParticleGroup& group, base::ParticleOrder mode, bool isThinned, Orderer& orderer)
{
    const base::SnapshotGroup& rows = *group.newer;
    if (orderer.mode != mode)
        orderer.sort.forget();
    orderer.mode = mode;
    orderer.distances.resize(rows.count());
    float* distances = orderer.distances.data();
    const float* radius = rows.column(column::Radius).data();
    if (mode == base::ParticleOrder::Depth) {
        const SortOrigin origin = sortOrigin(*in.camera, place, rows.constants()[constant::OrderBias]);
        rowDistances({rows.column(column::PositionX).data(), rows.column(column::PositionY).data(),
                      rows.column(column::PositionZ).data(), radius, rows.count()},
                     origin.eye, in.camera->orthographic, place.scale, origin.offset, distances);
    } else {
        const float* age = rows.column(column::Age).data();
        for (size_t i = 0; i < rows.count(); ++i)
            distances[i] = radius[i] > 0.0f ? age[i] : DepthSort::kAbsent;
    }
    for (size_t i = 0; isThinned && i < rows.count(); ++i)
        if (orderer.factors[i] == 0)
            distances[i] = DepthSort::kAbsent;
    group.order = mode == base::ParticleOrder::Youngest ? orderer.sort.nearestFirst(orderer.distances)
                                                        : orderer.sort.farthestFirst(orderer.distances);
}

} // namespace fx::render
