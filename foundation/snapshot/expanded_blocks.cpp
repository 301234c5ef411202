#include "foundation/snapshot/expanded_blocks.h"

#include "foundation/snapshot/block_groups.h"

#include <algorithm>
#include <array>

namespace fx::base {

namespace {

namespace blob = blob_column;

/// Blocks whose rows are to be expanded.
struct Level
{
    BlockFrame frame;
    const SnapshotGroup* blocks = nullptr;
    uint32_t row = 0; ///< next row
};

class BallWriter
{
public:
    explicit BallWriter(SnapshotGroup& group) : group_(group) {}

    bool isFull() const { return next_ == group_.count(); }
    uint32_t missing() const { return group_.count() - next_; }

    void write(const SnapshotGroup& balls, const BlockFrame& frame)
    {
        const uint32_t count = std::min(balls.count(), group_.count() - next_);
        const float section = frame.density * frame.scale * frame.scale;
        for (uint32_t i = 0; i < count; ++i) {
            const uint32_t to = next_ + i;
            const glm::vec3 position = frame.position + frame.turned(vectorAt(balls, blob::PositionX, i));
            const glm::vec3 velocity = frame.velocity + frame.turned(vectorAt(balls, blob::VelocityX, i));
            for (int k = 0; k < 3; ++k) {
                column(blob::PositionX + size_t(k))[to] = position[k];
                column(blob::VelocityX + size_t(k))[to] = velocity[k];
            }
            column(blob::Radius)[to] = frame.scale * balls.start(blob::Radius)[i];
            column(blob::CrossSection)[to] = section * balls.start(blob::CrossSection)[i];
            column(blob::Age)[to] = std::min(frame.age, balls.start(blob::Age)[i]);
            group_.editIds()[to] = frame.id + balls.ids()[i];
        }
        for (const size_t same : kSame)
            std::copy_n(balls.start(same), count, column(same) + next_);
        next_ += count;
    }

private:
    static constexpr size_t kSame[] = {blob::Temperature, blob::AlbedoR,   blob::AlbedoG,
                                       blob::AlbedoB,     blob::EmissionR, blob::EmissionG,
                                       blob::EmissionB,   blob::FireShare, blob::Heat};

    float* column(size_t index) { return group_.editColumn(index).data(); }

    SnapshotGroup& group_;
    uint32_t next_ = 0;
};

/// Calls write(balls, frame, row) for the balls of each block, with the row of the effect's block that they
/// are in, until isFull().
template <class IsFull, class Write>
void forEachBlock(const BlockGroups& groups, IsFull&& isFull, Write&& write)
{
    std::array<Level, kMaxBlockLevels> stack;
    size_t depth = 0;
    stack[depth++].blocks = &groups.root();
    while (depth > 0 && !isFull()) {
        Level& top = stack[depth - 1];
        if (top.row == top.blocks->count()) {
            --depth;
            continue;
        }
        const uint32_t row = top.row++;
        const SnapshotGroup* const content = groups.contentOf(*top.blocks, row);
        if (!content)
            continue;
        const BlockFrame inner = top.frame.inside(*top.blocks, row);
        if (!groups.isBlocks(*content))
            write(*content, inner, stack[0].row - 1);
        else if (depth < stack.size())
            stack[depth++] = {inner, content, 0};
    }
}

} // namespace

void expandBlocks(const FrameSnapshot& snapshot, size_t place, SnapshotGroup& io)
{
    BallWriter writer(io);
    forEachBlock(
        BlockGroups(snapshot, place), [&] { return writer.isFull(); },
        [&](const SnapshotGroup& balls, const BlockFrame& frame, uint32_t) { writer.write(balls, frame); });
    io.editInfo().count -= writer.missing();
}

LateRows lateRowsOf(const KindDesc& kind)
{
    return kind == kMaterialKind ? expandMaterials : expandBlocks;
}

void expandMaterials(const FrameSnapshot& snapshot, size_t place, SnapshotGroup& io)
{
    const BlockGroups groups(snapshot, place - 1);
    const SnapshotGroup* const own = groups.material();
    uint32_t next = 0;
    forEachBlock(
        groups, [&] { return !own || next == io.count(); },
        [&](const SnapshotGroup& balls, const BlockFrame& frame, uint32_t row) {
            const glm::vec3 block = vectorAt(groups.root(), block_column::PositionX, row);
            const uint32_t count = std::min(balls.count(), io.count() - next);
            for (uint32_t i = 0; i < count; ++i, ++next) {
                const glm::vec3 away =
                    frame.position - block + frame.turned(vectorAt(balls, blob::PositionX, i));
                for (size_t c = 0; c < material_column::Count; ++c)
                    io.editColumn(c)[next] = own->start(c)[row] + away[int(c % 3)];
                io.editIds()[next] = frame.id + balls.ids()[i];
            }
        });
    io.editInfo().count = next;
}

} // namespace fx::base
