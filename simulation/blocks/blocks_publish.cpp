// What the blocks of an instance publish: the content of the variants in use, the blocks, and their balls.
#include "foundation/random/philox.h"
#include "foundation/snapshot/expanded_blocks.h"
#include "simulation/blocks/blocks_solver.h"
#include "simulation/motion/blob_optics.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace fx::sim {

namespace {

namespace blob = base::blob_column;
namespace block = base::block_column;
namespace constant = base::block_constant;
using base::SnapshotGroup;

constexpr float kRoundedUp = 1.001f;
constexpr uint32_t kSolverBits = 8;

void writeBlock(const BlockPlacement& placed, float variant, uint64_t id, uint32_t i, SnapshotGroup& io)
{
    for (int k = 0; k < 3; ++k) {
        io.editColumn(block::PositionX + size_t(k))[i] = placed.position[k];
        io.editColumn(block::VelocityX + size_t(k))[i] = 0.0f;
    }
    const float rotation[4] = {placed.rotation.x, placed.rotation.y, placed.rotation.z, placed.rotation.w};
    for (size_t k = 0; k < 4; ++k)
        io.editColumn(block::RotationX + k)[i] = rotation[k];
    io.editColumn(block::Scale)[i] = placed.scale;
    io.editColumn(block::Density)[i] = placed.density;
    io.editColumn(block::Age)[i] = base::kSettledAge;
    io.editColumn(block::Variant)[i] = variant;
    io.editIds()[i] = id;
}

void writeBall(const ListedBall& ball, float fireShare, uint32_t i, SnapshotGroup& io)
{
    for (int k = 0; k < 3; ++k) {
        io.editColumn(blob::PositionX + size_t(k))[i] = ball.center[k];
        io.editColumn(blob::VelocityX + size_t(k))[i] = 0.0f;
        io.editColumn(blob::AlbedoR + size_t(k))[i] = ball.albedo[k];
        io.editColumn(blob::EmissionR + size_t(k))[i] = ball.emission[k];
    }
    io.editColumn(blob::Radius)[i] = ball.radius;
    io.editColumn(blob::CrossSection)[i] = ball.crossSection;
    io.editColumn(blob::Temperature)[i] = ball.temperature;
    io.editColumn(blob::FireShare)[i] = fireShare;
    io.editColumn(blob::Heat)[i] = 0.0f;
    io.editColumn(blob::Age)[i] = base::kSettledAge;
    io.editIds()[i] = i;
}

} // namespace

SnapshotGroup& BlocksSolver::addBlocks(const base::GroupInfo& base, float owner,
                                       std::span<const BlockPlacement> blocks, uint32_t capacity,
                                       base::FrameSnapshot& snapshot) const
{
    SnapshotGroup& group = snapshot.addGroup(kinds_.block, capacity);
    base::GroupInfo& info = group.editInfo();
    info = base;
    info.kind = kinds_.block;
    info.count = uint32_t(blocks.size());
    group.editConstants()[constant::Owner] = owner;
    return group;
}

/// The group of one variant.
void BlocksSolver::addContent(const base::GroupInfo& base, uint32_t type, uint32_t phase,
                              base::FrameSnapshot& snapshot) const
{
    const BlockType& shown = def_.types[type];
    const auto variant = float(base::variantOf(type, phase));
    base::Bounds bounds;
    bounds.add(glm::vec3(0.0f), shown.radius);
    if (shown.hasBlocks()) {
        SnapshotGroup& group =
            addBlocks(base, variant, shown.blocks, uint32_t(shown.blocks.size()), snapshot);
        for (uint32_t i = 0; i < group.count(); ++i) {
            const BlockPlacement& placed = shown.blocks[i];
            const uint32_t inner = innerPhase(placed, def_.types[placed.type], phase);
            writeBlock(placed, float(base::variantOf(placed.type, inner)), shown.ids[i], i, group);
        }
        group.editInfo().bounds = bounds;
        return;
    }
    SnapshotGroup& group = snapshot.addGroup(kinds_.ball, size_t(shown.ballCount));
    base::GroupInfo& info = group.editInfo();
    info = base;
    info.kind = kinds_.ball;
    info.bounds = bounds;
    group.editConstants()[base::block_ball_constant::Variant] = variant;
    if (shown.loop) {
        const base::Ticks ahead = shown.loop->period() * base::Ticks(phase) / base::Ticks(shown.phases);
        info.count = shown.loop->write(now_ + ahead, group);
        return;
    }
    info.count = uint32_t(shown.balls.size());
    for (uint32_t i = 0; i < info.count; ++i)
        writeBall(shown.balls[i], def_.fireShare, i, group);
}

