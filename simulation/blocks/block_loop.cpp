#include "simulation/blocks/block_loop.h"

#include "foundation/math/hash.h"
#include "foundation/simd/floating_point_scope.h"
#include "foundation/snapshot/blob_kind.h"
#include "simulation/emitters/emitter_def.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fx::sim {

namespace {

namespace blob = base::blob_column;
using base::Code;
using base::Status;
using base::Ticks;

static_assert(blob::Count == 18);

constexpr double kStepsPerSecond = 60.0;
constexpr uint64_t kStepWork = 64; ///< [particle step] of a step without particles
constexpr uint32_t kMaxPeriods = (1u << BlockLoop::kPeriodBits) - 2; ///< of a life, so that ids are unique

/// One emitter whose births end with the period, and what it needs to be stepped alone.
class Recording
{
public:
    Recording(const EmitterDef& emitter, const BlockLoop::Settings& settings)
        : def_(emitter), settings_(settings), tasks_(base::makeSerialRunner()),
          scratch_(std::pmr::get_default_resource()), snapshot_(&schema_, std::pmr::get_default_resource())
    {
        def_.emission.duration =
            std::clamp(settings.period - def_.emission.start, 0.0f, def_.emission.duration);
        schema_.add(base::kBlobKind);
        solver_ = def_.create(schema_, {}, std::pmr::get_default_resource());
    }

    void step(Ticks from, Ticks to)
    {
        scratch_.reset();
        StepContext context{};
        context.tick = from;
        context.stepTicks = to - from;
        context.seed = settings_.seed;
        context.gravity = context.worldGravity = settings_.gravity;
        context.groundHeight = -std::numeric_limits<float>::infinity();
        context.parameters = &parameters_;
        context.tasks = tasks_.get();
        context.scratch = &scratch_;
        context.counters = &counters_;
        solver_->step(context);
    }

    const base::SnapshotGroup* balls(Ticks tick)
    {
        snapshot_.begin(tick, 1);
        solver_->publish({}, snapshot_);
        return snapshot_.groupCount() > 0 ? &snapshot_.group(0) : nullptr;
    }

    bool isOver(Ticks tick) const { return solver_->finished(tick); }
    uint64_t particles() const { return solver_->elementCount(); }

private:
    EmitterDef def_;
    const BlockLoop::Settings& settings_;
    std::unique_ptr<base::TaskRunner> tasks_;
    base::Arena scratch_;
    base::SnapshotSchema schema_;
    base::FrameSnapshot snapshot_;
    std::unique_ptr<Solver> solver_;
    InstanceParameters parameters_;
    StepCounters counters_;
};

} // namespace

base::Result<std::shared_ptr<const BlockLoop>> BlockLoop::record(const EmitterDef& emitter,
                                                                 const Settings& settings)
{
    if (emitter.lifetime.max > settings.period * float(kMaxPeriods))
        return Status(Code::InvalidArgument, "the lifetime is more than " + std::to_string(kMaxPeriods) +
                                                 " periods; make the period longer");
    const base::FloatingPointScope floatingPoint;
    auto loop = std::make_shared<BlockLoop>();
    const uint32_t frames = settings.frames;
    loop->frames_.resize(frames);
    loop->frameTicks_ = std::max(base::toTicks(double(settings.period)) / Ticks(frames), Ticks(1));
    const auto steps =
        std::max(uint32_t(std::ceil(base::toSeconds(loop->frameTicks_) * kStepsPerSecond)), 1u);
    Recording recording(emitter, settings);
    uint64_t work = 0;
    const Ticks end = loop->period() + base::toTicks(double(emitter.lifetime.max)) + loop->frameTicks_;
    for (uint32_t frame = 0;; ++frame) {
        const Ticks now = loop->frameTicks_ * Ticks(frame);
        if (const base::SnapshotGroup* const balls = recording.balls(now))
            for (uint32_t i = 0; i < balls->count(); ++i) {
                Row row{uint32_t(balls->ids()[i]), frame / frames, {}};
                for (size_t k = 0; k < kValues; ++k)
                    row.values[k] = balls->start(k)[i];
                loop->frames_[frame % frames].push_back(row);
                loop->births_ = std::max(loop->births_, uint64_t(row.birth) + 1);
                if (++loop->rows_ > kMaxLoopRows)
                    return Status(Code::TooLarge,
                                  "the loop has more than " + std::to_string(kMaxLoopRows) +
                                      " balls in all frames; lower frames, the rate or the lifetime");
            }
        if (now > end || (now >= loop->period() && recording.isOver(now)))
            break;
        for (uint32_t k = 0; k < steps; ++k) {
            recording.step(now + loop->frameTicks_ * Ticks(k) / Ticks(steps),
                           now + loop->frameTicks_ * Ticks(k + 1) / Ticks(steps));
            work += kStepWork + recording.particles();
            if (work > settings.maxWork)
                return Status(Code::TooLarge, "the loop takes more than " + std::to_string(settings.maxWork) +
                                                  " particle steps; lower the rate, period or lifetime");
        }
    }
    loop->measure();
    if (loop->maxBalls_ == 0)
        return Status(Code::InvalidArgument, "the emitter has no balls within the period");
    return std::shared_ptr<const BlockLoop>(std::move(loop));
}

