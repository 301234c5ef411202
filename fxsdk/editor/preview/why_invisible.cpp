#include "fxsdk/editor/preview/why_invisible.h"

#include "fxsdk/editor/document/document_findings.h"

#include <cstdio>

namespace fx::editor {

namespace {

std::string seconds(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.3g s", value);
    return text;
}

double numberAt(const Json& value, const char* pointer, double otherwise)
{
    const Json::json_pointer at(pointer);
    return value.is_object() && value.contains(at) && value.at(at).is_number() ? value.at(at).get<double>()
                                                                               : otherwise;
}

/// Reasons at the members of one element.
void reasonsOf(const Json& element, const std::string& pointer, double time, std::vector<std::string>& io)
{
    for (const char* start : {"/start", "/emission/start"})
        if (const double begins = numberAt(element, start, 0.0); begins > time)
            io.push_back(pointer + start + ": it begins at " + seconds(begins) + "; the picture shows " +
                         seconds(time));
    for (const char* member : {"/opticalDepth", "/crossSection", "/opacityOverLife", "/sizeOverLife",
                               "/density", "/appearance/opacity", "/opacity"})
        if (numberAt(element, member, 1.0) == 0.0)
            io.push_back(pointer + member + ": it is 0, which shows nothing; set it above 0");
    const bool isSprite = numberAt(element, "/appearance/luminance", 0.0) == 0.0 &&
                          numberAt(element, "/appearance/lit", 1.0) == 0.0;
    if (isSprite)
        io.push_back(pointer +
                     "/appearance: lit and luminance are 0, so that it is black; raise one of them");
}

} // namespace

std::vector<std::string> whyInvisible(const Document& document, const SoloMute& choice, double time)
{
    std::vector<std::string> reasons;
    for (const DocumentFinding& finding : findingsOf(document))
        if (!finding.diagnostic.warning)
            reasons.push_back(finding.diagnostic.pointer + ": " + finding.diagnostic.message);
    const std::vector<std::string> elements = soloElements(document.json(), document.schema());
    const double local = time + numberAt(document.json(), "/prewarm", 0.0);
    if (document.kind() == DocumentKind::Preset && elements.empty())
        reasons.emplace_back("The preset has no emitter, gas or medium; add one.");
    for (const std::string& pointer : elements) {
        if (!choice.isShown(pointer))
            reasons.push_back(pointer + ": it is muted, or another element is solo");
        reasonsOf(document.json().at(Json::json_pointer(pointer)), pointer, local, reasons);
    }
    return reasons;
}

} // namespace fx::editor
