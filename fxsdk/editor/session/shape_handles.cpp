#include "fxsdk/editor/session/shape_handles.h"

#include "fxsdk/editor/document/solo_mute.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace fx::editor {

namespace {

constexpr int kCorners = 48; // of a circle
constexpr double kThousandths = 1000.0;
constexpr double kArrow = 0.6; // [m] shortest length of an axis
constexpr double kGap = 0.2;   // [m] from the center to the handle of a length of 0

double numberOf(const Json& value, double otherwise)
{
    return value.is_number() ? value.get<double>() : otherwise;
}

double memberOf(const Json& object, const char* name, double otherwise)
{
    const auto found = object.find(name);
    return found == object.end() ? otherwise : numberOf(*found, otherwise);
}

glm::dvec3 vectorOf(const Json& object, const char* name, const glm::dvec3& otherwise)
{
    const auto found = object.find(name);
    if (found == object.end() || !found->is_array() || found->size() != 3)
        return otherwise;
    return {numberOf((*found)[0], 0.0), numberOf((*found)[1], 0.0), numberOf((*found)[2], 0.0)};
}

/// A number counts for all three components.
glm::dvec3 extentOf(const Json& object, const char* name, double otherwise)
{
    const auto found = object.find(name);
    if (found != object.end() && found->is_number())
        return glm::dvec3(found->get<double>());
    return vectorOf(object, name, glm::dvec3(otherwise));
}

/// Axes of a shape whose +Y is turned to a direction by the shortest way.
struct Axes
{
    glm::dvec3 x{1.0, 0.0, 0.0}, y{0.0, 1.0, 0.0}, z{0.0, 0.0, 1.0};
};

Axes axesAlong(const glm::dvec3& direction)
{
    const double length = glm::length(direction);
    if (!(length > 1e-9))
        return {};
    const glm::dvec3 y = direction / length;
    if (y.y < -0.999999)
        return {{1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, -1.0}};
    // Rotation from +Y to y: v' = v + c x v + c x (c x v) / (1 + y.y) with c = (+Y) x y.
    const glm::dvec3 c = glm::cross(glm::dvec3(0.0, 1.0, 0.0), y);
    const auto turn = [&](const glm::dvec3& v) {
        const glm::dvec3 once = glm::cross(c, v);
        return v + once + glm::cross(c, once) / (1.0 + y.y);
    };
    return {turn({1.0, 0.0, 0.0}), y, turn({0.0, 0.0, 1.0})};
}

class Builder
{
public:
    Builder(const Document& document, const std::string& element) : document_(document), element_(element) {}

