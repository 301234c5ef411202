#include "simulation/cloud/moving_cloud.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::sim {
namespace {

namespace blob = base::blob_column;

constexpr float kDefaultShutter = 1.0f / 60.0f; ///< [s]
constexpr float kBorn = 1.0f; ///< [s] age of all balls: longer than a step, in which none is hidden

float root16(float x)
{
    return std::sqrt(std::sqrt(std::sqrt(std::sqrt(x))));
}

float power16(float x)
{
    const float square = x * x, fourth = square * square, eighth = fourth * fourth;
    return eighth * eighth;
}

/// Moment between two frames.
struct Moment
{
    float share = 0.0f;   ///< w
    float seconds = 0.0f; ///< T
};

/// A ball that only one frame shows. @param away [s] from that frame  @param share of its cross section
MovingBall alone(MovingBall ball, float away, float share)
{
    ball.ball.center += away * ball.velocity;
    ball.ball.crossSection *= share;
    return ball;
}

MovingBall between(const MovingBall& a, const MovingBall& b, const Moment& moment)
{
    const float w = moment.share, u = 1.0f - w, t = moment.seconds;
    MovingBall out = a;
    out.ball.center = (1.0f + 2.0f * w) * u * u * a.ball.center + w * u * u * t * a.velocity +
                      w * w * (3.0f - 2.0f * w) * b.ball.center - w * w * u * t * b.velocity; // (1)
    out.ball.radius = glm::mix(a.ball.radius, b.ball.radius, w);
    out.ball.crossSection = glm::mix(a.ball.crossSection, b.ball.crossSection, w);
    out.ball.temperature = glm::mix(a.ball.temperature, b.ball.temperature, w);
    out.ball.albedo = glm::mix(a.ball.albedo, b.ball.albedo, w);
    for (int c = 0; c < 3; ++c)
        out.ball.emission[c] =
            power16(glm::mix(root16(a.ball.emission[c]), root16(b.ball.emission[c]), w)); // (2)
    out.velocity = glm::mix(a.velocity, b.velocity, w);
    out.streak = glm::mix(a.streak, b.streak, w);
    return out;
}

MovingBalls blend(const MovingBalls& first, const MovingBalls& second, const Moment& moment)
{
    MovingBalls out;
    out.reserve(std::max(first.size(), second.size()));
    const float since = moment.share * moment.seconds, until = (1.0f - moment.share) * moment.seconds;
    for (size_t i = 0, j = 0; i < first.size() || j < second.size();) {
        if (j == second.size() || (i < first.size() && first[i].number < second[j].number))
            out.push_back(alone(first[i++], since, 1.0f - moment.share));
        else if (i == first.size() || second[j].number < first[i].number)
            out.push_back(alone(second[j++], -until, moment.share));
        else
            out.push_back(between(first[i++], second[j++], moment));
    }
    return out;
}

} // namespace

class MovingCloudSolver final : public Solver, public SeekableSolver
{
public:
    MovingCloudSolver(const MovingCloudDef& def, base::KindId kind) : def_(def), kind_(kind) {}

    void step(const StepContext& context) override { tick_ = context.tick + context.stepTicks; }
    void seek(const StepContext&, base::Ticks tick) override { tick_ = tick; }
    bool canSeek(const StepContext&, base::Ticks) const override { return true; }
    bool finished(base::Ticks) const override { return false; }
    base::Ticks restsUntil(base::Ticks tick) const override { return def_.time().restsUntil(tick); }
    void save(StateWriter& writer) const override { writer.value(tick_); }
    void restore(StateReader& reader) override { tick_ = reader.value<base::Ticks>(); }
    SeekableSolver* seekable() override { return this; }