/// Marks the variants that the blocks of the effect show, and those inside of them.
void BlocksSolver::findUsed(const SnapshotGroup& root) const
{
    isUsed_.fill(false);
    for (const float variant : root.column(block::Variant))
        isUsed_[size_t(variant)] = true;
    for (auto type = uint32_t(def_.types.size()); type-- > 0;) // blocks have types of lower index
        for (uint32_t phase = 0; phase < def_.types[type].phases; ++phase) {
            if (!isUsed_[base::variantOf(type, phase)])
                continue;
            for (const BlockPlacement& inside : def_.types[type].blocks)
                isUsed_[base::variantOf(inside.type, innerPhase(inside, def_.types[inside.type], phase))] =
                    true;
        }
}

void BlocksSolver::addContents(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const
{
    for (uint32_t type = 0; type < def_.types.size(); ++type)
        for (uint32_t phase = 0; phase < def_.types[type].phases; ++phase)
            if (isUsed_[base::variantOf(type, phase)])
                addContent(base, type, phase, snapshot);
}

/// The block that a particle of the emitter is.
void BlocksSolver::writeEmitted(uint32_t i, const SnapshotGroup& particles, SnapshotGroup& io) const
{
    const uint64_t birth = particles.ids()[i] & ((uint64_t(1) << 40) - 1);
    const auto u = base::randomUnit4(seed_, 0, birth, base::RandomPurpose::Axis);
    const auto pick = [](float share, size_t count) {
        return std::min(size_t(share * float(count)), count - 1);
    };
    BlockPlacement placed;
    placed.type = def_.emitted[pick(u[0], def_.emitted.size())];
    const BlockType& type = def_.types[placed.type];
    const float radius = particles.start(blob::Radius)[i];
    placed.scale = radius / std::max(type.radius, 1e-6f); // of an empty type, 0
    placed.density = particles.start(blob::CrossSection)[i] / crossSectionOf(1.0f, radius);
    for (int k = 0; k < 3; ++k)
        placed.position[k] = particles.start(blob::PositionX + size_t(k))[i];
    placed.rotation = turnOf(def_.turn, seed_, birth);
    const auto variant = float(base::variantOf(placed.type, uint32_t(pick(u[1], type.phases))));
    writeBlock(placed, variant, birth * stride_, i, io);
    for (size_t k = 0; k < 3; ++k)
        io.editColumn(block::VelocityX + k)[i] = particles.start(blob::VelocityX + k)[i];
    io.editColumn(block::Age)[i] = particles.start(blob::Age)[i];
}

/// The group of the coordinates of blocks, before that of the blocks. Its rows are written later.
void BlocksSolver::openMaterial(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const
{
    const size_t capacity = emitter_ ? def_.emitter->maxParticles : def_.blocks.size();
    SnapshotGroup& group = snapshot.addGroup(kinds_.blockMaterial, capacity);
    base::GroupInfo& info = group.editInfo();
    info = base;
    info.kind = kinds_.blockMaterial;
    writeDetail(def_.detail, generations_, group);
    // The factor that keeps the total would have to be found from all balls in each frame.
    group.editConstants()[base::material_constant::Lossy] = 1.0f;
}

/// Blocks that do not move have their present place in both generations.
void BlocksSolver::writeMaterial(const SnapshotGroup& root, SnapshotGroup& io) const
{
    io.editInfo().count = root.count();
    std::ranges::copy(root.ids(), io.editIds().begin());
    const SnapshotGroup* const moving = emitter_ && root.count() > 0 ? &particles_.group(1) : nullptr;
    for (size_t column = 0; column < base::material_column::Count; ++column) {
        const auto from = moving ? moving->column(column) : root.column(block::PositionX + column % 3);
        std::ranges::copy(from, io.editColumn(column).begin());
    }
    if (moving)
        for (const size_t c : {base::material_constant::Generation, base::material_constant::Fade})
            io.editConstants()[c] = moving->constants()[c];
}

/// The blocks of the effect.
SnapshotGroup& BlocksSolver::addRoot(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const
{
    const uint64_t first = uint64_t(base.solver & ((1u << kSolverBits) - 1u)) << (64 - kSolverBits);
    SnapshotGroup* root = nullptr;
    if (emitter_) {
        particles_.begin(snapshot.tick(), 1, snapshot.step());
        emitter_->publish(base, particles_);
        const uint32_t count = particles_.groupCount() > 0 ? particles_.group(0).count() : 0;
        root = &addBlocks(base, base::kNoOwner, {}, def_.emitter->maxParticles, snapshot);
        root->editInfo().count = count;
        for (uint32_t i = 0; i < count; ++i)
            writeEmitted(i, particles_.group(0), *root);
    } else {
        root = &addBlocks(base, base::kNoOwner, def_.blocks, uint32_t(def_.blocks.size()), snapshot);
        for (uint32_t i = 0; i < root->count(); ++i) {
            const BlockPlacement& placed = def_.blocks[i];
            const uint32_t phase = placed.phase % def_.types[placed.type].phases;
            writeBlock(placed, float(base::variantOf(placed.type, phase)), i * stride_, i, *root);
        }
    }
    for (uint32_t i = 0; i < root->count(); ++i) {
        root->editIds()[i] += first;
        root->editColumn(block::Density)[i] *= def_.density;
    }
    return *root;
}

void BlocksSolver::publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const
{
    if (kinds_.block == base::kNoKind || kinds_.ball == base::kNoKind)
        return;
    const size_t first = snapshot.addedCount();
    if (hasMaterial())
        openMaterial(base, snapshot);
    const size_t root = snapshot.addedCount();
    findUsed(addRoot(base, snapshot));
    if (hasMaterial())
        writeMaterial(snapshot.editGroup(root), snapshot.editGroup(first));
    addContents(base, snapshot);
    addBalls(base, root, snapshot);
    if (hasMaterial())
        snapshot.editGroup(first).editInfo().bounds = snapshot.editGroup(root).info().bounds;
}

/// The group of the balls of all blocks, and what is known of it: bounds and counts.
void BlocksSolver::addBalls(const base::GroupInfo& base, size_t root, base::FrameSnapshot& snapshot) const
{
    base::Bounds bounds;
    uint64_t balls = 0, inside = 0;
    {
        const SnapshotGroup& blocks = snapshot.added(root);
        for (uint32_t i = 0; i < blocks.count(); ++i) {
            const auto value = [&](size_t column) { return blocks.start(column)[i]; };
            const BlockType& type = def_.types[size_t(value(block::Variant)) / base::kMaxBlockPhases];
            balls += type.ballCount;
            inside += 1 + type.blockCount;
            const glm::vec3 position(value(block::PositionX), value(block::PositionY),
                                     value(block::PositionZ));
            const glm::vec3 velocity(value(block::VelocityX), value(block::VelocityY),
                                     value(block::VelocityZ));
            const float radius = kRoundedUp * value(block::Scale) * type.radius;
            bounds.add(position, radius);
            bounds.add(position - velocity * std::min(value(block::Age), kRoundedUp * snapshot.secondsBack()),
                       radius);
        }
    }
    const uint64_t kept = std::min<uint64_t>(balls, def_.maxParticles);
    SnapshotGroup& blocks = snapshot.editGroup(root);
    blocks.editInfo().bounds = bounds;
    blocks.editConstants()[constant::Blocks] = float(inside);
    blocks.editConstants()[constant::Refused] = float(balls - kept);
    if (def_.isAnimated())
        blocks.editConstants()[constant::Seconds] = float(base::toSeconds(now_));
    if (kinds_.blob == base::kNoKind || kept == 0)
        return;
    SnapshotGroup& expanded = snapshot.addLateGroup(kinds_.blob, base::expandBlocks);
    base::GroupInfo& info = expanded.editInfo();
    info = base;
    info.kind = kinds_.blob;
    info.count = uint32_t(kept);
    info.bounds = bounds;
    info.isLate = true;
    info.isCosmetic = true; // it follows from the other groups, also where it is copied
    const std::span<float> constants = expanded.editConstants();
    constants[base::blob_constant::Layer] = float(uint32_t(def_.layer));
    constants[base::blob_constant::DetailScale] = 1.0f;
    constants[base::blob_constant::Anisotropy] = def_.anisotropy;
    if (hasMaterial() && kinds_.material != base::kNoKind)
        addLateMaterial(root, snapshot);
}

/// The coordinates of the balls of all blocks.
void BlocksSolver::addLateMaterial(size_t root, base::FrameSnapshot& snapshot) const
{
    const size_t place = snapshot.addedCount() - 1; // of the balls
    SnapshotGroup& group = snapshot.addLateGroup(kinds_.material, base::expandMaterials);
    group.editInfo() = snapshot.editGroup(place).info();
    group.editInfo().kind = kinds_.material;
    std::ranges::copy(snapshot.editGroup(root - 1).constants(), group.editConstants().begin());
}

} // namespace fx::sim
