/// @file budget_report.h
/// What an effect costs on this machine: by element, by stage of a frame, by quality and over time.
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

struct ElementCost
{
    std::string pointer;  ///< such as "/emitters/0"
    double drawing = 0.0; ///< [ms] lights and effects with this element alone, less those without any
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
    std::vector<ElementCost> elements;
    std::vector<QualityCost> qualities;
    std::vector<MomentCost> moments;
};

} // namespace fx::editor