    ShapeWires build()
    {
        const Json& element = document_.json().at(Json::json_pointer(element_));
        if (!element.is_object())
            return {};
        const bool isGas = element_.starts_with("/gas"), isFragments = element_.starts_with("/fragments");
        const glm::dvec3 center = vectorOf(element, "position", glm::dvec3(0.0));
        list(element, "collisions", element_ + "/", &Builder::obstacle);
        const bool isEmitter = element_.starts_with("/emitters/");
        const bool isInstance = document_.kind() == DocumentKind::Scene;
        if (isInstance ? !isMoved(element)
                       : isGas || isEmitter || isFragments || element.contains("position"))
            position(element_ + "/position", center, glm::dvec3(0.0)); // the last at a place is grabbed
        if (isEmitter)
            spawnShape(element, center);
        else
            cross(center, 0.25);
        if (isFragments)
            ball(element_ + "/originRadius", HandleKind::Length, center,
                 memberOf(element, "originRadius", 0.2));
        if (const auto forces = element.find("forces"); forces != element.end() && forces->is_object())
            fields(*forces);
        return std::move(wires_);
    }

private:
    /// Keys of an instance replace its position.
    static bool isMoved(const Json& instance)
    {
        const auto keys = instance.find("keys");
        return keys != instance.end() && keys->is_array() && !keys->empty() && keys->front().is_object() &&
               keys->front().contains("position");
    }
    void line(const glm::dvec3& a, const glm::dvec3& b) { wires_.lines.emplace_back(a, b); }
    void cross(const glm::dvec3& center, double size)
    {
        for (int i = 0; i < 3; ++i) {
            glm::dvec3 arm(0.0);
            arm[i] = size;
            line(center - arm, center + arm);
        }
    }
    void circle(const glm::dvec3& center, const glm::dvec3& a, const glm::dvec3& b)
    {
        for (int k = 0; k < kCorners; ++k) {
            const auto at = [&](int i) {
                const double angle = 2.0 * std::numbers::pi * i / kCorners;
                return center + std::cos(angle) * a + std::sin(angle) * b;
            };
            line(at(k), at(k + 1));
        }
    }
    void position(const std::string& pointer, const glm::dvec3& place, const glm::dvec3& center)
    {
        wires_.handles.push_back({pointer, HandleKind::Position, place, center, {0.0, 1.0, 0.0}, 0});
    }
    void length(const std::string& pointer, HandleKind kind, const glm::dvec3& center,
                const glm::dvec3& along, double value, int component = 0)
    {
        // A length of 0 is dragged beside the center, where the position is dragged.
        const glm::dvec3 from = value > 0.0 ? center : center + kGap * along;
        wires_.handles.push_back({pointer, kind, from + value * along, from, along, component});
    }
    void axis(const std::string& pointer, const glm::dvec3& center, const Axes& axes, double reach)
    {
        const glm::dvec3 tip = center + axes.y * std::max(reach, kArrow);
        line(center, tip);
        line(tip, tip - 0.12 * axes.y + 0.06 * axes.x);
        line(tip, tip - 0.12 * axes.y - 0.06 * axes.x);
        wires_.handles.push_back({pointer, HandleKind::Direction, tip, center, axes.y, 0});
    }
    void ball(const std::string& pointer, HandleKind kind, const glm::dvec3& center, double radius)
    {
        const glm::dvec3 x(radius, 0.0, 0.0), y(0.0, radius, 0.0), z(0.0, 0.0, radius);
        circle(center, x, y);
        circle(center, y, z);
        circle(center, z, x);
        length(pointer, kind, center, {1.0, 0.0, 0.0}, radius);
    }
    void box(const std::string& pointer, const glm::dvec3& center, const Axes& axes, const glm::dvec3& half)
    {
        const auto corner = [&](int k) {
            return center + ((k & 1) ? half.x : -half.x) * axes.x + ((k & 2) ? half.y : -half.y) * axes.y +
                   ((k & 4) ? half.z : -half.z) * axes.z;
        };
        for (int k = 0; k < 8; ++k)
            for (const int bit : {1, 2, 4})
                if ((k & bit) == 0)
                    line(corner(k), corner(k | bit));
        const std::array<glm::dvec3, 3> directions{axes.x, axes.y, axes.z};
        for (int i = 0; i < 3; ++i)
            length(pointer, HandleKind::Extent, center, directions[size_t(i)], half[i], i);
    }

    void cone(const Json& element, const glm::dvec3& center, const Axes& axes, double radius)
    {
        const double height = memberOf(element, "height", 0.0);
        const double reach = height > 0.0 ? height : std::max(2.0 * radius, kArrow);
        const double angle = std::min(memberOf(element, "angleDegrees", 0.0), 89.0);
        const double wide = radius + reach * std::tan(glm::radians(angle));
        const glm::dvec3 top = center + reach * axes.y;
        circle(center, radius * axes.x, radius * axes.z);
        circle(top, wide * axes.x, wide * axes.z);
        for (const glm::dvec3& side : {axes.x, -axes.x, axes.z, -axes.z})
            line(center + radius * side, top + wide * side);
        if (height > 0.0)
            length(element_ + "/height", HandleKind::Length, center, axes.y, height);
    }

    void spline(const Json& element, const glm::dvec3& center)
    {
        const auto points = element.find("points");
        if (points == element.end() || !points->is_array())
            return;
        std::vector<glm::dvec3> places;
        for (size_t i = 0; i < points->size(); ++i) {
            const Json holder = {{"p", (*points)[i]}};
            places.push_back(center + vectorOf(holder, "p", glm::dvec3(0.0)));
            position(element_ + "/points/" + std::to_string(i), places.back(), center);
        }
        for (size_t i = 1; i < places.size(); ++i)
            line(places[i - 1], places[i]);
        if (element.value("closed", Json(false)) == Json(true) && places.size() > 2)
            line(places.back(), places.front());
    }

