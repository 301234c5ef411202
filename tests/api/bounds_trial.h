/// @file bounds_trial.h
/// Plays one random preset to a random time, moves it, and renders it from a random position. Measures which
/// pixels change and how far they are outside of the published bounds.
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
    glm::dvec3 center; ///< [m] world
    double radius;     ///< [m]
};

/// Result of a trial.
struct TrialResult
{
    RandomPreset preset;
    int drawn = 0; ///< number of changed pixels
    /// [pixel] distance of the farthest changed pixel from the bounds
    std::array<double, size_t(Without::Count)> by{};
    double slack = 0;      ///< [pixel] allowed distance
    bool isCut = false;    ///< the bounds reach behind the near plane
    double tightness = 0;  ///< [1] linear size of the bounds on the picture over that of what was drawn; 0:
                           ///< cannot be told
    double reach = 0;      ///< [m] reach that the instance reports
    double beyond = 0;     ///< [m] of the ray of the farthest pixel from the ball of that radius, less slack
    double room = 0;       ///< [1] that radius over the distance of the bounds' farthest corner
    uint32_t onGpu = 0;    ///< number of rows that the GPU computed
    uint32_t thinned = 0;  ///< number of rows that the level of detail left out
    uint32_t pictures = 0; ///< number of effects drawn as impostors
};

class BoundsTrialTest : public ViewApiTest
{
protected:
    BoundsTrialTest();

    /// @param isSharp uses sharpPreset(), moved in the last step and drawn at full detail, large and from the
    ///          side
    TrialResult tryOne(uint64_t seed, bool isSharp = false);
    /// [m] of the farthest pixel of the last trial from the reach that another preset would have in its
    /// place, as TrialResult::beyond.
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
    // of the last trial
    FxInstanceDef def_{};
    TrialCamera camera_{};
    TrialBall ball_{};
    double moved_ = 0;               ///< [m] by its last move
    std::vector<glm::dvec2> pixels_; ///< middles of those that changed
    double slack_ = 0;               ///< [pixel]
};

} // namespace fx::test
