/// @file bounds_trial.h
/// Plays one random preset to a random time, moves the instance, and renders it from a random position.
/// Measures the distance of changed pixels from the published bounds.
#pragma once

#include "tests/api/published_boxes.h"
#include "tests/api/random_preset.h"
#include "tests/api/view_fixture.h"
#include "tests/presets/temp_folder.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include <array>
#include <span>

namespace fx::test {

/// A camera that looks along its local -z axis.
struct TrialCamera
{
    glm::dvec3 origin;
    glm::dmat4 view, projection;
    bool isParallel;
};

/// A ball in world space that no particle should leave.
struct TrialBall
{
    glm::dvec3 center; ///< [m] position of the center in the world
    double radius;     ///< [m]
};

/// Result of a trial.
struct TrialResult
{
    RandomPreset preset;
    int drawn = 0; ///< number of changed pixels
    /// [pixel] Distance of the farthest changed pixel from the bounds, for each kind of omission.
    std::array<double, size_t(Without::Count)> by{};
    double slack = 0;   ///< [pixel] allowed distance of changed pixels from the bounds
    bool isCut = false; ///< true: the bounds extend behind the near plane
    /// [1] Linear size of the bounds in the picture divided by the linear size of the changed pixels; 0: not
    /// measured.
    double tightness = 0;
    double reach = 0; ///< [m] reach that the instance reports
    /// [m] Distance of the ray of the farthest changed pixel from the ball of radius `reach`, minus the
    /// allowed distance.
    double beyond = 0;
    double room = 0;       ///< [1] `reach` divided by the distance of the bounds' farthest corner
    uint32_t onGpu = 0;    ///< number of particles that the GPU computed
    uint32_t thinned = 0;  ///< number of particles that the level of detail omitted
    uint32_t pictures = 0; ///< number of effects that were drawn as impostors
};

class BoundsTrialTest : public ViewApiTest
{
protected:
    BoundsTrialTest();

    /// Runs one trial.
    /// @param isSharp true: uses a preset of sharpPreset(). The instance is moved in the last step and drawn
    /// at
    ///         full detail, large and from the side
    TrialResult tryOne(uint64_t seed, bool isSharp = false);
    /// [m] TrialResult::beyond of the last trial, computed with the reach of the preset `text`.
    double beyondReachOf(const std::string& text);

private:
    FxPresetId load(const std::string& text);
    FxInstanceDef randomInstance(Dice& dice, FxPresetId preset) const;
    void waitForGpu();
    void play(Dice& dice, bool moves, FxInstanceId id, FxInstanceDef& io);
    void move(Dice& dice, FxInstanceId id, FxInstanceDef& io);
    void changeWind(Dice& dice, FxInstanceId id, const FxInstanceDef& def);
    double reachOf(FxInstanceId id);
    FxViewSettings setView(Dice& dice, bool isSharp);
    TrialCamera randomCamera(Dice& dice, bool isAligned, double farther,
                             const std::vector<glm::dvec3>& corners) const;
    void look(const PublishedBoxes& boxes, const FxViewSettings& settings, Dice& dice, bool isSharp,
              TrialResult& io);
    void fillPattern();
    std::vector<glm::dvec2> draw(const TrialCamera& camera);
    void compare(const PublishedBoxes& boxes, const TrialCamera& camera, TrialResult& io) const;
    double beyond(const TrialBall& ball) const;

    TempFolder folder_;
    FxScene* own_ = nullptr;
    std::vector<float> pattern_;
    // Data of the last trial.
    FxInstanceDef def_{};
    TrialCamera camera_{};
    TrialBall ball_{};
    double moved_ = 0;               ///< [m] distance by which the last move displaced the instance
    std::vector<glm::dvec2> pixels_; ///< centers of the changed pixels
    double slack_ = 0;               ///< [pixel]
};

} // namespace fx::test