    void spawnShape(const Json& element, const glm::dvec3& center)
    {
        const Json kind = element.value("shape", Json("point"));
        const std::string shape = kind.is_string() ? kind.get<std::string>() : std::string("point");
        const Axes axes = axesAlong(vectorOf(element, "axis", {0.0, 1.0, 0.0}));
        const glm::dvec3 size = extentOf(element, "size", 0.0);
        const std::string pointer = element_ + "/size";
        if (shape == "box") {
            box(pointer, center, axes, size);
        } else if (shape == "sphere") {
            ball(pointer, HandleKind::Length, center, size.x);
        } else if (shape == "disc" || shape == "cone" || shape == "torus") {
            const double tube = shape == "torus" ? memberOf(element, "tube", 0.0) : 0.0;
            for (const double radius : {size.x - tube, size.x + tube})
                circle(center, radius * axes.x, radius * axes.z);
            for (const glm::dvec3& side : {axes.x, -axes.x, axes.z, -axes.z})
                if (tube > 0.0)
                    circle(center + size.x * side, tube * side, tube * axes.y);
            if (shape == "cone")
                cone(element, center, axes, size.x);
            if (shape == "torus")
                length(element_ + "/tube", HandleKind::Length, center + size.x * axes.z, axes.z, tube);
            length(pointer, HandleKind::Length, center, axes.x, size.x);
        } else if (shape == "line") {
            line(center - size.x * axes.y, center + size.x * axes.y);
            length(pointer, HandleKind::Length, center, axes.y, size.x);
        } else if (shape == "spline") {
            spline(element, center);
        } else {
            cross(center, 0.15);
        }
        const bool hasAxis = shape != "sphere" && shape != "spline" && shape != "mesh" && shape != "volume" &&
                             (shape != "point" || element.contains("axis"));
        if (hasAxis)
            axis(element_ + "/axis", center, axes, 1.5 * std::max({size.x, size.y, size.z}));
    }

    void vortex(const Json& field, const std::string& at)
    {
        const glm::dvec3 center = vectorOf(field, "position", glm::dvec3(0.0));
        const Axes axes = axesAlong(vectorOf(field, "axis", {0.0, 1.0, 0.0}));
        const double radius = memberOf(field, "radius", 1.0);
        for (const double height : {-0.5, 0.0, 0.5})
            circle(center + height * radius * axes.y, radius * axes.x, radius * axes.z);
        position(at + "/position", center, glm::dvec3(0.0));
        length(at + "/radius", HandleKind::Length, center, axes.x, radius);
        axis(at + "/axis", center, axes, 1.5 * radius);
    }

    void attractor(const Json& field, const std::string& at)
    {
        const glm::dvec3 center = vectorOf(field, "position", glm::dvec3(0.0));
        cross(center, 0.2);
        position(at + "/position", center, glm::dvec3(0.0));
        ball(at + "/radius", HandleKind::Length, center, memberOf(field, "radius", 1.0));
        if (const double reach = memberOf(field, "reach", 0.0); reach > 0.0)
            ball(at + "/reach", HandleKind::Length, center, reach);
    }

    void conform(const Json& field, const std::string& at)
    {
        const glm::dvec3 center = vectorOf(field, "position", glm::dvec3(0.0));
        const Json shape = field.value("shape", Json("sphere"));
        if (shape == Json("sphere"))
            ball(at + "/size", HandleKind::Length, center, extentOf(field, "size", 1.0).x);
        else if (shape == Json("box"))
            box(at + "/size", center, {}, extentOf(field, "size", 1.0));
        else
            cross(center, 0.2);
        position(at + "/position", center, glm::dvec3(0.0));
    }

    /// What the field is in its file is not known here: arms show 1 m of the grid.
    void vectorField(const Json& field, const std::string& at)
    {
        const glm::dvec3 center = vectorOf(field, "position", glm::dvec3(0.0));
        const double scale = memberOf(field, "scale", 1.0);
        cross(center, scale);
        position(at + "/position", center, glm::dvec3(0.0));
        length(at + "/scale", HandleKind::Length, center, {1.0, 0.0, 0.0}, scale);
    }

    /// Of a plane, which has no end, a square of 4 m.
    void plane(const std::string& at, const glm::dvec3& center, const Axes& axes)
    {
        constexpr double kHalf = 2.0; // [m]
        for (int i = -2; i <= 2; ++i) {
            const double way = kHalf * i / 2.0;
            line(center - kHalf * axes.x + way * axes.z, center + kHalf * axes.x + way * axes.z);
            line(center - kHalf * axes.z + way * axes.x, center + kHalf * axes.z + way * axes.x);
        }
        axis(at + "/axis", center, axes, kArrow);
    }