void BlockLoop::measure()
{
    const auto inOrder = [](const Row& a, const Row& b) {
        return a.birth != b.birth ? a.birth < b.birth : a.copy > b.copy;
    };
    const auto seconds = float(base::toSeconds(frameTicks_));
    double sections = 0, radii = 0;
    for (Frame& frame : frames_) {
        std::stable_sort(frame.begin(), frame.end(), inOrder);
        for (const Row& row : frame) {
            const glm::vec3 position(row.values[0], row.values[1], row.values[2]);
            const glm::vec3 velocity(row.values[3], row.values[4], row.values[5]);
            radius_ = std::max(radius_, glm::length(position) + seconds * glm::length(velocity) +
                                            row.values[blob::Radius]);
            const auto section = double(row.values[blob::CrossSection]);
            sections += section;
            radii += section * double(row.values[blob::Radius]);
        }
    }
    crossSection_ = float(sections / double(std::max<size_t>(frames_.size(), 1)));
    ballRadius_ = sections > 0.0 ? float(radii / sections) : 0.0f;
    for (size_t f = 0; f < frames_.size(); ++f) {
        uint32_t count = 0;
        const bool wraps = f + 1 == frames_.size();
        merge(frames_[f], frames_[wraps ? 0 : f + 1], wraps, [&](const Row*, const Row*) { ++count; });
        maxBalls_ = std::max(maxBalls_, count);
    }
}

/// Calls write(a, b) for each ball of two consecutive frames, with its rows in them, of which one may be
/// null.
/// @param wraps `to` is the first frame, one period later
template <class F>
void BlockLoop::merge(const Frame& from, const Frame& to, bool wraps, F&& write) const
{
    size_t i = 0, k = 0;
    while (i < from.size() || k < to.size()) {
        // The births of the period that begins after `from` have been there for -1 periods.
        const auto key = [](const Row& row, uint32_t earlier) {
            return uint64_t(row.birth) << 32 | (uint32_t(INT32_MAX) + earlier - row.copy);
        };
        const uint64_t a = i < from.size() ? key(from[i], 0) : UINT64_MAX;
        const uint64_t b = k < to.size() ? key(to[k], wraps ? 1 : 0) : UINT64_MAX;
        write(a <= b ? &from[i] : nullptr, b <= a ? &to[k] : nullptr);
        i += a <= b ? 1 : 0;
        k += b <= a ? 1 : 0;
    }
}

uint32_t BlockLoop::write(base::Ticks time, base::SnapshotGroup& io) const
{
    const Ticks whole = time / frameTicks_;
    const auto frame = size_t(whole % Ticks(frames_.size()));
    const auto period = uint32_t(whole / Ticks(frames_.size()));
    const bool wraps = frame + 1 == frames_.size();
    const float share = float(double(time - whole * frameTicks_) / double(frameTicks_));
    const auto seconds = float(base::toSeconds(frameTicks_));
    std::array<float*, kValues> columns{};
    for (size_t k = 0; k < kValues; ++k)
        columns[k] = io.editColumn(k).data();
    uint64_t* const ids = io.editIds().data();
    uint32_t count = 0;
    merge(frames_[frame], frames_[wraps ? 0 : frame + 1], wraps, [&](const Row* a, const Row* b) {
        const uint32_t copy = a ? a->copy : b->copy - (wraps ? 1u : 0u); // wraps around for the next births
        const uint32_t birth = a ? a->birth : b->birth;
        ids[count] = uint64_t(birth) << kPeriodBits | ((period - copy) & ((1u << kPeriodBits) - 1u));
        for (size_t k = 0; k < kValues; ++k)
            columns[k][count] =
                a && b ? a->values[k] + share * (b->values[k] - a->values[k]) : (a ? a : b)->values[k];
        if (!a || !b) {
            const float away = a ? share : share - 1.0f; // [frame] from the frame that has the ball
            for (size_t k = 0; k < 3; ++k)
                columns[blob::PositionX + k][count] += away * seconds * columns[blob::VelocityX + k][count];
            columns[blob::CrossSection][count] *= a ? 1.0f - share : share;
            columns[blob::Age][count] = std::max(columns[blob::Age][count] + away * seconds, 0.0f);
        }
        for (uint32_t i = count++; i > 0 && ids[i] < ids[i - 1]; --i) { // after the number of periods wrapped
            std::swap(ids[i], ids[i - 1]);
            for (float* const column : columns)
                std::swap(column[i], column[i - 1]);
        }
    });
    return count;
}

uint64_t BlockLoop::bytes() const
{
    return rows_ * sizeof(Row) + frames_.size() * sizeof(Frame);
}

uint64_t BlockLoop::hash() const
{
    uint64_t hash = base::hashWord(uint64_t(frameTicks_), frames_.size());
    for (const Frame& frame : frames_)
        hash = base::hashBytes(hash, frame.data(), frame.size() * sizeof(Row));
    return hash;
}

} // namespace fx::sim
