#include "simulation/cloud/moving_cloud.h"

#include "simulation/solver/sequence_player.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <span>

namespace fx::sim {
namespace {

namespace blob = base::blob_column;

constexpr float kDefaultShutter = 1.0f / 60.0f; ///< [s]

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

bool isBorn(const MovingBall& ball)
{
    return ball.age >= 0.0f;
}

/// A ball that only one frame shows. @param away [s] from that frame  @param share of its cross section
MovingBall alone(MovingBall ball, float away, float share)
{
    constexpr float kMost = 1.4f; // of (3)
    ball.ball.center += away * ball.velocity;
    ball.ball.crossSection *= share;
    ball.ball.emission *= power16(std::clamp(1.0f + ball.rate * away / 16.0f, 0.0f, kMost)); // (3)
    return ball;
}

/// Emission between two frames with the rates a and b [1/s].
float emissionBetween(float first, float second, float a, float b, const Moment& moment)
{
    const float w = moment.share, u = 1.0f - w, q1 = root16(first), q2 = root16(second);
    if (a == 0.0f && b == 0.0f)
        return power16(glm::mix(q1, q2, w));
    const float most = 3.0f * std::abs(q2 - q1) + std::max(q1, q2) / 8.0f;
    const float start = std::clamp(moment.seconds * a * q1 / 16.0f, -most, most);
    const float end = std::clamp(moment.seconds * b * q2 / 16.0f, -most, most);
    const float q = (1.0f + 2.0f * w) * u * u * q1 + w * u * u * start + w * w * (3.0f - 2.0f * w) * q2 -
                    w * w * u * end; // (2)
    return power16(std::max(q, 0.0f));
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
            emissionBetween(a.ball.emission[c], b.ball.emission[c], a.rate, b.rate, moment);
    out.velocity = glm::mix(a.velocity, b.velocity, w);
    out.streak = glm::mix(a.streak, b.streak, w);
    return out;
}

/// A ball in the frames around a moment, and in the nearest other frame of its steps; null: not there.
struct Sighting
{
    const MovingBall *earlier = nullptr, *later = nullptr, *other = nullptr;
    double away = 0.0;       ///< [frame] from that of `other`
    float age = kUnknownAge; ///< [s] at the moment; below 0: not yet born
};

MovingBall ballAt(const Sighting& seen, const Moment& moment)
{
    if (seen.earlier && moment.share == 0.0f)
        return *seen.earlier;
    if (seen.earlier && seen.later)
        return between(*seen.earlier, *seen.later, moment);
    if (seen.earlier)
        return alone(*seen.earlier, moment.share * moment.seconds, 1.0f - moment.share);
    if (seen.later)
        return alone(*seen.later, (moment.share - 1.0f) * moment.seconds,
                     seen.later->age < moment.seconds ? 1.0f : moment.share);
    return alone(*seen.other, float(std::clamp(seen.away, -1.0, 1.0)) * moment.seconds, 0.0f);
}

} // namespace

void MovingCloudDef::setFrames(std::vector<std::shared_ptr<const MovingBalls>> balls)
{
    frames = std::move(balls);
    ids_.assign(frames.size(), {});
    counts_.assign(frames.size(), 0);
    mostBalls = 0;
    shutter = 0.0f;
    std::vector<uint64_t> numbers;
    for (size_t i = 0; i < frames.size(); ++i) {
        for (const MovingBall& ball : *frames[i]) {
            numbers.push_back(ball.number);
            if (ball.streak != glm::vec3(0.0f))
                shutter = kDefaultShutter;
        }
    }
    std::ranges::sort(numbers);
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    for (size_t i = 0; i < frames.size(); ++i) {
        ids_[i].reserve(frames[i]->size());
        auto found = numbers.begin();
        for (const MovingBall& ball : *frames[i]) {
            found = std::lower_bound(found, numbers.end(), ball.number);
            ids_[i].push_back(uint32_t(found - numbers.begin()));
        }
    }
    const auto countIn = [&](const Steps& steps) {
        uint32_t count = 0;
        forEachIn(steps, [&](const MovingBall&, uint32_t) { ++count; });
        return count;
    };
    for (size_t i = 0; i < frames.size(); ++i) {
        const auto frame = double(i), halfway = frame + 0.5;
        counts_[i] = countIn({halfway, halfway, halfway});
        mostBalls = std::max(mostBalls, countIn({frame, halfway, frame + 1.5})); // a step ends between frames
    }
}

template <class Visit>
void MovingCloudDef::forEachIn(const Steps& steps, const Visit& visit) const
{
    constexpr size_t kMostFrames = 6; // two around each of three moments
    struct Cursor
    {
        int64_t frame = 0; ///< without the frames of the times that a loop has been played before
        size_t list = 0, at = 0;
    };
    std::array<Cursor, kMostFrames> cursors;
    size_t used = 0;
    for (const double moment : {steps.before, steps.frame, steps.after})
        for (auto k = int64_t(std::floor(moment)); double(k) < moment + 1.0; ++k)
            if (used == 0 || k > cursors[used - 1].frame)
                cursors[used++] = {k, size_t(k) % frames.size(), 0};
    const auto first = int64_t(std::floor(steps.frame));
    const Moment moment{float(steps.frame - double(first)), 1.0f / framesPerSecond};
    for (;;) {
        uint64_t number = std::numeric_limits<uint64_t>::max();
        bool isOver = true;
        for (const Cursor& cursor : std::span(cursors).first(used))
            if (const MovingBalls& balls = *frames[cursor.list]; cursor.at < balls.size()) {
                number = std::min(number, balls[cursor.at].number);
                isOver = false;
            }
        if (isOver)
            return;
        Sighting seen;
        uint32_t id = 0;
        for (Cursor& cursor : std::span(cursors).first(used)) {
            const MovingBalls& balls = *frames[cursor.list];
            if (cursor.at == balls.size() || balls[cursor.at].number != number)
                continue;
            id = ids_[cursor.list][cursor.at];
            const MovingBall* const ball = &balls[cursor.at++];
            const double here = steps.frame - double(cursor.frame); // [frame]
            if (ball->age < kUnknownAge)
                seen.age = ball->age + float(here) * moment.seconds; // frames rise: the last one counts
            if (cursor.frame == first)
                seen.earlier = ball;
            else if (cursor.frame == first + 1 && moment.share > 0.0f)
                seen.later = ball;
            else if (!seen.other || std::abs(here) < std::abs(seen.away)) {
                seen.other = ball;
                seen.away = here;
            }
        }
        if (seen.earlier)
            seen.age = std::max(seen.age, 0.0f); // whatever the next frame says
        MovingBall ball = ballAt(seen, moment);
        ball.age = seen.age;
        visit(ball, id);
    }
}

MovingBalls MovingCloudDef::at(double frame) const
{
    MovingBalls balls;
    balls.reserve(countAt(frame));
    const double shown = frames.size() == 1 ? 0.0 : frame; // a single frame does not move
    forEachIn({shown, shown, shown}, [&](const MovingBall& ball, uint32_t) {
        if (isBorn(ball))
            balls.push_back(ball);
    });
    return balls;
}

uint32_t MovingCloudDef::countAt(double frame) const
{
    const auto first = size_t(frame);
    return float(frame - double(first)) > 0.0f ? counts_[first] : uint32_t(frames[first]->size());
}

class MovingCloudSolver final : public SequencePlayer
{
public:
    MovingCloudSolver(const MovingCloudDef& def, base::KindId kind)
        : SequencePlayer(def.time()), def_(def), kind_(kind)
    {}