    void obstacle(const Json& obstacle, const std::string& at)
    {
        const Json kind = obstacle.value("shape", Json());
        const std::string shape = kind.is_string() ? kind.get<std::string>() : std::string();
        if (shape != "plane" && shape != "sphere" && shape != "box" && shape != "mesh" && shape != "heights")
            return; // the ground and what belongs to the host
        const glm::dvec3 center = vectorOf(obstacle, "position", glm::dvec3(0.0));
        const Axes axes = axesAlong(vectorOf(obstacle, "axis", {0.0, 1.0, 0.0}));
        const glm::dvec3 size = extentOf(obstacle, "size", 1.0);
        position(at + "/position", center, glm::dvec3(0.0));
        if (shape == "plane") {
            plane(at, center, axes);
        } else if (shape == "sphere") {
            ball(at + "/size", HandleKind::Length, center, size.x);
        } else if (shape == "box") {
            box(at + "/size", center, axes, size);
            axis(at + "/axis", center, axes, 1.5 * size.y);
        } else {
            cross(center, 0.5);
        }
    }

    using Build = void (Builder::*)(const Json&, const std::string&);
    /// Builds each object of a list of `holder`. @param at pointer of the holder, with "/" at its end
    void list(const Json& holder, const char* name, const std::string& at, Build add)
    {
        const auto found = holder.find(name);
        if (found == holder.end() || !found->is_array())
            return;
        for (size_t i = 0; i < found->size(); ++i)
            if ((*found)[i].is_object())
                (this->*add)((*found)[i], at + name + "/" + std::to_string(i));
    }

    void fields(const Json& forces)
    {
        const std::string at = element_ + "/forces/";
        list(forces, "vortices", at, &Builder::vortex);
        list(forces, "attractors", at, &Builder::attractor);
        list(forces, "conform", at, &Builder::conform);
        list(forces, "vectorFields", at, &Builder::vectorField);
    }

    const Document& document_;
    const std::string& element_;
    ShapeWires wires_;
};

double rounded(double value)
{
    const double result = std::round(value * kThousandths) / kThousandths;
    return result == 0.0 ? 0.0 : result; // no negative zero
}

/// Limits a number by the schema of the value at `pointer`.
double limitedAt(const Document& document, const std::string& pointer, double value)
{
    const Json* schema = schemaAt(document.schema(), document.json(), Json::json_pointer(pointer));
    if (!schema)
        return value;
    const Json& limits = decided(*schema, Json(value));
    return std::clamp(value, memberOf(limits, "minimum", -1e12), memberOf(limits, "maximum", 1e12));
}

/// The present value as three numbers.
glm::dvec3 presentExtent(const Document& document, const std::string& pointer)
{
    const Json::json_pointer at(pointer);
    const Json holder = document.json().contains(at) ? Json{{"v", document.json().at(at)}} : Json::object();
    return extentOf(holder, "v", 0.0);
}

} // namespace

std::string elementOf(const Document& document, const std::string& pointer)
{
    if (document.kind() == DocumentKind::Scene) {
        const auto begins = [&](const std::string& start) {
            return pointer == start || pointer.starts_with(start + "/");
        };
        const auto instances = document.json().find("instances");
        const size_t count = instances == document.json().end() ? 0 : instances->size();
        for (size_t i = 0; i < count; ++i)
            if (begins("/instances/" + std::to_string(i)))
                return "/instances/" + std::to_string(i);
        return {};
    }
    for (const std::string& element : soloElements(document.json(), document.schema()))
        if (pointer == element || pointer.starts_with(element + "/"))
            return element;
    return {};
}

ShapeWires shapeWires(const Document& document, const std::string& element)
{
    if (element.empty() || !document.json().contains(Json::json_pointer(element)))
        return {};
    return Builder(document, element).build();
}

Json valueAt(const Document& document, const ShapeHandle& handle, const glm::dvec3& place)
{
    const glm::dvec3 way = place - handle.center;
    if (handle.kind == HandleKind::Length || handle.kind == HandleKind::Extent) {
        const double value =
            limitedAt(document, handle.pointer, rounded(std::max(glm::dot(way, handle.along), 0.0)));
        const Json::json_pointer at(handle.pointer);
        const bool isTriple = document.json().contains(at) && document.json().at(at).is_array();
        if (handle.kind == HandleKind::Length && !isTriple)
            return value;
        glm::dvec3 triple = presentExtent(document, handle.pointer);
        triple[handle.component] = value;
        return Json::array({triple.x, triple.y, triple.z});
    }
    glm::dvec3 value = way;
    if (handle.kind == HandleKind::Direction) {
        if (!(glm::length(way) > 1e-6))
            return Json::array({handle.along.x, handle.along.y, handle.along.z});
        value = glm::normalize(way);
    }
    Json result = Json::array();
    for (int i = 0; i < 3; ++i)
        result.push_back(limitedAt(document, handle.pointer + "/" + std::to_string(i), rounded(value[i])));
    return result;
}

} // namespace fx::editor
