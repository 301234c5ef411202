#include "fxsdk/presets/parameter_reference.h"

#include "fxsdk/presets/schema_assembly.h"
#include "fxsdk/presets/schema_explainer.h"

namespace fx::preset {

namespace {

using Schema = nlohmann::ordered_json;

/// The object schema that `member` is or is a list of; null when it holds plain values.
const Schema* objectInside(const Schema& member)
{
    if (member.contains("x-kind"))
        return nullptr;
    if (member.contains("properties"))
        return &member;
    if (member.contains("items") && member["items"].contains("properties"))
        return &member["items"];
    return nullptr;
}

/// What is allowed without the unit, which has a column of its own.
std::string allowedColumn(const Schema& member)
{
    nlohmann::json plain = member;
    plain.erase("x-unit");
    return allowedText(plain);
}

std::string row(const std::string& name, const Schema& member, bool isRequired)
{
    const std::string defaultText = isRequired                   ? "required"
                                    : member.contains("default") ? "`" + member["default"].dump() + "`"
                                                                 : "absent";
    return "| `" + name + "` | " + member.value("description", std::string()) + " | " +
           member.value("x-unit", std::string("–")) + " | " + allowedColumn(member) + " | " + defaultText +
           " | " + member.value("x-cost", std::string("–")) + " |\n";
}

void writeObject(const Schema& object, const std::string& path, std::string& out)
{
    out += "\n## " + (path.empty() ? object["title"].get<std::string>() : "`" + path + "`") + "\n\n" +
           object["description"].get<std::string>() +
           "\n\n| member | meaning | unit | allowed | default | cost |\n|---|---|---|---|---|---|\n";
    const Schema required = object.value("required", Schema::array());
    for (const auto& [name, member] : object["properties"].items())
        out += row(name, member, std::find(required.begin(), required.end(), name) != required.end());
    for (const auto& [name, member] : object["properties"].items())
        if (const Schema* inner = objectInside(member))
            writeObject(*inner, path + "/" + name + (member.contains("items") ? "[]" : ""), out);
}

} // namespace

std::string parameterReference()
{
    std::string text = "# Parameters\n\nWritten by `fx parameters` from the JSON Schemas of this build.\n";
    text += "\n# Presets (`*.fx.json`)\n";
    writeObject(presetSchema(), "", text);
    text += "\n# Scenes (`*.scene.json`)\n";
    writeObject(sceneSchema(), "", text);
    return text;
}

std::string presetSchemaText()
{
    return presetSchema().dump(2) + "\n";
}

std::string sceneSchemaText()
{
    return sceneSchema().dump(2) + "\n";
}

} // namespace fx::preset