    void publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const override
    {
        if (kind_ == base::kNoKind)
            return;
        const MovingCloudDef::Steps steps = stepsOf(base.step);
        uint32_t count = 0;
        def_.forEachIn(steps, [&](const MovingBall& ball, uint32_t) { count += isBorn(ball); });
        BlobWriter writer(snapshot, base, kind_, count, std::max(def_.capacity(), count));
        StillMediumSolver::writeShared(def_, writer);
        writer.constant(base::blob_constant::Shutter) = def_.shutter;
        const float early = // [s] before the start
            std::clamp(float(base::toSeconds(now())), -1.0f / def_.framesPerSecond, 0.0f);
        uint32_t i = 0;
        def_.forEachIn(steps, [&](const MovingBall& moving, uint32_t id) {
            if (!isBorn(moving))
                return;
            const ListedBall& ball = moving.ball;
            const glm::vec3 velocity = def_.shutter > 0.0f ? moving.streak / def_.shutter : moving.velocity;
            for (int k = 0; k < 3; ++k) {
                writer.column(blob::PositionX + size_t(k))[i] =
                    def_.position[k] + def_.scale * (ball.center[k] + early * moving.velocity[k]);
                writer.column(blob::VelocityX + size_t(k))[i] = def_.scale * velocity[k];
                writer.column(blob::AlbedoR + size_t(k))[i] = ball.albedo[k];
                writer.column(blob::EmissionR + size_t(k))[i] = ball.emission[k];
            }
            writer.column(blob::Radius)[i] = def_.scale * ball.radius;
            writer.column(blob::CrossSection)[i] = def_.sectionScale() * ball.crossSection;
            writer.column(blob::Temperature)[i] = ball.temperature;
            writer.column(blob::Age)[i] = moving.age;
            writer.ids()[i] = blobId(base.solver, id);
            ++i;
        });
        writer.closeBounds();
    }

    uint32_t elementCount() const override { return def_.countAt(frame()); }
    bool hasElements() const override { return true; } // of another frame

private:
    MovingCloudDef::Steps stepsOf(base::Ticks step) const
    {
        const SequenceTime time = def_.time();
        const SequenceTime::Way way = time.wayTo(now(), step);
        const double last = time.end == SequenceEnd::Loop ? INFINITY : double(time.count - 1);
        const auto shown = [&](double frame) { return std::clamp(frame, 0.0, last); };
        return {shown(way.before), shown(way.frame), shown(2.0 * way.frame - way.before)};
    }

    const MovingCloudDef& def_;
    base::KindId kind_;
};

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
    return balls * (sizeof(MovingBall) + sizeof(uint32_t)) + frames.size() * sizeof(uint32_t);
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
