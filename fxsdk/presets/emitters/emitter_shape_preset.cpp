#include "foundation/tasks/task_runner.h"
#include "fxsdk/assets/obj_reader.h"
#include "fxsdk/presets/emitters/emitter_parts_preset.h"
#include "simulation/particles/fields/spline_path.h"
#include "simulation/particles/shapes/mesh_sampler.h"
#include "simulation/particles/shapes/shape_sample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>

namespace fx::preset {

namespace {

constexpr uint64_t kMaxMeshText = uint64_t(64) << 20; ///< [byte]

using sim::ShapeKind;
static_assert(uint8_t(ShapeKind::Cone) == uint8_t(sim::EmitterShape::Cone) &&
              uint8_t(ShapeKind::Sphere) == uint8_t(sim::EmitterShape::Sphere));

constexpr std::array<std::pair<std::string_view, ShapeKind>, 10> kShapes{{
    {"point", ShapeKind::Point},
    {"sphere", ShapeKind::Sphere},
    {"box", ShapeKind::Box},
    {"cone", ShapeKind::Cone},
    {"line", ShapeKind::Line},
    {"disc", ShapeKind::Disc},
    {"torus", ShapeKind::Torus},
    {"mesh", ShapeKind::Mesh},
    {"spline", ShapeKind::Spline},
    {"volume", ShapeKind::Volume},
}};

/// A finding about the asset that the member names.
void blame(const PresetValue& value, const char* member, const base::Status& status)
{
    std::string name;
    value.read(member, name);
    value.error(member, "asset \"" + name + "\": " + status.message());
}

/// The bytes of the asset that the member names, or nothing after a finding.
/// @param wanted says what kind of file is needed, and gives an example
std::optional<std::string> readBytes(const PresetValue& value, const char* member, uint64_t maxBytes,
                                     const std::string& wanted)
{
    if (!value.has(member)) {
        value.error(member, "found no file; this needs " + wanted);
        return std::nullopt;
    }
    base::Result<std::string> bytes = value.readAsset(member, maxBytes);
    if (bytes)
        return std::move(*bytes);
    value.error(member, bytes.status().message());
    return std::nullopt;
}

/// The mesh of an asset, or nothing after a finding.
std::optional<asset::ObjTriangles> readMesh(const PresetValue& value, const char* member)
{
    const std::optional<std::string> text =
        readBytes(value, member, kMaxMeshText, "triangles (*.obj), such as \"file\": \"stone.obj\"");
    if (!text)
        return std::nullopt;
    base::Result<asset::ObjTriangles> mesh = asset::readObjTriangles(*text);
    if (mesh)
        return std::move(*mesh);
    blame(value, member, mesh.status());
    return std::nullopt;
}

/// Takes what was made of an asset, or adds a finding.
template <class T>
T takeOr(const PresetValue& value, const char* member, base::Result<T> made)
{
    if (made)
        return std::move(*made);
    blame(value, member, made.status());
    return {};
}

void readPoints(const PresetValue& element, sim::ShapeDef& out)
{
    std::vector<glm::vec3> points;
    for (size_t i = 0; i < element.size("points"); ++i) {
        points.emplace_back(0.0f);
        element.readElement("points", i, points.back());
    }
    bool isClosed = false;
    element.read("closed", isClosed);
    if (points.size() < 2)
        return element.error("points", "found no points; a spline needs at least two");
    out.spline = std::make_shared<sim::SplinePath>(points, isClosed);
}

/// What a shape is drawn from. @return false after a finding
bool readSource(const PresetValue& element, sim::ShapeDef& out)
{
    if (out.kind == ShapeKind::Spline)
        readPoints(element, out);
    if (out.kind == ShapeKind::Mesh)
        if (const std::optional<asset::ObjTriangles> mesh = readMesh(element, "file"))
            out.mesh = takeOr(element, "file",
                              sim::makeMeshSampler({glm::dvec3(0.0), mesh->positions, mesh->indices}));
    if (out.kind == ShapeKind::Volume)
        if (const auto grid = readGrid(element, "file", 1))
            out.volume = takeOr(element, "file", sim::makeVolumeSampler(*grid));
    if (out.kind == ShapeKind::Torus && out.tube > out.size.x)
        element.error("tube", "found a tube wider than the torus; allowed is tube <= size");
    return (out.kind != ShapeKind::Spline || out.spline) && (out.kind != ShapeKind::Mesh || out.mesh) &&
           (out.kind != ShapeKind::Volume || out.volume);
}

/// True when EmitterDef::shape and its fellows say all of it.
bool isPlain(const sim::ShapeDef& shape)
{
    return shape.kind <= ShapeKind::Cone && shape.axis == glm::vec3(0.0f, 1.0f, 0.0f) &&
           shape.inner == 0.0f && shape.height == 0.0f && !shape.onSurface;
}

} // namespace

std::shared_ptr<const sim::FieldGrid> readGrid(const PresetValue& value, const char* member,
                                               uint32_t channels)
{
    const std::optional<std::string> bytes = readBytes(
        value, member, sim::kMaxGridBytes,
        "a grid (*.fxgrid) of " + std::to_string(channels) + (channels == 1 ? " channel" : " channels") +
            ", such as \"file\": \"swirl.fxgrid\"; docs/howto/grids.md tells how to make one");
    if (!bytes)
        return nullptr;
    auto grid = takeOr(value, member, sim::parseFieldGrid(*bytes));
    if (grid && grid->channels != channels) {
        blame(value, member,
              {base::Code::Schema, "found a grid of " + std::to_string(grid->channels) +
                                       " channels; needed are " + std::to_string(channels)});
        return nullptr;
    }
    return grid;
}

namespace {
constexpr float kFarOff = 0.1f; ///< [m] that particles should not meet a mesh away from its triangles

/// [m] the most by which the field leaves out, or thickens, what is in the middle of a triangle.
float errorOf(const sim::DistanceField& field, const asset::ObjTriangles& mesh)
{
    float worst = 0.0f;
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::vec3 middle = (mesh.positions[mesh.indices[i]] + mesh.positions[mesh.indices[i + 1]] +
                                  mesh.positions[mesh.indices[i + 2]]) /
                                 3.0f;
        worst = std::max(worst, std::abs(field.distance(middle - glm::vec3(field.origin()))));
    }
    return worst;
}

std::string textOf(float length)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.3g m", double(length));
    return text;
}
} // namespace

