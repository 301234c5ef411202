#include "fxsdk/editor/document/solo_mute.h"

namespace fx::editor {

namespace {

/// Schema of the elements of a member that a technique adds: an array of objects; otherwise null.
const Json* elementSchema(const Json& schema, const std::string& member)
{
    const Json& properties = schema["properties"];
    if (!properties.contains(member) || properties[member].value("type", "") != "array")
        return nullptr;
    const Json& items = properties[member]["items"];
    return items.is_object() && items.contains("properties") ? &items : nullptr;
}

/// Makes an element invisible by the members that its schema has: medium without density; particles without
/// size and opacity, whose events still happen; otherwise it starts at the last moment of the range.
void hide(Json& io, const Json& schema)
{
    const Json& properties = schema["properties"];
    if (properties.contains("density"))
        io["density"] = 0;
    else if (properties.contains("opacityOverLife") && properties.contains("sizeOverLife")) {
        io["opacityOverLife"] = 0;
        io["sizeOverLife"] = 0;
        io["heat"] = 0;
    } else if (properties.contains("start"))
        io["start"] = properties["start"]["maximum"];
}

void set(std::set<std::string>& io, const std::string& element, bool isIn)
{
    if (isIn)
        io.insert(element);
    else
        io.erase(element);
}

} // namespace

std::vector<std::string> soloElements(const Json& preset, const Json& schema)
{
    std::vector<std::string> pointers;
    if (!preset.is_object())
        return pointers;
    for (auto it = preset.begin(); it != preset.end(); ++it)
        if (it->is_array() && elementSchema(schema, it.key()))
            for (size_t i = 0; i < it->size(); ++i)
                pointers.push_back("/" + it.key() + "/" + std::to_string(i));
    return pointers;
}

void SoloMute::setMuted(const std::string& element, bool isMuted)
{
    set(muted_, element, isMuted);
}

void SoloMute::setSolo(const std::string& element, bool isSolo)
{
    set(solo_, element, isSolo);
}

bool SoloMute::isShown(const std::string& element) const
{
    return !isMuted(element) && (solo_.empty() || isSolo(element));
}

void SoloMute::clear()
{
    muted_.clear();
    solo_.clear();
}

Json SoloMute::shown(const Json& preset, const Json& schema) const
{
    Json shown = preset;
    if (!isActive())
        return shown;
    for (const std::string& element : soloElements(preset, schema)) {
        Json& value = shown[Json::json_pointer(element)];
        if (!isShown(element) && value.is_object())
            hide(value, *elementSchema(schema, Json::json_pointer(element).parent_pointer().back()));
    }
    return shown;
}

} // namespace fx::editor
