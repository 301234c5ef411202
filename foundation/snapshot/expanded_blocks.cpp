#include "foundation/snapshot/expanded_blocks.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>

namespace fx::base {

namespace {

namespace blob = blob_column;
namespace block = block_column;

constexpr uint32_t kAbsent = UINT32_MAX;

glm::vec3 vectorAt(const SnapshotGroup& group, size_t first, uint32_t i)
{
    return {group.start(first)[i], group.start(first + 1)[i], group.start(first + 2)[i]};
}

/// What the blocks above an element do to it.
struct Frame
{
    const SnapshotGroup* blocks = nullptr; ///< group whose rows are to be expanded
    uint32_t row = 0;                      ///< next row
    glm::vec3 position{0.0f};
    glm::vec3 velocity{0.0f};
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    float scale = 1.0f;
    float density = 1.0f;
    float age = kSettledAge;
    uint64_t id = 0;

    glm::vec3 turned(const glm::vec3& v) const { return rotation * (scale * v); }

    /// The frame of the content of the block in row `i` of `blocks`.
    Frame inside(uint32_t i) const
    {
        const auto value = [&](size_t column) { return blocks->start(column)[i]; };
        Frame inner;
        inner.position = position + turned(vectorAt(*blocks, block::PositionX, i));
        inner.velocity = velocity + turned(vectorAt(*blocks, block::VelocityX, i));
        inner.rotation = rotation * glm::quat(value(block::RotationW), value(block::RotationX),
                                              value(block::RotationY), value(block::RotationZ));
        inner.scale = scale * value(block::Scale);
        inner.density = density * value(block::Density);
        inner.age = std::min(age, value(block::Age));
        inner.id = id + blocks->ids()[i];
        return inner;
    }
};

class BallWriter
{
public:
    explicit BallWriter(SnapshotGroup& group) : group_(group) {}

    bool isFull() const { return next_ == group_.count(); }
    uint32_t missing() const { return group_.count() - next_; }

    void write(const SnapshotGroup& balls, const Frame& frame)
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

/// The groups of a solver's blocks.
class BlockGroups
{
public:
    /// @param end one above the place of the last of them; the first one is the blocks of the effect
    BlockGroups(const FrameSnapshot& snapshot, size_t end) : snapshot_(snapshot), root_(end - 1)
    {
        places_.fill(kAbsent);
        const KindId balls = snapshot.schema().find(kBlockBallKind.name);
        for (; root_ > 0; --root_) {
            const SnapshotGroup& group = snapshot.added(root_);
            const float variant =
                group.constants()[group.info().kind == balls ? size_t(block_ball_constant::Variant)
                                                             : size_t(block_constant::Owner)];
            if (variant == kNoOwner)
                break;
            places_[size_t(variant)] = uint32_t(root_);
        }
        leaveOutEmpty(end);
    }

    const SnapshotGroup& root() const { return snapshot_.added(root_); }
    bool isBlocks(const SnapshotGroup& group) const { return group.info().kind == root().info().kind; }
    /// The content of the block in row `i`; null if its variant has no group.
    const SnapshotGroup* contentOf(const SnapshotGroup& blocks, uint32_t i) const
    {
        const uint32_t place = places_[size_t(blocks.start(block::Variant)[i])];
        return place == kAbsent ? nullptr : &snapshot_.added(place);
    }

private:
    /// Removes the variants without any ball, so that a walk through blocks ends with the balls. What a block
    /// consists of comes before it.
    void leaveOutEmpty(size_t end)
    {
        const KindId balls = snapshot_.schema().find(kBlockBallKind.name);
        for (size_t place = root_ + 1; place < end; ++place) {
            const SnapshotGroup& group = snapshot_.added(place);
            const bool isBalls = group.info().kind == balls;
            bool isEmpty = group.count() == 0;
            for (uint32_t i = 0; !isBalls && !isEmpty; ++i) {
                if (i == group.count())
                    isEmpty = true;
                else if (contentOf(group, i))
                    break;
            }
            if (isEmpty)
                places_[size_t(group.constants()[isBalls ? size_t(block_ball_constant::Variant)
                                                         : size_t(block_constant::Owner)])] = kAbsent;
        }
    }

    const FrameSnapshot& snapshot_;
    std::array<uint32_t, kMaxBlockVariants> places_; ///< by variant
    size_t root_;
};

} // namespace

void expandBlocks(const FrameSnapshot& snapshot, size_t place, SnapshotGroup& io)
{
    const BlockGroups groups(snapshot, place);
    BallWriter writer(io);
    std::array<Frame, kMaxBlockLevels> stack;
    size_t depth = 0;
    stack[depth++].blocks = &groups.root();
    while (depth > 0 && !writer.isFull()) {
        Frame& top = stack[depth - 1];
        if (top.row == top.blocks->count()) {
            --depth;
            continue;
        }
        const uint32_t row = top.row++;
        const SnapshotGroup* const content = groups.contentOf(*top.blocks, row);
        if (!content)
            continue;
        Frame inner = top.inside(row);
        if (!groups.isBlocks(*content)) {
            writer.write(*content, inner);
        } else if (depth < stack.size()) {
            inner.blocks = content;
            stack[depth++] = inner;
        }
    }
    io.editInfo().count -= writer.missing();
}

} // namespace fx::base
