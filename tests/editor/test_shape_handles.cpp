// Handles of the picture: what is dragged in the picture becomes the number that would be typed.
#include "fxsdk/editor/document/document_findings.h"
#include "fxsdk/editor/session/shape_handles.h"
#include "fxsdk/editor/session/time_marks.h"
#include "fxsdk/editor/session/view_projection.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace fx::editor {
namespace {

Document presetWith(const std::string& emitter)
{
    auto document = Document::fromText(
        R"({"version": 1, "emitters": [{"emission": {"rate": 1, "start": 1, "bursts": [{"time": 2, "count": 3}]}, )" +
            emitter + "}]}",
        "shapes.fx.json");
    EXPECT_TRUE(document.ok());
    return std::move(*document);
}

const ShapeHandle* find(const ShapeWires& wires, const std::string& pointer, int component = 0)
{
    for (const ShapeHandle& handle : wires.handles)
        if (handle.pointer == pointer && handle.component == component)
            return &handle;
    return nullptr;
}

TEST(ShapeHandles, eachPlaceGivesTheValueThatItStandsFor)
{
    // A handle that is not moved must not change the document.
    const Document document =
        presetWith(R"("shape": "box", "size": [1, 2, 3], "axis": [0, 1, 0], "position": [0.5, 1, -2],
        "forces": {"vortices": [{"radius": 2, "axis": [1, 0, 0]}], "attractors": [{"strength": 3, "radius": 1.5, "reach": 4}]})");
    const ShapeWires wires = shapeWires(document, "/emitters/0");
    ASSERT_GE(wires.handles.size(), 10u);
    for (const ShapeHandle& handle : wires.handles) {
        const Json::json_pointer at(handle.pointer);
        if (document.json().contains(at)) {
            EXPECT_EQ(valueAt(document, handle, handle.place), document.json().at(at)) << handle.pointer;
        }
    }
}

TEST(ShapeHandles, aMovedHandleGivesTheMovedValue)
{
    const Document document = presetWith(R"("shape": "box", "size": 1, "position": [0, 1, 0])");
    const ShapeWires wires = shapeWires(document, "/emitters/0");
    const ShapeHandle* const position = find(wires, "/emitters/0/position");
    ASSERT_TRUE(position);
    EXPECT_EQ(valueAt(document, *position, {0.1234, 2.0, -0.0001}), Json::array({0.123, 2.0, 0.0}));
    const ShapeHandle* const extent = find(wires, "/emitters/0/size", 2);
    ASSERT_TRUE(extent);
    EXPECT_EQ(valueAt(document, *extent, {9.0, 9.0, 2.5}),
              Json::array({1.0, 1.0, 2.5})); // only along its axis
    EXPECT_EQ(valueAt(document, *extent, {0.0, 1.0, -3.0}), Json::array({1.0, 1.0, 0.0})); // not below 0
}

TEST(ShapeHandles, obstaclesAndVectorFieldsAreDragged)
{
    const Document document = presetWith(R"("collisions": [{"shape": "plane", "position": [0, 0.5, 0]},
        {"shape": "sphere", "size": 2, "position": [1, 2, 3]}, {"shape": "box", "size": [1, 2, 3], "axis": [1, 0, 0]},
        {"shape": "ground"}, {"shape": "mesh", "file": "a.obj"}],
        "forces": {"vectorFields": [{"file": "a.fxgrid", "scale": 2, "position": [0, 1, 0]}]})");
    const ShapeWires wires = shapeWires(document, "/emitters/0");
    for (const ShapeHandle& handle : wires.handles)
        if (const Json::json_pointer at(handle.pointer); document.json().contains(at)) {
            EXPECT_EQ(valueAt(document, handle, handle.place), document.json().at(at)) << handle.pointer;
        }
    const std::string obstacles = "/emitters/0/collisions/";
    EXPECT_EQ(find(wires, obstacles + "0/axis")->kind, HandleKind::Direction);
    EXPECT_EQ(valueAt(document, *find(wires, obstacles + "1/size"), {4.0, 2.0, 3.0}), Json(3.0));
    // +Y of the box is turned to +X: its second half extent is dragged along X.
    EXPECT_EQ(valueAt(document, *find(wires, obstacles + "2/size", 1), {5.0, 0.0, 0.0}),
              Json::array({1.0, 5.0, 3.0}));
    EXPECT_FALSE(find(wires, obstacles + "3/position"));
    EXPECT_TRUE(find(wires, obstacles + "4/position"));
    EXPECT_EQ(valueAt(document, *find(wires, "/emitters/0/forces/vectorFields/0/scale"), {3.0, 1.0, 0.0}),
              Json(3.0));
}

