#include "fxsdk/editor/session/time_edits.h"

#include "fxsdk/assets/asset_resolver.h"
#include "fxsdk/presets/preset_loader.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace fx::editor {

namespace {

using Pointer = Json::json_pointer;

constexpr double kStepsPerSecond = 100.0; // to which times are rounded

double roundedTime(double time)
{
    return std::max(std::round(time * kStepsPerSecond) / kStepsPerSecond, 0.0);
}

double timeOf(const Json& element)
{
    const auto found = element.is_object() ? element.find("time") : element.end();
    return element.is_object() && found != element.end() && found->is_number() ? found->get<double>() : 0.0;
}

/// The array at a pointer; an empty one if there is none.
Json listAt(const Document& document, const std::string& pointer)
{
    const Pointer at(pointer);
    const bool isList = document.json().contains(at) && document.json().at(at).is_array();
    return isList ? document.json().at(at) : Json::array();
}

/// The preset of an instance; null if it cannot be read.
Json presetOf(const Document& document, const std::string& documentName, const std::string& instance)
{
    if (document.kind() == DocumentKind::Preset)
        return document.json();
    const Pointer at = Pointer(instance) / "preset";
    if (instance.empty() || !document.json().contains(at) || !document.json().at(at).is_string())
        return {};
    const std::string folder = preset::folderOf(documentName);
    const asset::AssetResolver resolver(folder.empty() ? "." : folder, preset::libraryFiles());
    const auto text = resolver.read(document.json().at(at).get<std::string>(), preset::kPresetBytes);
    return text ? Json::parse(*text, nullptr, false) : Json();
}

/// Index of the nearest element that is less than half a step from `time`; empty: there is none.
std::optional<size_t> indexAt(const Json& list, double time)
{
    std::optional<size_t> nearest;
    double least = 0.5 / kStepsPerSecond;
    for (size_t i = 0; i < list.size(); ++i)
        if (const double distance = std::abs(timeOf(list[i]) - time); distance < least) {
            nearest = i;
            least = distance;
        }
    return nearest;
}

/// Index of the first element that is later than `time`.
size_t indexAfter(const Json& list, double time)
{
    size_t index = 0;
    while (index < list.size() && timeOf(list[index]) <= time)
        ++index;
    return index;
}

} // namespace

std::string triggeredInstance(const Document& document, const std::string& selection)
{
    if (document.kind() == DocumentKind::Preset)
        return "/preview/instance";
    const Json instances = listAt(document, "/instances");
    constexpr std::string_view kInstances = "/instances/";
    if (selection.starts_with(kInstances))
        return selection.substr(0, selection.find('/', kInstances.size()));
    return instances.empty() ? std::string() : std::string(kInstances) + "0";
}

std::vector<std::string> triggerNames(const Document& document, const std::string& documentName,
                                      const std::string& instance)
{
    std::vector<std::string> names;
    const Json preset = presetOf(document, documentName, instance);
    const auto listOf = [](const Json& object, const char* member) {
        return object.is_object() && object.contains(member) && object[member].is_array() ? object[member]
                                                                                          : Json::array();
    };
    for (const Json& emitter : listOf(preset, "emitters"))
        for (const Json& event : listOf(emitter, "events")) {
            if (!event.is_object() || event.value("on", Json()) != "host" || !event.contains("name") ||
                !event["name"].is_string())
                continue;
            const auto name = event["name"].get<std::string>();
            if (std::find(names.begin(), names.end(), name) == names.end())
                names.push_back(name);
        }
    return names;
}

base::Status addTrigger(Document& io, const std::string& instance, const std::string& name, double time)
{
    if (instance.empty())
        return {base::Code::InvalidArgument, "the scene has no instance that a trigger could belong to"};
    const Pointer start = Pointer(instance) / "start";
    const bool hasStart = io.json().contains(start) && io.json().at(start).is_number();
    const double at = std::max(roundedTime(time), hasStart ? io.json().at(start).get<double>() : 0.0);
    const std::string list = instance + "/triggers";
    return io.insert(list, indexAfter(listAt(io, list), at), {{"time", at}, {"name", name}});
}

base::Status addCameraKey(Document& io, const OrbitCamera& camera, double time)
{
    const std::string list = io.kind() == DocumentKind::Scene ? "/camera/keys" : "/preview/camera/keys";
    const double at = roundedTime(time);
    Json key = {{"time", at}, {"position", placeOf(camera.position())}, {"target", placeOf(camera.target())}};
    const Json keys = listAt(io, list);
    if (const std::optional<size_t> present = indexAt(keys, at))
        return io.set(list + "/" + std::to_string(*present), std::move(key));
    return io.insert(list, indexAfter(keys, at), std::move(key));
}

base::Status removeTimed(Document& io, const std::string& pointer)
{
    const Pointer element = Pointer(pointer).parent_pointer();
    const Pointer list = element.parent_pointer();
    if (!io.json().contains(element) || !io.json().at(list).is_array())
        return {base::Code::NotFound, pointer + ": it belongs to no list"};
    return io.erase((io.json().at(list).size() > 1 ? element : list).to_string());
}

Json placeOf(const glm::dvec3& position)
{
    constexpr double kThousandths = 1e3; // [1/m]
    Json rounded = Json::array();
    for (int i = 0; i < 3; ++i)
        rounded.push_back(std::round(position[i] * kThousandths) / kThousandths);
    return rounded;
}

} // namespace fx::editor