    void publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const override
    {
        if (kind_ == base::kNoKind)
            return;
        const MovingBalls balls = def_.at(def_.time().frameAt(tick_));
        const auto count = uint32_t(balls.size());
        BlobWriter writer(snapshot, base, kind_, count, std::max(def_.capacity(), count));
        StillMediumSolver::writeShared(def_, writer);
        writer.constant(base::blob_constant::Shutter) = def_.shutter;
        writer.fill(blob::Age, kBorn);
        const float perShutter = def_.shutter > 0.0f ? def_.scale / def_.shutter : 0.0f;
        size_t id = 0;
        for (uint32_t i = 0; i < count; ++i) {
            const ListedBall& ball = balls[i].ball;
            for (int k = 0; k < 3; ++k) {
                writer.column(blob::PositionX + size_t(k))[i] =
                    def_.position[k] + def_.scale * ball.center[k];
                writer.column(blob::VelocityX + size_t(k))[i] = perShutter * balls[i].streak[k];
                writer.column(blob::AlbedoR + size_t(k))[i] = ball.albedo[k];
                writer.column(blob::EmissionR + size_t(k))[i] = ball.emission[k];
            }
            writer.column(blob::Radius)[i] = def_.scale * ball.radius;
            writer.column(blob::CrossSection)[i] = def_.sectionScale() * ball.crossSection;
            writer.column(blob::Temperature)[i] = ball.temperature;
            while (def_.numbers_[id] < balls[i].number)
                ++id;
            writer.ids()[i] = blobId(base.solver, id);
        }
        writer.closeBounds();
    }

    uint32_t elementCount() const override
    {
        return uint32_t(def_.frames[size_t(def_.time().frameAt(tick_))]->size());
    }
    bool hasElements() const override { return true; } // of another frame

private:
    const MovingCloudDef& def_;
    base::KindId kind_;
    base::Ticks tick_ = 0;
};

void MovingCloudDef::setFrames(std::vector<std::shared_ptr<const MovingBalls>> balls)
{
    frames = std::move(balls);
    numbers_.clear();
    mostBalls = 0;
    shutter = 0.0f;
    for (size_t i = 0; i < frames.size(); ++i) {
        for (const MovingBall& ball : *frames[i]) {
            numbers_.push_back(ball.number);
            if (ball.streak != glm::vec3(0.0f))
                shutter = kDefaultShutter;
        }
        const MovingBalls& next = *frames[(i + 1) % frames.size()];
        mostBalls = std::max(mostBalls, uint32_t(blend(*frames[i], next, {0.5f, 0.0f}).size()));
    }
    std::ranges::sort(numbers_);
    numbers_.erase(std::unique(numbers_.begin(), numbers_.end()), numbers_.end());
}

MovingBalls MovingCloudDef::at(double frame) const
{
    const auto first = size_t(frame);
    const auto share = float(frame - double(first));
    if (!(share > 0.0f))
        return *frames[first];
    return blend(*frames[first], *frames[(first + 1) % frames.size()], {share, 1.0f / framesPerSecond});
}

std::unique_ptr<Solver> MovingCloudDef::create(const base::SnapshotSchema& schema, const Quality&,
                                               std::pmr::memory_resource*) const
{
    return std::make_unique<MovingCloudSolver>(*this, schema.find(base::kBlobKind.name));
}

uint64_t MovingCloudDef::bytes() const
{
    uint64_t balls = 0;
    for (const std::shared_ptr<const MovingBalls>& frame : frames)
        balls += frame->size();
    return balls * sizeof(MovingBall) + numbers_.size() * sizeof(uint64_t);
}

float MovingCloudDef::reach(float, float, float) const
{
    float farthest = 0.0f;
    for (const std::shared_ptr<const MovingBalls>& frame : frames)
        for (const MovingBall& own : *frame) { // between frames by at most two thirds of a step farther
            const float way = glm::length(own.velocity) / framesPerSecond + glm::length(own.streak);
            farthest = std::max(farthest, glm::length(position + scale * own.ball.center) +
                                              scale * (own.ball.radius + way));
        }
    return farthest * 1.0001f; // above rounding
}

} // namespace fx::sim
