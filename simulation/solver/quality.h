/// @file quality.h
/// Simulation quality, which controls the cost of an instance. The quality is chosen when the instance is
/// created and does not change. Therefore equal calls give equal bits.
///
/// Quality applies to gases, not to emitters. The author chooses the particle counts of emitters. The cost of
/// an emitter is small compared to a gas, and fewer but denser particles would change the picture.
#pragma once

#include <cstdint>

namespace fx::sim {

enum class QualityLevel : uint8_t
{
    Low,
    Medium, ///< the level for which presets are designed
    High,
    Reference, ///< reference level, against which errors of all other levels are measured
};

/// Parameters of solvers at a quality level. `fx accuracy` measures the errors of the levels.
struct Quality
{
    QualityLevel level = QualityLevel::Medium;
    float particles = 1.0f; ///< [1] factor on the preset's number of particles, > 0
    /// [1] nominal number of neighbors, 4/3 pi n H^3, with the number density n and the support radius H
    float neighbors = 58.0f;
    /// [1] smallest radius of a gas particle, relative to its radius at release; 0: no limit
    float radiusFloor = 0.25f;
    /// [1] Highest Mach number of the flow that the reduction of the speed of sound may cause; 0: the speed
    /// of sound is not reduced. The reduction allows longer steps.
    float flowMach = 0.3f;
};

constexpr Quality qualityOf(QualityLevel level)
{
    switch (level) {
    case QualityLevel::Low:
        return {level, 0.25f, 40.0f, 0.5f, 0.3f};
    case QualityLevel::Medium:
        break;
    case QualityLevel::High:
        return {level, 2.0f, 58.0f, 0.1f, 0.075f};
    case QualityLevel::Reference:
        return {level, 4.0f, 93.0f, 0.0f, 0.0f};
    }
    return {};
}

} // namespace fx::sim