TEST(ShapeHandles, sizesOfBallsStayNumbersAndFirstNumbersOfTriples)
{
    const Document number = presetWith(R"("shape": "sphere", "size": 1)");
    EXPECT_EQ(valueAt(number, *find(shapeWires(number, "/emitters/0"), "/emitters/0/size"), {2, 0, 0}),
              Json(2.0));
    const Document triple = presetWith(R"("shape": "sphere", "size": [1, 5, 6])");
    EXPECT_EQ(valueAt(triple, *find(shapeWires(triple, "/emitters/0"), "/emitters/0/size"), {2, 0, 0}),
              Json::array({2.0, 5.0, 6.0}));
}

TEST(ShapeHandles, sizesOfZeroAreDraggedBesideThePosition)
{
    for (const std::string shape : {"sphere", "box", "disc", "line", "cone", "torus"}) {
        const Document document = presetWith(R"("shape": ")" + shape + R"(", "position": [1, 2, 3])");
        const ShapeWires wires = shapeWires(document, "/emitters/0");
        const ShapeHandle* const size = find(wires, "/emitters/0/size");
        ASSERT_TRUE(size) << shape;
        EXPECT_EQ(wires.handles.front().pointer, "/emitters/0/position"); // the last at one place is taken
        EXPECT_GT(glm::length(size->place - glm::dvec3(1.0, 2.0, 3.0)), 0.1) << shape;
        const Json same = valueAt(document, *size, size->place);
        EXPECT_EQ(same.is_array() ? same[0] : same, Json(0.0)) << shape;
        const Json longer = valueAt(document, *size, size->place + 0.5 * size->along);
        EXPECT_EQ(longer.is_array() ? longer[0] : longer, Json(0.5)) << shape;
    }
}

TEST(ShapeHandles, instancesAreDraggedUnlessKeysMoveThem)
{
    const auto scene = Document::fromText(R"({"version": 1, "instances": [{"preset": "library:sparks"},
        {"preset": "library:sparks", "position": [1, 2, 3]},
        {"preset": "library:sparks", "keys": [{"time": 0, "position": [1, 1, 1]}]},
        {"preset": "library:sparks", "keys": [{"time": 0, "rotationDegrees": [0, 90, 0]}]}]})",
                                          "a.scene.json");
    ASSERT_TRUE(scene.ok()) << scene.status().message();
    ASSERT_EQ(scene->kind(), DocumentKind::Scene);
    EXPECT_EQ(find(shapeWires(*scene, "/instances/0"), "/instances/0/position")->place, glm::dvec3(0.0));
    EXPECT_EQ(find(shapeWires(*scene, "/instances/1"), "/instances/1/position")->place, glm::dvec3(1, 2, 3));
    EXPECT_TRUE(shapeWires(*scene, "/instances/2").handles.empty());
    EXPECT_FALSE(shapeWires(*scene, "/instances/3").handles.empty());
}

TEST(ShapeHandles, directionsAreUnitVectorsAndTheShapeTurnsWithThem)
{
    const Document document = presetWith(R"("shape": "line", "size": 2, "axis": [0, 0, 3])");
    const ShapeWires wires = shapeWires(document, "/emitters/0");
    const ShapeHandle* const axis = find(wires, "/emitters/0/axis");
    ASSERT_TRUE(axis);
    EXPECT_EQ(valueAt(document, *axis, {0.0, 3.0, 4.0}), Json::array({0.0, 0.6, 0.8}));
    const ShapeHandle* const size = find(wires, "/emitters/0/size");
    EXPECT_NEAR(glm::length(size->place - glm::dvec3(0.0, 0.0, 2.0)), 0.0, 1e-12);
}

TEST(ShapeHandles, valuesStayInTheRangeOfTheSchema)
{
    const Document document = presetWith(R"("position": [0, 0, 0], "forces": {"vortices": [{"radius": 2}]})");
    const ShapeWires wires = shapeWires(document, "/emitters/0");
    EXPECT_EQ(valueAt(document, *find(wires, "/emitters/0/position"), {5e5, 0.0, 0.0})[0], 10000.0);
    EXPECT_EQ(valueAt(document, *find(wires, "/emitters/0/forces/vortices/0/radius"), {-1.0, 0.0, 0.0}),
              Json(0.001));
}

