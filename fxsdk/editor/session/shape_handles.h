/// @file shape_handles.h
/// Spawn shapes and force fields of an element as wires, with the places that can be dragged.
#pragma once

#include "fxsdk/editor/document/document.h"

#include <glm/vec3.hpp>

#include <string>
#include <utility>
#include <vector>

namespace fx::editor {

/// How the place of a handle becomes a value.
enum class HandleKind
{
    Position,  ///< [x, y, z]: the place relative to `center`
    Length,    ///< a number: distance from `center` along `along`
    Extent,    ///< one of three numbers: likewise
    Direction, ///< [x, y, z]: unit vector from `center` to the place
};

struct ShapeHandle
{
    std::string pointer; ///< of the member that is edited
    HandleKind kind = HandleKind::Position;
    glm::dvec3 place{0.0};           ///< [m] in the coordinates of the preset
    glm::dvec3 center{0.0};          ///< [m]
    glm::dvec3 along{0.0, 1.0, 0.0}; ///< unit vector; of Length and Extent
    int component = 0;               ///< of Extent: 0 to 2
};

struct ShapeWires
{
    std::vector<std::pair<glm::dvec3, glm::dvec3>> lines; ///< [m] in the coordinates of the preset
    std::vector<ShapeHandle> handles;
};

/// Pointer of the element of a technique, such as "/emitters/0", that has the value at `pointer`; empty:
/// none.
std::string elementOf(const Document& document, const std::string& pointer);

/// Wires and handles of an element of a preset. Handles of a scene are the positions of its instances.
ShapeWires shapeWires(const Document& document, const std::string& element);

/// Value of the member of a handle at another place, rounded to 1 mm (of directions: to 1/1000) and limited
/// to the range of the schema.
Json valueAt(const Document& document, const ShapeHandle& handle, const glm::dvec3& place);

} // namespace fx::editor
