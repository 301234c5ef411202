#include "fxsdk/editor/inspector/new_element.h"

#include <algorithm>

namespace fx::editor {

namespace {

using Pointer = Json::json_pointer;

/// The array of a document; null if there is none.
const Json* arrayAt(const Document& document, const Pointer& at)
{
    if (!document.json().contains(at) || !document.json().at(at).is_array())
        return nullptr;
    return &document.json().at(at);
}

/// What is born of an event: particles of another emitter, which has births of its own or waits for events.
void completeEvent(const Document& document, const Pointer& array, Json& io)
{
    const Json* const emitters = arrayAt(document, Pointer("/emitters"));
    const Json& own = document.json().at(array.parent_pointer());
    const auto named = [&](const Json& name) {
        return std::count_if(emitters->begin(), emitters->end(), [&](const Json& other) {
            return other.is_object() && other.value("name", Json()) == name;
        });
    };
    if (emitters)
        for (const Json& other : *emitters)
            if (&other != &own && other.is_object() && other.contains("name") && other["name"].is_string() &&
                !other["name"].get<std::string>().empty() && !other.contains("events") &&
                other.value("space", Json()) == own.value("space", Json()) && named(other["name"]) == 1)
            {
                io["emit"] = other["name"];
                return;
            }
    io["cue"] = "cue";
}

/// The first event that waits for the host; empty if there is none.
std::string hostEventOf(const Document& document)
{
    const Json* const emitters = arrayAt(document, Pointer("/emitters"));
    for (size_t i = 0; emitters && i < emitters->size(); ++i)
        if (const Json* const events = arrayAt(document, Pointer("/emitters") / i / "events"))
            for (const Json& event : *events)
                if (event.is_object() && event.value("on", Json()) == "host" && event.contains("name") &&
                    event["name"].is_string())
                    return event["name"].get<std::string>();
    return {};
}

/// Keys of an instance have places or angles, those of a camera both members that it requires.
void completeFirst(const Document& document, const Pointer& array, Json& io)
{
    const Json& around = document.json().contains(array.parent_pointer())
                             ? document.json().at(array.parent_pointer())
                             : Json::object();
    for (const char* member : {"position", "target"})
        if (around.is_object() && around.contains(member))
            io[member] = around[member];
    if (!io.contains("position"))
        io["position"] = Json::array({0, 0, 0});
}

/// [s] Nothing happens to an instance before its start.
double firstTime(const Document& document, const Pointer& array, double least)
{
    const Pointer start = array.parent_pointer() / "start";
    const bool isStated = document.json().contains(start) && document.json().at(start).is_number();
    return isStated ? std::max(document.json().at(start).get<double>(), least) : least;
}

} // namespace

base::Result<Json> newElement(const Document& document, const Member& array)
{
    const Json& items = (*array.schema)["items"];
    const Json& schema = items.is_array() ? items[0] : items;
    const Pointer at(array.pointer);
    const Json* const present = arrayAt(document, at);
    const bool isTimed = schema.contains("properties") && schema["properties"].contains("time");
    if (isTimed && present && !present->empty() && present->back().is_object() &&
        present->back().value("time", Json()).is_number())
    {
        Json element = present->back();
        const double latest = schema["properties"]["time"].value("maximum", 86400.0);
        element["time"] = std::min(element["time"].get<double>() + 1.0, latest);
        return element;
    }
    if (schema.value("x-kind", std::string()) == "vector" && present && !present->empty() &&
        present->back().is_array() && present->back().size() == 3 && present->back()[1].is_number())
    {
        Json place = present->back();
        place[1] = place[1].get<double>() + 1.0; // beside the last one
        return place;
    }
    Json element = startValue(schema);
    if (isTimed)
        element["time"] = firstTime(document, at, schema["properties"]["time"].value("minimum", 0.0));
    if (array.name == "keys" && isTimed)
        completeFirst(document, at, element);
    if (array.name == "events" && element.is_object() && document.json().contains(at.parent_pointer()))
        completeEvent(document, at, element);
    if (array.name == "triggers" && document.kind() == DocumentKind::Preset) {
        const std::string name = hostEventOf(document);
        if (name.empty())
            return base::Status(base::Code::InvalidArgument,
                                array.pointer +
                                    ": nothing listens to a trigger; give an emitter an event with "
                                    "\"on\": \"host\" and a name first");
        element["name"] = name;
    }
    return element;
}

base::Status addElement(Document& io, const Member& array)
{
    const Json* const present = arrayAt(io, Pointer(array.pointer));
    const size_t count = present ? present->size() : 0;
    const size_t fewest = array.schema->value("minItems", size_t(0));
    const size_t most = array.schema->value("maxItems", count + 1);
    if (count + 1 > most)
        return {base::Code::InvalidArgument,
                array.pointer + ": it has " + std::to_string(count) + " elements, and no more are allowed"};
    Document probe = io;
    for (size_t size = count; size == count || size < fewest; ++size) {
        auto element = newElement(probe, array);
        if (!element)
            return element.status();
        if (size + 1 >= fewest && size == count)
            return io.insert(array.pointer, count, std::move(*element));
        if (base::Status status = probe.insert(array.pointer, size, std::move(*element)); !status)
            return status;
    }
    return setMember(io, array.pointer, probe.json().at(Pointer(array.pointer)));
}

} // namespace fx::editor