TEST(ShapeHandles, selectionsInsideOfAnElementShowTheElement)
{
    const Document document = presetWith(R"("position": [0, 0, 0])");
    EXPECT_EQ(elementOf(document, "/emitters/0/emission"), "/emitters/0");
    EXPECT_EQ(elementOf(document, "/preview"), "");
    EXPECT_TRUE(shapeWires(document, "").handles.empty());
    EXPECT_TRUE(shapeWires(document, "/emitters/7").handles.empty());
}

TEST(ShapeHandles, wrongValuesOfAFileGiveNoHandleThatHarms)
{
    const Document document = presetWith(R"("shape": 3, "position": "here", "size": [1], "axis": [0, 0, 0],
        "forces": {"vortices": 4, "attractors": [1, {"radius": "x"}]})");
    EXPECT_FALSE(shapeWires(document, "/emitters/0").handles.empty());
}

TEST(ViewProjection, projectsAndFindsTheWayBack)
{
    OrbitCamera camera;
    camera.look({3.0, 2.0, 6.0}, {0.0, 1.0, 0.0});
    const ViewProjection view(camera, {100.0, 50.0}, {640.0, 360.0});
    const auto middle = view.project(camera.target());
    ASSERT_TRUE(middle);
    EXPECT_NEAR(middle->x, 420.0, 1e-9);
    EXPECT_NEAR(middle->y, 230.0, 1e-9);
    const glm::dvec3 place(0.7, 1.9, -1.1);
    const auto seen = view.project(place);
    ASSERT_TRUE(seen);
    EXPECT_NEAR(glm::length(view.inPlaneOf(place, *seen) - place), 0.0, 1e-9);
    const glm::dvec3 along = glm::normalize(glm::dvec3(1.0, 0.3, 0.2));
    const auto way = view.alongLine(place - 2.0 * along, along, *seen);
    ASSERT_TRUE(way);
    EXPECT_NEAR(*way, 2.0, 1e-9);
    EXPECT_FALSE(view.project(camera.position() + glm::dvec3(3.0, 1.0, 6.0)).has_value()); // behind
    EXPECT_FALSE(
        view.alongLine(camera.position(), view.rayThrough({300.0, 200.0}), {300.0, 200.0}).has_value());
}

TEST(TimeMarks, eventsFollowTheFirstBirthOfRateAndBursts)
{
    const auto eventAt = [](const std::string& emission) {
        const auto document =
            Document::fromText(R"({"version": 1, "emitters": [{)" + emission +
                                   R"("events": [{"on": "age", "age": 0.5, "cue": "pop"}]}]})",
                               "marks.fx.json");
        EXPECT_TRUE(document.ok());
        const std::vector<TimeMark> marks = timeMarks(*document);
        return !marks.empty() && marks.back().kind == MarkKind::Event ? marks.back().time : -1.0;
    };
    EXPECT_EQ(
        eventAt(
            R"("emission": {"start": 4, "bursts": [{"time": 3, "count": 1}, {"time": 2, "count": 1}]}, )"),
        2.5);
    EXPECT_EQ(eventAt(R"("emission": {"rate": 5, "start": 1, "bursts": [{"time": 2, "count": 1}]}, )"), 1.5);
    EXPECT_EQ(eventAt(R"("emission": {"rate": 5, "start": 3, "bursts": [{"time": 2, "count": 1}]}, )"), 2.5);
    EXPECT_EQ(eventAt(""), -1.0); // born of events of other emitters
    EXPECT_EQ(eventAt(R"("emission": {"rate": 0, "start": 1}, )"), -1.0);
}

TEST(TimeMarks, listStartsBurstsAndEventsAndMoveThem)
{
    const Document document =
        presetWith(R"("events": [{"on": "age", "age": 0.5, "cue": "pop"}, {"on": "death", "cue": "end"}])");
    const std::vector<TimeMark> marks = timeMarks(document);
    ASSERT_EQ(marks.size(), 3u);
    EXPECT_EQ(marks[0].pointer, "/emitters/0/emission/start");
    EXPECT_EQ(marks[1].pointer, "/emitters/0/emission/bursts/0/time");
    EXPECT_EQ(marks[1].time, 2.0);
    EXPECT_EQ(marks[2].pointer, "/emitters/0/events/0/age");
    EXPECT_EQ(marks[2].time, 1.5); // after the first birth
    EXPECT_EQ(timeAt(document, marks[1], 3.14159), Json(3.14));
    EXPECT_EQ(timeAt(document, marks[2], 2.25), Json(1.25));
    EXPECT_EQ(timeAt(document, marks[2], 0.0), Json(0.0001)); // the least age
    EXPECT_EQ(timeAt(document, marks[0], -4.0), Json(0.0));
}

} // namespace
} // namespace fx::editor
