#include "fxsdk/editor/preview/instance_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::editor {

namespace {

constexpr double kLongest = 60.0;  ///< [s] after which a circle ends
constexpr double kGravity = 9.81;  ///< [m/s2]
constexpr int kTurnKeys = 16;      ///< keys of a turn; between them the way is smooth
constexpr double kThrowKey = 0.05; ///< [s] between keys

/// Puts an instance where its motion brings it by a scene time [s], and takes away what is not played.
void holdStill(scene_file::SceneInstance& io, double time)
{
    const base::Placement place = io.placementAt(time);
    io.position = place.position;
    io.rotation = place.rotation;
    const bool emits = scene_file::valueAt(io.play.emitting, io.start, 1.0) > 0.0;
    io.play = {};
    if (!emits)
        io.play.emitting = {{0.0, 0.0}};
}

void addCircle(const MotionChoice& motion, scene_file::SceneInstance& io)
{
    const glm::dvec3 center = io.position;
    const double turn = 2.0 * std::numbers::pi * motion.radius / motion.speed; // [s]
    const int keys = int(std::clamp(std::ceil(kLongest / turn * kTurnKeys), 2.0, 4096.0));
    for (int i = 0; i <= keys; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kTurnKeys;
        scene_file::InstanceKey key;
        key.time = io.start + turn * i / kTurnKeys;
        key.position = center + motion.radius * glm::dvec3(std::cos(angle), 0.0, -std::sin(angle));
        io.play.keys.push_back(key);
    }
    io.play.moves = true;
}

void addThrow(const MotionChoice& motion, scene_file::SceneInstance& io)
{
    const glm::dvec3 from = io.position;
    const double along = motion.speed * std::numbers::sqrt2 / 2.0; // [m/s] both forwards and upwards
    const double end = std::min(2.0 * along / kGravity, kLongest);
    const int keys = int(std::clamp(std::ceil(end / kThrowKey), 2.0, 4096.0));
    for (int i = 0; i <= keys; ++i) {
        const double t = end * i / keys;
        scene_file::InstanceKey key;
        key.time = io.start + t;
        key.position = from + glm::dvec3(along * t, along * t - 0.5 * kGravity * t * t, 0.0);
        io.play.keys.push_back(key);
    }
    io.play.moves = true;
}

} // namespace

void setMotion(const MotionChoice& motion, double stillTime, scene_file::SceneInstance& io)
{
    if (motion.kind == MotionKind::Document)
        return;
    holdStill(io, stillTime);
    if (motion.kind == MotionKind::Circle)
        addCircle(motion, io);
    else if (motion.kind == MotionKind::Throw)
        addThrow(motion, io);
}

bool isPlayed(const scene_file::SceneFile& file)
{
    return std::any_of(file.instances.begin(), file.instances.end(), [](const auto& instance) {
        const scene_file::InstancePlay& play = instance.play;
        const bool onlyEmits = play.keys.empty() && play.speed.empty() && play.triggers.empty() &&
                               play.jumps.empty() && play.emitting.size() == 1 &&
                               play.emitting.front().time <= instance.start;
        return !play.isEmpty() && !onlyEmits; // what emits or not from its start on needs no steps
    });
}

} // namespace fx::editor
