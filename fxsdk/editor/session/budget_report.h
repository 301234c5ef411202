/// @file budget_report.h
/// What an effect costs on this machine: by element, by technique, by stage of a frame, by quality and over
/// time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace fx::editor {

/// Medians of some frames [ms]. The GPU has finished each stage before the next one begins.
struct StageTimes
{
    double simulation = 0.0; ///< of a step of 1/60 s
    double lights = 0.0;     ///< of the light that effects cast, and of the shadows of media
    double stage = 0.0;      ///< of the opaque surroundings
    double effects = 0.0;    ///< of the effects
};

/// What an element or a technique adds. A difference that is below zero counts as 0.
struct PartCost
{
    std::string pointer; ///< of an element, such as "/emitters/0", or of a technique, such as "/emitters"
    /// Of an element: with it alone, less without any. Of a technique: with all elements, less without its
    /// own. The stage is 0.
    StageTimes times;
    /// [ms] by which the sum of the times is uncertain: half the ranges of the repeated frames of both, and
    /// what the whole effect took more or less at the end than at the beginning.
    double noise = 0.0;

    double drawing() const { return times.lights + times.effects; }
    double total() const { return times.simulation + drawing(); }
};

struct QualityCost
{
    std::string name; ///< as of fx render --quality
    uint32_t particles = 0;
    StageTimes times;
    uint32_t texture = 0; ///< GL name of its picture, lower row first
};

struct MomentCost
{
    double time = 0.0; ///< [s]
    uint32_t particles = 0;
    double simulation = 0.0; ///< [ms] of a step of 1/60 s
};

struct BudgetReport
{
    double time = 0.0; ///< [s] that elements, stages and qualities were measured at
    int width = 0;     ///< [pixel]
    int height = 0;    ///< [pixel]
    std::vector<PartCost> elements;
    std::vector<PartCost> techniques;
    size_t unmeasured = 0; ///< elements beyond the largest number that is measured
    std::vector<QualityCost> qualities;
    std::vector<MomentCost> moments;
};

} // namespace fx::editor
