#include "fxsdk/editor/session/stage_choice.h"

#include "fxsdk/scene_file/stages.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::editor {

namespace {

constexpr double kMillionths = 1e6; // directions are written with six digits

/// The object that has the members of a stage; null if there is none.
const Json* holderOf(const Json& document, DocumentKind kind)
{
    if (!document.is_object())
        return nullptr;
    if (kind == DocumentKind::Scene)
        return &document;
    const auto preview = document.find("preview");
    return preview != document.end() && preview->is_object() ? &*preview : nullptr;
}

/// One number counts for all three.
double numberIn(const Json& triple, size_t i)
{
    if (triple.is_number())
        return triple.get<double>();
    return triple.is_array() && triple.size() == 3 && triple[i].is_number() ? triple[i].get<double>() : 0.0;
}

/// Light that a document states, otherwise that of the first stage.
Json lightingOf(const Json* holder)
{
    Json lighting = Json::parse(scene_file::stages()[0].members)["lighting"];
    if (holder && holder->contains("lighting") && (*holder)["lighting"].is_object())
        lighting.update((*holder)["lighting"]);
    return lighting;
}

/// A triple with another value of green; the others change in proportion, or are equal to it from black on.
Json withGreen(const Json& triple, double green)
{
    const double before = numberIn(triple, 1);
    Json result = Json::array();
    for (size_t i = 0; i < 3; ++i)
        result.push_back(before > 0.0 ? numberIn(triple, i) * green / before : green);
    return result;
}

/// The sky is also the background.
void setSky(Json& io, Json& ioLighting, double luminance)
{
    const double before = numberIn(ioLighting["skyLuminance"], 1);
    ioLighting["skyLuminance"] = withGreen(ioLighting["skyLuminance"], luminance);
    Json background = Json::parse(scene_file::stages()[0].members)["background"];
    if (io.contains("background") && io["background"].is_object())
        background = io["background"];
    for (const char* member : {"color", "horizon"})
        if (background.contains(member))
            background[member] =
                withGreen(background[member],
                          before > 0.0 ? numberIn(background[member], 1) * luminance / before : luminance);
    io["background"] = std::move(background);
}

double fiveDigits(double value)
{
    if (!(value > 0.0))
        return 0.0;
    const double unit = std::pow(10.0, 4.0 - std::floor(std::log10(value)));
    return std::round(value * unit) / unit;
}

/// Changes the ratios of red and blue to green, of the background as of the sky.
void setSkyColor(Json& io, Json& ioLighting, const glm::dvec3& color)
{
    constexpr double kMost = 1e6; // [cd/m2]
    const Json before = ioLighting["skyLuminance"];
    const auto colored = [&](const Json& triple) {
        Json result = Json::array();
        for (int i = 0; i < 3; ++i) {
            const double was = numberIn(before, size_t(i)), green = numberIn(before, 1);
            const double ratio = was > 0.0 ? numberIn(triple, size_t(i)) / was : numberIn(triple, 1) / green;
            result.push_back(fiveDigits(std::min(green > 0.0 ? ratio * green * color[i] : 0.0, kMost)));
        }
        return result;
    };
    ioLighting["skyLuminance"] = colored(before);
    for (const char* member : {"color", "horizon"})
        if (io["background"].contains(member))
            io["background"][member] = colored(io["background"][member]);
}

void setLight(Json& io, const StageChoice& choice)
{
    if (!choice.sunDirection && !choice.sunIlluminance && !choice.skyLuminance && !choice.skyColor)
        return;
    Json lighting = lightingOf(&io);
    if (choice.sunDirection) {
        Json direction = Json::array();
        for (int i = 0; i < 3; ++i)
            direction.push_back(std::round((*choice.sunDirection)[i] * kMillionths) / kMillionths);
        lighting["sunDirection"] = std::move(direction);
    }
    if (choice.sunIlluminance)
        lighting["sunIlluminance"] = withGreen(lighting["sunIlluminance"], *choice.sunIlluminance);
    if (choice.skyLuminance || choice.skyColor)
        setSky(io, lighting, choice.skyLuminance.value_or(numberIn(lighting["skyLuminance"], 1)));
    if (choice.skyColor)
        setSkyColor(io, lighting, *choice.skyColor);
    io["lighting"] = std::move(lighting);
}

} // namespace

StageLightValues lightOf(const Json& document, DocumentKind kind)
{
    const Json lighting = lightingOf(holderOf(document, kind));
    const Json& direction = lighting["sunDirection"];
    const glm::dvec3 sun(numberIn(direction, 0), numberIn(direction, 1), numberIn(direction, 2));
    const double length = glm::length(sun);
    return {length > 0.0 ? sun / length : glm::dvec3(0.0, 1.0, 0.0),
            numberIn(lighting["sunIlluminance"], 1),
            numberIn(lighting["skyLuminance"], 1),
            {numberIn(lighting["skyLuminance"], 0), numberIn(lighting["skyLuminance"], 1),
             numberIn(lighting["skyLuminance"], 2)}};
}

void setSky(StageChoice& io, const glm::dvec3& sky)
{
    constexpr double kLeastGreen = 1e-3; // of the brightest channel
    const double green = std::max(sky.y, kLeastGreen * std::max(sky.x, sky.z));
    io.skyLuminance = green;
    if (green > 0.0)
        io.skyColor = glm::dvec3(sky.x / green, 1.0, sky.z / green);
}

bool hasFigure(const Json& document)
{
    const Json* const preview = holderOf(document, DocumentKind::Preset);
    return preview && preview->contains("figure");
}

Json onStage(const Json& document, DocumentKind kind, const StageChoice& choice)
{
    if (choice == StageChoice() || !document.is_object())
        return document;
    const Json* const present = holderOf(document, kind);
    Json holder = present ? *present : Json::object();
    if (!choice.name.empty())
        scene_file::setStage(holder, choice.name);
    if (!choice.meshFile.empty())
        holder["mesh"] = {{"file", choice.meshFile}};
    setLight(holder, choice);
    if (kind == DocumentKind::Scene)
        return holder;
    if (choice.hasFigure == false)
        holder.erase("figure");
    else if (choice.hasFigure && !holder.contains("figure"))
        holder["figure"] = {{"position", {-1.5, 0, 0}}, {"headingDegrees", 60}};
    Json result = document;
    result["preview"] = std::move(holder);
    return result;
}

glm::dvec3 directionOf(double headingDegrees, double elevationDegrees)
{
    const double heading = glm::radians(headingDegrees), elevation = glm::radians(elevationDegrees);
    return {std::sin(heading) * std::cos(elevation), std::sin(elevation),
            std::cos(heading) * std::cos(elevation)};
}

double headingOf(const glm::dvec3& direction)
{
    return glm::degrees(std::atan2(direction.x, direction.z));
}

double elevationOf(const glm::dvec3& direction)
{
    return glm::degrees(std::asin(std::clamp(direction.y, -1.0, 1.0)));
}

} // namespace fx::editor
