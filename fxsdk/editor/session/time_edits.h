/// @file time_edits.h
/// Adds and removes what happens at a time: triggers of an instance and keys of the camera. Each call is one
/// edit.
#pragma once

#include "fxsdk/editor/document/document.h"
#include "fxsdk/editor/session/orbit_camera.h"

#include <string>
#include <vector>

namespace fx::editor {

/// Pointer of the instance that triggers belong to: that of the selection, otherwise the first one; of a
/// preset
/// "/preview/instance". Empty: the scene has none.
std::string triggeredInstance(const Document& document, const std::string& selection);

/// Names of the events with "on": "host" to which an instance listens, in the order of its preset.
/// @param documentName file of the document, in whose folder presets are searched
std::vector<std::string> triggerNames(const Document& document, const std::string& documentName,
                                      const std::string& instance);

/// Adds a trigger in the order of time. @param time [s] rounded to 1/100 s, and not before the instance
/// starts
/// @return InvalidArgument if `instance` is empty
base::Status addTrigger(Document& io, const std::string& instance, const std::string& name, double time);

/// Adds a key with position and target of `camera`. A key less than 1/200 s from this time is replaced. The
/// camera keeps its other members. @param time [s] rounded to 1/100 s, >= 0
base::Status addCameraKey(Document& io, const OrbitCamera& camera, double time);

/// Removes the element of a list to which a time belongs, and the list with its last one.
/// @param pointer of the time, such as "/camera/keys/1/time"
base::Status removeTimed(Document& io, const std::string& pointer);

/// A position [m] as a document has it: rounded to 1 mm.
Json placeOf(const glm::dvec3& position);

} // namespace fx::editor