std::shared_ptr<const sim::DistanceField> readMeshField(const PresetValue& value)
{
    const std::optional<asset::ObjTriangles> mesh = readMesh(value, "file");
    if (!mesh)
        return nullptr;
    float cell = 0.0f;
    value.read("cellSize", cell);
    base::Bounds bounds;
    for (const glm::vec3& p : mesh->positions)
        bounds.add(p, 0.0f);
    const glm::vec3 size = bounds.empty() ? glm::vec3(0.0f) : bounds.max - bounds.min;
    const bool isAutomatic = cell <= 0.0f;
    if (isAutomatic)
        cell = std::max({size.x, size.y, size.z}) / 48.0f;
    const auto tasks = base::makeSerialRunner();
    auto field = takeOr(value, "file",
                        sim::DistanceField::build({glm::dvec3(0.0), mesh->positions, mesh->indices}, cell,
                                                  *tasks, std::pmr::new_delete_resource()));
    if (const float error = field && isAutomatic ? errorOf(*field, *mesh) : 0.0f; error > kFarOff)
        value.warning("file", "the mesh is met up to " + textOf(error) +
                                  " away from its triangles: its field of distances has cells of " +
                                  textOf(cell) +
                                  ", a 48th of its size, and walls are at least half a cell thick; give a "
                                  "smaller \"cellSize\", or collide with several smaller meshes");
    return field;
}

void readEmitterShape(const PresetValue& element, sim::EmitterDef& emitter)
{
    sim::ShapeDef shape;
    element.read("shape", std::span<const std::pair<std::string_view, ShapeKind>>(kShapes), shape.kind);
    element.read("position", shape.position);
    element.read("size", shape.size);
    float degrees = 0;
    element.read("angleDegrees", degrees);
    shape.angle = degrees * (std::numbers::pi_v<float> / 180.0f);
    element.read("axis", shape.axis);
    element.read("inner", shape.inner);
    element.read("surface", shape.onSurface);
    element.read("height", shape.height);
    element.read("tube", shape.tube);
    if (shape.axis == glm::vec3(0.0f))
        element.error("axis", "found an axis without length; any other direction is allowed");
    emitter.position = shape.position;
    emitter.size = shape.size;
    emitter.angle = shape.angle;
    if (shape.kind <= ShapeKind::Cone)
        emitter.shape = sim::EmitterShape(uint8_t(shape.kind));
    if (!isPlain(shape) && readSource(element, shape))
        emitter.births = sim::makeShapeOp(shape);
}

} // namespace fx::preset
