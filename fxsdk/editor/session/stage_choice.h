/// @file stage_choice.h
/// What the picture of the editor shows around the effect: a stage, a figure, sun and sky. The choice belongs
/// to the view; the document has it only when it is kept.
#pragma once

#include "fxsdk/editor/document/schema_tree.h"

#include <glm/vec3.hpp>

#include <optional>
#include <string>

namespace fx::editor {

/// Members without a value are those of the document, or of the stage where one is chosen.
struct StageChoice
{
    std::string name; ///< of scene_file::stages(); empty: the stage of the document
    std::string
        meshFile; ///< OBJ file in the folder of the document, instead of the stage's mesh; empty: none
    /// Whether a person of 1.8 m stands beside the effect; presets only.
    std::optional<bool> hasFigure;
    std::optional<glm::dvec3> sunDirection; ///< unit vector towards the sun
    std::optional<double> sunIlluminance;   ///< [lx] of the channel green, >= 0
    /// [cd/m2] of the channel green, >= 0. The background changes in proportion.
    std::optional<double> skyLuminance;
    /// Color of the sky: ratios of its channels to green, whose own is 1. The background changes in
    /// proportion.
    std::optional<glm::dvec3> skyColor;

    bool operator==(const StageChoice&) const = default;
};

/// Light of a document: that which it states, otherwise that of the first stage.
struct StageLightValues
{
    glm::dvec3 sunDirection{0.0, 1.0, 0.0}; ///< unit vector
    double sunIlluminance = 0.0;            ///< [lx] of the channel green
    double skyLuminance = 0.0;              ///< [cd/m2] of the channel green
    glm::dvec3 sky{0.0};                    ///< [cd/m2] of all channels
};
StageLightValues lightOf(const Json& document, DocumentKind kind);

/// Sets luminance and color of the sky. A sky without green gets a little of it.
/// @param sky [cd/m2] of all channels, >= 0
void setSky(StageChoice& io, const glm::dvec3& sky);

/// Whether a person stands beside the effect of a preset.
bool hasFigure(const Json& document);

/// The document with the choice as members: of "preview" in a preset, of the document in a scene.
Json onStage(const Json& document, DocumentKind kind, const StageChoice& choice);

/// A direction from its heading about +Y (0: +Z, 90: +X) and its elevation [degree].
glm::dvec3 directionOf(double headingDegrees, double elevationDegrees);
double headingOf(const glm::dvec3& direction);   ///< [degree] in -180..180
double elevationOf(const glm::dvec3& direction); ///< [degree] in -90..90

} // namespace fx::editor
