/// @file stages.h
/// Stages on which any preset or scene can be shown. A stage is a set of members of a preset's "preview", or
/// of a scene: mesh, light, background and exposure, in one case also the camera.
///
/// Threads: any.
#pragma once

#include "foundation/result/embedded_text.h"

#include <nlohmann/json.hpp>

#include <span>
#include <string>
#include <string_view>

namespace fx::scene_file {

struct Stage
{
    std::string_view name;        ///< for options and files, such as "studio-gray"
    std::string_view description; ///< one line for people
    std::string_view members;     ///< JSON object
};

/// All stages; the first is the one that presets without a "preview" stand on.
std::span<const Stage> stages();

/// What library:NAME means for meshes and props of scenes and previews: the files of
/// preset::libraryFiles(), and the meshes of stages, which games do not need and libfxsdk does not have.
std::span<const base::EmbeddedText> libraryWithStages();

/// @return null if there is no stage of the name
const Stage* findStage(std::string_view name);

/// Replaces mesh, light, background and exposure by those of a stage. Other members, such as figure and
/// props, stay.
/// @param io the object "preview" of a preset, or a scene
/// @param name of stages()
void setStage(nlohmann::ordered_json& io, std::string_view name);

/// The text of a preset whose "preview" has the stage. A text that is no JSON object is returned unchanged,
/// for readers to report.
std::string presetOnStage(const std::string& text, std::string_view name);

} // namespace fx::scene_file
